//! What is charted: ways to solve a scene, and how finely.

use super::Effort;
use serde::Serialize;
use slipzone_api::{Family, PluginInfo, Values, plugins};

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
    #[must_use]
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
    #[must_use]
    pub fn name(&self) -> String {
        match (self.quadrature, self.kernel) {
            (Some(quadrature), Some(kernel)) => format!("{quadrature}, {kernel}"),
            _ => "slipzone's choice".into(),
        }
    }

    /// From coarse to fine: by tolerance, then by its own knobs.
    #[must_use]
    pub fn settings(&self, effort: Effort) -> Vec<Setting> {
        let (quadrature, kernel) = (self.quadrature, self.kernel);
        let table = |name: Option<&str>, knob: Option<(&str, String)>| {
            let knob = knob.map(|(key, value)| format!(", {key} = {value}")).unwrap_or_default();
            name.map(|name| format!("{{ type = \"{name}\"{knob} }}"))
        };
        let lines = |tolerance: f64, quadrature: Option<String>, kernel: Option<String>| {
            let line = |key: &str, table: Option<String>| table.map(|t| format!("{key} = {t}\n")).unwrap_or_default();
            let (quadrature, kernel) = (line("quadrature", quadrature), line("kernel", kernel));
            format!("[solver]\ntolerance = {tolerance:e}\n{quadrature}{kernel}")
        };
        let by_tolerance = thinned(&TOLERANCES, effort).into_iter().map(|tolerance| Setting {
            solver: lines(tolerance, table(quadrature, None), table(kernel, None)),
            resolution: None,
            cutoff: None,
            tolerance,
            series: 0,
        });
        let mut all: Vec<Setting> = by_tolerance.collect();
        let knobs = quadrature.and_then(|name| knob(Family::Quadrature, name)).zip(kernel);
        let Some(((key, steps), kernel)) = knobs else { return all };
        let cutoffs = knob_samples(Family::Kernel, kernel);
        let own = [None].into_iter().chain(cutoffs.iter().flat_map(|(key, samples)| {
            let samples: &[f64] = if effort == Effort::Quick { &samples[..1] } else { samples };
            samples.iter().map(move |sample| Some((*key, *sample)))
        }));
        for (series, cutoff) in own.enumerate() {
            all.extend(thinned(&steps, effort).into_iter().map(|n| {
                let own = cutoff.map(|(key, value)| (key, format!("{value:?}")));
                Setting {
                    solver: lines(PINNED, table(quadrature, Some((key, n.to_string()))), table(Some(kernel), own)),
                    resolution: Some(n),
                    cutoff: cutoff.map(|(_, value)| value),
                    tolerance: PINNED,
                    series: 1 + series,
                }
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

/// The middle of the samples of a method's first key; `None` where it has none.
pub(super) fn middle(family: Family, name: &str) -> Option<(&'static str, f64)> {
    knob_samples(family, name).map(|(key, samples)| (key, samples[samples.len() / 2]))
}

fn info(family: Family, name: &str) -> Option<&'static PluginInfo> {
    slipzone_api::find(family, name)
}

/// A quadrature's knob, its first key that is a whole number: about half a dozen to a dozen steps over its samples, each
/// some `sqrt 2` times the one before, in multiples of 4.
fn knob(family: Family, name: &str) -> Option<(&'static str, Vec<u64>)> {
    let mut keys = info(family, name)?.parameters.iter();
    let (key, least, most) = keys.find_map(|parameter| match (parameter.values, parameter.samples) {
        (Values::Whole(..) | Values::Even(..), [least, .., most]) => Some((parameter.name, *least, *most)),
        _ => None,
    })?;
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // samples are few
    let whole = |value: f64| (4.0 * (value / 4.0).round()).max(4.0) as u64;
    let mut steps: Vec<u64> = std::iter::successors(Some(least), |n| Some(n * std::f64::consts::SQRT_2))
        .take_while(|n| *n <= 1.01 * most)
        .map(whole)
        .collect();
    steps.dedup();
    Some((key, steps))
}

/// A kernel strategy's knob, its first key that is a number: its samples.
fn knob_samples(family: Family, name: &str) -> Option<(&'static str, &'static [f64])> {
    let first = info(family, name)?.parameters.iter().find(|parameter| !parameter.samples.is_empty())?;
    Some((first.name, first.samples))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

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
