//! One scene at one resolution: pressure, stick zone, and the numbers reported.

use super::checks::{self, SlipCheck};
use super::contact_size::{self, Size};
use super::error_estimate::Seen;
use super::family::Family;
use super::growing::Growing;
use super::layer::{Layer, Wanted};
use super::linear_strain::RateCurve;
use super::normal::Normal;
use super::problem::{LoadInLayerUnits, Problem};
use super::quantity::{Numbers, Quantity, ShearTrace, Traces};
use super::sharpen::{apart_from_twin, sharpen};
use super::stick::Shear;
use super::stick_search::{Found, FrictionCurve, Root, Samples};
use super::stick_zone::StickZone;
use super::work::Work;
use arrayvec::ArrayVec;
use slipzone_api::{Edge, Quadrature, Refusal, Station};
use std::f64::consts::FRAC_PI_2;

/// Friction below this share of the coefficient at every stick zone is rounding: there is no shear.
const NO_SHEAR: f64 = 1e-10;
/// A stick zone whose widths change by less than this from one resolution to the next is known well enough to be
/// checked, and to have its shear told from the zone solved last.
const KNOWN: f64 = 1e-4;
/// Points at which a smooth pressure is compared before its peak is refined.
const PEAK_SAMPLES: usize = 24;

/// Rules, matrices and scratch of one resolution, reused from load to load.
pub(crate) struct Stage {
    pub(crate) normal: Normal,
    /// Under a flat punch with friction.
    pub(crate) shear: Option<Shear>,
    /// Of a contact that grows with the load.
    pub(crate) growing: Option<Box<Growing>>,
    slip_check: SlipCheck,
    /// Whether it solves slices of contacts that grow. Friction bears their sum: it need not bear each of them.
    pub(crate) of_slices: bool,
    /// Whether it does not bear one of those examined.
    pub(crate) is_overloaded: bool,
    /// The friction curve, and the half-width that it belongs to: it depends on no load.
    curve: Option<(f64, Samples)>,
    /// The stick zones found last, and the half-width and the friction coefficient that they belong to: they
    /// depend on no load either.
    rubbed: Option<(f64, f64, Rubbing)>,
    /// Half-width and force of the pressure that `shear` was shown last.
    shown: Option<(f64, f64)>,
    /// How wide the contact became under its load, where that was looked for.
    sized: Option<(LoadInLayerUnits, Size)>,
}

/// What one resolution found.
#[derive(Clone, Debug, Default)]
pub(crate) struct Outcome {
    /// The numbers reported, in layer units.
    pub(crate) numbers: Numbers,
    pub(crate) rubbing: Option<Rubbing>,
    pub(crate) size: Option<Size>,
    /// The pressure at [`Traces::AT`] over its mean.
    pressure: [f64; Traces::AT.len()],
    /// Of a contact that grew: what its stack loses, relative.
    pub(crate) lost: Option<f64>,
}

impl Outcome {
    /// Of a contact that grew; the pressure is that at [`Traces::AT`], over its mean.
    pub(crate) fn new(
        numbers: Numbers,
        rubbing: Option<Rubbing>,
        size: Option<Size>,
        pressure: [f64; Traces::AT.len()],
        lost: f64,
    ) -> Self {
        Self { numbers, rubbing, size, pressure, lost: Some(lost) }
    }

    /// An outcome of which only the stick zone is known.
    pub(crate) fn of_rubbing(rubbing: Rubbing) -> Self {
        Self::new(Numbers::default(), Some(rubbing), None, [0.0; Traces::AT.len()], 0.0)
    }

    /// What it tells of the next resolution.
    pub(crate) fn seen(&self) -> Seen {
        let shear = self.rubbing.as_ref().and_then(|rubbing| rubbing.shear);
        let traces = Traces { pressure: self.pressure, shear, is_stacked: self.lost.is_some() };
        let mut numbers = self.numbers;
        if self.rubbing.as_ref().is_some_and(|rubbing| rubbing.is_full) {
            // A zone that is all of the contact is no number that converges.
            for quantity in [Quantity::StickHalfWidth, Quantity::StickRatio, Quantity::OneMinusRatio] {
                numbers.take(quantity);
            }
        }
        Seen { numbers, traces }
    }
}

