//! Friction under a flat punch at one resolution: the stick zone, looked for, followed and checked.

use super::Contact;
use crate::engine::friction::checks;
use crate::engine::friction::linear_strain::RateCurve;
use crate::engine::friction::rubbing::{Rubbing, Verdict};
use crate::engine::friction::sharpen::{apart_from_twin, sharpen};
use crate::engine::friction::stick_search::{Found, FrictionCurve, Root};
use crate::engine::friction::stick_zone::StickZone;
use crate::engine::numerics::root::CERTAIN;
use crate::engine::outcome::{Outcome, Task};
use crate::engine::prepared_layer::PreparedLayer;
use crate::engine::problem::Problem;
use slipzone_api::Refusal;
use std::f64::consts::PI;

/// Friction below this share of the coefficient at every stick zone is rounding: there is no shear.
const NO_SHEAR: f64 = 1e-10;
/// A stick zone whose widths change by less than this from one resolution to the next is known well enough to be
/// checked, and to have its shear told from the zone solved last.
const KNOWN: f64 = 1e-4;

impl Contact {
    /// The curve of friction coefficients over stick zones, and room for the shear.
    pub(crate) fn curve<'a>(&'a mut self, layer: &'a PreparedLayer, task: Task) -> FrictionCurve<'a> {
        FrictionCurve {
            layer,
            normal: &mut self.normal,
            shear: self.shear.as_mut().expect("room for the shear was made with friction"),
            beta: task.problem.elastic.beta(),
            tolerance: task.tolerance,
        }
    }

    /// Finds the stick zones: follows those of a coarser resolution, or looks for all.
    pub(super) fn rub(
        &mut self,
        layer: &PreparedLayer,
        task: Task,
        coarse: Option<&Rubbing>,
    ) -> Result<Rubbing, Refusal> {
        let (b, eta) = (self.normal.half_width, task.friction());
        if let Some((half_width, friction, rubbing)) = &self.rubbed
            && self.normal.is_flat
            && (half_width.to_bits(), friction.to_bits()) == (b.to_bits(), eta.to_bits())
        {
            return Ok(rubbing.clone());
        }
        let mut rubbing = self.find(layer, task, coarse)?;
        self.examine(layer, task, &mut rubbing, coarse.and_then(Rubbing::root))?;
        self.rubbed = Some((b, eta, rubbing.clone()));
        Ok(rubbing)
    }

    /// Finds the stick zone in which the strain is `C|x|`: near that of a coarser resolution, or by a search.
    pub(super) fn rub_linearly(
        &mut self,
        layer: &PreparedLayer,
        task: Task,
        coarse: Option<&Rubbing>,
    ) -> Result<Rubbing, Refusal> {
        self.refresh(layer);
        let (b, eta) = (self.normal.half_width, task.friction());
        let known = coarse.and_then(Rubbing::reported);
        let shear = self.shear.as_mut().expect("room for the shear was made with friction");
        let mut failure = None;
        for branch in [1.0, -1.0] {
            if known.is_some_and(|root| root.branch.to_bits() != f64::to_bits(branch)) {
                continue;
            }
            let (beta, friction) = (task.problem.elastic.beta(), branch * eta);
            let mut curve = RateCurve { layer, normal: &mut self.normal, shear, beta, friction };
            for lambda in curve.extrema(known.map(|root| root.lambda))? {
                curve.at(lambda)?;
                let root = Root { lambda, branch, slope: f64::NAN, doubt: f64::NAN };
                let rubbing = Rubbing::expected(root, b, true);
                let rubbing = rubbing.traced(curve.shear.trace(curve.normal.mean()));
                // As near to its end as a slice: nearer, contacts that grow end on their budget for it.
                let Some((x, load)) = checks::overload(layer, curve.normal, curve.shear, eta, true) else {
                    return Ok(rubbing);
                };
                let what = format!("{} inside the stick zone", checks::overloaded(load, x));
                failure = failure.or(Some(rubbing.failing(what)));
            }
        }
        let lost = StickZone::from_log(FrictionCurve::NARROWEST_SAMPLED, b);
        Ok(failure.unwrap_or_else(|| Rubbing::new(lost, Verdict::NotScanned, Found::default())))
    }

