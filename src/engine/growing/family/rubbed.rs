//! What friction makes of the flat punches of a family: their stick zones, and what their shear lacks to that of full
//! sliding.

use super::told::Told;
use crate::engine::contact::Contact;
use crate::engine::friction::stick_search::{FrictionCurve, Root};
use crate::engine::friction::stick_zone::StickZone;
use crate::engine::growing::blend::Blend;
use crate::engine::growing::sheet::{Places, Sheet};
use crate::engine::numerics::chebyshev::largest;
use crate::engine::numerics::climb;
use crate::engine::numerics::lanes::{LANES, Lanes, add_rows};
use slipzone_api::Station;
use std::ops::Range;
use std::sync::Arc;

/// The stick zones of a family.
pub(super) struct Rubbed {
    /// Where they are known, and how they are told in between.
    pub(super) blend: Arc<Blend>,
    /// How well.
    pub(super) told: Told,
    /// By how much more slowly what the shear lacks falls off than the zone.
    slower: f64,
    /// Stick zones of contacts, the widest contact first: of the members, and of some between them.
    pub(super) zones: Vec<Seen>,
    /// How unsure those between are, relative, times the half-width.
    unsure: f64,
    /// How much of each function of the half-width there is in it, and in the slope of the friction coefficient over
    /// it.
    of_lambda: Vec<f64>,
    of_slope: Vec<f64>,
    /// How much of the slopes is left to the function that varies fastest, relative: one member's that is none of the
    /// others' shows.
    slope_left: f64,
    /// `+1` where the slip is inward, `-1` where it is outward.
    pub(super) branch: f64,
    /// Whether all of every member sticks: what the shear lacks is then told to none at all, for what slides is out of
    /// all proportion.
    pub(super) sticks: bool,
    /// What the shear lacks in the stick zone, times `sqrt(b^2 - x^2)`.
    pub(super) lack: Sheet,
    /// By how much that moves with `lambda`, here or at a coarser resolution.
    pub(super) moves: Option<Arc<Moves>>,
    /// Whether the conditions of friction were found to hold.
    pub(super) checked: bool,
}

impl Rubbed {
    /// The stick zone under a half-width.
    pub(super) fn lambda_at(&self, half_width: f64) -> f64 {
        self.blend.sum(half_width, &self.of_lambda)
    }

    /// The same, and how the friction coefficient rises there.
    pub(super) fn root_at(&self, half_width: f64, doubt: f64) -> Root {
        let slope = self.blend.sum(half_width, &self.of_slope);
        Root { lambda: self.lambda_at(half_width), branch: self.branch, slope, doubt: doubt.max(self.slope_left) }
    }

    /// By how much a member of that half-width, of a finer resolution, differs from what is told of it, as far as that
    /// is the series: by its stick zone, on which resolutions agree long before they do on the shear.
    pub(super) fn apart_from(&self, member: &Member, half_width: f64) -> f64 {
        self.slower * (self.lambda_at(half_width) - member.root.lambda).abs() / felt(member.root.lambda)
    }

    /// The stick zone under a half-width between the members, as it is told.
    pub(super) fn seen(&self, half_width: f64) -> Seen {
        Seen::told(half_width, self.lambda_at(half_width), self.unsure)
    }

    /// The widest stick zone about those of three contacts, the widest contact last.
    pub(super) fn widest_zone(&self, three: [&Seen; 3]) -> Seen {
        let three = three.map(|seen| (seen.half_width, seen.zone));
        self.seen(climb::top(three, |half_width| self.seen(half_width).zone).0)
    }

    /// Whether a half-width is between its members.
    pub(super) fn tells(&self, half_width: f64) -> bool {
        (self.blend.narrowest()..=self.blend.widest()).contains(&half_width)
    }

    /// The stick zones under half-widths side by side, from the blend's functions there.
    pub(super) fn lambda_in_lanes(&self, functions: &[Lanes]) -> Lanes {
        let mut lambda = [0.0; LANES];
        for (share, function) in self.of_lambda.iter().zip(functions) {
            lambda.iter_mut().zip(function).for_each(|(lambda, function)| *lambda += share * function);
        }
        lambda
    }
}

/// By how much what the shear lacks moves with `lambda`, over the half-widths of a family.
pub(super) struct Moves {
    blend: Arc<Blend>,
    /// A series over the places for each function of the half-width.
    coefficients: Vec<f64>,
    /// By how much they and the slope differed from what a coarser resolution knew, relative.
    doubt: f64,
}

