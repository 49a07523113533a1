//! What is told of the pressures under the flat punches of a family.

use super::Room;
use super::told::Told;
use crate::engine::growing::blend::Blend;
use crate::engine::growing::sheet::{END, Places, Sheet};
use crate::engine::numerics::chebyshev::largest;
use crate::engine::numerics::lanes::add_rows;
use crate::engine::pressure::normal::Normal;
use slipzone_api::double_exponential::Node;
use slipzone_api::{Rule, Station};
use std::sync::Arc;

/// Pressures under unit forces, as one resolution knows them.
pub(super) struct Pressed {
    /// Where they are solved, and how they are told in between.
    pub(super) blend: Blend,
    /// How well.
    pub(super) told: Told,
    /// Pressures, times the half-width.
    pub(super) pressure: Table,
    /// Odd densities `W` with `int W(r)/(x - r) dr/pi + ... = -1`: a punch of slope `g'` carries `int W g' dx/A0`.
    pub(super) tilt: Table,
    /// Depth over `A0`, beyond that on a half-plane.
    pub(super) depth: Vec<f64>,
    /// The pressures times `sqrt(1 - (x/b)^2)` at any place; made when first asked for.
    spread: Option<Sheet>,
    /// `W` at the nodes of a grid over half of the contact; made when first asked for.
    tilt_over: Option<(Arc<Vec<Node>>, Table)>,
}

impl Pressed {
    /// None as yet.
    pub(super) fn new(blend: Blend) -> Self {
        let (pressure, tilt, depth) = (Table::default(), Table::default(), Vec::new());
        let told = Told::first(blend.functions(), f64::INFINITY);
        Self { blend, told, pressure, tilt, depth, spread: None, tilt_over: None }
    }

    /// All members were solved; `coarse` is how well a coarser resolution told them, and by how much it was wrong.
    pub(super) fn blended(&mut self, coarse: Option<(Told, f64)>) {
        let Self { blend, told, pressure, tilt, depth, .. } = self;
        *depth = blend.coefficients(depth, 1);
        let last = [pressure, tilt].map(|table| {
            table.numbers = blend.coefficients(&table.numbers, table.width);
            blend.last(&table.numbers, table.width) / largest(&table.numbers)
        });
        *told = Told::new(blend.functions(), last[0].max(last[1]), coarse);
    }

    /// The pressure of a member, times its half-width, as its unknowns.
    pub(super) fn pressure<'r>(&self, b: f64, room: &'r mut Room) -> &'r [f64] {
        self.row(&self.pressure, b, room)
    }

    /// `W` of a member as its unknowns.
    pub(super) fn tilt<'r>(&self, b: f64, room: &'r mut Room) -> &'r [f64] {
        self.row(&self.tilt, b, room)
    }

    fn row<'r>(&self, table: &Table, b: f64, Room { functions, density, .. }: &'r mut Room) -> &'r [f64] {
        self.blend.functions_at(b, functions);
        table.blend_into(functions, density);
        density
    }

    /// The pressures of all half-widths times `sqrt(1 - (x/b)^2)`, with what tells them between the members; `normal`
    /// is the contact of their unknowns, `wanted` the error of the numbers.
    pub(super) fn spread(&mut self, normal: &mut Normal, wanted: f64) -> (&Blend, &Sheet) {
        let Self { blend, pressure, spread, .. } = self;
        let sheet = spread.get_or_insert_with(|| {
            let places = Places::of(pressure.width as f64, END);
            let stations = &places.stations;
            let mut rows = Vec::with_capacity(blend.functions() * stations.len());
            for row in pressure.numbers.chunks_exact(pressure.width) {
                let first = rows.len();
                rows.resize(first + stations.len(), 0.0);
                normal.values_of(1.0, row, stations, &mut rows[first..]);
                rows[first..].iter_mut().zip(stations).for_each(|(p, at)| *p *= (at.gap * (2.0 - at.gap)).sqrt());
            }
            Sheet::through(&places, &rows, wanted)
        });
        (blend, sheet)
    }

    /// `W` of a member at the nodes of a grid over its right half; `rule` is that of its unknowns.
    pub(super) fn tilt_over(
        &mut self,
        b: f64,
        grid: &Arc<Vec<Node>>,
        rule: &mut dyn Rule,
        functions: &mut Vec<f64>,
        out: &mut Vec<f64>,
    ) {
        let known = self.tilt_over.take().filter(|(known, _)| Arc::ptr_eq(known, grid));
        let (_, table) = self.tilt_over.insert(known.unwrap_or_else(|| {
            let at: Vec<Station> = grid.iter().map(|node| Station { x: node.from_lower, gap: node.to_upper }).collect();
            let mut numbers = vec![0.0; self.blend.functions() * at.len()];
            rule.stretch(1.0);
            let rows = self.tilt.numbers.chunks_exact(self.tilt.width).zip(numbers.chunks_exact_mut(at.len()));
            rows.for_each(|(row, out)| rule.values_into(row, &at, out));
            (Arc::clone(grid), Table { width: at.len(), numbers })
        }));
        self.blend.functions_at(b, functions);
        table.blend_into(functions, out);
    }
}

/// A few numbers at each point of a family, and then as many for each function of the half-width.
#[derive(Default)]
pub(super) struct Table {
    pub(super) width: usize,
    pub(super) numbers: Vec<f64>,
}

impl Table {
    pub(super) fn push(&mut self, row: impl Iterator<Item = f64>) {
        let before = self.numbers.len();
        self.numbers.extend(row);
        self.width = self.numbers.len() - before;
    }

    /// The row between the points.
    pub(super) fn blend_into(&self, functions: &[f64], out: &mut Vec<f64>) {
        out.clear();
        out.resize(self.width, 0.0);
        add_rows(functions, &self.numbers, out);
    }
}
