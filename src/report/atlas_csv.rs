//! The atlas as a table: a line for each cell.

use super::csv::{cell, line};
use crate::chart::atlas::Sheet;

/// All cells as CSV, with a heading.
pub fn atlas_csv(sheets: &[Sheet]) -> String {
    let mut text = "map,method,x_name,x,y_name,y,ended,wrong,digits,claimed,reason\n".to_owned();
    for sheet in sheets {
        for mapped in &sheet.methods {
            let places = sheet.y.values.iter().flat_map(|y| sheet.x.values.iter().map(move |x| (*x, *y)));
            text.extend(places.zip(&mapped.cells).map(|((x, y), found)| {
                line([
                    sheet.name.to_owned(),
                    mapped.method.clone(),
                    sheet.x.name.to_owned(),
                    cell(Some(x)),
                    sheet.y.name.to_owned(),
                    cell(Some(y)),
                    found.ended.name().to_owned(),
                    found.wrong.to_string(),
                    cell(found.digits),
                    cell(found.claimed),
                    found.reason.clone().unwrap_or_default(),
                ])
            }));
        }
    }
    text
}
