//! What the arguments name out of a list.

use super::Failure;
use crate::api::nearest;

/// The members of these names, in the order of the list; all when none is named.
pub(super) fn named<'a, T>(
    what: &str,
    names: &[String],
    list: &'a [T],
    name_of: impl Fn(&T) -> &'static str,
) -> Result<Vec<&'a T>, Failure> {
    let known: Vec<_> = list.iter().map(&name_of).collect();
    if let Some(name) = names.iter().find(|name| !known.contains(&name.as_str())) {
        return Err(unknown(what, name, &known));
    }
    Ok(list.iter().filter(|member| names.is_empty() || names.iter().any(|name| name == name_of(member))).collect())
}

/// A name that is none of these.
pub(super) fn unknown(what: &str, name: &str, known: &[&str]) -> Failure {
    let hint = match nearest(name, known) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("known are {}", known.join(", ")),
    };
    Failure::Usage(format!("unknown {what} `{name}`"), Some(hint))
}
