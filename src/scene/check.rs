//! What no single key can show to be wrong.

use super::decode::wrong_type;
use super::document::{Document, dotted, number, one_of, owned};
use super::error::{Kind, SceneError};
use super::keys::{ABSCISSAE, LISTED, LONGEST_LABEL, MOST_FRICTION, POINTS, STAND_INS, TOLERANCES};
use super::{Load, Model, Scene};
use crate::caught::caught;
use slipzone_api::{Base, Friction, LawFlaw, MODERATE, PunchShape, Refusal, short};
use std::ops::Range;
use toml::Spanned;
use toml::de::DeValue;

type Check = fn(&Document, &Scene) -> Result<(), SceneError>;

/// All checks; the first that fails.
pub(super) fn all(document: &Document, scene: &Scene) -> Result<(), SceneError> {
    // Those of the others are looked at before their files are read.
    const MAGNITUDES: Check = |document, _| magnitudes(document, &["friction", "load", "solver"]);
    const CHECKS: [Check; 12] =
        [labels, friction, tolerance, models, output, quantities, MAGNITUDES, thickness, grading, datum, load, ratios];
    // A plugin that panics is told of where the scene is solved.
    CHECKS.iter().try_for_each(|check| caught(|| check(document, scene)).unwrap_or(Ok(())))
}

/// What the engine relies on of a scene, told by a few comparisons: all that is checked of one that was parsed, and one
/// that was made in code may not keep to.
pub(crate) fn bounds(scene: &Scene) -> Result<(), Refusal> {
    let Scene { format, layer, friction, load, path, solver, output, .. } = scene;
    let is_listed = |x: &Vec<f64>| LISTED.contains(&x.len()) && x.iter().all(|x| ABSCISSAE.contains(x));
    let are_placed = output.x.as_ref().map_or(POINTS.contains(&output.points), is_listed);
    let rubs = |Friction::Goodman { coefficient, .. }| (*MODERATE.start()..=MOST_FRICTION).contains(&coefficient.get());
    let lengths = layer.thickness.into_iter().chain(layer.datum).all(|length| in_scale(length.get()));
    let is_forbidden = |model: &Model| *model == Model::Full || solver.model == Some(*model);
    let kept = [
        ("format", *format == 1),
        ("solver.tolerance", TOLERANCES.contains(&solver.tolerance.get())),
        ("solver.forbid", !solver.forbid.iter().any(is_forbidden)),
        (if output.x.is_some() { "output.x" } else { "output.points" }, are_placed),
        ("layer", lengths),
        ("layer.thickness", layer.thickness.is_some() || layer.base == Base::Infinite),
        ("friction.coefficient", friction.is_none_or(rubs)),
        ("load.path", path.as_ref().is_none_or(|path| in_scale(path.load(0).value().get()))),
    ];
    let broken = kept.iter().find(|(_, is_kept)| !is_kept).map(|(key, _)| *key);
    broken.map_or_else(|| bounded(*load), |key| Err(beyond(key)))
}

/// The same of a load alone.
pub(crate) fn bounded(load: Load) -> Result<(), Refusal> {
    if in_scale(load.value().get()) { Ok(()) } else { Err(beyond("load")) }
}

/// A scene that no text could describe.
fn beyond(key: &str) -> Refusal {
    let why = format!("`{key}` of this scene is outside of what a scene may hold");
    Refusal::Limit { why, remedy: "`Scene::check` tells what is allowed" }
}

/// Text that goes into reports and figures.
fn labels(document: &Document, scene: &Scene) -> Result<(), SceneError> {
    let labels: [(&[&str], &Option<String>); 3] = [
        (&["title"], &scene.title),
        (&["units", "length"], &scene.units.length),
        (&["units", "stress"], &scene.units.stress),
    ];
    for (path, label) in labels {
        let Some(label) = label else { continue };
        let length = label.chars().count();
        if length > LONGEST_LABEL {
            let error = document.error(document.key(path), format!("`{}` is too long", path.join(".")));
            return Err(error.found(format!("{length} characters")).expected(format!("at most {LONGEST_LABEL}")));
        }
        printable(document, (path, document.key(path)), (label, "one line of printable text"), &[])?;
    }
    Ok(())
}

