//! Depths that cut a law beside its narrow places.

/// Places wider than this, over the thickness, are seen anyway; in narrower ones than the second nothing is to be seen.
const NARROW: f64 = 0.02;
const NARROWEST: f64 = 1e-12;
/// Most places.
const MOST: usize = 1000;
/// Lengths from one cut to the next grow by this factor, up to the last, over the thickness.
const GROWTH: f64 = 4.0;
const LAST: f64 = 0.1;

/// Cuts beside narrow places of which width and depth are given over the thickness, ever farther from each; ascending,
/// inside the layer.
pub(crate) fn beside(places: impl Iterator<Item = (f64, f64)>) -> Vec<f64> {
    let mut cuts = Vec::new();
    for (depth, width) in places.filter(|(_, width)| *width < NARROW && *width > NARROWEST).take(MOST) {
        cuts.push(depth);
        let lengths =
            std::iter::successors(Some(width), |length| Some(length * GROWTH)).take_while(|length| *length < LAST);
        cuts.extend(lengths.flat_map(|length| [depth - length, depth + length]));
    }
    cuts.retain(|depth| *depth > 0.0 && *depth < 1.0);
    cuts.sort_by(f64::total_cmp);
    // Two that all but meet are one.
    cuts.dedup_by(|next, before| *next <= *before + f64::EPSILON);
    cuts
}
