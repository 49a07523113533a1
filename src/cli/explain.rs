//! `slipzone explain`: the scene as understood, what follows from it, and how it would be solved.

use super::{Failure, Outcome, input, print};
use slipzone::api::{Base, Elastic, Positive};
use slipzone::engine::{self, Plan};
use slipzone::scene::{Load, Scene};
use std::fmt::Write;
use std::path::Path;

pub(super) fn run(path: &Path) -> Result<Outcome, Failure> {
    let scene = input::scene(path)?;
    let mut text = resolved(&scene)?;
    // Writing to a string does not fail.
    let _ = derived(&mut text, &scene);
    let _ = choices(&mut text, &scene, &engine::plan(&scene));
    print::result(&text)?;
    Ok(Outcome::Done)
}

/// The scene with every default filled in: a scene file again.
fn resolved(scene: &Scene) -> Result<String, Failure> {
    let toml = toml::to_string(scene).map_err(|error| Failure::System(format!("cannot write the scene: {error}")))?;
    Ok(format!("# The scene as it is understood.\n{toml}"))
}

/// Constants that the theory is written in.
fn derived(text: &mut String, scene: &Scene) -> std::fmt::Result {
    let elastic = Elastic::new(scene.layer.plane, scene.layer.poisson);
    writeln!(text, "\n# What follows from it.")?;
    writeln!(text, "# kappa    = {}", elastic.kappa)?;
    writeln!(text, "# beta     = {}", elastic.beta())?;
    writeln!(text, "# A0 mu1   = {}", elastic.a0())?;
    match scene.layer.law() {
        Ok(law) => {
            writeln!(text, "# mu1      = {}  (stress)", law.surface_modulus())?;
            writeln!(text, "# A0       = {}  (1/stress)", elastic.a0() / law.surface_modulus())?;
            match law.exponent() {
                Some(gamma) if scene.layer.base == Base::Infinite => {
                    writeln!(text, "# gamma    = {gamma}  (1/length)")?;
                }
                Some(gamma) => writeln!(text, "# gamma h  = {gamma}")?,
                None => {}
            }
        }
        Err(refusal) => writeln!(text, "# refused: {refusal}")?,
    }
    let half_width = match (scene.punch.shape(), scene.load) {
        (Ok(shape), Load::HalfWidth(b)) => shape.fixed_half_width().or(Some(b.get())),
        (Ok(shape), _) => shape.fixed_half_width(),
        (Err(refusal), _) => {
            writeln!(text, "# refused: {refusal}")?;
            None
        }
    };
    match (half_width, scene.layer.thickness.map(Positive::get)) {
        (Some(b), Some(h)) => writeln!(text, "# h/b      = {}", h / b),
        (Some(b), None) => writeln!(text, "# b        = {b}  (length)"),
        (None, _) => writeln!(text, "# b          grows with the load"),
    }
}

/// Which plugin does what: named in the scene, or chosen by the plan.
fn choices(text: &mut String, scene: &Scene, plan: &Plan) -> std::fmt::Result {
    writeln!(text, "\n# How it is solved.")?;
    let solver = &scene.solver;
    let methods = [
        ("grading", scene.layer.grading.typetag_name(), true),
        ("punch", scene.punch.typetag_name(), true),
        ("flexibility", plan.flexibility.as_str(), solver.flexibility.is_some()),
        ("kernel", plan.kernel.as_str(), solver.kernel.is_some()),
        ("quadrature", plan.quadrature.as_str(), solver.quadrature.is_some()),
    ];
    for (family, name, is_named) in methods {
        let by = if is_named { "named in the scene" } else { "chosen by the solver" };
        writeln!(text, "# {family:<12} {name} ({by})")?;
    }
    plan.reasons.iter().try_for_each(|reason| writeln!(text, "# {reason}"))?;
    engine::refusal(scene).map_or(Ok(()), |refusal| writeln!(text, "# It would be refused: {refusal}"))
}
