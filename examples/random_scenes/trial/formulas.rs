//! Texts that plugins take: formulas, and files' names. What no description of a key can say.

use super::dice::Dice;
use slipzone::api::{Files, Parameter, Values};
use std::collections::BTreeSet;
use toml::{Table, Value};

/// Formulas that make sense, by the key that holds them, in a depth `y` over a thickness `h` or in an abscissa `x`.
const FORMULAS: [(&str, &[&str]); 4] = [
    (
        "modulus",
        &[
            "m",
            "m*(1 + a*(y/h)^2)",
            "m*exp(a*y/h)",
            "m*(1 + a*abs(y/h - 0.4))",
            "m/(1 + a*y/h)",
            "m*(1 + 0.3*sin(3*y/h))",
            "m*(1 + a*max(0, y/h - 0.5))",
            "m*(1 + a*(y/h)^2.5)",
        ],
    ),
    ("poisson", &["p", "p + (0.25 - p)*y/h", "0.1 + 0.3*y/h", "0.3 - 0.1*exp(-y/h)", "p*(1 - 0.5*(y/h)^2)"]),
    (
        "height",
        &[
            "x^2/(2*R)",
            "m*x^2 + a*x^4",
            "R*(cosh(x/R) - 1)",
            "9*R - sqrt((9*R)^2 - x^2)",
            "m*abs(x)^2.5",
            "m*abs(x)",
            "m*(sqrt(1 + x^2) - 1)",
            "m*max(0, abs(x) - 0.2)^2",
        ],
    ),
    ("slope", &["x/R", "m*x + a*x^3", "tanh(x/R)", "m*x*abs(x)", "m*sinh(x)", "x/sqrt((9*R)^2 - x^2)"]),
];
/// Names of their parameters.
const NAMES: [&str; 4] = ["m", "a", "p", "R"];
/// What expressions are made of.
const FUNCTIONS: [&str; 10] = ["abs", "exp", "ln", "sqrt", "sin", "tanh", "erf", "cosh", "atan", "log10"];

/// A text for a key: most often one that makes sense there.
pub(crate) fn text(dice: &mut Dice, key: &str, example: Option<&Value>, wild: f64) -> String {
    if key == "file" {
        return (*dice.one_of(&["moduli.csv", "profile.csv", "profile.csv", "missing.csv"])).into();
    }
    let Some((_, known)) = FORMULAS.iter().find(|(name, _)| *name == key) else {
        return example.and_then(Value::as_str).unwrap_or("text").into();
    };
    if dice.chance(wild) {
        let variable = if matches!(key, "height" | "slope") { "x" } else { "y" };
        return expression(dice, variable, 3);
    }
    (*dice.one_of(known)).into()
}

fn expression(dice: &mut Dice, variable: &str, depth: u32) -> String {
    if depth == 0 || dice.chance(0.15) {
        return match dice.whole(0, 5) {
            0 | 1 => variable.into(),
            2 => format!("{:?}", dice.log(1e-3, 1e3)),
            3 => (*dice.one_of(&["1", "2", "0", "pi", "1e30", "1e-30"])).into(),
            _ => (*dice.one_of(&NAMES)).into(),
        };
    }
    let mut part = || expression(dice, variable, depth - 1);
    let (one, other) = (part(), part());
    match dice.whole(0, 7) {
        0 => format!("{}({one})", dice.one_of(&FUNCTIONS)),
        1 => format!("({one})^{}", dice.one_of(&["2", "0.5", "-1", "3", "2.5"])),
        2 => format!("{}({one}, {other})", dice.one_of(&["min", "max"])),
        3 => format!("-({one})"),
        4 => format!("({one})/({other})"),
        5 => format!("({one}) - ({other})"),
        6 => format!("({one}) + ({other})"),
        _ => format!("({one})*({other})"),
    }
}

/// The words of a formula that are names.
pub(crate) fn names(text: &str) -> BTreeSet<String> {
    let word = |c: char| c.is_alphanumeric() || c == '_';
    let words = text.split(|c| !word(c)).filter(|word| word.starts_with(|c: char| c.is_alphabetic()));
    words.map(str::to_owned).collect()
}

/// Gives each parameter that the texts of a table name a number, where the table has a key for that.
pub(crate) fn name_parameters(dice: &mut Dice, keys: &[Parameter], table: &mut Table) {
    let Some(key) = keys.iter().find(|key| matches!(key.values, Values::ByName(_))) else { return };
    let texts: Vec<String> = table.values().filter_map(Value::as_str).map(str::to_owned).collect();
    let named = texts.iter().flat_map(|text| names(text));
    let named: BTreeSet<String> = named.filter(|name| NAMES.contains(&name.as_str())).collect();
    let number = |name: &str, dice: &mut Dice| if name == "p" { dice.between(0.0, 0.45) } else { dice.log(0.2, 4.0) };
    let values: Table = named.into_iter().map(|name| (name.clone(), number(&name, dice).into())).collect();
    if values.is_empty() {
        table.remove(key.name);
    } else {
        table.insert(key.name.into(), values.into());
    }
}

/// The files that random scenes name: those of the examples.
pub(crate) struct Examples;

impl Files for Examples {
    fn read(&self, name: &str) -> Result<Vec<u8>, String> {
        match name {
            "moduli.csv" => Ok(include_bytes!("../../moduli.csv").to_vec()),
            "profile.csv" => Ok(include_bytes!("../../profile.csv").to_vec()),
            _ => Err("there is no such file".into()),
        }
    }
}

/// A formula with another text in place of a name.
pub(crate) fn replaced(text: &str, name: &str, by: &str) -> String {
    with_words(text, |word| (word == name).then(|| by.to_owned()))
}

/// A formula with another text in place of some of its names and numbers.
pub(crate) fn with_words(text: &str, instead: impl Fn(&str) -> Option<String>) -> String {
    let mut out = String::new();
    let mut word = String::new();
    for c in text.chars().chain([' ']) {
        if c.is_alphanumeric() || c == '_' || c == '.' {
            word.push(c);
            continue;
        }
        out += instead(&word).as_ref().unwrap_or(&word);
        word.clear();
        out.push(c);
    }
    out.trim_end().to_owned()
}
