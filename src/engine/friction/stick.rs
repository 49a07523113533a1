//! The shear under a flat punch with Goodman friction: for each stick zone the friction coefficient that
//! belongs to it is explicit (docs/theory.md, "Stick zone").

use super::carrier;
use super::half_plane_shear::HalfPlaneShear;
use super::slip_grid::SlipGrid;
use super::stick_zone::StickZone;
use crate::engine::accuracy::quantity::{ShearTrace, Traces};
use crate::engine::foreign;
use crate::engine::numerics::dense::Dense;
use crate::engine::prepared_layer::PreparedLayer;
use crate::engine::pressure::lookout::Lookout;
use crate::engine::pressure::normal::Normal;
use crate::engine::work::Work;
use slipzone_api::{Component, Edge, Parity, Quadrature, Refusal, Rule, Station, lend};
use std::cell::Cell;

/// Points at which what is known of the shear is told at a time.
const KNOWN: usize = 64;

/// The shear at one resolution, in layer units; solved again for each stick zone, in the same memory.
pub(crate) struct Shear {
    pub(crate) zone: StickZone,
    /// Friction coefficient that belongs to the zone: positive for inward slip, negative for outward.
    pub(crate) friction: f64,
    /// `eta p(a)`.
    pub(crate) at_edge: f64,
    /// Whether it is as it was solved for the zone, and not adapted to another friction coefficient since.
    pub(crate) is_solved: bool,
    /// `C/A0` of the strain `C|x|` in the stick zone; 0 where nothing is left there.
    pub(crate) strain_rate: f64,
    /// By how much its resolution moves it anywhere in the zone, where that was asked for, see [`super::sharpen`].
    pub(crate) along: Option<f64>,
    quadrature: Box<dyn Quadrature>,
    /// Its own, and those ever a step finer.
    grids: Vec<StickGrid>,
    /// The zone that was resolved, unless it is the zone itself: all that are wider are told from it.
    resolved: Option<StickZone>,
    /// What is taken off the shear in the zone solved last.
    known: HalfPlaneShear,
    /// `p(a)` times the friction that belongs to it.
    own: f64,
    /// The grid of that zone.
    used: usize,
    /// The unknowns of that zone.
    unknowns: Vec<f64>,
    /// The coupling's potential under the pressure, sampled.
    coupling: Vec<f64>,
}

thread_local! {
    /// The room of this thread, unless it is in use: each zone of each resolution fills it anew.
    static ROOM: Cell<Option<Box<Room>>> = const { Cell::new(None) };
}

/// What the tangential equation in one stick zone is made of, a row for each collocation point.
#[derive(Default)]
struct Room {
    slip: SlipGrid,
    /// The points, seen from the contact's edge.
    stations: Vec<Station>,
    coupled: Vec<f64>,
    pressure: Vec<f64>,
    by_slip: Vec<[f64; 2]>,
    /// What the kernel makes of both shears of the half-plane, [`HalfPlaneShear`].
    applied: Vec<[f64; 2]>,
}

impl Room {
    /// Lends the room of this thread.
    fn lend<T>(work: impl FnOnce(&mut Self) -> T) -> T {
        lend(&ROOM, |room| work(room.get_or_insert_default()))
    }
}

/// The stick zone at one resolution.
struct StickGrid {
    rule: Box<dyn Rule>,
    system: Dense,
}

impl StickGrid {
    fn new(quadrature: &dyn Quadrature) -> Result<Self, Refusal> {
        let rule = foreign::rule(quadrature, Parity::Odd, Edge::Continued)?;
        Ok(Self { system: Dense::new(rule.unknowns() + 1, 1), rule })
    }
}

impl Shear {
    /// Room for the shear of zones that a rule of `quadrature` resolves.
    pub(crate) fn new(quadrature: Box<dyn Quadrature>) -> Result<Self, Refusal> {
        let coarsest = StickGrid::new(quadrature.as_ref())?;
        Ok(Self {
            zone: StickZone::default(),
            friction: 0.0,
            at_edge: 0.0,
            is_solved: false,
            strain_rate: 0.0,
            along: None,
            quadrature,
            grids: vec![coarsest],
            resolved: None,
            known: HalfPlaneShear::new(StickZone::default()),
            own: 0.0,
            used: 0,
            unknowns: Vec::new(),
            coupling: Vec::new(),
        })
    }

    /// Takes note of a new pressure; no zone is solved for it yet.
    pub(crate) fn under(&mut self, layer: &PreparedLayer, normal: &mut Normal) {
        self.zone = StickZone::default();
        (self.is_solved, self.along) = (false, None);
        normal.sample_potential(layer, Component::Coupling, &mut self.coupling);
    }

