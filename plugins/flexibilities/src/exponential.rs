//! An exponential layer on a rigid base, or without a base, whichever way its flexibility is got.

use crate::surface_tail;
use slipzone_api::{Elastic, LayerResponse, Refusal, SurfaceFlexibility};

/// Largest `|ln(mu3/mu1)|`: the moduli, and squares of what fades with them, stay within the range of floats.
pub(crate) const STEEPEST: f64 = 300.0;

/// `mu1 exp(gamma y)` on a rigid base or without a base, and how `s F/A0` is got at one wave number.
pub(crate) struct Exponential {
    pub(crate) elastic: Elastic,
    pub(crate) gamma: f64,
    /// 1; without a base the depth in which it stiffens by a factor of e.
    pub(crate) depth: f64,
    pub(crate) surface: fn(&Exponential, f64) -> Result<SurfaceFlexibility, Refusal>,
}

impl Exponential {
    /// The layer, unless it is steeper than the numbers of `method` reach.
    pub(crate) fn no_steeper(self, method: &'static str) -> Result<Box<dyn LayerResponse>, Refusal> {
        if self.gamma.abs() <= STEEPEST { Ok(Box::new(self)) } else { Err(too_steep(method, self.gamma)) }
    }
}

/// The refusal of a law steeper than [`STEEPEST`].
pub(crate) fn too_steep(method: &'static str, gamma: f64) -> Refusal {
    Refusal::OutOfReach {
        method,
        why: format!("ln(mu3/mu1) = {gamma} is beyond +-{STEEPEST}"),
        remedy: "use a modulus at the base that is closer to the one at the surface",
    }
}

impl LayerResponse for Exponential {
    fn surface(&self, wave_number: f64) -> Result<SurfaceFlexibility, Refusal> {
        (self.surface)(self, wave_number)
    }

    fn elastic(&self) -> Elastic {
        self.elastic
    }

    fn tail(&self, terms: usize) -> Vec<SurfaceFlexibility> {
        surface_tail::exponential(self.elastic, self.gamma, terms)
    }

    fn depth(&self) -> Option<f64> {
        Some(self.depth)
    }

    fn is_homogeneous(&self) -> bool {
        self.gamma == 0.0
    }
}