    /// Takes the shear's trace, and checks the conditions of friction as soon as the zone is known: resolutions that
    /// come after change it by less than the checks tell apart.
    fn examine(
        &mut self,
        layer: &PreparedLayer,
        task: Task,
        rubbing: &mut Rubbing,
        before: Option<f64>,
    ) -> Result<(), Refusal> {
        let known = before.zip(rubbing.root()).filter(|(before, lambda)| Self::is_known(*before, *lambda));
        if let Some((_, lambda)) = known.filter(|_| !rubbing.checked) {
            if self.of_slices || rubbing.scanned {
                rubbing.checked = self.holds(layer, task, lambda)?;
            } else if self.judge(layer, task, KNOWN, rubbing)?.is_some() {
                self.look_again(layer, task, rubbing)?;
            }
        }
        let Some(lambda) = rubbing.solved() else { return Ok(()) };
        self.curve(layer, task).at_or_near(lambda, KNOWN)?;
        let shear = self.shear.as_ref().expect("room for the shear was made with friction");
        rubbing.shear = Some(shear.trace(self.normal.mean()));
        Ok(())
    }

    /// Looks for all stick zones again where none of those known holds: this resolution may see what the coarser one
    /// that was scanned did not. Finer ones need not look.
    fn look_again(&mut self, layer: &PreparedLayer, task: Task, rubbing: &mut Rubbing) -> Result<(), Refusal> {
        rubbing.scanned = true;
        let again = self.scan(layer, task)?;
        if let Some(again) = self.followed(layer, task, &again)? {
            *rubbing = Rubbing { scanned: true, ..again };
        }
        Ok(())
    }

    /// Whether a stick zone is known well enough for its conditions to be checked, from where two resolutions find it.
    pub(crate) fn is_known(before: f64, lambda: f64) -> bool {
        (before - lambda).abs() < KNOWN
    }

    /// Whether both conditions of friction hold in a stick zone.
    pub(crate) fn holds(&mut self, layer: &PreparedLayer, task: Task, lambda: f64) -> Result<bool, Refusal> {
        self.curve(layer, task).at_or_near(lambda, KNOWN)?;
        Ok(self.violation(layer, task.problem).is_none())
    }

    /// Shows the present pressure to the shear. Under a flat punch both grow with the force.
    fn refresh(&mut self, layer: &PreparedLayer) {
        let Some(shear) = &mut self.shear else { return };
        let (half_width, force) = (self.normal.half_width, self.normal.force);
        match self.shown {
            Some((before, less)) if self.normal.is_flat && before.to_bits() == half_width.to_bits() => {
                shear.press(force / less);
            }
            _ => shear.under(layer, &mut self.normal),
        }
        self.shown = Some((half_width, force));
    }

    /// [`Self::rub`], from the beginning.
    fn find(&mut self, layer: &PreparedLayer, task: Task, coarse: Option<&Rubbing>) -> Result<Rubbing, Refusal> {
        if coarse.is_some_and(|coarse| coarse.verdict == Verdict::Sticks) && self.stuck(layer, task)?.is_some() {
            return Ok(Rubbing::sticking(self.normal.half_width, false));
        }
        self.refresh(layer);
        if let Some(coarse) = coarse
            && let Some(rubbing) = self.followed(layer, task, coarse)?
        {
            return Ok(rubbing);
        }
        self.scan(layer, task)
    }

    /// The stick zone, wider than all that are looked for, where everything sticks; leaves the shear of the widest of
    /// these. How wide it is tells by how much friction is more than it takes; where the curve is flat all are that
    /// wide.
    pub(crate) fn stuck(&mut self, layer: &PreparedLayer, task: Task) -> Result<Option<Root>, Refusal> {
        self.refresh(layer);
        let eta = task.friction();
        let least = self.curve(layer, task).at(FrictionCurve::WIDEST)?;
        let slope = (task.problem.elastic.beta() / PI).max(FrictionCurve::FLAT);
        let lambda = FrictionCurve::WIDEST + (eta - least) / slope;
        Ok((least.abs() < eta).then_some(Root { lambda, branch: 1.0, slope, doubt: 0.0 }))
    }

    /// The friction coefficient that the shear solved last belongs to.
    pub(crate) fn friction_of_shear(&self) -> f64 {
        self.shear.as_ref().map_or(0.0, |shear| shear.friction)
    }

