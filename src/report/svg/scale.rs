//! The scale of an axis: linear or logarithmic, its ends, its ticks and its label.

use crate::report::number::{trimmed, typeset};
use crate::report::svg::axis::{Axis, power_of_ten};
use crate::report::svg::canvas::LETTERS;
use kuva::render::layout::{AxisLabelOverlap, ComputedLayout, Layout, TickFormat};
use kuva::render::render_utils::generate_ticks_log;
use std::sync::Arc;

/// An axis of a panel. What is drawn is divided by [`Self::unit`].
#[derive(Clone)]
pub(super) struct Scale {
    pub(super) label: String,
    pub(super) unit: f64,
    pub(super) least: f64,
    pub(super) most: f64,
    is_logarithmic: bool,
    /// Distance of the ticks; `None` where they are powers of ten, with or without their double and half.
    step: Option<f64>,
    ticks: TickFormat,
}

impl Scale {
    /// From 0 to a little beyond the largest number; `None` where that is not above 0.
    pub(super) fn up_to(largest: f64, name: &str, unit: &str) -> Option<Self> {
        let axis = Axis::new(largest, name, unit)?;
        let ticks = axis.ticks();
        let (step, is_logarithmic) = (Some(axis.step), false);
        Some(Self { label: axis.label, unit: axis.unit, least: 0.0, most: axis.most, is_logarithmic, step, ticks })
    }

    /// Around both numbers, neither of which need be 0, with about so many distances of ticks.
    pub(super) fn around(least: f64, most: f64, name: &str, intervals: f64) -> Option<Self> {
        /// Room beyond both ends, over the range.
        const ROOM: f64 = 0.12;
        let room = ROOM * (most - least);
        let axis = Axis::with_intervals(most - least, name, "", intervals)?;
        let step = axis.step * axis.unit;
        let (least, most, ticks) = (least - room, most + room, signed(step));
        Some(Self { label: name.into(), unit: 1.0, least, most, is_logarithmic: false, step: Some(step), ticks })
    }

    /// From the least number to the largest, with room beyond the ends that are asked for.
    pub(super) fn spanning((least, most): (f64, f64), [below, above]: [bool; 2], name: &str, unit: &str) -> Self {
        /// Room beyond an end, over the range.
        const ROOM: f64 = 0.06;
        const INTERVALS: f64 = 6.0;
        /// Numbers that differ by less, over the largest, are equal but for their errors; nor would the ticks differ.
        const EQUAL: f64 = 1e-8;
        // Equal numbers, or none, need a frame, too.
        let apart = most - least > EQUAL * least.abs().max(most.abs());
        let spread = if apart { 0.0 } else { 0.1 * least.abs().max(f64::MIN_POSITIVE.sqrt()) };
        let (least, most) = (least - spread, most + spread);
        let size = least.abs().max(most.abs());
        let powers = Axis::new(size, name, unit);
        let (label, divisor) = powers.map_or_else(|| (name.to_owned(), 1.0), |axis| (axis.label, axis.unit));
        let (least, most) = (least / divisor, most / divisor);
        let range = most - least;
        let room = |wanted: bool| if wanted { ROOM * range } else { 0.0 };
        let step = Axis::with_intervals(range, "", "", INTERVALS).map_or(range, |axis| axis.step * axis.unit);
        let (least, most) = (least - room(below), most + room(above));
        Self { label, unit: divisor, least, most, is_logarithmic: false, step: Some(step), ticks: signed(step) }
    }

