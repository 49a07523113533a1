//! What a tribologist reads on the terminal.

use crate::engine::{Curve, Slip, Solution, Status, StickReport};
use crate::report::labels::{Labels, one_line, with_unit};
use crate::report::number::{digits, significant, trimmed};
use crate::report::scene_line::{ASCII, scene_parts};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt::Write;

/// Digits of a number that comes without an estimate.
const DIGITS_WITHOUT_ESTIMATE: usize = 6;

/// Digits of a number that is exact: as many as a decimal fraction keeps through a division or two.
const DIGITS_OF_EXACT: usize = 15;

/// Digits of the ends of a loading curve, at most: they remind, the curve itself is data.
const DIGITS_OF_CURVE: usize = 6;

/// The solution as a page of aligned text: status first, then every number with its unit and its own error
/// estimate, with only as many digits as the estimate supports and one more. Never `NaN`: a number that does
/// not exist is a reason in words. Ends in a line feed.
pub fn text(solution: &Solution) -> String {
    let mut page = String::new();
    if let Some(title) = &solution.scene.title {
        line(&mut page, &one_line(title));
        line(&mut page, "");
    }
    pair(&mut page, "status", status(solution.status));
    if let Some(reason) = &solution.reason {
        pair(&mut page, "reason", &one_line(reason));
    }
    pair(&mut page, "scene", &scene_parts(&solution.scene, solution.load.half_width, &ASCII).join(", "));
    if solution.status != Status::Refused {
        line(&mut page, "");
        table(&mut page, &rows(solution), &solution.error.each);
        if let Some(slip) = solution.stick.as_ref().and_then(slip) {
            pair(&mut page, "slip", slip);
        }
        if let Some(curve) = &solution.path {
            path(&mut page, curve, &Labels::new(&solution.units));
        }
        line(&mut page, "");
        work(&mut page, solution);
    }
    list(&mut page, "assumptions", &solution.assumptions);
    page
}

/// A status in words.
fn status(status: Status) -> &'static str {
    match status {
        Status::Converged => "converged",
        Status::NotConverged => "NOT CONVERGED: the best numbers found miss the tolerance",
        Status::AssumptionViolated => "ASSUMPTION VIOLATED: not all of the numbers hold, see the reason",
        Status::Refused => "REFUSED: no numbers",
    }
}

/// Where it slides; `None` where that was not found or not asked for.
fn slip(stick: &StickReport) -> Option<&'static str> {
    match stick.slip {
        Some(Slip::Inward) => {
            Some("inward: beside the stick zone the surface slides towards the middle (q = +eta p at x > a)")
        }
        Some(Slip::Outward) => {
            Some("outward: beside the stick zone the surface slides away from the middle (q = -eta p at x > a)")
        }
        None => (stick.one_minus_ratio == Some(0.0)).then_some("none: everything sticks"),
    }
}

/// A number to be reported.
struct Row {
    name: &'static str,
    symbol: &'static str,
    value: Option<f64>,
    /// Why there is no value.
    absent: &'static str,
    unit: String,
    /// Key of `error.each`.
    path: &'static str,
}

fn rows(solution: &Solution) -> Vec<Row> {
    let Labels { length, stress, force, intensity, per_length } = Labels::new(&solution.units);
    let none = String::new;
    let row = |path, name, symbol, value, absent, unit| Row { name, symbol, value, absent, unit, path };
    let (load, pressure, edge) = (&solution.load, &solution.pressure, &solution.edge);
    let depth = if solution.scene.layer.has_depths() { "not computed" } else { "undefined on a half-plane" };
    let mut rows = vec![
        row("load.half_width", "contact half-width", "b", load.half_width, "not computed", length.clone()),
        row("load.indentation", "indentation", "delta", load.indentation, depth, length.clone()),
        row("load.force", "force per length", "P", load.force, "not computed", force),
        row("pressure.centre", "pressure, centre", "p(0)", pressure.centre, "unbounded", stress.clone()),
        row("pressure.mean", "pressure, mean", "P/(2b)", pressure.mean, "not computed", stress.clone()),
        row("pressure.peak", "pressure, peak", "max p", pressure.peak, "unbounded", stress),
        row("edge.stress_intensity", "edge stress intensity", "K", edge.stress_intensity, "not computed", intensity),
        row("edge.ratio", "edge ratio", "K sqrt(b)/P", edge.ratio, "not computed", none()),
    ];
    if let Some(stick) = &solution.stick {
        rows.extend([
            row("stick.half_width", "stick half-width", "a", stick.half_width, "not found", length),
            row("stick.ratio", "stick ratio", "a/b", stick.ratio, "not found", none()),
            row("stick.one_minus_ratio", "slip share", "1 - a/b", stick.one_minus_ratio, "not found", none()),
        ]);
        // Only a strain that is taken to be linear has one.
        if stick.strain_rate.is_some() {
            rows.push(row("stick.strain_rate", "strain rate", "C", stick.strain_rate, "", per_length));
        }
    } else {
        let absent = if solution.scene.friction.is_none() { "none: frictionless" } else { "not computed" };
        rows.push(row("stick", "stick zone", "", None, absent, none()));
    }
    let output = &solution.scene.output;
    let asked = |row: &Row| match row.path {
        "stick" => output.asks_of_stick(),
        path => output.asks(path),
    };
    rows.retain(asked);
    rows
}