impl Moves {
    /// The series at a half-width.
    fn at(&self, half_width: f64) -> Vec<f64> {
        let mut functions = Vec::new();
        self.blend.functions_at(half_width, &mut functions);
        let mut series = vec![0.0; self.coefficients.len() / functions.len()];
        add_rows(&functions, &self.coefficients, &mut series);
        series
    }
}

/// A member's stick zone and shear.
pub(super) struct Member {
    pub(super) root: Root,
    /// What the shear lacks, times `sqrt(b^2 - x^2)`, as a series over the places.
    pub(super) lack: Vec<f64>,
    /// What it lacks to no shear at all, where everything sticks, and the least that errors of that are relative to.
    pub(super) stuck: Option<(Vec<f64>, f64)>,
    /// By how much that moves with `lambda`: measured, or known well enough before.
    pub(super) moves: Option<Vec<f64>>,
}

impl Member {
    /// What the shear solved last lacks to a friction coefficient's, times `sqrt(b^2 - x^2)`, as a series over the
    /// places up to an end.
    pub(super) fn lack(contact: &Contact, friction: f64, end: f64) -> Vec<f64> {
        let shear = contact.shear.as_ref().expect("friction has shear");
        let zone = shear.zone;
        // The pressure has a branch point where the contact ends.
        let crowding = if zone.log() < FADED { zone.crowding() } else { 1.0 };
        let places = Places::of(shear.unknowns().len() as f64 * finer(crowding), end);
        let scaled = |at: &Station| Station { x: zone.half_width * at.x, gap: zone.half_width * at.gap };
        let mut at: Vec<Station> = places.stations.iter().map(scaled).collect();
        let (mut q, mut p) = (vec![0.0; at.len()], vec![0.0; at.len()]);
        shear.in_stick_into(&at, &mut q);
        for at in &mut at {
            *at = zone.in_contact(*at);
        }
        contact.normal.values_into(&at, &mut p);
        for ((p, q), at) in p.iter_mut().zip(&q).zip(&at) {
            *p = (at.gap * (zone.contact() + at.x)).sqrt() * (friction * *p - q);
        }
        // What was the shear is room for the series.
        places.through_into(&p, &mut q);
        q
    }
}

/// What was found of the members so far.
pub(super) struct Members {
    lambda: Vec<f64>,
    slope: Vec<f64>,
    branch: f64,
    lack: Vec<Vec<f64>>,
    stuck: Vec<Vec<f64>>,
    /// The least that errors of what is `stuck` are relative to.
    least: f64,
    moves: Vec<Vec<f64>>,
    /// What a coarser resolution knows of the moves, and by how much those measured last differ from it, relative.
    known: Option<Arc<Moves>>,
    pub(super) doubt: f64,
    pub(super) checked: bool,
}

impl Members {
    pub(super) fn new(known: Option<Arc<Moves>>, checked: bool) -> Self {
        let doubt = known.as_ref().map_or(f64::INFINITY, |known| known.doubt);
        Self {
            lambda: Vec::new(),
            slope: Vec::new(),
            branch: 1.0,
            lack: Vec::new(),
            stuck: Vec::new(),
            least: 0.0,
            moves: Vec::new(),
            known,
            doubt,
            checked,
        }
    }

    /// By how much what the shear lacks at a half-width is known to move with `lambda`.
    pub(super) fn moves_known(&self, half_width: f64) -> Option<Vec<f64>> {
        let within = self.known.as_ref().filter(|moves| half_width <= moves.blend.widest());
        within.map(|moves| moves.at(half_width))
    }

    /// The stick zone to be expected next, from the last two.
    pub(super) fn continued(&self, half_widths: &[f64], b: f64) -> Option<Root> {
        let ([.., b2, b1], [.., l2, l1]) = (half_widths, self.lambda.as_slice()) else { return None };
        let lambda = l1 + (l1 - l2) / (b1 - b2) * (b - b1);
        Some(Root { lambda, branch: self.branch, slope: *self.slope.last()?, doubt: f64::INFINITY })
    }

