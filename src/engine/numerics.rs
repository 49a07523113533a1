//! Numerical tools that know nothing of contacts.

pub(crate) mod chebyshev;
pub(crate) mod climb;
pub(crate) mod dense;
pub(crate) mod elimination;
pub(crate) mod lanes;
pub(crate) mod root;
pub(crate) mod ways;
