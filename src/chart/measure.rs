//! One run: what it took, what it claims, what is true.

use super::judge::{self, Judge};
use super::{Charted, Effort, Errors, Measured, Method, Setting};
use crate::caught::caught;
use crate::engine::{Plan, Solution, Solver, Status, first_not_finite};
use crate::scene::Scene;
use serde::Serialize;
use slipzone_api::Refusal;
use std::time::Instant;

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Ended {
    /// With numbers within the tolerance, as it says.
    Converged,
    /// With numbers, and a word that they are not good enough.
    Flagged,
    /// With a refusal.
    Refused,
    /// With a number that is none.
    NotFinite,
    /// With a panic.
    Panicked,
    /// It took more than the chart has; finer settings are not tried.
    TooLong,
    /// Not tried, because a coarser setting took too long.
    NotTried,
}

impl Ended {
    /// Whether there are numbers to chart.
    pub fn has_numbers(self) -> bool {
        matches!(self, Self::Converged | Self::Flagged)
    }

    /// In a word or two.
    pub fn name(self) -> &'static str {
        match self {
            Self::Converged => "converged",
            Self::Flagged => "flagged",
            Self::Refused => "refused",
            Self::NotFinite => "not finite",
            Self::Panicked => "panicked",
            Self::TooLong => "too long",
            Self::NotTried => "not tried",
        }
    }
}

/// Seconds of repeated runs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// The shortest.
    pub least: f64,
    /// The one in the middle.
    pub median: f64,
    /// The longest.
    pub most: f64,
}

/// A scene solved by a method at one of its settings. Work and times include what the estimate of the error takes.
#[derive(Clone, Debug, Serialize)]
pub struct Run {
    /// The method.
    #[serde(flatten)]
    pub method: Method,
    /// How finely.
    #[serde(flatten)]
    pub setting: Setting,
    /// How it ended.
    pub ended: Ended,
    /// Why not better.
    pub reason: Option<String>,
    /// Called itself converged, and some number is off by more than three times what it claims and the judges leave
    /// open.
    pub wrong: bool,
    /// Seconds with everything to be made anew.
    pub fresh: Option<Spread>,
    /// Seconds on a layer whose kernels are known already; the difference is the set-up.
    pub known: Option<Spread>,
    /// Unknowns of the finest pressure problem.
    pub unknowns: usize,
    /// Wave numbers.
    pub flexibility_evaluations: usize,
    /// Distances at which a kernel was read.
    pub kernel_evaluations: u64,
    /// Systems.
    pub factorisations: usize,
    /// Multiplications in their elimination.
    pub operations: u64,
    /// Errors that it claims.
    pub claimed: Errors,
    /// Errors that it has.
    pub errors: Errors,
}

/// Seconds after which a setting is given up, with all that are finer.
const PATIENCE: f64 = 1.0;
/// Seconds that go into repeating one run, and how often at least and at most. What takes longer is not repeated: its
/// spread is small beside what the charts show.
const REPEATING: f64 = 0.03;
const REPEATED: [usize; 2] = [3, 9];
const LONG: f64 = 0.1;

impl Run {
    fn new(method: &Method, setting: &Setting, ended: Ended, reason: Option<String>) -> Self {
        Self {
            method: method.clone(),
            setting: setting.clone(),
            ended,
            reason,
            wrong: false,
            fresh: None,
            known: None,
            unknowns: 0,
            flexibility_evaluations: 0,
            kernel_evaluations: 0,
            factorisations: 0,
            operations: 0,
            claimed: Errors::default(),
            errors: Errors::default(),
        }
    }

    pub(super) fn not_tried(method: &Method, setting: &Setting) -> Self {
        Self::new(method, setting, Ended::NotTried, Some("a coarser setting took too long".into()))
    }

    /// Wave numbers, kernels read and multiplications: one number for what it did, the same on every machine. Each
    /// counts alike, though a wave number is a few hundred multiplications and a kernel about ten.
    pub fn work(&self) -> u64 {
        self.flexibility_evaluations as u64 + self.kernel_evaluations + self.operations
    }

    fn working(self, plan: &Plan) -> Self {
        Self {
            unknowns: plan.unknowns,
            flexibility_evaluations: plan.flexibility_evaluations,
            kernel_evaluations: plan.kernel_evaluations,
            factorisations: plan.factorisations,
            operations: plan.operations,
            ..self
        }
    }
}

