//! Force over indentation and over the sizes of the contact, side by side.

mod trace;

use super::head::{alarm, titled};
use super::legend::Entry;
use super::panel::Panel;
use super::scale::Scale;
use super::sheet::Sheet;
use super::{FigureError, with_numbers};
use crate::engine::{Curve, Solution};
use crate::report::labels::Labels;
use crate::report::scene_line::{GREEK, constant_parts};
use trace::Trace;

const DEPTH: Entry = Entry::line("indentation δ", "#3d7a3d", 2.4, "none");
const CONTACT: Entry = Entry::line("contact b", "#1f4e8c", 2.4, "none");
const STICK: Entry = Entry::line("stick zone a", "#b5401c", 2.4, "8 4");

/// The loading curve as an SVG figure (UTF-8): force over indentation, where there is one, and over the half-widths of
/// contact and stick zone, with the scene in a line under its title. The same solution always gives the same text. Few
/// loads are marked one by one; a load without numbers leaves a gap.
pub fn curve_svg(solution: &Solution) -> Result<String, FigureError> {
    with_numbers(solution)?;
    let curve = solution.path.as_ref().ok_or(FigureError::NoCurve)?;
    let labels = Labels::new(&solution.units);
    let most = curve.force.iter().flatten().copied().fold(0.0, f64::max);
    let force = Scale::up_to(most, "force per length P", &labels.force).ok_or(FigureError::NoCurve)?;
    let drawn = traces(solution, curve);
    let panels: Vec<Panel> = drawn.iter().filter_map(|(traces, name)| panel(traces, name, &force, &labels)).collect();
    if panels.is_empty() {
        return Err(FigureError::NoCurve);
    }
    // Where each panel has one curve its axis says which.
    let legend = drawn.iter().flat_map(|(traces, _)| traces).map(|trace| trace.entry.clone());
    Ok(Sheet {
        title: titled(solution.scene.title.as_deref(), "Loading curve"),
        notes: constant_parts(&solution.scene, &GREEK),
        alarm: alarm(curve.status, curve.note.as_deref()),
        abreast: panels.len(),
        panels,
        legend: if drawn.iter().any(|(traces, _)| traces.len() > 1) { legend.collect() } else { Vec::new() },
    }
    .draw())
}

/// What is known, for each panel, and what the abscissa is called.
fn traces(solution: &Solution, curve: &Curve) -> [(Vec<Trace>, &'static str); 2] {
    // A shape that cannot be had belongs to no solved contact.
    let shape = solution.scene.punch.shape().ok();
    let touched = shape.map(|shape| shape.fixed_half_width().unwrap_or_else(|| shape.face()));
    let within = touched.filter(|half_width| *half_width == 0.0);
    let trace = |entry, column: &Option<Vec<Option<f64>>>, start| {
        Trace::new(entry, column.as_deref().unwrap_or_default(), &curve.force, start)
    };
    let depth: Vec<Trace> = trace(DEPTH, &curve.indentation, Some(0.0)).into_iter().collect();
    let sizes = Trace::new(CONTACT, &curve.half_width, &curve.force, touched).into_iter();
    let sizes: Vec<Trace> = sizes.chain(trace(STICK, &curve.stick_half_width, within)).collect();
    let name = if sizes.len() > 1 { "half-width" } else { "contact half-width b" };
    [(depth, "indentation δ"), (sizes, name)]
}

/// Force over one or two lengths, unless none is above 0.
fn panel(traces: &[Trace], name: &str, force: &Scale, labels: &Labels) -> Option<Panel> {
    let x = Scale::up_to(traces.iter().map(Trace::widest).reduce(f64::max)?, name, &labels.length)?;
    let curves = traces.iter().map(|trace| trace.curve(x.unit, force.unit)).collect();
    Some(Panel::new(x, force.clone(), curves))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::Status;
    use crate::report::samples;
    use crate::report::svg::texts;

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
        assert_eq!((marks(1), marks(24), marks(25)), (3 + 3, 3 * 24 + 3, 0), "three curves and their names");
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
        assert_eq!(curve_svg(&solution), Err(FigureError::NotFinite("`path.force[0]` is no number".into())));
    }
}
