//! How well a series over the half-width tells what is between its members, and how many it takes.

/// Series fall off with at least this power of their members.
const ORDER: f64 = 8.0;
/// The root of what is left too much by which members are added: nothing is as slow as that, and the resolutions that
/// come add what is still missing.
///
/// Measured on 180 random contacts at 1e-8 and 1e-10: with 18 a tenth more work, with 32 less on most of them, but up
/// to six times on a few, and shears off by up to 14 estimates.
const GROWTH: f64 = 24.0;
/// A series leaves no more than so many times its last coefficient.
///
/// Measured on stick zones: a thirtieth of it on a layer five times as thick as the contact is wide, 10 to 80 times it
/// on layers a tenth or ten times as stiff above as below, which are as thick as the contact is wide.
const BESIDE_LAST: f64 = 100.0;
/// Members over those of the coarsest resolution: beside these they show what that left.
const COMPARED: f64 = 1.25;
/// Most members over those of the resolution before.
const MOST: f64 = 2.0;

/// A series through the members of a family, and what it leaves, relative.
#[derive(Clone, Copy, Debug)]
pub(super) struct Told {
    members: usize,
    /// The last coefficient over the largest.
    last: f64,
    left: f64,
    /// Whether that was measured, beside other members.
    is_measured: bool,
}

impl Told {
    /// Without a coarser resolution nothing but the last coefficient tells.
    pub(super) fn first(members: usize, last: f64) -> Self {
        Self { members, last, left: last, is_measured: false }
    }

    /// Through so many members; `coarse` is the series of a coarser resolution, and by how much it was wrong at these.
    pub(super) fn new(members: usize, last: f64, coarse: Option<(Self, f64)>) -> Self {
        match coarse {
            None => Self::first(members, last),
            // Where both go through the same values nothing is seen, but what a better resolution leaves of the last
            // coefficient.
            Some((coarse, _)) if coarse.members == members => {
                Self { last, left: coarse.left.min(BESIDE_LAST * last), ..coarse }
            }
            Some((coarse, wrong)) => {
                // Resolutions differ by more than their members.
                let before = wrong.min(BESIDE_LAST * coarse.last);
                let left = before * (coarse.members as f64 / members as f64).powf(ORDER);
                Self { members, last, left, is_measured: true }
            }
        }
    }

    /// Members for the next finer resolution, where so much may be left.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a few dozen
    pub(super) fn enough(&self, wanted: f64) -> usize {
        let least = if self.is_measured { 1.0 } else { COMPARED };
        let growth = (self.left / wanted).powf(1.0 / GROWTH).max(least).min(MOST);
        (self.members as f64 * growth).ceil() as usize
    }

    /// How many it goes through.
    pub(super) fn members(&self) -> usize {
        self.members
    }

    /// What is left, as far as that was measured.
    pub(super) fn left(&self) -> f64 {
        if self.is_measured { self.left } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn members_are_added_until_enough_are_there() {
        // A series that falls off with the tenth power, seen to 1e-12.
        let left = |members: usize| (members as f64 / 4.0).powi(-10) + 1e-12;
        let mut told = Told::first(8, left(8));
        for _ in 0..12 {
            let members = told.enough(1e-8);
            assert!(members <= 2 * told.members, "{told:?} asks for {members}");
            let wrong = if members == told.members { 0.0 } else { left(told.members) };
            told = Told::new(members, left(members), Some((told, wrong)));
            assert!(told.left() >= left(members) - 1e-12, "{told:?} leaves more");
        }
        assert!(told.left() <= 1e-8, "{told:?}");
        assert_eq!(told.enough(1e-8), told.members, "enough are there");
        assert!(told.members < 40, "no more than it takes: {told:?}");
    }

    #[test]
    fn what_was_left_stays_where_nothing_is_compared() {
        let coarse = Told::new(12, 1e-6, Some((Told::first(8, 1e-5), 1e-4)));
        assert!(coarse.left() > 1e-6);
        let same = Told::new(12, 1e-7, Some((coarse, 0.0)));
        assert_eq!(same.left().to_bits(), coarse.left().to_bits());
    }

    /// Through the most members there are, values of a better resolution take nothing but rounding on: under rounded
    /// flats on thin skins it was the coarse one that was left of, at each finer one.
    #[test]
    fn a_better_resolution_of_as_many_members_leaves_less() {
        let coarse = Told::new(12, 1e-6, Some((Told::first(8, 1e-5), 1e-4)));
        let same = Told::new(12, 1e-12, Some((coarse, 0.0)));
        assert!(same.left() <= 1.01e-10, "{same:?}");
    }

    #[test]
    fn resolutions_that_differ_by_more_than_members_ask_for_few() {
        let fine = |wrong: f64| Told::new(12, 1e-12, Some((Told::first(10, 1e-11), wrong)));
        assert!(fine(1e-3).left() < 1e-9, "{:?}", fine(1e-3));
        assert!(fine(1e-10).left() < 1e-10);
    }

    #[test]
    fn the_coarsest_resolution_is_compared_even_where_it_seems_enough() {
        let told = Told::first(8, 1e-12);
        assert_eq!(told.enough(1e-4), 10);
        assert!(told.left() <= 0.0, "and claims nothing before");
    }
}
