//! What is charted: ways to solve a scene, and how finely.

use super::Effort;
use crate::scene::example::least;
use serde::Serialize;
use slipzone_api::{Family, Parameter, Values, plugins};

/// A way to solve a scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Method {
    /// Its quadrature; `None` where the program chooses everything.
    pub quadrature: Option<&'static str>,
    /// Its kernel strategy; `None` where the program chooses everything.
    pub kernel: Option<&'static str>,
}

/// How finely a method solves.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Setting {
    /// Lines of `[solver]`.
    pub solver: String,
    /// The quadrature's own knob; `None` where the tolerance decides.
    pub resolution: Option<u64>,
    /// The kernel strategy's own knob; `None` where it decides by itself.
    pub cutoff: Option<f64>,
    /// Tolerance asked for.
    pub tolerance: f64,
    /// Settings of one series differ in one knob alone, the coarsest first.
    pub series: usize,
}

/// Tolerances that are asked for where the tolerance decides.
const TOLERANCES: [f64; 6] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12];
/// Asked for where the knobs decide: nothing is refined, the estimate is what it is.
const PINNED: f64 = 1e-8;

impl Method {
    /// What the program chooses, then every quadrature with every kernel strategy that has a knob.
    pub fn all() -> Vec<Self> {
        let names = |family| plugins().into_iter().filter(move |info| info.family == family).map(|info| info.name);
        let pairs = names(Family::Quadrature).flat_map(|quadrature| {
            names(Family::Kernel)
                .filter(|kernel| knob_samples(Family::Kernel, kernel).is_some())
                .map(move |kernel| Self { quadrature: Some(quadrature), kernel: Some(kernel) })
        });
        [Self { quadrature: None, kernel: None }].into_iter().chain(pairs).collect()
    }

    /// Its name in a legend.
    pub fn name(&self) -> String {
        match (self.quadrature, self.kernel) {
            (Some(quadrature), Some(kernel)) => format!("{quadrature}, {kernel}"),
            _ => "slipzone's choice".into(),
        }
    }

    /// From coarse to fine: by tolerance, then by its own knobs.
    pub fn settings(&self, effort: Effort) -> Vec<Setting> {
        let (quadrature, kernel) = (self.quadrature, self.kernel);
        let quadrature_with = |knob| quadrature.map(|name| table(Family::Quadrature, name, knob));
        let kernel_with = |knob| kernel.map(|name| table(Family::Kernel, name, knob));
        let lines = |tolerance: f64, quadrature: Option<String>, kernel: Option<String>| {
            let line = |key: &str, table: Option<String>| table.map(|t| format!("{key} = {t}\n")).unwrap_or_default();
            let (quadrature, kernel) = (line("quadrature", quadrature), line("kernel", kernel));
            format!("[solver]\ntolerance = {tolerance:e}\n{quadrature}{kernel}")
        };
        let by_tolerance = thinned(&TOLERANCES, effort).into_iter().map(|tolerance| Setting {
            solver: lines(tolerance, quadrature_with(None), kernel_with(None)),
            resolution: None,
            cutoff: None,
            tolerance,
            series: 0,
        });
        let mut all: Vec<Setting> = by_tolerance.collect();
        let Some((key, steps)) = quadrature.and_then(|name| knob(Family::Quadrature, name)) else { return all };
        let cutoffs = kernel.and_then(|name| knob_samples(Family::Kernel, name));
        let own = [None].into_iter().chain(cutoffs.iter().flat_map(|(key, samples)| {
            let samples: &[f64] = if effort == Effort::Quick { &samples[..1] } else { samples };
            samples.iter().map(move |sample| Some((*key, *sample)))
        }));
        for (series, cutoff) in own.enumerate() {
            all.extend(thinned(&steps, effort).into_iter().map(|n| Setting {
                solver: lines(PINNED, quadrature_with(Some((key, n as f64))), kernel_with(cutoff)),
                resolution: Some(n),
                cutoff: cutoff.map(|(_, value)| value),
                tolerance: PINNED,
                series: 1 + series,
            }));
        }
        all
    }
}