/// Rows in five columns: name, symbol, value, unit, relative error.
fn table(page: &mut String, rows: &[Row], each: &BTreeMap<&'static str, f64>) {
    let mut cells = vec![["", "", "value", "unit", "relative error"].map(String::from)];
    cells.extend(rows.iter().map(|row| {
        let estimate = each.get(row.path).copied();
        let value = row.value.map_or_else(|| row.absent.into(), |value| number(value, estimate));
        // The unit of a word or of an error that nobody estimated would only puzzle.
        let unit = if row.value.is_some() { row.unit.clone() } else { String::new() };
        let error =
            if row.value.is_some() { estimate.map_or_else(|| "not estimated".into(), error) } else { String::new() };
        [row.name.into(), row.symbol.into(), value, unit, error]
    }));
    let widths: [usize; 5] =
        std::array::from_fn(|column| cells.iter().map(|row| row[column].chars().count()).max().unwrap_or_default());
    for row in &cells {
        let padded = row.iter().zip(widths).map(|(cell, width)| format!("{cell:<width$}"));
        line(page, &padded.collect::<Vec<_>>().join("  "));
    }
}

/// A value with the digits that its relative error estimate supports, and one more.
fn number(value: f64, estimate: Option<f64>) -> String {
    match estimate {
        // Not even its sign is known; a bound is off by all of itself at most.
        Some(estimate) if estimate > 1.0 => "unknown".into(),
        _ if value == 0.0 => "0".into(),
        _ if !value.is_finite() => "not finite".into(),
        Some(0.0) => trimmed(value, DIGITS_OF_EXACT),
        Some(estimate) => significant(value, digits(estimate)),
        None => significant(value, DIGITS_WITHOUT_ESTIMATE),
    }
}

/// A relative error estimate in words or one digit.
fn error(estimate: f64) -> String {
    match estimate {
        0.0 => "exact".into(),
        finite if finite.is_finite() => format!("{finite:.0e}"),
        _ => "not finite".into(),
    }
}

/// How many loads there are on the way to the one reported, and between which numbers the contact grows.
fn path(page: &mut String, curve: &Curve, labels: &Labels) {
    type Column<'c> = (&'c str, Option<&'c [Option<f64>]>, &'c str);
    let columns: [Column; 5] = [
        ("P", Some(&curve.force), &labels.force),
        ("b", Some(&curve.half_width), &labels.length),
        ("delta", curve.indentation.as_deref(), &labels.length),
        ("a", curve.stick_half_width.as_deref(), &labels.length),
        ("a/b", curve.stick_ratio.as_deref(), ""),
    ];
    let supported = curve.error.map_or(DIGITS_OF_CURVE, |error| digits(error).min(DIGITS_OF_CURVE));
    let range = |(symbol, column, unit): Column| {
        let mut known = column?.iter().copied().flatten();
        let first = known.next()?;
        let last = known.next_back().unwrap_or(first);
        let number = |value| trimmed(value, supported);
        Some(with_unit(&format!("{symbol} {} to {}", number(first), number(last)), unit))
    };
    let ranges: Vec<String> = columns.into_iter().filter_map(range).collect();
    let points = curve.points();
    let loads = if points == 1 { "1 load".into() } else { format!("{points} loads, the last of them above") };
    pair(page, "path", &format!("{loads}: {}", ranges.join(", ")));
    if let Some(error) = curve.error {
        pair(page, "", &format!("largest relative error on the way {}", self::error(error)));
    }
    if let Some(note) = &curve.note {
        pair(page, "", &one_line(note));
    }
}

/// Methods, counts of work, how the errors were got.
fn work(page: &mut String, solution: &Solution) {
    let plan = &solution.plan;
    let methods = [plan.grading, plan.flexibility, plan.kernel, plan.quadrature];
    let methods: Vec<_> = methods.into_iter().filter(|name| !name.is_empty()).map(one_line).collect();
    pair(page, "methods", &methods.join(", "));
    pair(
        page,
        "work",
        &format!(
            "{} unknowns, {} flexibility evaluations, {} factorisations",
            plan.unknowns, plan.flexibility_evaluations, plan.factorisations
        ),
    );
    if !solution.error.how.is_empty() {
        pair(page, "errors", &one_line(&solution.error.how));
    }
}

