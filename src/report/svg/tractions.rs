//! The tractions as a figure fit to print.

mod curves;

use super::canvas::{ALARM, GRID, INK, LINE, SIZE, THIN, framed, line, literal, name_clip, outline, write};
use super::head::{SUBTITLE, alarm, lines, titled};
use super::legend::{LEGEND, under_frame};
use super::{FigureError, with_numbers};
use crate::engine::{Slip, Solution, StickReport};
use crate::report::labels::{Labels, with_unit};
use crate::report::number::{digits, significant, trimmed, typeset};
use crate::report::scene_line::{GREEK, scene_parts};
use curves::{Curves, Frame};
use kuva::backend::svg::SvgBackend;
use kuva::render::annotations::ShadedRegion;
use kuva::render::layout::{ComputedLayout, Layout, TickFormat};
use kuva::render::plots::Plot;
use kuva::render::render::render_multiple;
use std::sync::Arc;

/// Half the range of `x/b`: room beside the contact for the markers of its edges.
const HALF_RANGE: f64 = 1.2;
const STICK: &str = "#dbe4ef";
const SLIP: &str = "#f9f1e4";

/// The tractions over the contact as an SVG figure (UTF-8): pressure and shear in mean pressures over `x/b`, zones
/// of stick and slip shaded and named, the scene in a line under its title. The same solution always gives the
/// same text. A pressure that is unbounded leaves the frame at its top.
pub fn svg(solution: &Solution) -> Result<String, FigureError> {
    with_numbers(solution)?;
    let positive = |value: Option<f64>| value.filter(|v| *v > 0.0).ok_or(FigureError::NoScale);
    let (b, mean) = (positive(solution.load.half_width)?, positive(solution.pressure.mean)?);
    let curves = Curves::new(solution, b, mean)?;
    let frame = curves.frame();

    let mut layout = layout(solution, b, mean, frame);
    // What is everywhere leaves the other nowhere, which is no rectangle.
    for (from, to, color) in zones(solution.stick.as_ref()).into_iter().filter(|(from, to, _)| from < to) {
        layout = layout.with_shaded_region(ShadedRegion::vertical(from, to).with_color(color).with_opacity(1.0));
    }
    // Room between subtitle and frame for the names of the zones and, if need be, for the alarm.
    let (names, alarm) = (names(solution), alarm(solution.status, solution.reason.as_deref()));
    let lines = (alarm.len() + usize::from(!names.is_empty())) as f64;
    let plain = ComputedLayout::from_layout(&layout);
    let layout = layout.with_force_margins_y(plain.margin_top + lines * LINE, plain.margin_bottom + LEGEND);
    let computed = ComputedLayout::from_layout(&layout);

    let mut plots = rules(solution.stick.as_ref(), frame);
    plots.extend(curves.plots(frame));
    let mut scene = render_multiple(plots, layout);
    for (x, name) in names {
        write(&mut scene, computed.map_x(x), computed.margin_top - 0.4 * LINE, name, INK, false);
    }
    for (line, text) in alarm.into_iter().enumerate() {
        write(&mut scene, SIZE.0 / 2.0, computed.margin_top - (lines - line as f64 - 0.6) * LINE, text, ALARM, true);
    }
    for (style, x, y) in curves.samples(frame) {
        scene.add(style.mark(computed.map_x(x), computed.map_y(y)));
    }
    outline(&mut scene, &computed);
    under_frame(&curves.legend(), &mut scene, &computed);
    name_clip(&mut scene, "frame");
    Ok(SvgBackend::new().with_pretty(true).render_scene(&scene))
}

/// Titles, axes and legend.
fn layout(solution: &Solution, b: f64, mean: f64, frame: Frame) -> Layout {
    let labels = Labels::new(&solution.units);
    let called =
        if solution.stick.is_some() { "Pressure and shear under the punch" } else { "Pressure under the punch" };
    let title = titled(solution.scene.title.as_deref(), called);
    let own = |path: &str, value: f64, unit: &str| {
        let supported = solution.error.each.get(path).map_or(SCALE_DIGITS, |e| digits(*e).min(SCALE_DIGITS));
        with_unit(&typeset(&trimmed(value, supported)), unit)
    };
    let below = format!("x / b (b = {})", own("load.half_width", b, &labels.length));
    let beside = format!("traction / mean pressure (mean {})", own("pressure.mean", mean, &labels.stress));
    framed((-HALF_RANGE, HALF_RANGE), (frame.bottom, frame.top), SIZE, [&below, &beside])
        .with_x_axis_min(-HALF_RANGE)
        .with_x_axis_max(HALF_RANGE)
        .with_y_axis_min(frame.bottom)
        .with_y_axis_max(frame.top)
        .with_x_tick_step(0.5)
        .with_y_tick_step(frame.step)
        .with_tick_format(TickFormat::Custom(Arc::new(|v| format!("{v:.1}").replace('-', "\u{2212}"))))
        .with_title(literal(&title))
        .with_title_size(17)
        .with_title_wrap(52)
        .with_subtitle(literal(&lines(&scene_parts(&solution.scene, solution.load.half_width, &GREEK), SUBTITLE)))
        .with_subtitle_size(12)
        .with_subtitle_wrap(SUBTITLE)
        .with_y_label_wrap(24)
        .with_x_label_offset(0.0, -LEGEND)
}

