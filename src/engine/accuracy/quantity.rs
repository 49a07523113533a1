//! The numbers that a result reports and that errors are estimated for.

use crate::scene::Scene;
use slipzone_api::Station;

/// A reported number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Quantity {
    Force,
    HalfWidth,
    Indentation,
    Centre,
    Mean,
    Peak,
    StressIntensity,
    EdgeRatio,
    StickHalfWidth,
    StickRatio,
    OneMinusRatio,
    StrainRate,
    /// The shear all along the contact: it has an error, over its largest value, and no value of its own.
    Shear,
}

impl Quantity {
    pub(crate) const ALL: [Self; 13] = [
        Self::Force,
        Self::HalfWidth,
        Self::Indentation,
        Self::Centre,
        Self::Mean,
        Self::Peak,
        Self::StressIntensity,
        Self::EdgeRatio,
        Self::StickHalfWidth,
        Self::StickRatio,
        Self::OneMinusRatio,
        Self::StrainRate,
        Self::Shear,
    ];

    /// Whether it tells of the shear, and not of the pressure alone.
    pub(crate) fn is_of_shear(self) -> bool {
        matches!(self, Self::StickHalfWidth | Self::StickRatio | Self::OneMinusRatio | Self::StrainRate | Self::Shear)
    }

    /// Its path in the result.
    pub(crate) fn path(self) -> &'static str {
        match self {
            Self::Force => "load.force",
            Self::HalfWidth => "load.half_width",
            Self::Indentation => "load.indentation",
            Self::Centre => "pressure.centre",
            Self::Mean => "pressure.mean",
            Self::Peak => "pressure.peak",
            Self::StressIntensity => "edge.stress_intensity",
            Self::EdgeRatio => "edge.ratio",
            Self::StickHalfWidth => "stick.half_width",
            Self::StickRatio => "stick.ratio",
            Self::OneMinusRatio => "stick.one_minus_ratio",
            Self::StrainRate => "stick.strain_rate",
            Self::Shear => "profile.shear",
        }
    }
}

/// What a scene asks for: nothing else is computed that costs anything.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wishes {
    /// Numbers that are reported, each with its error.
    reported: [bool; Quantity::ALL.len()],
    /// Whether the tractions are sampled: they are known as well as the numbers that they are judged by.
    pub(crate) profile: bool,
    /// How close to the edge the closest sample inside is, over the half-width.
    pub(crate) nearest: f64,
    /// Whether a loading curve is asked for, which has a force and a half-width at every point.
    curve: bool,
}

impl Wishes {
    pub(crate) fn of(scene: &Scene) -> Self {
        let reported = Quantity::ALL.map(|quantity| scene.output.asks(quantity.path()));
        let profile = scene.output.asks("profile");
        Self { reported, profile, nearest: scene.output.nearest(), curve: scene.path.is_some() }
    }

    /// Of a flat punch in a stack: its tractions, and its depth where that of the contact is wanted.
    pub(crate) fn of_member(self, deep: bool) -> Self {
        let mut reported = [true; Quantity::ALL.len()];
        reported[Quantity::Indentation as usize] = deep;
        Self { reported, ..self }
    }

    /// The same where a loading curve is taken.
    pub(crate) fn along_curve(self) -> Self {
        Self { curve: true, ..self }
    }

    /// Whether a number is reported.
    pub(crate) fn reports(self, quantity: Quantity) -> bool {
        self.reported[quantity as usize]
    }

    /// Whether the error of a number has to meet the tolerance. That of the shear is told beside these.
    pub(crate) fn judges(self, quantity: Quantity) -> bool {
        let by_profile = !matches!(quantity, Quantity::Indentation | Quantity::Peak | Quantity::StrainRate);
        let on_curve = matches!(quantity, Quantity::Force | Quantity::HalfWidth);
        let asked = self.reports(quantity) || self.profile && by_profile || self.curve && on_curve;
        asked && quantity != Quantity::Shear
    }
}

/// One number for each quantity that a scene has: values in layer units, or their relative errors.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Numbers {
    /// Zero for what the scene has not.
    values: [f64; Quantity::ALL.len()],
    /// A bit for each that it has.
    known: u16,
}

impl Numbers {
    pub(crate) fn get(&self, quantity: Quantity) -> Option<f64> {
        (self.known >> quantity as usize & 1 == 1).then(|| self.values[quantity as usize])
    }

    pub(crate) fn set(&mut self, quantity: Quantity, value: f64) {
        self.values[quantity as usize] = value;
        self.known |= 1 << quantity as usize;
    }

    /// Adds to a number, where there is one.
    pub(crate) fn add(&mut self, quantity: Quantity, more: f64) {
        if let Some(number) = self.get(quantity) {
            self.set(quantity, number + more);
        }
    }

    /// Each of those that there are, and `share` more.
    pub(crate) fn plus(self, share: f64) -> Self {
        self.map(|number| number + share)
    }

    /// Errors of which one that is not finite, as of a difference of infinite numbers, is 1: it tells nothing.
    pub(crate) fn telling(self) -> Self {
        self.map(|error| if error.is_finite() { error } else { 1.0 })
    }

    /// Something else in the place of each of those that there are.
    fn map(mut self, other: impl Fn(f64) -> f64) -> Self {
        let each = self;
        each.iter().for_each(|(quantity, number)| self.set(quantity, other(number)));
        self
    }

    /// Each of those that there are, and what `more` has for it.
    pub(crate) fn and(mut self, more: &Self) -> Self {
        more.iter().for_each(|(quantity, more)| self.add(quantity, more));
        self
    }

