//! Sine and cosine integrals at distances in steps, which weigh a sinc series beside a sign and a logarithm.

use spec_math::cephes64::sici;
use std::f64::consts::{FRAC_2_PI, PI};
use std::sync::{Mutex, PoisonError};

/// `(2/pi) Si(pi d)` and `Ci(pi d)` at distances so far apart by 1: the same for all grids.
type Integrals = Mutex<Vec<(f64, f64)>>;

/// The first `count` at `d = 1/2, 3/2, ...`.
pub(super) fn at_halves(count: usize) -> (Vec<f64>, Vec<f64>) {
    static KNOWN: Integrals = Mutex::new(Vec::new());
    integrals(&KNOWN, 0.5, count)
}

/// The first `count` at `d = 1, 2, ...`.
pub(super) fn at_wholes(count: usize) -> (Vec<f64>, Vec<f64>) {
    static KNOWN: Integrals = Mutex::new(Vec::new());
    integrals(&KNOWN, 1.0, count)
}

/// The first `count` of those known, which begin at `d = first`; as many are made known.
fn integrals(known: &Integrals, first: f64, count: usize) -> (Vec<f64>, Vec<f64>) {
    let mut known = known.lock().unwrap_or_else(PoisonError::into_inner);
    let next = |m: usize| {
        let (si, ci) = sici(PI * (m as f64 + first));
        (FRAC_2_PI * si, ci)
    };
    let missing = known.len()..count;
    known.extend(missing.map(next));
    known[..count].iter().copied().unzip()
}