    /// Takes note of a pressure so many times as large as the last one.
    pub(crate) fn press(&mut self, factor: f64) {
        self.unknowns.iter_mut().chain(&mut self.coupling).for_each(|number| *number *= factor);
        self.at_edge *= factor;
        self.own *= factor;
    }

    /// Solves the tangential equation for one stick zone with the friction coefficient as one more unknown,
    /// and returns that coefficient.
    ///
    /// Inside the stick zone `q` is odd and meets `eta p(a)` at its ends; outside `q = eta p sign(x)`. What is resolved
    /// is `r = q - p(a) (eta Y + eta_h Z)`, with `Y`, `Z` and the friction `eta_h` of [`HalfPlaneShear`]. The equations
    /// at the collocation points, and the condition that `r` is not singular at the ends, make the square system `[ T |
    /// p(a) T Y + slip ] (r, eta) = -beta p + (1/pi) int p k_uv - p(a) eta_h T Z`.
    pub(crate) fn solve(
        &mut self,
        layer: &PreparedLayer,
        normal: &mut Normal,
        beta: f64,
        zone: StickZone,
    ) -> Result<f64, Refusal> {
        self.solve_on(0, layer, normal, beta, zone)
    }

    /// [`Self::solve`] on grids so many steps finer.
    ///
    /// A slip zone narrower than the grid's last gap is the half-plane's: what the layer makes of the shear does not
    /// change with it any more.
    fn solve_on(
        &mut self,
        steps: usize,
        layer: &PreparedLayer,
        normal: &mut Normal,
        beta: f64,
        zone: StickZone,
    ) -> Result<f64, Refusal> {
        let widest = StickZone::from_log(-self.grids[steps].rule.finest_gap().ln(), zone.contact());
        let is_wider = zone.slip_width < widest.slip_width;
        let told = if is_wider { widest } else { zone };
        if !(is_wider && self.is_solved && self.used == steps && self.resolved == Some(told)) {
            let (p_edge, friction) = Room::lend(|room| {
                let p_edge = self.see(steps, layer, normal, told, room)?;
                Ok((p_edge, self.balance(layer, beta, p_edge, room, |_, _, by_slip| [by_slip, 0.0])?))
            })?;
            (self.zone, self.friction, self.at_edge, self.is_solved) = (told, friction, friction * p_edge, true);
            self.strain_rate = 0.0;
        }
        if is_wider {
            let of_layer = self.friction - self.known.friction(beta);
            self.move_to(normal, beta, zone, of_layer);
            self.resolved = Some(told);
        }
        Ok(self.friction)
    }

    /// Takes the shear of one stick zone on a half-plane, under its own pressure, and returns the friction coefficient
    /// that belongs to it: there is nothing to solve.
    pub(crate) fn know(&mut self, normal: &Normal, beta: f64, zone: StickZone) -> f64 {
        (self.used, self.resolved, self.is_solved) = (0, None, true);
        (self.along, self.strain_rate) = (None, 0.0);
        self.unknowns.clear();
        self.unknowns.resize(self.grids[0].rule.unknowns(), 0.0);
        self.move_to(normal, beta, zone, 0.0);
        self.friction
    }

    /// Takes another zone, for which only the shear of the half-plane differs; the layer adds `of_layer` to the
    /// friction that it takes.
    fn move_to(&mut self, normal: &Normal, beta: f64, zone: StickZone, of_layer: f64) {
        let p_edge = normal.at(Station { x: zone.half_width, gap: zone.slip_width });
        (self.zone, self.known) = (zone, HalfPlaneShear::new(zone));
        self.grids[self.used].rule.stretch(zone.half_width);
        let of_half_plane = self.known.friction(beta);
        self.friction = of_half_plane + of_layer;
        (self.own, self.at_edge) = (p_edge * of_half_plane, p_edge * self.friction);
    }

