//! What the tests of all rules share.

use slipzone_api::{Component, KernelTable, Parts, PartsMut, Rule, Station};
use std::f64::consts::PI;

/// A made-up kernel: its parts by the distance, the same for each component, and its own length.
#[derive(Clone, Copy)]
pub(crate) struct Made<P = fn(f64) -> Parts> {
    pub(crate) parts: P,
    pub(crate) length: f64,
}

impl<P: Fn(f64) -> Parts + Send + Sync> KernelTable for Made<P> {
    fn parts_into(&self, _: Component, distances: &[f64], out: PartsMut) {
        out.fill(distances, &self.parts);
    }

    fn length(&self) -> f64 {
        self.length
    }

    fn flexibility_evaluations(&self) -> usize {
        0
    }
}

/// The sign of the distance.
pub(crate) fn jump(length: f64) -> Made {
    Made { parts: |_| Parts { sign: 1.0, ..Parts::default() }, length }
}

/// The logarithm of the distance.
pub(crate) fn logarithm(length: f64) -> Made {
    Made { parts: |_| Parts { log: 1.0, ..Parts::default() }, length }
}

pub(crate) fn operator(rule: &mut dyn Rule, kernel: Option<(&dyn KernelTable, Component)>) -> Vec<f64> {
    let mut rows = vec![0.0; rule.unknowns() * rule.collocation().len()];
    rule.operator_into(kernel, &mut rows);
    rows
}

/// Factor of each row.
pub(crate) fn row_scale(rule: &dyn Rule) -> Vec<f64> {
    rule.row_scale().map_or_else(|| vec![1.0; rule.collocation().len()], <[f64]>::to_vec)
}

pub(crate) fn apply(rows: &[f64], unknowns: &[f64]) -> Vec<f64> {
    rows.chunks(unknowns.len()).map(|row| row.iter().zip(unknowns).map(|(a, u)| a * u).sum()).collect()
}

#[track_caller]
pub(crate) fn assert_close(got: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((got - expected).abs() <= tolerance, "{what}: {got:e} instead of {expected:e}");
}

/// Odd densities that are finite at the ends `+-c`: with `k(t) = t^3`,
/// `int_-c^c r (x - r)^3 dr = -2 c^3 x^2 - 2 c^5/5`.
#[track_caller]
pub(crate) fn applies_a_kernel_to_what_is_finite_at_the_ends(rule: &mut dyn Rule, tolerance: f64) {
    let cubic = Made { parts: |t| Parts { smooth: t * t * t, ..Parts::default() }, length: 10.0 };
    let (c, kernel) = (rule.half_width(), (&cubic as &dyn KernelTable, Component::ShearStrain));
    let rows = operator(rule, Some(kernel));
    let mut applied = vec![[0.0; 2]; rule.collocation().len()];
    let line = |at: &[Station], out: &mut [[f64; 2]]| {
        out.iter_mut().zip(at).for_each(|(out, at)| *out = [at.x, -2.0 * at.x]);
    };
    rule.applied_into(kernel, &rows, &line, &mut applied);
    for (([one, other], at), scale) in applied.iter().zip(rule.collocation()).zip(row_scale(rule)) {
        let exact = -2.0 * c.powi(3) * (at.x * at.x + 0.2 * c * c) / PI;
        assert_close(one / scale, exact, tolerance, "one density");
        assert_close(other / scale, -2.0 * exact, tolerance, "the other");
    }
}
