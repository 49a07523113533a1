//! Sums of waves over the nodes: the transforms of a spectrum at distances over which no panel sees many waves.

use super::column::Column;
use super::spectrum::Spectrum;
use pulp::{Arch, Simd, WithSimd};
use slipzone_api::elementary::{ROUND, sin_pi};
use std::f64::consts::FRAC_1_PI;

/// Nodes side by side.
const LANES: usize = 4;

/// Groups of nodes whose waves are told at once.
const AT_ONCE: usize = 16;

/// The nodes of all panels, and what stands there before the wave.
pub(super) struct Waves {
    nodes: Vec<[f64; LANES]>,
    /// Per kernel: whether it is odd, and the values times their weights.
    kernels: Vec<(bool, Vec<[f64; LANES]>)>,
}

impl Waves {
    pub(super) fn new(columns: &[Column], spectrum: &Spectrum) -> Self {
        let nodes: Vec<f64> = spectrum.panels().iter().flat_map(|panel| &panel.nodes).copied().collect();
        let kernel = |i: usize| {
            let weighted = |panel: &super::legendre::Panel| -> Vec<f64> {
                panel.weighted(i).iter().map(|value| panel.half * value).collect()
            };
            filled(&spectrum.panels().iter().flat_map(weighted).collect::<Vec<_>>())
        };
        let kernels = (0..columns.len()).map(|i| (columns[i].component.is_odd(), kernel(i))).collect();
        Self { nodes: filled(&nodes), kernels }
    }

    /// Adds to `out` the sine transforms of the odd kernels and the cosine transforms of the even ones.
    pub(super) fn add(&self, t: f64, out: &mut [f64]) {
        Arch::new().dispatch(Add { waves: self, t, out });
    }
}

/// Four at a time, zeros at the end.
fn filled(numbers: &[f64]) -> Vec<[f64; LANES]> {
    let four = |four: &[f64]| std::array::from_fn(|i| four.get(i).copied().unwrap_or(0.0));
    numbers.chunks(LANES).map(four).collect()
}

struct Add<'a> {
    waves: &'a Waves,
    t: f64,
    out: &'a mut [f64],
}

impl WithSimd for Add<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) {
        let Self { waves, t, out } = self;
        let turns = t * FRAC_1_PI;
        // Kernels of one kind share the waves: those are told once for a few nodes.
        let mut sums = [[0.0; LANES]; MOST_KERNELS];
        for (block, nodes) in waves.nodes.chunks(AT_ONCE).enumerate() {
            let (mut sines, mut cosines) = ([[0.0; LANES]; AT_ONCE], [[0.0; LANES]; AT_ONCE]);
            for ((sines, cosines), s) in sines.iter_mut().zip(&mut cosines).zip(nodes) {
                (*sines, *cosines) = sines_and_cosines(s.map(|s| s * turns));
            }
            for (sum, (odd, weighted)) in sums.iter_mut().zip(&waves.kernels) {
                let values = if *odd { &sines } else { &cosines };
                for (value, weighted) in values.iter().zip(&weighted[AT_ONCE * block..]) {
                    *sum = std::array::from_fn(|i| sum[i] + value[i] * weighted[i]);
                }
            }
        }
        for (out, sum) in out.iter_mut().zip(sums) {
            *out += (sum[0] + sum[1]) + (sum[2] + sum[3]);
        }
    }
}

/// As many as there are.
const MOST_KERNELS: usize = 4;

/// `sin(pi y)` and `cos(pi y)`.
#[inline(always)]
fn sines_and_cosines(y: [f64; LANES]) -> ([f64; LANES], [f64; LANES]) {
    let (mut sines, mut cosines) = ([0.0; LANES], [0.0; LANES]);
    for i in 0..LANES {
        let shifted = y[i] + ROUND;
        let rest = y[i] - (shifted - ROUND);
        let sign = shifted.to_bits() << 63;
        sines[i] = f64::from_bits(sin_pi(rest).to_bits() ^ sign);
        cosines[i] = f64::from_bits(sin_pi(0.5 - rest.abs()).to_bits() ^ sign);
    }
    (sines, cosines)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn waves_of_any_length() {
        for k in -4000..4000 {
            let y: [f64; LANES] = std::array::from_fn(|i| 0.013 * f64::from(k) + 0.1 * i as f64);
            let (sines, cosines) = sines_and_cosines(y);
            for i in 0..LANES {
                let (sine, cosine) = (PI * y[i]).sin_cos();
                // The argument of the other is rounded: 160.
                let error = (sines[i] - sine).abs().max((cosines[i] - cosine).abs());
                assert!(error < 3e-14, "{}: {error:e}", y[i]);
            }
        }
    }
}
