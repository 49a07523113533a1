//! The kernels of a narrow contact: a half-plane's, and what the base changes at first.

use serde::{Deserialize, Serialize};
use slipzone_api::{
    Component, KernelRequest, KernelStrategy, KernelTable, LayerResponse, Parts, PartsMut, Refusal, SurfaceFlexibility,
};

/// The first terms of the kernels in powers of `t`: moments of the flexibility.
///
/// Of a homogeneous layer `M(s)` falls like `exp(-2 s d)`, and with `m_n = int s^n M ds`
///
/// ```text
/// k_vv = m_1 t,    k_uu = m_1 t,    k_uv = m_0 - m_2 t^2/2,    G/A0 = -log|t| + g - m_1 t^2/2,
/// ```
///
/// each with its own `M`, and `g = ln 2d + int (M_vv + exp(-2 s d))/s ds`. What is left out is at most
/// `int s^3 |M| ds t^3/6`, and `int s^4 |M_uv| ds t^4/24` of the coupling: that is the error stated. A contact far
/// narrower than its layer is thick takes a dozen wave numbers this way, two where a millionth is asked for, and one
/// multiplication at each distance.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Moments {}

slipzone_api::register!(Kernel, "moments", "half-plane's kernels and the first correction by a base far away",
    example: "type = \"moments\"",
    parameters: [],
    source: "docs/planner.md");

/// Gauss's nodes on `(0, 4)` and from there on, over the depth, and what sums over them are good to: measured below for
/// either base and any contraction.
struct Sums {
    nodes: [(usize, f64); 2],
    error: f64,
}
const COARSE: Sums = Sums { nodes: [(8, 4.0), (4, 10.0)], error: 5e-4 };
const FINE: Sums = Sums { nodes: [(14, 4.0), (10, 18.0)], error: 1e-6 };
/// What is left out is such a sum as well: it is taken so much larger.
const CERTAIN: f64 = 1.05;
/// Share of the accuracy that coarse sums may take.
const SHARE: f64 = 0.1;

#[typetag::serde(name = "moments")]
impl KernelStrategy for Moments {
    fn serves(&self, response: &dyn LayerResponse) -> Result<(), Refusal> {
        depth(response).map(|_| ())
    }

    fn tabulate(&self, response: &dyn LayerResponse, request: &KernelRequest) -> Result<Box<dyn KernelTable>, Refusal> {
        let depth = depth(response)?;
        let is_coarse = COARSE.left_out(request, depth) <= SHARE * request.accuracy;
        let sums = if is_coarse { COARSE } else { FINE };
        let mut table = Table::new(response, depth, &sums)?;
        table.error = table.left_out(request) + sums.left_out(request, depth);
        Ok(Box::new(table))
    }

    fn refined(&self, _level: u32) -> Box<dyn KernelStrategy> {
        Box::new(self.clone())
    }

    fn is_pinned(&self) -> bool {
        false
    }
}

/// Depth of a homogeneous layer on a rigid base. (Under the surface of others the nodes of the sums may miss all there
/// is.)
fn depth(response: &dyn LayerResponse) -> Result<f64, Refusal> {
    match response.depth().filter(|_| response.is_homogeneous()) {
        Some(depth) if response.surface(0.0)?.vv == 0.0 => Ok(depth),
        _ => Err(Refusal::OutOfReach {
            method: "moments",
            why: "its kernels are those of a homogeneous layer on a rigid base".into(),
            remedy: "take the strategy `split`",
        }),
    }
}

impl Sums {
    /// Wave numbers over the depth, and their weights.
    fn rule(&self) -> impl Iterator<Item = (f64, f64)> {
        let [(first, end), (second, last)] = self.nodes;
        [(first, 0.0, end), (second, end, last)].into_iter().flat_map(|(count, from, to)| {
            let rule = bilby::GaussLegendre::new(count).expect("nodes").rule().clone();
            let (middle, half) = (f64::midpoint(from, to), 0.5 * (to - from));
            rule.nodes.into_iter().zip(rule.weights).map(move |(x, weight)| (middle + half * x, half * weight))
        })
    }

    /// Their part of the error, in the terms of the request.
    fn left_out(&self, request: &KernelRequest, depth: f64) -> f64 {
        let t = request.reach / depth;
        let of = |component: &Component| match component {
            Component::NormalSlope | Component::ShearStrain => t * t,
            Component::Coupling => t,
            Component::Depth => 1.0,
        };
        self.error * request.components.iter().map(of).fold(0.0, f64::max)
    }
}

