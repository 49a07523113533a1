//! Single rows that are off the convex curve through all others: a lost decimal point, a spike of the instrument.
//!
//! Least squares bends to a row in proportion to how far it is off, and what it leaves over everywhere hides that row
//! among the scatter it makes. So the worst rows are left out one after the other; those that turn out to be off by
//! much more than the rest scatter, and stand where nothing convex does, are no part of the shape.

use super::fit::Fit;
use super::scatter::{CERTAIN, above_hull};

/// Part of the squares left over that the worst row holds where it is worth a look.
const WORTH: f64 = 1.0 / 16.0;

/// One row of so many may be a stray, and no more of them than that.
const ONE_OF: usize = 10;
const MOST: usize = 16;

/// How much more certain one must be of a curve with few rows to spare: with one to spare, so many times more.
const SPARSE: f64 = 5.0;

/// Places among the rows of those that are off, and the fit of all others; `whole` is that of all.
pub(super) fn strays(rows: &[[f64; 2]], whole: Fit, units: [f64; 2]) -> (Vec<usize>, Fit) {
    let most = (rows.len() / ONE_OF).clamp(1, MOST);
    let mut certain = (Vec::new(), whole);
    // Those left out so far, and the fit of the rest where it does not make all of them certain.
    let (mut out, mut tried): (Vec<usize>, Option<Fit>) = (Vec::new(), None);
    while out.len() < most {
        let Some(worst) = worst(rows, &out, tried.as_ref().unwrap_or(&certain.1)) else { break };
        out.push(worst);
        let kept: Vec<_> = (0..rows.len()).filter(|i| !out.contains(i)).map(|i| rows[i]).collect();
        let Ok(next) = Fit::new(&kept, units) else { break };
        if next.rises() && out.iter().all(|stray| is_off(rows[*stray], &kept, &next)) {
            (certain, tried) = ((out.clone(), next), None);
        } else {
            tried = Some(next);
        }
    }
    certain
}

/// The row furthest off, if it holds much of what is left over.
fn worst(rows: &[[f64; 2]], out: &[usize], fit: &Fit) -> Option<usize> {
    let kept = (0..rows.len()).filter(|i| !out.contains(i));
    let (worst, off) = kept.map(|i| (i, fit.off(rows[i]).abs())).max_by(|one, other| one.1.total_cmp(&other.1))?;
    (off > fit.rounding() && off * off > WORTH * fit.left_over()).then_some(worst)
}

/// Whether a row is off the fit of those kept by much more than they are, and no convex curve comes as near to it.
fn is_off(stray: [f64; 2], kept: &[[f64; 2]], fit: &Fit) -> bool {
    let Some(spare) = fit.spare() else { return false };
    let noise = (fit.left_over() / spare).sqrt() + fit.rounding();
    let allowed = CERTAIN * (1.0 + SPARSE / spare) * noise + fit.decimal();
    // The hull of many rows runs through those furthest below the curve.
    let below = (2.0 * (kept.len() as f64).ln()).sqrt() * noise;
    let is_beyond = || {
        let mut all: Vec<(f64, f64)> = kept.iter().chain([&stray]).map(|[x, height]| (x.abs(), *height)).collect();
        all.sort_by(|one, other| one.0.total_cmp(&other.0));
        above_hull(&all).any(|(_, above)| above > allowed + below)
    };
    fit.off(stray).abs() > allowed && is_beyond()
}
