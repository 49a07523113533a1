//! Gradings: how the shear modulus varies with depth. One file per plugin.

mod exponential;
mod homogeneous;

pub use exponential::Exponential;
pub use homogeneous::Homogeneous;

/// Names every module that registers a plugin, so that no linker drops this crate.
pub fn link() {
    exponential::link();
    homogeneous::link();
}

#[cfg(test)]
mod tests {
    #[test]
    fn plugins_conform() {
        super::link();
        slipzone_api::testkit::check_crate(env!("CARGO_PKG_NAME"));
    }
}