/// A text that is to be printed holds no control character but those allowed.
pub(crate) fn printable(
    document: &Document,
    (path, place): (&[&str], Range<usize>),
    (text, expected): (&str, &str),
    allowed: &[char],
) -> Result<(), SceneError> {
    let Some(control) = text.chars().find(|c| c.is_control() && !allowed.contains(c)) else { return Ok(()) };
    let error = document.error(place, format!("`{}` holds a control character", dotted(path)));
    Err(error.found(format!("`{}`", control.escape_debug())).expected(expected))
}

/// Products of a few numbers, of some sections, must neither overflow nor vanish.
pub(super) fn magnitudes(document: &Document, sections: &[&str]) -> Result<(), SceneError> {
    sections.iter().try_for_each(|section| {
        document.each_within(&[section], |path, value| match number(value) {
            // Poisson's ratio has no unit, and may be as near to zero as one likes. What is no finite number is told
            // where it is read.
            Some(number) if number.is_finite() && !in_scale(number) && path[1..].iter().all(|key| key != "poisson") => {
                let path: Vec<_> = path.iter().map(String::as_str).collect();
                let sign = if number < 0.0 { ", or its negative" } else { "" };
                Err(document
                    .not_allowed(&path, format!("a number between 1e-100 and 1e100{sign}"))
                    .hint("choose units in which the numbers are moderate"))
            }
            _ => Ok(()),
        })
    })
}

/// Whether a number is 0 (then its type has its say) or of a size that can be computed with.
fn in_scale(number: f64) -> bool {
    number == 0.0 || MODERATE.contains(&number.abs())
}

/// A layer has a thickness; a solid without a base has none.
fn thickness(document: &Document, scene: &Scene) -> Result<(), SceneError> {
    match (scene.layer.base, scene.layer.thickness) {
        (Base::Infinite, Some(_)) => Err(document
            .error(document.key(&["layer", "thickness"]), "a thickness on a solid without a base")
            .found("`thickness` beside `base = { type = \"infinite\" }`")
            .expected("one of the two")
            .hint("leave out `thickness`, or choose a base at that depth")),
        (Base::Infinite, None) | (_, Some(_)) => Ok(()),
        (_, None) => Err(document
            .error(document.key(&["layer"]), "missing key `thickness` in [layer]")
            .of_kind(Kind::MissingKey(owned(&["layer"])))
            .found("a layer on a base without its thickness")
            .expected("`thickness`: depth of the base (length)")
            .hint("a solid without a base is `base = { type = \"infinite\" }`")),
    }
}

/// The grading describes an elastic solid over the whole layer.
fn grading(document: &Document, scene: &Scene) -> Result<(), SceneError> {
    let layer = &scene.layer;
    if let (Some(own), Some(given)) = (layer.grading.thickness(), layer.thickness)
        && (given.get() / own.get() - 1.0).abs() > SAME
    {
        return Err(document
            .not_allowed(
                &["layer", "thickness"],
                format!("{}, the thickness of its grading (of a stack, the sum over its sublayers)", own.get()),
            )
            .hint("leave out `thickness`: the grading knows its own"));
    }
    match layer.model() {
        Ok(model) => match model.flaw() {
            Some(flaw) => Err(no_solid(document, flaw, layer.length().ok().flatten().unwrap_or(1.0))),
            None => Ok(()),
        },
        Err(Refusal::Unusable { plugin, why }) => {
            let error = of_grading(document, format!("the grading `{plugin}` does not fit the layer"));
            let (found, hint) = why.split_once("; ").map_or((why.as_str(), None), |(found, hint)| (found, Some(hint)));
            let error = error.found(found).expected("a finite modulus above 0 at every depth down to the base");
            Err(hint.into_iter().fold(error, SceneError::hint))
        }
        // What is not built is the engine's to refuse.
        Err(_) => Ok(()),
    }
}

