//! How precisely a layer is followed: what is left out, and where.

use crate::integration::{HALF, HALF_ROUGH};

/// What of a layer matters.
#[derive(Debug)]
pub(crate) struct Precision {
    /// Largest relative error of a coefficient of the equations: the last ones of its Chebyshev series, and two values
    /// beside the nodes.
    pub(crate) fit: (f64, f64),
    /// Chebyshev coefficients below this part of what they add up to are left out.
    pub(crate) dropped: f64,
    /// By how many of its thicknesses below its top a panel shows a law to be no different from what is above:
    /// polynomials fit where the nearest singularity is about as far away as that.
    pub(crate) shown: f64,
    /// A power of a slice's series below this part of the largest is left out.
    pub(crate) negligible: f64,
    /// Half the nodes on which those powers are integrated.
    pub(crate) half: usize,
    /// Largest wave number of a slice, over its thickness, whose digits all count. Rising states lose `exp(2 s delta)`
    /// of them; what is lost at a depth `y` counts as `exp(-2 s y)` at the surface, so that slices may be as thick as
    /// they are deep, and so much more.
    pub(crate) thick: f64,
    /// A base is forgotten where `exp(-2 s y)` times the contrast of moduli, and times the square of the polynomial
    /// that goes with it (below `exp(8)` there), drops under `exp(8 - forgotten)`: what is put in its place is as good
    /// to a digit at least.
    pub(crate) forgotten: f64,
}

/// Largest wave number of any slice, over its thickness. What the nodes make of a series has a pole at 15.15 with 14
/// nodes, later with more.
const THICKEST: f64 = 10.0;

impl Precision {
    /// Largest wave number of a slice that is so many times as thick as deep, over its thickness: a wave that feels it
    /// is no shorter.
    pub(crate) fn thickest(&self, thickness_over_depth: f64) -> f64 {
        if thickness_over_depth > 1.0 {
            return self.thick;
        }
        (self.forgotten * thickness_over_depth).clamp(self.thick, THICKEST)
    }
}

/// To rounding.
pub(crate) static FULL: Precision = Precision {
    fit: (4e-15, 2e-14),
    dropped: 6e-16,
    shown: 4.0,
    negligible: f64::EPSILON / 8.0,
    half: HALF,
    thick: 2.0,
    forgotten: 41.0,
};

/// The error that [`ROUGH`] leaves, see [`slipzone_api::LayerResponse::roughly`].
pub(crate) const ROUGHNESS: f64 = 1e-12;

/// To [`ROUGHNESS`]: half as many slices, each at half the cost.
pub(crate) static ROUGH: Precision = Precision {
    fit: (5e-14, 2e-13),
    dropped: 5e-15,
    shown: 3.3,
    negligible: 1e-14,
    half: HALF_ROUGH,
    thick: 3.0,
    forgotten: 37.0,
};
