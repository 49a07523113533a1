//! Force over indentation and over the sizes of the contact, side by side.

mod trace;

use super::axis::Axis;
use super::head::Head;
use super::legend::{Entry, LEGEND, under_frame};
use super::{FigureError, GRID, SIZE, THIN, alarm, framed, line, outline, place};
use crate::engine::{Curve, Solution, Status, first_not_finite};
use crate::report::labels::Labels;
use crate::report::scene_line::{GREEK, constant_parts};
use kuva::backend::svg::SvgBackend;
use kuva::render::color::Color;
use kuva::render::layout::ComputedLayout;
use kuva::render::plots::Plot;
use kuva::render::render::{Primitive, Scene, render_multiple};
use trace::Trace;

const DEPTH: Entry = Entry::line("indentation δ", "#1f4e8c", 2.4, "none");
const CONTACT: Entry = Entry::line("contact b", "#1f4e8c", 2.4, "none");
const STICK: Entry = Entry::line("stick zone a", "#b5401c", 2.4, "8 4");

/// Height of a panel, px; it is as wide as the figure of the tractions.
const PANEL: f64 = 420.0;
/// Points up to which each is marked: a curve through few says where they are.
const MARKED: usize = 24;
/// Radius of a mark, px.
const MARK: f64 = 3.2;

/// The loading curve as an SVG figure (UTF-8): force over indentation, where there is one, and over the half-widths of
/// contact and stick zone, with the scene in a line under its title. The same solution always gives the same text. Few
/// loads are marked one by one; a load without numbers leaves a gap.
pub fn curve_svg(solution: &Solution) -> Result<String, FigureError> {
    if solution.status == Status::Refused {
        return Err(FigureError::Refused(solution.reason.clone().unwrap_or_default()));
    }
    if let Some(found) = first_not_finite(solution) {
        return Err(FigureError::NotFinite(found));
    }
    let curve = solution.path.as_ref().ok_or(FigureError::NoCurve)?;
    let labels = Labels::new(&solution.units);
    let force = Axis::over(&curve.force, "force per length P", &labels.force).ok_or(FigureError::NoCurve)?;
    let panels = panels(solution, curve, &labels);
    if panels.is_empty() {
        return Err(FigureError::NoCurve);
    }

    let parts = constant_parts(&solution.scene, &GREEK);
    let alarm = alarm(curve.status, curve.note.as_deref());
    let title = solution.scene.title.as_deref();
    let head = Head::new(title, "Loading curve", &parts, &alarm, panels.len());
    let mut figure = Scene::new(SIZE.0 * panels.len() as f64, head.height + PANEL);
    for (index, panel) in panels.into_iter().enumerate() {
        let at = (SIZE.0 * index as f64, head.height);
        place(&mut figure, draw(&panel, &force), &format!("frame{index}"), at);
    }
    figure.elements.extend(head.lines);
    Ok(SvgBackend::new().with_pretty(true).render_scene(&figure))
}

/// Force over one or two lengths.
struct Panel {
    axis: Axis,
    traces: Vec<Trace>,
    /// Whether a legend must tell the curves apart.
    legend: bool,
}

/// Those of the panels that have something to show.
fn panels(solution: &Solution, curve: &Curve, labels: &Labels) -> Vec<Panel> {
    // A shape that cannot be had belongs to no solved contact.
    let shape = solution.scene.punch.shape().ok();
    let touched = shape.map(|shape| shape.fixed_half_width().unwrap_or_else(|| shape.face()));
    let within = touched.filter(|half_width| *half_width == 0.0);
    let trace = |entry, column: &Option<Vec<Option<f64>>>, start| {
        Trace::new(entry, column.as_deref().unwrap_or_default(), &curve.force, start)
    };
    // All share a place under their axis for a legend, so that the frames stand in a line.
    let legend = curve.stick_half_width.is_some();
    let depth: Vec<Trace> = trace(DEPTH, &curve.indentation, Some(0.0)).into_iter().collect();
    let sizes = Trace::new(CONTACT, &curve.half_width, &curve.force, touched).into_iter();
    let sizes: Vec<Trace> = sizes.chain(trace(STICK, &curve.stick_half_width, within)).collect();
    let name = if sizes.len() > 1 { "half-width" } else { "contact half-width b" };
    [(depth, "indentation δ"), (sizes, name)]
        .into_iter()
        .filter_map(|(traces, name)| {
            let axis = Axis::new(traces.iter().map(Trace::widest).reduce(f64::max)?, name, &labels.length)?;
            Some(Panel { axis, traces, legend })
        })
        .collect()
}

