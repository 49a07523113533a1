//! A modulus given by a formula.

use crate::{cuts, thickness};
use serde::{Deserialize, Serialize};
use slipzone_api::taylor::Taylor;
use slipzone_api::{Fault, Files, Grading, ModulusLaw, Refusal, Setting, Values, short};
use slipzone_formula as formula;
use std::collections::BTreeMap;

/// The modulus as a formula in the depth `y` (in the user's unit), in `h`, the layer's thickness, and in named
/// parameters, and so the Poisson's ratio, where it is given; see [`slipzone_formula`] for what may stand in it.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Formula {
    /// Formula for the modulus.
    pub modulus: String,
    /// Formula for Poisson's ratio; left out, it is the layer's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub poisson: Option<String>,
    /// Values of the names in both.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub parameters: BTreeMap<String, f64>,
}

slipzone_api::register!(Grading, "formula", "modulus by a formula in y with named parameters",
    also: ["function", "expression", "custom"],
    example: "type = \"formula\"\nmodulus = \"m*(1 + (y/h)^2)\"\npoisson = \"0.3 - 0.1*y/h\"\nparameters = { m = 2.0 }",
    parameters: [
        ("modulus", "formula (stress) in the depth `y` and the thickness `h` (length)", true, [], Text),
        ("poisson", "formula for Poisson's ratio; left out, it is the layer's", false, [], Text),
        ("parameters", "values of the names in the formulas", false, [], ByName(&Values::Number)),
    ],
    source: "docs/plugins.md");

/// The most kinks that are told of.
const MOST_KINKS: usize = 1000;

/// Depths at which what stands for a formula is compared with it: a film as thin as one of so many parts is seen even
/// if nothing in the formula tells of it. They are shifted by a part that nobody puts a jump at.
const PROBES: u32 = 256;
const SHIFT: f64 = 0.618_034;

impl Formula {
    /// The formula for the modulus, and that for Poisson's ratio if there is one, over a layer of some thickness.
    fn understood(&self, thickness: f64) -> Result<Vec<formula::Formula>, Fault> {
        let poisson = self.poisson.as_deref().map(|text| ("poisson", text));
        let texts: Vec<_> = std::iter::once(("modulus", self.modulus.as_str())).chain(poisson).collect();
        formula::Formula::parse_each(&texts, "y", &self.parameters, &[("h", thickness)]).map_err(|fault| {
            let is_thickness = fault.path == ["parameters", "h"];
            if is_thickness { fault.hint("`h` is the layer's thickness: leave the parameter out") } else { fault }
        })
    }
}

#[typetag::serde(name = "formula")]
impl Grading for Formula {
    fn read(&mut self, _files: &dyn Files) -> Result<(), Fault> {
        // Nothing but a divisor that happens to vanish depends on the thickness: one that nobody writes.
        self.understood(std::f64::consts::SQRT_2).map(|_| ())
    }

