//! What a result reports, and how sure each number is.

pub(crate) mod error_estimate;
pub(crate) mod quantity;
