//! Panels of the angle, graded towards the contact's end, and polynomials on them.

use std::f64::consts::PI;

/// Lower end of the outermost panel over its upper one, `pi/2`.
///
/// With 1/2 instead of 1/4 here, ten digits of the pressure at any place take 45 to 110 unknowns instead of 50 to
/// 125, and nodes and panels that grow together are near the best pair at any accuracy.
const OUTERMOST: f64 = 0.5;

/// Lower end over upper end of the other panels, but for the first, which begins at 0.
///
/// A density with `gap log gap` takes `1/(log(1/ratio) log(rho))` unknowns per digit squared, where
/// `rho = (1 + sqrt(ratio))^2/(1 - ratio)` is the ellipse through the contact's end. That is within 3 % of its
/// minimum for ratios from 0.1 to 0.27; larger ones have shorter panels in the middle.
const RATIO: f64 = 0.25;

/// Panels over `0 <= theta <= pi/2`, the contact's end at 0 and its middle at `pi/2`; `x = c cos(theta)`.
///
/// They are panels of `u`, of which the angle is a power: `theta = u^root`. On each a polynomial of degree `degree`, by
/// its values at `degree + 1` Chebyshev-Lobatto points; the end points belong to both neighbours, so that what is
/// described is continuous.
#[derive(Clone, Debug)]
pub(super) struct Mesh {
    pub(super) degree: usize,
    pub(super) root: u32,
    /// Ends of the panels in `u`, ascending from the contact's end to its middle.
    pub(super) breaks: Vec<f64>,
    /// Lobatto points of `[0, 2]`: distance to the panel's lower end in half-lengths; their barycentric weights.
    offsets: Vec<f64>,
    weights: Vec<f64>,
}

/// A place on the mesh.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) panel: usize,
    /// Distance to the panel's lower end, in half-lengths, in `[0, 2]`.
    pub(super) offset: f64,
}

impl Mesh {
    /// Where the equal panels of a root are cut, half of them come of the first.
    pub(super) fn new(degree: usize, panels: usize, root: u32, is_cut: bool) -> Self {
        let middle = to_root(0.5 * PI, root);
        let breaks: Vec<f64> = if root == 1 {
            let graded = std::iter::successors(Some(middle * OUTERMOST), |end| Some(end * RATIO));
            let mut breaks: Vec<f64> = std::iter::once(middle).chain(graded).take(panels).collect();
            breaks.push(0.0);
            breaks.reverse();
            breaks
        } else {
            let cuts = if is_cut { panels / 2 } else { 0 };
            let equal = panels - cuts;
            let mut breaks: Vec<f64> = (0..=equal).map(|k| middle * k as f64 / equal as f64).collect();
            (0..cuts).for_each(|_| breaks.insert(1, RATIO * breaks[1]));
            breaks
        };
        // 1 - cos(a) = 2 sin^2(a/2) keeps the distance to the lower end.
        let offset = |i: usize| 2.0 * (0.5 * PI * i as f64 / degree as f64).sin().powi(2);
        let weight = |i: usize| {
            let size = if i == 0 || i == degree { 0.5 } else { 1.0 };
            if i.is_multiple_of(2) { size } else { -size }
        };
        let (offsets, weights) = (0..=degree).map(|i| (offset(i), weight(i))).unzip();
        Self { degree, root, breaks, offsets, weights }
    }

    pub(super) fn panels(&self) -> usize {
        self.breaks.len() - 1
    }

    /// Nodes in all, shared ones counted once.
    pub(super) fn nodes(&self) -> usize {
        self.degree * self.panels() + 1
    }

    pub(super) fn half_length(&self, panel: usize) -> f64 {
        0.5 * (self.breaks[panel + 1] - self.breaks[panel])
    }

    /// `u` at `offset` half-lengths from the lower end of `panel`.
    pub(super) fn at(&self, Place { panel, offset }: Place) -> f64 {
        self.breaks[panel] + self.half_length(panel) * offset
    }

    /// The angle there.
    pub(super) fn angle(&self, u: f64) -> f64 {
        u.powi(self.root.cast_signed())
    }

