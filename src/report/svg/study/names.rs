//! What axes of a figure and members of a family are called.

use crate::report::labels::{Labels, one_line};
use crate::report::number::{trimmed, typeset};
use crate::study::{Cell, Column, FOUND, Place, Source, Study};

/// A number of the result: name and unit.
fn number(path: &str, labels: &Labels) -> (&'static str, String) {
    let Labels { length, stress, force, intensity, per_length } = labels;
    let (name, unit) = match path {
        "stick.ratio" => ("stick zone a/b", ""),
        "stick.one_minus_ratio" => ("slip zone 1 − a/b", ""),
        "stick.half_width" => ("half-width of the stick zone a", length.as_str()),
        "stick.strain_rate" => ("strain in the stick zone over x, C", per_length.as_str()),
        "load.force" => ("force per length P", force.as_str()),
        "load.half_width" => ("contact half-width b", length.as_str()),
        "load.indentation" => ("indentation δ", length.as_str()),
        "pressure.centre" => ("pressure in the middle p(0)", stress.as_str()),
        "pressure.mean" => ("mean pressure P/2b", stress.as_str()),
        "pressure.peak" => ("largest pressure", stress.as_str()),
        "edge.stress_intensity" => ("stress intensity at the edge K", intensity.as_str()),
        "edge.ratio" => ("stress intensity at the edge K√b/P", ""),
        "error.estimate" => ("estimated relative error", ""),
        _ => ("answer", ""),
    };
    (name, unit.to_owned())
}

/// A field of the scene: name and unit, where it has a name of its own.
fn field(path: &str, labels: &Labels) -> Option<(&'static str, String)> {
    let (length, stress, force) = (&labels.length, &labels.stress, &labels.force);
    let (name, unit) = match path {
        "layer.thickness" => ("thickness h", length.as_str()),
        "layer.poisson" => ("Poisson's ratio ν", ""),
        "layer.grading.surface" => ("modulus at the surface", stress.as_str()),
        "layer.grading.base" => ("modulus at the base", stress.as_str()),
        "layer.grading.modulus" => ("modulus", stress.as_str()),
        "punch.half_width" => ("half-width of the punch", length.as_str()),
        "punch.radius" => ("radius R", length.as_str()),
        "friction.coefficient" => ("coefficient of friction η", ""),
        "load.force" => ("force per length P", force.as_str()),
        "load.half_width" => ("contact half-width b", length.as_str()),
        "load.indentation" => ("indentation δ", length.as_str()),
        _ => return None,
    };
    Some((name, unit.to_owned()))
}

/// Name and unit of what a figure shows.
pub(super) fn of(source: Source, study: &Study) -> (String, String) {
    let labels = Labels::new(&study.scene.units);
    match source {
        Source::Number(FOUND) => {
            let asked = study.find.as_ref().map_or("", |find| find.field.as_str());
            field(asked, &labels).map_or_else(|| (one_line(asked), String::new()), |(name, unit)| (name.into(), unit))
        }
        Source::Number(path) => {
            let (name, unit) = number(path, &labels);
            (name.into(), unit)
        }
        Source::Field(place) => {
            let column = column(study, place);
            match field(&column.field, &labels).filter(|_| column.label == column.field) {
                Some((name, unit)) => (name.into(), unit),
                None => (with_symbols(&column.label), String::new()),
            }
        }
    }
}

fn column(study: &Study, place: Place) -> &Column {
    &study.axes[place.axis].columns[place.column]
}

/// A value of an axis: `µ₁/µ₃ = 1/8`, or the name alone where it says more than a number; with digits that tell it
/// apart from its values at other steps.
pub(super) fn value(study: &Study, place: Place, step: u64, others: &[u64]) -> String {
    /// What reminds of a number; what makes two of them that differ.
    const DIGITS: std::ops::Range<usize> = 4..15;
    let column = column(study, place);
    let cell = column.cell(step);
    let is_named = matches!(cell, Cell::Text(_));
    let text = match cell {
        Cell::Number(number) => {
            let others =
                || others.iter().map(|other| column.cell(*other)).filter(|other| *other != Cell::Number(number));
            let is_alike = |other: Cell, digits: usize| matches!(other, Cell::Number(other) if trimmed(other, digits) == trimmed(number, digits));
            let digits = DIGITS.clone().find(|digits| !others().any(|other| is_alike(other, *digits)));
            typeset(&trimmed(number, digits.unwrap_or(DIGITS.end)))
        }
        Cell::Text(text) => with_symbols(&text),
    };
    // A name such as 1/8 is a number, 2 mm says all by itself.
    if is_named && !text.chars().all(|c| c.is_ascii_digit() || "−-+./".contains(c)) {
        return text;
    }
    let labels = Labels::new(&study.scene.units);
    let (name, unit) = match field(&column.field, &labels).filter(|_| column.label == column.field) {
        // Of `thickness h` the symbol is enough.
        Some((name, unit)) => {
            let symbol = name.rsplit_once(' ').map(|(_, last)| last).filter(|last| last.chars().count() == 1);
            (symbol.unwrap_or(name).to_owned(), unit)
        }
        None => (with_symbols(&column.label), String::new()),
    };
    let unit = if unit.is_empty() || is_named { String::new() } else { format!(" {unit}") };
    format!("{name} = {text}{unit}")
}

/// Words for symbols as the symbols: `mu1/mu3` as `µ₁/µ₃`.
pub(super) fn with_symbols(text: &str) -> String {
    const SYMBOLS: [(&str, &str); 7] =
        [("mu", "µ"), ("nu", "ν"), ("eta", "η"), ("gamma", "γ"), ("beta", "β"), ("delta", "δ"), ("kappa", "κ")];
    let text = one_line(text);
    let mut written = String::new();
    let mut rest = text.as_str();
    while !rest.is_empty() {
        let is_letter = |c: char| c.is_alphabetic();
        let length = rest.find(|c| !is_letter(c)).unwrap_or(rest.len());
        let (word, after) = rest.split_at(length);
        if let Some((_, symbol)) = SYMBOLS.iter().find(|(name, _)| *name == word) {
            written.push_str(symbol);
            let digits = after.find(|c: char| !c.is_ascii_digit()).unwrap_or(after.len());
            written.extend(after[..digits].chars().map(subscript));
            rest = &after[digits..];
        } else {
            written.push_str(word);
            let next = after.find(is_letter).unwrap_or(after.len());
            written.push_str(&after[..next]);
            rest = &after[next..];
        }
    }
    written
}

fn subscript(digit: char) -> char {
    let shift = digit.to_digit(10).unwrap_or_default();
    char::from_u32(u32::from('₀') + shift).unwrap_or(digit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_for_symbols_become_symbols() {
        let written =
            ["mu1/mu3", "eta = 0.3, nu = 0.3", "number of betas", "h/b", "gamma b = 0.1", ""].map(with_symbols);
        assert_eq!(written, ["µ₁/µ₃", "η = 0.3, ν = 0.3", "number of betas", "h/b", "γ b = 0.1", ""]);
    }
}
