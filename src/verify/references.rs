//! Tables of numbers that other programs computed: `tests/data`.

use super::Case;
use serde_json::Value;

/// One case of each entry under `cases`; a table that cannot be read is a case that fails.
pub(super) fn cases(name: &'static str, text: &'static str, of: impl Fn(Value, usize) -> Case) -> Vec<Case> {
    let read = || {
        let file: Value = serde_json::from_str(text).map_err(|error| format!("the table is no JSON: {error}"))?;
        file["cases"].as_array().cloned().ok_or_else(|| "the table has no list of cases".to_owned())
    };
    match read() {
        Ok(cases) => cases.into_iter().enumerate().map(|(i, case)| of(case, i)).collect(),
        Err(why) => vec![Case::new(name, move |_| Err(why.clone()))],
    }
}

/// Half a unit of the last digit that a table prints of this number, relative to it.
pub(super) fn half_a_unit(text: &str, reference: f64) -> Result<f64, String> {
    let shortest = format!("{reference}");
    let at = text.find(&shortest).ok_or_else(|| format!("{shortest} is not printed in the table"))?;
    // The last digits may be zeros, which a number forgets.
    let end = text[at..].find(|c: char| !(c.is_ascii_digit() || c == '.')).map_or(text.len(), |end| at + end);
    let decimals = text[at..end].split_once('.').map_or(0, |(_, decimals)| decimals.len());
    Ok(0.5 * 10.0_f64.powi(-i32::try_from(decimals).unwrap_or(i32::MAX)) / reference.abs())
}

/// A number of a case.
pub(super) fn number(case: &Value, key: &str) -> Result<f64, String> {
    case[key].as_f64().ok_or_else(|| format!("the table has no number under {key}"))
}

/// A list of numbers of a case.
pub(super) fn list(case: &Value, key: &str) -> Result<Vec<f64>, String> {
    let list = case[key].as_array().ok_or_else(|| format!("the table has no list under {key}"))?;
    list.iter().map(|x| x.as_f64().ok_or_else(|| format!("{key} lists something that is no number"))).collect()
}
