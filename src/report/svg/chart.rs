//! Work-precision charts of one scene: a row for each number measured, its error over time, over counted work, and over
//! the tolerance that was asked for.

use super::canvas::{ALARM, INK, LETTERS, filled};
use super::legend::Entry;
use super::panel::{Curve, Ground, Panel};
use super::scale::Scale;
use super::sheet::Sheet;
use super::style::Style;
use crate::chart::{Chart, Ended, Measured, Run};
use kuva::render::color::Color;
use kuva::render::layout::ComputedLayout;
use kuva::render::render::{Primitive, Scene, TextAnchor};

/// Errors that are drawn; what is below is drawn at the lower end.
const LEAST: f64 = 1e-16;
/// Above this there are no errors, but what ended without numbers: a line for each way.
const STRIP: f64 = 2.0;
const TOP: f64 = 3e5;
/// Ways to end without numbers, and where they are written.
const FAILURES: [(&str, &[Ended], f64); 3] = [
    ("refused", &[Ended::Refused], 4e1),
    ("too long", &[Ended::TooLong, Ended::NotTried], 1.3e3),
    ("no number", &[Ended::NotFinite, Ended::Panicked], 3e4),
];

/// What errors are drawn over.
#[derive(Clone, Copy, PartialEq)]
enum Over {
    Time,
    Work,
    Asked,
}

impl Over {
    const ALL: [Self; 3] = [Self::Time, Self::Work, Self::Asked];

    fn name(self) -> &'static str {
        match self {
            Self::Time => "time of a fresh solve (s)",
            Self::Work => "wave numbers, kernels read and multiplications",
            Self::Asked => "tolerance asked for",
        }
    }

    fn of(self, run: &Run) -> Option<f64> {
        match self {
            Self::Time => run.fresh.map(|spread| spread.median),
            Self::Work => Some(run.work() as f64).filter(|work| *work > 0.0),
            Self::Asked => run.setting.resolution.is_none().then_some(run.setting.tolerance),
        }
    }
}

/// The charts of a scene as SVG (UTF-8).
pub fn chart_svg(chart: &Chart) -> String {
    let methods = methods(chart);
    let mut panels = Vec::new();
    for measured in Measured::ALL {
        let charted = |run: &&Run| run.ended.has_numbers() && run.errors.of(measured).is_some();
        let runs: Vec<&Run> = chart.runs.iter().filter(charted).collect();
        if runs.is_empty() {
            continue;
        }
        panels.extend(Over::ALL.map(|over| panel(chart, &methods, &runs, measured, over)));
    }
    let wrong = chart.runs.iter().filter(|run| run.wrong).count();
    let solved = chart.runs.iter().filter(|run| run.ended.has_numbers()).count();
    Sheet {
        title: format!("{}: {}", chart.scene, chart.about),
        notes: vec![
            format!("{solved} of {} runs have numbers", chart.runs.len()),
            "filled marks: converged, as the program says".into(),
            "open marks: flagged by it".into(),
            "black: no run does better with less".into(),
            format!("grey: beyond what {} and {} agree on", chart.judges[0], chart.judges[1]),
        ],
        alarm: if wrong > 0 { vec![format!("{wrong} runs claim success and are wrong")] } else { Vec::new() },
        panels,
        abreast: Over::ALL.len(),
        legend: legend(&methods),
    }
    .draw()
}

