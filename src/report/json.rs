//! The whole solution for machines.

use crate::engine::Solution;
use crate::engine::insist;

/// The solution as JSON (format 1, `docs/formats.md`), ending in a line feed. Numbers read back exactly.
///
/// # Panics
/// If a number of the solution is not finite; see [`first_not_finite`](crate::engine::first_not_finite).
/// `serde_json` would write it as `null`, which means something else.
pub fn json(solution: &Solution) -> String {
    insist(solution);
    let mut text = serde_json::to_string_pretty(solution).expect("every key of a solution is a string");
    text.push('\n');
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::samples;
    use serde_json::Value;

    fn keys(value: &Value, pointer: &str) -> Vec<String> {
        value.pointer(pointer).unwrap().as_object().unwrap().keys().cloned().collect()
    }

    /// Others read these: keys are added, never renamed. A new key is added here too.
    #[test]
    fn keys_are_stable() {
        let value: Value = serde_json::from_str(&json(&samples::flat_with_friction())).unwrap();
        // serde_json sorts the keys of a parsed object.
        for (pointer, expected) in [
            ("", "assumptions edge error format load plan pressure profile program reason scene status stick units"),
            ("/program", "name version"),
            ("/load", "force half_width indentation"),
            ("/pressure", "centre mean peak"),
            ("/edge", "ratio stress_intensity"),
            ("/stick", "half_width one_minus_ratio ratio slip"),
            ("/error", "each estimate how"),
            (
                "/plan",
                "bound coupling_neglected factorisations flexibility flexibility_evaluations grading kernel kernel_evaluations model operations quadrature reasons unknowns work",
            ),
            ("/profile", "pressure shear x"),
            ("/scene", "format friction layer load output punch solver title units"),
        ] {
            let mut found = keys(&value, pointer);
            found.sort_unstable();
            assert_eq!(found.join(" "), expected, "at `{pointer}`");
        }
    }

    #[test]
    fn words_and_nulls_are_stable() {
        let value: Value = serde_json::from_str(&json(&samples::flat_with_friction())).unwrap();
        let at = |pointer: &str| value.pointer(pointer).unwrap().clone();
        assert_eq!(at("/format"), 1);
        assert_eq!(at("/status"), "converged");
        assert_eq!(at("/stick/slip"), "inward");
        for null in ["/reason", "/load/indentation", "/pressure/peak", "/profile/pressure/0", "/profile/shear/0"] {
            assert_eq!(at(null), Value::Null, "{null}");
        }
        let frictionless: Value = serde_json::from_str(&json(&samples::cylinder_without_friction())).unwrap();
        assert_eq!((&frictionless["stick"], &frictionless["profile"]["shear"]), (&Value::Null, &Value::Null));
    }

    #[test]
    fn numbers_read_back_exactly() {
        let mut solution = samples::flat_with_friction();
        let awkward = [0.1 + 0.2, 1.0 / 3.0, f64::MIN_POSITIVE, 5e-324, f64::MAX, 1e23];
        for (slot, v) in solution.profile.x.iter_mut().zip(awkward) {
            *slot = v;
        }
        // Parsed by the standard library: serde_json itself may be off by a bit when it reads.
        let text = json(&solution);
        let x = text.split("\"x\": [").nth(1).unwrap().split(']').next().unwrap();
        let x: Vec<f64> = x.split(',').map(|number| number.trim().parse().unwrap()).collect();
        assert_eq!(x, solution.profile.x);
    }

    #[test]
    #[should_panic(expected = "`profile.shear[3]` is no number")]
    fn nan_is_not_written_as_null() {
        let mut solution = samples::flat_with_friction();
        solution.profile.shear.as_mut().unwrap()[3] = Some(f64::NAN);
        let _ = json(&solution);
    }
}
