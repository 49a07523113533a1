//! What a study says, tried: its values make scenes, its question can be asked, its figures can be drawn.

use crate::scene::document::{Document, dotted, one_of};
use crate::scene::{Asked, Kind, Replacement, SceneError, overlap, printable};
use crate::study::Study;
use crate::study::axis::{Axis, Column, Values};
use crate::study::find::Wanted;
use slipzone_api::Files;

/// What goes into tables, figures and messages can be printed; that it is spread over lines does no harm.
pub(super) fn check_texts(document: &Document) -> Result<(), SceneError> {
    ["title", "axes", "plots"].into_iter().try_for_each(|section| {
        document.each_within(&[section], |path, value| {
            let Some(text) = value.as_str() else { return Ok(()) };
            let path: Vec<&str> = path.iter().map(String::as_str).collect();
            printable(document, (&path, document.best(&path)), (text, "printable text"), &['\n', '\r', '\t'])
        })
    })
}

/// Each value makes a scene of the base: with the other axes at their first values, as the base has them, or at their
/// last values. What is wrong only together is a line of the results.
pub(super) fn check_values(document: &Document, study: &Study, files: &dyn Files) -> Result<(), SceneError> {
    for (a, axis) in study.axes.iter().enumerate() {
        for (c, column) in axis.columns.iter().enumerate() {
            for (key, end) in column.ends() {
                check_end(document, study, [a, c], key, end, files)?;
            }
            for step in column.checked() {
                let with_others = |of: fn(&Axis) -> u64| {
                    let steps = study.axes.iter().enumerate();
                    study.made(steps.map(|(i, axis)| (axis, if i == a { step } else { of(axis) })), None, files)
                };
                if with_others(|_| 0).is_ok() {
                    continue;
                }
                let Err(error) = study.made(std::iter::once((axis, step)), None, files) else { continue };
                if with_others(|axis| axis.count - 1).is_ok() {
                    continue;
                }
                // Fields zipped change together: the one that the error names.
                let c = blamed(axis, &error).unwrap_or(c);
                let column = &axis.columns[c];
                let (a, c) = (a.to_string(), c.to_string());
                let mut place = vec!["axes", a.as_str()];
                if document.value(&["axes", &a, "zip"]).is_some() {
                    place.extend(["zip", c.as_str()]);
                } else if document.value(&["axes", &a, "random"]).is_some() {
                    place.extend(["random", "fields", c.as_str()]);
                }
                let index = step.to_string();
                match &column.values {
                    _ if is_of_field(&error, &column.path) => place.push("field"),
                    Values::Listed(_) => place.extend(["values", index.as_str()]),
                    _ => {
                        let is_there = |key: &&str| document.value(&[&place[..], &[*key]].concat()).is_some();
                        let key = ["linear", "log"].into_iter().find(is_there);
                        place.extend(key);
                        place.push(if step == 0 { "from" } else { "to" });
                    }
                }
                return Err(placed(document, study, &place, &error, &column.path));
            }
        }
    }
    Ok(())
}

/// An end of what a field is drawn from makes a scene, with all else as the base has it, or at its first or last
/// values.
fn check_end(
    document: &Document,
    study: &Study,
    [a, c]: [usize; 2],
    key: &str,
    end: f64,
    files: &dyn Files,
) -> Result<(), SceneError> {
    let column = &study.axes[a].columns[c];
    let value = || Some(Replacement::number(&column.path, end));
    let Err(error) = study.made(std::iter::empty(), value(), files) else { return Ok(()) };
    let with_others =
        |of: fn(&Axis) -> u64| study.made(study.axes.iter().map(|axis| (axis, of(axis))), value(), files).is_ok();
    if with_others(|_| 0) || with_others(|axis| axis.count - 1) {
        return Ok(());
    }
    let scale = if matches!(column.values, Values::Drawn { by_factors: true, .. }) { "log" } else { "linear" };
    let (a, c) = (a.to_string(), c.to_string());
    let mut place = vec!["axes", a.as_str(), "random", "fields", c.as_str()];
    if error.kind == Kind::NotWhole {
        place.push("field");
        return Err(of_whole_numbers(document, &place, &column.field));
    }
    place.extend(if is_of_field(&error, &column.path) { vec!["field"] } else { vec![scale, key] });
    Err(placed(document, study, &place, &error, &column.path))
}

/// Whether it is the field that is wrong, and not its value: keys may be unknown within that, too.
fn is_of_field(error: &SceneError, path: &[String]) -> bool {
    match &error.kind {
        Kind::NoPlace => true,
        Kind::UnknownKey(table) => is_around(table, path),
        Kind::MissingKey(table) => !table.is_empty() && is_around(table, path),
        _ => false,
    }
}

/// Whether a field is in a table, or in one within.
fn is_around(table: &[String], path: &[String]) -> bool {
    table.len() < path.len() && path.starts_with(table)
}

/// That a field of whole numbers is none to go through a range of all numbers.
fn of_whole_numbers(document: &Document, place: &[&str], field: &str) -> SceneError {
    let error = document.error(document.best(place), format!("`{field}` takes whole numbers only"));
    error
        .found(format!("`{field}`"))
        .expected("a field that takes any number between two")
        .hint(format!("an axis goes through whole numbers: field = \"{field}\", values = [...]"))
}

/// The column of an axis whose field an error names.
fn blamed(axis: &Axis, error: &SceneError) -> Option<usize> {
    let named = |column: &Column| {
        let keys: Vec<&str> = column.path.iter().map(String::as_str).collect();
        let last = keys.last().copied().unwrap_or_default();
        error.message.contains(&format!("`{}`", dotted(&keys))) || error.message.contains(&format!("`{last}`"))
    };
    axis.columns.iter().position(named)
}