    fn law(&self, setting: &Setting) -> Result<Box<dyn ModulusLaw>, Refusal> {
        let thickness = thickness::of(setting, "a grading by a formula")?;
        let formulas = self.understood(thickness);
        let formulas = formulas.map_err(|fault| Refusal::Unusable { plugin: "formula", why: fault.to_string() })?;
        // A quarter of the thickness: as far as samples are densest.
        let narrow: Vec<_> = formulas.iter().map(|formula| formula.narrow_places(thickness)).collect();
        let singular = |(formula, narrow): (&formula::Formula, &Vec<_>)| {
            formula.singular_points(0.25 * thickness, MOST_KINKS, narrow)
        };
        let singular: Vec<_> = formulas.iter().zip(&narrow).map(singular).collect();
        let refused = |why: String| Err(Refusal::Unusable { plugin: "formula", why });
        if let Some(depth) = pole(&formulas[0], &singular[0], thickness) {
            let value = formulas[0].at(depth).value;
            let found = if value.is_finite() { short(value) } else { "infinite".into() };
            return refused(format!("the modulus is {found} at depth {}", short(depth)));
        }
        let kinks = singular.iter().flatten().map(|depth| depth / thickness);
        let mut breakpoints: Vec<f64> = kinks.filter(|d| *d > 0.0 && *d < 1.0).collect();
        breakpoints.sort_unstable_by(f64::total_cmp);
        breakpoints.dedup();
        let narrow = narrow.into_iter().flatten().map(|(depth, width)| (depth / thickness, width / thickness));
        let details = cuts(narrow);
        let probes = (0..PROBES).map(|i| (f64::from(i) + SHIFT) / f64::from(PROBES)).collect();
        let law = Law { formulas, thickness, breakpoints, details, probes };
        for (formula, what) in law.formulas.iter().zip(["modulus", "Poisson's ratio"]) {
            if law.value(formula, 0.0).is_nan() {
                return refused(format!("the {what} tends to no value at the surface, depth 0, or too slowly to tell"));
            }
        }
        Ok(Box::new(law))
    }
}

/// A depth in the layer at which a modulus becomes infinite or zero, as it may where the formula is singular: there,
/// and to the last bit nowhere else, so that no sampling would find it.
fn pole(modulus: &formula::Formula, singular: &[f64], thickness: f64) -> Option<f64> {
    /// Beside a depth, in units of the thickness, and by how much a modulus without poles changes over it at most.
    const NEAR: f64 = 1e-3;
    const MOST: f64 = 1e5;
    let mut inside = singular.iter().copied().filter(|depth| *depth > 0.0 && *depth <= thickness);
    inside.find(|&depth| {
        let here = modulus.at(depth).value;
        let near = [depth - NEAR * thickness, depth + NEAR * thickness].map(|depth| modulus.at(depth).value);
        let is_like = |near: f64| here > near / MOST && here < near * MOST;
        // What has no value at all here has one close by.
        !here.is_nan() && !near.into_iter().any(is_like)
    })
}

/// Where it tends to towards the surface, if that can be told: no number otherwise.
///
/// It was taken for its value at 1e-12 of the thickness, where what is like `y^0.3 ln(y)^2` is far from 0: edge factors
/// were 9 % off.
fn limit(at: impl Fn(f64) -> f64) -> f64 {
    /// Depths over the thickness, and how much the values there may differ.
    const DEPTHS: [f64; 2] = [1e-150, 1e-280];
    const ALIKE: f64 = 1e-12;
    let [near, nearest] = DEPTHS.map(at);
    if (nearest - near).abs() <= ALIKE * near.abs() { nearest } else { f64::NAN }
}

/// The power of the depth in what is left at the surface, from those measured at ever smaller depths.
///
/// They differ from it by what comes next in the formula, which falls with that power itself and is taken off, and by
/// rounding, which rises: taken are those that change least. Measured at one depth the power was off by up to 0.01
/// where Poisson's ratio leaves 0.499 in a thousandth of the thickness, and edge factors by 1,100 estimates.
fn first_power(measured: impl Fn(f64) -> f64) -> f64 {
    /// Depths looked at, over the thickness.
    const DEPTHS: std::ops::Range<i32> = 2..40;
    let powers: Vec<f64> =
        DEPTHS.map(|digit| measured(10_f64.powi(-digit))).take_while(|power| power.is_finite()).collect();
    let refined: Vec<f64> =
        powers.windows(2).map(|pair| pair[1] + (pair[1] - pair[0]) / (10_f64.powf(pair[1]) - 1.0)).collect();
    let steadiest =
        refined.windows(2).min_by(|one, other| (one[1] - one[0]).abs().total_cmp(&(other[1] - other[0]).abs()));
    steadiest.map_or(f64::NAN, |pair| pair[1])
}

