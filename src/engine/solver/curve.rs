//! Loading curves: all loads on the way to one.

use super::Solver;
use crate::engine::accuracy::quantity::Numbers;
use crate::engine::assemble;
use crate::engine::problem::LoadInLayerUnits;
use crate::engine::refine::Aim;
use crate::engine::solution::Status;
use crate::engine::solution::loading_curve::{Curve, Point};
use crate::engine::verdict::verdict;
use crate::scene::{Load, LoadPath};
use slipzone_api::Refusal;

/// Loads on the way to another that are found one by one, where nothing asks for a stack of flat punches.
const FEW: usize = 8;

impl Solver {
    /// The contact under each of the loads, from the smallest to the largest: numbers alone, no report. Afterwards the
    /// solver is pressed by the largest.
    ///
    /// ```
    /// use slipzone::{api::Positive, engine::{Solver, Status}, scene::{self, Load, LoadPath}};
    ///
    /// let scene = scene::parse("example.toml", r#"
    ///     format = 1
    ///     layer = { thickness = 5.0, poisson = 0.3, grading = { type = "exponential", surface = 1.0, base = 8.0 } }
    ///     punch = { type = "cylinder", radius = 10.0 }
    ///     load = { half_width = 1.0 }
    /// "#).unwrap();
    /// let loads = LoadPath::until(Load::HalfWidth(Positive::new(1.0).unwrap()), 10).unwrap();
    /// let curve = Solver::new(&scene).unwrap().curve(&loads);
    /// assert_eq!((curve.status, curve.points()), (Status::Converged, 10));
    /// assert!(curve.force.is_sorted(), "a wider contact takes more force");
    /// ```
    pub fn curve(&mut self, loads: &LoadPath) -> Curve {
        self.go_back();
        let wishes = self.problem.wishes;
        self.problem.wishes = wishes.along_curve();
        self.begin_whole();
        self.load(loads.last());
        let found = self.find();
        let last = self.point_of(found);
        let curve = self.curve_to(loads, last);
        self.press(loads.last());
        self.problem.wishes = wishes;
        curve
    }

    /// The curve that ends in the load found last, and what of it is asked for and missing. The solver is left pressed
    /// by some load on the way.
    pub(super) fn curve_to(&mut self, loads: &LoadPath, last: Point) -> Curve {
        let missing = self.missing();
        let mut points = self.on_the_way(loads);
        points.push(last);
        let curve = Curve::of(&points, loads, &self.chosen.scene);
        missing.iter().fold(curve, |curve, why| curve.lacking(why))
    }

    /// All points but the last, whose load was found before: by the stack of flat punches that found it, or one by one.
    fn on_the_way(&mut self, loads: &LoadPath) -> Vec<Point> {
        let earlier: Vec<Load> = loads.loads().take(loads.points() - 1).collect();
        // For all loads on the way together.
        self.begin_whole();
        let stacked = self.stacked_points(&earlier);
        self.begin_whole();
        let Some(points) = stacked else { return earlier.iter().map(|load| self.point_under(*load)).collect() };
        let each = earlier.iter().zip(points);
        // What the flat punches of the last load do not tell well enough takes its own.
        each.map(|(load, told)| if told.is_short() { self.point_under(*load) } else { told.insisting(*load) }).collect()
    }

    /// One load, with what earlier ones left behind.
    fn point_under(&mut self, load: Load) -> Point {
        self.load(load);
        let found = self.find_within();
        self.point_of(found)
    }

    /// What came of the present load.
    fn point_of(&mut self, found: Result<(), Refusal>) -> Point {
        let load = self.chosen.scene.load;
        match found {
            Ok(()) => self.point().insisting(load),
            Err(refusal) => Point::refused(load, &refusal),
        }
    }

    /// Points of a loading curve that ends in the load found last; `None` where each has to be solved by itself.
    fn stacked_points(&mut self, loads: &[Load]) -> Option<Vec<Point>> {
        let tolerance = self.chosen.scene.solver.tolerance.get();
        let Self { chosen, problem, layer, ladder, judged, .. } = self;
        let judged = judged.as_ref()?;
        // A strain that is prescribed has no history; a few take less by themselves than all the flat punches that they
        // are made of.
        if problem.is_linear || !problem.is_stacked() && loads.len() <= FEW {
            return None;
        }
        let (status, reason) = verdict(layer, problem, ladder.stage(judged.step), judged, tolerance);
        if status == Status::AssumptionViolated {
            return None;
        }
        let scaled = |load: &Load| LoadInLayerUnits::new(*load, problem.length, problem.stress);
        let scaled: Vec<_> = loads.iter().map(scaled).collect();
        let found = ladder.on_the_way(layer, Aim { problem, methods: &chosen.methods, tolerance }, judged, &scaled)?;
        let point = |(load, (numbers, error)): (&Load, (Numbers, f64))| {
            let judgement =
                if error <= tolerance { (Status::Converged, None) } else { (Status::NotConverged, reason.clone()) };
            assemble::point(*load, problem, &numbers, Some(error), judgement)
        };
        Some(loads.iter().zip(found).map(point).collect())
    }

    /// What was found, as a point of a loading curve.
    pub(super) fn point(&mut self) -> Point {
        let Some(judged) = &self.judged else { unreachable!("found before") };
        let tolerance = self.chosen.scene.solver.tolerance.get();
        let judgement = verdict(&self.layer, &self.problem, self.ladder.stage(judged.step), judged, tolerance);
        let error = Point::error(&judged.errors);
        assemble::point(self.chosen.scene.load, &self.problem, &judged.outcome.numbers, error, judgement)
    }
}
