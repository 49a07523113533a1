//! One wave number by each registered flexibility, on each registered grading.

use crate::{layer, measure, methods, skip};
use criterion::{Criterion, Throughput};
use slipzone::api::{
    Family, Flexibility, Grading, LayerModel, LayerResponse, ModulusLaw, Positive, Setting, SurfaceFlexibility,
};
use std::hint::black_box;
use std::sync::Arc;

/// `flexibility/METHOD/GRADING`: time for all wave numbers that the method serves; the throughput is per
/// wave number.
pub(crate) fn benchmarks(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("flexibility");
    let layers = layers();
    let all = wave_numbers();
    for (method, flexibility) in methods::examples::<Box<dyn Flexibility>>(Family::Flexibility) {
        for (grading, layer) in &layers {
            let name = format!("{method}/{grading}");
            let response = match flexibility.respond(layer) {
                Ok(response) => response,
                Err(refusal) => {
                    skip("flexibility", &name, &refusal);
                    continue;
                }
            };
            let (served, refusal) = served(response.as_ref(), &all);
            if let (true, Some(refusal)) = (served.is_empty(), &refusal) {
                skip("flexibility", &name, refusal);
                continue;
            }
            let work = || {
                let refused = refusal.as_ref().map(|why| format!("; the last of those refused: {why}"));
                format!("{} of {} wave numbers served{}", served.len(), all.len(), refused.unwrap_or_default())
            };
            let mut out = vec![SurfaceFlexibility::default(); served.len()];
            group.throughput(Throughput::Elements(served.len() as u64));
            measure(&mut group, &name, work, || response.surface_into(black_box(&served), &mut out));
        }
    }
    group.finish();
}

/// A layer per registered grading, and one of whose law nothing is known but its values: what a closed
/// form saves.
fn layers() -> Vec<(&'static str, Arc<LayerModel>)> {
    let thickness = Positive::new(5.0).expect("a positive constant");
    let mut layers = Vec::new();
    for (name, grading) in methods::examples::<Box<dyn Grading>>(Family::Grading) {
        match grading.law(&Setting::thick(grading.thickness().unwrap_or(thickness))) {
            Ok(law) => layers.push((name, layer::bonded(law))),
            Err(refusal) => skip("flexibility", name, &refusal),
        }
    }
    layers.push(("values-only", layer::bonded(Box::new(ValuesOnly(layer::graded())))));
    layers
}

/// Wave numbers times thickness, four to an octave: from where a kernel's panels begin to a cut-off that
/// three or four refinements reach.
fn wave_numbers() -> Vec<f64> {
    (-32..=36).map(|quarter| (f64::from(quarter) / 4.0).exp2()).collect()
}

/// Those that a method serves, and its last refusal.
fn served(response: &dyn LayerResponse, wave_numbers: &[f64]) -> (Vec<f64>, Option<slipzone::api::Refusal>) {
    let (mut served, mut refusal) = (Vec::new(), None);
    for &s in wave_numbers {
        match response.surface(s) {
            Ok(_) => served.push(s),
            Err(why) => refusal = Some(why),
        }
    }
    (served, refusal)
}

#[derive(Debug)]
struct ValuesOnly(Arc<LayerModel>);

impl ModulusLaw for ValuesOnly {
    fn modulus(&self, depth: f64) -> f64 {
        self.0.law.modulus(depth)
    }
}
