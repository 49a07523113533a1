//! Work, counted: the same on every machine.

pub(crate) mod budget;
pub(crate) mod counted;

use std::iter::Sum;
use std::ops::{Add, Sub};

/// Work in dense systems.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Work {
    /// Matrices factorised.
    pub(crate) factorisations: usize,
    /// Multiplications in their elimination: `n^3/3` for the matrix, `n^2` for each right-hand side.
    pub(crate) operations: u64,
}

impl Work {
    /// Adds one system of `n` equations.
    pub(crate) fn count(&mut self, n: usize, right: usize) {
        self.factorisations += 1;
        self.operations += elimination(n, right);
    }
}

/// Multiplications in eliminating `n` equations with so many right-hand sides.
pub(super) fn elimination(n: usize, right: usize) -> u64 {
    let (n, right) = (n as u64, right as u64);
    n * n * n / 3 + right * n * n
}

impl Add for Work {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            factorisations: self.factorisations + other.factorisations,
            operations: self.operations + other.operations,
        }
    }
}

impl Sub for Work {
    type Output = Self;

    fn sub(self, before: Self) -> Self {
        Self {
            factorisations: self.factorisations - before.factorisations,
            operations: self.operations - before.operations,
        }
    }
}

impl Sum for Work {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::default(), Add::add)
    }
}
