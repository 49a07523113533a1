//! A number over two axes, in colours, with lines of equal value.

mod between;
mod levels;

use super::gather::Groups;
use super::{ABREAST, Drawing, names};
use crate::report::svg::FigureError;
use crate::report::svg::canvas::{INK, LETTERS, filled, lettered, literal};
use crate::report::svg::panel::{Ground, MARKED, Panel};
use crate::report::svg::scale::{Scale, ends};
use crate::study::{Cell, Place, Scale as Steps, Source};
use between::Between;
use kuva::plot::ColorMap;
use kuva::render::color::Color;
use kuva::render::layout::ComputedLayout;
use kuva::render::plots::Plot;
use kuva::render::render::{Primitive, Scene, TextAnchor};
use serde_json::Value;

/// Most cells along an axis: of more steps some are left out.
const MOST: u64 = 160;
/// Readable in grey, and for eyes that do not tell red from green.
const COLORS: ColorMap = ColorMap::Viridis;
/// Cells without a number, crossed out.
pub(super) const MISSING: &str = "#e8e8e8";

/// A panel's colours and what they mean.
pub(super) struct Cells {
    /// Middles of the columns and of the rows, in units of the axes.
    middles: [Vec<f64>; 2],
    /// Edges of the columns and of the rows, in units of the axes.
    columns: Vec<f64>,
    rows: Vec<f64>,
    /// Numbers row by row, in units of the scale.
    values: Vec<Option<f64>>,
    scale: Scale,
}

pub(super) fn draw(groups: &Groups, records: impl IntoIterator<Item = Value>) -> Result<Drawing, FigureError> {
    let Groups { study, plot, shown, .. } = *groups;
    let (Some(Source::Field(x)), [Source::Field(y)], Some(z)) = (shown.x, &shown.y[..], shown.z) else {
        return Err(FigureError::Plot("a map is drawn over two axes".into()));
    };
    let axes = [(x, plot.x_scale, &plot.x_label), (*y, plot.y_scale, &plot.y_label)];
    let mut grids = Vec::new();
    for (place, steps, label) in axes {
        grids.push(Grid::new(groups, place, steps, label.as_deref())?);
    }
    let [columns, rows] = &grids[..] else { unreachable!("two axes") };
    let count = columns.middles.len() * rows.middles.len();
    let mut values = vec![vec![None; count]; groups.panels()];
    let (scenes, failed) = groups.each(records, |shot| {
        let number = groups.number(&shot, z).filter(|_| shot.converged);
        if let (Some(column), Some(row)) = (columns.of(shot.steps[x.axis]), rows.of(shot.steps[y.axis])) {
            values[shot.panel][row * columns.middles.len() + column] = number;
        }
        Ok(())
    })?;
    let (name, unit) = names::of(z, study);
    let (least, most) = ends(values.iter().flatten().flatten().copied())
        .ok_or_else(|| FigureError::NothingToShow("none converged with the number asked for".into()))?;
    let scale = Scale::spanning((least, most), [false, false], &name, &unit);
    let panels = values.into_iter().enumerate().map(|(panel, values)| Panel {
        name: groups.panel_name(panel),
        ground: Box::new(Cells {
            middles: [columns, rows].map(|grid| grid.middles.iter().map(|middle| middle.1 / grid.scale.unit).collect()),
            columns: columns.edges.clone(),
            rows: rows.edges.clone(),
            values: values.into_iter().map(|value| value.map(|value| value / scale.unit)).collect(),
            scale: scale.clone(),
        }),
        ..Panel::new(columns.scale.clone(), rows.scale.clone(), Vec::new())
    });
    Ok(Drawing { panels: panels.collect(), abreast: ABREAST, legend: Vec::new(), scenes, failed, left_out: None })
}

/// An axis of a map: its steps in the order of their values, and the cells around them.
struct Grid {
    /// Step and value.
    middles: Vec<(u64, f64)>,
    /// One more than the middles, half way between them.
    edges: Vec<f64>,
    scale: Scale,
}

impl Grid {
    fn new(groups: &Groups, place: Place, steps: Steps, label: Option<&str>) -> Result<Self, FigureError> {
        let (name, unit) = names::of(Source::Field(place), groups.study);
        let name = label.map_or(name, names::with_symbols);
        let refused = |what: &str| FigureError::Plot(format!("an axis of a map {what}: {name}"));
        let column = &groups.study.axes[place.axis].columns[place.column];
        let all = groups.study.shown_steps(groups.shown, place.axis, MOST);
        let value = |step: &u64| match column.cell(*step) {
            Cell::Number(number) => Some((*step, number)),
            Cell::Text(_) => None,
        };
        let mut middles: Vec<(u64, f64)> = all.iter().filter_map(value).collect();
        middles.sort_by(|one, other| one.1.total_cmp(&other.1));
        if middles.windows(2).any(|pair| pair[0].1.total_cmp(&pair[1].1).is_eq()) {
            return Err(refused("has each value once"));
        }
        if middles.len() < 2 {
            return Err(refused("has at least two values"));
        }
        let is_log = steps == Steps::Log;
        if is_log && middles[0].1 <= 0.0 {
            return Err(refused("with `log` steps has values above 0"));
        }
        let to = |v: f64| if is_log { v.ln() } else { v };
        let from = |v: f64| if is_log { v.exp() } else { v };
        let places: Vec<f64> = middles.iter().map(|middle| to(middle.1)).collect();
        let between = places.windows(2).map(|pair| f64::midpoint(pair[0], pair[1]));
        let (first, last) = (places[0], places[places.len() - 1]);
        let before = first - (places[1] - first) / 2.0;
        let after = last + (last - places[places.len() - 2]) / 2.0;
        let edges: Vec<f64> = [before].into_iter().chain(between).chain([after]).map(from).collect();
        let ends = (edges[0], edges[edges.len() - 1]);
        let scale = if is_log {
            Scale::logarithmic(ends.0, ends.1, &name, &unit)
        } else {
            Scale::spanning(ends, [false, false], &name, &unit)
        };
        let edges = edges.into_iter().map(|edge| edge / scale.unit).collect();
        Ok(Self { middles, edges, scale })
    }