    /// Solves the tangential equation for one stick zone in which the strain is `C|x|`, with `C/A0` as one more
    /// unknown, and returns it; the friction coefficient is given.
    ///
    /// What `|x|` makes of the shear on a half-plane is known and taken out of it, see [`carrier`].
    pub(crate) fn solve_strained(
        &mut self,
        layer: &PreparedLayer,
        normal: &mut Normal,
        beta: f64,
        friction: f64,
        zone: StickZone,
    ) -> Result<f64, Refusal> {
        let (p_edge, strain_rate) = Room::lend(|room| {
            let p_edge = self.see(0, layer, normal, zone, room)?;
            let strained = carrier::equation(layer, zone.half_width, self.grids[self.used].rule.collocation());
            let beside = |i: usize, scale: f64, by_slip: f64| [scale * strained[i], friction * by_slip];
            Ok((p_edge, self.balance(layer, beta, p_edge, room, beside)?))
        })?;
        self.strain_rate = strain_rate;
        (self.zone, self.friction, self.at_edge, self.is_solved) = (zone, friction, friction * p_edge, true);
        Ok(self.strain_rate)
    }

    /// Fills in the terms of the tangential equation in one stick zone; returns `p(a)`.
    fn see(
        &mut self,
        used: usize,
        layer: &PreparedLayer,
        normal: &mut Normal,
        zone: StickZone,
        room: &mut Room,
    ) -> Result<f64, Refusal> {
        let StickGrid { rule, .. } = &mut self.grids[used];
        // Refused, the zone solved last stays as it is.
        layer.room_for((rule.unknowns() + 1, 1), &**rule, zone.half_width)?;
        (self.used, self.resolved, self.is_solved, self.along) = (used, None, false, None);
        let known = HalfPlaneShear::new(zone);
        self.known = known;
        rule.stretch(zone.half_width);

        let Room { slip, stations, coupled, pressure, by_slip, .. } = room;
        let at = rule.collocation();
        stations.clear();
        stations.extend(at.iter().map(|own| zone.in_contact(*own)));
        for out in [&mut *coupled, &mut *pressure] {
            out.resize(at.len(), 0.0);
        }
        by_slip.resize(at.len(), [0.0; 2]);
        normal.potential_into(layer, Component::Coupling, &self.coupling, stations, coupled);
        normal.values_into(stations, pressure);
        Ok(slip.potential_into(layer, normal, known, (rule.unknowns(), at), by_slip))
    }

    /// Solves the tangential equation with one more unknown beside the shear's, and returns that. From the point's
    /// number, its row's scale and what is known there per unit of friction, `beside` gives what multiplies the unknown
    /// and what is taken off the right side.
    fn balance(
        &mut self,
        layer: &PreparedLayer,
        beta: f64,
        p_edge: f64,
        room: &mut Room,
        beside: impl Fn(usize, f64, f64) -> [f64; 2],
    ) -> Result<f64, Refusal> {
        let StickGrid { rule, system } = &mut self.grids[self.used];
        let Room { coupled, pressure, by_slip, applied, .. } = room;
        let known = self.known;
        let own = p_edge * known.friction(beta);
        self.own = own;
        let n = rule.unknowns();
        system.solve(|rows, right| {
            let of_points = &mut rows[..by_slip.len() * (n + 1)];
            let kernel = layer.kernel(Component::ShearStrain);
            rule.operator_into(kernel, of_points);
            applied.clear();
            applied.resize(by_slip.len(), [0.0; 2]);
            if let Some(kernel) = kernel {
                rule.applied_into(kernel, of_points, &|at, out| known.sticking_into(at, out), applied);
            }
            let scale = rule.row_scale();
            for (i, by_slip) in by_slip.iter().enumerate() {
                let scale = scale.map_or(1.0, |scale| scale[i]);
                let [factor, known] = beside(i, scale, p_edge * applied[i][0] + scale * by_slip[0]);
                let of_half_plane = own * (applied[i][1] + scale * by_slip[1]);
                rows[i * (n + 1) + n] = factor;
                right[i] = scale * (coupled[i] - beta * pressure[i]) - known - of_half_plane;
            }
            if let Some(condition) = rule.edge_condition() {
                let row = &mut rows[n * (n + 1)..];
                row[..n].copy_from_slice(condition);
                row[n] = 0.0;
                right[n] = 0.0;
            }
            1
        })?;
        let (other, unknowns) = system.column(0).split_last().expect("one unknown more than q has");
        self.unknowns.clear();
        self.unknowns.extend_from_slice(unknowns);
        Ok(*other)
    }

    /// Another friction coefficient for the same zone, `q` in proportion: right in the slip zone, and in the
    /// stick zone only where that is too narrow to matter.
    pub(crate) fn rescale(&mut self, friction: f64) {
        let factor = if friction == 0.0 { 0.0 } else { friction / self.friction };
        self.unknowns.iter_mut().for_each(|unknown| *unknown *= factor);
        self.friction = friction;
        self.at_edge *= factor;
        self.own *= factor;
        self.is_solved = false;
    }

