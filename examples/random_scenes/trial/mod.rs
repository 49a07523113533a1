//! Random scenes, what must hold of each, and the smallest scene that fails like a given one.
//!
//! Shared by `examples/random_scenes` and `tests/it`: docs/random-scenes.md.

mod dice;
mod draw;
mod formulas;
mod judge;
mod neighbours;
mod sense;
mod shrink;
mod theorems;
mod units;

use dice::Dice;
use draw::Artist;
use formulas::Examples;
use slipzone::engine::{BUDGET, Solution, Status, first_not_finite, solve_within};
use slipzone::scene::{Asked, KEYS, Scene};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;
use toml::{Table, Value};

pub(crate) use shrink::shrunk;

/// A scene of a run, and how it is to be tried.
#[derive(Clone, Debug)]
pub(crate) struct Trial {
    pub(crate) table: Table,
    /// For the choices of the checks.
    dice: Dice,
    /// Which of the dear checks are made.
    pub(crate) chosen: Vec<&'static str>,
    /// Work that each solve may take.
    budget: u64,
}

/// What became of one.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tried {
    /// `invalid` where the text was refused, else the status.
    pub(crate) status: &'static str,
    /// Why it was refused or flagged, without its numbers.
    pub(crate) reason: String,
    /// Checks that were made, and that do not apply.
    pub(crate) held: Vec<&'static str>,
    pub(crate) skipped: Vec<&'static str>,
    /// The check that failed, and how.
    pub(crate) failure: Option<(&'static str, String)>,
    /// Share of the budget of work that it took.
    pub(crate) work: f64,
    /// Seconds of each step.
    pub(crate) seconds: Vec<(&'static str, f64)>,
}

/// A scene that was solved.
pub(crate) struct Case {
    pub(crate) table: Table,
    pub(crate) scene: Scene,
    pub(crate) found: Solution,
    budget: u64,
}

/// What must hold of a solved scene: whether it applies, or how it fails.
type Check = fn(&Case, &mut Dice) -> Result<bool, String>;

/// The checks that take other solves, and the share of the scenes that they are made of.
pub(crate) const CHECKS: [(&str, Check, f64); 12] = [
    ("re-solved otherwise", judge::agrees, 0.1),
    ("units", neighbours::units, 0.05),
    ("mirror", neighbours::mirror, 0.05),
    ("merged sublayers", neighbours::merged, 0.07),
    ("more friction sticks more", neighbours::stick, 0.05),
    ("a wider contact bears more", neighbours::wider, 0.05),
    ("twice the force", neighbours::linear, 0.05),
    ("a curve's points", neighbours::curve, 0.3),
    ("equilibrium", theorems::equilibrium, 0.05),
    ("reciprocity", theorems::reciprocity, 0.05),
    ("stiffness", theorems::stiffness, 0.05),
    ("energy release", theorems::energy, 0.05),
];

/// Shares of the scenes that may take the whole budget of work, some seconds, or a hundredth of it; the others a
/// thousandth, which is enough for most and has the bound of work at work.
const WHOLE: (f64, f64) = (0.001, 0.1);
/// Work by which a scene may exceed its budget: one resolution's tables and readings, which are counted behind.
const OVERSHOT: f64 = 0.05 * BUDGET as f64;

/// Draws scene `index` of a run.
pub(crate) fn draw(seed: u64, index: u64) -> Trial {
    slipzone::link_plugins();
    let mut dice = Dice::new(seed, index);
    let manner = dice.roll();
    // Two thirds make sense, as far as is known what does; the others are wild in some of their numbers or in all.
    let wild = match manner {
        _ if manner < 0.66 => 0.0,
        _ if manner < 0.9 => dice.log(0.02, 0.3),
        _ => 1.0,
    };
    let mut artist = Artist::new(&mut dice, wild, 0.35);
    let mut table = artist.table(KEYS, None);
    if dice.chance(0.45) {
        let flat = slipzone::api::find(slipzone::api::Family::Punch, "flat")
            .map(|info| Artist::new(&mut dice, wild, 0.35).of_plugin(info));
        table.extend(flat.map(|flat| ("punch".to_owned(), flat.into())));
    }
    if dice.chance(0.7) && !table.contains_key("solver") {
        // Coarser than the default, which costs most.
        set(&mut table, &["solver", "tolerance"], dice.log(1e-6, 1e-2));
    }
    if manner < 0.8 {
        sense::make(&mut dice, &mut table);
    }
    if manner < 0.8 && dice.chance(0.3) {
        let factors = [dice.log(1e-6, 1e6), dice.log(1e-6, 1e6)];
        table = units::scaled(&table, KEYS, factors).unwrap_or(table);
    }
    // What grows with friction takes a hundred times as long.
    let grows = sense::kind(table.get("punch")).is_none_or(|kind| kind != "flat");
    if grows && dice.chance(0.9) {
        table.remove("friction");
    }
    let chosen = CHECKS.iter().filter(|(_, _, share)| dice.chance(*share)).map(|(name, ..)| *name).collect();
    let budget = match dice.roll() {
        roll if roll < WHOLE.0 => BUDGET,
        roll if roll < WHOLE.1 => BUDGET / 100,
        _ => BUDGET / 1000,
    };
    Trial { table, dice, chosen, budget }
}

impl Trial {
    pub(crate) fn text(&self) -> String {
        self.table.to_string()
    }

    /// The same of another scene.
    fn of(&self, table: Table) -> Self {
        Self { table, ..self.clone() }
    }

    /// Solves and checks; a panic is a failure, too.
    pub(crate) fn run(&self) -> Tried {
        catch_unwind(AssertUnwindSafe(|| self.run_unprotected())).unwrap_or_else(|panic| {
            let text = panic.downcast_ref::<String>().cloned();
            let text = text.or_else(|| panic.downcast_ref::<&str>().map(|text| (*text).to_owned()));
            Tried { status: "panic", failure: Some(("no panic", text.unwrap_or_default())), ..Tried::default() }
        })
    }

    fn run_unprotected(&self) -> Tried {
        let mut tried = Tried { status: "invalid", ..Tried::default() };
        let scene = match parse(&self.table) {
            Ok(scene) => scene,
            Err(error) => {
                tried.reason.clone_from(&error.message);
                if error.message.is_empty() || error.line > self.text().lines().count() + 1 {
                    tried.failure = Some(("refused with a reason", format!("{error:?}")));
                }
                return tried;
            }
        };
        let start = Instant::now();
        let found = solve_within(&scene, self.budget);
        tried.seconds.push(("solve", start.elapsed().as_secs_f64()));
        tried.status = name(found.status);
        tried.reason = found.reason.clone().unwrap_or_default();
        tried.work = found.plan.work as f64 / self.budget as f64;
        if let Err(how) = sane(&found, self.budget) {
            tried.failure = Some(("sane", how));
            return tried;
        }
        let case = Case { table: self.table.clone(), scene, found, budget: self.budget };
        if case.found.status != Status::Converged {
            return tried;
        }
        let mut dice = self.dice.clone();
        for (check, made, _) in CHECKS.iter().filter(|(check, ..)| self.chosen.contains(check)) {
            let start = Instant::now();
            let outcome = made(&case, &mut dice);
            tried.seconds.push((check, start.elapsed().as_secs_f64()));
            match outcome {
                Ok(true) => tried.held.push(check),
                Ok(false) => tried.skipped.push(check),
                Err(how) => {
                    tried.failure = Some((check, how));
                    return tried;
                }
            }
        }
        tried
    }
}

fn parse(table: &Table) -> Result<Scene, slipzone::scene::SceneError> {
    slipzone::scene::parse_with("random.toml", &table.to_string(), &Examples)
}

fn name(status: Status) -> &'static str {
    match status {
        Status::Converged => "converged",
        Status::NotConverged => "not converged",
        Status::AssumptionViolated => "assumption violated",
        Status::Refused => "refused",
    }
}

