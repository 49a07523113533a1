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

    fn against_datum(&self) -> Option<Box<dyn LayerResponse>> {
        Some(Box::new(AgainstDatum { elastic: self.elastic, datum: self.datum? }))
    }

    fn depth(&self) -> Option<f64> {
        None
    }
}

/// The same with vertical displacements counted from a depth `d`: under a wave of pressure they fall like
/// `exp(-s d) (1 + 2 s d/(kappa + 1))`.
#[derive(Debug)]
struct AgainstDatum {
    elastic: Elastic,
    datum: f64,
}

impl LayerResponse for AgainstDatum {
    fn surface(&self, s: f64) -> Result<SurfaceFlexibility, Refusal> {
        let phase = s * self.datum;
        let vv = -(-phase).exp_m1() - (-phase).exp() * phase * 2.0 / (self.elastic.kappa + 1.0);
        Ok(SurfaceFlexibility { vv, ..surface_tail::half_plane(self.elastic) })
    }

    fn elastic(&self) -> Elastic {
        self.elastic
    }

    fn tail(&self, terms: usize) -> Vec<SurfaceFlexibility> {
        vec![SurfaceFlexibility::default(); terms]
    }

    fn depth(&self) -> Option<f64> {
        Some(0.5 * self.datum)
    }
}