fn list(page: &mut String, name: &str, items: &[Cow<'static, str>]) {
    for (i, item) in items.iter().enumerate() {
        pair(page, if i == 0 { name } else { "" }, &one_line(item));
    }
}

/// A name and what follows it, in two columns.
fn pair(page: &mut String, name: &str, value: &str) {
    line(page, &format!("{name:<13}{value}"));
}

/// A line without trailing blanks.
fn line(page: &mut String, text: &str) {
    writeln!(page, "{}", text.trim_end()).expect("a String takes any text");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::samples;

    #[test]
    fn a_page_of_text() {
        let expected = "\
Flat punch, layer stiffening downwards

status       converged
scene        h/b = 5, exponential, mu1 = 1 MPa, mu1/mu3 = 1/8, nu = 0.3, plane strain, bonded to a rigid base, \
flat punch (half-width = 1 mm), eta = 0.3, P = 1 N/mm

                                    value         unit        relative error
contact half-width     b            1             mm          exact
indentation            delta        not computed
force per length       P            1             N/mm        exact
pressure, centre       p(0)         0.318309886   MPa         2e-9
pressure, mean         P/(2b)       0.5           MPa         exact
pressure, peak         max p        unbounded
edge stress intensity  K            0.3183098862  MPa mm^1/2  3e-10
edge ratio             K sqrt(b)/P  0.3183098862              3e-10
stick half-width       a            0.5530000     mm          4e-7
stick ratio            a/b          0.5530000                 4e-7
slip share             1 - a/b      0.4470000                 1e-6
slip         inward: beside the stick zone the surface slides towards the middle (q = +eta p at x > a)

methods      exponential, transfer-matrix, split, de-sinc
work         40 unknowns, 120 flexibility evaluations, 3 factorisations
errors       difference from the next finer resolution
assumptions  plane strain
             Goodman: q does not change p
";
        assert_eq!(text(&samples::flat_with_friction()), expected);
    }

    #[test]
    fn what_does_not_exist_is_said_in_words() {
        let page = text(&samples::cylinder_without_friction());
        let value = |name: &str| {
            let row = page.lines().find(|row| row.starts_with(name)).unwrap();
            row[name.len()..].split("  ").map(str::trim).filter(|cell| !cell.is_empty()).nth(1).unwrap_or_default()
        };
        assert_eq!(value("indentation"), "undefined on a half-plane");
        assert_eq!(value("edge stress intensity"), "0");
        assert_eq!(value("pressure, centre"), "0.63662", "an error of 1e-4 carries four digits, and one more");
        assert_eq!(value("contact half-width"), "1.00000", "six digits of a number without an estimate");
        assert!(page.contains("none: frictionless"));
        assert!(!page.contains("MPa"), "a scene without labels has no units");
    }

    #[test]
    fn a_linear_strain_has_its_rate() {
        let mut solution = samples::flat_with_friction();
        assert!(!text(&solution).contains("strain rate"), "no other strain has one");
        solution.stick.as_mut().expect("friction").strain_rate = Some(-0.125);
        solution.error.each.insert("stick.strain_rate", 2e-4);
        let page = text(&solution);
        let row = page.lines().find(|row| row.starts_with("strain rate")).expect("a row");
        assert_eq!(row.split_whitespace().collect::<Vec<_>>(), ["strain", "rate", "C", "-0.1250", "1/mm", "2e-4"]);
    }

    /// A datum says from where the indentation is counted: then its absence has another reason than the base.
    #[test]
    fn an_indentation_over_a_datum_is_not_undefined() {
        let mut solution = samples::cylinder_without_friction();
        solution.scene.layer.datum = Some(slipzone_api::Positive::new(10.0).expect("a depth"));
        assert!(!text(&solution).contains("undefined on a half-plane"));
    }

    #[test]
    fn a_refusal_is_a_reason_and_no_numbers() {
        let page = text(&samples::refused());
        assert!(page.contains("status       REFUSED: no numbers\nreason       this grading does not exist yet"));
        assert!(!page.contains("relative error"), "{page}");
    }

    #[test]
    fn a_loading_curve_is_told_by_its_ends() {
        let mut solution = samples::loading_curve();
        let page = text(&solution);
        let told = "path         60 loads, the last of them above: P 0.0166667 to 1 N/mm, b 0.129099 to 1 mm, \
                    delta 0.00166667 to 0.1 mm, a 0.0713920 to 0.553 mm, a/b 0.553 to 0.553\n             \
                    largest relative error on the way 1e-6\n";
        assert!(page.contains(&told.replace("0.0713920", "0.071392")), "{page}");
        solution.path.as_mut().expect("a curve").note = Some("1 of 60 loads not converged\nat all".into());
        assert!(text(&solution).contains("\n             1 of 60 loads not converged at all\n"));
    }

    #[test]
    fn nan_never_reaches_the_reader() {
        let mut solution = samples::flat_with_friction();
        solution.pressure.centre = Some(f64::NAN);
        solution.error.each.insert("edge.ratio", f64::INFINITY);
        let page = text(&solution);
        assert!(!page.contains("NaN") && !page.contains("inf\n"), "{page}");
        assert_eq!(page.matches("not finite").count(), 2, "{page}");
    }

    #[test]
    fn a_number_that_is_all_error_is_none() {
        assert_eq!([0.3, 1.0, 3e192].map(|estimate| number(-2e187, Some(estimate))), ["-2e187", "-2e187", "unknown"]);
        assert_eq!([0.0, 3e3].map(|estimate| number(0.0, Some(estimate))), ["0", "unknown"]);
    }
}