    /// How the angle rises with `u`.
    pub(super) fn slope(&self, u: f64) -> f64 {
        f64::from(self.root) * u.powi(self.root.cast_signed() - 1)
    }

    /// By how much it differs between two places over their distance in `u`.
    pub(super) fn rise(&self, u: f64, v: f64) -> f64 {
        let (mut sum, mut power) = (1.0, 1.0);
        for _ in 1..self.root {
            power *= v;
            sum = sum * u + power;
        }
        sum
    }

    /// What `slope/(theta - theta_p)` is beside its pole `1/(u - p)`: `sum (k + 1) u^k p^(root - 2 - k)` over
    /// [`Self::rise`].
    pub(super) fn rest_of_pole(&self, u: f64, p: f64) -> f64 {
        let (mut sum, mut power) = (0.0, 1.0);
        for k in (1..self.root).rev() {
            sum = sum * u + f64::from(k) * power;
            power *= p;
        }
        sum / self.rise(u, p)
    }

    /// `u` at an angle.
    pub(super) fn place_of(&self, angle: f64) -> f64 {
        to_root(angle, self.root)
    }

    /// `u` at the `i`-th node, counted from the contact's end.
    pub(super) fn node(&self, i: usize) -> f64 {
        if i == self.nodes() - 1 {
            return self.breaks[self.panels()];
        }
        self.at(Place { panel: i / self.degree, offset: self.offsets[i % self.degree] })
    }

    pub(super) fn locate(&self, u: f64) -> Place {
        let panel = self.breaks[1..self.panels()].partition_point(|end| *end < u);
        let offset = (u - self.breaks[panel]) / self.half_length(panel);
        Place { panel, offset: offset.min(2.0) }
    }

    /// What stands before the polynomial of a density that vanishes at the contact's end in proportion to the angle.
    pub(super) fn vanishing(&self, u: f64) -> f64 {
        u.powi(self.root.cast_signed() - 1)
    }

    /// `out[i]` = value at `offset` of the polynomial that is one at the panel's node `i` and zero at the others.
    ///
    /// Barycentric; near the lower end of the first panel the entries for the other nodes are exact in their
    /// ratio to the distance, as densities that vanish at the contact's end ask for.
    #[expect(clippy::float_cmp, reason = "only an exact hit divides by zero")]
    pub(super) fn basis_into(&self, offset: f64, out: &mut [f64]) {
        let mut is_hit = false;
        for ((out, node), weight) in out.iter_mut().zip(&self.offsets).zip(&self.weights) {
            is_hit |= *node == offset;
            *out = weight / (offset - node);
        }
        if is_hit {
            out.iter_mut().zip(&self.offsets).for_each(|(out, node)| *out = f64::from(u8::from(*node == offset)));
            return;
        }
        let sum: f64 = out.iter().sum();
        for out in out {
            *out /= sum;
        }
    }

    /// Value at `place` of what has the value `at_node(i)` at each node.
    pub(super) fn interpolate(&self, at_node: impl Fn(usize) -> f64, place: Place, basis: &mut Vec<f64>) -> f64 {
        basis.resize(self.degree + 1, 0.0);
        self.basis_into(place.offset, basis);
        let first = place.panel * self.degree;
        basis.iter().enumerate().map(|(i, value)| value * at_node(first + i)).sum()
    }
}

/// A root of a number.
fn to_root(x: f64, root: u32) -> f64 {
    if root == 1 { x } else { x.powf(f64::from(root).recip()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_come_back_and_small_values_keep_their_digits() {
        let mesh = Mesh::new(7, 12, 1, true);
        let mut basis = Vec::new();
        let polynomial = |angle: f64| angle * (1.0 - 0.3 * angle.powi(6));
        for angle in [1e-12, 3e-8, 1e-4, 0.2, 0.4, 1.5, 0.5 * PI] {
            let got = mesh.interpolate(|i| polynomial(mesh.node(i)), mesh.locate(angle), &mut basis);
            assert!((got / polynomial(angle) - 1.0).abs() < 1e-13, "at {angle:e}: {got:e}");
        }
    }
}