/// Digits of the scales on the axes' labels, at most.
const SCALE_DIGITS: usize = 5;

/// `a/b` where a stick zone was found.
fn stick_ratio(stick: Option<&StickReport>) -> Option<f64> {
    stick?.ratio.filter(|ratio| *ratio > 0.0 && *ratio <= 1.0)
}

/// Shaded zones: from, to, colour.
fn zones(stick: Option<&StickReport>) -> Vec<(f64, f64, &'static str)> {
    match stick_ratio(stick) {
        Some(a) => vec![(-1.0, -a, SLIP), (-a, a, STICK), (a, 1.0, SLIP)],
        None => Vec::new(),
    }
}

/// Names of the zones over the frame, where no curve can cross them: middle (x/b), text.
fn names(solution: &Solution) -> Vec<(f64, String)> {
    let Some((stick, a)) = solution.stick.as_ref().and_then(|stick| Some((stick, stick_ratio(Some(stick))?))) else {
        return Vec::new();
    };
    // Arrows point where the surface slides.
    if stick.one_minus_ratio == Some(0.0) {
        return vec![(0.0, "stick everywhere".into())];
    }
    let (left, right) = match stick.slip {
        Some(Slip::Inward) => ("slip \u{2192}", "\u{2190} slip"),
        Some(Slip::Outward) => ("\u{2190} slip", "slip \u{2192}"),
        None => ("slip", "slip"),
    };
    let shown = |path: &str, value: f64| {
        let supported = solution.error.each.get(path).map_or(4, |e| digits(*e).min(4));
        typeset(&significant(value, supported))
    };
    let size = match stick.rest_that_tells() {
        Some(rest) => format!("1 \u{2212} a/b = {}", shown("stick.one_minus_ratio", rest)),
        None => format!("a/b = {}", shown("stick.ratio", a)),
    };
    let slip = f64::midpoint(a, 1.0);
    vec![(-slip, left.into()), (0.0, format!("stick, {size}")), (slip, right.into())]
}

/// Grid, edges of the contact and of the stick zone: under the curves, none in the legend.
fn rules(stick: Option<&StickReport>, frame: Frame) -> Vec<Plot> {
    /// More than any frame holds.
    const MOST_LEVELS: u8 = 64;
    let level = |y: f64, color: &str| line([(-HALF_RANGE, y), (HALF_RANGE, y)], color, THIN, None);
    let upright = |x: f64, dashes| line([(x, frame.bottom), (x, frame.top)], INK, 1.0, dashes);

    let mut rules: Vec<Plot> = (1..MOST_LEVELS)
        .map(|i| frame.bottom + f64::from(i) * frame.step)
        .take_while(|y| *y < frame.top - 0.5 * frame.step)
        .map(|y| level(y, GRID))
        .collect();
    rules.push(level(0.0, INK));
    rules.extend([-1.0, 1.0].map(|x| upright(x, None)));
    if let Some(a) = stick_ratio(stick) {
        rules.extend([-a, a].map(|x| upright(x, Some("9 3 2 3"))));
    }
    rules
}

#[cfg(test)]
mod tests {
    use super::curves::{LIMIT, PRESSURE};
    use super::*;
    use crate::engine::Status;
    use crate::report::samples;
    use crate::report::svg::legend::Entry;
    use crate::report::svg::texts;

    /// Ordinates (px) of the pressure from left to right, and those of the frame's top and bottom.
    fn pressure_curve(svg: &str) -> (Vec<f64>, [f64; 2]) {
        curve(svg, &PRESSURE)
    }

    /// The same of the last curve drawn in such a way.
    fn curve(svg: &str, entry: &Entry) -> (Vec<f64>, [f64; 2]) {
        let document = roxmltree::Document::parse(svg).unwrap();
        let path = document
            .descendants()
            .rfind(|n| n.has_tag_name("path") && n.attribute("stroke") == Some(entry.style.color))
            .expect("such a curve");
        let numbers = path.attribute("d").unwrap().split([' ', 'M', 'L']).filter(|s| !s.is_empty());
        let numbers: Vec<f64> = numbers.map(|s| s.parse().unwrap()).collect();
        let frame = document.descendants().find(|n| n.has_tag_name("clipPath")).unwrap().first_element_child().unwrap();
        let side = |name| frame.attribute(name).unwrap().parse::<f64>().unwrap();
        (numbers.chunks(2).map(|xy| xy[1]).collect(), [side("y"), side("y") + side("height")])
    }

