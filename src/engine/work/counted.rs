//! A kernel whose readings count as work.

use super::budget::Meter;
use slipzone_api::{Component, KernelTable, PartsMut};
use std::sync::Arc;

/// A table that counts how often it is read: one for each distance.
pub(crate) struct Counted {
    pub(crate) table: Box<dyn KernelTable>,
    pub(crate) meter: Arc<Meter>,
}

impl Counted {
    fn count(&self, distances: &[f64]) {
        self.meter.count_readings(distances.len());
    }
}

impl KernelTable for Counted {
    fn parts_into(&self, component: Component, distances: &[f64], out: PartsMut) {
        self.count(distances);
        self.table.parts_into(component, distances, out);
    }

    fn values_into(&self, component: Component, distances: &[f64], out: &mut [f64]) {
        self.count(distances);
        self.table.values_into(component, distances, out);
    }

    fn error(&self) -> Option<f64> {
        self.table.error()
    }

    fn edge_error(&self) -> f64 {
        self.table.edge_error()
    }

    fn length(&self) -> f64 {
        self.table.length()
    }

    fn nearest(&self) -> Option<f64> {
        self.table.nearest()
    }

    fn power(&self) -> Option<f64> {
        self.table.power()
    }

    fn flexibility_evaluations(&self) -> usize {
        self.table.flexibility_evaluations()
    }
}
