//! From the text of a study to a [`Study`]; errors say where.

mod check;

use super::axis::{Axis, Cell, Column, Values};
use super::files::{Kept, Reading};
use super::find::Find;
use super::plot::Plot;
use super::{ANSWER, LARGEST_STUDY, Study};
use crate::scene::document::Document;
use crate::scene::{Asked, SceneError, Template, decode, overlap, plain};
use check::{check_find, check_plots, check_texts, check_values};
use serde::Deserialize;
use serde::de::IgnoredAny;
use slipzone_api::Files;
use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};
use toml::de::DeValue;

/// The sections of a study, its scene and its lists of values left to the document.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct StudyTable {
    #[allow(dead_code)] // checked before
    format: u32,
    title: Option<String>,
    #[allow(dead_code)] // read from the document
    scene: IgnoredAny,
    #[serde(default)]
    axes: Vec<AxisTable>,
    #[serde(default)]
    plots: Vec<Plot>,
    find: Option<Find>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct AxisTable {
    field: Option<String>,
    label: Option<String>,
    values: Option<IgnoredAny>,
    names: Option<Vec<String>>,
    linear: Option<Range>,
    log: Option<Range>,
    zip: Option<Vec<ColumnTable>>,
    random: Option<Random>,
}

/// A field among several that change together.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ColumnTable {
    field: String,
    label: Option<String>,
    values: Option<IgnoredAny>,
    names: Option<Vec<String>>,
    linear: Option<Range>,
    log: Option<Range>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