    /// The stick zone reported, known roughly, found at this resolution to the tolerance; `None` where it is lost.
    /// Others stay as they are: they are asked for only should this one fail a condition.
    fn followed(&mut self, layer: &PreparedLayer, task: Task, known: &Rubbing) -> Result<Option<Rubbing>, Refusal> {
        let Some(root) = known.found.roots.get(known.chosen) else { return Ok(None) };
        let Some(root) = self.curve(layer, task).follow(*root, task.friction())? else { return Ok(None) };
        let mut rubbing = Rubbing { verdict: Verdict::Holds, is_full: false, shear: None, ..known.clone() };
        rubbing.zone = StickZone::from_log(root.lambda, self.normal.half_width);
        rubbing.found.roots[known.chosen] = root;
        Ok(Some(rubbing))
    }

    /// Looks for all stick zones, and for the first that holds where there are several; those in which all sticks, or
    /// that are too narrow to be found, come last.
    fn scan(&mut self, layer: &PreparedLayer, task: Task) -> Result<Rubbing, Refusal> {
        let (b, eta) = (self.normal.half_width, task.friction());
        let samples = match self.sampled.take() {
            Some((half_width, samples)) if half_width.to_bits() == b.to_bits() => samples,
            _ => self.curve(layer, task).sample()?,
        };
        let mut curve = self.curve(layer, task);
        let mut found = curve.roots(eta, &samples)?;
        if self.branch < 0.0 {
            found.roots.sort_by(|one, other| one.branch.total_cmp(&other.branch));
        }
        self.sampled = Some((b, samples));
        let (lambda, verdict) = match (found.roots.first(), found.narrower) {
            (Some(root), _) => (root.lambda, Verdict::Holds),
            _ if found.largest < NO_SHEAR * eta => (0.0, Verdict::NoShear),
            (None, Some(bound)) => (bound, Verdict::TooNarrow),
            _ if found.wider => (FrictionCurve::WIDEST, Verdict::Sticks),
            _ => (FrictionCurve::NARROWEST_SAMPLED, Verdict::NoRoot),
        };
        let zone = match verdict {
            Verdict::NoShear => StickZone { half_width: b, slip_width: 0.0 },
            _ => StickZone::from_log(lambda, b),
        };
        let mut rubbing = Rubbing::new(zone, verdict, found);
        let (roots, wider, narrower) = (rubbing.found.roots.len(), rubbing.found.wider, rubbing.found.narrower);
        if roots > 0
            && roots + usize::from(wider) + usize::from(narrower.is_some()) > 1
            && let Some(what) = self.judge(layer, task, task.tolerance, &mut rubbing)?
        {
            if wider {
                return Ok(Rubbing::sticking(b, false));
            }
            // What holds in one as narrow as the bound holds in those below.
            if let Some(bound) = narrower
                && self.holds(layer, task, bound)?
            {
                let found = Found { narrower, ..Found::default() };
                return Ok(Rubbing::new(StickZone::from_log(bound, b), Verdict::TooNarrow, found));
            }
            rubbing.verdict = Verdict::Fails(what);
        }
        // So coarse a resolution may see nothing of what a zone fails: it is checked again once it is known.
        rubbing.checked = false;
        Ok(rubbing)
    }

    /// Checks the stick zone reported, known to within an error, unless it was; where it fails a condition of friction,
    /// reports the first of the others that satisfies both. Otherwise returns what it fails. Leaves the shear of the
    /// zone checked last.
    fn judge(
        &mut self,
        layer: &PreparedLayer,
        task: Task,
        error: f64,
        rubbing: &mut Rubbing,
    ) -> Result<Option<String>, Refusal> {
        let (first, mut failure) = (rubbing.chosen, None);
        let others = (0..rubbing.found.roots.len()).filter(|i| *i != first);
        for i in [first].into_iter().chain(others) {
            if i != first {
                let Some(root) = self.curve(layer, task).follow(rubbing.found.roots[i], task.friction())? else {
                    continue;
                };
                rubbing.found.roots[i] = root;
            }
            let lambda = rubbing.found.roots[i].lambda;
            self.curve(layer, task).at_or_near(lambda, error)?;
            let known = rubbing.checked && i == first;
            let Some(what) = (if known { None } else { self.violation(layer, task.problem) }) else {
                (rubbing.chosen, rubbing.checked, rubbing.verdict) = (i, true, Verdict::Holds);
                rubbing.zone = StickZone::from_log(lambda, self.normal.half_width);
                return Ok(None);
            };
            failure = failure.or(Some(what));
        }
        Ok(failure)
    }