/// What `moments` builds.
struct Table {
    /// `m_1` of the slope and of the strain.
    odd: [f64; 2],
    /// `m_0`, `m_2` of the coupling.
    even: [f64; 2],
    /// `g`.
    ground: f64,
    /// `int s^3 |M_vv| ds`, the same with `M_uu`, and `int s^4 |M_uv| ds`.
    next: [f64; 3],
    depth: f64,
    error: f64,
    flexibility_evaluations: usize,
}

impl Table {
    fn new(response: &dyn LayerResponse, depth: f64, sums: &Sums) -> Result<Self, Refusal> {
        let (waves, weights): (Vec<f64>, Vec<f64>) = sums.rule().map(|(s, weight)| (s / depth, weight / depth)).unzip();
        let mut flexibility = vec![SurfaceFlexibility::default(); waves.len()];
        response.surface_into(&waves, &mut flexibility)?;
        let beta = response.elastic().beta();
        let mut table = Self {
            odd: [0.0; 2],
            even: [0.0; 2],
            ground: 0.0,
            next: [0.0; 3],
            depth,
            error: 0.0,
            flexibility_evaluations: waves.len(),
        };
        for ((s, w), f) in waves.iter().zip(weights).zip(&flexibility) {
            let [vv, uu, uv] = [f.vv - 1.0, f.uu - 1.0, f.uv + beta];
            table.odd[0] += w * s * vv;
            table.odd[1] += w * s * uu;
            table.even[0] += w * uv;
            table.even[1] += w * s * s * uv;
            // As fast as the layer falls: the logarithm of the length is added.
            table.ground += w * (vv + (-2.0 * s * depth).exp()) / s;
            table.next[0] += w * s.powi(3) * vv.abs();
            table.next[1] += w * s.powi(3) * uu.abs();
            table.next[2] += w * s.powi(4) * uv.abs();
        }
        table.ground += (2.0 * depth).ln();
        Ok(table)
    }

    /// What the first terms leave out up to the reach, in the terms of the request.
    fn left_out(&self, request: &KernelRequest) -> f64 {
        let t = request.reach;
        let of = |component: &Component| match component {
            Component::NormalSlope => self.next[0] * t.powi(4) / 6.0,
            Component::ShearStrain => self.next[1] * t.powi(4) / 6.0,
            Component::Coupling => self.next[2] * t.powi(5) / 24.0,
            Component::Depth => self.next[0] * t.powi(4) / 24.0,
        };
        CERTAIN * request.components.iter().map(of).fold(0.0, f64::max)
    }

    fn parts(&self, component: Component, t: f64) -> Parts {
        let (smooth, log) = match component {
            Component::NormalSlope => (self.odd[0] * t, 0.0),
            Component::ShearStrain => (self.odd[1] * t, 0.0),
            Component::Coupling => (self.even[0] - 0.5 * self.even[1] * t * t, 0.0),
            Component::Depth => (self.ground - 0.5 * self.odd[0] * t * t, -1.0),
        };
        Parts { smooth, sign: 0.0, log }
    }
}

impl KernelTable for Table {
    fn parts_into(&self, component: Component, distances: &[f64], out: PartsMut) {
        out.fill(distances, |t| self.parts(component, t));
    }

    fn values_into(&self, component: Component, distances: &[f64], out: &mut [f64]) {
        assert_eq!(distances.len(), out.len(), "one value for each distance");
        for (out, t) in out.iter_mut().zip(distances) {
            *out = self.parts(component, *t).value(*t);
        }
    }

    fn error(&self) -> Option<f64> {
        Some(self.error)
    }

    fn length(&self) -> f64 {
        self.depth
    }

