//! Functions of a place in a contact and of the contact's half-width.

use crate::engine::numerics::chebyshev::{Points, largest};
use crate::engine::numerics::lanes::{LANES, Lanes, polynomials_in_lanes};
use pulp::{Arch, Simd, WithSimd};
use slipzone_api::{Shelf, Station, double_exponential};
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

/// Where places end in the variable `u` of `x = c tanh((pi/2) sinh u)`: `1.7e-12 c` is left beyond it.
pub(crate) const END: f64 = 2.9;
/// Where those end of what goes on as `ln(c - x)/sqrt(c - x)`: `4e-19 c` is left beyond it.
pub(crate) const FAR_END: f64 = 3.4;

/// Places at which a density is told: this many, and more per unknown. A Chebyshev series takes half as many again as a
/// sum of sinc functions on the same stretch.
const FEWEST_PLACES: f64 = 8.0;
const PLACES_PER_UNKNOWN: f64 = 1.5;

/// What may be left out of a sheet, over the largest of its coefficients, for the error wanted of the numbers.
///
/// As the resolutions were found to be enough by what they change, the last holds many coefficients that tell nothing:
/// measured on strained contacts at 1e-3 and 1e-5, seven in eight of those of the shear.
const LEFT_OUT: f64 = 1e-6;

/// A function on `(0, c)` for all half-widths of a blend: a sum of products of the blend's functions and of Chebyshev
/// polynomials in `u`, in which powers and logarithms of the distance to `c` fade double-exponentially.
pub(crate) struct Sheet {
    /// Where the places end.
    end: f64,
    /// Most polynomials beside a function of the half-width.
    width: usize,
    /// A series for each of them, one after another, as long as it tells anything.
    coefficients: Vec<f64>,
    /// Where each begins, and where the last ends.
    starts: Vec<usize>,
}

impl Sheet {
    /// From a series of so many polynomials for each of the blend's functions, over places up to an end; `wanted` is
    /// the error of the numbers.
    pub(crate) fn new(mut coefficients: Vec<f64>, width: usize, end: f64, wanted: f64) -> Self {
        let mut starts = vec![0];
        let left_out = LEFT_OUT * wanted * largest(&coefficients);
        let (mut longest, mut kept) = (0, 0);
        for from in (0..coefficients.len()).step_by(width) {
            // No polynomial is larger than 1. What is no number stays.
            let mut rest = 0.0;
            let tells = |c: &f64| {
                rest += c.abs();
                rest > left_out || !rest.is_finite()
            };
            let length = coefficients[from..from + width].iter().rposition(tells).map_or(0, |last| last + 1);
            coefficients.copy_within(from..from + length, kept);
            (longest, kept) = (length.max(longest), kept + length);
            starts.push(kept);
        }
        coefficients.truncate(kept);
        Self { end, width: longest, coefficients, starts }
    }

    /// Through values at the stations of some places, one row for each of the blend's functions.
    pub(crate) fn through(places: &Places, rows: &[f64], wanted: f64) -> Self {
        let width = places.stations.len();
        let mut coefficients = vec![0.0; rows.len()];
        for (row, to) in rows.chunks_exact(width).zip(coefficients.chunks_exact_mut(width)) {
            places.through_into(row, to);
        }
        Self::new(coefficients, width, places.end, wanted)
    }

    /// The place of a point in a contact; what is beyond the last is as good as there.
    pub(crate) fn place(&self, at: Station) -> f64 {
        (double_exponential::locate(at) / self.end).min(1.0)
    }

    /// How many products it is a sum of.
    pub(crate) fn products(&self) -> usize {
        self.coefficients.len()
    }

    /// Values at places, from the blend's functions at their half-widths.
    pub(crate) fn values_into(&self, functions: &[Lanes], places: &Lanes, room: &mut Vec<Lanes>, out: &mut Lanes) {
        // All of it is written: nothing has to be cleared.
        room.resize(self.width, [0.0; LANES]);
        Arch::new().dispatch(Values { sheet: self, functions, places, room, out });
    }
}

/// Places at which a density is told.
///
/// The middle is one of them: what is wrong there is wrong of all members of a stack that are much wider than the point
/// looked at is far from it, and under a pointed punch these are many.
pub(crate) struct Places {
    end: f64,
    points: Arc<Points>,
    /// Where they are in a contact of unit half-width, the middle last.
    pub(crate) stations: Vec<Station>,
}

impl Places {
    /// Those up to an end for so many unknowns.
    pub(crate) fn of(unknowns: f64, end: f64) -> Arc<Self> {
        const MOST: usize = 1 << 14;
        static KNOWN: Shelf<(usize, u64), Places> = Shelf::new(MOST, |places| places.stations.len());
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // some dozens
        let count = ((FEWEST_PLACES + PLACES_PER_UNKNOWN * unknowns) * end / END) as usize;
        KNOWN.get((count, end.to_bits()), || Self::new(count, end))
    }

    /// So many, and the middle.
    fn new(count: usize, end: f64) -> Self {
        let points = Points::get(count);
        let station = |s: &f64| {
            let w = FRAC_PI_2 * (end * s).sinh();
            Station { x: w.tanh(), gap: 2.0 / (1.0 + (2.0 * w).exp()) }
        };
        let stations = points.at.iter().chain(&[0.0]).map(station).collect();
        Self { end, points, stations }
    }