    /// The stick zone under a flat punch from a guess, to within an error; its shear is left in `shear`. `None` where
    /// the guess was not near.
    pub(crate) fn follow(
        &mut self,
        layer: &mut PreparedLayer,
        task: Task,
        half_width: f64,
        guess: Root,
        error: f64,
    ) -> Result<Option<Root>, Refusal> {
        const STEPS: usize = 6;
        const WIDEST: f64 = 0.3;
        if !FrictionCurve::reaches(guess.lambda) {
            return Ok(None);
        }
        self.press(layer, task, half_width)?;
        self.refresh(layer);
        let target = guess.branch * task.friction();
        let mut curve = self.curve(layer, task);
        let Root { mut lambda, mut slope, mut doubt, .. } = guess;
        let mut value = curve.at(lambda)?;
        for _ in 0..STEPS {
            let step = (target - value) / slope;
            // What a step along the slope misses: the part by which that is in doubt, and the square.
            let is_last = doubt < CERTAIN && step.abs() * (doubt + step.abs()) < 0.5 * error;
            if step.abs() < error || is_last {
                return Ok(Some(Root { lambda: lambda + step, slope, ..guess }));
            }
            if step.is_nan() || step.abs() > WIDEST || !FrictionCurve::reaches(lambda + step) {
                return Ok(None);
            }
            let next = curve.at(lambda + step)?;
            let measured = (next - value) / step;
            // Differences of rounding have no slope; one of another sign is no neighbour's.
            if step.abs() > f64::EPSILON.sqrt() && measured * slope > 0.0 {
                (slope, doubt) = (measured, step.abs());
            }
            (lambda, value) = (lambda + step, next);
        }
        Ok(None)
    }

    /// Leaves the shear of the stick zone reported in `shear`, and checks it. Returns whether another zone than
    /// before is reported.
    pub(crate) fn settle(&mut self, layer: &PreparedLayer, task: Task, outcome: &mut Outcome) -> Result<bool, Refusal> {
        let Some(rubbing) = &mut outcome.rubbing else { return Ok(false) };
        if task.problem.is_linear {
            return Ok(false); // each is checked when it is found
        }
        self.refresh(layer);
        let before = rubbing.zone;
        if rubbing.found.roots.is_empty() {
            self.settle_without_root(layer, task, rubbing)?;
            if !matches!(rubbing.verdict, Verdict::Fails(_)) || rubbing.scanned {
                return Ok(false);
            }
            // The coarse resolution that was scanned may have turned down the zone that holds.
            self.look_again(layer, task, rubbing)?;
            if rubbing.found.roots.is_empty() {
                self.curve(layer, task).at_or_near(before.log(), KNOWN)?;
                return Ok(false);
            }
        }
        let mut failure = self.judge(layer, task, task.tolerance, rubbing)?;
        if failure.is_some() && !rubbing.scanned {
            self.look_again(layer, task, rubbing)?;
            failure = self.judge(layer, task, task.tolerance, rubbing)?;
        }
        if let Some(what) = failure {
            rubbing.verdict = Verdict::Fails(what);
            let lambda = rubbing.found.roots[rubbing.chosen].lambda;
            self.curve(layer, task).at(lambda)?;
        }
        rubbing.report(&mut outcome.numbers);
        let moved = |now: f64, before: f64| (now / before - 1.0).abs() > 0.1;
        let zone = rubbing.zone;
        Ok(moved(zone.ratio(), before.ratio()) || moved(zone.one_minus_ratio(), before.one_minus_ratio()))
    }

