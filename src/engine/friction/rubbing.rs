//! What friction makes of a contact at one resolution.

use super::stick_search::{Found, FrictionCurve, Root};
use super::stick_zone::StickZone;
use crate::engine::accuracy::quantity::{Numbers, Quantity, ShearTrace};

/// What friction makes of it.
#[derive(Clone, Debug)]
pub(crate) struct Rubbing {
    pub(crate) zone: StickZone,
    pub(crate) verdict: Verdict,
    /// Whether all of the contact sticks in it, but for less than can be told.
    pub(crate) is_full: bool,
    pub(crate) found: Found,
    /// Which of the roots is reported.
    pub(crate) chosen: usize,
    /// Whether a resolution that knew the zone has looked for all roots again.
    pub(crate) scanned: bool,
    /// Whether the root reported is known to satisfy the conditions of friction.
    pub(crate) checked: bool,
    /// The shear over the mean pressure, where a stick zone was found.
    pub(crate) shear: Option<ShearTrace>,
}

/// Whether a stick zone was found, and whether it holds.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Verdict {
    /// A root; that both conditions of friction hold is checked when it is settled.
    Holds,
    /// Roots, but each fails a condition: what the one reported fails, and where.
    Fails(String),
    /// It may hold: what keeps that from being told.
    Untold(String),
    /// It may well hold, but the contact grew in a way that is not solved: how.
    Unbuilt(String),
    /// No root; the stick zone is narrower than what was looked for.
    TooNarrow,
    /// No root; the slip zone is narrower than any that is looked for: everything sticks. The shear is that of the
    /// widest zone looked for.
    Sticks,
    /// No shear arises, whatever the zone: everything sticks without friction.
    NoShear,
    /// No root in between: the direction of slip changes along the contact.
    NoRoot,
    /// No root in the range that is looked at under a linear strain.
    NotScanned,
}

impl Rubbing {
    /// What a search found, the first root reported where there are some; nothing of it is checked yet.
    pub(crate) fn new(zone: StickZone, verdict: Verdict, found: Found) -> Self {
        let is_full = verdict == Verdict::Sticks;
        Self { zone, verdict, is_full, found, chosen: 0, scanned: false, checked: false, shear: None }
    }

    /// A stick zone told by a coarser resolution.
    pub(crate) fn expected(root: Root, half_width: f64, checked: bool) -> Self {
        let zone = StickZone::from_log(root.lambda, half_width);
        Self { checked, ..Self::new(zone, Verdict::Holds, Found::only(root)) }
    }

    /// Everything sticks, but for less than can be told beside the widest zone that is looked for.
    pub(crate) fn sticking(half_width: f64, checked: bool) -> Self {
        let zone = StickZone::from_log(FrictionCurve::WIDEST, half_width);
        Self { checked, ..Self::new(zone, Verdict::Sticks, Found::default()) }
    }

    /// The root reported, where there is one that may hold.
    pub(crate) fn reported(&self) -> Option<Root> {
        (self.verdict == Verdict::Holds).then(|| self.found.roots[self.chosen])
    }

    /// `lambda` of the zone whose shear is that of the contact.
    pub(crate) fn solved(&self) -> Option<f64> {
        if self.is_full { Some(self.zone.log()) } else { self.root() }
    }

    /// `lambda` of that root.
    pub(crate) fn root(&self) -> Option<f64> {
        self.reported().map(|root| root.lambda)
    }

    /// The condition that it fails, or why nothing can be told of it.
    pub(crate) fn failure(&self) -> Option<&str> {
        match &self.verdict {
            Verdict::Fails(what) | Verdict::Untold(what) | Verdict::Unbuilt(what) => Some(what),
            _ => None,
        }
    }

    /// The same, found to fail a condition.
    pub(crate) fn failing(self, what: String) -> Self {
        Self { verdict: Verdict::Fails(what), ..self }
    }

    /// The same, of which nothing can be told.
    pub(crate) fn untold(self, why: String) -> Self {
        Self { verdict: Verdict::Untold(why), ..self }
    }

    /// The same, of a contact that grew in a way that is not solved.
    pub(crate) fn unbuilt(self, how: String) -> Self {
        Self { verdict: Verdict::Unbuilt(how), ..self }
    }

    /// The same with what tells its shear from that of other resolutions, see [`Traces`].
    pub(crate) fn traced(self, shear: ShearTrace) -> Self {
        Self { shear: Some(shear), ..self }
    }

    /// Whether there is a zone to report: one that was found, holds or not, or a bound of it.
    pub(crate) fn has_zone(&self) -> bool {
        !matches!(self.verdict, Verdict::NoRoot | Verdict::NotScanned)
    }

    /// The zone to report: all of the contact where everything sticks.
    pub(crate) fn reported_zone(&self) -> StickZone {
        if self.is_full { self.zone.widened() } else { self.zone }
    }

    /// Adds it to the numbers reported.
    pub(crate) fn report(&self, numbers: &mut Numbers) {
        let zone = self.reported_zone();
        numbers.set(Quantity::StickHalfWidth, zone.half_width);
        numbers.set(Quantity::StickRatio, zone.ratio());
        numbers.set(Quantity::OneMinusRatio, zone.one_minus_ratio());
    }
}
