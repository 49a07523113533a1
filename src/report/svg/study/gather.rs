//! Which scene belongs to which curve of which panel, and how it ended.

use super::names;
use crate::report::svg::FigureError;
use crate::study::{Place, Plot, Shown, Source, Study, at};
use serde_json::Value;

/// A figure's panels and the curves in each.
pub(super) struct Groups<'a> {
    pub(super) study: &'a Study,
    pub(super) plot: &'a Plot,
    pub(super) shown: &'a Shown,
    /// Steps of the axis of panels.
    panels: Vec<u64>,
    /// Steps of each axis of the family.
    family: Vec<(Place, Vec<u64>)>,
}

/// A scene that a figure shows.
pub(super) struct Shot {
    /// Number of the scene.
    pub(super) index: u64,
    /// Steps of the axes.
    pub(super) steps: Vec<u64>,
    pub(super) panel: usize,
    pub(super) member: usize,
    pub(super) record: Value,
    /// Whether its numbers are results.
    pub(super) converged: bool,
    /// Whether they are as computed, and something contradicts them.
    pub(super) violated: bool,
}

impl<'a> Groups<'a> {
    pub(super) fn new(study: &'a Study, plot: &'a Plot, shown: &'a Shown) -> Self {
        // Few, as the description was checked.
        let steps = |axis: usize| study.shown_steps(shown, axis, u64::MAX);
        let panels = shown.panels.map_or_else(Vec::new, |place| steps(place.axis));
        let family = shown.family.iter().map(|place| (*place, steps(place.axis))).collect();
        Self { study, plot, shown, panels, family }
    }

    pub(super) fn panels(&self) -> usize {
        self.panels.len().max(1)
    }

    /// Curves of a panel.
    pub(super) fn members(&self) -> usize {
        self.family.iter().map(|(_, steps)| steps.len()).product()
    }

    /// What a panel is called; nothing where there is one only.
    pub(super) fn panel_name(&self, panel: usize) -> String {
        let named = self.shown.panels.zip(self.panels.get(panel));
        named.map_or_else(String::new, |(place, step)| names::value(self.study, place, *step, &self.panels))
    }

    /// What a curve is called; nothing where there is one only.
    pub(super) fn member_name(&self, member: usize) -> String {
        let steps = self.family.iter().zip(self.places(member));
        let names: Vec<String> =
            steps.map(|((place, steps), (at, _))| names::value(self.study, *place, steps[at], steps)).collect();
        names.join(", ")
    }

    /// A member's place in each axis of the family, and among how many.
    pub(super) fn places(&self, member: usize) -> Vec<(usize, usize)> {
        let mut rest = member;
        let mut places: Vec<_> = self
            .family
            .iter()
            .rev()
            .map(|(_, steps)| {
                let place = rest % steps.len();
                rest /= steps.len();
                (place, steps.len())
            })
            .collect();
        places.reverse();
        places
    }

    /// The scenes that the figure shows, one by one; counts them, and those that did not converge.
    pub(super) fn each(
        &self,
        records: impl IntoIterator<Item = Value>,
        mut take: impl FnMut(Shot) -> Result<(), FigureError>,
    ) -> Result<(u64, u64), FigureError> {
        let (mut scenes, mut failed) = (0, 0);
        for record in records {
            let Some(shot) = self.shot(record)? else { continue };
            scenes += 1;
            failed += u64::from(!shot.converged);
            take(shot)?;
        }
        if scenes == 0 {
            return Err(FigureError::NothingToShow("the results hold none of them".into()));
        }
        Ok((scenes, failed))
    }

    /// `None` where the figure does not show the scene.
    fn shot(&self, record: Value) -> Result<Option<Shot>, FigureError> {
        let rows = self.study.rows();
        let index = record.get("index").and_then(Value::as_u64).filter(|index| *index < rows);
        let Some(index) = index else {
            let found = record.get("index").map_or_else(|| "no `index`".into(), |index| format!("index {index}"));
            return Err(FigureError::NotOfTheStudy(format!("{found}, where the study has {rows} scenes")));
        };
        let steps = self.study.steps(index);
        if !self.shown.only.iter().all(|(place, only)| only.contains(&steps[place.axis])) {
            return Ok(None);
        }
        let among = |place: &Place, list: &[u64]| list.iter().position(|step| *step == steps[place.axis]);
        let panel = self.shown.panels.as_ref().map_or(Some(0), |place| among(place, &self.panels));
        let member =
            self.family.iter().try_fold(0, |member, (place, list)| Some(member * list.len() + among(place, list)?));
        let (Some(panel), Some(member)) = (panel, member) else { return Ok(None) };
        let status = record.get("status").and_then(Value::as_str);
        let [converged, violated] = ["converged", "assumption-violated"].map(|name| status == Some(name));
        Ok(Some(Shot { index, steps, panel, member, record, converged, violated }))
    }

    /// What a figure shows of a scene, if it is known.
    pub(super) fn number(&self, shot: &Shot, source: Source) -> Option<f64> {
        let value = match source {
            Source::Field(place) => {
                match self.study.axes[place.axis].columns[place.column].cell(shot.steps[place.axis]) {
                    crate::study::Cell::Number(number) => Some(number),
                    crate::study::Cell::Text(_) => None,
                }
            }
            Source::Number(path) => (shot.converged || shot.violated).then(|| number(&shot.record, path)).flatten(),
        };
        value.filter(|value| value.is_finite())
    }
}

/// A number of a record by its path.
pub(super) fn number(record: &Value, path: &str) -> Option<f64> {
    at(record, path)?.as_f64()
}