/// Names of the methods, in the order of the runs.
fn methods(chart: &Chart) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for run in &chart.runs {
        let name = run.method.name();
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

fn legend(methods: &[String]) -> Vec<Entry> {
    let methods = methods.iter().enumerate().map(|(index, name)| Entry {
        name: name.clone().into(),
        style: Style::of(index, &[]),
        is_line: true,
        is_marked: true,
    });
    let frontier = Entry { name: "Pareto frontier".into(), style: Style::frontier(), is_line: true, is_marked: false };
    methods.chain([frontier]).collect()
}

fn panel(chart: &Chart, methods: &[String], runs: &[&Run], measured: Measured, over: Over) -> Panel {
    let point = |run: &Run| over.of(run).zip(run.errors.of(measured)).map(|(x, error)| (x, error.clamp(LEAST, STRIP)));
    let xs: Vec<f64> = runs.iter().filter_map(|run| over.of(run)).collect();
    let least = xs.iter().copied().fold(f64::INFINITY, f64::min);
    let most = xs.iter().copied().fold(0.0, f64::max);
    let x = Scale::of_powers(least / 1.6, most * 1.6, over.name(), 1, f64::INFINITY);
    let y = Scale::of_powers(LEAST / 2.0, TOP, "relative error", 2, 1.0);
    let place = |(a, b): (f64, f64)| (a / x.unit, b / y.unit);

    let mut curves = Vec::new();
    if over == Over::Asked {
        let line = vec![place((least, least)), place((most, most))];
        curves.push(Curve { style: Style::level(0), stretches: vec![line], marks: Vec::new() });
    } else {
        let all = frontier(runs.iter().filter_map(|run| point(run)));
        let stretches = vec![all.into_iter().map(place).collect()];
        curves.push(Curve { style: Style::frontier(), stretches, marks: Vec::new() });
    }
    for (index, name) in methods.iter().enumerate() {
        let style = Style::of(index, &[]);
        let own = || runs.iter().filter(|run| run.method.name() == *name);
        let points: Vec<(f64, f64)> = own().filter_map(|run| point(run)).collect();
        let line = if over == Over::Asked { points } else { frontier(points) };
        let marks = |ended: Ended| {
            let marked = own().filter(|run| run.ended == ended).filter_map(|run| point(run));
            marked.map(place).collect()
        };
        let stretches = vec![line.into_iter().map(place).collect()];
        curves.push(Curve { style: style.with_open_marks(), stretches, marks: marks(Ended::Flagged) });
        curves.push(Curve { style: style.with_filled_marks(), stretches: Vec::new(), marks: marks(Ended::Converged) });
    }
    let wrong = runs.iter().filter(|run| run.wrong).filter_map(|run| point(run)).map(place).collect();
    let ground = Strips {
        band: chart.band.of(measured).map(|band| band.max(LEAST) / y.unit),
        from: STRIP / y.unit,
        lines: FAILURES.map(|(name, ended, at)| (name, at / y.unit, counts(chart, methods, ended))).into(),
        wrong,
    };
    Panel { name: measured.name().into(), ground: Box::new(ground), ..Panel::new(x, y, curves) }
}

/// How many runs of each method ended like that.
fn counts(chart: &Chart, methods: &[String], ended: &[Ended]) -> Vec<usize> {
    let count = |name: &String| {
        chart.runs.iter().filter(|run| ended.contains(&run.ended) && run.method.name() == *name).count()
    };
    methods.iter().map(count).collect()
}

/// The points that none betters with less.
fn frontier(points: impl IntoIterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
    let mut points: Vec<(f64, f64)> = points.into_iter().collect();
    points.sort_by(|one, other| one.0.total_cmp(&other.0).then(one.1.total_cmp(&other.1)));
    let mut best = f64::INFINITY;
    points.retain(|point| {
        let better = point.1 < best;
        best = best.min(point.1);
        better
    });
    points
}

/// The band in which nothing can be told, and the lines of what ended without numbers. Heights in units of the axis.
struct Strips {
    band: Option<f64>,
    from: f64,
    lines: Vec<(&'static str, f64, Vec<usize>)>,
    /// Runs that claim success and are wrong.
    wrong: Vec<(f64, f64)>,
}

impl Ground for Strips {
    fn draw(&self, scene: &mut Scene, computed: &ComputedLayout, _: &Scale, y: &Scale) {
        let (left, width) = (computed.margin_left, computed.plot_width());
        let shade = |from: f64, to: f64, color: &str| {
            let (top, bottom) = (computed.map_y(to), computed.map_y(from));
            filled((left, top), (width, bottom - top), color, Some(0.5))
        };
        if let Some(band) = self.band.filter(|band| *band > y.least) {
            scene.add(shade(y.least, band.min(self.from), "#cfcfcf"));
        }
        scene.add(shade(self.from, y.most, "#f6e3df"));
        let mut text = |x: f64, y: f64, content: String, anchor: TextAnchor, color: &str, bold: bool| {
            let (size, color) = (LETTERS - 3, Some(Color::from(color)));
            scene.add(Primitive::Text { x, y, content, size, anchor, rotate: None, bold, color });
        };
        for (name, at, counts) in &self.lines {
            let height = computed.map_y(*at) + 0.3 * f64::from(LETTERS);
            text(left + 6.0, height, (*name).into(), TextAnchor::Start, INK, false);
            for (index, count) in counts.iter().enumerate().filter(|(_, count)| **count > 0) {
                let x = left + 86.0 + (width - 96.0) * (index as f64 + 0.5) / counts.len() as f64;
                let color = Style::of(index, &[]).color;
                text(x, height, format!("{count} \u{d7}"), TextAnchor::Middle, color, true);
            }
        }
        for (x, y) in &self.wrong {
            let (cx, cy) = (computed.map_x(*x), computed.map_y(*y));
            let (fill, stroke, stroke_width) = (Color::from(ALARM), Some(Color::from(ALARM)), Some(1.0));
            scene.add(Primitive::Circle { cx, cy, r: 11.0, fill, fill_opacity: Some(0.35), stroke, stroke_width });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_frontier_has_what_none_betters_with_less() {
        let points = [(3.0, 1e-3), (1.0, 1e-2), (2.0, 1e-1), (4.0, 1e-3), (5.0, 1e-9)];
        assert_eq!(frontier(points), [(1.0, 1e-2), (3.0, 1e-3), (5.0, 1e-9)]);
    }
}
