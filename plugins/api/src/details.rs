//! Places that cut a function beside where it varies over a short length.

/// In narrower places than this, over the whole length, nothing is to be seen.
const NARROWEST: f64 = 1e-12;
/// Most places.
const MOST: usize = 1000;
/// Lengths from one cut to the next grow by this factor.
const GROWTH: f64 = 4.0;

/// Cuts of `(0, 1)` beside places of which width and position are given, ever farther from each up to `last`;
/// ascending. Places wider than `narrow` are seen anyway.
pub fn beside(places: impl Iterator<Item = (f64, f64)>, narrow: f64, last: f64) -> Vec<f64> {
    let mut cuts = Vec::new();
    for (place, width) in places.filter(|(_, width)| *width < narrow && *width > NARROWEST).take(MOST) {
        cuts.push(place);
        let lengths =
            std::iter::successors(Some(width), |length| Some(length * GROWTH)).take_while(|length| *length < last);
        cuts.extend(lengths.flat_map(|length| [place - length, place + length]));
    }
    cuts.retain(|place| *place > 0.0 && *place < 1.0);
    cuts.sort_by(f64::total_cmp);
    // Two that all but meet are one.
    cuts.dedup_by(|next, before| *next <= *before + f64::EPSILON);
    cuts
}

/// Places between cuts, and these: where one begins a grid may agree with what varies there by chance, and that is not
/// at its largest.
pub fn looked_at(cuts: &[f64]) -> impl Iterator<Item = f64> {
    const PARTS: [f64; 4] = [0.25, 0.5, 0.75, 1.0];
    let begins = std::iter::once(&0.0).chain(cuts);
    begins.zip(cuts).flat_map(|(from, to)| PARTS.map(|part| from + part * (to - from)))
}
