//! What becomes of states that rise through a slice, for all wave numbers at once.

use crate::integration::{HALF, Integration, Nodes, Pair, fused, pair};
use crate::precision::Precision;
use pulp::{Arch, Simd, WithSimd};

/// Most powers of the square of the wave number.
const MOST: usize = 32;

/// The states at the top of a slice for each unit state at its bottom, in powers of `q = s^2`.
///
/// A state is `(u, w, sigma, tau) = (u, v/s, sigma_xy, sigma_yy/s)`. Of the wave number its equations hold `q` alone,
/// and no entry is small because `s` is: in the distance from the bottom, over the thickness,
///
/// ```text
/// u' = -q w - sigma/mu                     sigma' = -q (8 mu/(1 + kappa) u + lambda tau)
/// w' = lambda u - (beta/mu) tau            tau' = sigma
/// ```
///
/// Power by power of `q`, each component is an integral of what is known.
#[derive(Clone, Debug)]
pub(crate) struct Propagator {
    /// By the power of `q`: rows `u`, `w`, columns the states at the bottom.
    displacements: Vec<Entries>,
    /// The same of `sigma`, `tau`.
    tractions: Vec<Entries>,
    /// Bounds on the terms of each power where the wave number is largest, relative to what they are added to.
    sizes: Vec<f64>,
    /// By how much the largest term of an entry exceeds its first ones there, at the most.
    growth: f64,
    /// The largest `q`.
    largest: f64,
    /// A term below this part of the largest of its entry is left out.
    negligible: f64,
}

/// Two rows of coefficients.
type Entries = Pair;

/// Two rows of a propagator at some wave numbers.
pub(crate) type Rows<const L: usize> = [[[f64; L]; 4]; 2];

impl Propagator {
    /// Of a slice whose constants (softness, stiffness, contraction, cross) are given from 0 at its bottom to 1 at its
    /// top, for wave numbers up to `thickest` over its thickness.
    pub(crate) fn new(precision: &Precision, thickest: f64, constants: impl Fn(f64) -> [f64; 4]) -> Self {
        if precision.half == HALF {
            Build::by(Integration::full(), (thickest, precision.negligible), constants)
        } else {
            Build::by(Integration::rough(), (thickest, precision.negligible), constants)
        }
    }

    #[inline(always)]
    fn build<S: Simd, const H: usize>(build: &Build<'_, H>) -> Self {
        let Build { rule, constants, thickest, negligible } = build;
        let (mut displacements, mut tractions, mut sizes) =
            (Vec::with_capacity(MOST), Vec::with_capacity(MOST), Vec::with_capacity(MOST));
        // `sigma` and, of the power before, `w`; in turn `tau` and `u`.
        let mut field = [[[unit(2), [0.0; 4]]; H]; 2];
        let mut sigma = unit(2);
        let (mut largest, mut first, mut power) = ([Pair::default(); 2], [Pair::default(); 2], 1.0);
        for power_of_q in 0..MOST {
            let start = &STARTS[power_of_q.min(1)];
            for ([sigma, w], [softness, ..]) in field.iter_mut().flatten().zip(constants.iter().flatten()) {
                *w = std::array::from_fn(|i| -fused::<S>(*softness, sigma[i], w[i]));
            }
            let [tau, u] = rule.integrate::<S>(&start[0], &mut field);
            for ([tau, u], [_, stiffness, contraction, cross]) in
                field.iter_mut().flatten().zip(constants.iter().flatten())
            {
                let (t, d) = (*tau, *u);
                *tau = std::array::from_fn(|i| -fused::<S>(*stiffness, d[i], contraction * t[i]));
                *u = std::array::from_fn(|i| fused::<S>(*contraction, d[i], -cross * t[i]));
            }
            let [next_sigma, w] = rule.integrate::<S>(&start[1], &mut field);
            let mut relative = 0.0_f64;
            for (largest, top) in largest.iter_mut().zip([[u, w], [sigma, tau]]) {
                let size = pair(|c, i| top[c][i].abs() * power);
                *largest = pair(|c, i| largest[c][i].max(size[c][i]));
                let entries = size.iter().flatten().zip(largest.iter().flatten());
                relative =
                    entries.fold(relative, |most, (size, largest)| most.max(size / largest.max(f64::MIN_POSITIVE)));
            }
            power *= thickest * thickest;
            displacements.push([u, w]);
            tractions.push([sigma, tau]);
            sizes.push(relative);
            if power_of_q < FIRST {
                first = largest;
            }
            if relative <= *negligible {
                break;
            }
            sigma = next_sigma;
        }
        let entries = largest.iter().flatten().flatten().zip(first.iter().flatten().flatten());
        let growth = entries.fold(1.0, |most: f64, (largest, first)| most.max(largest / first.max(f64::MIN_POSITIVE)));
        Self { displacements, tractions, sizes, growth, largest: thickest * thickest, negligible: *negligible }
    }

