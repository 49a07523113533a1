//! The scene in one line.

use crate::engine::DepthProfile;
use crate::report::labels::{Labels, one_line, with_unit};
#[cfg(feature = "plot")]
use crate::report::number::typeset;
use crate::report::number::{digits, trimmed};
use crate::scene::{Layer, Load, Scene};
use serde_json::Value;
use slipzone_api::{Base, Family, Friction, PunchProfile, clip};

/// Letters for the field's symbols, and how numbers are set.
pub(super) struct Alphabet {
    /// Modulus: everywhere, at the surface, at the base.
    shear: [&'static str; 3],
    young: [&'static str; 3],
    gamma: &'static str,
    nu: &'static str,
    eta: &'static str,
    delta: &'static str,
    typeset: fn(&str) -> String,
}

/// For terminals and logs.
pub(super) const ASCII: Alphabet = Alphabet {
    shear: ["mu", "mu1", "mu3"],
    young: ["E", "E1", "E3"],
    gamma: "gamma",
    nu: "nu",
    eta: "eta",
    delta: "delta",
    typeset: str::to_owned,
};
/// For figures.
#[cfg(feature = "plot")]
pub(super) const GREEK: Alphabet =
    Alphabet {
        shear: ["µ", "µ₁", "µ₃"], young: ["E", "E₁", "E₃"], gamma: "γ", nu: "ν", eta: "η", delta: "δ", typeset
    };

/// Of most numbers of the line.
const DIGITS: usize = 4;

impl Alphabet {
    /// A number of the line, with few digits: it reminds, it is not data.
    fn number(&self, value: f64) -> String {
        (self.typeset)(&trimmed(value, DIGITS))
    }

    /// Poisson's ratio: one just below that of incompressible materials has the digits that say so.
    fn ratio(&self, nu: f64) -> String {
        (self.typeset)(&trimmed(nu, DIGITS.max(digits(2.0 * (0.5 - nu)))))
    }
}

/// A scene in one line of plain text, before it is solved.
pub fn scene_line(scene: &Scene) -> String {
    scene_parts(scene, None, &ASCII).join(", ")
}

/// The scene's parts, widest meaning first: geometry, material, base, punch, friction, load; the thickness in units of
/// a half-width where there is one.
pub(super) fn scene_parts(scene: &Scene, half_width: Option<f64>, letters: &Alphabet) -> Vec<String> {
    let labels = Labels::new(&scene.units);
    let mut parts = parts_but_load(scene, half_width, letters);
    let (symbol, value, unit) = match &scene.load {
        Load::Force(v) => ("P", v, &labels.force),
        Load::HalfWidth(v) => ("b", v, &labels.length),
        Load::Indentation(v) => (letters.delta, v, &labels.length),
    };
    parts.push(format!("{symbol} = {}", with_unit(&letters.number(value.get()), unit)));
    parts
}

/// The same parts but those that change on the way to the load.
#[cfg(feature = "plot")]
pub(super) fn constant_parts(scene: &Scene, letters: &Alphabet) -> Vec<String> {
    let fixed = scene.punch.shape().ok().and_then(|shape| shape.fixed_half_width());
    parts_but_load(scene, fixed, letters)
}

/// What the scene's solid is: thickness, material and base.
pub(super) fn layer_parts(scene: &Scene, half_width: Option<f64>, letters: &Alphabet) -> Vec<String> {
    let labels = Labels::new(&scene.units);
    let mut parts = layer(&scene.layer, half_width, &labels, letters);
    parts.push(poisson(&scene.layer, letters));
    parts.push(scene.layer.plane.words().into());
    parts.push(base(&scene.layer, &labels, letters));
    parts
}

fn parts_but_load(scene: &Scene, half_width: Option<f64>, letters: &Alphabet) -> Vec<String> {
    let labels = Labels::new(&scene.units);
    let mut parts = layer_parts(scene, half_width, letters);
    parts.push(punch(&*scene.punch, &labels, letters));
    parts.push(match &scene.friction {
        None => "frictionless".into(),
        Some(Friction::Goodman { coefficient, .. }) => {
            format!("{} = {}", letters.eta, letters.number(coefficient.get()))
        }
    });
    parts
}

/// Thickness and how the modulus varies.
fn layer(layer: &Layer, half_width: Option<f64>, labels: &Labels, letters: &Alphabet) -> Vec<String> {
    let mut parts = Vec::new();
    if let Some(h) = layer.thickness {
        parts.push(match half_width {
            Some(b) => format!("h/b = {}", letters.number(h.get() / b)),
            None => format!("h = {}", with_unit(&letters.number(h.get()), &labels.length)),
        });
    }
    let kind = layer.grading.typetag_name();
    // A law that cannot be had (that may be why the scene was refused) still has a name.
    let Ok(law) = layer.law() else {
        parts.push(kind.into());
        return parts;
    };
    let [mu, mu1, mu3] = if layer.moduli.is_shear() { letters.shear } else { letters.young };
    let surface = with_unit(&letters.number(law.surface_modulus()), &labels.stress);
    match (law.exponent(), layer.thickness) {
        (Some(0.0), _) => parts.push(format!("{kind}, {mu} = {surface}")),
        (_, Some(_)) => {
            let ratio = law.surface_modulus() / law.modulus(1.0);
            parts.push(format!("{kind}, {mu1} = {surface}, {mu1}/{mu3} = {}", fraction(ratio, letters)));
        }
        (Some(gamma), None) => {
            let per_length = if labels.length.is_empty() { String::new() } else { format!(" /{}", labels.length) };
            parts.push(format!("{kind}, {mu1} = {surface}, {} = {}{per_length}", letters.gamma, letters.number(gamma)));
        }
        (None, None) => parts.push(format!("{kind}, {mu1} = {surface}")),
    }
    parts
}

/// Poisson's ratio, or from where to where it goes where the grading has it vary.
fn poisson(layer: &Layer, letters: &Alphabet) -> String {
    /// Differences that are rounding.
    const SAME: f64 = 1e-9;
    let varies = layer.law().is_ok_and(|law| law.poisson(0.0).is_some() || !law.sublayers().is_empty());
    let profile = if varies { DepthProfile::new(layer).ok().flatten() } else { None };
    let given = layer.poisson.get();
    let (least, most) = profile.map_or((given, given), |profile| profile.poisson_range());
    let range = if most - least > SAME { format!(" to {}", letters.ratio(most)) } else { String::new() };
    format!("{} = {}{range}", letters.nu, letters.ratio(least))
}

/// A ratio, as `1/8` where that is what it is: so it stands in the literature.
fn fraction(ratio: f64, letters: &Alphabet) -> String {
    let inverse = ratio.recip();
    // Moduli given with rounding still make a whole number.
    let whole = (inverse - inverse.round()).abs() < 1e-9 * inverse;
    if inverse > 1.5 && inverse < 1e4 && whole { format!("1/{inverse:.0}") } else { letters.number(ratio) }
}

fn base(layer: &Layer, labels: &Labels, letters: &Alphabet) -> String {
    match layer.base {
        Base::Rigid => "bonded to a rigid base".into(),
        Base::Frictionless => "on a frictionless rigid base".into(),
        Base::HalfPlane { shear, poisson } => {
            let (shear, nu) = (shear.get(), poisson.get());
            let symbol = if layer.moduli.is_shear() { letters.shear[0] } else { letters.young[0] };
            let modulus = with_unit(&letters.number(layer.moduli.of_shear(shear, nu)), &labels.stress);
            format!("bonded to a half-plane ({symbol} = {modulus}, {} = {})", letters.nu, letters.ratio(nu))
        }
        Base::Infinite => "half-plane".into(),
    }
}

/// Characters of a text such as a formula that fit into a line.
const LONGEST: usize = 60;

/// Numbers of a list that fit into a line.
const FEW: usize = 6;

/// The punch by its `type` and those of its keys that fit into a line.
fn punch(punch: &dyn PunchProfile, labels: &Labels, letters: &Alphabet) -> String {
    let kind = punch.typetag_name();
    let name = format!("{kind} punch");
    let parameters = slipzone_api::find(Family::Punch, kind).map_or(&[][..], |plugin| plugin.parameters);
    let is_length = |key: &str| parameters.iter().any(|parameter| parameter.name == key && parameter.is_length());
    let Ok(Value::Object(table)) = serde_json::to_value(punch) else { return name };
    let shown = |(key, value): (&String, &Value)| match value {
        // Named parameters go by their own names.
        Value::Object(parameters) => {
            let each = |(name, value): (&String, &Value)| Some(format!("{name} = {}", letters.number(value.as_f64()?)));
            let each: Option<Vec<_>> = parameters.iter().map(each).collect();
            each.filter(|each| each.len() <= FEW && !each.is_empty()).map(|each| each.join(", "))
        }
        Value::Array(values) if values.iter().any(Value::is_array) => Some(format!("{} {key}", values.len())),
        Value::Array(values) => {
            let each: Option<Vec<_>> = values.iter().map(|value| Some(letters.number(value.as_f64()?))).collect();
            each.filter(|each| each.len() <= FEW).map(|each| format!("{key} = [{}]", each.join(", ")))
        }
        // A unit of 1 goes without saying.
        Value::Number(number) if key.ends_with("_unit") && number.as_f64() == Some(1.0) => None,
        Value::Number(number) => {
            let unit = if is_length(key) { &labels.length } else { "" };
            Some(format!("{} = {}", key.replace('_', "-"), with_unit(&letters.number(number.as_f64()?), unit)))
        }
        Value::String(text) if key != "type" => {
            Some(format!("{} = {}", key.replace('_', "-"), clip(&one_line(text), LONGEST)))
        }
        _ => None,
    };
    let keys: Vec<_> = table.iter().filter_map(shown).collect();
    if keys.is_empty() { name } else { format!("{name} ({})", keys.join(", ")) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::Solution;
    use crate::report::samples;

    #[test]
    fn one_line_says_it_all() {
        let line = |solution: &Solution| scene_parts(&solution.scene, solution.load.half_width, &ASCII).join(", ");
        assert_eq!(
            line(&samples::flat_with_friction()),
            "h/b = 5, exponential, mu1 = 1 MPa, mu1/mu3 = 1/8, nu = 0.3, plane strain, bonded to a rigid base, \
             flat punch (half-width = 1 mm), eta = 0.3, P = 1 N/mm"
        );
        assert_eq!(
            line(&samples::cylinder_without_friction()),
            "homogeneous, mu = 1, nu = 0.3, plane strain, half-plane, cylinder punch (radius = 10), frictionless, b = 1"
        );
    }

    #[test]
    fn a_layer_is_described_as_the_scene_gives_it() {
        crate::link_plugins();
        let line = |layer: &str| {
            let text = format!(
                "format = 1\npunch = {{ type = 'flat', half_width = 1.0 }}\nload = {{ force = 1.0 }}\n\
                 [layer]\npoisson = 0.3\n{layer}"
            );
            let layer = crate::scene::parse("line", &text).unwrap_or_else(|e| panic!("{e}")).layer;
            let labels = Labels::new(&crate::scene::Units::default());
            format!("{}, {}", poisson(&layer, &ASCII), base(&layer, &labels, &ASCII))
        };
        let stack = |poisson: &str| {
            format!(
                "grading = {{ type = 'stack', layers = [\
                 {{ thickness = 1.0, grading = {{ type = 'homogeneous', modulus = 2.0 }} }}, \
                 {{ thickness = 1.0, {poisson} grading = {{ type = 'homogeneous', modulus = 1.0 }} }}] }}"
            )
        };
        let steel = "base = { type = 'half-plane', young = 210.0, poisson = 0.25 }\n";
        assert_eq!(
            line(&format!("{steel}moduli = 'young'\n{}", stack("poisson = 0.2,"))),
            "nu = 0.2 to 0.3, bonded to a half-plane (E = 210, nu = 0.25)"
        );
        assert_eq!(line(&format!("{steel}{}", stack(""))), "nu = 0.3, bonded to a half-plane (mu = 84, nu = 0.25)");
        let rubber = "base = { type = 'half-plane', shear = 1.0, poisson = 0.499999 }\n";
        let told = line(&format!("{rubber}{}", stack("poisson = 0.5,")));
        assert_eq!(told, "nu = 0.3 to 0.5, bonded to a half-plane (mu = 1, nu = 0.499999)", "it is not incompressible");
    }

    #[test]
    fn punches_of_many_numbers_stay_in_line() {
        crate::link_plugins();
        let line = |text: &str| {
            let text = format!(
                "format = 1\npunch = {text}\nload = {{ force = 1.0 }}\n[layer]\nthickness = 1.0\npoisson = 0.3\n\
                 grading = {{ type = 'homogeneous', modulus = 1.0 }}"
            );
            let scene = crate::scene::parse("line", &text).unwrap_or_else(|e| panic!("{e}"));
            punch(&*scene.punch, &Labels::new(&scene.units), &ASCII)
        };
        assert_eq!(
            line("{ type = 'polynomial', coefficients = [0.05, 0.001] }"),
            "polynomial punch (coefficients = [0.05, 0.001])"
        );
        let points = "[[0.0, 0.0], [1.0, 0.05], [2.0, 0.2], [3.0, 0.45]]";
        assert_eq!(line(&format!("{{ type = 'table', points = {points} }}")), "table punch (4 points)");
        #[cfg(feature = "formula")]
        {
            assert_eq!(
                line("{ type = 'formula', height = 'x^2/(2*R)', parameters = { R = 10.0 } }"),
                "formula punch (height = x^2/(2*R), R = 10)"
            );
            let long = format!("x^2{}", " + 0.1*x^4".repeat(20));
            let shown = line(&format!("{{ type = 'formula', height = '{long}' }}"));
            assert!(shown.len() < 100 && shown.ends_with("...)"), "{shown}");
        }
    }

    #[test]
    fn ratios_read_as_in_the_literature() {
        assert_eq!(
            [0.125, 1.0 / 3.0, 8.0, 1.0, 0.7].map(|ratio| fraction(ratio, &ASCII)),
            ["1/8", "1/3", "8", "1", "0.7"]
        );
    }
}
