//! Lines of equal value on a map.

use super::between::Between;
use crate::report::svg::canvas::{LETTERS, filled, lettered, stroked};
use crate::report::svg::scale::{Scale, ends};
use kuva::render::layout::ComputedLayout;
use kuva::render::render::{Scene, TextAnchor};

/// Numbers as close as this, relative, may be the same.
const ROUNDED: f64 = 1e-9;

/// Both ends of a straight part of a line.
type Part = [(f64, f64); 2];

/// A line at each tick of the scale, with its number where there is room.
pub(super) fn draw(scene: &mut Scene, computed: &ComputedLayout, between: &Between, scale: &Scale) {
    // A line around a plateau at the least or the largest value is where the numbers round to that, if anywhere.
    let ends = ends(between.values.iter().flatten().copied());
    let is_end = |level: f64, end: f64| (level - end).abs() <= ROUNDED * level.abs().max(end.abs());
    let is_passed = |level: &f64| ends.is_some_and(|(least, most)| !is_end(*level, least) && !is_end(*level, most));
    let mut named = Vec::new();
    for level in scale.ticks_within().into_iter().filter(is_passed) {
        let parts = level_line(between, level);
        if parts.is_empty() {
            continue;
        }
        named.extend(place_of_name(&parts, computed, &named).map(|at| (at, level)));
        let part = |[(x1, y1), (x2, y2)]: &Part| format!("M{x1:.2} {y1:.2}L{x2:.2} {y2:.2}");
        scene.add(stroked(parts.iter().map(part).collect(), "#ffffff", 1.1));
    }
    for (at, level) in named {
        name(scene, at, scale.written(level));
    }
}

/// Where a number passes through a level: marching squares with straight lines. Squares with a missing corner are left
/// out.
fn level_line(Between { columns, rows, values, .. }: &Between, level: f64) -> Vec<Part> {
    let mut parts = Vec::new();
    for row in 1..rows.len() {
        for column in 1..columns.len() {
            // Around the square.
            let corners = [(column - 1, row - 1), (column, row - 1), (column, row), (column - 1, row)];
            let known: Vec<(f64, f64, f64)> = corners
                .iter()
                .filter_map(|(c, r)| Some((columns[*c], rows[*r], values[r * columns.len() + c]? - level)))
                .collect();
            if known.len() < corners.len() {
                continue;
            }
            let crossing = |side: usize| {
                let ((x1, y1, v1), (x2, y2, v2)) = (known[side], known[(side + 1) % 4]);
                let share = v1 / (v1 - v2);
                ((v1 < 0.0) != (v2 < 0.0)).then_some((x1 + share * (x2 - x1), y1 + share * (y2 - y1)))
            };
            let crossings: Vec<(f64, f64)> = (0..4).filter_map(crossing).collect();
            parts.extend(crossings.chunks_exact(2).map(|ends| [ends[0], ends[1]]));
        }
    }
    parts
}

/// Where the number of a line stands on it, as near as may be to the middle of the frame; nowhere on a line that is not
/// much longer than the number, and not on the number of another line.
fn place_of_name(parts: &[Part], computed: &ComputedLayout, taken: &[((f64, f64), f64)]) -> Option<(f64, f64)> {
    /// Lengths in px: of a line that has a number, between two numbers, and from a number to the frame.
    const LENGTH: f64 = 60.0;
    const APART: f64 = 40.0;
    const INSIDE: f64 = 20.0;
    let distance = |(x1, y1): (f64, f64), (x2, y2): (f64, f64)| (x1 - x2).hypot(y1 - y2);
    if parts.iter().map(|[from, to]| distance(*from, *to)).sum::<f64>() < LENGTH {
        return None;
    }
    let (left, top) = (computed.margin_left, computed.margin_top);
    let (right, bottom) = (left + computed.plot_width(), top + computed.plot_height());
    let middle = (f64::midpoint(left, right), f64::midpoint(top, bottom));
    let is_inside = |(x, y): (f64, f64)| (x - left).min(right - x).min(y - top).min(bottom - y) > INSIDE;
    parts
        .iter()
        .map(|[from, to]| (f64::midpoint(from.0, to.0), f64::midpoint(from.1, to.1)))
        .filter(|at| is_inside(*at) && taken.iter().all(|(other, _)| distance(*at, *other) > APART))
        .min_by(|one, other| distance(*one, middle).total_cmp(&distance(*other, middle)))
}

/// Writes the number of a line on a light ground, which all colours need.
fn name(scene: &mut Scene, (x, y): (f64, f64), content: String) {
    const SIZE: u32 = LETTERS - 2;
    let (height, width) = (f64::from(SIZE) + 2.0, 0.6 * f64::from(SIZE) * content.chars().count() as f64 + 4.0);
    scene.add(filled((x - width / 2.0, y - height / 2.0), (width, height), "#ffffff", Some(0.8)));
    scene.add(lettered((x, y + 0.35 * f64::from(SIZE)), content, SIZE, TextAnchor::Middle, None));
}
