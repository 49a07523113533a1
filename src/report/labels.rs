//! Unit labels, composed from the two that a scene may give.

use crate::scene::Units;

/// Labels of the units in which a solution's numbers are; empty where the scene gives none.
pub(super) struct Labels {
    /// Of lengths.
    pub(super) length: String,
    /// Of stresses.
    pub(super) stress: String,
    /// Of forces per unit length out of plane.
    pub(super) force: String,
    /// Of stress times the square root of length.
    pub(super) intensity: String,
    /// Of one over a length.
    pub(super) per_length: String,
}

impl Labels {
    pub(super) fn new(units: &Units) -> Self {
        let length = one_line(units.length.as_deref().unwrap_or_default());
        let stress = one_line(units.stress.as_deref().unwrap_or_default());
        // Half a compound label would be wrong, so it takes both.
        let (force, intensity) = match (stress.as_str(), length.as_str()) {
            ("", _) | (_, "") => Default::default(),
            ("MPa" | "N/mm^2" | "N/mm²", "mm") => ("N/mm".into(), format!("{stress} mm^1/2")),
            ("GPa", "um" | "µm" | "μm") => ("N/mm".into(), format!("{stress} {length}^1/2")),
            ("GPa", "mm") => ("kN/mm".into(), "GPa mm^1/2".into()),
            ("kPa", "m") => ("kN/m".into(), "kPa m^1/2".into()),
            ("Pa", "m") => ("N/m".into(), "Pa m^1/2".into()),
            _ => (format!("{stress} {length}"), format!("{stress} {length}^1/2")),
        };
        let per_length = if length.is_empty() { String::new() } else { format!("1/{length}") };
        Self { length, stress, force, intensity, per_length }
    }
}

/// `number` and its unit, if it has a label.
pub(super) fn with_unit(number: &str, unit: &str) -> String {
    if unit.is_empty() { number.to_owned() } else { format!("{number} {unit}") }
}

/// Text of the user's on one line, without characters that a terminal would obey or XML forbids.
pub(super) fn one_line(text: &str) -> String {
    let harmless = |c: char| if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') { ' ' } else { c };
    text.chars().map(harmless).collect::<String>().trim().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(stress: Option<&str>, length: Option<&str>) -> [String; 4] {
        let l = Labels::new(&Units { length: length.map(Into::into), stress: stress.map(Into::into) });
        [l.length, l.stress, l.force, l.intensity]
    }

    #[test]
    fn compound_labels_need_both() {
        assert_eq!(labels(Some("MPa"), Some("mm")), ["mm", "MPa", "N/mm", "MPa mm^1/2"]);
        assert_eq!(labels(Some("GPa"), Some("um")), ["um", "GPa", "N/mm", "GPa um^1/2"]);
        assert_eq!(labels(Some("psi"), Some("in")), ["in", "psi", "psi in", "psi in^1/2"]);
        assert_eq!(labels(None, Some("mm")), ["mm", "", "", ""]);
        assert_eq!(labels(None, None), [""; 4]);
    }

    #[test]
    fn a_title_cannot_steer_the_terminal() {
        assert_eq!(one_line("two\nlines \u{1b}[31mred\u{ffff}"), "two lines  [31mred");
    }
}
