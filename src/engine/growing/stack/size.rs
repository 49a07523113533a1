//! The size of a contact under a load, and how the load grows with it.

use super::Stack;
use crate::engine::growing::family::Family;
use crate::engine::numerics::climb::Trail;
use crate::engine::numerics::root;
use crate::engine::pressure::contact_size::Size;
use crate::engine::problem::{LoadInLayerUnits, Problem};
use std::mem::{Discriminant, discriminant};

/// By how much a half-width is narrower from which the growth of a load is measured, relative.
const BESIDE: f64 = 1e-3;
/// The way in `ln b'` over which a depth is looked at for its first rise to a load's.
const CLIMB: f64 = 9.0;
/// Steps of that way.
const CLIMB_STEPS: f64 = 45.0;

/// What contacts bear at the steps that are looked at for the first rise to a load, and the kind of that.
pub(super) type Climbed = Option<(Discriminant<LoadInLayerUnits>, Vec<f64>)>;

impl Stack {
    /// Half-width of the contact under a load; `None` where no member bears it.
    pub(crate) fn under(&mut self, problem: &Problem, family: &mut Family, load: LoadInLayerUnits) -> Option<f64> {
        if let LoadInLayerUnits::HalfWidth(half_width) = load {
            return Some(half_width);
        }
        let (least, widest) = self.range()?;
        let end = if self.may_shrink(problem, load) {
            self.first_rise(problem, family, load, (least, widest)).min(widest)
        } else {
            widest
        };
        root::between((least, end), 4.0 * f64::EPSILON * end, |b| self.excess(problem, family, load, b))
    }

    /// What a contact of that half-width bears beyond a load, relative.
    pub(crate) fn excess(&mut self, problem: &Problem, family: &mut Family, load: LoadInLayerUnits, b: f64) -> f64 {
        self.borne(problem, family, load, b) / load.value() - 1.0
    }

    /// What it bears, as loads of that kind are counted.
    fn borne(&mut self, problem: &Problem, family: &mut Family, load: LoadInLayerUnits, b: f64) -> f64 {
        match load {
            LoadInLayerUnits::HalfWidth(_) => b,
            LoadInLayerUnits::Force(_) => self.force(problem, b),
            LoadInLayerUnits::Indentation(_) => self.depth(problem, family, b),
        }
    }

    /// A half-width that bears the load, with what it misses of that: the force grows from a face like a power of what
    /// is beyond it, of which the half-width holds few digits, a millionth where that is 1e-10 of it. Where the load
    /// may shrink, with how it grows there, too.
    pub(crate) fn size(&mut self, problem: &Problem, family: &mut Family, half_width: f64) -> Size {
        let size = Size::exactly(half_width).missing(self.excess(problem, family, problem.load, half_width).abs());
        if self.may_shrink(problem, problem.load) {
            size.growing(self.growth(problem, family, half_width))
        } else {
            size
        }
    }

    /// A size to start from, where the stack finds the load at that half-width: with how the load grows there.
    pub(crate) fn size_about(&mut self, problem: &Problem, family: &mut Family, half_width: f64) -> Size {
        Size::about(half_width, self.growth(problem, family, half_width))
    }

    /// How the load grows with the half-width, both over what they are.
    fn growth(&mut self, problem: &Problem, family: &mut Family, half_width: f64) -> f64 {
        let mut borne = |b: f64| self.borne(problem, family, problem.load, b);
        (borne(half_width) / borne(half_width * (1.0 - BESIDE))).ln() / -(-BESIDE).ln_1p()
    }

    /// Half-widths between which a load is looked for.
    fn range(&self) -> Option<(f64, f64)> {
        let (face, widest) = (self.breaks[0], *self.breaks.last()?);
        Some((if face > 0.0 { face * (1.0 + 1e-12) } else { widest * 1e-9 }, widest))
    }

    /// A half-width at which a load is borne that may shrink again while the contact grows, and before which it was
    /// borne nowhere, as far as
    /// [`CLIMB_STEPS`] and the parabolas through them tell; the widest of the range where it is borne nowhere.
    fn first_rise(
        &mut self,
        problem: &Problem,
        family: &mut Family,
        load: LoadInLayerUnits,
        (least, widest): (f64, f64),
    ) -> f64 {
        let to = widest.ln();
        let from = least.ln().max(to - CLIMB);
        let step = (to - from) / CLIMB_STEPS;
        let mut trail = Trail::default();
        let (mut steps, mut at) = (0, from);
        while at < to {
            let here = self.borne_on_the_way(problem, family, load, (steps, at.exp())) / load.value() - 1.0;
            if here >= 0.0 {
                return at.exp();
            }
            let excess = |log: f64| self.excess(problem, family, load, log.exp());
            if let Some((_, top)) = trail.top((at, here), excess) {
                return top.exp();
            }
            trail.pass((at, here));
            at += step;
            steps += 1;
        }
        to.exp()
    }

    /// What the contact after so many steps bears: they are the same for all loads of a kind, one after another.
    fn borne_on_the_way(
        &mut self,
        problem: &Problem,
        family: &mut Family,
        load: LoadInLayerUnits,
        (steps, b): (usize, f64),
    ) -> f64 {
        let kind = discriminant(&load);
        let known = match &self.climbed {
            Some((known, borne)) if *known == kind => borne.get(steps).copied(),
            _ => {
                self.climbed = Some((kind, Vec::new()));
                None
            }
        };
        known.unwrap_or_else(|| {
            let borne = self.borne(problem, family, load, b);
            self.climbed.iter_mut().for_each(|(_, all)| all.push(borne));
            borne
        })
    }

    /// Whether a load of that kind may shrink while the contact grows: a stiff surface bends, and a datum may sink as
    /// fast as the punch.
    fn may_shrink(&mut self, problem: &Problem, load: LoadInLayerUnits) -> bool {
        let mut bends = || *self.bends.get_or_insert_with(|| problem.is_softer_below());
        match load {
            LoadInLayerUnits::HalfWidth(_) => false,
            LoadInLayerUnits::Force(_) => problem.is_on_soft_base() || bends(),
            LoadInLayerUnits::Indentation(_) => !problem.layer.is_grounded() || bends(),
        }
    }
}