    #[test]
    fn the_same_solution_gives_the_same_figure() {
        let solution = samples::flat_with_friction();
        assert_eq!(svg(&solution).unwrap(), svg(&solution).unwrap());
    }

    #[test]
    fn titles_are_escaped() {
        let mut solution = samples::flat_with_friction();
        let title = "a < b & \"c\" > 'd' at $1 or $2";
        solution.scene.title = Some(format!("{title}\u{1}"));
        let figure = svg(&solution).unwrap();
        assert!(texts(&figure).contains(&title.to_owned()), "{:?}", texts(&figure));
        solution.units.length = Some("<m>".into());
        assert!(texts(&svg(&solution).unwrap()).contains(&"x / b (b = 1 <m>)".to_owned()));
    }

    /// A curve through five points looked as smooth as one through two hundred.
    #[test]
    fn few_samples_are_marked_and_many_are_not() {
        let marks =
            |points: u32| svg(&samples::flat(0.5, 0.3, Slip::Inward, points)).unwrap().matches("<circle").count();
        // Pressure and shear between the edges, where both are unbounded, and each in the legend.
        assert_eq!((marks(5), marks(9), marks(201)), (2 * 3 + 2, 2 * 7 + 2, 0));
        let of_list = |x: Vec<f64>| {
            let mut solution = samples::cylinder_without_friction();
            solution.profile.pressure = x.iter().map(|x| Some(0.6 * (1.0 - x * x).sqrt())).collect();
            solution.profile.x = x;
            svg(&solution).unwrap().matches("<circle").count()
        };
        let list = |count: u32| (0..count).map(|i| f64::from(i) / 30.0).collect::<Vec<_>>();
        assert_eq!((of_list(list(24)), of_list(list(25))), (25, 0));
        // The one at the edge is as good as any, and what lies beyond a frame is not drawn.
        assert_eq!(of_list(vec![-1.0, 0.0, 1.0]), 4);
    }

    #[test]
    fn zones_and_curves_are_named() {
        let found = texts(&svg(&samples::flat_with_friction()).unwrap());
        let names =
            ["slip \u{2192}", "stick, a/b = 0.5530", "\u{2190} slip", "pressure p", "shear q", "friction limit ±ηp"];
        for name in names {
            assert!(found.iter().any(|text| text == name), "{name} in {found:?}");
        }
        let found = texts(&svg(&samples::cylinder_without_friction()).unwrap());
        assert!(!found.iter().any(|text| text.contains("slip") || text.contains("shear")), "{found:?}");
    }

    #[test]
    fn where_nothing_slips_no_zone_is_called_slip() {
        let mut solution = samples::flat(1.0, 0.3, Slip::Inward, 201);
        let stick = solution.stick.as_mut().expect("friction");
        (stick.ratio, stick.one_minus_ratio) = (Some(1.0), Some(0.0));
        let svg = svg(&solution).expect("a profile");
        assert!(!svg.contains("width=\"0\""), "a zone without a width");
        let found = texts(&svg);
        assert!(found.contains(&"stick everywhere".to_owned()), "{found:?}");
        assert!(!found.iter().any(|text| text.contains("slip")), "{found:?}");
    }

    #[test]
    fn a_narrow_slip_zone_shows_how_narrow() {
        let found = texts(&svg(&samples::flat(1.0 - 2.1e-5, 0.3, Slip::Inward, 201)).unwrap());
        assert!(found.contains(&"stick, 1 \u{2212} a/b = 2.100×10⁻⁵".to_owned()), "{found:?}");
    }

    #[test]
    fn an_unbounded_pressure_leaves_the_frame_at_its_top() {
        // Also where the samples are far apart.
        for points in [5, 11, 201] {
            let (curve, [top, bottom]) = pressure_curve(&svg(&samples::flat(0.5, 0.3, Slip::Inward, points)).unwrap());
            assert!(curve[0] < top && *curve.last().unwrap() < top, "{points} points: {curve:?}");
            assert!(curve.iter().all(|y| *y < bottom), "{points} points");
        }
        let (curve, [top, bottom]) = pressure_curve(&svg(&samples::cylinder_without_friction()).unwrap());
        assert!(curve.iter().all(|y| *y >= top && *y <= bottom), "a bounded pressure stays inside");
    }

