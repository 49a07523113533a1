//! The loading history in small steps.

use super::coulomb::{Shear, State};
use super::pressure::Pressure;
use super::surface::Surface;
use slipzone::api::Component;
use std::f64::consts::PI;

/// A punch.
pub(super) struct Punch {
    /// Half-width of its flat face.
    pub(super) face: f64,
    /// Its pressure on a half-plane of compliance 1 is `tip ln(1/|x|)` in the middle.
    pub(super) tip: f64,
    /// Its pressure on a half-plane of compliance `A0 = 1`, from `x` and the half-width.
    pub(super) half_plane: fn(f64, f64) -> f64,
}

/// The contact after the last step, whose half-width is 1.
pub(super) struct End {
    /// Mean shear over each cell, from the middle out.
    pub(super) q: Vec<f64>,
    /// Mean pressure over each cell.
    pub(super) p: Vec<f64>,
    /// What each cell did in the last step.
    pub(super) state: Vec<State>,
}

impl End {
    /// The force.
    pub(super) fn force(&self) -> f64 {
        2.0 * self.p.iter().sum::<f64>() / self.p.len() as f64
    }

    /// The largest shear, but for the middle: under a wedge it is unbounded there and the first steps show.
    pub(super) fn largest(&self) -> f64 {
        self.q[self.q.len() / 10..].iter().fold(0.0, |top, q| q.abs().max(top))
    }

    /// The shear at `x`, where a cell must end: a cubic through four cells.
    pub(super) fn shear(&self, x: f64) -> f64 {
        between(&self.q, x)
    }

    /// The pressure at `x`, likewise.
    pub(super) fn pressure(&self, x: f64) -> f64 {
        between(&self.p, x)
    }
}

fn between(cells: &[f64], x: f64) -> f64 {
    let ends_at = |i: &usize| (*i as f64 - x * cells.len() as f64).abs() < 1e-9;
    let i = (2..cells.len() - 1).find(ends_at).expect("a cell ends there");
    // Of means over cells, not of values.
    (7.0 * (cells[i] + cells[i - 1]) - cells[i + 1] - cells[i - 2]) / 12.0
}

/// Marches the half-width from the face to 1 in so many equal `steps`, on so many equal `cells` over `[0, 1]`.
///
/// The last cell of a contact may be covered in part: it bears the pressure that there is.
pub(super) fn march(surface: &Surface, punch: &Punch, eta: f64, cells: usize, steps: usize) -> End {
    let width = 1.0 / cells as f64;
    let a0 = surface.elastic.a0();
    let shear = Shear::new(cells, &shear_weights(surface, width, cells));
    let coupling = coupling_weights(surface, width, cells);
    let contact = covered(punch.face, cells);
    assert!((contact as f64 * width - punch.face).abs() < 1e-12, "the face ends where a cell does");
    let (mut before, mut state) = (vec![0.0; cells], vec![State::Stick; contact]);
    let (mut q, mut p) = (vec![], vec![]);
    for step in 1..=steps {
        let b = punch.face + (1.0 - punch.face) * step as f64 / steps as f64;
        let contact = covered(b, cells);
        let half_plane = |x: f64| (punch.half_plane)(x, b) / a0;
        let masses =
            Pressure::new(surface, &half_plane, [punch.face, punch.tip / a0], b).masses(0.5 * width, 2 * contact);
        let pressed = by_pressure(surface, &masses, &coupling, cells);
        p = masses.chunks(2).map(|m| (m[0] + m[1]) / width).collect();
        assert!(p.iter().all(|p| *p > 0.0), "no contact is lost");
        let bound: Vec<f64> = p.iter().map(|p| eta * p).collect();
        let rest: Vec<f64> = pressed.iter().zip(&before).map(|(u, before)| u - before).collect();
        // A guess for the cells that come into contact: they slide as their neighbour does.
        state.resize(contact, state.last().copied().filter(|s| *s != State::Stick).unwrap_or(State::Inward));
        q = shear.step(&bound, &rest, &mut state);
        before = shear.displacement(&q).iter().zip(&pressed).map(|(by_q, by_p)| by_q + by_p).collect();
    }
    End { q, p, state }
}

/// Cells that a contact covers, all or in part; but for what rounding adds to a whole number.
fn covered(half_width: f64, cells: usize) -> usize {
    (0..cells).take_while(|cell| (*cell as f64) < half_width * cells as f64 - 1e-9).count()
}

/// Displacement of a cell's middle by unit shear on a cell so many cells away: the logarithm exactly.
fn shear_weights(surface: &Surface, width: f64, cells: usize) -> Vec<f64> {
    let scale = -surface.elastic.a0() / PI;
    // int_0^t ln|s| ds
    let log = |t: f64| t * t.abs().ln() - t;
    // Over half cells: int of int_0^t k_uu.
    let mut inner = 0.0;
    let halves = surface.moments(Component::ShearStrain, 0.5 * width, 4 * cells + 2);
    let twice: Vec<f64> = halves
        .iter()
        .map(|(zeroth, first)| {
            let value = inner * 0.5 * width + first;
            inner += zeroth;
            value
        })
        .collect();
    let weight = |d: usize| {
        let t = d as f64 * width;
        let smooth = if d == 0 { 2.0 * twice[0] } else { twice[2 * d] + twice[2 * d - 1] };
        scale * (log(t + 0.5 * width) - log(t - 0.5 * width) + smooth)
    };
    (0..=2 * cells).map(weight).collect()
}

/// `int_0^t k_uv` at whole numbers of cells.
fn coupling_weights(surface: &Surface, width: f64, cells: usize) -> Vec<f64> {
    let mut sum = 0.0;
    let moments = surface.moments(Component::Coupling, width, 2 * cells);
    let ends = moments.iter().map(|(zeroth, _)| {
        sum += zeroth;
        sum
    });
    [0.0].into_iter().chain(ends).collect()
}

/// Displacement of all cells by the pressure, whose integrals over half cells are given.
fn by_pressure(surface: &Surface, masses: &[f64], coupling: &[f64], cells: usize) -> Vec<f64> {
    let (a0, beta) = (surface.elastic.a0(), surface.elastic.beta());
    let whole: Vec<f64> = masses.chunks(2).map(|m| m[0] + m[1]).collect();
    let kernel = |i: usize, c: usize| {
        let apart = coupling[i.abs_diff(c)];
        if i < c { coupling[i + c + 1] - apart } else { coupling[i + c + 1] + apart }
    };
    let mut within = 0.0;
    let displacement = |i: usize| {
        let middle = within + masses.get(2 * i).unwrap_or(&0.0);
        within += whole.get(i).unwrap_or(&0.0);
        let layer: f64 = whole.iter().enumerate().map(|(c, m)| m * kernel(i, c)).sum();
        a0 * (layer / PI - beta * middle)
    };
    (0..cells).map(displacement).collect()
}