struct Range {
    from: f64,
    to: f64,
    count: Option<u64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Random {
    count: u64,
    seed: u64,
    fields: Vec<ColumnTable>,
}

/// Reads and checks a study.
pub(super) fn study(name: &str, text: &str, files: &dyn Files) -> Result<Study, SceneError> {
    let document = Document::parse_as("study", "at least `format`, `scene` and `[[axes]]`", name, text)?;
    decode::format(&document)?;
    let table: StudyTable = decode::decode(&document)?;
    let (text, folder) = base_file(&document, files)?;
    let files = Reading::new(files, folder);
    let base = match text {
        Some((name, text)) => Template::parse(&name, text, &files)?,
        None => Template::within(&document, "scene", &files)?,
    };
    let mut axes = Vec::new();
    for (index, axis) in table.axes.into_iter().enumerate() {
        axes.push(read_axis(&document, &["axes", &index.to_string()], axis)?);
    }
    check_texts(&document)?;
    distinct(&document, &axes)?;
    let rows = axes.iter().try_fold(1_u64, |rows, axis| rows.checked_mul(axis.count));
    if rows.is_none_or(|rows| rows > LARGEST_STUDY) {
        let counts: Vec<String> = axes.iter().map(|axis| axis.count.to_string()).collect();
        return Err(document
            .error(document.key(&["axes"]), "too many scenes")
            .found(counts.join(" x "))
            .expected(format!("at most {LARGEST_STUDY} scenes in one study"))
            .hint("take fewer steps, or `random` in place of a grid"));
    }
    let (title, plots, find) = (table.title, table.plots, table.find);
    let mut study =
        Study { title, axes, plots, find, scene: base.scene().clone(), base, files: Kept::default(), tractions: false };
    check_values(&document, &study, &files)?;
    check_find(&document, &study, &files)?;
    check_plots(&document, &study)?;
    study.files = files.kept();
    Ok(study)
}

/// Name and text of the scene that the others differ from, where it is a file beside the study, and its folder.
fn base_file(document: &Document, files: &dyn Files) -> Result<(Option<(String, String)>, PathBuf), SceneError> {
    let path = ["scene"];
    match document.value(&path).map(toml::Spanned::get_ref) {
        Some(DeValue::String(name)) => {
            let bytes = files.read(name).map_err(|why| {
                let error = document.error(document.best(&path), "the scene of the study cannot be read");
                error.found(why).expected(
                    "a scene file, named relative to the study's folder (from standard input: to the current one)",
                )
            })?;
            let called = document.beside(name);
            let text = crate::scene::text(&called, bytes)?;
            let folder = Path::new(name.as_ref()).parent().unwrap_or(Path::new("")).to_path_buf();
            Ok((Some((called, text)), folder))
        }
        Some(DeValue::Table(_)) => Ok((None, PathBuf::new())),
        _ => Err(decode::wrong_type(document, &path, "the name of a scene file, or a table [scene]")),
    }
}

fn read_axis(document: &Document, path: &[&str; 2], axis: AxisTable) -> Result<Axis, SceneError> {
    let AxisTable { field, label, values, names, linear, log, zip, random } = axis;
    let of_one_field = [
        ("label", label.is_some()),
        ("values", values.is_some()),
        ("names", names.is_some()),
        ("linear", linear.is_some()),
        ("log", log.is_some()),
    ];
    if let (None, true, Some((key, _))) =
        (&field, zip.is_some() || random.is_some(), of_one_field.into_iter().find(|(_, is_given)| *is_given))
    {
        let at = [path[0], path[1], key];
        return Err(document
            .error(document.key(&at), format!("`{key}` belongs to a `field`, and this axis has none"))
            .found(document.found(&at))
            .expected(format!("`{key}` with each of the fields of `zip` or `random`")));
    }
    match (field, zip, random) {
        (Some(field), None, None) => {
            let column = ColumnTable { field, label, values, names, linear, log };
            let (column, count) = stepped(document, path, column)?;
            Ok(Axis { columns: vec![column], count })
        }
        (None, Some(zip), None) => zipped(document, &[path[0], path[1], "zip"], zip),
        (None, None, Some(random)) => at_random(document, &[path[0], path[1], "random"], random),
        _ => Err(document
            .error(document.key(path), "an axis needs exactly one of `field`, `zip` and `random`")
            .found(document.found(path))
            .expected("`field` with its values, `zip = [{ field = ..., values = ... }, ...]` or `random = { ... }`")),
    }
}

/// Fields that change together.
fn zipped(document: &Document, path: &[&str; 3], zip: Vec<ColumnTable>) -> Result<Axis, SceneError> {
    let (mut columns, mut counts) = (Vec::new(), Vec::new());
    for (index, column) in zip.into_iter().enumerate() {
        let (column, count) = stepped(document, &[path[0], path[1], path[2], &index.to_string()], column)?;
        columns.push(column);
        counts.push(count);
    }
    if columns.is_empty() {
        return Err(empty(document, path, "`zip` lists no field"));
    }
    Ok(Axis { count: as_many_each(document, path, &columns, &counts)?, columns })
}

/// Fields that are drawn together.
fn at_random(document: &Document, path: &[&str; 3], random: Random) -> Result<Axis, SceneError> {
    if random.count == 0 {
        return Err(document.not_allowed(&[path[0], path[1], path[2], "count"], "at least 1"));
    }
    let mut columns = Vec::new();
    for (index, column) in random.fields.into_iter().enumerate() {
        let place = [path[0], path[1], path[2], "fields", &index.to_string()];
        columns.push(drawn(document, &place, column, random.seed.wrapping_add(index as u64 * 0x1_0000_0001))?);
    }
    if columns.is_empty() {
        return Err(empty(document, path, "`random` lists no field"));
    }
    Ok(Axis { columns, count: random.count })
}

/// How many values each of the fields zipped together has; the odd one is to blame where they differ.
fn as_many_each(document: &Document, path: &[&str; 3], columns: &[Column], counts: &[u64]) -> Result<u64, SceneError> {
    let others = |count: u64| counts.iter().filter(|other| **other == count).count();
    // Of two that differ the second.
    let usual = counts.iter().copied().rev().max_by_key(|count| others(*count)).unwrap_or_default();
    let Some(odd) = counts.iter().position(|count| *count != usual) else { return Ok(usual) };
    let found: Vec<_> = columns.iter().zip(counts).map(|(c, count)| format!("{count} of `{}`", c.field)).collect();
    let place = [path[0], path[1], path[2], &odd.to_string()];
    let error = document.error(document.key(&place), "fields zipped together have as many values each");
    Err(error.found(found.join(", ")).expected(format!("as many of `{}` as of the others", columns[odd].field)))
}

/// A field that takes one value after another, and how many.
fn stepped(document: &Document, path: &[&str], column: ColumnTable) -> Result<(Column, u64), SceneError> {
    let ColumnTable { field, label, values, names, linear, log } = column;
    let within = |key| [path, &[key]].concat();
    let (values, count) = match (values.is_some(), linear, log) {
        (true, None, None) => {
            let listed = listed(document, &within("values"), names.as_deref())?;
            let count = listed.len() as u64;
            (Values::Listed(listed), count)
        }
        (false, Some(range), None) => steps(document, &within("linear"), range, false)?,
        (false, None, Some(range)) => steps(document, &within("log"), range, true)?,
        _ => {
            return Err(document
                .error(document.key(path), format!("the values of `{field}` are to be given in exactly one way"))
                .found(document.found(path))
                .expected("one of `values = [...]`, `linear = { from, to, count }`, `log = { from, to, count }`"));
        }
    };
    if names.is_some() && !matches!(values, Values::Listed(_)) {
        let error = document.error(document.key(&within("names")), "`names` go with `values` only");
        return Err(error
            .found("`names` beside a range")
            .expected("no `names`, or `values = [...]` in place of the range"));
    }
    Ok((column_of(document, path, &field, label, values)?, count))
}

/// A field that is drawn at random.
fn drawn(document: &Document, path: &[&str], column: ColumnTable, seed: u64) -> Result<Column, SceneError> {
    let ColumnTable { field, label, values, names, linear, log } = column;
    let within = |key| [path, &[key]].concat();
    let (range, key) = match (values.is_some() || names.is_some(), linear, log) {
        (false, Some(range), None) => (range, "linear"),
        (false, None, Some(range)) => (range, "log"),
        _ => {
            return Err(document
                .error(document.key(path), format!("`{field}` is to be drawn in exactly one way"))
                .found(document.found(path))
                .expected("`linear = { from, to }`, or `log = { from, to }` to draw its logarithm"));
        }
    };
    if range.count.is_some() {
        let place = [path, &[key, "count"]].concat();
        let error = document.error(document.key(&place), "the draws are counted once, by `random.count`");
        return Err(error.found(document.found(&place)).expected("`from` and `to` alone"));
    }
    let by_factors = key == "log";
    ends(document, &within(key), range, by_factors)?;
    let values = Values::Drawn { from: range.from, to: range.to, by_factors, seed };
    column_of(document, path, &field, label, values)
}

fn column_of(
    document: &Document,
    path: &[&str],
    field: &str,
    label: Option<String>,
    values: Values,
) -> Result<Column, SceneError> {
    let keys: Vec<String> = field.split('.').map(|key| key.trim().to_owned()).collect();
    if keys.iter().any(String::is_empty) || keys[0] == "format" {
        let place = [path, &["field"]].concat();
        return Err(document.not_allowed(&place, "the path of a field of the scene, such as `layer.grading.base`"));
    }
    let field = keys.join(".");
    Ok(Column { label: label.unwrap_or_else(|| field.clone()), path: keys, field, values })
}

/// Values one by one, as TOML and as they are shown.
fn listed(document: &Document, path: &[&str], names: Option<&[String]>) -> Result<Vec<(String, Cell)>, SceneError> {
    let Some(DeValue::Array(values)) = document.value(path).map(toml::Spanned::get_ref) else {
        return Err(decode::wrong_type(document, path, "an array of values"));
    };
    if values.is_empty() {
        return Err(empty(document, path, "an axis without values"));
    }
    let wrong_names = |message: &str| {
        let place = [&path[..path.len() - 1], &["names"]].concat();
        document.error(document.key(&place), message)
    };
    if let Some(names) = names.filter(|names| names.len() != values.len()) {
        let error = wrong_names("as many names as values are needed");
        return Err(error.found(format!("{} names", names.len())).expected(format!("{} of them", values.len())));
    }
    let names = names.unwrap_or_default();
    let mut seen = HashSet::new();
    if let Some(again) = names.iter().find(|name| !seen.insert(*name)) {
        let error = wrong_names("two values have one name");
        return Err(error.found(format!("`{again}` twice")).expected("a name of its own for each value"));
    }
    let values = values.iter().map(|value| plain(document, value)).collect::<Result<Vec<_>, _>>()?;
    let mut of_type: HashMap<&str, usize> = HashMap::new();
    values.iter().filter_map(type_of).for_each(|one| *of_type.entry(one).or_default() += 1);
    let shown = |index: usize, value: &toml::Value| match (names.get(index), value, type_of(value)) {
        (Some(name), ..) => Cell::Text(name.clone()),
        (None, toml::Value::Integer(integer), _) => Cell::Number(*integer as f64),
        (None, toml::Value::Float(float), _) if float.is_finite() => Cell::Number(*float),
        (None, toml::Value::String(text), _) => Cell::Text(text.clone()),
        // Tables of one type are told apart by all that they hold.
        (None, _, Some(one)) if of_type[one] == 1 => Cell::Text(one.into()),
        (None, other, _) => Cell::Text(other.to_string()),
    };
    Ok(values.iter().enumerate().map(|(index, value)| (value.to_string(), shown(index, value))).collect())
}

/// The `type` of a table.
fn type_of(value: &toml::Value) -> Option<&str> {
    value.get("type").and_then(toml::Value::as_str)
}

/// Steps from one number to another.
fn steps(document: &Document, path: &[&str], range: Range, by_factors: bool) -> Result<(Values, u64), SceneError> {
    ends(document, path, range, by_factors)?;
    let within = |key| [path, &[key]].concat();
    let Some(count) = range.count else {
        let error = document.error(document.key(path), "missing key `count`: how many steps?");
        return Err(error.found("only `from`, `to`").expected("`count`, at least 2"));
    };
    if count < 2 {
        return Err(document.not_allowed(&within("count"), "at least 2, both ends included"));
    }
    let is_whole = |key| document.value(&within(key)).is_some_and(|value| value.get_ref().is_integer());
    let step = (range.to - range.from) / (count - 1) as f64;
    let whole = !by_factors && is_whole("from") && is_whole("to") && step != 0.0 && step.fract() == 0.0;
    Ok((Values::Steps { from: range.from, to: range.to, count, by_factors, whole }, count))
}

fn ends(document: &Document, path: &[&str], range: Range, by_factors: bool) -> Result<(), SceneError> {
    let wrong = |end: f64| !end.is_finite() || by_factors && end <= 0.0;
    let expected = if by_factors { "a finite number above 0" } else { "a finite number" };
    for (key, end) in [("from", range.from), ("to", range.to)] {
        if wrong(end) {
            return Err(document.not_allowed(&[path, &[key]].concat(), expected));
        }
    }
    if range.from.to_bits() == range.to.to_bits() {
        return Err(document.not_allowed(&[path, &["to"]].concat(), "another number than `from`"));
    }
    Ok(())
}

fn empty(document: &Document, path: &[&str], what: &str) -> SceneError {
    document.error(document.key(path), what).found(document.found(path)).expected("at least one")
}

/// Columns of the table beside the axes, the numbers and [`ANSWER`].
const RESERVED: [&str; 5] = ["index", "status", "stick.slip", "error", "reason"];

/// No field is set twice, no two columns have one name.
fn distinct(document: &Document, axes: &[Axis]) -> Result<(), SceneError> {
    let mut seen: Vec<&Column> = Vec::new();
    for (index, axis) in axes.iter().enumerate() {
        for column in &axis.columns {
            let place = ["axes", &index.to_string()];
            if let Some(other) = seen.iter().find(|other| overlap(&other.path, &column.path)) {
                let error = document.error(document.key(&place), "two axes set the same field");
                return Err(error
                    .found(format!("`{}` and `{}`", other.field, column.field))
                    .expected("each field once; fields that change together are a `zip`"));
            }
            // The fields themselves may be called as they are: their columns stand for the numbers of that name.
            let is_reserved =
                |label: &str| RESERVED.contains(&label) || ANSWER.contains(&label) || Asked::named(label).is_some();
            let is_taken = column.label != column.field && is_reserved(&column.label);
            if seen.iter().any(|other| other.label == column.label) || is_taken {
                let error = document.error(document.key(&place), format!("two columns named `{}`", column.label));
                let found = if is_taken { "a `label` that results have for something else" } else { "it twice" };
                return Err(error.found(found).expected("a `label` of its own for each field"));
            }
            seen.push(column);
        }
    }
    Ok(())
}
