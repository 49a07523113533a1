//! The scenes that a figure is confined to.

use super::Place;
use super::fault::wrong;
use crate::study::plot::Plot;
use crate::study::{Cell, Study};
use slipzone_api::Fault;

/// Steps among which one with a given value is looked for.
const MOST_STEPS: u64 = 1_000_000;

impl Study {
    /// Steps of the axes that a figure is confined to.
    pub(super) fn only(&self, plot: &Plot) -> Result<Vec<(Place, Vec<u64>)>, Fault> {
        let mut only: Vec<(Place, Vec<u64>)> = Vec::new();
        for (name, wanted) in &plot.only {
            let place = self.place(&["only", name], name)?;
            let wanted = wanted.as_array().map_or(std::slice::from_ref(wanted), Vec::as_slice);
            let mut steps: Vec<u64> = Vec::new();
            for value in wanted {
                steps.extend(self.steps_with(place, name, value)?);
            }
            steps.sort_unstable();
            steps.dedup();
            if steps.is_empty() || only.iter().any(|other| other.0.axis == place.axis) {
                return Err(wrong(&["only", name], "nothing to show", "values of each axis once, at least one"));
            }
            only.push((place, steps));
        }
        Ok(only)
    }

    fn steps_with(&self, place: Place, name: &str, value: &toml::Value) -> Result<Vec<u64>, Fault> {
        /// Numbers written with ten digits are meant to be those of a range.
        const SAME: f64 = 1e-9;
        let (axis, column) = (&self.axes[place.axis], &self.axes[place.axis].columns[place.column]);
        let number = value.as_float().or_else(|| value.as_integer().map(|integer| integer as f64));
        let is_meant = |step: &u64| match column.cell(*step) {
            Cell::Text(text) => value.as_str().map_or_else(|| value.to_string() == text, |value| value == text),
            Cell::Number(own) => number.is_some_and(|n| (n - own).abs() <= SAME * own.abs()),
        };
        let steps: Vec<u64> = (0..axis.count.min(MOST_STEPS)).filter(is_meant).collect();
        if steps.is_empty() {
            let shown: Vec<String> = (0..axis.count.min(6)).map(|step| column.cell(step).to_string()).collect();
            let more = if axis.count > 6 { ", ..." } else { "" };
            let fault = wrong(&["only", name], format!("no value of `{name}`"), shown.join(", ") + more);
            return Err(fault.found(value.to_string()));
        }
        Ok(steps)
    }
}