    /// Two half-widths side by side, everything sticking at the first and not at the second; `None` where it does at
    /// all, or at none.
    pub(super) fn sticks_at_times(&self, half_widths: &[f64]) -> Option<(f64, f64)> {
        let sticks = |lambda: f64| lambda > FrictionCurve::WIDEST;
        let change = self.lambda.windows(2).position(|pair| sticks(pair[0]) != sticks(pair[1]))?;
        let (wide, narrow) = (half_widths[change], half_widths[change + 1]);
        Some(if sticks(self.lambda[change]) { (wide, narrow) } else { (narrow, wide) })
    }

    /// The smallest stick zone that is not all of its contact, of contacts up to a widest.
    pub(super) fn narrowest_zone(&self, half_widths: &[f64], widest: f64) -> f64 {
        let zones = half_widths.iter().zip(&self.lambda).filter(|(b, _)| **b <= widest);
        let slips = zones.filter(|(_, lambda)| **lambda <= FrictionCurve::WIDEST);
        let zones = slips.map(|(b, lambda)| StickZone::from_log(*lambda, *b).half_width);
        zones.fold(f64::INFINITY, f64::min)
    }

    /// Adds a member; returns false where it slips another way than those before.
    pub(super) fn add(&mut self, member: Member) -> bool {
        if self.lambda.is_empty() {
            self.branch = member.root.branch;
        }
        self.lambda.push(member.root.lambda);
        self.slope.push(member.root.slope);
        self.lack.push(member.lack);
        if let Some((stuck, least)) = member.stuck {
            self.stuck.push(stuck);
            self.least = self.least.max(least);
        }
        self.moves.extend(member.moves);
        self.branch.to_bits() == member.root.branch.to_bits()
    }

    /// All members were found, their shears told at places up to an end; `wanted` is the error of the numbers.
    pub(super) fn blended(self, blend: Blend, (end, wanted): (f64, f64), coarse: Option<(Told, f64)>) -> Rubbed {
        let blend = Arc::new(blend);
        let is_known = self.moves.len() == self.lack.len();
        let sticks = self.stuck.len() == self.lack.len();
        let (lack, least) = if sticks { (self.stuck, self.least) } else { (self.lack, 0.0) };
        let (lack, width) = side_by_side(lack);
        let moves = is_known.then(|| {
            let (moves, width) = side_by_side(self.moves);
            let coefficients = blend.coefficients(&moves, width);
            Arc::new(Moves { blend: Arc::clone(&blend), coefficients, doubt: self.doubt })
        });
        let of_lambda = blend.coefficients(&self.lambda, 1);
        let of_slope = blend.coefficients(&self.slope, 1);
        let lack = blend.coefficients(&lack, width);
        // A zone is a logarithm.
        let of_zone = blend.last(&of_lambda, 1) / felt(largest(&of_lambda));
        let of_lack = blend.last(&lack, width) / largest(&lack).max(least);
        let told = Told::new(blend.functions(), of_lack.max(of_zone), coarse);
        let unsure = UNSURE * told.left() * blend.widest();
        Rubbed {
            zones: zones(&blend, &self.lambda, &of_lambda, unsure),
            unsure,
            told,
            of_lambda,
            slope_left: if are_alike(&self.slope) {
                blend.last(&of_slope, 1) / largest(&of_slope)
            } else {
                f64::INFINITY
            },
            of_slope,
            branch: self.branch,
            sticks,
            slower: (of_lack / of_zone).max(1.0),
            lack: Sheet::new(lack, width, end, wanted),
            moves: moves.or(self.known),
            checked: self.checked,
            blend,
        }
    }
}

/// Of slip zones as narrow as `exp(-FADED)` of the contact no place at which the shear is told sees anything.
const FADED: f64 = 100.0;

/// By how much less of a change of `lambda` is felt, as far as it is large: in proportion to the friction coefficient.
fn felt(lambda: f64) -> f64 {
    /// Slip zones of `exp(-SEEN)` of the contact are not seen at all.
    const SEEN: f64 = 30.0;
    (lambda / SEEN).max(1.0)
}

/// Parts of the way from one member to the next, over each of which a zone is taken to grow, or to shrink.
pub(super) const PARTS: usize = 4;

/// Factor on what the series of the stick zones are taken to leave, where it is asked whether these shrink.
const UNSURE: f64 = 4.0;