    /// Around both positive numbers on a logarithmic axis.
    pub(super) fn logarithmic(least: f64, most: f64, name: &str, unit: &str) -> Self {
        /// Of the largest number to the least that is shown: kuva goes from power to power of ten, and never comes to
        /// infinity.
        const LONGEST: f64 = 1e280;
        /// Ticks that say how the axis is stepped; and of their distances, where these are equal.
        const FEWEST: usize = 3;
        const INTERVALS: f64 = 6.0;
        /// Most ticks with their numbers, of powers of ten.
        const NUMBERED: usize = 10;
        /// kuva takes what is below 1e-10 for 1e-10: numbers are drawn in units of the largest where need be.
        const DRAWN: std::ops::Range<f64> = 1e-9..1e15;
        /// Ends of an axis whose numbers are written in full: its ticks are 0.001 to 5000.
        const PLAIN: std::ops::Range<f64> = 5.01e-4..9.99e3;
        let least = least.max(most / LONGEST);
        let fits = DRAWN.contains(&least) && DRAWN.contains(&most);
        let divisor = if fits { 1.0 } else { 10.0_f64.powf(least.log10().floor()) };
        let label = if unit.is_empty() { name.to_owned() } else { format!("{name} ({unit})") };
        let (least, most) = (least / divisor, most / divisor);
        let round = generate_ticks_log(least, most);
        // Within a decade there may be none or one of them: then equal distances.
        let step = Axis::with_intervals(most - least, "", "", INTERVALS).filter(|_| round.len() < FEWEST);
        let step = step.map(|axis| axis.step * axis.unit);
        let every = [1, 2, 5, 10, 20, 50].into_iter().find(|every| NUMBERED * every >= round.len());
        let every = every.and_then(|every| i32::try_from(every).ok()).unwrap_or(100);
        // As many as tell neighbours apart.
        let digits = step.map_or(1, |step| usize::try_from(1 + power_of_ten(most) - power_of_ten(step)).unwrap_or(1));
        // All in one way: 1000 is no neighbour of 10⁴.
        let is_plain = [least, most].into_iter().all(|end| PLAIN.contains(&(end * divisor)));
        let ticks = TickFormat::Custom(Arc::new(move |value: f64| {
            #[expect(clippy::cast_possible_truncation, reason = "a few hundred")]
            let power = (value * divisor).log10().round() as i32;
            let is_numbered = every <= 1 || power % every == 0;
            let value = value * divisor;
            let written = if is_plain { trimmed(value, digits.max(4)) } else { format!("{:.*e}", digits - 1, value) };
            if is_numbered { typeset(&written) } else { String::new() }
        }));
        Self { label, unit: divisor, least, most, is_logarithmic: true, step, ticks }
    }

    /// Powers of ten, every so many of them with its number; none above the last.
    pub(super) fn of_powers(least: f64, most: f64, label: &str, every: i32, last: f64) -> Self {
        /// What is drawn is in units of this: kuva takes what is below 1e-10 for 1e-10.
        const POWERS: f64 = 1e-100;
        let ticks = TickFormat::Custom(Arc::new(move |value: f64| {
            #[expect(clippy::cast_possible_truncation, reason = "a few hundred")]
            let power = (value * POWERS).log10().round() as i32;
            let is_shown = power % every == 0 && value * POWERS <= 1.01 * last;
            if is_shown { typeset(&format!("1e{power}")) } else { String::new() }
        }));
        let (least, most) = (least / POWERS, most / POWERS);
        Self { label: label.into(), unit: POWERS, least, most, is_logarithmic: true, step: None, ticks }
    }

    /// A cell for each of these names, from 0; names that would overlap are left out.
    pub(super) fn of_names(names: Vec<String>, label: &str, most: usize) -> Self {
        let count = names.len() as f64;
        let step = (names.len().div_ceil(most.max(1)).max(1)) as f64;
        let ticks = TickFormat::Custom(Arc::new(move |value: f64| {
            let is_whole = (value - value.round()).abs() < 1e-6 && value > -0.25;
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates, and few")]
            let name = names.get(value.round() as usize).filter(|_| is_whole);
            name.cloned().unwrap_or_default()
        }));
        let (least, most) = (-0.5, count - 0.5);
        Self { label: label.into(), unit: 1.0, least, most, is_logarithmic: false, step: Some(step), ticks }
    }

    pub(super) fn is_logarithmic(&self) -> bool {
        self.is_logarithmic
    }

    /// Whether a number, in units of the axis, lies between the ends.
    pub(super) fn holds(&self, value: f64) -> bool {
        (self.least..=self.most).contains(&value)
    }

    /// Place of a number, in units of the axis, between the ends 0 and 1.
    pub(super) fn place(&self, value: f64) -> f64 {
        let (value, least, most) = if self.is_logarithmic {
            (value.max(self.least).ln(), self.least.ln(), self.most.ln())
        } else {
            (value, self.least, self.most)
        };
        (value - least) / (most - least)
    }

    /// Where a number, in units of the axis, stands in a frame that has this as its abscissa, px.
    pub(super) fn across(&self, computed: &ComputedLayout, value: f64) -> f64 {
        computed.margin_left + computed.plot_width() * self.place(value)
    }

