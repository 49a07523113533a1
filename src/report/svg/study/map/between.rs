//! What a map shows between the values: colours and lines of equal value are those of one surface through them.

use crate::report::svg::canvas::filled;
use kuva::render::render::Scene;

/// Numbers at places on the canvas, close enough for straight lines between them.
pub(super) struct Between {
    pub(super) columns: Vec<f64>,
    pub(super) rows: Vec<f64>,
    /// Row by row; none beside a value that is missing.
    pub(super) values: Vec<Option<f64>>,
    /// Whether there are places between the middles of cells.
    is_finer: bool,
}

impl Between {
    /// From the values at the middles of cells: linear along columns and rows, and beyond the outer middles, to the
    /// ends of the frame, as on them.
    pub(super) fn new([columns, rows]: [&[f64]; 2], [across, up]: [(f64, f64); 2], values: &[Option<f64>]) -> Self {
        let (x, y) = (finer(columns, across), finer(rows, up));
        let linear = |from: Option<f64>, to: Option<f64>, share: f64| {
            if share > 0.0 { Some(from? + share * (to? - from?)) } else { from }
        };
        let along = |row: usize, (column, share, _): (usize, f64, f64)| {
            let at = |column: usize| values[row * columns.len() + column.min(columns.len() - 1)];
            linear(at(column), at(column + 1), share)
        };
        let at = |(row, share, _): (usize, f64, f64), x| {
            linear(along(row, x), along((row + 1).min(rows.len() - 1), x), share)
        };
        Self {
            values: y.iter().flat_map(|y| x.iter().map(|x| at(*y, *x))).collect(),
            is_finer: x.len() > columns.len() + 2 || y.len() > rows.len() + 2,
            columns: x.into_iter().map(|(_, _, place)| place).collect(),
            rows: y.into_iter().map(|(_, _, place)| place).collect(),
        }
    }

    /// Colours over those of cells, where cells are so large that they differ.
    pub(super) fn draw(&self, scene: &mut Scene, color: impl Fn(f64) -> String) {
        if !self.is_finer {
            return;
        }
        for (row, up) in self.rows.windows(2).enumerate() {
            for (column, across) in self.columns.windows(2).enumerate() {
                let corner = |r, c| self.values[(row + r) * self.columns.len() + column + c];
                let [Some(a), Some(b), Some(c), Some(d)] = [corner(0, 0), corner(0, 1), corner(1, 0), corner(1, 1)]
                else {
                    continue;
                };
                // A hair of overlap: viewers leave light seams between neighbours.
                let seam = |is_inner: bool| if is_inner { 0.4 } else { 0.0 };
                let width = across[1] - across[0] + seam(column + 2 < self.columns.len());
                let height = up[0] - up[1] + seam(row > 0);
                scene.add(filled((across[0], up[1]), (width, height), &color((a + b + c + d) / 4.0), None));
            }
        }
    }
}

/// Places from end to end, those of the values among them: the value before each, and how far it is to the next.
fn finer(places: &[f64], (first, last): (f64, f64)) -> Vec<(usize, f64, f64)> {
    /// Distance of neighbours, px, where the values are farther apart than a line that is off by half of it shows.
    const APART: f64 = 8.0;
    const FINE: f64 = 16.0;
    let mut all = vec![(0, 0.0, first)];
    for (index, pair) in places.windows(2).enumerate() {
        let distance = (pair[1] - pair[0]).abs();
        let parts = if distance > FINE { (distance / APART).ceil() } else { 1.0 };
        let share = |part: u32| f64::from(part) / parts;
        let within = (0..u32::MAX).map(share).take_while(|share| *share < 1.0);
        all.extend(within.map(|share| (index, share, pair[0] + share * (pair[1] - pair[0]))));
    }
    let end = places.len() - 1;
    all.extend([(end, 0.0, places[end]), (end, 0.0, last)]);
    all
}
