//! Pressure without friction: the half-plane's in closed form, what the layer adds by the scheme of Erdogan and Gupta.
//!
//! F. Erdogan, G. D. Gupta, Q. Appl. Math. 29 (1972) 525: Gauss and Chebyshev, density `sqrt(1 - t^2)` times a
//! polynomial, collocation at the zeros between. With the closed form taken off, what is left is smooth but for the
//! jump and the logarithm of a graded layer's kernel, which leave an error that goes like the square of the spacing,
//! cleanly enough to be extrapolated away. What the closed form does to the layer is integrated between its own
//! singularities and the kernel's: taken at the nodes, a wedge's logarithm would leave an error of the first order.

use super::dense::solve;
use super::surface::{GAUSS, Surface, crowded};
use slipzone::api::Component;
use slipzone::api::double_exponential::nodes_up_to;
use std::f64::consts::PI;

/// Nodes over the whole contact, even numbers.
const NODES: [usize; 2] = [48, 96];

/// The pressure of one half-width.
pub(super) struct Pressure<'a> {
    known: Known<'a>,
    half_width: f64,
    coarse: Added,
    fine: Added,
}

impl<'a> Pressure<'a> {
    /// `half_plane(x)` is the pressure of the same punch on a half-plane, smooth but for `kink` and the middle, where
    /// it is `tip ln(1/|x|)`.
    pub(super) fn new(
        surface: &Surface,
        half_plane: &'a dyn Fn(f64) -> f64,
        [kink, tip]: [f64; 2],
        half_width: f64,
    ) -> Self {
        let bend = tip * half_width * surface.kernel(Component::NormalSlope, &[1e-9])[0];
        let known = Known { half_plane, kink, bend };
        let [coarse, fine] = NODES.map(|nodes| Added::new(surface, &known, half_width, nodes));
        Self { known, half_width, coarse, fine }
    }

    /// `int p dx` over each of `count` pieces of the given `width` from the middle on; the last may end with the
    /// contact.
    pub(super) fn masses(&self, width: f64, count: usize) -> Vec<f64> {
        let b = self.half_width;
        // x = b sin: the edge's square root becomes a cosine.
        let angle = |piece: usize| (piece as f64 * width / b).min(1.0).asin();
        let mass = |piece: usize| {
            let (from, to) = (angle(piece), angle(piece + 1));
            let each = GAUSS.iter().map(|(node, weight)| {
                let (part, weight) = crowded(piece, *node, *weight);
                let (sin, cos) = (from + part * (to - from)).sin_cos();
                (to - from) * weight * b * cos * self.value(sin, cos)
            });
            each.sum()
        };
        (0..count).map(mass).collect()
    }

    /// At `x = b s`, `root = sqrt(1 - s^2)`.
    fn value(&self, s: f64, root: f64) -> f64 {
        let [coarse, fine] = [&self.coarse, &self.fine].map(|added| root * added.value(s));
        let spacings = (NODES[1] + 1) as f64 / (NODES[0] + 1) as f64;
        self.known.value(self.half_width * s, s, root) + fine + (fine - coarse) / (spacings * spacings - 1.0)
    }
}

/// What is known of the pressure beforehand.
struct Known<'a> {
    half_plane: &'a dyn Fn(f64) -> f64,
    kink: f64,
    /// The kernel's jump answers the logarithm under a wedge's tip with a bend: `bend |t| sqrt(1 - t^2)`.
    bend: f64,
}

impl Known<'_> {
    /// At `x = b s`, `root = sqrt(1 - s^2)`.
    fn value(&self, x: f64, s: f64, root: f64) -> f64 {
        (self.half_plane)(x) + self.bend * s.abs() * root
    }

    /// `(1/pi) PV int` of the bend over `s - t`: `(2 s/pi) (1 - r artanh r)`, `r = sqrt(1 - s^2)`.
    fn slope_of_bend(&self, s: f64) -> f64 {
        let root = (1.0 - s * s).sqrt();
        self.bend * 2.0 * s / PI * (1.0 - root * root.atanh())
    }
}

