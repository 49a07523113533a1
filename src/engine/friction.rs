//! What friction adds to one contact: stick zones, the shear in them, the conditions that they are to meet.

pub(crate) mod carrier;
pub(crate) mod checks;
pub(crate) mod half_plane_shear;
pub(crate) mod linear_strain;
pub(crate) mod rubbing;
pub(crate) mod sharpen;
pub(crate) mod slip_grid;
pub(crate) mod stick;
pub(crate) mod stick_search;
pub(crate) mod stick_zone;
pub(crate) mod strain;