/// What friction makes of it.
#[derive(Clone, Debug)]
pub(crate) struct Rubbing {
    pub(crate) zone: StickZone,
    pub(crate) verdict: Verdict,
    /// Whether all of the contact sticks in it, but for less than can be told.
    pub(crate) is_full: bool,
    found: Found,
    /// Which of the roots is reported.
    chosen: usize,
    /// Whether the roots come from this resolution's own scan.
    scanned: bool,
    /// Whether the root reported is known to satisfy the conditions of friction.
    checked: bool,
    /// The shear over the mean pressure, where a stick zone was found.
    shear: Option<ShearTrace>,
}

/// Whether a stick zone was found, and whether it holds.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Verdict {
    /// A root; that both conditions of friction hold is checked when it is settled.
    Holds,
    /// Roots, but each fails a condition: what the one reported fails, and where.
    Fails(String),
    /// No root; the stick zone is narrower than what was looked for.
    TooNarrow,
    /// No root; the slip zone is narrower than what the resolution can tell.
    TooWide,
    /// No root, and every slip zone that can be told from none was looked at: everything sticks. The shear is that of the widest
    /// zone looked at.
    Sticks,
    /// No shear arises, whatever the zone: everything sticks without friction.
    NoShear,
    /// No root in between: the direction of slip changes along the contact.
    None,
}

/// What a stage needs to know beside its own scratch.
#[derive(Clone, Copy)]
pub(crate) struct Task<'a> {
    pub(crate) problem: &'a Problem,
    pub(crate) wanted: Wanted,
    pub(crate) tolerance: f64,
}

impl Stage {
    pub(crate) fn new(problem: &Problem, quadrature: Box<dyn Quadrature>) -> Result<Self, Refusal> {
        let edge = if problem.fixed_half_width().is_some() { Edge::Sharp } else { Edge::Smooth };
        let normal = Normal::new(quadrature.as_ref(), edge)?;
        let grows = problem.fixed_half_width().is_none();
        let growing = grows.then(|| Box::new(Growing::new(problem, quadrature.clone())));
        let shear = match problem.friction {
            // The kink of a strain `C|x|` is resolved late.
            Some(_) if problem.is_linear && !quadrature.is_pinned() => Some(Shear::new(quadrature.refined(1))?),
            Some(_) if !problem.is_stacked() => Some(Shear::new(quadrature)?),
            _ => None,
        };
        Ok(Self {
            normal,
            shear,
            growing,
            slip_check: SlipCheck::default(),
            of_slices: false,
            is_overloaded: false,
            curve: None,
            rubbed: None,
            shown: None,
            sized: None,
        })
    }

    /// Solves; `coarse` is what a coarser resolution found, and the flat punches it found it with.
    pub(crate) fn solve(
        &mut self,
        layer: &mut Layer,
        task: Task,
        coarse: Option<&Outcome>,
        family: Option<&Family>,
    ) -> Result<Outcome, Refusal> {
        let problem = task.problem;
        if let Some(growing) = self.growing.as_mut().filter(|growing| growing.is_solver) {
            return growing.solve(layer, task, &mut self.normal, coarse, family);
        }
        let size = if let Some(half_width) = problem.fixed_half_width() {
            layer.tabulate(Wanted { half_width, ..task.wanted })?;
            self.normal.press_sharp(layer, problem, half_width)?;
            None
        } else {
            let known = coarse.and_then(|coarse| coarse.size);
            Some(self.press_smooth(layer, task, known)?)
        };
        let rubbing = match problem.friction {
            Some(eta) if problem.is_linear => {
                Some(self.rub_linearly(layer, task, eta, coarse.and_then(|c| c.rubbing.as_ref()))?)
            }
            Some(eta) => Some(self.rub(layer, task, eta, coarse.and_then(|c| c.rubbing.as_ref()))?),
            None => None,
        };
        let mut outcome = self.outcome(layer, problem, size, rubbing);
        let rubbing = &outcome.rubbing;
        if problem.is_linear && rubbing.as_ref().is_some_and(|rubbing| rubbing.verdict == Verdict::Holds) {
            let rate = self.shear.as_ref().map_or(0.0, |shear| shear.strain_rate);
            outcome.numbers.set(Quantity::StrainRate, problem.elastic.a0() * rate);
        }
        Ok(outcome)
    }

    /// Solves the pressure of a contact that grows, from what is known of its size.
    fn press_smooth(&mut self, layer: &mut Layer, task: Task, known: Option<Size>) -> Result<Size, Refusal> {
        let size = contact_size::press(layer, task.problem, &mut self.normal, task.wanted, task.tolerance, known)?;
        self.sized = Some((task.problem.load, size));
        Ok(size)
    }

