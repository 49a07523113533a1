//! A homogeneous solid without a base.

use crate::surface_tail;
use slipzone_api::{Elastic, LayerResponse, Refusal, SurfaceFlexibility};

/// `s F/A0` is the same at every wave number.
#[derive(Debug)]
pub(crate) struct HalfPlane {
    pub(crate) elastic: Elastic,
    /// Depth from which vertical displacements are counted.
    pub(crate) datum: Option<f64>,
}

impl LayerResponse for HalfPlane {
    fn surface(&self, _s: f64) -> Result<SurfaceFlexibility, Refusal> {
        Ok(surface_tail::half_plane(self.elastic))
    }

    fn elastic(&self) -> Elastic {
        self.elastic
    }

    fn tail(&self, terms: usize) -> Vec<SurfaceFlexibility> {
        vec![SurfaceFlexibility::default(); terms]
    }

    fn depth(&self) -> Option<f64> {
        None
    }
}