#[derive(Debug)]
struct Law {
    /// For the modulus, and for Poisson's ratio if there is one.
    formulas: Vec<formula::Formula>,
    thickness: f64,
    breakpoints: Vec<f64>,
    details: Vec<f64>,
    probes: Vec<f64>,
}

impl Law {
    /// The power of the depth with which one of the formulas begins to be no analytic function: what is left of it
    /// after its series, at two depths of which one is twice the other.
    fn power_of(&self, formula: &formula::Formula) -> Option<f64> {
        /// Derivatives asked for: a formula that has as many is smooth.
        const DERIVATIVES: usize = 8;
        /// Depths from which on more than rounding is left after two terms, after three and so on; of longer series the
        /// power hardly matters.
        const DEPTHS: [f64; 3] = [1e-4, 1e-3, 1e-2];
        /// Less than that of the first term is left to rounding.
        const TOLD: f64 = 1e-11;
        /// Least power that is told: where a law goes on like a logarithm it is none, and this so small that no wave is
        /// too short for it.
        const LEAST: f64 = 0.02;
        /// What is no nearer to a whole power is broken, where no series tells.
        const WHOLE: f64 = 1e-3;
        let mut series = self.series(formula, DERIVATIVES).into_finite();
        // The limit of what has no value there.
        let is_limit = series.is_empty();
        if is_limit {
            series.push(self.value(formula, 0.0));
        }
        let count = series.len();
        if count >= DERIVATIVES {
            return None;
        }
        let least = (count - 1) as f64;
        let left =
            |depth: f64| self.value(formula, depth) - series.iter().rev().fold(0.0, |sum, term| sum * depth + term);
        let between = |depth: f64, told: f64| {
            let near = left(depth);
            if near.abs() > told { (left(2.0 * depth) / near).log2() } else { f64::NAN }
        };
        let power = match count.checked_sub(2) {
            None => first_power(|depth| between(depth, TOLD * series[0].abs())),
            Some(longer) => DEPTHS.get(longer).map_or(f64::NAN, |depth| between(*depth, 0.0)),
        };
        let is_whole = power.is_nan() || (power - power.round()).abs() <= WHOLE;
        if is_limit && is_whole {
            return None;
        }
        Some(if power.is_finite() { power.clamp(least + LEAST, least + 1.0) } else { least + 0.5 })
    }

    /// A value where there is one; where there is none what its series begins with, as that of `(exp(y) - 1)/y` does;
    /// else the limit at the surface, or a value close by.
    fn value(&self, formula: &formula::Formula, depth: f64) -> f64 {
        /// Beside a depth, in units of the thickness.
        const NEAR: [f64; 2] = [1e-12, -1e-12];
        /// Common factors that may be divided out.
        const FACTORS: usize = 6;
        let at = |depth: f64| formula.at(depth * self.thickness).value;
        let here = at(depth);
        if !here.is_nan() {
            return here;
        }
        let begins = Taylor::new(formula.series(depth * self.thickness, FACTORS)).into_finite();
        begins.first().copied().unwrap_or_else(|| {
            if depth == 0.0 {
                return limit(at);
            }
            NEAR.into_iter().map(|near| at((depth + near).max(0.0))).find(|value| !value.is_nan()).unwrap_or(f64::NAN)
        })
    }

    fn series(&self, formula: &formula::Formula, terms: usize) -> Taylor {
        Taylor::new(formula.series(0.0, terms)).rescaled(self.thickness)
    }
}

impl ModulusLaw for Law {
    fn modulus(&self, depth: f64) -> f64 {
        self.value(&self.formulas[0], depth)
    }

    fn poisson(&self, depth: f64) -> Option<f64> {
        self.formulas.get(1).map(|poisson| self.value(poisson, depth))
    }

    fn broken_power(&self) -> Option<f64> {
        self.formulas.iter().filter_map(|formula| self.power_of(formula)).reduce(f64::min)
    }

