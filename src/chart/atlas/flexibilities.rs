//! Flexibilities of one surface by every method.

use super::{Cell, Ended};
use crate::engine::response;
use crate::scene::parse;
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
    let judges = JUDGES.map(|method| surface(layer, method, *wave));
    let cell = |method: &'static str| {
        let found = match surface(layer, method, *wave) {
            Ok(found) => found,
            Err(refusal) => return Cell::lost(Ended::Refused, refusal),
        };
        let judge = if method == JUDGES[0] { &judges[1] } else { &judges[0] };
        let off = judge.as_ref().ok().map(|right| distance(found, *right));
        if off.is_some_and(f64::is_nan) {
            return Cell::lost(Ended::NotFinite, "a flexibility is not finite");
        }
        let digits = off.map(|off| -off.max(1e-16).log10());
        let wrong = digits.is_some_and(|digits| digits < PROMISED);
        Cell { ended: Ended::Converged, wrong, digits, claimed: None, reason: None }
    };
    methods().map(cell).collect()
}

fn surface(layer: &str, method: &str, wave: f64) -> Result<SurfaceFlexibility, String> {
    let scene = format!(
        "format = 1\n[layer]\n{layer}\n[punch]\ntype = \"flat\"\nhalf_width = 1.0\n[load]\nforce = 1.0\n\
         [solver]\nflexibility = {{ type = \"{method}\" }}\n"
    );
    let scene = parse("atlas", &scene).map_err(|error| error.to_string())?;
    let response = response(&scene).map_err(|refusal| refusal.to_string())?;
    response.surface(wave).map_err(|refusal| refusal.to_string())
}

/// `vv` and `uu` relative to themselves, `uv`, which passes through zero, to their mean; NaN where one is.
fn distance(found: SurfaceFlexibility, right: SurfaceFlexibility) -> f64 {
    let SurfaceFlexibility { vv, uu, uv } = right;
    let all = [found.vv / vv - 1.0, found.uu / uu - 1.0, (found.uv - uv) / (vv * uu).sqrt()];
    if all.iter().any(|error| error.is_nan()) {
        f64::NAN
    } else {
        all.iter().fold(0.0, |most, error| most.max(error.abs()))
    }
}