/// That a law, over a layer of that thickness, gives no elastic solid.
fn no_solid(document: &Document, flaw: LawFlaw, thickness: f64) -> SceneError {
    let (what, first, depth) = match flaw {
        LawFlaw::Contract(what) => {
            let error = of_grading(document, "the grading breaks the contract of gradings");
            return error.found(what).expected("a law that is what it tells of itself");
        }
        LawFlaw::Modulus { modulus, depth } => (format!("the modulus is {}", short(modulus)), "modulus", depth),
        LawFlaw::Poisson { ratio, depth } => (format!("Poisson's ratio is {ratio}"), "poisson", depth),
    };
    let depth = depth * thickness;
    let (path, own) = culprit(document, Some(depth), first);
    let path: Vec<&str> = path.iter().map(String::as_str).collect();
    let within = if path.len() > 3 { format!(", {} below its sublayer's top", short(own)) } else { String::new() };
    document
        .error(document.best(&path), "the grading describes no elastic solid")
        .found(format!("{what} at depth {}{within}", short(depth)))
        .expected("a finite modulus above 0, and a Poisson's ratio above -1 and up to 0.5, at every depth")
}

/// An error of the grading as a whole.
fn of_grading(document: &Document, message: impl Into<String>) -> SceneError {
    let (path, _) = culprit(document, None, "modulus");
    let path: Vec<&str> = path.iter().map(String::as_str).collect();
    document.error(document.best(&path), message)
}

/// What gives the constants at a depth: a key of the grading, or of the sublayer there; and the depth in that. Without
/// a depth, a key of the grading itself. Of its keys the `first` if it is there, or what holds all constants.
fn culprit(document: &Document, depth: Option<f64>, first: &'static str) -> (Vec<String>, f64) {
    let mut own = depth.unwrap_or_default();
    let mut path = vec!["layer".to_owned(), "grading".to_owned()];
    loop {
        let here: Vec<&str> = path.iter().map(String::as_str).collect();
        let Some(table) = document.table(&here) else { return (path, own) };
        let layers = table.get("layers").and_then(|layers| layers.get_ref().as_array()).filter(|_| depth.is_some());
        let Some(layers) = layers else {
            let key = [first, "points", "file", "layers"].into_iter().find(|key| table.contains_key(*key));
            path.extend(key.map(str::to_owned));
            return (path, own);
        };
        let mut index = 0;
        for layer in layers.iter().take(layers.len().saturating_sub(1)) {
            let thickness = layer.get_ref().get("thickness").and_then(|value| number(value.get_ref()));
            let Some(thickness) = thickness.filter(|thickness| own >= *thickness) else { break };
            own -= thickness;
            index += 1;
        }
        path.extend(["layers".to_owned(), index.to_string(), "grading".to_owned()]);
    }
}

/// Largest relative difference between a stack's thickness as given and as summed: roundings of decimals.
const SAME: f64 = 1e-9;

/// A datum is asked for where the base leaves the indentation undefined.
fn datum(document: &Document, scene: &Scene) -> Result<(), SceneError> {
    if scene.layer.datum.is_some() && scene.layer.is_grounded() {
        return Err(document
            .error(document.key(&["layer", "datum"]), "a datum where the indentation is defined already")
            .found("`datum` over a base that does not move, or a solid that stiffens without end")
            .expected("no `datum`: the indentation is counted from the base, or from far below")
            .hint("it is for `half-plane` bases and homogeneous `infinite` solids"));
    }
    Ok(())
}

