//! The layer in words: what it is made of, what its surface knows of it, and what its base means for the indentation.

use super::Known;
use crate::api::{Base, LayerModel, Moduli, ModulusLaw, exactly, rounded, short};
use crate::engine::DepthProfile;
use crate::scene::Scene;
use std::fmt::{Result, Write};

/// Terms of the surface series asked for: more than any kernel takes.
const TERMS: usize = 32;

/// Differences that are rounding.
const SAME: f64 = 1e-12;

pub(super) fn write(text: &mut String, scene: &Scene, known: &Known) -> Result {
    let [unit_of_length, _] = scene.units.names();
    writeln!(text, "\n# The layer.")?;
    match &known.depths {
        Ok(Some(profile)) => constants(text, scene, profile)?,
        Ok(None) => writeln!(text, "# modulus      the same at every depth")?,
        Err(refusal) => writeln!(text, "# refused: {refusal}")?,
    }
    if let Ok(model) = scene.layer.model() {
        model.law.remarks().iter().try_for_each(|remark| writeln!(text, "# note         {remark}"))?;
        surface(text, &model)?;
    }
    match &known.response {
        Ok(response) => match response.depth() {
            Some(depth) => {
                let (deep, unit) = match scene.layer.length() {
                    Ok(Some(length)) => (depth * length, unit_of_length),
                    _ => (depth, "natural length"),
                };
                let deep = short(deep);
                writeln!(
                    text,
                    "# felt below   d = {deep}  ({unit}): depth of the first base, jump or kink, or else over which the \
                     modulus changes; its share of the flexibility goes like exp(-2 s d), s the wave number"
                )?;
            }
            None => writeln!(text, "# felt below   nothing: s F is the same at every wave number")?,
        },
        Err(refusal) => writeln!(text, "# felt below   unknown: {refusal}")?,
    }
    base(text, scene)
}

/// Sublayers and ranges.
fn constants(text: &mut String, scene: &Scene, profile: &DepthProfile) -> Result {
    let stretches = match profile.stretches() {
        1 => "one smooth stretch".to_owned(),
        several => format!("{several} smooth stretches"),
    };
    match profile.sublayers {
        1 => writeln!(text, "# made of      {stretches}")?,
        several => writeln!(text, "# made of      {several} sublayers, {stretches}")?,
    }
    let [_, stress] = scene.units.names();
    let kind = match scene.layer.moduli {
        Moduli::Shear => "shear modulus",
        Moduli::Young => "Young's modulus",
    };
    let shown = if scene.layer.base == Base::Infinite { " as far as it is drawn" } else { "" };
    let (least, most) = profile.modulus_range();
    if most - least > SAME * most {
        writeln!(
            text,
            "# modulus      {} to {}  ({kind}, {stress}){shown}",
            free_of_roundings(least),
            free_of_roundings(most)
        )?;
    } else {
        writeln!(text, "# modulus      {} everywhere  ({kind}, {stress})", free_of_roundings(least))?;
    }
    let (least, most) = profile.poisson_range();
    if most - least > SAME {
        writeln!(text, "# poisson      {} to {}", free_of_roundings(least), free_of_roundings(most))?;
    }
    Ok(())
}

/// Without the roundings of the law's own arithmetic.
fn free_of_roundings(value: f64) -> String {
    rounded(value, 10)
}

/// How much the surface knows of what lies below.
fn surface(text: &mut String, model: &LayerModel) -> Result {
    let mut law: &dyn ModulusLaw = &*model.law;
    while let Some(top) = law.sublayers().first() {
        law = &*top.law;
    }
    let mut known = law.surface_series(TERMS).len();
    if law.poisson(0.0).is_some() {
        known = known.min(law.poisson_series(TERMS).len());
    }
    let derivatives = match known {
        TERMS.. => "all derivatives of the moduli known".to_owned(),
        0 | 1 => "no derivative known: the kernel's jump and logarithm are taken from values".to_owned(),
        2 => "1 derivative known".to_owned(),
        several => format!("{} derivatives known", several - 1),
    };
    writeln!(text, "# surface      {derivatives}")
}

/// What the base means for the depth of the punch.
fn base(text: &mut String, scene: &Scene) -> Result {
    let (what, moves) = match scene.layer.base {
        Base::Rigid => ("bonded to a rigid base", false),
        Base::Frictionless => ("on a frictionless rigid base", false),
        Base::HalfPlane { .. } => ("bonded to an elastic half-plane", true),
        Base::Infinite => ("none, the solid goes on for ever", true),
    };
    let softens = scene.layer.law().is_ok_and(|law| law.exponent().is_some_and(|gradient| gradient < 0.0));
    match (moves, scene.layer.datum) {
        (true, _) if scene.layer.base == Base::Infinite && softens => {
            writeln!(text, "# base         {what} and softens: it bears no load")
        }
        (false, _) => writeln!(text, "# base         {what}: the indentation is counted from it"),
        (true, None) if scene.layer.has_depths() => {
            writeln!(text, "# base         {what} and stiffens: the indentation is counted from far below")
        }
        (true, Some(datum)) => {
            let [length, _] = scene.units.names();
            writeln!(
                text,
                "# base         {what}: the indentation is counted from depth {}  ({length})",
                exactly(datum.get())
            )
        }
        (true, None) => {
            writeln!(text, "# base         {what}: without a datum the indentation is undefined")
        }
    }
}