    fn flexibility_evaluations(&self) -> usize {
        self.flexibility_evaluations
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Split;
    use slipzone_api::{Base, Flexibility, LayerModel, Moduli, ModulusLaw, Plane, Poisson, Positive, Solid};
    use slipzone_flexibilities::Compliance;
    use std::sync::Arc;

    #[derive(Debug)]
    struct Homogeneous;

    impl ModulusLaw for Homogeneous {
        fn modulus(&self, _depth: f64) -> f64 {
            1.0
        }

        fn exponent(&self) -> Option<f64> {
            Some(0.0)
        }
    }

    const ALL: [Component; 4] = [Component::Depth, Component::NormalSlope, Component::ShearStrain, Component::Coupling];

    /// Its bound holds for every kernel against `split` at full accuracy, and is no more than a hundred times too large
    /// where the series' next term decides.
    #[test]
    fn is_off_by_no_more_than_it_says() {
        for plane in [Plane::Strain, Plane::Stress] {
            for base in [Base::Rigid, Base::Frictionless] {
                for nu in [-0.95, -0.5, 0.0, 0.3, 0.45, 0.4776, 0.49, 0.4999, 0.5] {
                    let solid = Solid { plane, poisson: Poisson::new(nu).expect("in range"), moduli: Moduli::Shear };
                    let model = Arc::new(LayerModel::new(Box::new(Homogeneous), solid, base));
                    let response = Compliance {}.respond(&model).expect("a layer");
                    for reach in [1e-3, 1e-2, 0.1, 0.4] {
                        for component in ALL {
                            let components = &[component];
                            let request = |accuracy| KernelRequest { reach, components, accuracy };
                            let exact = Split::default().tabulate(&*response, &request(1e-13)).expect("a table");
                            for accuracy in [1e-3, 1e-8] {
                                let request = request(accuracy);
                                let first = Moments {}.tabulate(&*response, &request).expect("a table");
                                let scale = if component == Component::Depth { 1.0 } else { reach };
                                let worst = (1..=50).map(|i| f64::from(i) / 50.0 * reach).fold(0.0_f64, |worst, t| {
                                    let [mut one, mut other] = [[0.0], [0.0]];
                                    exact.values_into(component, &[t], &mut one);
                                    first.values_into(component, &[t], &mut other);
                                    worst.max(scale * (one[0] - other[0]).abs())
                                });
                                let (bound, own) = (first.error().unwrap(), exact.error().unwrap());
                                let what = format!("{plane:?}, {base:?}, nu = {nu}, {component:?} up to {reach}");
                                assert!(worst <= bound + own, "{what}: off by {worst:e}, not {bound:e}");
                                assert!(reach < 0.1 || worst > 0.01 * bound, "{what}: off by {worst:e}, not {bound:e}");
                            }
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn a_graded_surface_is_refused() {
        #[derive(Debug)]
        struct Growing;
        impl ModulusLaw for Growing {
            fn modulus(&self, depth: f64) -> f64 {
                (0.1 * depth).exp()
            }

            fn exponent(&self) -> Option<f64> {
                Some(0.1)
            }
        }
        let solid =
            Solid { plane: Plane::Strain, poisson: Poisson::new(0.3).expect("in range"), moduli: Moduli::Shear };
        let model = Arc::new(LayerModel::new(Box::new(Growing), solid, Base::Rigid));
        let response = Compliance {}.respond(&model).expect("a layer");
        let request = KernelRequest { reach: 0.1, components: &ALL, accuracy: 1e-3 };
        let refused = Moments {}.tabulate(&*response, &request).err().expect("a refusal");
        assert!(refused.to_string().contains("homogeneous layer"), "{refused}");
    }

    /// What lies below a homogeneous surface is felt as well: a stiff skin on a soft layer was off by 5 %, claimed to
    /// 1e-6.
    #[test]
    fn what_is_not_homogeneous_below_is_refused() {
        #[derive(Debug)]
        struct Below(fn(f64) -> f64);
        impl ModulusLaw for Below {
            fn modulus(&self, depth: f64) -> f64 {
                (self.0)(depth)
            }

            fn breakpoints(&self) -> &[f64] {
                if (self.0)(0.5) > 1.5 || (self.0)(0.5) < 0.5 { &[0.01] } else { &[] }
            }
        }
        let solid =
            Solid { plane: Plane::Strain, poisson: Poisson::new(0.3).expect("in range"), moduli: Moduli::Shear };
        for modulus in
            [|y| if y < 0.01 { 1.0 } else { 0.01 }, |y| if y < 0.01 { 1.0 } else { 10.0 }, |y: f64| 1.0 + y.powi(5)]
        {
            for base in [Base::Rigid, Base::Frictionless] {
                let model = Arc::new(LayerModel::new(Box::new(Below(modulus)), solid, base));
                let response = Compliance {}.respond(&model).expect("a layer");
                for accuracy in [1e-3, 1e-6] {
                    let request = KernelRequest { reach: 1e-5, components: &ALL, accuracy };
                    let refused = Moments {}.tabulate(&*response, &request).err().expect("a refusal");
                    assert!(refused.to_string().contains("homogeneous layer"), "{refused}");
                }
            }
        }
    }

    /// Under long waves it moves without end, and no moment of it exists.
    #[test]
    fn a_half_plane_below_is_refused() {
        let poisson = Poisson::new(0.3).expect("in range");
        let solid = Solid { plane: Plane::Strain, poisson, moduli: Moduli::Shear };
        let base = Base::HalfPlane { shear: Positive::new(1e-3).expect("above 0"), poisson };
        let model = Arc::new(LayerModel::new(Box::new(Homogeneous), solid, base));
        let response = Compliance {}.respond(&model).expect("a layer");
        let request = KernelRequest { reach: 0.1, components: &ALL, accuracy: 1e-3 };
        let refused = Moments {}.tabulate(&*response, &request).err().expect("a refusal");
        assert!(refused.to_string().contains("rigid base"), "{refused}");
    }
}