    /// What the pressure solved last tells, and the stick zone found for it.
    fn outcome(&mut self, layer: &Layer, problem: &Problem, size: Option<Size>, rubbing: Option<Rubbing>) -> Outcome {
        let mut numbers = normal_numbers(layer, problem, &mut self.normal);
        if let Some(rubbing) = &rubbing {
            rubbing.report(&mut numbers);
        }
        let mean = self.normal.mean();
        let mut pressure = [0.0; Traces::AT.len()];
        self.normal.values_into(&Traces::stations(self.normal.half_width), &mut pressure);
        Outcome { numbers, rubbing, size, pressure: pressure.map(|p| p / mean), lost: None }
    }

    /// Solves another load of a punch whose contact grows, no wider than the one given, from what is known of others and what a
    /// coarser resolution found; `None` where that is not enough.
    pub(crate) fn solve_again(
        &mut self,
        layer: &mut Layer,
        task: Task,
        widest: f64,
        coarse: Option<&Outcome>,
    ) -> Result<Option<Outcome>, Refusal> {
        let problem = task.problem;
        let known = coarse.and_then(|coarse| coarse.size);
        if let Some(growing) = self.growing.as_mut().filter(|growing| growing.is_solver) {
            return growing.solve_again(layer, task, &mut self.normal, known);
        }
        let known = known.or_else(|| self.sized.and_then(|(before, size)| size.under(before, problem.load)));
        let Some(known) = known.filter(|size| size.half_width <= widest && problem.friction.is_none()) else {
            return Ok(None);
        };
        let size = self.press_smooth(layer, task, Some(known))?;
        Ok(Some(self.outcome(layer, problem, Some(size), None)))
    }

    /// Pressure at points strictly inside the contact solved last.
    pub(crate) fn pressure_into(&mut self, problem: &Problem, at: &[Station], out: &mut [f64]) {
        match self.growing.as_mut().filter(|growing| growing.is_solver) {
            Some(growing) => growing.pressure_into(problem, &self.normal, at, out),
            None => self.normal.values_into(at, out),
        }
    }

    /// Shear at such points, where the pressures are `pressure`; `None` where there is none to tell.
    pub(crate) fn shear(&mut self, problem: &Problem, at: &[Station], pressure: &[f64]) -> Option<Vec<f64>> {
        match self.growing.as_mut().filter(|growing| growing.is_solver) {
            Some(growing) => growing.shear(problem, at, pressure),
            None => self.shear.as_ref().map(|shear| shear.values(at, pressure)),
        }
    }

    /// The strain left on the surface at points `x >= 0` of the stick zone; `None` where there is none to tell.
    pub(crate) fn strain(&mut self, layer: &Layer, problem: &Problem, at: &[f64]) -> Option<Vec<Option<f64>>> {
        match self.growing.as_mut().filter(|growing| growing.is_solver) {
            Some(growing) => growing.strain(layer, problem, &self.normal, at),
            // What sticks to a flat punch has never slipped.
            None => self.shear.as_ref().map(|shear| {
                let rate = problem.elastic.a0() * shear.strain_rate;
                at.iter().map(|x| Some(rate * x)).collect()
            }),
        }
    }

    /// Friction coefficient of the shear, negative where the slip is outward.
    pub(crate) fn signed_friction(&self) -> Option<f64> {
        match self.growing.as_ref().filter(|growing| growing.is_solver) {
            Some(growing) => growing.signed_friction(),
            None => self.shear.as_ref().map(|shear| shear.friction),
        }
    }

    /// Where the pressure of an outcome pulls, see [`checks::tension`].
    pub(crate) fn tension(&mut self, problem: &Problem, outcome: &Outcome) -> Option<(f64, f64)> {
        if self.growing.as_mut().is_some_and(|growing| growing.is_solver && growing.presses(problem)) {
            return None;
        }
        let (b, mean) = (outcome.numbers.get(Quantity::HalfWidth)?, outcome.numbers.get(Quantity::Mean)?);
        checks::tension(b, mean, |at, out| self.pressure_into(problem, at, out))
    }

    /// Whether friction cannot be told of a contact as it grew.
    pub(crate) fn is_broken(&self) -> bool {
        self.growing.as_ref().is_some_and(|growing| growing.is_broken())
    }