fn thinned<T: Copy>(steps: &[T], effort: Effort) -> Vec<T> {
    match effort {
        Effort::Full => steps.to_vec(),
        Effort::Quick => steps.iter().take(3).step_by(2).copied().collect(),
    }
}

/// The table of a method with the middle of the samples of its first key; without, where it has none.
pub(super) fn with_middle(family: Family, name: &str) -> String {
    table(family, name, knob_samples(family, name).map(|(key, samples)| (key, samples[samples.len() / 2])))
}

/// The inline table of a method, with a knob at a value.
pub(super) fn table(family: Family, name: &str, knob: Option<(&str, f64)>) -> String {
    slipzone_api::find(family, name).map_or_else(String::new, |info| least(info, knob))
}

/// A quadrature's knob, its first key that is a whole number: about half a dozen to a dozen steps over its samples.
fn knob(family: Family, name: &str) -> Option<(&'static str, Vec<u64>)> {
    let mut keys = slipzone_api::find(family, name)?.parameters.iter();
    keys.find_map(|key| matches!(key.values, Values::Whole(..) | Values::Even(..)).then(|| steps(key)).flatten())
}

/// The steps of a key from the least of its samples up to the largest, each some `sqrt 2` times the one before:
/// multiples of 4 where all samples are, or of 2 where only even ones will do.
fn steps(key: &Parameter) -> Option<(&'static str, Vec<u64>)> {
    let [least, .., most] = *key.samples else { return None };
    let unit = match key.values {
        _ if key.samples.iter().all(|sample| sample % 4.0 == 0.0) => 4.0,
        Values::Even(..) => 2.0,
        _ => 1.0,
    };
    let growing = std::iter::successors(Some(least.max(unit)), |n| Some(n * std::f64::consts::SQRT_2));
    let all = [least].into_iter().chain(growing.take_while(|n| *n <= 1.01 * most));
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // samples are few
    let mut steps: Vec<u64> = all.map(|value| (unit * (value / unit).round()).min(most) as u64).collect();
    steps.dedup();
    Some((key.name, steps))
}

/// A kernel strategy's knob, its first key that is a number: its samples.
fn knob_samples(family: Family, name: &str) -> Option<(&'static str, &'static [f64])> {
    let first = slipzone_api::find(family, name)?.parameters.iter().find(|parameter| !parameter.samples.is_empty())?;
    Some((first.name, first.samples))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn steps_lead_from_the_least_sample_up_to_the_largest() {
        let steps_of = |values, samples| {
            let key = Parameter { samples, ..Parameter::optional("n", "steps", values) };
            steps(&key).map(|(_, steps)| steps)
        };
        assert_eq!(steps_of(Values::Whole(0, 6), &[0.0, 2.0, 4.0]), Some(vec![0, 1, 2, 3, 4]));
        assert_eq!(steps_of(Values::Even(2, 20), &[2.0, 6.0, 10.0]), Some(vec![2, 4, 6, 8]));
        assert_eq!(steps_of(Values::Whole(8, 90), &[8.0, 32.0]), Some(vec![8, 12, 16, 24, 32]));
        assert_eq!(steps_of(Values::Whole(8, 90), &[8.0]), None, "no range");
    }

    #[test]
    fn every_pair_has_settings_by_tolerance_and_by_its_own_knobs() {
        crate::link_plugins();
        let all = Method::all();
        assert_eq!(all.len(), 1 + 3 * 2, "three quadratures with two kernel strategies, and what the program chooses");
        for method in &all[1..] {
            let settings = method.settings(Effort::Full);
            let resolutions: BTreeSet<_> = settings.iter().filter_map(|setting| setting.resolution).collect();
            let cutoffs = settings.iter().filter_map(|setting| setting.cutoff).count();
            assert!(resolutions.len() >= 5 && cutoffs >= 10, "{}: {resolutions:?}", method.name());
            assert_eq!(settings.iter().filter(|setting| setting.resolution.is_none()).count(), TOLERANCES.len());
            for setting in &settings {
                let scene = super::super::ALL[0].parsed(&setting.solver);
                assert!(scene.is_ok(), "{}: {:?}", setting.solver, scene.err());
            }
        }
        assert!(all[0].settings(Effort::Full).iter().all(|setting| setting.resolution.is_none()));
    }
}
