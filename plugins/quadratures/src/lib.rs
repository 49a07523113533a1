//! Quadratures: how a singular integral equation becomes matrix rows. One file per plugin.

mod count;
mod de_sinc;
#[cfg(test)]
mod fixtures;
mod gauss_chebyshev;
mod graded_panels;

pub use de_sinc::DeSinc;
pub use gauss_chebyshev::GaussChebyshev;
pub use graded_panels::GradedPanels;

/// Names every module that registers a plugin, so that no linker drops this crate.
pub fn link() {
    de_sinc::link();
    gauss_chebyshev::link();
    graded_panels::link();
}

#[cfg(test)]
mod tests {
    #[test]
    fn plugins_conform() {
        super::link();
        slipzone_api::testkit::check_crate(env!("CARGO_PKG_NAME"));
    }
}