    /// [`Self::settle`] where no stick zone belongs to the friction coefficient: all sticks, or nothing does, or too little of it.
    fn settle_without_root(&mut self, layer: &PreparedLayer, task: Task, rubbing: &mut Rubbing) -> Result<(), Refusal> {
        let lambda = rubbing.zone.log();
        if rubbing.verdict == Verdict::Sticks {
            self.curve(layer, task).at_or_near(lambda, KNOWN)?;
            if let Some(what) = self.overload(layer, task.friction()) {
                rubbing.verdict = Verdict::Fails(what);
            }
            return Ok(());
        }
        let finite = lambda.clamp(FrictionCurve::NARROWEST, FrictionCurve::WIDEST);
        let friction = self.curve(layer, task).at(finite)?;
        let shear = self.shear.as_mut().expect("room for the shear was made with friction");
        match rubbing.verdict {
            // The narrowest stick zone looked for wants more friction than there is: all but it slides.
            Verdict::TooNarrow => shear.rescale(task.friction().copysign(friction)),
            Verdict::NoShear => {
                shear.rescale(0.0);
                shear.relocate(rubbing.zone);
            }
            _ => {}
        }
        Ok(())
    }

    /// Makes the shear under a flat punch as sure all along the stick zone settled as the tolerance asks, where the
    /// pressure is known to within `of_pressure`, see [`sharpen`]; its error, over its largest value. `coarser` is the
    /// resolution before.
    pub(crate) fn sharpen(
        &mut self,
        layer: &PreparedLayer,
        task: Task,
        outcome: &Outcome,
        of_pressure: f64,
        coarser: Option<&Self>,
    ) -> Result<Option<f64>, Refusal> {
        let is_solved =
            |rubbing: &&Rubbing| matches!(rubbing.verdict, Verdict::Holds | Verdict::Sticks | Verdict::Fails(_));
        let found = outcome.rubbing.as_ref().filter(is_solved).filter(|_| !task.problem.is_linear);
        let shear = self.shear.as_mut().filter(|shear| shear.is_solved);
        let Some((shear, found)) = shear.zip(found) else { return Ok(None) };
        let coarser = coarser.and_then(|coarser| coarser.shear.as_deref()).filter(|shear| shear.is_solved);
        let (beta, wanted) = (task.problem.elastic.beta(), (of_pressure, task.tolerance));
        sharpen((shear, coarser), layer, &mut self.normal, beta, found.zone, wanted)
    }

    /// What the shear solved last loses between its nodes, over the mean pressure.
    pub(crate) fn lost_of_shear(&self) -> f64 {
        self.shear.as_ref().map_or(0.0, |shear| shear.lost_between() / self.normal.mean().abs())
    }

    /// By how much the shear under a flat punch differs from that of a twin; `None` where one of them has none.
    pub(crate) fn shear_apart(&self, twin: &Self) -> Option<f64> {
        let both = self.shear.as_ref().zip(twin.shear.as_ref());
        let (own, other) = both.filter(|(own, other)| own.is_solved && other.is_solved)?;
        Some(apart_from_twin(own, other, &self.normal))
    }

    /// Where the shear solved last is more than a friction coefficient bears, though everything sticks.
    pub(crate) fn overload(&mut self, layer: &PreparedLayer, eta: f64) -> Option<String> {
        let (x, load) = checks::overload(layer, &self.normal, self.shear.as_deref()?, eta, self.of_slices)?;
        self.is_overloaded = true;
        (!self.of_slices).then(|| format!("where everything sticks {}", checks::overloaded(load, x)))
    }

    /// The condition of friction that the stick zone solved last fails, and where.
    fn violation(&mut self, layer: &PreparedLayer, problem: &Problem) -> Option<String> {
        let (normal, shear) = (&mut self.normal, self.shear.as_deref()?);
        let direction = if shear.friction < 0.0 { "outward" } else { "inward" };
        let zone = shear.zone.words();
        if let Some((x, load)) = checks::overload(layer, normal, shear, shear.friction.abs(), self.of_slices) {
            self.is_overloaded = true;
            if !self.of_slices {
                return Some(format!(
                    "with {direction} slip and {zone}, {} inside the stick zone",
                    checks::overloaded(load, x)
                ));
            }
        }
        let slip_check = self.slip_check.get_or_insert_default();
        slip_check.wrong_slip(layer, problem, normal, shear).map(|x| {
            format!("with {direction} slip and {zone}, the surface slides the other way at {}", checks::place(x))
        })
    }
}
