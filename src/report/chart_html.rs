//! Charts as one page: hover for numbers, switch methods on and off.

use super::page::page;
use crate::chart::Chart;

/// Charts as a page of HTML (UTF-8).
#[must_use]
pub fn chart_html(charts: &[Chart]) -> String {
    page(include_str!("chart.html"), charts)
}