/// What must hold of every result, whatever its status, within a budget of work.
fn sane(found: &Solution, budget: u64) -> Result<(), String> {
    if let Some(what) = first_not_finite(found) {
        return Err(what);
    }
    let json = slipzone::report::json(found);
    let read: serde_json::Value = serde_json::from_str(&json).map_err(|error| error.to_string())?;
    let _ = (slipzone::report::text(found), slipzone::report::csv(found));
    if read["status"].is_null() {
        return Err("the JSON has no status".into());
    }
    let tolerance = found.scene.solver.tolerance.get();
    match (found.status, &found.reason, found.error.estimate) {
        (Status::Converged, None, Some(estimate)) if estimate <= tolerance => {}
        // Nothing that is asked for has an error.
        (Status::Converged, None, None) if found.error.each.is_empty() => {}
        (Status::Converged, reason, estimate) => {
            return Err(format!("converged to {estimate:?} at a tolerance of {tolerance:e}: {reason:?}"));
        }
        (_, Some(reason), _) if reason.len() > 10 => {}
        (status, reason, _) => return Err(format!("{} without a reason: {reason:?}", name(status))),
    }
    let profile = &found.profile;
    let lengths =
        [Some(profile.pressure.len()), profile.shear.as_ref().map(Vec::len), profile.strain.as_ref().map(Vec::len)];
    if lengths.into_iter().flatten().any(|length| length != profile.x.len()) {
        return Err("the columns of the profile differ in length".into());
    }
    if found.status == Status::Converged
        && let Some(peak) = found.pressure.peak
        && let Some(beyond) = profile.pressure.iter().flatten().copied().reduce(f64::max).map(|most| most / peak - 1.0)
    {
        let estimate = |path: &str| found.error.each.get(path).copied().unwrap_or(0.0);
        if beyond > 3.0 * (estimate("pressure.peak") + estimate("profile.pressure")) + ROUNDING {
            return Err(format!("a pressure of the profile is beyond the largest by {beyond:.1e}: {:?}", found.error));
        }
    }
    let budgets = if found.path.is_some() { 3.0 } else { 1.0 };
    if found.plan.work as f64 > budgets * budget as f64 + OVERSHOT {
        return Err(format!("more than the budget of {budget:.0e}: {:?}", found.plan));
    }
    Ok(())
}