    /// Unknowns of the pressure.
    pub(crate) fn unknowns(&self) -> usize {
        self.normal.size()
    }

    /// Work in its systems so far.
    pub(crate) fn work(&self) -> Work {
        let of_shear = self.shear.as_ref().map_or(Work::default(), Shear::work);
        let of_members = self.growing.as_ref().map_or(Work::default(), |growing| growing.work());
        self.normal.work() + of_shear + of_members
    }

    /// The curve of friction coefficients over stick zones, and room for the shear.
    pub(crate) fn curve<'a>(&'a mut self, layer: &'a Layer, task: Task) -> FrictionCurve<'a> {
        FrictionCurve {
            layer,
            normal: &mut self.normal,
            shear: self.shear.as_mut().expect("room for the shear was made with friction"),
            beta: task.problem.elastic.beta(),
            tolerance: task.tolerance,
        }
    }

    /// Finds the stick zones: follows those of a coarser resolution, or looks for all.
    fn rub(&mut self, layer: &Layer, task: Task, eta: f64, coarse: Option<&Rubbing>) -> Result<Rubbing, Refusal> {
        let b = self.normal.half_width;
        if let Some((half_width, friction, rubbing)) = &self.rubbed
            && self.normal.is_flat
            && (half_width.to_bits(), friction.to_bits()) == (b.to_bits(), eta.to_bits())
        {
            return Ok(rubbing.clone());
        }
        let mut rubbing = self.find(layer, task, eta, coarse)?;
        if let Some(lambda) = rubbing.solved() {
            self.examine(layer, task, lambda, &mut rubbing, coarse.and_then(Rubbing::root))?;
        }
        self.rubbed = Some((b, eta, rubbing.clone()));
        Ok(rubbing)
    }