/// A panel by itself.
fn draw(panel: &Panel, force: &Axis) -> Scene {
    let labels = [panel.axis.label.as_str(), &force.label];
    let layout = framed((0.0, panel.axis.most), (0.0, force.most), (SIZE.0, PANEL), labels)
        .with_x_axis_min(0.0)
        .with_x_axis_max(panel.axis.most)
        .with_y_axis_min(0.0)
        .with_y_axis_max(force.most)
        .with_x_tick_step(panel.axis.step)
        .with_y_tick_step(force.step)
        .with_x_tick_format(panel.axis.ticks())
        .with_y_tick_format(force.ticks());
    let below = if panel.legend { LEGEND } else { 0.0 };
    let plain = ComputedLayout::from_layout(&layout);
    let layout =
        layout.with_force_margins_y(plain.margin_top, plain.margin_bottom + below).with_x_label_offset(0.0, -below);
    let computed = ComputedLayout::from_layout(&layout);

    let mut plots = grid(&panel.axis, force);
    for trace in &panel.traces {
        plots.extend(trace.segments(panel.axis.unit, force.unit, [panel.axis.most, force.most]).map(|points| {
            let style = &trace.entry.style;
            line(points, style.color, style.width, Some(style.dashes))
        }));
    }
    let mut scene = render_multiple(plots, layout);
    for trace in &panel.traces {
        mark(&mut scene, &computed, trace, panel.axis.unit, force.unit);
    }
    outline(&mut scene, &computed);
    if panel.traces.len() > 1 {
        let entries: Vec<Entry> = panel.traces.iter().map(|trace| trace.entry.clone()).collect();
        under_frame(&entries, &mut scene, &computed);
    }
    scene
}

/// Lines at the ticks, under the curves.
fn grid(axis: &Axis, force: &Axis) -> Vec<Plot> {
    let rule = |ends: [(f64, f64); 2]| line(ends, GRID, THIN, None);
    let upright = axis.inner_ticks().map(|x| rule([(x, 0.0), (x, force.most)]));
    upright.chain(force.inner_ticks().map(|y| rule([(0.0, y), (axis.most, y)]))).collect()
}

