//! Kernel strategies: how the contact kernels `k(t)` are got from `F(s)`. One file per plugin.

mod even_table;
mod moments;
#[cfg(test)]
mod rational;
mod split;
mod truncated;
mod wave_numbers;

pub use moments::Moments;
pub use split::Split;
pub use truncated::Truncated;

/// Names every module that registers a plugin, so that no linker drops this crate.
pub fn link() {
    moments::link();
    split::link();
    truncated::link();
}

#[cfg(test)]
mod tests {
    #[test]
    fn plugins_conform() {
        super::link();
        slipzone_api::testkit::check_crate(env!("CARGO_PKG_NAME"));
    }
}
