//! Pressure and shear over the contact, a curve for each scene.

use super::gather::{Groups, Shot, number};
use super::{ABREAST, Drawing, curves, names};
use crate::report::labels::Labels;
use crate::report::svg::FigureError;
use crate::report::svg::edges::to_the_edges;
use crate::report::svg::panel::{Curve, MARKED, Panel};
use crate::report::svg::scale::Scale;
use crate::report::svg::style::Style;
use crate::study::{FOUND, Over, Source};
use serde_json::Value;

/// Samples of a profile that are kept.
const MOST: usize = 4000;
/// Up to where an unbounded traction decides how high the frame is, in half-widths of the contact.
const SHOWN: f64 = 0.95;

/// Tractions of a scene from the middle to the edge: `x/b` and what is drawn there, infinite at a sharp edge.
struct Profile {
    panel: usize,
    member: usize,
    /// Pressure and shear, over what the figure divides them by.
    tractions: [Vec<(f64, Option<f64>)>; 2],
    /// Whether they are so few that a curve alone would hide where they are.
    few: bool,
    /// Whether they are as computed, and something contradicts them.
    violated: bool,
}

/// Crosses along a curve that something contradicts.
const CROSSES: f64 = 10.0;
/// Width of such a curve, px.
const DOUBTFUL: f64 = 1.1;

pub(super) fn draw(groups: &Groups, records: impl IntoIterator<Item = Value>) -> Result<Drawing, FigureError> {
    let Groups { study, plot, shown, .. } = *groups;
    let mut profiles: Vec<Profile> = Vec::new();
    let (scenes, failed) = groups.each(records, |shot| {
        if profiles.len() == groups.panels() * groups.members() {
            return Err(FigureError::NotOfTheStudy("a scene stands in them twice".into()));
        }
        profiles.extend(profile(groups, &shot));
        Ok(())
    })?;
    profiles.sort_by_key(|profile| (profile.panel, profile.member));
    let stress = Labels::new(&study.scene.units).stress;
    let (over, unit) = match plot.over {
        Over::Mean => ("/ mean pressure", ""),
        Over::Modulus => ("/ surface modulus µ₁", ""),
        Over::One => ("", stress.as_str()),
    };
    let mut kinds = Vec::new();
    for y in &shown.y {
        let (which, name) = if *y == Source::Number("shear") { (1, "shear q") } else { (0, "pressure p") };
        // All that is bounded, and of what is not the part away from the edge.
        let seen = profiles.iter().flat_map(|profile| {
            let points = &profile.tractions[which];
            let sharp = profile.tractions[0].last().is_some_and(|point| point.1.is_none());
            points.iter().filter(move |point| !sharp || point.0 <= SHOWN).filter_map(|point| point.1)
        });
        let label =
            plot.y_label.as_deref().map_or_else(|| format!("{name} {over}").trim().to_owned(), names::with_symbols);
        let seen = seen.chain([0.0]).chain(plot.lines.iter().map(|line| line.y));
        let scale = curves::scale(seen, plot.y_scale, &label, unit, true);
        kinds.push((which, scale.ok_or_else(|| FigureError::NothingToShow("no tractions".into()))?));
    }
    if profiles.is_empty() {
        return Err(FigureError::NothingToShow("none converged, or the results hold no tractions".into()));
    }
    let x = Scale::spanning(
        (0.0, 1.0),
        [false, false],
        &plot.x_label.as_deref().map_or("x / b".into(), names::with_symbols),
        "",
    );
    let mut panels = Vec::new();
    for panel in 0..groups.panels() {
        for (which, y) in &kinds {
            let of_panel = profiles.iter().filter(|profile| profile.panel == panel);
            let drawn = of_panel.map(|profile| {
                let points = &profile.tractions[*which];
                let style = Style::of(profile.member, &groups.places(profile.member));
                let style = if profile.violated { style.crossed().with_width(DOUBTFUL) } else { style };
                Curve { style, stretches: vec![line(points, y)], marks: marks(profile, points, y) }
            });
            let curves = curves::levels(groups, &x, y).into_iter().chain(drawn).collect();
            panels.push(Panel { name: groups.panel_name(panel), ..Panel::new(x.clone(), y.clone(), curves) });
        }
    }
    let few = profiles.iter().any(|profile| profile.few && !profile.violated);
    let legend = curves::legend(groups, few, profiles.iter().any(|profile| profile.violated));
    Ok(Drawing { panels, abreast: ABREAST, legend, scenes, failed, left_out: None })
}