    /// Finds the stick zone in which the strain is `C|x|`: near that of a coarser resolution, or by a search.
    fn rub_linearly(
        &mut self,
        layer: &Layer,
        task: Task,
        eta: f64,
        coarse: Option<&Rubbing>,
    ) -> Result<Rubbing, Refusal> {
        self.refresh(layer);
        let b = self.normal.half_width;
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
                let Some((x, load)) = checks::overload(curve.normal, curve.shear, eta) else { return Ok(rubbing) };
                let what = format!("|q| reaches {load:.3} eta p at x = {x:.4} b inside the stick zone");
                failure = failure.or(Some(rubbing.failing(what)));
            }
        }
        let nothing = Root { lambda: -FrictionCurve::WIDEST, branch: 1.0, slope: f64::NAN, doubt: f64::NAN };
        let lost = || Rubbing { verdict: Verdict::None, ..Rubbing::expected(nothing, b, true) };
        Ok(failure.unwrap_or_else(lost))
    }

    /// Takes the shear's trace, and checks the conditions of friction as soon as the zone is known: resolutions that
    /// come after change it by less than the checks tell apart.
    fn examine(
        &mut self,
        layer: &Layer,
        task: Task,
        lambda: f64,
        rubbing: &mut Rubbing,
        before: Option<f64>,
    ) -> Result<(), Refusal> {
        self.curve(layer, task).at_or_near(lambda, KNOWN)?;
        let shear = self.shear.as_ref().expect("room for the shear was made with friction");
        rubbing.shear = Some(shear.trace(self.normal.mean()));
        if let Some(before) = before.filter(|_| !rubbing.checked) {
            rubbing.checked = self.holds(layer, task, before, lambda)?;
        }
        Ok(())
    }

    /// Whether a stick zone was nearly known before, and both conditions of friction hold in it.
    pub(crate) fn holds(&mut self, layer: &Layer, task: Task, before: f64, lambda: f64) -> Result<bool, Refusal> {
        if (before - lambda).abs() >= KNOWN {
            return Ok(false);
        }
        self.curve(layer, task).at_or_near(lambda, KNOWN)?;
        Ok(self.violation(layer, task.problem).is_none())
    }

    /// Shows the present pressure to the shear. Under a flat punch both grow with the force.
    fn refresh(&mut self, layer: &Layer) {
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
    fn find(&mut self, layer: &Layer, task: Task, eta: f64, coarse: Option<&Rubbing>) -> Result<Rubbing, Refusal> {
        if coarse.is_some_and(|coarse| coarse.verdict == Verdict::Sticks)
            && let (lambda, least) = self.stick(layer, task)?
            && least.abs() < eta
        {
            return Ok(Rubbing::sticking(self.normal.half_width, lambda, false));
        }
        self.refresh(layer);
        let known = coarse.filter(|coarse| !coarse.found.roots.is_empty());
        match known.map(|coarse| self.followed(layer, task, eta, coarse)).transpose()?.flatten() {
            Some(rubbing) => Ok(rubbing),
            None => self.scan(layer, task, eta),
        }
    }

    /// The widest stick zone that this resolution can tell from all of the contact, and the friction coefficient that belongs to it, with
    /// the sign of the shear there: everything sticks with more. Leaves the shear.
    pub(crate) fn stick(&mut self, layer: &Layer, task: Task) -> Result<(f64, f64), Refusal> {
        self.refresh(layer);
        let mut curve = self.curve(layer, task);
        let widest = curve.widest();
        Ok((widest, curve.at(widest)?))
    }

    /// Stick zones known roughly, found at this resolution to the tolerance; `None` where the one reported is lost.
    fn followed(&mut self, layer: &Layer, task: Task, eta: f64, known: &Rubbing) -> Result<Option<Rubbing>, Refusal> {
        let mut curve = self.curve(layer, task);
        let mut found = Found { roots: ArrayVec::new(), ..known.found.clone() };
        let mut chosen = None;
        for (i, root) in known.found.roots.iter().enumerate() {
            if let Some(root) = curve.follow(*root, eta)? {
                if i == known.chosen {
                    chosen = Some(found.roots.len());
                }
                found.roots.push(root);
            }
        }
        let Some(chosen) = chosen else { return Ok(None) };
        let zone = StickZone::from_log(found.roots[chosen].lambda, self.normal.half_width);
        let checked = known.checked;
        let (verdict, is_full) = (Verdict::Holds, false);
        Ok(Some(Rubbing { zone, verdict, is_full, found, chosen, scanned: false, checked, shear: None }))
    }

    /// Looks for all stick zones, and for the first that holds where there are several.
    fn scan(&mut self, layer: &Layer, task: Task, eta: f64) -> Result<Rubbing, Refusal> {
        let b = self.normal.half_width;
        let samples = match self.curve.take() {
            Some((half_width, samples)) if half_width.to_bits() == b.to_bits() => samples,
            _ => self.curve(layer, task).sample()?,
        };
        let mut curve = self.curve(layer, task);
        let (found, sees_all) = (curve.roots(eta, &samples)?, curve.sees_all());
        self.curve = Some((b, samples));
        let curve = self.curve(layer, task);
        let (lambda, verdict) = match found.roots.first() {
            Some(root) => (root.lambda, Verdict::Holds),
            None if found.largest < NO_SHEAR * eta => (0.0, Verdict::NoShear),
            None if found.narrower => (-FrictionCurve::WIDEST, Verdict::TooNarrow),
            None if found.wider && sees_all => (curve.widest(), Verdict::Sticks),
            None if found.wider => (curve.widest(), Verdict::TooWide),
            None => (-FrictionCurve::WIDEST, Verdict::None),
        };
        let zone = match verdict {
            Verdict::NoShear => StickZone { half_width: b, slip_width: 0.0 },
            _ => StickZone::from_log(lambda, b),
        };
        let is_full = verdict == Verdict::Sticks;
        let mut rubbing =
            Rubbing { zone, verdict, is_full, found, chosen: 0, scanned: true, checked: false, shear: None };
        if rubbing.found.roots.len() > 1 {
            self.choose(layer, task, &mut rubbing)?;
        }
        Ok(rubbing)
    }

    /// Chooses the first root that satisfies both conditions of friction, if any does; leaves its shear.
    fn choose(&mut self, layer: &Layer, task: Task, rubbing: &mut Rubbing) -> Result<(), Refusal> {
        let b = self.normal.half_width;
        let mut failure = None;
        let first = rubbing.chosen;
        let others = (0..rubbing.found.roots.len()).filter(|i| *i != first);
        for i in [first].into_iter().chain(others) {
            let lambda = rubbing.found.roots[i].lambda;
            self.curve(layer, task).at_or_near(lambda, task.tolerance)?;
            let known = rubbing.checked && i == first;
            match if known { None } else { self.violation(layer, task.problem) } {
                None => {
                    rubbing.chosen = i;
                    rubbing.checked = true;
                    rubbing.zone = StickZone::from_log(lambda, b);
                    rubbing.verdict = Verdict::Holds;
                    return Ok(());
                }
                Some(what) => failure = failure.or(Some(what)),
            }
        }
        if let Some(what) = failure {
            rubbing.verdict = Verdict::Fails(what);
        }
        Ok(())
    }

    /// The pressure under a flat punch.
    pub(crate) fn press(&mut self, layer: &mut Layer, task: Task, half_width: f64) -> Result<(), Refusal> {
        layer.tabulate(Wanted { half_width, ..task.wanted })?;
        self.normal.press_sharp(layer, task.problem, half_width)
    }

    /// The stick zone under a flat punch from a guess, to within an error; its shear is left in `shear`. `None` where the
    /// guess was not near.
    pub(crate) fn follow(
        &mut self,
        layer: &mut Layer,
        task: Task,
        half_width: f64,
        guess: Root,
        error: f64,
    ) -> Result<Option<Root>, Refusal> {
        const STEPS: usize = 6;
        const WIDEST: f64 = 0.3;
        self.press(layer, task, half_width)?;
        self.refresh(layer);
        let target = guess.branch * task.problem.friction.unwrap_or(0.0);
        let mut curve = self.curve(layer, task);
        let (widest, Root { mut lambda, mut slope, .. }) = (curve.widest(), guess);
        let mut value = curve.at(lambda)?;
        for _ in 0..STEPS {
            let step = (target - value) / slope;
            if step.abs() < error {
                return Ok(Some(Root { lambda: lambda + step, slope, ..guess }));
            }
            if step.is_nan() || step.abs() > WIDEST || lambda + step > widest {
                return Ok(None);
            }
            let next = curve.at(lambda + step)?;
            let measured = (next - value) / step;
            // Differences of rounding have no slope; one of another sign is no neighbour's.
            if step.abs() > f64::EPSILON.sqrt() && measured * slope > 0.0 {
                slope = measured;
            }
            (lambda, value) = (lambda + step, next);
        }
        Ok(None)
    }

    /// Leaves the shear of the stick zone reported in `shear`, and checks it. Returns whether another zone than
    /// before is reported.
    pub(crate) fn settle(&mut self, layer: &mut Layer, task: Task, outcome: &mut Outcome) -> Result<bool, Refusal> {
        if let Some(growing) = self.growing.as_mut().filter(|growing| growing.is_solver) {
            growing.settle(layer, task, outcome)?;
            return Ok(false);
        }
        if task.problem.is_linear {
            return Ok(false); // each is checked when it is found
        }
        let (Some(rubbing), Some(eta)) = (&mut outcome.rubbing, task.problem.friction) else { return Ok(false) };
        self.refresh(layer);
        if !rubbing.found.roots.is_empty() {
            let before = rubbing.zone;
            self.choose(layer, task, rubbing)?;
            if rubbing.verdict != Verdict::Holds && !rubbing.scanned {
                // This resolution may see what the one that was scanned did not.
                let again = self.scan(layer, task, eta)?;
                if let Some(again) = self.followed(layer, task, eta, &again)? {
                    *rubbing = Rubbing { scanned: true, ..again };
                    self.choose(layer, task, rubbing)?;
                }
            }
            if matches!(rubbing.verdict, Verdict::Fails(_)) {
                let lambda = rubbing.found.roots[rubbing.chosen].lambda;
                self.curve(layer, task).at(lambda)?;
            }
            let changed = (rubbing.zone.ratio() / before.ratio() - 1.0).abs() > 0.1
                || (rubbing.zone.one_minus_ratio() / before.one_minus_ratio() - 1.0).abs() > 0.1;
            rubbing.report(&mut outcome.numbers);
            return Ok(changed);
        }
        let lambda = rubbing.zone.log();
        if rubbing.verdict == Verdict::Sticks {
            self.curve(layer, task).at_or_near(lambda, KNOWN)?;
            if let Some(what) = self.overload(eta) {
                rubbing.verdict = Verdict::Fails(what);
            }
            return Ok(false);
        }
        let finite = lambda.clamp(-FrictionCurve::WIDEST, FrictionCurve::WIDEST);
        let friction = self.curve(layer, task).at(finite)?;
        let shear = self.shear.as_mut().expect("room for the shear was made with friction");
        let sliding = eta.copysign(friction);
        match rubbing.verdict {
            // The narrowest stick zone looked for wants more friction than there is: all but it slides.
            Verdict::TooNarrow => shear.rescale(sliding),
            // The widest one needs less; what slips beyond it slides at the limit all the same.
            Verdict::TooWide => shear.slide_at(sliding),
            Verdict::NoShear => {
                shear.rescale(0.0);
                shear.relocate(rubbing.zone);
            }
            _ => {}
        }
        Ok(false)
    }

    /// Makes the shear under a flat punch as sure all along the stick zone settled as the tolerance asks, where the pressure is known to
    /// within `of_pressure`, see [`sharpen`]; its error, over its largest value.
    pub(crate) fn sharpen(
        &mut self,
        layer: &Layer,
        task: Task,
        outcome: &Outcome,
        of_pressure: f64,
    ) -> Result<Option<f64>, Refusal> {
        let is_solved =
            |rubbing: &&Rubbing| matches!(rubbing.verdict, Verdict::Holds | Verdict::Sticks | Verdict::Fails(_));
        let found = outcome.rubbing.as_ref().filter(is_solved).filter(|_| !task.problem.is_linear);
        let shear = self.shear.as_mut().filter(|shear| shear.is_solved);
        let Some((shear, found)) = shear.zip(found) else { return Ok(None) };
        sharpen(shear, layer, &mut self.normal, task.problem.elastic.beta(), found.zone, (of_pressure, task.tolerance))
    }

    /// By how much the shear under a flat punch differs from that of a twin; `None` where one of them has none.
    pub(crate) fn shear_apart(&self, twin: &Self) -> Option<f64> {
        let both = self.shear.as_ref().zip(twin.shear.as_ref());
        let (own, other) = both.filter(|(own, other)| own.is_solved && other.is_solved)?;
        Some(apart_from_twin(own, other, &self.normal))
    }

    /// Where the shear solved last is more than a friction coefficient bears, though everything sticks.
    pub(crate) fn overload(&mut self, eta: f64) -> Option<String> {
        let (x, load) = checks::overload(&self.normal, self.shear.as_ref()?, eta)?;
        self.is_overloaded = true;
        (!self.of_slices).then(|| format!("where everything sticks |q| reaches {load:.3} eta p at x = {x:.4} b"))
    }

    /// The condition of friction that the stick zone solved last fails, and where.
    fn violation(&mut self, layer: &Layer, problem: &Problem) -> Option<String> {
        let (normal, shear) = (&mut self.normal, self.shear.as_ref()?);
        let direction = if shear.friction < 0.0 { "outward" } else { "inward" };
        let ratio = shear.zone.ratio();
        if let Some((x, load)) = checks::overload(normal, shear, shear.friction.abs()) {
            self.is_overloaded = true;
            if !self.of_slices {
                return Some(format!(
                    "with {direction} slip and a/b = {ratio:.6}, |q| reaches {load:.3} eta p at x = {x:.4} b inside \
                     the stick zone"
                ));
            }
        }
        self.slip_check.wrong_slip(layer, problem, normal, shear).map(|x| {
            format!("with {direction} slip and a/b = {ratio:.6}, the surface slides the other way at x = {x:.4} b")
        })
    }
}

