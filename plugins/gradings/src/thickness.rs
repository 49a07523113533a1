//! What laws need that run from the surface to a base.

use slipzone_api::{Positive, Refusal, Setting};

/// The thickness of the layer.
///
/// # Errors
/// A refusal of `what`, such as "a linear grading", where there is no layer but an infinite solid.
pub(crate) fn of(setting: &Setting, what: &str) -> Result<f64, Refusal> {
    setting.thickness.map(Positive::get).ok_or_else(|| Refusal::NotBuilt {
        what: format!("{what} on a solid without a base"),
        remedy: "choose a `base` and a `thickness`, or a grading that an infinite solid can have: `homogeneous`, or \
                 `exponential` with `gradient`"
            .into(),
    })
}