    /// Writes the series through values at the stations.
    pub(crate) fn through_into(&self, values: &[f64], series: &mut [f64]) {
        let (middle, values) = values.split_last().expect("a value in the middle");
        let (last, series) = series.split_last_mut().expect("as many coefficients");
        self.points.through_into(values, series);
        // The next polynomial vanishes at all points but the middle; there they are 1 and -1 in turn.
        let sign = |k: usize| if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        let told: f64 = series.iter().enumerate().map(|(k, c)| sign(k) * c).sum();
        *last = sign(series.len()) * (middle - told);
    }
}

struct Values<'a> {
    sheet: &'a Sheet,
    functions: &'a [Lanes],
    places: &'a Lanes,
    room: &'a mut [Lanes],
    out: &'a mut Lanes,
}

impl WithSimd for Values<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { sheet, functions, places, room, out } = self;
        polynomials_in_lanes(simd, places, room);
        let mut sums = [0.0; LANES];
        let (wide, single) = S::as_mut_simd_f64s(&mut sums).0.as_chunks_mut::<WIDE>();
        for (group, sums) in wide.iter_mut().enumerate() {
            add(simd, sheet, (functions, room), WIDE * group, sums);
        }
        let first = WIDE * wide.len();
        for (i, sum) in single.as_chunks_mut::<1>().0.iter_mut().enumerate() {
            add(simd, sheet, (functions, room), first + i, sum);
        }
        *out = sums;
    }
}

/// Vectors added up side by side.
const WIDE: usize = 4;

/// Sums over all products for the vectors from a first one on.
#[inline(always)]
fn add<S: Simd, const N: usize>(
    simd: S,
    sheet: &Sheet,
    (functions, polynomials): (&[Lanes], &[Lanes]),
    first: usize,
    sums: &mut [S::f64s; N],
) {
    for (function, ends) in functions.iter().zip(sheet.starts.windows(2)) {
        let row = &sheet.coefficients[ends[0]..ends[1]];
        let mut factors = [simd.splat_f64s(0.0); N];
        for (coefficient, polynomial) in row.iter().zip(polynomials) {
            let coefficient = simd.splat_f64s(*coefficient);
            let polynomial = &S::as_simd_f64s(polynomial).0[first..first + N];
            for i in 0..N {
                factors[i] = simd.mul_add_e_f64s(coefficient, polynomial[i], factors[i]);
            }
        }
        let function = &S::as_simd_f64s(function).0[first..first + N];
        for i in 0..N {
            sums[i] = simd.mul_add_e_f64s(function[i], factors[i], sums[i]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::blend::Blend;
    use super::*;

    #[test]
    fn what_is_smooth_in_both_comes_back_side_by_side() {
        let blend = Blend::new((0.0, 3.0), 20, &[(1, 1)]).unwrap();
        let places = Places::new(60, END);
        let f = |x: f64, gap: f64, b: f64| gap.sqrt() * (1.0 + 0.3 * x * b + 0.1 * gap * gap.ln()) / (2.0 + b);
        let rows: Vec<f64> = blend
            .half_widths()
            .iter()
            .flat_map(|b| places.stations.iter().map(|at| f(at.x, at.gap, *b)).collect::<Vec<_>>())
            .collect();
        let sheet = Sheet::through(&places, &blend.coefficients(&rows, places.stations.len()), 1e-10);
        let gaps: Lanes = std::array::from_fn(|i| 0.5_f64.powi(2 * i32::try_from(i).unwrap()));
        let half_widths: Lanes = std::array::from_fn(|i| 3.0 - 0.18 * i as f64);
        let (mut functions, mut room, mut values) = (Vec::new(), Vec::new(), [0.0; LANES]);
        blend.functions_into(&half_widths, &mut functions);
        let places = gaps.map(|gap| sheet.place(Station { x: 1.0 - gap, gap }));
        assert!(places[0].abs() < f64::MIN_POSITIVE, "the middle");
        sheet.values_into(&functions, &places, &mut room, &mut values);
        for i in 0..LANES {
            let exact = f(1.0 - gaps[i], gaps[i], half_widths[i]);
            assert!((values[i] - exact).abs() < 1e-10, "{} for {exact} at {}", values[i], gaps[i]);
        }
    }

    #[test]
    fn what_tells_nothing_is_left_out() {
        let (functions, width, wanted) = (5, 12, 1e-3);
        let coefficients: Vec<f64> =
            (0..functions * width).map(|i| (-2.5 * ((i % width) + (i / width) * (i / width)) as f64).exp()).collect();
        let [whole, sheet] = [0.0, wanted].map(|wanted| Sheet::new(coefficients.clone(), width, END, wanted));
        assert_eq!(whole.products(), functions * width);
        assert!(sheet.products() < whole.products() / 2, "{} products", sheet.products());
        let (place, functions) = ([0.3; LANES], [[1.0; LANES]; 5]);
        let [found, told] = [&sheet, &whole].map(|sheet| {
            let mut values = [0.0; LANES];
            sheet.values_into(&functions, &place, &mut Vec::new(), &mut values);
            values[0]
        });
        let off = (found - told).abs();
        assert!(off > 0.0 && off < 5.0 * LEFT_OUT * wanted, "{off:e}");
        let unknown = Sheet::new(vec![1.0, f64::NAN, 0.0], 3, END, wanted);
        assert_eq!(unknown.products(), 2, "what is no number stays");
    }
}