/// Marks the points of a curve that has few.
fn mark(scene: &mut Scene, computed: &ComputedLayout, trace: &Trace, unit: f64, force_unit: f64) {
    if trace.known() > MARKED {
        return;
    }
    for (x, y) in trace.points().filter(|(x, y)| *x >= 0.0 && *y >= 0.0) {
        scene.add(Primitive::Circle {
            cx: computed.map_x(x / unit),
            cy: computed.map_y(y / force_unit),
            r: MARK,
            fill: Color::from("#ffffff"),
            fill_opacity: None,
            stroke: Some(Color::from(trace.entry.style.color)),
            stroke_width: Some(1.6),
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::samples;

    /// All text of a figure; fails on what is no XML.
    fn texts(svg: &str) -> Vec<String> {
        let document = roxmltree::Document::parse(svg).expect("well-formed XML");
        document.descendants().filter(|n| n.has_tag_name("text")).filter_map(|n| n.text()).map(Into::into).collect()
    }

    /// The column of a curve that has it.
    fn column(column: &mut Option<Vec<Option<f64>>>) -> &mut Vec<Option<f64>> {
        column.as_mut().expect("a column")
    }

    #[test]
    fn curves_and_axes_are_named_with_their_units() {
        let found = texts(&curve_svg(&samples::loading_curve()).expect("a curve"));
        for name in ["force per length P (N/mm)", "indentation δ (mm)", "half-width (mm)", "contact b", "stick zone a"]
        {
            assert!(found.iter().any(|text| text == name), "{name} in {found:?}");
        }
        let scene = found.iter().find(|text| text.contains("exponential")).expect("the scene");
        assert!(scene.starts_with("h = 5 mm, "), "no number of the last load alone: {scene}");
        let mut solution = samples::loading_curve();
        let curve = solution.path.as_mut().expect("a curve");
        (curve.indentation, curve.stick_half_width, curve.stick_ratio) = (None, None, None);
        let found = texts(&curve_svg(&solution).expect("a curve"));
        assert!(found.contains(&"contact half-width b (mm)".to_owned()), "{found:?}");
        assert!(!found.iter().any(|text| text.contains("stick") || text.contains('δ')), "{found:?}");
    }

    #[test]
    fn the_same_solution_gives_the_same_figure() {
        let solution = samples::loading_curve();
        let figure = curve_svg(&solution).expect("a curve");
        assert_eq!(curve_svg(&solution).expect("a curve"), figure);
        for frame in ["frame0", "frame1"] {
            assert!(figure.contains(&format!("url(#{frame})")), "each panel clips its own curves");
        }
    }

    #[test]
    fn few_points_are_marked_and_many_are_not() {
        let marks = |points: usize| {
            let mut solution = samples::loading_curve();
            let curve = solution.path.as_mut().expect("a curve");
            curve.force.truncate(points);
            let figure = curve_svg(&solution).expect("a curve");
            figure.matches("<circle").count()
        };
        assert_eq!((marks(1), marks(24), marks(25)), (3, 72, 0), "three curves");
    }

    #[test]
    fn odd_numbers_still_fit_a_figure() {
        for odd in [None, Some(0.0), Some(-1.0), Some(1e300), Some(1e-300)] {
            let mut solution = samples::loading_curve();
            let curve = solution.path.as_mut().expect("a curve");
            (curve.force[3], curve.half_width[7]) = (odd, odd);
            column(&mut curve.indentation)[59] = odd;
            column(&mut curve.stick_half_width).fill(odd);
            let figure = curve_svg(&solution).expect("a curve");
            texts(&figure);
            assert!(!figure.contains("NaN") && !figure.contains("inf"), "{odd:?}: {figure}");
        }
    }

    #[test]
    fn what_failed_is_told() {
        let mut solution = samples::loading_curve();
        solution.scene.title = Some("a < b & $1".into());
        let curve = solution.path.as_mut().expect("a curve");
        (curve.status, curve.note) = (Status::Refused, Some("1 of 60 loads have no numbers at $2 & up".into()));
        let found = texts(&curve_svg(&solution).expect("a curve"));
        for text in ["a < b & $1", "INCOMPLETE: 1 of 60 loads have no numbers at $2 & up"] {
            assert!(found.iter().any(|found| found == text), "{text} in {found:?}");
        }
    }

    #[test]
    fn without_numbers_there_is_no_figure() {
        assert!(matches!(curve_svg(&samples::refused()), Err(FigureError::Refused(_))));
        assert_eq!(curve_svg(&samples::flat_with_friction()), Err(FigureError::NoCurve));
        let mut solution = samples::loading_curve();
        solution.path.as_mut().expect("a curve").force.fill(None);
        assert_eq!(curve_svg(&solution), Err(FigureError::NoCurve));
        solution.path.as_mut().expect("a curve").force[0] = Some(f64::NAN);
        assert_eq!(curve_svg(&solution), Err(FigureError::NotFinite("`path.force[0]` is NaN".into())));
    }
}
