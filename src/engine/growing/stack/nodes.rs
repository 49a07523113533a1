//! Nodes of integrals over the half-width.

use super::{LONGEST_PIECE, Stack};
use crate::engine::numerics::ways::Ways;
use crate::engine::problem::Problem;
use slipzone_api::elementary::sinh;

/// The longest way in `t` of `b' = x cosh(t)` that one grid integrates over.
const LONGEST: f64 = 6.0;
/// Shapes whose slope begins with a lower power of `x` than this press so much on the last bit of their tip that the
/// middle of the contact feels more of it than a grid in `b'` sees: that bit is told in closed form.
const POINTED: f64 = 0.5;
/// A lower power than this is rounding.
const BLUNT: f64 = 1e-9;
/// Parts of the first piece between which that power is measured; it is taken to hold from the second inwards,
const TIP: [f64; 2] = [1e-24, 1e-20];
/// and where a law begins with a power of the depth, from where what that leaves is below this, but at the least from
/// there.
const FELT: f64 = 1e-16;
const LEAST_TIP: f64 = 1e-200;

/// A node of an integral over the half-width.
pub(super) struct Beyond {
    pub(super) member: f64,
    /// Beyond the point looked at, and beyond the lower end.
    pub(super) gap: f64,
    pub(super) from_lower: f64,
    pub(super) weight: f64,
}

impl Stack {
    /// Nodes of an integral over a part of a piece that begins `from` there or before, seen from `x`.
    pub(super) fn nodes_of_piece(
        &self,
        problem: &Problem,
        ways: &Ways,
        (x, from): (f64, f64),
        (lower, upper): (f64, f64),
        mut each: impl FnMut(Beyond),
    ) {
        if x > 0.0 {
            return nodes_beyond(ways, (x, from), (lower, upper), each);
        }
        let mut start = lower;
        if lower == 0.0 {
            let Some(power) = pointed(problem, upper) else {
                for node in self.grid_of_middle.iter() {
                    let member = upper * node.from_lower;
                    each(Beyond { member, gap: member, from_lower: member, weight: upper * node.weight });
                }
                return;
            };
            // `dP/b'` of all that is nearer to the tip, in one place.
            start = self.tip * upper;
            each(Beyond { member: start, gap: start, from_lower: start, weight: start / power });
        }
        // In proportion.
        ways.along(((upper - start) / start).ln_1p(), LONGEST_PIECE, |passed, weight| {
            let from_start = start * passed.exp_m1();
            let member = start + from_start;
            each(Beyond { member, gap: member, from_lower: start - lower + from_start, weight: weight * member });
        });
    }
}

/// Nodes between two half-widths beyond `x > 0`, of a piece that begins `from` there or before.
///
/// What is stacked has its singularity, of the order `(b' - x)^(-1/2)`, at `x` or just before, and varies with `x/b'`;
/// beyond a kink the force grows like `(b' - from)^(-1/2)` besides. The way begins at one of the two or at both: by `t`
/// with `b' = x cosh(t)` where there is no kink, and with `b' - lower = d sinh(t)^2`, `d` the distance of the other,
/// where there is one.
pub(super) fn nodes_beyond(
    ways: &Ways,
    (x, from): (f64, f64),
    (lower, upper): (f64, f64),
    mut each: impl FnMut(Beyond),
) {
    let apart = if lower > from { lower - from } else { lower - x };
    if from > 0.0 && apart > 0.0 {
        let end = ((upper - lower) / apart).sqrt().asinh();
        ways.along(end, LONGEST, |t, weight| {
            let root = sinh(t);
            let from_lower = apart * root * root;
            let (member, gap) = (lower + from_lower, (lower - x) + from_lower);
            each(Beyond { member, gap, from_lower, weight: weight * apart * twice(root) });
        });
        return;
    }
    let parameter = |member: f64| 2.0 * ((member - x).max(0.0) / (2.0 * x)).sqrt().asinh();
    let (start, end) = (parameter(lower), parameter(upper));
    ways.along(end - start, LONGEST, |passed, weight| {
        let root = sinh(0.5 * (start + passed));
        let gap = 2.0 * x * root * root;
        let from_lower = if start == 0.0 { gap } else { 2.0 * x * sinh(start + 0.5 * passed) * sinh(0.5 * passed) };
        each(Beyond { member: lower + from_lower, gap, from_lower, weight: weight * x * twice(root) });
    });
}

/// `sinh(2 t)` of `sinh(t)`.
fn twice(root: f64) -> f64 {
    2.0 * root * (1.0 + root * root).sqrt()
}

/// The part of the first piece within which the slope's power is taken to hold, and no power with which the law begins
/// is felt.
pub(super) fn tip(problem: &Problem) -> f64 {
    let of_law = problem.layer.law.broken_power().map(|power| FELT.powf(power.recip()).max(LEAST_TIP));
    of_law.into_iter().fold(TIP[1], f64::min)
}

/// The power of `x` that the slope of a shape begins with, where it is so low that a grid in `b'` is too coarse for the
/// tip. A corner has none.
fn pointed(problem: &Problem, upper: f64) -> Option<f64> {
    let [inner, outer] = TIP.map(|part| problem.slope(part * upper));
    let power = (outer / inner).ln() / (TIP[1] / TIP[0]).ln();
    (BLUNT..POINTED).contains(&power).then_some(power)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a tip presses on the middle, where the flat punches feel a broken power of the depth: so long as the tip
    /// told in one place is the same part of every contact, whatever the power, all contacts are off alike, and none
    /// shows it.
    #[test]
    #[cfg(feature = "formula")]
    fn a_tip_is_told_from_where_the_law_is_no_longer_felt() {
        for (slope, power) in [(0.02, 0.3), (0.1, 0.2), (0.02, 2.5)] {
            let text = format!(
                "format = 1\nlayer = {{ thickness = 1.0, poisson = 0.3, \
                 grading = {{ type = \"formula\", modulus = \"1 + y^{power:?}\" }} }}\n\
                 punch = {{ type = \"power\", coefficient = 1.0, exponent = {:?} }}\nload = {{ half_width = 1.0 }}\n",
                1.0 + slope
            );
            let scene = crate::scene::parse("tip", &text).expect("a scene");
            let problem = Problem::new(&scene).expect("a punch");
            let stack = Stack::empty(&problem, 1.0, 1e-12, 24);
            let mut sum = 0.0;
            stack.nodes_of_piece(&problem, &stack.ways, (0.0, 0.0), (0.0, 1.0), |at| {
                sum += at.weight * at.member.powf(slope - 1.0) * (1.0 + at.member.powf(power));
            });
            let exact = slope.recip() + (slope + power).recip();
            assert!((sum / exact - 1.0).abs() < 1e-12, "{slope} on {power}: {:e} off", sum / exact - 1.0);
        }
    }
}
