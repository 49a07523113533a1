//! The atlas as one page: hover for the reason of a cell.

use super::page::page;
use crate::chart::atlas::Sheet;

/// The atlas as a page of HTML (UTF-8).
#[must_use]
pub fn atlas_html(sheets: &[Sheet]) -> String {
    page(include_str!("atlas.html"), sheets)
}
