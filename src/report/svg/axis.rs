//! An axis from zero: its end, its ticks and its label.

use crate::report::number::typeset;
use kuva::render::layout::TickFormat;
use std::sync::Arc;

/// From 0 to a little beyond the largest number.
pub(super) struct Axis {
    /// Name and unit.
    pub(super) label: String,
    /// What the numbers are divided by: a power of a thousand where their size would make long ticks.
    pub(super) unit: f64,
    /// Its end, so divided.
    pub(super) most: f64,
    /// Distance of its ticks, so divided.
    pub(super) step: f64,
}

/// Numbers between these are written as they are.
const PLAIN: std::ops::Range<f64> = 0.01..1e5;
/// Distances of ticks to the end of the axis.
const INTERVALS: f64 = 5.0;
/// Room between the largest number and the end of the axis, over that number.
const ROOM: f64 = 0.05;

impl Axis {
    /// `None` where no number is above 0.
    pub(super) fn new(largest: f64, name: &str, unit: &str) -> Option<Self> {
        Self::with_intervals(largest, name, unit, INTERVALS)
    }

    /// The same with at most so many distances of ticks.
    pub(super) fn with_intervals(largest: f64, name: &str, unit: &str, intervals: f64) -> Option<Self> {
        if largest <= 0.0 || !largest.is_finite() {
            return None;
        }
        let thousands = if PLAIN.contains(&largest) { 0 } else { power_of_ten(largest).div_euclid(3) };
        let power = 10.0_f64.powi(3 * thousands);
        let label = match (thousands, unit) {
            (0, "") => name.to_owned(),
            (0, unit) => format!("{name} ({unit})"),
            (_, unit) => {
                let factor = typeset(&format!("1e{}", 3 * thousands));
                format!("{name} ({})", if unit.is_empty() { factor } else { format!("{factor} {unit}") })
            }
        };
        let largest = largest / power;
        let raw = largest / intervals;
        let decade = 10.0_f64.powi(power_of_ten(raw));
        let step = [1.0, 2.0, 5.0, 10.0].map(|times| times * decade).into_iter().find(|step| *step >= raw);
        Some(Self { label, unit: power, most: (1.0 + ROOM) * largest, step: step.unwrap_or(raw) })
    }

    /// As many decimals as the distance of the ticks has.
    pub(super) fn ticks(&self) -> TickFormat {
        let decimals = usize::try_from(-power_of_ten(self.step)).unwrap_or(0);
        TickFormat::Custom(Arc::new(move |value| format!("{:.decimals$}", value + 0.0)))
    }
}

/// The largest power of ten that a number reaches.
#[expect(clippy::cast_possible_truncation, reason = "at most 308 in size")]
pub(super) fn power_of_ten(value: f64) -> i32 {
    // A logarithm of 1000 may fall short of 3 by rounding.
    (value.log10() + 1e-9).floor() as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_few() {
        for (largest, label, step, count) in [
            (300.0, "P (N/mm)", 100.0, 3),
            (1.0, "P (N/mm)", 0.2, 5),
            (0.32, "P (N/mm)", 0.1, 3),
            (99_999.0, "P (N/mm)", 2e4, 5),
            (1.2e5, "P (10³ N/mm)", 50.0, 2),
            (4e-4, "P (10⁻⁶ N/mm)", 100.0, 4),
            (1e-3, "P (10⁻³ N/mm)", 0.2, 5),
            (1e100, "P (10⁹⁹ N/mm)", 2.0, 5),
        ] {
            let axis = Axis::new(largest, "P", "N/mm").expect("an axis");
            let inner = (1..16).take_while(|i| f64::from(*i) * axis.step < axis.most).count();
            assert_eq!((axis.label.as_str(), inner), (label, count), "{largest}");
            assert!((axis.step / step - 1.0).abs() < 1e-12, "{largest}: {}", axis.step);
            assert!((axis.most * axis.unit / largest - 1.05).abs() < 1e-9, "{largest}");
        }
        assert_eq!(Axis::new(4e-4, "P", "").expect("an axis").label, "P (10⁻⁶)");
        assert!([0.0, -1.0, f64::NAN, f64::INFINITY].iter().all(|none| Axis::new(*none, "P", "").is_none()));
    }
}
