//! What is seen at one value of the field.

use super::Question;
use crate::engine::{Solution, Status, solve};
use crate::plan;
use crate::scene::{Asked, Layer, Load, Replacement, Scene};
use crate::study::find::{Find, Wanted};

/// Ranges wider than this factor are stepped by factors.
const WIDE: f64 = 4.0;

/// A place in the range, taken as 0 to 1, and the excess there.
pub(super) type Place = (f64, f64);

/// What was seen at one value of the field: the number that decides, less what is wanted of it.
#[derive(Clone, Copy)]
pub(super) struct Point {
    pub(super) at: f64,
    pub(super) number: f64,
    /// Of the excess.
    pub(super) error: f64,
    pub(super) excess: f64,
}

impl Point {
    pub(super) fn place(&self) -> Place {
        (self.at, self.excess)
    }

    /// Whether it is as wanted, as far as its own error tells.
    pub(super) fn may_be_hit(&self) -> bool {
        self.excess.abs() <= self.error
    }
}

impl Question<'_> {
    fn by_factors(&self) -> bool {
        self.find.from > 0.0 && self.find.to / self.find.from > WIDE
    }

    /// The value of the field at a share of the range.
    pub(super) fn value(&self, at: f64) -> f64 {
        let Find { from, to, .. } = *self.find;
        match at {
            0.0 => from,
            1.0 => to,
            _ if self.by_factors() => from * (to / from).powf(at),
            _ => from + (to - from) * at,
        }
    }

    /// The width of the range, relative to a value in it, or to the farther end where that is 0.
    pub(super) fn relative(&self, value: f64) -> f64 {
        let Find { from, to, .. } = *self.find;
        let beside = if value == 0.0 { from.abs().max(to.abs()) } else { value.abs() };
        if self.by_factors() { (to / from).ln() } else { (to - from) / beside }
    }

    pub(super) fn excess(&self, at: f64) -> Result<f64, String> {
        self.point(at).map(|point| point.excess)
    }

    pub(super) fn point(&self, at: f64) -> Result<Point, String> {
        self.seen(at, &self.solution(self.value(at), true)?)
    }

    pub(super) fn seen(&self, at: f64, solution: &Solution) -> Result<Point, String> {
        let number =
            solution.number(&self.find.quantity).ok_or_else(|| format!("{} is undefined", self.find.quantity))?;
        let error = self.excess_error(solution);
        let excess = match self.find.wanted {
            Wanted::Target(target) => number - target,
            Wanted::Minimum => number,
            Wanted::Maximum => -number,
            Wanted::HalfPlaneWithin(share) => {
                let plane = solve(&half_plane(&solution.scene)?);
                let reference = plane
                    .number(&self.find.quantity)
                    .ok_or_else(|| format!("{} has no value on a half-plane to compare with", self.find.quantity))?;
                if reference == 0.0 {
                    return Err(format!(
                        "{} is 0 on a half-plane: nothing is within a share of that",
                        self.find.quantity
                    ));
                }
                (number / reference - 1.0).abs() - share
            }
        };
        Ok(Point { at, number, error, excess })
    }

    /// The scene solved with the field at a value, for nothing but the number that decides where `alone`; an error
    /// where it does not converge.
    pub(super) fn solution(&self, value: f64, alone: bool) -> Result<Solution, String> {
        let replacement = Replacement::number(self.path, value);
        let mut scene = self.study.scene_where(self.row, replacement).map_err(|error| error.in_one_line())?;
        if alone {
            scene.output.quantities = Asked::named(&self.find.quantity).map(|asked| vec![asked]);
            scene.output.strain = false;
        }
        let solution = solve(&scene);
        if solution.status == Status::Converged {
            return Ok(solution);
        }
        Err(solution.reason.unwrap_or_else(|| "it does not converge".into()))
    }

    /// The error of the excess.
    pub(super) fn excess_error(&self, solution: &Solution) -> f64 {
        let size = match self.find.wanted {
            Wanted::HalfPlaneWithin(_) => 2.0, // relative to the half-plane's number, which has an error of its own
            _ => solution.number(&self.find.quantity).map_or(1.0, f64::abs),
        };
        let tolerance = solution.scene.solver.tolerance.get();
        solution.error.each.get(self.find.quantity.as_str()).copied().unwrap_or(tolerance) * size
    }
}

/// The scene on a homogeneous half-plane of the surface's modulus. Depths are counted from the same datum.
fn half_plane(scene: &Scene) -> Result<Scene, String> {
    let datum = scene.layer.datum;
    if matches!(scene.load, Load::Indentation(_)) && datum.is_none() {
        return Err("this scene is compared with a half-plane, on which its indentation is undefined: prescribe the force or the half-width".into());
    }
    let model = scene.layer.model().map_err(|refusal| refusal.to_string())?;
    if plan::is_homogeneous_half_plane(&model) {
        return Err("that is the homogeneous half-plane already".into());
    }
    Ok(Scene { layer: Layer { datum, ..plan::half_plane(&scene.layer, &model) }, ..scene.clone() })
}