impl Rubbing {
    /// A stick zone told by a coarser resolution.
    pub(crate) fn expected(root: Root, half_width: f64, checked: bool) -> Self {
        Self {
            zone: StickZone::from_log(root.lambda, half_width),
            verdict: Verdict::Holds,
            is_full: false,
            found: Found::only(root),
            chosen: 0,
            scanned: false,
            checked,
            shear: None,
        }
    }

    /// Everything sticks, but for less than can be told beside that zone.
    pub(crate) fn sticking(half_width: f64, lambda: f64, checked: bool) -> Self {
        let zone = StickZone::from_log(lambda, half_width);
        let (verdict, is_full) = (Verdict::Sticks, true);
        Self { zone, verdict, is_full, found: Found::default(), chosen: 0, scanned: false, checked, shear: None }
    }

    /// The root reported, where there is one that may hold.
    pub(crate) fn reported(&self) -> Option<Root> {
        (self.verdict == Verdict::Holds).then(|| self.found.roots[self.chosen])
    }

    /// `lambda` of the zone whose shear is that of the contact.
    fn solved(&self) -> Option<f64> {
        if self.is_full { Some(self.zone.log()) } else { self.root() }
    }

    /// `lambda` of that root.
    fn root(&self) -> Option<f64> {
        self.reported().map(|root| root.lambda)
    }

