//! Flexibilities: how the surface flexibility `F(s)` of a layer is got. One file per plugin.

mod by_need;
mod closed_form;
mod coefficients;
mod compliance;
mod exponential;
#[cfg(test)]
mod fixtures;
mod graded_half_plane;
mod half_plane;
mod integration;
mod layered;
mod minors;
mod panels;
mod precision;
mod propagator;
mod slice;
mod slices;
mod surface_tail;
mod transfer_matrix;

pub use closed_form::ClosedForm;
pub use compliance::Compliance;
pub use transfer_matrix::TransferMatrix;

/// Names every module that registers a plugin, so that no linker drops this crate.
pub fn link() {
    closed_form::link();
    compliance::link();
    transfer_matrix::link();
}

#[cfg(test)]
mod tests {
    #[test]
    fn plugins_conform() {
        super::link();
        slipzone_api::testkit::check_crate(env!("CARGO_PKG_NAME"));
    }
}
