//! The frictionless contact at one resolution: its pressure, its size, its depth.

pub(crate) mod contact_size;
pub(crate) mod half_plane_depth;
pub(crate) mod lookout;
pub(crate) mod normal;