    /// Whether the root reported is known to satisfy the conditions of friction.
    pub(crate) fn is_checked(&self) -> bool {
        self.checked
    }

    /// A stick zone of which no more is told than that it is at least as wide, in a contact of that half-width.
    pub(crate) fn bounded(self, half_width: f64) -> Self {
        let zone = StickZone::from_log(self.zone.log(), half_width);
        Self { zone, verdict: Verdict::TooWide, is_full: false, ..self }
    }

    /// The condition that it fails.
    pub(crate) fn failure(&self) -> Option<&str> {
        if let Verdict::Fails(what) = &self.verdict { Some(what) } else { None }
    }

    /// The same, found to fail a condition.
    pub(crate) fn failing(self, what: String) -> Self {
        Self { verdict: Verdict::Fails(what), ..self }
    }

    /// The same with what tells its shear from that of other resolutions, see [`Traces`].
    pub(crate) fn traced(self, shear: ShearTrace) -> Self {
        Self { shear: Some(shear), ..self }
    }

    /// Adds the zone to the numbers reported, all of the contact where everything sticks.
    pub(crate) fn report(&self, numbers: &mut Numbers) {
        let zone = if self.is_full { self.zone.widened() } else { self.zone };
        numbers.set(Quantity::StickHalfWidth, zone.half_width);
        numbers.set(Quantity::StickRatio, zone.ratio());
        numbers.set(Quantity::OneMinusRatio, zone.one_minus_ratio());
    }
}