/// Loads that mean nothing for this punch or this base.
fn load(document: &Document, scene: &Scene) -> Result<(), SceneError> {
    // A shape that cannot be built is the engine's to refuse.
    let key = scene.load.kind().key();
    let place = scene.path.as_ref().map_or_else(|| vec!["load", key], |path| vec!["load", path.key(), key]);
    let shape = scene.punch.shape().ok();
    let fixed = shape.as_ref().and_then(|shape| shape.fixed_half_width());
    let face = shape.as_ref().map_or(0.0, |shape| shape.face());
    let reach = shape.as_ref().and_then(|shape| shape.reach()).unwrap_or(f64::INFINITY);
    let smallest = scene.path.as_ref().map_or(scene.load, |path| path.load(0)).value().get();
    let hole = match (&shape, scene.load) {
        (Some(shape), Load::HalfWidth(b)) => without_height(&**shape, b.get()),
        _ => None,
    };
    match scene.load {
        Load::HalfWidth(_) if fixed.is_some() => Err(document
            .error(document.key(&place), "a half-width as load on a punch whose contact is fixed")
            .found("`half_width`, which the punch itself sets")
            .expected("`force` or `indentation`")
            .hint("press it with `force = ...`; its width is `punch.half_width`")),
        Load::HalfWidth(b) if b.get() > reach => Err(document
            .not_allowed(&place, format!("at most {reach}, where the punch's table ends"))
            .hint("give the table rows further out, or a smaller load")),
        Load::HalfWidth(b) if smallest <= face && b.get() > face => Err(document
            .not_allowed(&place, format!("loads above {face} from the first on, the half-width of the punch's flat face"))
            .hint(format!(
                "the first of the loads on the way is {smallest}; to begin at another list them: `path = {{ half_width = [...] }}`"
            ))),
        Load::HalfWidth(_) if smallest <= face => Err(document
            .not_allowed(&place, format!("above {face}, the half-width of the punch's flat face"))
            .hint("the contact is as wide as the face before there is any load")),
        Load::HalfWidth(_) if hole.is_some() => {
            Err(document.not_allowed(&place, "a contact within which the punch has a height everywhere").hint(format!(
                "at x = {} it has none: a division by zero, or a root of a negative number?",
                hole.unwrap_or_default()
            )))
        }
        Load::Indentation(_) if !scene.layer.has_depths() => Err(document
            .error(document.key(&place), "an indentation on an elastic half-plane")
            .found("`indentation`, which is undefined there: it grows without bound with the depth of the datum")
            .expected(if fixed.is_some() { "`force`" } else { "`force` or `half_width`" })
            .hint("or name a depth that counts as at rest: `datum` in [layer]")),
        _ => Ok(()),
    }
}

/// A point under a contact of that half-width at which the punch is not defined, of those where that is likely.
fn without_height(shape: &dyn PunchShape, half_width: f64) -> Option<f64> {
    let inside = shape.kinks().iter().copied().filter(|kink| *kink < half_width);
    inside.chain([half_width]).find(|&x| !shape.height(x).is_finite())
}

fn friction(document: &Document, scene: &Scene) -> Result<(), SceneError> {
    const LEAST: f64 = *MODERATE.start();
    match scene.friction {
        Some(Friction::Goodman { coefficient, .. }) if !(LEAST..=MOST_FRICTION).contains(&coefficient.get()) => {
            Err(document
                .not_allowed(&["friction", "coefficient"], format!("a number between {LEAST:e} and {MOST_FRICTION}"))
                .hint("common coefficients lie between 0.05 and 1.5"))
        }
        _ => Ok(()),
    }
}

fn tolerance(document: &Document, scene: &Scene) -> Result<(), SceneError> {
    if TOLERANCES.contains(&scene.solver.tolerance.get()) {
        return Ok(());
    }
    Err(document
        .not_allowed(
            &["solver", "tolerance"],
            format!("a number between {:?} and {:?}", TOLERANCES.start(), TOLERANCES.end()),
        )
        .hint("it is relative: 1e-6 asks for six digits"))
}

/// What is forced is not forbidden, and something is left.
fn models(document: &Document, scene: &Scene) -> Result<(), SceneError> {
    let forbidden = &scene.solver.forbid;
    let at = |index: usize| index.to_string();
    if let Some(index) = forbidden.iter().position(|model| *model == Model::Full) {
        return Err(document
            .not_allowed(&["solver", "forbid", &at(index)], one_of(&STAND_INS))
            .hint("the full model is what is left where no other is near enough; `model` forces another"));
    }
    if let Some(index) = (1..forbidden.len()).find(|index| forbidden[..*index].contains(&forbidden[*index])) {
        return Err(document.not_allowed(&["solver", "forbid", &at(index)], "each model once"));
    }
    let forced = forbidden.iter().position(|model| Some(*model) == scene.solver.model);
    forced.map_or(Ok(()), |index| {
        Err(document
            .not_allowed(&["solver", "forbid", &at(index)], "a model other than `solver.model`, which forces it"))
    })
}