    /// The place of a step; `None` where it is left out.
    fn of(&self, step: u64) -> Option<usize> {
        self.middles.iter().position(|middle| middle.0 == step)
    }
}

impl Ground for Cells {
    /// The bar, its numbers and its name.
    fn room(&self) -> f64 {
        120.0
    }

    /// None to be seen.
    fn rules(&self, _: &Scale, _: &Scale) -> Vec<Plot> {
        Vec::new()
    }

    fn draw(&self, scene: &mut Scene, computed: &ComputedLayout, x: &Scale, y: &Scale) {
        let (left, top) = (computed.margin_left, computed.margin_top);
        let (width, height) = (computed.plot_width(), computed.plot_height());
        let across = |edge: f64| x.across(computed, edge);
        let up = |edge: f64| y.up(computed, edge);
        let count = self.columns.len() - 1;
        let mut crosses = Vec::new();
        for (index, value) in self.values.iter().enumerate() {
            let (column, row) = (index % count, index / count);
            let (x1, x2) = (across(self.columns[column]), across(self.columns[column + 1]));
            let (y1, y2) = (up(self.rows[row + 1]), up(self.rows[row]));
            let fill = value.map_or_else(|| MISSING.to_owned(), |value| COLORS.map(self.scale.place(value)));
            // A hair of overlap: viewers leave light seams between neighbours.
            let seam = if value.is_some() { 0.4 } else { 0.0 };
            let size = ((x2 - x1 + seam).min(left + width - x1), (y2 - y1 + seam).min(top + height - y1));
            scene.add(filled((x1, y1), size, &fill, None));
            if value.is_none() {
                crosses.extend([((x1, y1), (x2, y2)), ((x1, y2), (x2, y1))]);
            }
        }
        for ((x1, y1), (x2, y2)) in crosses {
            let stroke = Color::from("#8c8c8c");
            scene.add(Primitive::Line { x1, y1, x2, y2, stroke, stroke_width: 0.8, stroke_dasharray: None });
        }
        let [columns, rows] = &self.middles;
        let columns: Vec<f64> = columns.iter().map(|middle| across(*middle)).collect();
        let rows: Vec<f64> = rows.iter().map(|middle| up(*middle)).collect();
        let between = Between::new([&columns, &rows], [(left, left + width), (top + height, top)], &self.values);
        between.draw(scene, |value| COLORS.map(self.scale.place(value)));
        levels::draw(scene, computed, &between, &self.scale);
        if columns.len().max(rows.len()) <= MARKED {
            for (index, _) in self.values.iter().enumerate().filter(|(_, value)| value.is_some()) {
                let (cx, cy) = (columns[index % count], rows[index / count]);
                let (fill, fill_opacity) = (Color::from(INK), Some(0.5));
                scene.add(Primitive::Circle { cx, cy, r: 1.6, fill, fill_opacity, stroke: None, stroke_width: None });
            }
        }
        self.bar(scene, computed);
    }
}

impl Cells {
    /// The bar of colours with its numbers.
    fn bar(&self, scene: &mut Scene, computed: &ComputedLayout) {
        const BAR: f64 = 18.0;
        const PARTS: u16 = 64;
        let left = computed.margin_left + computed.plot_width() + 18.0;
        let (top, height) = (computed.margin_top, computed.plot_height());
        let part = height / f64::from(PARTS);
        for index in 0..PARTS {
            let place = 1.0 - (f64::from(index) + 0.5) / f64::from(PARTS);
            let overlap = if index + 1 < PARTS { 0.4 } else { 0.0 };
            scene.add(filled((left, top + part * f64::from(index)), (BAR, part + overlap), &COLORS.map(place), None));
        }
        for tick in self.scale.ticks_within() {
            let y = top + height * (1.0 - self.scale.place(tick));
            let content = self.scale.written(tick);
            let at = (left + BAR + 6.0, y + 0.33 * f64::from(LETTERS));
            scene.add(lettered(at, content, LETTERS - 1, TextAnchor::Start, None));
        }
        let at = (left + BAR + 66.0, top + height / 2.0);
        scene.add(lettered(at, literal(&self.scale.label), LETTERS, TextAnchor::Middle, Some(-90.0)));
    }
}