    #[test]
    fn the_lower_limit_of_friction_stays_inside() {
        let mut solution = samples::cylinder_without_friction();
        solution.scene.friction = samples::flat(0.5, 0.8, Slip::Inward, 5).scene.friction;
        let (curve, [top, bottom]) = curve(&svg(&solution).unwrap(), &LIMIT);
        let lowest = curve.iter().copied().fold(top, f64::max);
        assert!(lowest > f64::midpoint(top, bottom) && lowest <= bottom, "{lowest} in a frame from {top} to {bottom}");
    }

    #[test]
    fn under_a_corner_the_pressure_leaves_the_frame_in_a_peak() {
        let wedge = |x: f64| (1.0 / x.abs()).acosh();
        let draw = |tip: Option<f64>| {
            let mut solution = samples::cylinder_without_friction();
            let x: Vec<f64> = (-50..=50).map(|i| f64::from(i) / 50.0).collect();
            let pressure = x.iter().map(|x| if *x == 0.0 { tip } else { Some(wedge(*x)) }).collect();
            let text = "type = \"wedge\"\nslope = 0.1";
            solution.scene.punch = toml::from_str(text).expect("a punch");
            (solution.load.half_width, solution.pressure.mean) = (Some(1.0), Some(1.5));
            solution.profile = crate::engine::Profile { x, pressure, shear: None, strain: None };
            svg(&solution).expect("a profile")
        };
        let (curve, [top, _]) = pressure_curve(&draw(None));
        let steps = curve.windows(2).filter(|y| y[0] > top);
        // One way up and one way down, in steps: no wall.
        let rises = curve.iter().filter(|y| **y < top).count();
        assert!(rises > 10, "{rises} points over the frame");
        let tallest = steps.map(|y| (y[0] - y[1]).abs()).fold(0.0, f64::max);
        assert!(tallest < 60.0, "{tallest} px in one step");
        // A number there would be as good as any other.
        assert_eq!(draw(None), draw(Some(12.5)));
    }

    #[test]
    fn points_in_any_order_draw_the_same_curve() {
        let sorted = samples::flat_with_friction();
        let mut reversed = sorted.clone();
        let profile = &mut reversed.profile;
        profile.x.reverse();
        profile.pressure.reverse();
        profile.shear.as_mut().unwrap().reverse();
        assert_eq!(svg(&sorted).unwrap(), svg(&reversed).unwrap());
    }

    #[test]
    fn odd_profiles_still_fit_a_frame() {
        let mut solution = samples::flat_with_friction();
        for (x, pressure) in [
            (vec![-1.0, 1.0], vec![Some(0.0), Some(0.0)]),
            (vec![-0.9, 0.2], vec![Some(-3.0), Some(1e300)]),
            (vec![0.5, 0.5, 0.5], vec![Some(1.0), None, Some(1.0)]),
            (vec![-1.0, 0.0, 1.0], vec![None, Some(1e-300), None]),
        ] {
            solution.profile = crate::engine::Profile { shear: Some(pressure.clone()), x, pressure, strain: None };
            let figure = svg(&solution).unwrap();
            texts(&figure);
            assert!(!figure.contains("NaN") && !figure.contains("inf"), "{:?}: {figure}", solution.profile);
        }
    }

    #[test]
    fn doubtful_numbers_are_flagged() {
        let mut solution = samples::flat_with_friction();
        for (status, flag) in
            [(Status::NotConverged, "NOT CONVERGED: x & y"), (Status::AssumptionViolated, "ASSUMPTION VIOLATED: x & y")]
        {
            (solution.status, solution.reason) = (status, Some("x & y".into()));
            assert!(texts(&svg(&solution).unwrap()).contains(&flag.to_owned()));
        }
        solution.reason = Some("word ".repeat(50));
        let alarm = alarm(solution.status, solution.reason.as_deref());
        assert_eq!(alarm.len(), 2);
        assert!(alarm.iter().all(|line| line.chars().count() <= 68) && alarm[1].ends_with("word…"), "{alarm:?}");
    }

    #[test]
    fn without_numbers_there_is_no_figure() {
        assert!(
            matches!(svg(&samples::refused()), Err(FigureError::Refused(reason)) if reason.contains("exponential"))
        );
        let mut solution = samples::cylinder_without_friction();
        solution.profile =
            crate::engine::Profile { x: vec![0.0], pressure: vec![Some(1.0)], shear: None, strain: None };
        assert_eq!(svg(&solution), Err(FigureError::NoProfile(1)));
        solution.pressure.mean = None;
        assert_eq!(svg(&solution), Err(FigureError::NoScale));
        solution.profile.x[0] = f64::NAN;
        assert_eq!(svg(&solution), Err(FigureError::NotFinite("`profile.x[0]` is no number".into())));
    }
}
