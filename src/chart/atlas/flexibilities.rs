//! Flexibilities of one surface by every method.

use super::{Cell, Ended};
use crate::chart::method::table;
use crate::verify::layers::{distance, respond};
use slipzone_api::{Family, SurfaceFlexibility, plugins};

/// The method that judges the others, and the one that judges it: by the roots of the characteristic equation, and by a
/// differential equation for the compliance, with nothing in common.
const JUDGES: [&str; 2] = ["closed-form", "compliance"];
/// Digits below which a flexibility without a word about it is called wrong: contacts are to have ten.
const PROMISED: f64 = 9.0;

pub(super) fn names() -> Vec<(String, bool)> {
    methods().map(|name| (name.to_owned(), JUDGES.contains(&name))).collect()
}

fn methods() -> impl Iterator<Item = &'static str> {
    plugins().into_iter().filter(|info| info.family == Family::Flexibility).map(|info| info.name)
}

/// A cell for each method.
pub(super) fn cells((wave, layer): &(f64, String)) -> Vec<Cell> {
    let surface = |method: &str| -> Result<SurfaceFlexibility, String> {
        let response = respond(layer, &table(Family::Flexibility, method, None))?;
        response.surface(*wave).map_err(|refusal| refusal.to_string())
    };
    let found: Vec<_> = methods().map(|method| (method, surface(method))).collect();
    let by = |name: &str| found.iter().find(|(method, _)| *method == name).and_then(|(_, found)| found.clone().ok());
    let judges = JUDGES.map(by);
    let cell = |(method, surface): &(&str, Result<SurfaceFlexibility, String>)| {
        let surface = match surface {
            Ok(surface) => *surface,
            Err(refusal) => return Cell::lost(Ended::Refused, refusal),
        };
        let judge = judges[usize::from(*method == JUDGES[0])];
        let off = judge.map(|right| distance(surface, right));
        if off == Some(f64::INFINITY) {
            return Cell::lost(Ended::NotFinite, "a flexibility is not finite");
        }
        let digits = off.map(|off| -off.max(1e-16).log10());
        let wrong = digits.is_some_and(|digits| digits < PROMISED);
        Cell { ended: Ended::Converged, wrong, digits, claimed: None, reason: None }
    };
    found.iter().map(cell).collect()
}