/// The points of a curve that are marked: all where they are few, some where something contradicts them.
fn marks(profile: &Profile, points: &[(f64, Option<f64>)], y: &Scale) -> Vec<(f64, f64)> {
    let bounded = points.iter().filter_map(|(x, value)| Some((*x, (*value)? / y.unit)));
    if profile.few {
        return bounded.collect();
    }
    let (mut marks, mut next) = (Vec::new(), 0.5 / CROSSES);
    for (x, value) in bounded.filter(|_| profile.violated) {
        if x >= next {
            marks.push((x, value));
            next = x + 1.0 / CROSSES;
        }
    }
    marks
}

/// `None` where there are no numbers.
fn profile(groups: &Groups, shot: &Shot) -> Option<Profile> {
    if !(shot.converged || shot.violated) {
        return None;
    }
    let (record, of) = (&shot.record, |path: &str| number(&shot.record, path).filter(|number| *number > 0.0));
    let b = of("load.half_width")?;
    let divisor = match groups.plot.over {
        Over::Mean => of("pressure.mean")?,
        Over::Modulus => {
            let scene = groups.study.scene_answered(shot.index, number(record, FOUND)).ok()?;
            scene.layer.model().ok()?.surface_shear
        }
        Over::One => 1.0,
    };
    let x: Vec<f64> = record.pointer("/profile/x")?.as_array()?.iter().filter_map(Value::as_f64).collect();
    let stride = x.len().div_ceil(MOST).max(1);
    let column = |name: &str, parity: f64| -> Vec<(f64, Option<f64>)> {
        let values = record.get("profile").and_then(|profile| profile.get(name)).and_then(Value::as_array);
        let last = x.len().saturating_sub(1);
        let all = x.iter().zip(values.into_iter().flatten()).enumerate();
        let kept = all.filter(|(index, _)| index % stride == 0 || *index == last);
        let all: Vec<(f64, Option<f64>)> =
            kept.map(|(_, (x, value))| (x / b, value.as_f64().map(|value| value / divisor))).collect();
        // Both halves are the same, but for the sign of the shear.
        let mirrored = |(x, value): &(f64, Option<f64>)| (-x, value.map(|value| parity * value));
        let right = all.iter().filter(|point| point.0 >= 0.0).copied();
        let mut half: Vec<_> = right.chain(all.iter().filter(|point| point.0 < 0.0).map(mirrored)).collect();
        half.sort_by(|one, other| one.0.total_cmp(&other.0));
        half.dedup_by(|next, before| next.0 - before.0 < 1e-9);
        half
    };
    let tractions = [column("pressure", 1.0), column("shear", -1.0)];
    let few = x.len() <= MARKED;
    Some(Profile { panel: shot.panel, member: shot.member, tractions, few, violated: shot.violated })
}

/// A curve in the units of its scale, continued to a sharp edge.
fn line(points: &[(f64, Option<f64>)], y: &Scale) -> Vec<(f64, f64)> {
    /// Beyond the frame, in its heights: some viewers stumble over huge coordinates.
    const FAR: f64 = 20.0;
    // Of the other half, so that the edge is the end on both sides and not the middle.
    let mirror = points.iter().rev().map(|(x, value)| (-x, *value)).filter(|point| point.0 < 0.0);
    let whole: Vec<_> = mirror.chain(points.iter().copied()).collect();
    let (low, high) = (y.least - FAR * (y.most - y.least), y.most + FAR * (y.most - y.least));
    let half = to_the_edges(&whole).into_iter().filter(|point| point.0 >= 0.0);
    half.map(|(x, value)| (x, (value / y.unit).clamp(low, high))).collect()
}