/// The stick zone of a contact of some half-width.
#[derive(Clone, Copy)]
pub(super) struct Seen {
    pub(super) half_width: f64,
    pub(super) zone: f64,
    /// How unsure that is, relative, times the half-width.
    pub(super) unsure: f64,
}

impl Seen {
    fn told(half_width: f64, lambda: f64, unsure: f64) -> Self {
        Self { half_width, zone: StickZone::from_log(lambda, half_width).half_width, unsure }
    }

    /// By how much it is smaller than that of a narrower contact, relative: the least that is sure, and what is said.
    pub(super) fn shrinks_from(&self, narrow: &Self) -> Range<f64> {
        let said = 1.0 - self.zone / narrow.zone;
        said - self.unsure.max(narrow.unsure) / narrow.half_width..said
    }
}

/// Stick zones at the members, the widest first, and as told at the ends of the parts between, where they are so
/// `unsure`.
fn zones(blend: &Blend, lambda: &[f64], of_lambda: &[f64], unsure: f64) -> Vec<Seen> {
    let half_widths = blend.half_widths();
    let mut zones = Vec::with_capacity(PARTS * half_widths.len());
    for (k, (b, lambda)) in half_widths.iter().zip(lambda).enumerate() {
        zones.push(Seen::told(*b, *lambda, 0.0));
        let Some(next) = half_widths.get(k + 1) else { break };
        let between = (1..PARTS).map(|part| b + (next - b) * part as f64 / PARTS as f64);
        zones.extend(between.map(|b| Seen::told(b, blend.sum(b, of_lambda), unsure)));
    }
    zones
}

/// Whether each slope is near that of the member before. One that was measured where the curve jumps, from one grid of
/// the slip zone to another, is not, and what is between it and others moves no zone far enough, at this resolution and
/// at all that come after.
fn are_alike(slopes: &[f64]) -> bool {
    /// A step along a slope that many times another, or less, still leaves no more than half of the way.
    const NEAR: f64 = 1.5;
    slopes.windows(2).all(|pair| (1.0 / NEAR..NEAR).contains(&(pair[1] / pair[0])))
}

/// Series of any lengths as rows of one, and that.
fn side_by_side(mut series: Vec<Vec<f64>>) -> (Vec<f64>, usize) {
    let width = series.iter().map(Vec::len).max().unwrap_or(0);
    for row in &mut series {
        row.resize(width, 0.0);
    }
    (series.concat(), width)
}

/// How many times as many places as the unknowns alone ask for tell the shear where convergence is that much slower; in
/// powers of `sqrt 2`, so that neighbours have as many.
fn finer(crowding: f64) -> f64 {
    /// A zone that ends far from the contact's edge asks for no more.
    const NEARLY: f64 = 0.65;
    let steps = (2.0 * (NEARLY * crowding).log2()).ceil().max(0.0);
    (0.5 * steps).exp2()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::growing::sheet::END;
    use crate::engine::numerics::root::CERTAIN;

    #[test]
    fn one_slope_that_is_none_of_the_others_puts_all_in_doubt() {
        let doubt_of = |odd: f64| {
            let blend = Blend::new((0.0, 3.0), 16, &[]).unwrap();
            let mut found = Members::new(None, true);
            for (k, b) in blend.half_widths().iter().enumerate() {
                let slope = if k == 5 { odd } else { 0.14 + 0.001 * b };
                let root = Root { lambda: 5.0 + b, branch: 1.0, slope, doubt: 0.0 };
                found.add(Member { root, lack: vec![1.0], stuck: None, moves: None });
            }
            found.blended(blend, (END, 1e-10), None).root_at(1.0, 0.005).doubt
        };
        assert!(doubt_of(0.14) < CERTAIN);
        assert!(doubt_of(0.3) > CERTAIN && doubt_of(-6.0) > CERTAIN);
    }

    /// Wherever it is: the last coefficient may miss it.
    #[test]
    fn slopes_are_alike_where_each_is_near_the_one_before() {
        let slopes: Vec<f64> = (0..16).map(|k| 0.08 * 1.1_f64.powi(k)).collect();
        assert!(are_alike(&slopes));
        for k in 0..slopes.len() {
            for odd in [2.0, 0.4, -1.0, 28.0, f64::NAN] {
                let mut slopes = slopes.clone();
                slopes[k] *= odd;
                assert!(!are_alike(&slopes), "{odd} times at {k}");
            }
        }
    }
}
