//! By how much two solutions differ, number by number.

use crate::engine::Solution;
use serde::Serialize;

/// What is compared. Each has a panel of its own: they are never mixed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measured {
    /// Stress intensity at a sharp edge.
    Edge,
    /// Size of the stick zone: the larger of the relative errors of `a/b` and `1 - a/b`.
    Stick,
    /// Force, half-width and indentation: the largest error of those that the scene does not give.
    Load,
    /// Pressure, the largest difference over the largest value, both times `sqrt(1 - (x/b)^2)`.
    Pressure,
    /// Shear, likewise.
    Shear,
}

impl Measured {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Edge, Self::Stick, Self::Load, Self::Pressure, Self::Shear];

    /// Name of its panel.
    pub fn name(self) -> &'static str {
        match self {
            Self::Edge => "edge stress intensity",
            Self::Stick => "stick zone",
            Self::Load => "load and contact size",
            Self::Pressure => "pressure, weighted sup norm",
            Self::Shear => "shear, weighted sup norm",
        }
    }
}

/// Relative differences; `None` where one of the two has no such number, or it is given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Errors {
    /// [`Measured::Edge`].
    pub edge: Option<f64>,
    /// [`Measured::Stick`].
    pub stick: Option<f64>,
    /// [`Measured::Load`].
    pub load: Option<f64>,
    /// [`Measured::Pressure`].
    pub pressure: Option<f64>,
    /// [`Measured::Shear`].
    pub shear: Option<f64>,
}

impl Errors {
    /// One of them.
    pub fn of(&self, measured: Measured) -> Option<f64> {
        match measured {
            Measured::Edge => self.edge,
            Measured::Stick => self.stick,
            Measured::Load => self.load,
            Measured::Pressure => self.pressure,
            Measured::Shear => self.shear,
        }
    }

    /// How far `solution` is from `expected`; profiles at the same points of the contact.
    pub fn between(solution: &Solution, expected: &Solution) -> Self {
        let both = |number: &dyn Fn(&Solution) -> Option<f64>| relative(number(solution)?, number(expected)?);
        let ratio = both(&|s| s.stick.as_ref()?.ratio);
        let rest = both(&|s| s.stick.as_ref()?.one_minus_ratio);
        Self {
            edge: both(&|s| s.edge.stress_intensity.filter(|k| *k != 0.0)),
            stick: ratio.zip(rest).map(|(ratio, rest)| ratio.max(rest)),
            load: worst([both(&|s| s.load.force), both(&|s| s.load.half_width), both(&|s| s.load.indentation)]),
            pressure: norm(solution, expected, &|s| Some(&s.profile.pressure)),
            shear: norm(solution, expected, &|s| s.profile.shear.as_ref()),
        }
    }

    /// The errors that a solution claims of itself; none of its tractions.
    pub fn claimed(solution: &Solution) -> Self {
        let each = |path: &str| solution.error.each.get(path).copied();
        let stick = each("stick.ratio").zip(each("stick.one_minus_ratio")).map(|(one, other)| one.max(other));
        Self {
            edge: each("edge.stress_intensity"),
            stick,
            load: worst(["load.force", "load.half_width", "load.indentation"].map(each)),
            pressure: None,
            shear: None,
        }
    }

    /// The largest.
    pub fn worst(&self) -> Option<f64> {
        worst(Measured::ALL.map(|measured| self.of(measured)))
    }
}

fn worst(errors: impl IntoIterator<Item = Option<f64>>) -> Option<f64> {
    errors.into_iter().flatten().reduce(f64::max)
}

fn relative(found: f64, expected: f64) -> Option<f64> {
    (expected != 0.0).then(|| (found / expected - 1.0).abs())
}

type Column<'a> = &'a dyn Fn(&Solution) -> Option<&Vec<Option<f64>>>;

/// The weight is the flat punch's own: bounded and not 0 at an edge where the traction is neither.
fn norm(solution: &Solution, expected: &Solution, column: Column) -> Option<f64> {
    let b = expected.load.half_width?;
    let (found, right) = (column(solution)?, column(expected)?);
    if found.len() != right.len() || found.is_empty() {
        return None;
    }
    let (mut difference, mut largest) = (0.0_f64, 0.0_f64);
    for ((x, found), right) in expected.profile.x.iter().zip(found).zip(right) {
        let weight = (1.0 - (x / b).powi(2)).max(0.0).sqrt();
        if let (Some(found), Some(right)) = (found, right) {
            difference = difference.max(weight * (found - right).abs());
            largest = largest.max(weight * right.abs());
        }
    }
    (largest > 0.0).then_some(difference / largest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::samples;

    #[test]
    fn each_number_is_compared_with_its_own() {
        let expected = samples::flat_with_friction();
        let mut found = expected.clone();
        let none = Errors::between(&found, &expected);
        assert_eq!((none.edge, none.stick, none.load), (Some(0.0), Some(0.0), Some(0.0)));
        found.edge.stress_intensity = found.edge.stress_intensity.map(|k| 1.001 * k);
        found.load.indentation = found.load.indentation.map(|depth| 1.01 * depth);
        let stick = found.stick.as_mut().unwrap();
        // The same distance of the zone's end is more of the slip zone than of the stick zone.
        stick.ratio = stick.ratio.map(|ratio| ratio + 1e-4);
        stick.one_minus_ratio = stick.one_minus_ratio.map(|rest| rest - 1e-4);
        let off = Errors::between(&found, &expected);
        let [edge, stick] = [off.edge.unwrap(), off.stick.unwrap()];
        assert!((edge - 1e-3).abs() < 1e-12, "{edge}");
        let stick_expected = expected.stick.unwrap();
        let least = stick_expected.ratio.unwrap().min(stick_expected.one_minus_ratio.unwrap());
        assert!((stick - 1e-4 / least).abs() < 1e-9, "{stick}");
    }

    #[test]
    fn tractions_are_weighed_as_a_flat_punch_weighs_them() {
        let mut expected = samples::flat_with_friction();
        expected.load.half_width = Some(1.0);
        expected.profile.x = vec![0.0, 0.6, 1.0];
        expected.profile.pressure = vec![Some(1.0), Some(1.0), None];
        let mut found = expected.clone();
        found.profile.pressure[1] = Some(1.1);
        let off = Errors::between(&found, &expected).pressure.unwrap();
        assert!((off - 0.08).abs() < 1e-12, "0.1 sqrt(1 - 0.36), of a largest value of 1: {off}");
    }
}
