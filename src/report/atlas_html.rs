//! The atlas as one page that needs no network: hover for the reason of a cell.

use super::chart_html::embedded;
use crate::chart::atlas::Sheet;

const PAGE: &str = include_str!("atlas.html");

/// The atlas as a page of HTML (UTF-8).
#[must_use]
pub fn atlas_html(sheets: &[Sheet]) -> String {
    PAGE.replace("/*DATA*/", &embedded(sheets))
}
