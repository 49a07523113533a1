//! What theory says of every contact: docs/theory.md section 4.

use super::{Case, Dice, set, write_all};
use slipzone::api::double_exponential::nodes;
use slipzone::engine::{Solution, Status};
use std::f64::consts::PI;
use toml::{Table, Value};

/// Integrals end that far from the edge, in half-widths: an abscissa nearer has lost its distance.
const END: f64 = 1e-9;
/// What an integral over sampled tractions may miss: the pressure's own error, kinks that no sample knows, layers of
/// stress beside the edges of contacts far wider than the layer.
const SAMPLED: f64 = 1e-5;
/// Nodes on either side of a piece.
const NODES: usize = 40;
/// Widest contact whose tractions are sampled, over the thickness.
const WIDEST: f64 = 20.0;

/// Abscissae and weights over `0..1` in pieces between kinks.
fn grid(kinks: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let mut ends = vec![0.0];
    ends.extend(kinks.iter().copied().filter(|kink| *kink > 1e-6 && *kink < 1.0 - 1e-6));
    ends.push(1.0 - END);
    let mut all = (Vec::new(), Vec::new());
    for pair in ends.windows(2) {
        for node in nodes(pair[1] - pair[0], NODES) {
            let x = if node.from_lower < node.to_upper { pair[0] + node.from_lower } else { pair[1] - node.to_upper };
            // Rounded onto a kink, where a pressure may be unbounded, or out of the contact.
            if x > pair[0] && x < pair[1] {
                all.0.push(x);
                all.1.push(node.weight);
            }
        }
    }
    all
}

/// `2 int_0^1 p g dx` of a sampled pressure, the end by its edge factor.
fn integral(found: &Solution, weights: &[f64], g: impl Fn(f64) -> f64) -> Option<f64> {
    let (b, force) = (found.load.half_width?, found.load.force?);
    let f = found.edge.ratio? * force / b;
    let mut sum = f * (1.0 - END).acos() * g(b);
    for ((x, p), w) in found.profile.x.iter().zip(&found.profile.pressure).zip(weights) {
        sum += w * (*p)? * g(*x);
    }
    Some(2.0 * b * sum)
}

/// Where the shape of the scene is not analytic, over a half-width.
fn kinks(case: &Case, b: f64) -> Option<Vec<f64>> {
    Some(case.scene.punch.shape().ok()?.kinks().iter().map(|kink| kink / b).collect())
}

fn is_narrow(case: &Case, b: f64) -> bool {
    case.scene.layer.thickness.is_none_or(|h| b < WIDEST * h.get())
}

/// The pressure carries the force.
pub(super) fn equilibrium(case: &Case, _dice: &mut Dice) -> Result<bool, String> {
    let Some(b) = case.found.load.half_width.filter(|b| is_narrow(case, *b)) else { return Ok(false) };
    let (x, weights) = grid(&kinks(case, b).unwrap_or_default());
    let Some(found) = case.found(|table| write_all(table, &x)) else { return Ok(false) };
    let (Some(carried), Some(force)) = (integral(&found, &weights, |_| 1.0), found.load.force) else {
        return Ok(false);
    };
    let allowed = SAMPLED + 30.0 * found.error.estimate.unwrap_or(0.0);
    if (carried / force - 1.0).abs() <= allowed {
        return Ok(true);
    }
    Err(format!("int p dx = {carried:e}, P = {force:e}, allowed {allowed:.0e}"))
}

/// A flat punch of that half-width on the same layer.
fn flat(table: &mut Table, half_width: f64) {
    let mut punch = Table::new();
    punch.insert("type".into(), "flat".into());
    punch.insert("half_width".into(), half_width.into());
    table.insert("punch".into(), punch.into());
    let mut load = Table::new();
    load.insert("force".into(), 1.0.into());
    table.insert("load".into(), load.into());
    table.remove("friction");
}

/// `delta = P D + int p_flat g dx`: the depth of any contact from the flat punch as wide.
pub(super) fn reciprocity(case: &Case, _dice: &mut Dice) -> Result<bool, String> {
    let (Some(b), Some(force), Some(depth)) =
        (case.found.load.half_width, case.found.load.force, case.found.load.indentation)
    else {
        return Ok(false);
    };
    let shape = case.scene.punch.shape().map_err(|refusal| refusal.to_string())?;
    // A datum moves by how the pressure is distributed.
    if shape.fixed_half_width().is_some() || !is_narrow(case, b) || case.scene.layer.datum.is_some() {
        return Ok(false);
    }
    let (x, weights) = grid(&kinks(case, b).unwrap_or_default());
    let flat = case.found(|table| {
        flat(table, b);
        write_all(table, &x);
    });
    let Some(flat) = flat else { return Ok(false) };
    let (Some(own), Some(lifted)) = (flat.load.indentation, integral(&flat, &weights, |x| shape.height(x))) else {
        return Ok(false);
    };
    let (told, size) = (force * own + lifted, (force * own).abs() + lifted.abs());
    let errors = case.found.error.estimate.unwrap_or(0.0) + flat.error.estimate.unwrap_or(0.0);
    if (told - depth).abs() <= (SAMPLED + 30.0 * errors) * size {
        return Ok(true);
    }
    Err(format!("delta = {depth:e}, but P D + int p g dx = {told:e}"))
}

