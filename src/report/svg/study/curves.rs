//! Numbers over an axis or over another number, a curve for each member of a family.

use super::gather::{Groups, Shot};
use super::names;
use super::{ABREAST, Drawing};
use crate::report::svg::FigureError;
use crate::report::svg::legend::Entry;
use crate::report::svg::panel::{Curve, MARKED, Panel};
use crate::report::svg::scale::{Scale, ends};
use crate::report::svg::style::Style;
use crate::study::{Scale as Steps, Source};
use serde_json::Value;

/// Scenes of which the numbers are kept.
const MOST: usize = 200_000;

/// A scene's place in the figure.
struct Row {
    index: u64,
    panel: usize,
    member: usize,
    x: Option<f64>,
    y: Vec<Option<f64>>,
    /// Whether its numbers are as computed, and something contradicts them.
    violated: bool,
}

/// Some of the scenes: all, as long as they are few; then every second, fourth, ... by a hash of their numbers, so that
/// the choice depends on the scenes alone and not on the order in which they come.
#[derive(Default)]
struct Rows {
    kept: Vec<Row>,
    halvings: u32,
}

impl Rows {
    fn add(&mut self, row: Row) {
        if self.keeps(row.index) {
            self.kept.push(row);
        }
        while self.kept.len() > MOST {
            self.halvings += 1;
            let mut kept = std::mem::take(&mut self.kept);
            kept.retain(|row| self.keeps(row.index));
            self.kept = kept;
        }
    }

    fn keeps(&self, index: u64) -> bool {
        // Fibonacci hashing (Knuth, The Art of Computer Programming 3, 6.4): the leading bits are even.
        let hash = index.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        hash.leading_zeros() >= self.halvings
    }
}

pub(super) fn draw(groups: &Groups, records: impl IntoIterator<Item = Value>) -> Result<Drawing, FigureError> {
    let x = groups.shown.x.ok_or_else(|| FigureError::Plot("missing key `x`".into()))?;
    let mut rows = Rows::default();
    // Points of each member for which there is no place.
    let mut without_place = vec![0_u64; groups.members()];
    let (scenes, failed) = groups.each(records, |shot: Shot| {
        let (row, lost) = row(groups, x, &shot);
        without_place[shot.member] += lost;
        rows.add(row);
        Ok(())
    })?;
    let mut rows = rows.kept;
    let out_of_sight = hide_what_is_far(groups, &mut rows);
    let left_out: Vec<String> = left_out(groups, &without_place).into_iter().chain(out_of_sight).collect();
    let left_out = (!left_out.is_empty()).then(|| left_out.join("; "));
    // Along an axis in the order of its values, otherwise in that of the scenes.
    let along = |row: &Row| if matches!(x, Source::Field(_)) { row.x.unwrap_or(f64::INFINITY) } else { 0.0 };
    rows.sort_by(|one, other| along(one).total_cmp(&along(other)).then(one.index.cmp(&other.index)));

    let (x_scale, y_scales) = scales(groups, x, &rows).ok_or_else(|| {
        FigureError::NothingToShow(left_out.as_deref().unwrap_or("none converged with the numbers asked for").into())
    })?;
    let few = rows.len() <= MARKED * groups.panels() * groups.members();
    let mut panels = Vec::new();
    for panel in 0..groups.panels() {
        for (which, y_scale) in y_scales.iter().enumerate() {
            let curves = curves(groups, (panel, which), &rows, (&x_scale, y_scale), few);
            let panel =
                Panel { name: groups.panel_name(panel), ..Panel::new(x_scale.clone(), y_scale.clone(), curves) };
            panels.push(panel);
        }
    }
    let abreast = if y_scales.len() > 1 { y_scales.len().min(ABREAST) } else { ABREAST };
    let has_violated = rows.iter().any(|row| row.violated && row.x.is_some() && row.y.iter().any(Option::is_some));
    Ok(Drawing { panels, abreast, legend: legend(groups, few, has_violated), scenes, failed, left_out })
}

/// A scene's place, and how many of its points have none on the scales.
fn row(groups: &Groups, x: Source, shot: &Shot) -> (Row, u64) {
    let Groups { plot, shown, .. } = *groups;
    let drawable = |value: &f64, scale: Steps| scale == Steps::Linear || *value > 0.0;
    let known = groups.number(shot, x);
    let placed = known.filter(|x| drawable(x, plot.x_scale));
    let (mut ys, mut lost) = (Vec::new(), 0);
    for y in &shown.y {
        let y = groups.number(shot, *y).filter(|_| shot.converged || shot.violated);
        let fits = y.filter(|y| drawable(y, plot.y_scale));
        lost += u64::from(known.is_some() && y.is_some() && (placed.is_none() || fits.is_none()));
        ys.push(fits);
    }
    let Shot { index, panel, member, violated, .. } = *shot;
    (Row { index, panel, member, x: placed, y: ys, violated }, lost)
}