    /// The same densities taken to live on another zone: for a shear that vanishes.
    pub(crate) fn relocate(&mut self, zone: StickZone) {
        self.zone = zone;
    }

    /// Shear traction at points of the stick zone; their gaps are to its edge.
    pub(crate) fn in_stick_into(&self, at: &[Station], out: &mut [f64]) {
        self.grids[self.used].rule.values_into(&self.unknowns, at, out);
        let mut known = [[0.0; 2]; KNOWN];
        for (at, out) in at.chunks(KNOWN).zip(out.chunks_mut(KNOWN)) {
            let known = &mut known[..at.len()];
            self.known.sticking_into(at, known);
            for (out, [proportional, beside]) in out.iter_mut().zip(known) {
                *out += self.at_edge * *proportional + self.own * *beside;
            }
        }
        if self.strain_rate != 0.0 {
            for (out, at) in out.iter_mut().zip(at) {
                *out += self.strain_rate * carrier::shear(self.zone.half_width, *at);
            }
        }
    }

    /// About how far it is off between the nodes of the grid used last; 0 where the rule does not tell.
    pub(crate) fn lost_between(&self) -> f64 {
        self.grids[self.used].rule.lost_between(&self.unknowns, self.zone.half_width).unwrap_or(0.0)
    }

    /// The shear at [`Traces::AT`] and at the end of the stick zone, over a mean pressure.
    pub(crate) fn trace(&self, mean: f64) -> ShearTrace {
        let mut at = [self.at_edge; ShearTrace::POINTS];
        self.in_stick_into(&Traces::stations(self.zone.half_width), &mut at[..Traces::AT.len()]);
        let at = at.map(|q| q / mean);
        let mut trace = ShearTrace::new(at, at, self.friction);
        if self.strain_rate != 0.0 {
            let a = self.zone.half_width;
            self.in_stick_into(
                &ShearTrace::NEAR_MIDDLE.map(|t| Station { x: t * a, gap: (1.0 - t) * a }),
                &mut trace.inner,
            );
            trace.inner = trace.inner.map(|q| q / mean);
        }
        trace
    }

    /// Solves a zone on grids that are so many steps finer than its own; `false` where there are none.
    pub(crate) fn refine(
        &mut self,
        layer: &PreparedLayer,
        normal: &mut Normal,
        beta: f64,
        (zone, steps): (StickZone, u32),
    ) -> Result<bool, Refusal> {
        let finer = steps as usize;
        while self.grids.len() <= finer {
            let step = u32::try_from(self.grids.len()).expect("a few steps");
            match StickGrid::new(self.quadrature.refined(step).as_ref()) {
                Ok(grid) => self.grids.push(grid),
                // The finest there is must do; the error estimate tells how well.
                Err(_) => return Ok(false),
            }
        }
        self.solve_on(finer, layer, normal, beta, zone)?;
        Ok(true)
    }

    /// Where the shear is looked at for what happens between the points reported.
    pub(crate) fn look(&self, lookout: &mut Lookout) {
        lookout.at_collocation(self.zone.half_width, self.grids[self.used].rule.collocation());
    }

    /// The unknowns of the shear in the stick zone.
    pub(crate) fn unknowns(&self) -> &[f64] {
        &self.unknowns
    }

    /// Shear traction at points strictly inside the contact, where the pressures are `pressure`.
    pub(crate) fn values(&self, at: &[Station], pressure: &[f64]) -> Vec<f64> {
        // The same point, its gap to the stick zone's edge.
        let in_stick = |station: &Station| {
            let x = station.x.abs();
            let gap = self.zone.inside(Station { x, ..*station });
            (gap > 0.0).then_some(Station { x, gap })
        };
        let sticking: Vec<Station> = at.iter().filter_map(in_stick).collect();
        let mut shear = vec![0.0; sticking.len()];
        self.in_stick_into(&sticking, &mut shear);
        let mut shear = shear.into_iter();
        let one = |(station, pressure): (&Station, &f64)| {
            let found = in_stick(station).and_then(|_| shear.next());
            found.unwrap_or(self.friction * pressure) * if station.x < 0.0 { -1.0 } else { 1.0 }
        };
        at.iter().zip(pressure).map(one).collect()
    }

    /// The coupling's potential under the pressure, as [`Normal::potential_into`] wants it.
    pub(crate) fn coupling(&self) -> &[f64] {
        &self.coupling
    }

    /// Work in its systems so far.
    pub(crate) fn work(&self) -> Work {
        self.grids.iter().map(|grid| grid.system.work).sum()
    }
}
