//! Where a pressure is largest.

use slipzone_api::Station;
use std::f64::consts::FRAC_PI_2;

/// Points at which a smooth pressure is compared before its peak is refined.
const SAMPLES: usize = 24;

/// The largest pressure under a punch whose contact ends smoothly, from the pressures at points inside it.
///
/// It is looked for along the angle whose sine is `x/b`: shapes of high powers press near the edge, on a stretch that
/// is a few steps wide there.
pub(crate) fn peak(b: f64, mut pressure: impl FnMut(&[Station], &mut [f64])) -> f64 {
    let mut step = FRAC_PI_2 / SAMPLES as f64;
    let station = |angle: f64| {
        let half = (0.5 * (FRAC_PI_2 - angle)).sin();
        Station { x: b * angle.sin(), gap: 2.0 * b * half * half }
    };
    let mut samples = [0.0; SAMPLES];
    let stations: [Station; SAMPLES] = std::array::from_fn(|i| station(i as f64 * step));
    pressure(&stations, &mut samples);
    let mut at = |angle: f64| {
        let mut p = [0.0];
        pressure(&[station(angle)], &mut p);
        p[0]
    };
    let (top, mut highest) =
        samples.iter().copied().enumerate().fold((0, samples[0]), |top, next| if next.1 > top.1 { next } else { top });
    if top == 0 || top == SAMPLES - 1 {
        return highest;
    }
    // Vertices of parabolas through three points that close in.
    let mut angle = top as f64 * step;
    for _ in 0..3 {
        let (left, middle, right) = (at(angle - step), at(angle), at(angle + step));
        let bend = 2.0 * middle - left - right;
        if bend <= 0.0 {
            break;
        }
        let shift = 0.5 * (right - left) / bend;
        angle += step * shift.clamp(-1.0, 1.0);
        step *= 0.1;
        highest = highest.max(at(angle));
    }
    highest
}
