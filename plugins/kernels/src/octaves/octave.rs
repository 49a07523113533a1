//! The kernels as polynomials on octaves of distance.

use super::bands::Bands;
use crate::integrand::Integrand;
use crate::origin::Origin;
use crate::piece::{Kernel, NEAR_ORIGIN, Piece, Pieces, Sample, Variable, place};
use num_complex::Complex64;
use slipzone_api::{Component, KernelRequest, Parts};

/// Nodes of a piece: a function that is analytic but at the origin has Chebyshev coefficients there that fall like
/// `5.8^-k`; of a piece at the origin parity leaves half.
const NODES: (usize, usize) = (10, 18);
/// Where the first piece ends, over the inverse of the highest wave number.
const FIRST: f64 = 0.5;
/// Share of the accuracy that a piece may miss.
const SHARE: f64 = 5e-3;
/// Narrowest piece over its upper end.
const NARROWEST: f64 = 3e-2;
/// Noise of the transforms, in the terms of the request: over that of values which are rounded once, and whatever their
/// size.
const NOISE: (f64, f64) = (50.0, 1e-13);

/// The kernels on octaves of distance, each halved until it is resolved; and the sum of the errors, in the terms of the
/// request.
///
/// What is known next to the `origin` is in a first piece of its own, without a polynomial.
pub(super) fn tabulated(
    integrands: &[Integrand],
    bands: &Bands,
    origin: Option<&Origin>,
    request: &KernelRequest,
) -> (Pieces, f64) {
    let at_origin = Variable::chebyshev(NODES.0, &[NEAR_ORIGIN, 1.0]);
    let elsewhere = Variable::chebyshev(NODES.1, &[1.0]);
    let mut pieces = Pieces { ends: Vec::new(), kernels: vec![Kernel::default(); integrands.len()] };
    let mut transforms = vec![Complex64::default(); integrands.len()];
    let mut samples: Vec<Vec<Sample>> = vec![Vec::new(); integrands.len()];
    let (mut lower, mut sum) = (0.0, 0.0);
    if let Some(origin) = origin {
        lower = origin.end.min(request.reach);
        let nothing = || Piece { rows: Vec::new(), error: 0.0, noise: 0.0 };
        pieces.take(lower, integrands.iter().map(|_| nothing()).collect(), false);
    }
    while lower < request.reach {
        let upper = if lower == 0.0 { FIRST / bands.highest } else { 2.0 * lower }.min(request.reach);
        let faded = bands.faded(if lower == 0.0 { upper } else { lower });
        let mut stack = vec![(lower, upper)];
        while let Some((from, to)) = stack.pop() {
            let variable = if from == 0.0 { &at_origin } else { &elsewhere };
            samples.iter_mut().for_each(Vec::clear);
            for v in &variable.all {
                let t = place(*v, (from, to));
                faded.at(t, &mut transforms);
                for ((samples, transform), integrand) in samples.iter_mut().zip(&transforms).zip(integrands) {
                    let transform = if integrand.component.is_odd() { transform.im } else { transform.re };
                    let Parts { smooth, sign, log } = integrand.parts(t, transform);
                    samples.push((*v, t, [smooth, sign, log]));
                }
            }
            // An error counts over the distances at which it is made; of the depth it counts as it is.
            let felt = |integrand: &Integrand| if integrand.component == Component::Depth { 1.0 } else { to - from };
            let piece = |(samples, integrand): (&Vec<Sample>, &Integrand)| {
                let aim = SHARE * request.accuracy / felt(integrand);
                Piece::through(samples.split_at(variable.nodes), from == 0.0, integrand.component.is_odd(), aim)
            };
            let told: Vec<Piece> = samples.iter().zip(integrands).map(piece).collect();
            let errors = || told.iter().zip(integrands).map(|(piece, integrand)| (felt(integrand), piece));
            let missed = errors().any(|(felt, piece)| {
                felt * piece.error > (2.0 * SHARE * request.accuracy).max(NOISE.0 * felt * piece.noise + NOISE.1)
            });
            if missed && from > 0.0 && to - from > NARROWEST * to {
                let middle = f64::midpoint(from, to);
                stack.extend([(middle, to), (from, middle)]);
                continue;
            }
            sum += errors().map(|(felt, piece)| felt * piece.error).fold(0.0, f64::max);
            pieces.take(to, told, false);
        }
        lower = upper;
    }
    (pieces, sum)
}
