//! Charts as one page that needs no network: hover for numbers, switch methods on and off.

use crate::chart::Chart;
use serde::Serialize;

/// The page; `DATA` in it is replaced.
const PAGE: &str = include_str!("chart.html");

/// Charts as a page of HTML (UTF-8).
#[must_use]
pub fn chart_html(charts: &[Chart]) -> String {
    PAGE.replace("/*DATA*/", &embedded(charts))
}

/// Data as a script takes it. No text in it can end the script or begin a comment.
pub(super) fn embedded(data: &(impl Serialize + ?Sized)) -> String {
    let json = serde_json::to_string(data).expect("plain data");
    json.replace('<', "\\u003c")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_text_ends_the_script() {
        assert_eq!(embedded(&["</script><!-- & 1"]), "[\"\\u003c/script>\\u003c!-- & 1\"]");
    }
}
