//! Pages of HTML that open from disk and need no network.

use crate::chart::Chart;
use crate::chart::atlas::Sheet;
use serde::Serialize;

const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

/// Charts as a page of HTML (UTF-8): hover for numbers, switch methods on and off.
pub fn chart_html(charts: &[Chart]) -> String {
    page(include_str!("chart.html"), charts)
}

/// The atlas as a page of HTML (UTF-8): hover for the reason of a cell.
pub fn atlas_html(sheets: &[Sheet]) -> String {
    page(include_str!("atlas.html"), sheets)
}

/// A page with what all pages share in the places of `STYLE` and `SCRIPT`, and its data in that of `DATA`.
fn page(template: &str, data: &(impl Serialize + ?Sized)) -> String {
    template.replace("/*STYLE*/", STYLE).replace("/*SCRIPT*/", SCRIPT).replace("/*DATA*/", &embedded(data))
}

/// Data as a script takes it. No text in it can end the script or begin a comment.
fn embedded(data: &(impl Serialize + ?Sized)) -> String {
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

    #[test]
    fn data_stay_what_they_are() {
        let made = page("<script>/*SCRIPT*/ const data = /*DATA*/;</script>", &["/*STYLE*/"]);
        assert!(made.ends_with("const data = [\"/*STYLE*/\"];</script>"), "{made}");
    }
}
