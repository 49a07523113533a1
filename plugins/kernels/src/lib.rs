//! Kernel strategies: how the contact kernels `k(t)` are got from `F(s)`. One file per plugin.

mod even_table;
mod integrand;
mod legendre_waves;
mod moments;
mod octaves;
mod origin;
mod piece;
mod polynomial;
#[cfg(test)]
mod rational;
mod spherical_bessel;
mod split;
mod table;
mod truncated;
mod wave_numbers;

pub use moments::Moments;
pub use octaves::Octaves;
pub use split::Split;
pub use truncated::Truncated;

use slipzone_api::{LayerResponse, Refusal};

/// Depth of what stands on a base down to its first break, or a refusal.
fn depth(response: &dyn LayerResponse) -> Result<f64, Refusal> {
    response.depth().ok_or_else(|| Refusal::NotBuilt {
        what: "a kernel of a homogeneous half-plane, which has none,".into(),
        remedy: "solve it by its Cauchy part alone".into(),
    })
}

/// Names every module that registers a plugin, so that no linker drops this crate.
pub fn link() {
    moments::link();
    octaves::link();
    split::link();
    truncated::link();
}

#[cfg(test)]
mod tests {
    use super::*;
    use slipzone_api::{Component, Elastic, KernelRequest, KernelStrategy, Plane, Poisson, SurfaceFlexibility};

    #[test]
    fn plugins_conform() {
        link();
        slipzone_api::testkit::check_crate(env!("CARGO_PKG_NAME"));
    }

    #[test]
    fn a_half_plane_has_no_kernel() {
        struct HalfPlane;
        impl LayerResponse for HalfPlane {
            fn surface(&self, _: f64) -> Result<SurfaceFlexibility, Refusal> {
                unreachable!("nothing to ask")
            }

            fn elastic(&self) -> Elastic {
                Elastic::new(Plane::Strain, Poisson::new(0.3).expect("in range"))
            }

            fn tail(&self, terms: usize) -> Vec<SurfaceFlexibility> {
                vec![SurfaceFlexibility::default(); terms]
            }

            fn depth(&self) -> Option<f64> {
                None
            }
        }
        let strategies: [&dyn KernelStrategy; 4] =
            [&Moments::default(), &Octaves::default(), &Split::default(), &Truncated::default()];
        let request = KernelRequest { reach: 1.0, components: &[Component::NormalSlope], accuracy: 1e-8 };
        assert!(strategies.iter().all(|strategy| strategy.tabulate(&HalfPlane, &request).is_err()));
        assert!(Moments::default().serves(&HalfPlane).is_err() && Octaves::default().serves(&HalfPlane).is_err());
    }
}
