//! The contract is checked by breaking a table: every fault that it claims to find is committed here once.

use super::{Known, kernel};
use crate::{Component, KernelRequest, KernelStrategy, KernelTable, LayerResponse, Parts, PartsMut, Refusal};
use serde::{Deserialize, Serialize};

/// What is wrong with a table.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
enum Fault {
    None,
    Refuses,
    Scaled,
    Bump,
    NoNumber,
    Even,
    OtherValues,
    NoLength,
    NoEdgeError,
    NeverFiner,
    FinerRefused,
}

/// The kernels in closed form.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Faulty(Fault);

#[typetag::serde(name = "faulty-kernel")]
impl KernelStrategy for Faulty {
    fn tabulate(&self, response: &dyn LayerResponse, request: &KernelRequest) -> Result<Box<dyn KernelTable>, Refusal> {
        if self.0 == Fault::Refuses {
            return Err(Refusal::NotBuilt { what: "this".into(), remedy: "do without".into() });
        }
        let known = if response.tail(1)[0].vv == 0.0 { Known::HOMOGENEOUS } else { Known::GRADED };
        Ok(Box::new(FaultyTable { fault: self.0, known, reach: request.reach }))
    }

    fn refined(&self, _: u32) -> Box<dyn KernelStrategy> {
        Box::new(Self(if self.0 == Fault::FinerRefused { Fault::Refuses } else { self.0 }))
    }

    fn is_pinned(&self) -> bool {
        false
    }
}

struct FaultyTable {
    fault: Fault,
    known: Known,
    reach: f64,
}

impl FaultyTable {
    fn kernel(&self, component: Component, t: f64) -> f64 {
        let is_even = !component.is_odd() || self.fault == Fault::Even;
        let value = self.known.kernel(component, t.abs()) * if is_even { 1.0 } else { t.signum() };
        match (self.fault, component) {
            (Fault::Scaled | Fault::NeverFiner, Component::Coupling) => 1.001 * value,
            (Fault::Bump, Component::ShearStrain) => {
                value * (1.0 + 1e-3 * (-(10.0 * (t.abs() / self.reach - 0.5)).powi(2)).exp())
            }
            (Fault::NoNumber, Component::Depth) if t > 0.5 * self.reach => f64::NAN,
            _ => value,
        }
    }
}

impl KernelTable for FaultyTable {
    fn parts_into(&self, component: Component, distances: &[f64], out: PartsMut) {
        out.fill(distances, |t| Parts { smooth: self.kernel(component, t), ..Parts::default() });
    }

    fn values_into(&self, component: Component, distances: &[f64], out: &mut [f64]) {
        let more = if self.fault == Fault::OtherValues { 1e-9 } else { 0.0 };
        out.iter_mut().zip(distances).for_each(|(out, t)| *out = self.kernel(component, *t) + more);
    }

    fn error(&self) -> Option<f64> {
        if matches!(self.fault, Fault::NeverFiner | Fault::FinerRefused) { None } else { Some(1e-9) }
    }

    fn edge_error(&self) -> f64 {
        if self.fault == Fault::NoEdgeError { f64::NAN } else { 0.0 }
    }

    fn length(&self) -> f64 {
        if self.fault == Fault::NoLength { 0.0 } else { 1.0 }
    }

    fn flexibility_evaluations(&self) -> usize {
        0
    }
}

#[test]
fn every_fault_is_found() {
    assert_eq!(kernel(&Faulty(Fault::None)), Ok(()));
    for (fault, words) in [
        (Fault::Refuses, "it refuses all flexibilities that it is tried on"),
        (Fault::Scaled, "a surface that is graded, wide: Coupling at "),
        (Fault::Bump, "ShearStrain at 2.2 is off by 9.0"),
        (Fault::NoNumber, "values_into() has NaN"),
        (Fault::Even, "but by the distance's mirror image it is"),
        (Fault::OtherValues, "but by parts it is"),
        (Fault::NoLength, "length() = 0"),
        (Fault::NoEdgeError, "edge_error() = NaN"),
        (Fault::NeverFiner, "over the reach by refined(2), and without by"),
        (Fault::FinerRefused, "refined(2) is refused: this is not implemented yet"),
    ] {
        let found = kernel(&Faulty(fault)).expect_err("this table is broken");
        assert!(found.contains(words), "{fault:?}: {found}");
    }
}
