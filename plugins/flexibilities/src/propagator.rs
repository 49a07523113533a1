//! What becomes of states that rise through a slice, for all wave numbers at once.

use crate::integration::{Field, Integration, Lanes, NODES};
use pulp::{Arch, Simd, WithSimd};

/// Largest wave number of a slice, in units of its thickness.
pub(crate) const THICK: f64 = 2.0;

/// Most powers of the square of the wave number.
const MOST: usize = 24;

/// A term below this part of the largest of its entry is left out.
const NEGLIGIBLE: f64 = f64::EPSILON / 32.0;

/// The states at the top of a slice for each unit state at its bottom, in powers of `q = s^2`.
///
/// A state is `(u, w, sigma, tau) = (u, v/s, sigma_xy, sigma_yy/s)`. Of the wave number its equations hold `q` alone, and no
/// entry is small because `s` is: in the distance from the bottom, over the thickness,
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
}

/// Two rows of coefficients.
type Entries = [Lanes; 2];

/// Two rows of a propagator at some wave numbers.
pub(crate) type Rows<const L: usize> = [[[f64; L]; 4]; 2];

impl Propagator {
    /// Of a slice whose constants (softness, stiffness, contraction, cross) are given from 0 at its bottom to 1 at its top.
    pub(crate) fn new(constants: impl Fn(f64) -> [f64; 4]) -> Self {
        Arch::new().dispatch(Build(&Integration::get().nodes.map(constants)))
    }

    #[inline(always)]
    fn build(constants: &Field) -> Self {
        let rule = Integration::get();
        let unit = |component: usize| std::array::from_fn(|state| if state == component { 1.0 } else { 0.0 });
        let (mut displacements, mut tractions, mut sizes) = (Vec::new(), Vec::new(), Vec::new());
        let mut fields: [Field; 4] = [[[0.0; 4]; NODES]; 4];
        let (mut largest, mut power) = ([[0.0_f64; 4]; 4], 1.0);
        for m in 0..MOST {
            let start = |component: usize| if m == 0 { unit(component) } else { [0.0; 4] };
            let [u, w, sigma, tau] = &mut fields;
            let rate = field(|j, i| -(constants[j][1] * u[j][i] + constants[j][2] * tau[j][i]));
            let sigma_top = integrate(rule, start(2), &rate, sigma);
            let tau_top = integrate(rule, start(3), &field(|j, i| sigma[j][i]), tau);
            let rate = field(|j, i| -(w[j][i] + constants[j][0] * sigma[j][i]));
            let u_top = integrate(rule, start(0), &rate, u);
            let rate = field(|j, i| constants[j][2] * u[j][i] - constants[j][3] * tau[j][i]);
            let w_top = integrate(rule, start(1), &rate, w);
            let mut relative = 0.0_f64;
            for (largest, top) in largest.iter_mut().flatten().zip([u_top, w_top, sigma_top, tau_top].iter().flatten()) {
                let size = top.abs() * power;
                *largest = largest.max(size);
                relative = relative.max(if size == 0.0 { 0.0 } else { size / *largest });
            }
            power *= THICK * THICK;
            displacements.push([u_top, w_top]);
            tractions.push([sigma_top, tau_top]);
            sizes.push(relative);
            if relative <= NEGLIGIBLE {
                break;
            }
        }
        Self { displacements, tractions, sizes }
    }

    /// Rows `u`, `w` and rows `sigma`, `tau` at squares of wave numbers, of which `most` is the largest.
    #[inline(always)]
    pub(crate) fn at<const L: usize>(&self, q: &[f64; L], most: f64) -> [Rows<L>; 2] {
        let terms = self.terms(most);
        [sum(&self.displacements[..terms], q), sum(&self.tractions[..terms], q)]
    }

    /// Powers that matter up to a square of the wave number: entries begin with the second power at the latest.
    #[inline(always)]
    fn terms(&self, most: f64) -> usize {
        let fraction = most / (THICK * THICK);
        let (mut terms, mut faded) = (self.sizes.len().min(FIRST), 1.0);
        while terms < self.sizes.len() && self.sizes[terms] * faded > NEGLIGIBLE {
            terms += 1;
            faded *= fraction;
        }
        terms
    }
}

/// Powers that each entry has at least: none begins later.
const FIRST: usize = 3;

#[inline(always)]
fn field(value: impl Fn(usize, usize) -> f64) -> Field {
    let mut field = [[0.0; 4]; NODES];
    for (j, lanes) in field.iter_mut().enumerate() {
        for (i, lane) in lanes.iter_mut().enumerate() {
            *lane = value(j, i);
        }
    }
    field
}

/// Integrates from `start` at the bottom; returns what that leads to at the top.
#[inline(always)]
fn integrate(rule: &Integration, start: Lanes, rate: &Field, out: &mut Field) -> Lanes {
    let (integrals, whole) = rule.integrals(rate);
    *out = field(|j, i| start[i] + integrals[j][i]);
    std::array::from_fn(|i| start[i] + whole[i])
}

/// Horner's scheme for eight entries at a time: as many as registers hold.
#[inline(always)]
fn sum<const L: usize>(orders: &[Entries], q: &[f64; L]) -> Rows<L> {
    let mut sums = [[[0.0; L]; 4]; 2];
    for order in orders.iter().rev() {
        for (sums, coefficients) in sums.iter_mut().zip(order) {
            for (sum, c) in sums.iter_mut().zip(coefficients) {
                for i in 0..L {
                    sum[i] = sum[i] * q[i] + c;
                }
            }
        }
    }
    sums
}

/// [`Propagator::build`] in the vectors that the machine has.
struct Build<'a>(&'a Field);

impl WithSimd for Build<'_> {
    type Output = Propagator;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> Propagator {
        Propagator::build(self.0)
    }
}
