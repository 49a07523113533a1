//! Force, depth and sizes of a contact on the way to its last load.

use crate::engine::accuracy::quantity::{Numbers, Quantity};
use crate::engine::solution::{LoadReport, Status};
use crate::scene::{Load, LoadPath, Scene};
use serde::Serialize;
use slipzone_api::{Refusal, rounded};

/// A contact under growing loads, the smallest first; lengths and forces in the scene's units.
///
/// A load that cannot be solved keeps its own number, all others are `None`, and the `note` names it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Curve {
    /// The gravest status of a load.
    pub status: Status,
    /// How many loads are not converged, and why the first of them is not, or what is missing of all; `None` when all
    /// are, and nothing is.
    pub note: Option<String>,
    /// Largest relative error estimated of a number on the curve; `None` where there is none.
    pub error: Option<f64>,
    /// Normal force per unit length.
    pub force: Vec<Option<f64>>,
    /// Half-width of the contact.
    pub half_width: Vec<Option<f64>>,
    /// Depth of the punch; `None` as a whole on a half-plane without a datum, and like the two below where it is not
    /// asked for.
    pub indentation: Option<Vec<Option<f64>>>,
    /// Half-width of the stick zone; `None` as a whole without friction.
    pub stick_half_width: Option<Vec<Option<f64>>>,
    /// The same over the half-width of the contact; `None` as a whole without friction.
    pub stick_ratio: Option<Vec<Option<f64>>>,
}

impl Curve {
    /// How many loads there are.
    pub fn points(&self) -> usize {
        self.force.len()
    }

    /// The same, of which something that was asked for is missing.
    pub(crate) fn lacking(self, why: &str) -> Self {
        let (status, note) = self.status.lacking(self.note, why);
        Self { status, note: Some(note), ..self }
    }

    pub(crate) fn of(points: &[Point], loads: &LoadPath, scene: &Scene) -> Self {
        let asks = |quantity: Quantity| scene.output.asks(quantity.path());
        let has_depth = scene.layer.has_depths() && asks(Quantity::Indentation);
        let sticks = |quantity: Quantity| scene.friction.is_some() && asks(quantity);
        let column = |of: fn(&Point) -> Option<f64>| points.iter().map(of).collect::<Vec<_>>();
        let status = points.iter().map(|point| point.status).max();
        Self {
            status: status.unwrap_or(Status::Refused),
            note: note(points, loads),
            error: points.iter().filter_map(|point| point.error).reduce(f64::max),
            force: column(|point| point.load.force),
            half_width: column(|point| point.load.half_width),
            indentation: has_depth.then(|| column(|point| point.load.indentation)),
            stick_half_width: sticks(Quantity::StickHalfWidth).then(|| column(|point| point.stick_half_width)),
            stick_ratio: sticks(Quantity::StickRatio).then(|| column(|point| point.stick_ratio)),
        }
    }
}

/// A contact under one of the loads.
pub(crate) struct Point {
    pub(crate) load: LoadReport,
    pub(crate) stick_half_width: Option<f64>,
    pub(crate) stick_ratio: Option<f64>,
    /// The largest estimated of the numbers above.
    pub(crate) error: Option<f64>,
    pub(crate) status: Status,
    pub(crate) reason: Option<String>,
}

/// The numbers of a [`Point`].
const ON_THE_CURVE: [Quantity; 5] =
    [Quantity::Force, Quantity::HalfWidth, Quantity::Indentation, Quantity::StickHalfWidth, Quantity::StickRatio];

impl Point {
    /// The largest error of the numbers of a point.
    pub(crate) fn error(errors: &Numbers) -> Option<f64> {
        ON_THE_CURVE.into_iter().filter_map(|quantity| errors.get(quantity)).reduce(f64::max)
    }

    /// Whether it misses the tolerance, which the last load met.
    pub(crate) fn is_short(&self) -> bool {
        self.status == Status::NotConverged && self.reason.is_none()
    }

    /// A load without a contact.
    pub(crate) fn refused(load: Load, refusal: &Refusal) -> Self {
        let (load, reason) = (LoadReport::given(load), Some(refusal.to_string()));
        Self { load, stick_half_width: None, stick_ratio: None, error: None, status: Status::Refused, reason }
    }

    /// The same, refused where one of its numbers is not finite.
    pub(crate) fn insisting(self, load: Load) -> Self {
        let LoadReport { force, half_width, indentation } = &self.load;
        let numbers = [*force, *half_width, *indentation, self.stick_half_width, self.stick_ratio, self.error];
        if numbers.into_iter().flatten().all(f64::is_finite) {
            return self;
        }
        let refusal = Refusal::Limit {
            why: "a number of the curve is not finite".into(),
            remedy: "check the sizes of the scene's numbers against each other",
        };
        Self::refused(load, &refusal)
    }
}

/// Digits of a load in words.
const SAID: usize = 8;

/// What is to be said against some of the points.
fn note(points: &[Point], loads: &LoadPath) -> Option<String> {
    let of = |status| {
        let mut failed = points.iter().enumerate().filter(move |(_, point)| point.status == status);
        let (first, point) = failed.next()?;
        let what = match status {
            Status::Converged => return None,
            Status::NotConverged => "not converged",
            Status::AssumptionViolated => "contradict the model's assumptions",
            Status::Refused => "have no numbers",
        };
        let reason = point.reason.as_deref().unwrap_or("no reason was given");
        let (key, value) = (loads.kind().key(), loads.load(first).value().get());
        Some(format!(
            "{} of {} loads {what}, the first at {key} = {}: {reason}",
            1 + failed.count(),
            points.len(),
            rounded(value, SAID)
        ))
    };
    let notes: Vec<String> =
        [Status::Refused, Status::AssumptionViolated, Status::NotConverged].into_iter().filter_map(of).collect();
    (!notes.is_empty()).then(|| notes.join("; "))
}
