//! The size of a contact under a load, and how the load grows with it.

use super::Stack;
use crate::engine::growing::family::Family;
use crate::engine::numerics::climb::Trail;
use crate::engine::numerics::root;
use crate::engine::pressure::contact_size::Size;
use crate::engine::problem::{LoadInLayerUnits, Problem};

/// By how much a half-width is narrower from which the growth of a load is measured, relative.
const BESIDE: f64 = 1e-3;
/// The way in `ln b'` over which a depth is looked at for its first rise to a load's.
const CLIMB: f64 = 9.0;
/// Steps of that way.
const CLIMB_STEPS: f64 = 45.0;

impl Stack {
    /// Half-width of the contact under a load; `None` where no member bears it.
    pub(crate) fn under(&mut self, problem: &Problem, family: &mut Family, load: LoadInLayerUnits) -> Option<f64> {
        if let LoadInLayerUnits::HalfWidth(half_width) = load {
            return Some(half_width);
        }
        let shrinks = may_shrink(problem, load);
        self.first(shrinks, |stack, b| stack.excess(problem, family, load, b))
    }

    /// What a contact of that half-width bears beyond a load, relative.
    pub(crate) fn excess(&mut self, problem: &Problem, family: &mut Family, load: LoadInLayerUnits, b: f64) -> f64 {
        match load {
            LoadInLayerUnits::HalfWidth(half_width) => b / half_width - 1.0,
            LoadInLayerUnits::Force(force) => self.force(problem, b) / force - 1.0,
            LoadInLayerUnits::Indentation(depth) => self.depth(problem, family, b) / depth - 1.0,
        }
    }

    /// A half-width that bears the load, with what it misses of that: the force grows from a face like a power of what is beyond it, of which the
    /// half-width holds few digits, a millionth where that is 1e-10 of it. Where the load may shrink, with how it grows there, too.
    pub(crate) fn size(&mut self, problem: &Problem, family: &mut Family, half_width: f64) -> Size {
        let size = Size::exactly(half_width).missing(self.excess(problem, family, problem.load, half_width).abs());
        if may_shrink(problem, problem.load) { size.growing(self.growth(problem, family, half_width)) } else { size }
    }

    /// A size to start from, where the stack finds the load at that half-width: with how the load grows there.
    pub(crate) fn size_about(&mut self, problem: &Problem, family: &mut Family, half_width: f64) -> Size {
        Size::about(half_width, self.growth(problem, family, half_width))
    }

    /// How the load grows with the half-width, both over what they are.
    fn growth(&mut self, problem: &Problem, family: &mut Family, half_width: f64) -> f64 {
        let mut borne = |b: f64| match problem.load {
            LoadInLayerUnits::HalfWidth(_) => b,
            LoadInLayerUnits::Force(_) => self.force(problem, b),
            LoadInLayerUnits::Indentation(_) => self.depth(problem, family, b),
        };
        (borne(half_width) / borne(half_width * (1.0 - BESIDE))).ln() / -(-BESIDE).ln_1p()
    }

    /// The narrowest half-width at which something grows through zero, where it may shrink again: a stiff surface bends, and a
    /// datum may sink as fast as the punch for a while.
    fn first(&mut self, shrinks: bool, mut excess: impl FnMut(&mut Self, f64) -> f64) -> Option<f64> {
        let (least, widest) = self.range()?;
        if !shrinks {
            return self.root((least, widest), excess);
        }
        let end = first_rise((least.ln(), widest.ln()), |log| excess(self, log.exp()));
        self.root((least, end.exp().min(widest)), excess)
    }

    /// Half-widths between which a load is looked for.
    fn range(&self) -> Option<(f64, f64)> {
        let (face, widest) = (self.breaks[0], *self.breaks.last()?);
        Some((if face > 0.0 { face * (1.0 + 1e-12) } else { widest * 1e-9 }, widest))
    }

    /// Half-width within a range at which something grows through zero.
    fn root(&mut self, (least, widest): (f64, f64), mut excess: impl FnMut(&mut Self, f64) -> f64) -> Option<f64> {
        root::between((least, widest), 4.0 * f64::EPSILON * widest, |b| excess(self, b))
    }
}

/// A place before which something has grown above zero for the first time, as far as [`CLIMB_STEPS`] and the parabolas through them
/// tell; the end where it has nowhere.
fn first_rise((from, to): (f64, f64), mut excess: impl FnMut(f64) -> f64) -> f64 {
    let from = from.max(to - CLIMB);
    let step = (to - from) / CLIMB_STEPS;
    let mut trail = Trail::default();
    let mut at = from;
    while at < to {
        let here = excess(at);
        if here >= 0.0 {
            return at;
        }
        if let Some((_, top)) = trail.top((at, here), &mut excess) {
            return top;
        }
        trail.pass((at, here));
        at += step;
    }
    to
}

/// Whether a load of that kind may shrink while the contact grows: a stiff surface bends, and a datum may sink as fast as the punch.
fn may_shrink(problem: &Problem, load: LoadInLayerUnits) -> bool {
    match load {
        LoadInLayerUnits::HalfWidth(_) => false,
        LoadInLayerUnits::Force(_) => problem.is_on_soft_base() || problem.has_soft_sublayer(),
        LoadInLayerUnits::Indentation(_) => !problem.layer.is_grounded() || problem.has_soft_sublayer(),
    }
}