/// Takes out numbers that something contradicts and that lie farther from all others than these from each other: a
/// frame that held them would show little else. Says how many.
fn hide_what_is_far(groups: &Groups, rows: &mut [Row]) -> Option<String> {
    let is_log = groups.plot.y_scale == Steps::Log;
    let along = |y: f64| if is_log { y.ln() } else { y };
    let mut hidden = 0_u64;
    for which in 0..groups.shown.y.len() {
        let sure = rows.iter().filter(|row| !row.violated && row.x.is_some()).filter_map(|row| row.y[which]).map(along);
        let Some((least, most)) = ends(sure) else { continue };
        // Of one number, or of equal ones, its own size.
        let range = if most > least { most - least } else { most.abs().max(1.0) };
        for row in rows.iter_mut().filter(|row| row.violated && row.x.is_some()) {
            let is_far = row.y[which].is_some_and(|y| !(least - range..=most + range).contains(&along(y)));
            if is_far {
                (row.y[which], hidden) = (None, hidden + 1);
            }
        }
    }
    let points = if hidden == 1 { "1 point is".into() } else { format!("{hidden} points are") };
    (hidden > 0).then(|| format!("{points} not shown, an assumption violated and far from all others"))
}

/// The scale of the abscissa and those of the ordinates; `None` where one has no numbers.
fn scales(groups: &Groups, x: Source, rows: &[Row]) -> Option<(Scale, Vec<Scale>)> {
    let Groups { study, plot, shown, .. } = *groups;
    let shown_rows = rows.iter().filter(|row| row.y.iter().any(Option::is_some));
    let xs = shown_rows.filter_map(|row| row.x).chain(plot.points.iter().flat_map(|points| points.x.iter().copied()));
    let (name, unit) = names::of(x, study);
    let name = plot.x_label.as_deref().map_or(name, names::with_symbols);
    let x_scale = scale(xs, plot.x_scale, &name, &unit, false)?;
    let y_scale = |(which, y): (usize, &Source)| {
        let of_points = plot.points.iter().flat_map(|points| points.y.iter().copied());
        let of_lines = plot.lines.iter().map(|line| line.y);
        let ys = rows.iter().filter_map(|row| row.y[which]).chain(of_points).chain(of_lines);
        let (name, unit) = names::of(*y, study);
        let name = plot.y_label.as_deref().map_or(name, names::with_symbols);
        scale(ys, plot.y_scale, &name, &unit, true)
    };
    let y_scales = shown.y.iter().enumerate().map(y_scale).collect::<Option<_>>()?;
    Some((x_scale, y_scales))
}

/// What one panel shows of one ordinate: lines across, a curve for each member, and points.
fn curves(
    groups: &Groups,
    (panel, which): (usize, usize),
    rows: &[Row],
    (x_scale, y_scale): (&Scale, &Scale),
    few: bool,
) -> Vec<Curve> {
    let place = |x: f64, y: f64| (x / x_scale.unit, y / y_scale.unit);
    let mut curves: Vec<Curve> = levels(groups, x_scale, y_scale);
    for member in 0..groups.members() {
        let points: Vec<Option<(f64, f64)>> = rows
            .iter()
            .filter(|row| row.panel == panel && row.member == member)
            .map(|row| row.x.zip(row.y[which]).filter(|_| !row.violated).map(|(x, y)| place(x, y)))
            .collect();
        let curve = curve(groups, member, &points, few);
        let violated = rows.iter().filter(|row| row.panel == panel && row.member == member && row.violated);
        let crosses = thinned_marks(violated.filter_map(|row| Some(place(row.x?, row.y[which]?))));
        let crosses = Curve { style: curve.style.crossed(), stretches: Vec::new(), marks: crosses };
        curves.extend([curve, crosses]);
    }
    curves.extend(groups.plot.points.iter().enumerate().map(|(index, points)| Curve {
        style: Style::points(index),
        stretches: Vec::new(),
        marks: points.x.iter().zip(&points.y).map(|(x, y)| place(*x, *y)).collect(),
    }));
    curves
}

