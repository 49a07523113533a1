//! Whole solves on layers of every kind, beside the exponential one.

use crate::{scenes, solve};
use criterion::Criterion;

/// `grading/LAYER` and `grading/LAYER/goodman`: a flat punch at the default tolerance, see [`scenes::layers`].
pub(crate) fn benchmarks(criterion: &mut Criterion) {
    solve::whole(criterion, "grading", scenes::layers());
}
