//! The order of the scenes of a study, and which of them are solved on one layer.
//!
//! Scenes are numbered like the digits of a number, the axis that is listed last changing fastest; but axes that change
//! the layer, or the methods that its tables depend on, change slowest of all, so that scenes that share tables follow
//! each other.

use super::Study;
use super::axis::Axis;
use std::ops::Range;

/// Most scenes that are solved one after another on one layer's tables: tables for so many cost little.
const LONGEST: u64 = 64;
/// Parts that a study is cut into at least, for many cores.
const PARTS: u64 = 16;

impl Axis {
    /// Whether scenes along it have tables of their own.
    fn is_of_layer(&self) -> bool {
        let decides = |keys: &[String]| match keys.first().map(String::as_str) {
            Some("layer") => true,
            Some("solver") => keys.get(1).is_none_or(|key| key != "tolerance" && key != "quadrature"),
            _ => false,
        };
        self.columns.iter().any(|column| decides(&column.path))
    }

    /// Whether scenes along it differ in nothing but the load or the friction coefficient.
    fn is_of_load(&self) -> bool {
        let loads = ["load.force", "load.half_width", "load.indentation", "friction.coefficient"];
        self.columns.iter().all(|column| loads.contains(&column.field.as_str()))
    }
}

impl Study {
    /// The axes from the slowest to the fastest, by their places in the list.
    fn nested(&self) -> impl DoubleEndedIterator<Item = usize> {
        let of_layer = |wanted: bool| (0..self.axes.len()).filter(move |a| self.axes[*a].is_of_layer() == wanted);
        of_layer(true).chain(of_layer(false))
    }

    /// The step of each axis in one scene, in the order of the list.
    pub(crate) fn steps(&self, row: u64) -> Vec<u64> {
        let mut steps = vec![0; self.axes.len()];
        let mut rest = row;
        for a in self.nested().rev() {
            steps[a] = rest % self.axes[a].count;
            rest /= self.axes[a].count;
        }
        steps
    }

    /// Whether two scenes differ in nothing but the load or the friction coefficient.
    pub(super) fn differ_in_load(&self, one: u64, other: u64) -> bool {
        let both = self.steps(one).into_iter().zip(self.steps(other));
        self.axes.iter().zip(both).all(|(axis, (one, other))| one == other || axis.is_of_load())
    }

    /// Scenes in a row that are on one layer.
    fn run(&self) -> u64 {
        self.axes.iter().filter(|axis| !axis.is_of_layer()).map(|axis| axis.count).product()
    }

    /// Scenes that are solved one after another; it depends on the study alone, and so do the results.
    fn chunk(&self) -> u64 {
        (self.rows() / PARTS).clamp(1, self.run().min(LONGEST))
    }

    /// How many chunks there are.
    pub(super) fn chunks(&self) -> u64 {
        self.rows() / self.run() * self.run().div_ceil(self.chunk())
    }

    /// The scenes of a chunk, all on one layer.
    pub(super) fn chunk_rows(&self, chunk: u64) -> Range<u64> {
        let (run, length) = (self.run(), self.chunk());
        let per_run = run.div_ceil(length);
        let start = chunk / per_run * run + chunk % per_run * length;
        start..(start + length).min(chunk / per_run * run + run)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn study(axes: &str) -> Study {
        let scene = "format = 1\nscene = { format = 1, layer = { thickness = 5.0, poisson = 0.3, grading = { type = \"homogeneous\", modulus = 1.0 } }, \
             punch = { type = \"flat\", half_width = 1.0 }, load = { force = 1.0 } }\n";
        Study::parse("study.toml", &format!("{scene}{axes}"), &slipzone_api::NoFiles).unwrap()
    }

    #[test]
    fn the_layer_changes_slowest_and_each_scene_comes_once() {
        let study = study(
            "[[axes]]\nfield = \"load.force\"\nlinear = { from = 1.0, to = 2.0, count = 3 }\n\
             [[axes]]\nfield = \"layer.thickness\"\nvalues = [1.0, 2.0]\n\
             [[axes]]\nfield = \"punch.half_width\"\nvalues = [1.0, 2.0, 3.0, 4.0]\n",
        );
        assert_eq!(study.rows(), 24);
        assert_eq!([0, 1, 4, 12].map(|row| study.steps(row)), [[0, 0, 0], [0, 0, 1], [1, 0, 0], [0, 1, 0]]);
        let rows: Vec<u64> = (0..study.chunks()).flat_map(|chunk| study.chunk_rows(chunk)).collect();
        assert_eq!(rows, (0..24).collect::<Vec<_>>());
    }

    #[test]
    fn chunks_do_not_cross_from_layer_to_layer() {
        let study = study(
            "[[axes]]\nfield = \"load.force\"\nlinear = { from = 1.0, to = 2.0, count = 77 }\n\
             [[axes]]\nfield = \"layer.thickness\"\nlinear = { from = 1.0, to = 2.0, count = 500 }\n",
        );
        let chunks: Vec<_> = (0..study.chunks()).map(|chunk| study.chunk_rows(chunk)).collect();
        assert!(chunks.iter().all(|rows| !rows.is_empty() && rows.start / 77 == (rows.end - 1) / 77));
        assert!(chunks.windows(2).all(|pair| pair[0].end == pair[1].start));
        assert_eq!(chunks.last().map(|rows| rows.end), Some(77 * 500));
        assert_eq!(chunks.len(), 1000, "64 and 13 scenes on each layer");
    }
}