/// How many points of which curves have no place in the figure, and why.
fn left_out(groups: &Groups, without_place: &[u64]) -> Option<String> {
    let all: u64 = without_place.iter().sum();
    let of = |(member, count): (usize, &u64)| format!("{count} of {}", groups.member_name(member));
    let each: Vec<_> = without_place.iter().enumerate().filter(|(_, count)| **count > 0).map(of).collect();
    let each = if without_place.len() > 1 { format!(" ({})", each.join(", ")) } else { String::new() };
    let points = if all == 1 { "1 point has" } else { &format!("{all} points have") };
    (all > 0).then(|| format!("{points} no place on a log axis, being 0 or less{each}"))
}

/// A member's curve; points alone where nothing says which follow each other.
fn curve(groups: &Groups, member: usize, points: &[Option<(f64, f64)>], few: bool) -> Curve {
    let known = || points.iter().flatten().copied();
    let stretches = points.split(Option::is_none).map(|stretch| stretch.iter().flatten().copied().collect());
    // A point between two gaps is no line.
    let lonely = points.split(Option::is_none).filter(|stretch| stretch.len() == 1).flatten().flatten().copied();
    let is_cloud = groups.shown.is_cloud;
    Curve {
        style: Style::of(member, &groups.places(member)),
        marks: if few || is_cloud { thinned_marks(known()) } else { lonely.collect() },
        stretches: if is_cloud { Vec::new() } else { stretches.filter(|s: &Vec<_>| s.len() > 1).collect() },
    }
}

/// No more marks than a viewer copes with.
fn thinned_marks(points: impl Iterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
    const MOST_MARKS: usize = 5000;
    let points: Vec<(f64, f64)> = points.collect();
    let stride = points.len().div_ceil(MOST_MARKS).max(1);
    points.into_iter().step_by(stride).collect()
}

/// Lines across the figure.
pub(super) fn levels(groups: &Groups, x: &Scale, y: &Scale) -> Vec<Curve> {
    let level = |(index, line): (usize, &crate::study::Line)| Curve {
        style: Style::level(index),
        stretches: vec![vec![(x.least, line.y / y.unit), (x.most, line.y / y.unit)]],
        marks: Vec::new(),
    };
    groups.plot.lines.iter().enumerate().map(level).collect()
}

/// Members, lines and points that have a name.
pub(super) fn legend(groups: &Groups, is_marked: bool, has_violated: bool) -> Vec<Entry> {
    let is_cloud = groups.shown.is_cloud;
    let members = (0..groups.members()).map(|member| Entry {
        name: groups.member_name(member).into(),
        style: Style::of(member, &groups.places(member)),
        is_line: !is_cloud,
        is_marked: is_marked || is_cloud,
    });
    let lines = groups.plot.lines.iter().enumerate().map(|(index, line)| Entry {
        name: names::with_symbols(&line.label).into(),
        style: Style::level(index),
        is_line: true,
        is_marked: false,
    });
    let points = groups.plot.points.iter().enumerate().map(|(index, points)| Entry {
        name: names::with_symbols(&points.label).into(),
        style: Style::points(index),
        is_line: false,
        is_marked: true,
    });
    let violated = has_violated.then(|| Entry {
        name: "assumption violated, as computed".into(),
        style: Style::points(0).crossed(),
        is_line: false,
        is_marked: true,
    });
    members.chain(lines).chain(points).chain(violated).filter(|entry| !entry.name.is_empty()).collect()
}

/// A scale that shows all of the numbers; `None` without any. From 0 where the least is small beside the largest, and
/// with room at its ends where asked for.
pub(super) fn scale(
    values: impl Iterator<Item = f64>,
    steps: Steps,
    name: &str,
    unit: &str,
    room: bool,
) -> Option<Scale> {
    /// Part of the largest number below which the least is shown from 0.
    const SMALL: f64 = 0.4;
    let (least, most) = ends(values)?;
    if steps == Steps::Log {
        let factor = if room || least >= most { (most / least).powf(0.05).max(1.02) } else { 1.0 };
        return Some(Scale::logarithmic(least / factor, most * factor, name, unit));
    }
    Some(if least >= 0.0 && least <= SMALL * most && most > 0.0 {
        Scale::spanning((0.0, most), [false, room], name, unit)
    } else if most <= 0.0 && most >= SMALL * least && least < 0.0 {
        Scale::spanning((least, 0.0), [room, false], name, unit)
    } else {
        Scale::spanning((least, most), [room, room], name, unit)
    })
}
