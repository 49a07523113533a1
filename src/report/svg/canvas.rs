//! What figures are drawn on: sizes, letters, a frame, lines in it, and drawings put side by side.

use kuva::plot::{LinePlot, LineStyle};
use kuva::render::color::Color;
use kuva::render::layout::{ComputedLayout, Layout};
use kuva::render::plots::Plot;
use kuva::render::render::{PathData, Primitive, Scene, TextAnchor};

/// Canvas in px; the letters are legible when it is printed 85 mm wide, the column of a journal.
pub(super) const SIZE: (f64, f64) = (620.0, 500.0);
pub(super) const INK: &str = "#222222";
pub(super) const GRID: &str = "#d5d5d5";
pub(super) const ALARM: &str = "#b00020";
/// Width of a line of the grid, px.
pub(super) const THIN: f64 = 0.8;
/// Height of a line of annotations, px.
pub(super) const LINE: f64 = 20.0;
/// Faces of the letters, the first that is there.
const FONTS: &str = "Helvetica, Arial, 'DejaVu Sans', sans-serif";
/// Size of letters beside the axes, px.
pub(super) const LETTERS: u32 = 14;

/// Axes around a frame with a scale below and one beside it: their ranges, the size of all, px, and their labels.
pub(super) fn framed(x: (f64, f64), y: (f64, f64), size: (f64, f64), labels: [&str; 2]) -> Layout {
    Layout::new(x, y)
        .with_width(size.0)
        .with_height(size.1)
        .with_box_axes()
        .with_show_grid(false)
        .with_font_family(FONTS)
        .with_label_size(15)
        .with_tick_size(LETTERS)
        .with_body_size(LETTERS)
        .with_x_label(literal(labels[0]))
        .with_y_label(literal(labels[1]))
}

/// A line through these points, with lengths of dashes and gaps, px, unless it is solid.
pub(super) fn line(
    points: impl IntoIterator<Item = (f64, f64)>,
    color: &str,
    width: f64,
    dashes: Option<&str>,
) -> Plot {
    let style = dashes.map_or(LineStyle::Solid, |dashes| LineStyle::Custom(dashes.into()));
    Plot::Line(LinePlot::new().with_data(points).with_color(color).with_stroke_width(width).with_line_style(style))
}

/// The points of a curve that can be told apart, both ends among them; `place` gives a point's place in its panel,
/// whose sides are 1.
pub(super) fn thinned(points: &[(f64, f64)], place: impl Fn((f64, f64)) -> (f64, f64)) -> Vec<(f64, f64)> {
    /// Points closer than this part of the panel are left out: nobody sees them.
    const UNSEEN: f64 = 1e-3;
    let mut kept: Vec<(f64, f64)> = Vec::new();
    for (index, &point) in points.iter().enumerate() {
        let seen = kept.last().is_none_or(|&last| {
            let (here, there) = (place(point), place(last));
            (here.0 - there.0).abs() > UNSEEN || (here.1 - there.1).abs() > UNSEEN
        });
        if seen || index + 1 == points.len() {
            kept.push(point);
        }
    }
    kept
}

/// Text that kuva shall not take for a formula.
pub(super) fn literal(text: &str) -> String {
    text.replace('$', "\\$")
}

/// Centred text at a place on the canvas.
pub(super) fn write(scene: &mut Scene, x: f64, y: f64, content: String, color: &str, bold: bool) {
    // Bold letters are wider.
    let size = if bold { LETTERS - 2 } else { LETTERS };
    let (anchor, color) = (TextAnchor::Middle, Some(Color::from(color)));
    scene.add(Primitive::Text { x, y, content, size, anchor, rotate: None, bold, color });
}

/// Text in ink at a place on the canvas, turned by so many degrees.
pub(super) fn lettered(
    (x, y): (f64, f64),
    content: String,
    size: u32,
    anchor: TextAnchor,
    rotate: Option<f64>,
) -> Primitive {
    Primitive::Text { x, y, content, size, anchor, rotate, bold: false, color: Some(Color::from(INK)) }
}

/// A rectangle without an outline, from its upper left corner.
pub(super) fn filled((x, y): (f64, f64), (width, height): (f64, f64), color: &str, opacity: Option<f64>) -> Primitive {
    Primitive::Rect { x, y, width, height, fill: Color::from(color), stroke: None, stroke_width: None, opacity }
}

/// A solid line along a path of SVG.
pub(super) fn stroked(d: String, color: &str, width: f64) -> Primitive {
    Primitive::Path(Box::new(PathData {
        d,
        fill: None,
        stroke: Color::from(color),
        stroke_width: width,
        opacity: None,
        stroke_dasharray: None,
    }))
}

/// The frame once more: the shading has covered the inner half of its lines.
pub(super) fn outline(scene: &mut Scene, computed: &ComputedLayout) {
    scene.add(Primitive::Rect {
        x: computed.margin_left,
        y: computed.margin_top,
        width: computed.plot_width(),
        height: computed.plot_height(),
        fill: Color::None,
        stroke: Some(Color::from(INK)),
        stroke_width: Some(1.0),
        opacity: None,
    });
}

/// Puts a drawing of its own into a figure, its clip path under that name; the first brings paper and letters.
pub(super) fn place(figure: &mut Scene, mut drawn: Scene, name: &str, (x, y): (f64, f64)) {
    name_clip(&mut drawn, name);
    if figure.font_family.is_none() {
        (figure.background_color, figure.text_color) = (drawn.background_color.take(), drawn.text_color.take());
        figure.font_family = drawn.font_family.take();
    }
    let transform = Some(format!("translate({x},{y})"));
    figure.add(Primitive::GroupStart { transform, title: None, extra_attrs: None });
    figure.elements.append(&mut drawn.elements);
    figure.defs.append(&mut drawn.defs);
    figure.add(Primitive::GroupEnd);
}

/// kuva numbers its clip paths through the life of the process; the same solution shall give the same text.
pub(super) fn name_clip(scene: &mut Scene, name: &str) {
    for element in &mut scene.elements {
        if let Primitive::ClipStart { id, .. } = element {
            for definition in &mut scene.defs {
                *definition = definition.replace(id.as_str(), name);
            }
            name.clone_into(id);
        }
    }
}
