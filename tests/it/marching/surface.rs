//! What a layer's surface does, in the units of the march: half-width at the end 1, surface modulus 1.

use crate::sketch::Sketch;
use slipzone::api::{Component, Elastic, Flexibility, KernelRequest, KernelStrategy, KernelTable};
use slipzone_flexibilities::ClosedForm;
use slipzone_kernels::Split;
use std::sync::Arc;

/// Elastic constants and kernels, the library's own: they are verified elsewhere.
pub(super) struct Surface {
    pub(super) elastic: Elastic,
    /// `None` on a half-plane.
    kernels: Option<(Box<dyn KernelTable>, f64)>,
}

/// Four nodes of Gauss and Legendre on `[0, 1]`, and their weights.
pub(super) const GAUSS: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

impl Surface {
    pub(super) fn new(sketch: &Sketch) -> Self {
        let layer = sketch.scene().layer;
        let elastic = Elastic::new(layer.plane, layer.poisson);
        let Some(thickness) = layer.thickness else { return Self { elastic, kernels: None } };
        let model = Arc::new(layer.model().expect("a law"));
        let response = ClosedForm {}.respond(&model).expect("an exponential layer");
        let components = &[Component::NormalSlope, Component::ShearStrain, Component::Coupling];
        // Far below what the march is asked for.
        let request = KernelRequest { reach: 2.0 / thickness.get(), components, accuracy: 1e-9 };
        let table = Split::default().tabulate(response.as_ref(), &request).expect("a kernel table");
        Self { elastic, kernels: Some((table, thickness.get())) }
    }

    pub(super) fn is_half_plane(&self) -> bool {
        self.kernels.is_none()
    }

    /// The kernel at each distance, 1/length.
    pub(super) fn kernel(&self, component: Component, distances: &[f64]) -> Vec<f64> {
        let mut values = vec![0.0; distances.len()];
        if let Some((table, thickness)) = &self.kernels {
            let scaled: Vec<f64> = distances.iter().map(|t| t / thickness).collect();
            table.values_into(component, &scaled, &mut values);
            for k in &mut values {
                *k /= thickness;
            }
        }
        values
    }

    /// `int k dt` and `int k (end - t) dt` over each of `count` pieces of the given `width`, from `t = 0` on.
    pub(super) fn moments(&self, component: Component, width: f64, count: usize) -> Vec<(f64, f64)> {
        let rule = |piece: usize| GAUSS.map(|(node, weight)| crowded(piece, node, weight));
        let distances = (0..count).flat_map(|piece| rule(piece).map(|(node, _)| (piece as f64 + node) * width));
        let values = self.kernel(component, &distances.collect::<Vec<_>>());
        let moments = values.chunks(GAUSS.len()).enumerate().map(|(piece, k)| {
            let each = k.iter().zip(rule(piece));
            let zeroth: f64 = each.clone().map(|(k, (_, weight))| width * weight * k).sum();
            let first: f64 = each.map(|(k, (node, weight))| width * width * weight * (1.0 - node) * k).sum();
            (zeroth, first)
        });
        moments.collect()
    }
}

/// Node and weight of a piece: those of the first piece crowd towards its start, where kernels of graded layers and
/// the pressure under a wedge have logarithms. Left as they are they cost an order.
pub(super) fn crowded(piece: usize, node: f64, weight: f64) -> (f64, f64) {
    if piece == 0 { (node.powi(4), 4.0 * node.powi(3) * weight) } else { (node, weight) }
}