impl Case {
    /// Another scene, solved; `None` where it is not valid.
    fn other(&self, change: impl FnOnce(&mut Table)) -> Option<Solution> {
        let mut table = self.table.clone();
        change(&mut table);
        parse(&table).ok().map(|scene| solve_within(&scene, self.budget))
    }

    /// The same, where it is found.
    fn found(&self, change: impl FnOnce(&mut Table)) -> Option<Solution> {
        self.other(change).filter(|other| other.status == Status::Converged)
    }
}

/// Puts a value where keys lead, making tables on the way.
fn set(table: &mut Table, path: &[&str], value: impl Into<Value>) {
    let Some((last, way)) = path.split_last() else { return };
    let mut here = table;
    for key in way {
        let next = here.entry(*key).or_insert_with(|| Value::Table(Table::new()));
        let Value::Table(next) = next else { return };
        here = next;
    }
    here.insert((*last).into(), value.into());
}

/// Makes a scene write everything, at these points.
fn write_all(table: &mut Table, x: &[f64]) {
    table.insert("output".into(), Value::Table(Table::new()));
    set(table, &["output", "x"], x.to_vec());
}

/// Whether the numbers of two results agree within three estimates of both; `factor` is what each of the first is to be
/// multiplied by.
fn agree(found: &Solution, other: &Solution, factor: impl Fn(&str) -> f64) -> Result<(), String> {
    for path in Asked::NUMBERS {
        let (Some(here), Some(there)) = (found.number(path), other.number(path)) else { continue };
        let here = here * factor(path);
        if here == 0.0 && there == 0.0 {
            continue;
        }
        let estimate = |solution: &Solution| solution.error.each.get(path).copied().unwrap_or(0.0);
        let error = (here / there - 1.0).abs();
        let allowed = 3.0 * (estimate(found) + estimate(other)) + ROUNDING;
        if error > allowed || error.is_nan() {
            return Err(format!(
                "{path}: {here:e} against {there:e}, apart by {error:.1e}; estimates {:.1e} and {:.1e}",
                estimate(found),
                estimate(other)
            ));
        }
    }
    Ok(())
}

/// What numbers may differ by that are the same: inputs are rounded differently.
const ROUNDING: f64 = 1e-12;