    fn surface_series(&self, terms: usize) -> Vec<f64> {
        (self.series(&self.formulas[0], terms) * self.surface_modulus().recip()).with_value(1.0).into_finite()
    }

    fn poisson_series(&self, terms: usize) -> Vec<f64> {
        self.formulas.get(1).map_or_else(Vec::new, |poisson| self.series(poisson, terms).into_finite())
    }

    fn breakpoints(&self) -> &[f64] {
        &self.breakpoints
    }

    fn details(&self) -> &[f64] {
        &self.details
    }

    fn probes(&self) -> &[f64] {
        &self.probes
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Exponential;
    use slipzone_api::{Finite, NoFiles, Positive};

    fn formula(modulus: &str, poisson: Option<&str>, parameters: &[(&str, f64)]) -> Formula {
        let parameters = parameters.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
        Formula { modulus: modulus.into(), poisson: poisson.map(Into::into), parameters }
    }

    fn thick(thickness: f64) -> Setting {
        Setting::thick(Positive::new(thickness).unwrap())
    }

    fn law(modulus: &str) -> Box<dyn ModulusLaw> {
        formula(modulus, None, &[]).law(&thick(4.0)).unwrap_or_else(|refusal| panic!("{refusal}"))
    }

    #[test]
    fn an_exponential_is_the_exponential() {
        let parameters = [("mu", 3.0), ("gamma", 0.4)];
        let written = formula("mu*exp(gamma*y)", None, &parameters).law(&thick(5.0)).unwrap();
        let exponential = Exponential::by_gradient(Positive::new(3.0).unwrap(), Finite::new(0.4).unwrap());
        let exponential = exponential.law(&thick(5.0)).unwrap();
        for i in 0..=20 {
            let depth = f64::from(i) / 20.0;
            assert!((written.modulus(depth) / exponential.modulus(depth) - 1.0).abs() < 1e-15);
        }
        let (series, exact) = (written.surface_series(20), exponential.surface_series(20));
        assert_eq!(series.len(), 20);
        assert!(series.iter().zip(exact).all(|(a, b)| (a - b).abs() < 1e-14 * b), "{series:?}");
        assert!(written.breakpoints().is_empty() && written.poisson(0.5).is_none());
    }

    #[test]
    fn kinks_are_breakpoints() {
        assert_eq!(law("1 + abs(y - 1)").breakpoints(), [0.25]);
        assert_eq!(law("1 + max(0, y - 3)*abs(y - 5) + min(y, 2)").breakpoints(), [0.5, 0.75]);
        assert!(law("1 + abs(y + 1)").breakpoints().is_empty());
        let both = formula("1 + abs(y - 3)", Some("0.3 + 0.01*abs(y - 1)"), &[]).law(&thick(4.0)).unwrap();
        assert_eq!(both.breakpoints(), [0.25, 0.75]);
        assert!((both.poisson(0.5).unwrap() - 0.31).abs() < 1e-15);
        assert!(both.poisson_series(3).iter().zip([0.31, -0.04, 0.0]).all(|(a, b)| (a - b).abs() < 1e-15));
    }

    /// Roots, powers and what is made of them; what is smooth has none, nor has a kink inside the layer.
    #[test]
    fn broken_powers_are_measured() {
        let laws = [
            ("1 + 3*sqrt(y/h)", Some(0.5)),
            ("2 + (y/h)^0.2", Some(0.2)),
            ("exp(-2*(y/h)^0.7)", Some(0.7)),
            ("1 + y + 3*(y/h)^1.5", Some(1.5)),
            ("1 + (y/h)^2.5", Some(2.5)),
            ("1 + y + (y/h)^2.2", Some(2.2)),
            ("1 + (y/h)^pi", Some(std::f64::consts::PI)),
            ("1 + (y/h)^3.8", Some(3.8)),
            ("1 + sqrt(y + 0.01*h)", None),
            ("3 + abs(y - 1)", None),
        ];
        for (formula, power) in laws {
            let found = law(formula).broken_power();
            let is_close = match (found, power) {
                (Some(found), Some(power)) => (found - power).abs() < 2e-2,
                (found, power) => found == power,
            };
            assert!(is_close, "{formula}: {found:?}");
        }
        // However soon what comes next in the formula is as large.
        let soon = formula("2", Some("0.499 - 0.2*sqrt(y/h)/(0.003 + sqrt(y/h))"), &[]).law(&thick(4.0)).unwrap();
        assert!((soon.broken_power().unwrap() - 0.5).abs() < 1e-6, "{:?}", soon.broken_power());
        for power in [0.2, 0.35, 0.5, 0.7, 0.95] {
            let found = law(&format!("1 + 3*(y/h)^{power}*(1 + y)")).broken_power().unwrap();
            assert!((found - power).abs() < 1e-6, "{found} for {power}");
        }
        // Of both formulas the one that breaks sooner.
        let both = formula("1 + (y/h)^1.5", Some("0.2 + 0.1*sqrt(y/h)"), &[]).law(&thick(4.0)).unwrap();
        assert!((both.broken_power().unwrap() - 0.5).abs() < 2e-2);
    }

    /// What has no value at one point has one beside it.
    #[test]
    fn gaps_are_closed() {
        let step = law("2 + abs(y - 1)/(y - 1)");
        assert!([1.0, 3.0].iter().any(|side| (step.modulus(0.25) - side).abs() < 1e-9));
        assert_eq!(step.breakpoints(), [0.25]);
        let sine = law("sin(y)/y + 1");
        assert!((sine.modulus(0.0) - 2.0).abs() < 1e-12);
        assert!(sine.surface_series(3).iter().zip([1.0, 0.0, -4.0 / 3.0]).all(|(a, b)| (a - b).abs() < 1e-12));
        // At 1e-12 of the thickness it is 1.0001, by rounding.
        let exponential = law("(exp(y) - 1)/y + (exp(y - 1) - 1)/(y - 1)");
        assert!((exponential.modulus(0.0) - 2.0 + (-1.0_f64).exp()).abs() < 1e-15);
        assert!((exponential.modulus(0.25) - 2.0 - 1.0_f64.exp() + 2.0).abs() < 1e-15);
    }

    /// What is like a power times a logarithm is not yet 0 at any depth that a layer has.
    #[test]
    fn the_surface_has_the_value_that_the_law_tends_to() {
        for (formula, power) in [("2 + sqrt(y/h)*ln(y/h)", 0.5), ("2 + (y/h)^0.3*ln(y/h)^2", 0.3)] {
            let law = law(formula);
            assert!((law.modulus(0.0) - 2.0).abs() < 1e-15, "{formula}: {}", law.modulus(0.0));
            // Near it, as far as there is one.
            let found = law.broken_power().unwrap();
            assert!((found - power).abs() < 0.15, "{formula}: {found}");
        }
        for smooth in ["3/y*y", "2 + y/y*y", "(y/y)*exp(y)"] {
            let law = law(smooth);
            assert!(law.modulus(0.0) > 0.9 && law.broken_power().is_none(), "{smooth}: {:?}", law.broken_power());
        }
        let slow = law("1 + 1/(50 - ln(y/h))");
        assert!(
            (slow.modulus(0.0) - 1.0).abs() < 1e-15 && slow.broken_power() == Some(0.02),
            "{:?}",
            slow.broken_power()
        );
        for none in ["2 + sin(ln(y))", "2 + sin(1/y^0.3)/2", "1 + sqrt(y - 1e-13)", "2 + y^0.01*ln(y)"] {
            let refusal = formula(none, None, &[]).law(&thick(4.0)).unwrap_err().to_string();
            assert!(refusal.contains("the modulus tends to no value at the surface"), "{none}: {refusal}");
        }
        let refusal = formula("2", Some("0.3 + 0.1*sin(ln(y))"), &[]).law(&thick(4.0)).unwrap_err().to_string();
        assert!(refusal.contains("Poisson's ratio tends to no value"), "{refusal}");
    }

    /// One of both may be a constant, but not both.
    #[test]
    fn constants_stand_beside_what_varies() {
        let law = formula("2", Some("0.3 + 0.1*y/h"), &[]).law(&thick(4.0)).unwrap();
        assert!((law.modulus(0.7) - 2.0).abs() < 1e-15 && (law.poisson(0.5).unwrap() - 0.35).abs() < 1e-15);
        let law = formula("2 + y", Some("nu"), &[("nu", 0.2)]).law(&thick(4.0)).unwrap();
        assert!((law.poisson(0.5).unwrap() - 0.2).abs() < 1e-15);
        assert_eq!(formula("2", Some("0.2"), &[]).read(&NoFiles).unwrap_err().path, ["modulus"]);
    }

    /// `cosh(5000)` has no place among numbers.
    #[test]
    fn a_divisor_too_large_for_a_number_leaves_nothing() {
        for film in ["1/cosh((y - 2)/4e-4)", "1/(1 + exp(((y - 2)/4e-4)^2))", "1/(1 + exp((2 - y)/4e-4))"] {
            let law = law(&format!("1 + {film}"));
            assert_eq!(law.surface_series(4), [1.0, 0.0, 0.0, 0.0], "{film}");
            assert!((law.modulus(0.1) - 1.0).abs() < 1e-15 && law.modulus(0.5) > 1.0 + 1e-30, "{film}");
        }
    }

    /// Of two factors that only grow and only fall nothing tells that they make a film, 0.03 thick. Probes are close
    /// enough, and no jump at a depth that one would write is one of them.
    #[test]
    fn probes_are_closer_than_a_film_of_which_the_formula_does_not_tell() {
        let law = law("1 + y^500*exp(500*(1 - y))");
        assert!(!law.details().iter().any(|depth| (depth - 0.25).abs() < 0.05), "{:?}", law.details());
        let probes = law.probes();
        let seen = probes.iter().filter(|depth| law.modulus(**depth) > 1.1).count();
        assert!(seen >= 8 && probes.len() < 300, "{seen} of {}", probes.len());
        assert!(probes.is_sorted() && probes.iter().all(|depth| (depth * 1000.0).fract() != 0.0));
    }

    #[test]
    fn the_thickness_has_a_name() {
        assert!((law("1 + y/h").modulus(0.5) - 1.5).abs() < 1e-15);
        let mut taken = formula("1 + y/h", None, &[("h", 2.0)]);
        assert_eq!(taken.read(&NoFiles).unwrap_err().path, ["parameters", "h"]);
        assert!(formula("1 + y/(h - 4)", None, &[]).law(&thick(4.0)).is_err());
    }

    #[test]
    fn what_cannot_be_is_refused() {
        for (singular, depth) in [("1/(2.4 - y)^2", "2.4"), ("abs(y - 0.7)", "0.7"), ("1/sqrt(abs(y - 3))", "3")] {
            let refusal = formula(singular, None, &[]).law(&thick(5.0)).unwrap_err().to_string();
            assert!(refusal.ends_with(&format!("at depth {depth}")), "{singular}: {refusal}");
        }
        assert!(formula("1/(5.1 - y)", None, &[]).law(&thick(5.0)).is_ok());
        assert_eq!(law("1 + y^1.5").surface_series(9).len(), 2);
        assert!(matches!(formula("1 + y", None, &[]).law(&Setting::default()), Err(Refusal::NotBuilt { .. })));
        for (modulus, poisson, key) in [("1 + x", None, "modulus"), ("1 + y", Some("y*"), "poisson")] {
            assert_eq!(formula(modulus, poisson, &[]).read(&NoFiles).unwrap_err().path, [key]);
        }
    }
}
