//! A map of the atlas: a panel of cells for each method.

use super::canvas::{INK, LETTERS, filled, lettered, stroked};
use super::panel::{Ground, Panel};
use super::scale::Scale;
use super::sheet::Sheet as Page;
use crate::chart::atlas::{Axis, Cell, Sheet};
use crate::report::number::typeset;
use kuva::render::color::Color;
use kuva::render::layout::ComputedLayout;
use kuva::render::plots::Plot;
use kuva::render::render::{Primitive, Scene, TextAnchor};

/// Viridis in nine steps of one and a half digits: readable in grey, and for eyes that do not tell red from green.
const STEPS: [&str; 9] =
    ["#440154", "#472d7b", "#3b528b", "#2c728e", "#21918c", "#28ae80", "#5ec962", "#addc30", "#fde725"];
const STEP: f64 = 1.5;
const REFUSED: &str = "#000000";
const UNJUDGED: &str = "#dddddd";
const WRONG: &str = "#d0021b";

/// A map as SVG (UTF-8).
pub fn atlas_svg(sheet: &Sheet) -> String {
    let scale = |axis: Axis, most: usize| Scale::of_names(written(axis.values), axis.name, most);
    let (x, y) = (scale(sheet.x, 7), scale(sheet.y, 30));
    let panel = |mapped: &crate::chart::atlas::Mapped| Panel {
        name: mapped.method.clone(),
        ground: Box::new(Cells { columns: sheet.x.values.len(), cells: mapped.cells.clone() }),
        ..Panel::new(x.clone(), y.clone(), Vec::new())
    };
    let wrong = |is_default: bool| {
        sheet
            .methods
            .iter()
            .filter(|mapped| mapped.is_default == is_default)
            .map(crate::chart::atlas::Mapped::wrong)
            .sum::<usize>()
    };
    let own = wrong(true);
    Page {
        title: format!("{}: {}", sheet.name, sheet.about),
        notes: vec![
            "black: refused, with a reason".into(),
            "striped red: claims success and is wrong".into(),
            "dot: flagged by the program".into(),
            "grey: no judge".into(),
        ],
        alarm: if own > 0 {
            vec![format!("{own} cells of the program's own choice claim success and are wrong")]
        } else {
            Vec::new()
        },
        panels: sheet.methods.iter().map(panel).collect(),
        abreast: 3,
        legend: Vec::new(),
    }
    .draw()
}

/// Numbers of an axis in full, unless one of them is long: then each in full or as a power of ten, whichever is
/// shorter.
fn written(values: &[f64]) -> Vec<String> {
    const LONG: usize = 6;
    let in_full = |value: &f64| typeset(&value.to_string());
    let shorter = |value: &f64| {
        let (full, power) = (in_full(value), typeset(&format!("{value:e}")));
        if power.chars().count() < full.chars().count() { power } else { full }
    };
    let is_short = values.iter().all(|value| in_full(value).chars().count() <= LONG);
    values.iter().map(|value| if is_short { in_full(value) } else { shorter(value) }).collect()
}

/// The cells of one method, row by row from below.
struct Cells {
    columns: usize,
    cells: Vec<Cell>,
}

/// Colour of a number of digits.
fn color(digits: f64) -> &'static str {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates, and few")]
    let step = (digits / STEP) as usize;
    STEPS[step.min(STEPS.len() - 1)]
}

fn fill(cell: &Cell) -> &'static str {
    match cell.digits {
        _ if !cell.ended.has_numbers() => REFUSED,
        _ if cell.wrong => "#ffffff",
        Some(digits) => color(digits),
        None => UNJUDGED,
    }
}

impl Ground for Cells {
    /// The colours and what they mean.
    fn room(&self) -> f64 {
        96.0
    }

    /// None to be seen.
    fn rules(&self, _: &Scale, _: &Scale) -> Vec<Plot> {
        Vec::new()
    }

    fn draw(&self, scene: &mut Scene, computed: &ComputedLayout, x: &Scale, y: &Scale) {
        let across = |edge: f64| x.across(computed, edge);
        let up = |edge: f64| y.up(computed, edge);
        for (index, cell) in self.cells.iter().enumerate() {
            let (column, row) = ((index % self.columns) as f64, (index / self.columns) as f64);
            let (x1, x2) = (across(column - 0.5), across(column + 0.5));
            let (y1, y2) = (up(row + 0.5), up(row - 0.5));
            let (width, height) = (x2 - x1 - 0.6, y2 - y1 - 0.6);
            scene.add(filled((x1, y1), (width, height), fill(cell), None));
            if cell.wrong {
                scene.add(stripes(x1, y1, width, height));
            } else if cell.ended == crate::chart::Ended::Flagged {
                let (cx, cy) = (f64::midpoint(x1, x2), f64::midpoint(y1, y2));
                let (fill, stroke, stroke_width) = (Color::from("#ffffff"), Some(Color::from(INK)), Some(0.8));
                scene.add(Primitive::Circle { cx, cy, r: 2.2, fill, fill_opacity: None, stroke, stroke_width });
            }
        }
        bar(scene, computed);
    }
}

/// Diagonal stripes over a cell.
fn stripes(x: f64, y: f64, width: f64, height: f64) -> Primitive {
    let lines = [0.25, 0.75, 1.25, 1.75].map(|place: f64| {
        // From the left or the lower side to the upper or the right one.
        let (from, to) = ((place.min(1.0), (place - 1.0).max(0.0)), ((place - 1.0).max(0.0), place.min(1.0)));
        let at = |(down, along): (f64, f64)| format!("{:.2} {:.2}", x + along * width, y + down * height);
        format!("M{}L{}", at(from), at(to))
    });
    stroked(lines.concat(), WRONG, 2.4)
}

/// The colours with their digits.
fn bar(scene: &mut Scene, computed: &ComputedLayout) {
    let left = computed.margin_left + computed.plot_width() + 14.0;
    let (top, height) = (computed.margin_top, computed.plot_height());
    let part = height / STEPS.len() as f64;
    for (index, color) in STEPS.into_iter().enumerate() {
        let y = top + height - part * (index + 1) as f64;
        scene.add(filled((left, y), (14.0, part), color, None));
        let content = format!("{}", STEP * index as f64);
        let at = (left + 19.0, y + part + 0.33 * f64::from(LETTERS));
        scene.add(lettered(at, content, LETTERS - 2, TextAnchor::Start, None));
    }
    let at = (left + 60.0, top + height / 2.0);
    scene.add(lettered(at, "digits".into(), LETTERS - 1, TextAnchor::Middle, Some(-90.0)));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_is_written_in_one_way() {
        assert_eq!(written(&[1e-3, 3e-3, 10.0, 1e4]), ["0.001", "0.003", "10", "10000"]);
        let long = [-1e-4, -1e-16, 1e-3, 0.01, 0.3, 0.499_999, 300.0, 1e6];
        assert_eq!(written(&long), ["−10⁻⁴", "−10⁻¹⁶", "10⁻³", "0.01", "0.3", "0.499999", "300", "10⁶"]);
    }
}