    /// The largest relative change from others to these.
    pub(crate) fn change_from(&self, others: &Self) -> f64 {
        let change = |(quantity, value): (Quantity, f64)| Some((others.get(quantity)? / value - 1.0).abs());
        self.iter().filter_map(change).fold(0.0, f64::max)
    }

    /// Takes one out.
    pub(crate) fn take(&mut self, quantity: Quantity) -> Option<f64> {
        let number = self.get(quantity);
        self.values[quantity as usize] = 0.0;
        self.known &= !(1 << quantity as usize);
        number
    }

    /// Those that are to meet the tolerance.
    pub(crate) fn judged_by(&self, wishes: Wishes) -> Self {
        let mut judged = *self;
        for (quantity, _) in self.iter().filter(|(quantity, _)| !wishes.judges(*quantity)) {
            judged.take(quantity);
        }
        judged
    }

    /// Those that there are.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (Quantity, f64)> + '_ {
        let mut left = self.known;
        std::iter::from_fn(move || {
            let quantity = *Quantity::ALL.get(left.trailing_zeros() as usize)?;
            left &= left - 1;
            Some((quantity, self.values[quantity as usize]))
        })
    }

    /// The largest, and whose it is.
    pub(crate) fn worst(&self) -> Option<(Quantity, f64)> {
        self.iter().reduce(|worst, next| if next.1 > worst.1 { next } else { worst })
    }
}

/// Tractions at a few points, over the mean pressure. One number may converge by chance for a while, a whole traction
/// does not: they tell how fast a sequence of resolutions converges.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Traces {
    pub(crate) pressure: [f64; Self::AT.len()],
    /// Where a stick zone was found.
    pub(crate) shear: Option<ShearTrace>,
    /// Whether the shear is stacked: no more is known of it than these traces tell.
    pub(crate) is_stacked: bool,
}

/// The shear at points of the stick zone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ShearTrace {
    /// At [`Traces::AT`] and at the end; of a contact that grew what it lacks to that of full sliding, at points of its
    /// own.
    pub(crate) at: [f64; Self::POINTS],
    /// At [`Self::NEAR_MIDDLE`], where shears come late there.
    pub(crate) inner: [f64; Self::INNER],
    /// The largest of `at`.
    pub(crate) scale: f64,
    /// The largest shear there: what errors of the shear are relative to. No less than [`Self::least`].
    pub(crate) largest: f64,
    /// The friction coefficient, with the sign of the shear.
    pub(crate) friction: f64,
    /// That of what slides to which it is told what the shear lacks: none where everything sticks.
    pub(crate) sliding: f64,
    /// What the widest flat punch of a contact that grew loses between its nodes, over its mean pressure.
    pub(crate) lost: f64,
}

impl ShearTrace {
    /// How many there are.
    pub(crate) const POINTS: usize = Traces::AT.len() + 1;
    pub(crate) const INNER: usize = 3;
    /// Where else, over the half-width of the stick zone, shears are compared that are stacked or have a kink of strain
    /// in the middle: at one point alone they may agree by chance.
    pub(crate) const NEAR_MIDDLE: [f64; Self::INNER] = [0.01, 0.025, 0.1];
    /// A shear that is less than this share of sliding friction under the mean pressure, with a coefficient of 1 at
    /// most, is none to speak of.
    const LEAST: f64 = 1e-2;

    /// The least that errors of the shear are relative to, over the mean pressure.
    pub(crate) fn least(friction: f64) -> f64 {
        Self::LEAST * friction.abs().min(1.0)
    }

    /// What slides under the mean pressure, as far as the shear is told by what it lacks of that, over the largest
    /// shear.
    pub(crate) fn of_sliding(&self) -> f64 {
        self.sliding.abs() / self.largest
    }

    /// That loss over the largest shear.
    ///
    /// Narrower punches lose as much, elsewhere: stacked, less is lost than by any of them.
    pub(crate) fn lost_between(&self) -> f64 {
        self.lost / self.largest
    }

    /// Of a traction over the mean pressure, its shear at those points, and the friction coefficient.
    pub(crate) fn new(at: [f64; Self::POINTS], shear: [f64; Self::POINTS], friction: f64) -> Self {
        let largest = |numbers: &[f64], least: f64| numbers.iter().fold(least, |most, q| most.max(q.abs()));
        Self {
            at,
            inner: [0.0; Self::INNER],
            scale: largest(&at, 0.0),
            largest: largest(&shear, Self::least(friction)),
            friction,
            sliding: friction,
            lost: 0.0,
        }
    }
}

impl Traces {
    /// Where they are taken, over the half-width of the contact or of the stick zone.
    pub(crate) const AT: [f64; 3] = [0.3, 0.6, 0.9];

    /// Those points of a zone.
    pub(crate) fn stations(half_width: f64) -> [Station; Self::AT.len()] {
        Self::AT.map(|t| Station { x: t * half_width, gap: (1.0 - t) * half_width })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_quantity_has_its_place() {
        for (place, quantity) in Quantity::ALL.into_iter().enumerate() {
            assert_eq!(quantity as usize, place);
        }
        let mut numbers = Numbers::default();
        assert_eq!(numbers.worst(), None);
        numbers.set(Quantity::Centre, 2.0);
        numbers.set(Quantity::Mean, 1.0);
        assert_eq!(numbers.worst(), Some((Quantity::Centre, 2.0)));
        assert_eq!((numbers.get(Quantity::Mean), numbers.get(Quantity::Peak)), (Some(1.0), None));
    }
}
