//! Tractions between the edge of the contact and the sample next to it.

/// The bounded points over `x/b`, with the curve between each edge that is sampled and the sample next to it.
///
/// Tractions end as the inverse square root of the distance to a sharp edge (an unbounded sample) and as the
/// square root at a smooth one (a sample of 0). So drawn, the curve leaves the frame instead of stopping short
/// of the edge, and meets a smooth edge without a corner. To an unbounded sample within, a corner of the punch, they go
/// like the logarithm of the distance. Nothing else is interpolated.
pub(super) fn to_the_edges(points: &[(f64, Option<f64>)]) -> Vec<(f64, f64)> {
    /// Shares of the distance between the edge and the sample next to it.
    const SHARES: [f64; 9] = [0.8, 0.6, 0.4, 0.25, 0.1, 0.03, 0.01, 0.001, 1e-4];
    let bounded = |points: &[(f64, Option<f64>)]| -> Vec<(f64, f64)> {
        points.iter().filter_map(|(x, y)| Some((*x, (*y)?))).collect()
    };
    let is_edge = |point: &&(f64, Option<f64>)| (point.0.abs() - 1.0).abs() < 1e-9;
    let first = points.first().filter(is_edge);
    let last = points.get(1..).and_then(<[_]>::last).filter(is_edge);
    let inner = &points[usize::from(first.is_some())..points.len() - usize::from(last.is_some())];
    // From the two samples beside the corner.
    let towards_corner = |corner: f64, near: Option<&(f64, Option<f64>)>, far: Option<&(f64, Option<f64>)>| {
        let (Some((x, Some(y))), Some((beyond, Some(lower)))) = (near, far) else { return Vec::new() };
        let rise = (y - lower) / ((beyond - corner) / (x - corner)).ln();
        if !(rise > 0.0 && rise.is_finite()) {
            return Vec::new();
        }
        SHARES.map(|share| (corner + (x - corner) * share, y - rise * share.ln())).into()
    };
    let mut curve = Vec::with_capacity(inner.len());
    for (i, (x, y)) in inner.iter().enumerate() {
        if let Some(y) = y {
            curve.push((*x, *y));
            continue;
        }
        let before = |n: usize| i.checked_sub(n).and_then(|i| inner.get(i));
        let left = towards_corner(*x, before(1), before(2));
        let right = towards_corner(*x, inner.get(i + 1), inner.get(i + 2));
        curve.extend(left.into_iter().chain(right.into_iter().rev()));
    }
    let (Some(left), Some(right)) = (curve.first().copied(), curve.last().copied()) else { return bounded(points) };
    let towards = |edge: &(f64, Option<f64>), (x, y): (f64, f64)| -> Vec<(f64, f64)> {
        let along = |power: fn(f64) -> f64| SHARES.map(|share| (edge.0 + (x - edge.0) * share, y * power(share)));
        match edge.1 {
            None => along(|share| share.sqrt().recip()).into(),
            Some(0.0) => along(f64::sqrt).into_iter().chain([(edge.0, 0.0)]).collect(),
            Some(value) => vec![(edge.0, value)],
        }
    };
    curve.splice(..0, first.into_iter().flat_map(|edge| towards(edge, left)).rev());
    curve.extend(last.into_iter().flat_map(|edge| towards(edge, right)));
    curve
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where samples begin in the middle nothing ends, and to a tip there they go like a logarithm.
    #[test]
    fn samples_of_one_half_begin_in_the_middle() {
        let half = [(0.0, Some(0.0)), (0.5, Some(0.1)), (1.0, Some(0.0))];
        let curve = to_the_edges(&half);
        assert_eq!(curve[..2], [(0.0, 0.0), (0.5, 0.1)]);
        assert!(curve.len() == 12 && curve.last() == Some(&(1.0, 0.0)), "{curve:?}");
        // 1 - ln x
        let tip = [(0.0, None), (0.25, Some(1.0 + 4_f64.ln())), (0.5, Some(1.0 + 2_f64.ln())), (0.75, Some(1.2))];
        let curve = to_the_edges(&tip);
        assert!(curve[..9].iter().all(|(x, y)| (y - 1.0 + x.ln()).abs() < 1e-12), "{curve:?}");
        assert_eq!(curve[9..].len(), 3, "nothing beyond the last sample");
        assert_eq!(to_the_edges(&[(1.0, None)]), []);
    }
}
