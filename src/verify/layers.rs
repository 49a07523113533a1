//! Surface flexibilities of layers written as a scene would write them.

use super::check::{Within, worst};
use super::contact::Contact;
use crate::engine::response;
use slipzone_api::{Family, LayerResponse, SurfaceFlexibility};

/// Wave numbers in units of `1/h`: where the base is all, where it is felt, and where it is forgotten.
pub(super) const WAVES: [f64; 15] = [1e-6, 1e-3, 0.03, 0.1, 0.3, 0.7, 1.0, 1.5, 2.3, 3.5, 5.0, 8.0, 13.0, 30.0, 1e4];

/// Every base under which a layer has a thickness, as lines of `[layer]`.
pub(super) const BASES: [(&str, &str); 3] = [
    ("rigid base", ""),
    ("frictionless base", "base = { type = \"frictionless\" }\n"),
    ("half-plane below", "base = { type = \"half-plane\", shear = 3.0, poisson = 0.2 }\n"),
];

/// What any two ways to one flexibility may differ by: each method promises 1e-11 of any law.
pub(super) const PROMISED: f64 = 1e-11;

/// What a method's flexibility may be off by.
pub(super) fn promised(method: &str) -> Within {
    match method {
        // Results that it expects to be worse are refused; a survey found none beyond twice that.
        "transfer-matrix" => Within::new(2e-10, "twice the error at which the published route refuses"),
        _ => Within::new(PROMISED, "each method promises 1e-11"),
    }
}

/// The response of a layer by a flexibility's table.
pub(crate) fn respond(layer: &str, flexibility: &str) -> Result<Box<dyn LayerResponse>, String> {
    let scene = Contact::flat(layer).by(Family::Flexibility, flexibility).scene()?;
    response(&scene).map_err(|refusal| refusal.to_string())
}

/// The response by the method that serves every layer.
pub(super) fn compliance(layer: &str) -> Result<Box<dyn LayerResponse>, String> {
    respond(layer, "{ type = \"compliance\" }")
}

/// Largest difference: `vv` and `uu` relative to themselves, `uv`, which may pass through zero, to their mean. NaN is
/// infinite.
pub(crate) fn distance(found: SurfaceFlexibility, expected: SurfaceFlexibility) -> f64 {
    let SurfaceFlexibility { vv, uu, uv } = expected;
    worst([found.vv / vv - 1.0, found.uu / uu - 1.0, (found.uv - uv) / (vv * uu).sqrt()])
}

/// The largest difference of two flexibilities over [`WAVES`].
pub(super) fn apart(one: &dyn LayerResponse, other: &dyn LayerResponse) -> Result<f64, String> {
    let at = |s: f64| -> Result<f64, String> {
        let [one, other] = [one.surface(s), other.surface(s)].map(|f| f.map_err(|refusal| refusal.to_string()));
        Ok(distance(one?, other?))
    };
    Ok(worst(WAVES.into_iter().map(at).collect::<Result<Vec<_>, _>>()?))
}
