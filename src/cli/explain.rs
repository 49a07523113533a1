//! `slipzone explain`: the scene as understood, what follows from it, and how it would be solved.

mod layer;

use super::args::Explain;
#[cfg(feature = "plot")]
use super::output::{self, Target};
use super::{Failure, Outcome, input, print};
use crate::api::{Base, LayerResponse, Positive, Refusal, exactly};
use crate::engine::{self, DepthProfile, Plan};
use crate::scene::{Load, Scene};
use std::fmt::Write;

/// What is known of a scene's layer before anything is solved.
struct Known {
    /// `None` where the solid is the same at every depth and has no base.
    depths: Result<Option<DepthProfile>, Refusal>,
    response: Result<Box<dyn LayerResponse>, Refusal>,
}

pub(super) fn run(arguments: &Explain) -> Result<Outcome, Failure> {
    #[cfg(feature = "plot")]
    if let Some(path) = &arguments.svg {
        output::named("--svg", path, "standard output is for the text; a file called `-` is `./-`")?;
        output::distinct(&arguments.scene, &[("--svg", path)])?;
    }
    #[cfg_attr(not(feature = "plot"), allow(unused_variables))]
    let (scene, read) = input::scene(&arguments.scene)?;
    #[cfg(feature = "plot")]
    if let Some(path) = &arguments.svg {
        output::spared("scene", &read, &[("--svg", path)], "give the figure a name of its own")?;
    }
    #[cfg(feature = "plot")]
    let target = arguments.svg.as_deref().map(Target::new).transpose()?;
    let known = Known { depths: DepthProfile::new(&scene.layer), response: engine::response(&scene) };
    #[cfg(feature = "plot")]
    if let Some((target, figure)) = target.and_then(|target| Some((target, figure(&scene, &known)?))) {
        output::write(&[(target, figure)])?;
    }
    let mut text = resolved(&scene)?;
    // Writing to a string does not fail.
    let _ = derived(&mut text, &scene);
    let _ = layer::write(&mut text, &scene, &known);
    let _ = choices(&mut text, &scene, &engine::plan(&scene));
    print::result(&text)?;
    Ok(Outcome::Done)
}

/// The figure of the layer; `None`, with a note, where there is nothing to draw.
#[cfg(feature = "plot")]
fn figure(scene: &Scene, known: &Known) -> Option<String> {
    let flexibility = known.response.as_ref().map_err(Clone::clone);
    let flexibility = flexibility.and_then(|response| engine::FlexibilityProfile::new(&**response));
    if let Err(refusal) = &flexibility {
        print::note(&format!("the figure has no flexibility: {refusal}"));
    }
    let depths = known.depths.as_ref().ok().and_then(Option::as_ref);
    super::solve::figure(crate::report::layer_svg(scene, depths, flexibility.as_ref().ok()))
}

/// The scene with every default filled in: a scene file again.
fn resolved(scene: &Scene) -> Result<String, Failure> {
    let toml = toml::to_string(scene).map_err(|error| Failure::System(format!("cannot write the scene: {error}")))?;
    let lines: Vec<_> = toml.lines().map(short_numbers).collect();
    Ok(format!("# The scene as it is understood.\n{}\n", lines.join("\n")))
}

/// A line of the scene, its numbers as powers of ten where plain decimals would be long.
fn short_numbers(line: &str) -> String {
    const AROUND: [char; 4] = ['[', ']', ',', ' '];
    // What stands in quotes is no number.
    let Some((key, value)) = line.split_once(" = ").filter(|(_, value)| !value.contains(['"', '\''])) else {
        return line.to_owned();
    };
    let parts = value.split_inclusive(AROUND).map(|part| {
        let text = part.trim_end_matches(AROUND);
        match text.parse::<f64>() {
            // An integer stays one, and 1.0 what it is.
            Ok(number) if text.contains('.') && exactly(number).contains('e') => exactly(number) + &part[text.len()..],
            _ => part.to_owned(),
        }
    });
    format!("{key} = {}", parts.collect::<String>())
}

/// Constants that the theory is written in.
fn derived(text: &mut String, scene: &Scene) -> std::fmt::Result {
    let [length, stress] = scene.units.names();
    writeln!(text, "\n# What follows from it.")?;
    match scene.layer.model() {
        Ok(model) => {
            let elastic = model.elastic;
            writeln!(text, "# kappa    = {}", exactly(elastic.kappa))?;
            writeln!(text, "# beta     = {}", exactly(elastic.beta()))?;
            writeln!(text, "# A0 mu1   = {}", exactly(elastic.a0()))?;
            writeln!(text, "# mu1      = {}  ({stress})", exactly(model.surface_shear))?;
            writeln!(text, "# A0       = {}  (1/{stress})", exactly(elastic.a0() / model.surface_shear))?;
            match model.exponent() {
                // In the unit of length that the model has of its own.
                Some(gamma) if scene.layer.base == Base::Infinite => {
                    let natural = scene.layer.length().ok().flatten().unwrap_or(1.0);
                    writeln!(text, "# gamma    = {}  (1/{length})", exactly(gamma / natural))?;
                }
                Some(gamma) => writeln!(text, "# gamma h  = {}", exactly(gamma))?,
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
        (Some(b), Some(h)) => writeln!(text, "# h/b      = {}", exactly(h / b)),
        (Some(b), None) => writeln!(text, "# b        = {}  ({length})", exactly(b)),
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
        ("flexibility", plan.flexibility, solver.flexibility.is_some()),
        ("kernel", plan.kernel, solver.kernel.is_some()),
        ("quadrature", plan.quadrature, solver.quadrature.is_some()),
    ];
    for (family, name, is_named) in methods {
        let by = if is_named { "named in the scene" } else { "chosen by the solver" };
        writeln!(text, "# {family:<12} {name} ({by})")?;
    }
    plan.reasons.iter().try_for_each(|reason| writeln!(text, "# {reason}"))?;
    engine::refusal(scene).map_or(Ok(()), |refusal| writeln!(text, "# It would be refused: {refusal}"))
}