/// Rate of change over a half-width, by central differences extrapolated; with the sizes that rounding and errors have.
fn rate(b: f64, of: impl Fn(f64) -> Option<[f64; 2]>) -> Option<[f64; 2]> {
    let central = |step: f64| -> Option<[f64; 2]> {
        let (above, below) = (of(b * (1.0 + step))?, of(b * (1.0 - step))?);
        Some([0, 1].map(|k| (above[k] - below[k]) / (2.0 * step * b)))
    };
    let (coarse, fine) = (central(STEP)?, central(0.5 * STEP)?);
    Some([0, 1].map(|k| (4.0 * fine[k] - coarse[k]) / 3.0))
}

/// Step of differences, relative; what is left of them is `STEP^4`.
const STEP: f64 = 0.02;
/// Tolerance of the contacts whose difference is taken: `1e-10/STEP` is lost.
const FINE: f64 = 1e-10;
/// What differences may miss.
const DIFFERENCE: f64 = 1e-4;

/// `dP/ddelta` of a contact that grows is the force over depth of the flat punch as wide.
pub(super) fn stiffness(case: &Case, _dice: &mut Dice) -> Result<bool, String> {
    let (Some(b), Some(_)) = (case.found.load.half_width, case.found.load.indentation) else { return Ok(false) };
    let shape = case.scene.punch.shape().map_err(|refusal| refusal.to_string())?;
    let near = |kink: &f64| (kink / b - 1.0).abs() < 0.2;
    let reach = shape.reach().unwrap_or(f64::INFINITY);
    if shape.fixed_half_width().is_some() || shape.kinks().iter().any(near) || 1.1 * b > reach || !is_narrow(case, b) {
        return Ok(false);
    }
    let at = |half_width: f64| {
        let mut load = Table::new();
        load.insert("half_width".into(), half_width.into());
        let found = case.found(|table| {
            table.insert("load".into(), load.into());
            table.remove("friction");
            write_all(table, &[0.0]);
            set(table, &["solver"], Value::Table(Table::new()));
            set(table, &["solver", "tolerance"], FINE);
        })?;
        Some([found.load.force?, found.load.indentation?])
    };
    let Some([force, depth]) = rate(b, at) else { return Ok(false) };
    let flat = case.found(|table| {
        flat(table, b);
        write_all(table, &[0.0]);
    });
    let Some(own) = flat.as_ref().and_then(|flat| flat.load.indentation) else { return Ok(false) };
    // Incompressible or thin, the depth is a small difference.
    let error = flat.as_ref().and_then(|flat| flat.error.estimate).unwrap_or(0.0);
    if (depth / force / own - 1.0).abs() <= DIFFERENCE + 10.0 * error {
        return Ok(true);
    }
    Err(format!("ddelta/dP = {:e}, of the flat punch {own:e}", depth / force))
}

/// `dD/db = -pi A0 f^2/b` of a flat punch: its depth knows nothing of how the edge factor was computed.
pub(super) fn energy(case: &Case, _dice: &mut Dice) -> Result<bool, String> {
    let shape = case.scene.punch.shape().map_err(|refusal| refusal.to_string())?;
    let (Some(b), Some(f), Some(_)) = (shape.fixed_half_width(), case.found.edge.ratio, case.found.load.indentation)
    else {
        return Ok(false);
    };
    if !is_narrow(case, b) || case.scene.layer.datum.is_some() {
        return Ok(false);
    }
    let Ok(model) = case.scene.layer.model() else { return Ok(false) };
    let compliance = model.elastic.a0() / model.surface_shear;
    let at = |half_width: f64| {
        let found = case.found(|table| {
            flat(table, half_width);
            write_all(table, &[0.0]);
            set(table, &["solver"], Value::Table(Table::new()));
            set(table, &["solver", "tolerance"], FINE);
        });
        found.filter(|found| found.status == Status::Converged)?.load.indentation.map(|depth| [depth, 0.0])
    };
    let Some([rate, _]) = rate(b, at) else { return Ok(false) };
    let expected = -PI * compliance * f * f / b;
    let error = case.found.error.each.get("edge.ratio").copied().unwrap_or(0.0);
    if (rate / expected - 1.0).abs() <= DIFFERENCE + 10.0 * error {
        return Ok(true);
    }
    Err(format!("dD/db = {rate:e}, -pi A0 f^2/b = {expected:e}"))
}