/// What else the layer adds, over `sqrt(1 - t^2)`.
struct Added {
    /// Nodes `t > 0`, their barycentric weights (both sides together), and the values there.
    terms: Vec<[f64; 3]>,
}

impl Added {
    fn new(surface: &Surface, known: &Known, b: f64, nodes: usize) -> Self {
        let (half, spacing) = (nodes / 2, PI / (nodes + 1) as f64);
        let points: Vec<f64> = (0..half).map(|i| (spacing * (i as f64 + 0.5)).cos()).collect();
        let nodes: Vec<f64> = (1..=half).map(|j| (spacing * j as f64).cos()).collect();
        if surface.is_half_plane() {
            return Self { terms: nodes.iter().map(|t| [*t, 1.0, 0.0]).collect() };
        }
        let pairs = points.iter().flat_map(|x| nodes.iter().flat_map(move |t| [b * (x - t), b * (x + t)]));
        let kernel = surface.kernel(Component::NormalSlope, &pairs.collect::<Vec<_>>());
        let (mut matrix, mut values) = (vec![0.0; half * half], vec![0.0; half]);
        for (i, x) in points.iter().enumerate() {
            for (j, t) in nodes.iter().enumerate() {
                let weight = (1.0 - t * t) * spacing / PI;
                let at = i * half + j;
                let layer = b * (kernel[2 * at] + kernel[2 * at + 1]);
                matrix[at] = weight * (1.0 / (x - t) + 1.0 / (x + t) + layer);
            }
            values[i] = -potential(surface, known, b * x, b) - known.slope_of_bend(*x);
        }
        solve(&mut matrix, &mut values);
        let signs = [1.0, -1.0].into_iter().cycle();
        let terms = nodes.iter().zip(values).zip(signs).map(|((t, value), sign)| [*t, sign * (1.0 - t * t) * t, value]);
        Self { terms: terms.collect() }
    }

    /// By barycentric interpolation.
    fn value(&self, s: f64) -> f64 {
        let (mut above, mut below) = (0.0, 0.0);
        for [t, weight, value] in &self.terms {
            let share = weight / (s * s - t * t);
            above += share * value;
            below += share;
        }
        above / below
    }
}

/// `(1/pi) int p k_vv(x - r) dr` over the whole contact, from the cuts of its half: the kink, `x` and the end.
fn potential(surface: &Surface, known: &Known, x: f64, b: f64) -> f64 {
    let kink = known.kink;
    let cuts = if kink < x { [0.0, kink, x, b] } else { [0.0, x, kink, b] };
    let pieces = cuts.windows(2).filter(|piece| piece[0] < piece[1]);
    // Nine digits of each piece, logarithms and square roots at its ends.
    let sources: Vec<[f64; 2]> = pieces
        .flat_map(|piece| {
            let at = |from_lower: f64| piece[0] + from_lower;
            let nodes = nodes_up_to(piece[1] - piece[0], 13, 3.0);
            nodes.into_iter().map(move |node| [at(node.from_lower), node.weight])
        })
        // Nodes that rounding puts on the point itself, or on the end, carry nothing.
        .filter(|[r, _]| *r > 0.0 && (r - x).abs() > 1e-14 && *r < b)
        .collect();
    let distances: Vec<f64> = sources.iter().flat_map(|[r, _]| [x - r, x + r]).collect();
    let kernel = surface.kernel(Component::NormalSlope, &distances);
    let value = |r: f64| known.value(r, r / b, ((b - r) * (b + r)).sqrt() / b);
    let terms = sources.iter().zip(kernel.chunks(2)).map(|([r, weight], k)| weight * value(*r) * (k[0] + k[1]));
    terms.sum::<f64>() / PI
}