/// Solves, times and judges.
pub(super) fn measure(scene: &Charted, method: &Method, setting: &Setting, judges: &[Judge; 2], effort: Effort) -> Run {
    let ended = |ended, reason: String| Run::new(method, setting, ended, Some(reason));
    let scene = match scene.parsed(&format!("{}{}", setting.solver, judge::output())) {
        Ok(scene) => scene,
        Err(error) => return ended(Ended::Refused, error.to_string()),
    };
    let began = Instant::now();
    let tried = caught(|| -> Result<(Solution, Solver), Refusal> {
        let mut solver = Solver::new(&scene)?;
        Ok((solver.solve(), solver))
    });
    let (solution, solver) = match tried {
        Ok(Ok(tried)) => tried,
        Ok(Err(refusal)) => return ended(Ended::Refused, refusal.to_string()),
        Err(why) => return ended(Ended::Panicked, why),
    };
    let took = began.elapsed().as_secs_f64();
    let reason = solution.reason.clone();
    if took > PATIENCE {
        return ended(Ended::TooLong, format!("took {took:.1} s")).working(&solution.plan);
    }
    if let Some(what) = first_not_finite(&solution) {
        return ended(Ended::NotFinite, what).working(&solution.plan);
    }
    let how = match solution.status {
        Status::Converged => Ended::Converged,
        Status::NotConverged | Status::AssumptionViolated => Ended::Flagged,
        Status::Refused => return Run::new(method, setting, Ended::Refused, reason).working(&solution.plan),
    };
    let judge = judge::of(method, judges);
    let (errors, claimed) = (Errors::between(&solution, &judge.solution), Errors::claimed(&solution));
    let band = judge::apart(judges);
    let (fresh, known) = times(&scene, solver, took, effort);
    Run {
        wrong: how == Ended::Converged && is_wrong(&errors, &claimed, &band),
        fresh: Some(fresh),
        known,
        claimed,
        errors,
        ..Run::new(method, setting, how, reason).working(&solution.plan)
    }
}

/// Whether a number is off by more than three of its estimates and what the judges leave open.
fn is_wrong(errors: &Errors, claimed: &Errors, band: &Errors) -> bool {
    Measured::ALL.into_iter().any(|measured| {
        let known = errors.of(measured).zip(claimed.of(measured));
        known.is_some_and(|(error, claimed)| error > 3.0 * claimed + 2.0 * band.of(measured).unwrap_or(0.0) + 1e-14)
    })
}

/// Repeats the run: with everything made anew, and on the layer that the first left behind.
fn times(scene: &Scene, solver: Solver, took: f64, effort: Effort) -> (Spread, Option<Spread>) {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // saturates
    let often = ((REPEATING / took) as usize).clamp(REPEATED[0], REPEATED[1]);
    let often = if effort == Effort::Quick || took > LONG { 1 } else { often };
    let mut fresh = Vec::new();
    for _ in 0..often {
        let began = Instant::now();
        let solved = Solver::new(scene).map(|mut solver| solver.solve());
        fresh.push(began.elapsed().as_secs_f64());
        drop(solved);
    }
    let mut known = Vec::new();
    let mut layer = solver.into_layer();
    for _ in 0..often {
        let began = Instant::now();
        let Ok(mut solver) = Solver::on(layer, scene) else { break };
        let solution = solver.solve();
        known.push(began.elapsed().as_secs_f64());
        drop(solution);
        layer = solver.into_layer();
    }
    (spread(fresh).unwrap_or(Spread { least: took, median: took, most: took }), spread(known))
}

fn spread(mut seconds: Vec<f64>) -> Option<Spread> {
    seconds.sort_by(f64::total_cmp);
    let (least, most) = (*seconds.first()?, *seconds.last()?);
    Some(Spread { least, median: seconds[seconds.len() / 2], most })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_claim_that_does_not_hold_is_wrong_unless_the_judges_leave_it_open() {
        let edge = |error| Errors { edge: Some(error), ..Errors::default() };
        assert!(is_wrong(&edge(1e-5), &edge(1e-8), &edge(1e-13)));
        assert!(!is_wrong(&edge(2.9e-8), &edge(1e-8), &edge(1e-13)), "three estimates are allowed");
        assert!(!is_wrong(&edge(1e-5), &edge(1e-8), &edge(1e-5)), "the judges are as far apart");
        assert!(!is_wrong(&Errors { pressure: Some(1.0), ..Errors::default() }, &edge(1e-8), &edge(0.0)), "no claim");
    }

    #[test]
    fn a_spread_has_its_median() {
        let found = spread(vec![3.0, 1.0, 2.0]).unwrap();
        assert_eq!((found.least, found.median, found.most), (1.0, 2.0, 3.0));
        assert_eq!(spread(Vec::new()), None);
    }
}
