//! The contract is checked by breaking a response: every fault that it claims to find is committed here once.

use super::{WAVE_NUMBERS, apart, flexibility, layers, marched, wave_number};
use crate::{Base, Elastic, Flexibility, LayerModel, LayerResponse, Plane, Refusal, SurfaceFlexibility};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// What is wrong with a response.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
enum Fault {
    None,
    Refuses,
    RefusesLongWaves,
    Bump,
    NoNumber,
    Sign,
    OtherTogether,
    OtherSolid,
    OtherSeries,
    LongSeries,
    NoDepth,
}

/// Small steps through the layer.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Faulty(Fault);

#[typetag::serde(name = "faulty-response")]
impl Flexibility for Faulty {
    fn respond(&self, layer: &Arc<LayerModel>) -> Result<Box<dyn LayerResponse>, Refusal> {
        // The steps need a base to begin at.
        if self.0 == Fault::Refuses || layer.base == Base::Infinite {
            return Err(refusal());
        }
        Ok(Box::new(FaultyResponse { fault: self.0, layer: Arc::clone(layer) }))
    }
}

fn refusal() -> Refusal {
    Refusal::NotBuilt { what: "this".into(), remedy: "do without".into() }
}

struct FaultyResponse {
    fault: Fault,
    layer: Arc<LayerModel>,
}

impl LayerResponse for FaultyResponse {
    fn surface(&self, s: f64) -> Result<SurfaceFlexibility, Refusal> {
        if self.fault == Fault::RefusesLongWaves && s > 0.1 {
            return Err(refusal());
        }
        let mut f = marched(&self.layer, s);
        match self.fault {
            Fault::Bump => f.vv *= 1.0 + 0.3 * (-(s - 3.0).powi(2)).exp(),
            Fault::NoNumber if s > 10.0 => f.uu = f64::NAN,
            Fault::Sign => f.uv = -f.uv,
            _ => {}
        }
        Ok(f)
    }

    fn surface_into(&self, wave_numbers: &[f64], out: &mut [SurfaceFlexibility]) -> Result<(), Refusal> {
        for (s, out) in wave_numbers.iter().zip(out) {
            *out = self.surface(*s)?;
            if self.fault == Fault::OtherTogether {
                out.uv += 1e-6;
            }
        }
        Ok(())
    }

    fn elastic(&self) -> Elastic {
        if self.fault == Fault::OtherSolid { Elastic::of(Plane::Stress, 0.3) } else { self.layer.elastic }
    }

    fn tail(&self, terms: usize) -> Vec<SurfaceFlexibility> {
        match self.fault {
            // Of a homogeneous surface, which half of the layers do not have.
            Fault::OtherSeries => vec![SurfaceFlexibility::default(); terms],
            Fault::LongSeries => vec![SurfaceFlexibility::default(); terms + 1],
            _ => Vec::new(),
        }
    }

    fn depth(&self) -> Option<f64> {
        if self.fault == Fault::NoDepth { Some(0.0) } else { Some(1.0) }
    }
}

#[test]
fn every_fault_is_found() {
    assert_eq!(flexibility(&Faulty(Fault::None)), Ok(()));
    for (fault, words) in [
        (Fault::Refuses, "it refuses all layers that it is tried on: a homogeneous layer on a rigid base, exp("),
        (Fault::RefusesLongWaves, "is refused: this is not implemented yet"),
        (Fault::Bump, "but it is SurfaceFlexibility { vv: 0."),
        (Fault::NoNumber, "uu: NaN"),
        (Fault::Sign, "a homogeneous layer on a rigid base: surface(0.01) = "),
        (Fault::OtherTogether, "surface_into() has SurfaceFlexibility"),
        (Fault::OtherSolid, "elastic() is Elastic"),
        (Fault::OtherSeries, "exp(1.5 y) on a rigid base: the limit and tail() give"),
        (Fault::LongSeries, "tail(8) has 9 terms"),
        (Fault::NoDepth, "depth() = 0"),
    ] {
        let found = flexibility(&Faulty(fault)).expect_err("this response is broken");
        assert!(found.contains(words), "{fault:?}: {found}");
    }
}

/// `s F/A0` of a homogeneous bonded layer (theory.md section 2).
fn bonded(kappa: f64, w: f64) -> SurfaceFlexibility {
    let (sinh, cosh) = ((2.0 * w).sinh(), (2.0 * w).cosh());
    let below = kappa * cosh + 2.0 * w * w + 0.5 * (1.0 + kappa * kappa);
    SurfaceFlexibility {
        vv: (kappa * sinh - 2.0 * w) / below,
        uu: (kappa * sinh + 2.0 * w) / below,
        uv: (4.0 * w * w - kappa * (kappa - 1.0) * (cosh - 1.0)) / ((kappa + 1.0) * below),
    }
}

#[test]
fn the_steps_are_fine_enough() {
    let (_, homogeneous) = &layers()[0];
    for s in (0..WAVE_NUMBERS).map(wave_number) {
        let error = apart(marched(homogeneous, s), bonded(homogeneous.elastic.kappa, s));
        // The closed form loses digits to its difference of two large numbers where the wave is long.
        assert!(error < 1e-8, "s = {s}: {error:e}");
    }
}