/// The numbers of the pressure alone.
pub(crate) fn normal_numbers(layer: &Layer, problem: &Problem, normal: &mut Normal) -> Numbers {
    let mut numbers = Numbers::default();
    let depth = if problem.wants_depth() { normal.depth(layer, problem) } else { None };
    let b = normal.half_width;
    numbers.set(Quantity::Force, normal.force);
    numbers.set(Quantity::HalfWidth, b);
    if problem.wishes.judges(Quantity::Centre) {
        numbers.set(Quantity::Centre, normal.at(Station { x: 0.0, gap: b }));
    }
    numbers.set(Quantity::Mean, normal.mean());
    numbers.set(Quantity::StressIntensity, normal.edge_factor / b.sqrt());
    numbers.set(Quantity::EdgeRatio, normal.edge_factor / normal.force);
    if let Some(depth) = depth {
        numbers.set(Quantity::Indentation, depth);
    }
    if problem.wishes.reports(Quantity::Peak) && !normal.is_sharp() {
        numbers.set(Quantity::Peak, peak(b, |at, out| normal.values_into(at, out)));
    }
    numbers
}

/// The largest pressure under a punch whose contact ends smoothly, from the pressures at points inside it.
///
/// It is looked for along the angle whose sine is `x/b`: shapes of high powers press near the edge, on a stretch that
/// is a few steps wide there.
pub(crate) fn peak(b: f64, mut pressure: impl FnMut(&[Station], &mut [f64])) -> f64 {
    let mut step = FRAC_PI_2 / PEAK_SAMPLES as f64;
    let station = |angle: f64| {
        let half = (0.5 * (FRAC_PI_2 - angle)).sin();
        Station { x: b * angle.sin(), gap: 2.0 * b * half * half }
    };
    let mut samples = [0.0; PEAK_SAMPLES];
    let stations: [Station; PEAK_SAMPLES] = std::array::from_fn(|i| station(i as f64 * step));
    pressure(&stations, &mut samples);
    let mut at = |angle: f64| {
        let mut p = [0.0];
        pressure(&[station(angle)], &mut p);
        p[0]
    };
    let (top, mut highest) =
        samples.iter().copied().enumerate().fold((0, samples[0]), |top, next| if next.1 > top.1 { next } else { top });
    if top == 0 || top == PEAK_SAMPLES - 1 {
        return highest;
    }
    // Vertices of parabolas through three points that close in.
    let mut angle = top as f64 * step;
    for _ in 0..3 {
        let (left, middle, right) = (at(angle - step), at(angle), at(angle + step));
        let bend = 2.0 * middle - left - right;
        if bend <= 0.0 {
            break;
        }
        let shift = 0.5 * (right - left) / bend;
        angle += step * shift.clamp(-1.0, 1.0);
        step *= 0.1;
        highest = highest.max(at(angle));
    }
    highest
}