    /// Rows `u`, `w` and rows `sigma`, `tau` at squares of wave numbers, of which `most` is the largest.
    #[inline(always)]
    pub(crate) fn at<S: Simd, const L: usize>(&self, q: &[f64; L], most: f64) -> [Rows<L>; 2] {
        let terms = self.terms(most);
        [sum::<S, L>(&self.displacements[..terms], q), sum::<S, L>(&self.tractions[..terms], q)]
    }

    /// Powers that matter up to a square of the wave number: entries begin with the second power at the latest.
    #[inline(always)]
    fn terms(&self, most: f64) -> usize {
        let fraction = most / self.largest;
        let (mut terms, mut faded) = (self.sizes.len().min(FIRST), self.growth);
        while terms < self.sizes.len() && self.sizes[terms] * faded > self.negligible {
            terms += 1;
            faded *= fraction;
        }
        terms
    }
}

/// What each integral begins with: `tau` and `u`, then the `sigma` of the next power and `w`; of the first power a unit
/// of each state, of the others nothing.
static STARTS: [[Pair; 2]; 2] = [[[unit(3), unit(0)], [[0.0; 4], unit(1)]], [[[0.0; 4]; 2]; 2]];

/// A unit of one component of the four states.
const fn unit(component: usize) -> [f64; 4] {
    let mut unit = [0.0; 4];
    unit[component] = 1.0;
    unit
}

/// Powers that each entry has at least: none begins later.
const FIRST: usize = 3;

/// Horner's scheme for eight entries at a time: as many as registers hold.
#[inline(always)]
fn sum<S: Simd, const L: usize>(orders: &[Entries], q: &[f64; L]) -> Rows<L> {
    let mut sums = [[[0.0; L]; 4]; 2];
    for order in orders.iter().rev() {
        for (sums, coefficients) in sums.iter_mut().zip(order) {
            for (sum, c) in sums.iter_mut().zip(coefficients) {
                for i in 0..L {
                    sum[i] = fused::<S>(sum[i], q[i], *c);
                }
            }
        }
    }
    sums
}

/// [`Propagator::build`] in the vectors that the machine has.
struct Build<'a, const H: usize> {
    rule: &'a Integration<H>,
    constants: Nodes<[f64; 4], H>,
    thickest: f64,
    negligible: f64,
}

impl<const H: usize> Build<'_, H> {
    fn by(
        rule: &Integration<H>,
        (thickest, negligible): (f64, f64),
        constants: impl Fn(f64) -> [f64; 4],
    ) -> Propagator {
        let constants = rule.nodes.map(|half| half.map(&constants));
        Arch::new().dispatch(Build { rule, constants, thickest, negligible })
    }
}

impl<const H: usize> WithSimd for Build<'_, H> {
    type Output = Propagator;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> Propagator {
        Propagator::build::<S, H>(&self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::precision::ROUGH;
    use pulp::Scalar;

    /// Of a thick slice the terms of the largest wave number rise before they fall: what is left out at a smaller one
    /// is to be little beside what they add up to there.
    #[test]
    fn powers_left_out_at_a_wave_number_are_little_beside_its_sum() {
        let thickest = 10.0;
        let slice = Propagator::new(&ROUGH, thickest, |z| [1.0 + z, 5.0 - z, 0.6, 0.3]);
        for s in 1..=100_u8 {
            let q = (0.1 * f64::from(s)).powi(2);
            let [some, all] = [q, thickest * thickest].map(|most| slice.at::<Scalar, 1>(&[q], most));
            for (some, all) in some.as_flattened().as_flattened().iter().zip(all.as_flattened().as_flattened()) {
                let error = (some[0] / all[0] - 1.0).abs();
                assert!(error < 4.0 * ROUGH.negligible, "q = {q}: {error:e}");
            }
        }
    }
}