    /// The same of a frame that has this as its ordinate.
    pub(super) fn up(&self, computed: &ComputedLayout, value: f64) -> f64 {
        computed.margin_top + computed.plot_height() * (1.0 - self.place(value))
    }

    /// Ticks off the frame.
    pub(super) fn inner_ticks(&self) -> Vec<f64> {
        /// More than any axis has.
        const MOST: u8 = 32;
        let Some(step) = self.step else {
            // Of very many powers those without numbers are left out.
            let (ticks, most) = (generate_ticks_log(self.least, self.most), usize::from(MOST));
            let is_shown = |tick: &f64| ticks.len() <= most || !self.written(*tick).is_empty();
            return ticks.iter().copied().filter(is_shown).collect();
        };
        let first = (self.least / step).floor() * step;
        let ticks = (0..MOST).map(|i| first + f64::from(i) * step);
        let off = 1e-6 * (self.most - self.least);
        ticks.filter(|tick| *tick > self.least + off && *tick < self.most - off).collect()
    }

    /// Ticks from end to end.
    pub(super) fn ticks_within(&self) -> Vec<f64> {
        let Some(step) = self.step else { return generate_ticks_log(self.least, self.most) };
        let off = 1e-6 * (self.most - self.least);
        let ends = [self.least, self.most].into_iter().filter(|end| ((end / step).round() * step - end).abs() <= off);
        let mut ticks: Vec<f64> = self.inner_ticks().into_iter().chain(ends).collect();
        ticks.sort_by(f64::total_cmp);
        ticks
    }

    /// A number of a tick as it is set in print.
    pub(super) fn written(&self, tick: f64) -> String {
        self.ticks.format(tick)
    }

    /// The layout with this as its abscissa.
    pub(super) fn below(&self, layout: Layout) -> Layout {
        let layout =
            layout.with_x_axis_min(self.least).with_x_axis_max(self.most).with_x_tick_format(self.ticks.clone());
        let layout = self.step.into_iter().fold(layout, Layout::with_x_tick_step);
        // Ticks without a number would take the room of their neighbours'.
        let is_numbered = self.ticks_within().into_iter().all(|tick| !self.written(tick).is_empty());
        let overlap = if is_numbered { AxisLabelOverlap::Thin } else { AxisLabelOverlap::Allow };
        let layout = layout.with_x_label_overlap(overlap);
        if self.is_logarithmic { layout.with_log_x() } else { layout }
    }

    /// The layout with this as its ordinate.
    pub(super) fn beside(&self, layout: Layout) -> Layout {
        let layout =
            layout.with_y_axis_min(self.least).with_y_axis_max(self.most).with_y_tick_format(self.ticks.clone());
        let layout = self.step.into_iter().fold(layout, Layout::with_y_tick_step);
        let layout = if self.is_logarithmic { layout.with_log_y() } else { layout };
        let beyond = self.beyond(&ComputedLayout::from_layout(&layout));
        layout.with_y_label_offset(-beyond, 0.0)
    }

    /// Room that the numbers beside the frame take, px, beyond what kuva reckons with: on a logarithmic axis that is
    /// for numbers written its own way.
    fn beyond(&self, computed: &ComputedLayout) -> f64 {
        if !self.is_logarithmic {
            return 0.0;
        }
        let written = self.ticks_within().into_iter().map(|tick| self.written(tick)).collect();
        let named = Layout::new((0.0, 1.0), (0.0, 1.0)).with_tick_size(LETTERS).with_y_categories(written);
        (ComputedLayout::from_layout(&named).y_tick_label_px - computed.y_tick_label_px).max(0.0)
    }

    /// Room to the left of the frame that has this as its ordinate, px.
    pub(super) fn margin(&self, layout: &Layout) -> f64 {
        let computed = ComputedLayout::from_layout(layout);
        computed.margin_left + self.beyond(&computed)
    }
}

/// The least of some numbers and the largest; `None` without any.
pub(super) fn ends(numbers: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    numbers.map(|number| (number, number)).reduce(|(least, most), (number, _)| (least.min(number), most.max(number)))
}

/// Numbers of any sign with as many decimals as the distance of the ticks has.
fn signed(step: f64) -> TickFormat {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates, and few")]
    let decimals = (-(step.log10() + 1e-9).floor()).clamp(0.0, 9.0) as usize;
    TickFormat::Custom(Arc::new(move |value| format!("{:.decimals$}", value + 0.0).replace('-', "\u{2212}")))
}