/// How many samples are asked for: before it is decoded, which knows of no range.
pub(super) fn points(document: &Document) -> Result<(), SceneError> {
    let place = ["output", "points"];
    let expected = format!("an integer from {} to {}", POINTS.start(), POINTS.end());
    match document.value(&place).map(Spanned::get_ref) {
        None => Ok(()),
        Some(DeValue::Integer(integer)) => {
            let points = usize::from_str_radix(integer.as_str(), integer.radix());
            if points.is_ok_and(|points| POINTS.contains(&points)) {
                Ok(())
            } else {
                Err(document.not_allowed(&place, expected))
            }
        }
        Some(_) => Err(wrong_type(document, &place, &expected).of_kind(Kind::NotWhole)),
    }
}

fn output(document: &Document, scene: &Scene) -> Result<(), SceneError> {
    let Some(x) = &scene.output.x else { return Ok(()) };
    let (from, to) = (ABSCISSAE.start(), ABSCISSAE.end());
    if !LISTED.contains(&x.len()) {
        let expected = format!("from {} to {} numbers from {from} to {to}", LISTED.start(), LISTED.end());
        return Err(document.not_allowed(&["output", "x"], expected));
    }
    // Written so that NaN is outside.
    match x.iter().position(|x| !ABSCISSAE.contains(x)) {
        None => Ok(()),
        Some(index) => Err(document
            .not_allowed(&["output", "x", &index.to_string()], format!("a number from {from} to {to}"))
            .hint("`x` is in units of the contact's half-width")),
    }
}

/// Something is asked for, nothing twice, and the strain only along a profile.
fn quantities(document: &Document, scene: &Scene) -> Result<(), SceneError> {
    const PLACE: [&str; 2] = ["output", "quantities"];
    let Some(asked) = &scene.output.quantities else { return Ok(()) };
    if asked.is_empty() {
        return Err(document
            .not_allowed(&PLACE, "at least one quantity")
            .hint("left out, `quantities` asks for everything"));
    }
    let twice = (1..asked.len()).find(|index| asked[..*index].contains(&asked[*index]));
    if let Some(index) = twice {
        return Err(document.not_allowed(&[&PLACE[..], &[&index.to_string()]].concat(), "each quantity once"));
    }
    if scene.output.strain && !scene.output.asks("profile") {
        return Err(document
            .error(document.key(&["output", "strain"]), "a strain without the profile that it belongs to")
            .found("`strain = true` beside `quantities` without `profile`")
            .expected("`profile` among the quantities, or no `strain`"));
    }
    Ok(())
}

/// Lengths must be comparable: beyond these ratios no digit of the smaller one is left.
fn ratios(document: &Document, scene: &Scene) -> Result<(), SceneError> {
    let last = match document.value(&["load", "path", "half_width"]).map(Spanned::get_ref) {
        Some(DeValue::Array(path)) => path.len().saturating_sub(1).to_string(),
        _ => String::new(),
    };
    let places: [&[&str]; 8] = [
        &["layer", "thickness"],
        &["punch", "half_width"],
        &["punch", "radius"],
        &["load", "half_width"],
        &["load", "until", "half_width"],
        // Those between are between.
        &["load", "path", "half_width", "0"],
        &["load", "path", "half_width", &last],
        &["layer", "datum"],
    ];
    let mut lengths: Vec<(&[&str], f64, String)> = Vec::new();
    if let (Some(thickness), None) = (scene.layer.thickness, document.value(places[0])) {
        // Of a stack.
        lengths.push((
            &["layer", "grading"],
            thickness.get(),
            format!("the thickness of the stack, which is {:?}", thickness.get()),
        ));
    }
    lengths.extend(places.into_iter().filter_map(|path| {
        let length = document.value(path).and_then(|value| number(value.get_ref()))?;
        Some((path, length, format!("`{}`, which is {}", dotted(path), document.found(path))))
    }));
    for (index, (path, length, _)) in lengths.iter().enumerate() {
        for (_, reference, named) in &lengths[..index] {
            if !(1e-9..=1e9).contains(&(length / reference)) {
                return Err(document
                    .not_allowed(path, format!("between 1e-9 and 1e9 times {named}"))
                    .hint("are both in the same unit? A layer without end is `base = { type = \"infinite\" }`"));
            }
        }
    }
    Ok(())
}
