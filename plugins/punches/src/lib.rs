//! Punches: the shape of the rigid body. One file per plugin.

mod cylinder;
mod flat;

pub use cylinder::Cylinder;
pub use flat::Flat;

/// Names every module that registers a plugin, so that no linker drops this crate.
pub fn link() {
    cylinder::link();
    flat::link();
}

#[cfg(test)]
mod tests {
    #[test]
    fn plugins_conform() {
        super::link();
        slipzone_api::testkit::check_crate(env!("CARGO_PKG_NAME"));
    }
}