/// An error of a scene at the place of the study that is to blame for that field, or with that where it has a place in
/// a data file.
fn placed(document: &Document, study: &Study, place: &[&str], error: &SceneError, path: &[String]) -> SceneError {
    let of = format!("`{}`", path.join("."));
    if error.file != study.base.name() {
        // Of a data file the place in it is told.
        let named = format!("it is read for {of}");
        return error.clone().named_at(error.hint.as_deref(), &named, &document.error(document.best(place), ""));
    }
    // Where it names the field itself, once is enough.
    let message = if error.message.contains(&of) { error.message.clone() } else { format!("{of}: {}", error.message) };
    let mut placed = document.error(document.best(place), message);
    placed.found.clone_from(&error.found);
    placed.expected.clone_from(&error.expected);
    placed.hint = error.hint.clone().or_else(|| otherwise(error, path));
    if let (Kind::SecondLoad, [_, kind, ..]) = (&error.kind, path) {
        let load = match kind.as_str() {
            "path" => "path = { force = [0.5, 1.0] }".into(),
            "until" => "until = { force = 1.0 }".into(),
            kind => format!("{kind} = 1.0"),
        };
        placed =
            placed.hint(format!("in [load] of the scene, write `{load}` in place of what is there: {of} changes that"));
    }
    placed
}

/// What to do about a field that is none, or cannot be changed alone.
fn otherwise(error: &SceneError, path: &[String]) -> Option<String> {
    if let [table @ .., last] = path
        && !table.is_empty()
        && last == "type"
    {
        return Some(format!(
            "other keys go with it: field = \"{}\", values = [{{ type = ... }}, ...]",
            table.join(".")
        ));
    }
    if !is_of_field(error, path) {
        return None;
    }
    if let Kind::MissingKey(section) = &error.kind {
        return Some(format!("the scene has no [{}]: give it one with all its keys", section.join(".")));
    }
    match Asked::named(&path.join(".")) {
        Some(_) => Some("that is of the result: [[plots]] show it, [find] looks for a value of it".into()),
        None if path.len() > 1 => None,
        None => Some("a field is a path from the top of the scene, such as `friction.coefficient`".into()),
    }
}

/// The question can be asked of the first scene.
pub(super) fn check_find(document: &Document, study: &Study, files: &dyn Files) -> Result<(), SceneError> {
    let Some(find) = &study.find else { return Ok(()) };
    let place = ["find", "quantity"];
    let numbers = Asked::NUMBERS;
    if !numbers.contains(&find.quantity.as_str()) {
        let error = document.not_allowed(&place, one_of(&numbers));
        return Err(error.nearest(&find.quantity, &numbers));
    }
    if !study.asks(&find.quantity) {
        let error = document.error(document.best(&place), "the number that decides is not asked for");
        return Err(error.found("`output.quantities` without it").expected("it among them, or no `quantities`"));
    }
    let path = find.path();
    if let Some(column) = study.columns().find(|column| overlap(&column.path, &path)) {
        let error = document.error(document.best(&["find", "field"]), "an axis sets the field that is looked for");
        return Err(error
            .found(format!("`{}`, beside an axis of `{}`", find.field, column.field))
            .expected("a field that no axis changes"));
    }
    for (key, end) in [("from", find.from), ("to", find.to)] {
        if !end.is_finite() {
            return Err(document.not_allowed(&["find", key], "a finite number"));
        }
        let value = Replacement::number(&path, end);
        if let Err(error) = study.made(study.axes.iter().map(|axis| (axis, 0)), Some(value), files) {
            if error.kind == Kind::NotWhole {
                return Err(of_whole_numbers(document, &["find", "field"], &find.field));
            }
            let key = if is_of_field(&error, &path) { "field" } else { key };
            return Err(placed(document, study, &["find", key], &error, &path));
        }
    }
    match find.wanted {
        Wanted::Target(target) if !target.is_finite() => {
            return Err(document.not_allowed(&["find", "target"], "a finite number"));
        }
        Wanted::HalfPlaneWithin(share) if !(share.is_finite() && share > 0.0) => {
            return Err(document.not_allowed(&["find", "half_plane_within"], "a finite number above 0"));
        }
        _ => {}
    }
    if find.from >= find.to {
        return Err(document.not_allowed(&["find", "to"], format!("a number above `from`, which is {}", find.from)));
    }
    Ok(())
}

/// Each figure has a name of its own and shows what the study has.
pub(super) fn check_plots(document: &Document, study: &Study) -> Result<(), SceneError> {
    for (index, plot) in study.plots.iter().enumerate() {
        let number = index.to_string();
        if let Err(mut fault) = study.shown(plot) {
            if fault.found.is_none() && !fault.path.is_empty() {
                let path = fault.path.iter().map(String::as_str);
                fault.found = Some(document.found(&["plots", &number].into_iter().chain(path).collect::<Vec<_>>()));
            }
            return Err(document.fault(&["plots", &number], fault));
        }
        // Some file systems take names in capitals for the same.
        if study.plots[..index].iter().any(|other| other.file.eq_ignore_ascii_case(&plot.file)) {
            let place = document.best(&["plots", &number, "file"]);
            let error = document.error(place, "two figures with one name").found(format!("`{}`", plot.file));
            return Err(error.expected("a `file` of its own for each [[plots]]"));
        }
    }
    Ok(())
}
