//! Elementary functions without branches, for loops that the compiler turns into vector code.
//!
//! A logarithm of the standard library is a call for each number. These have the same value in a loop and on
//! their own: nothing in them depends on what the machine has.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, LOG2_E, PI};

/// Euler's constant.
pub const EULER_GAMMA: f64 = 0.577_215_664_901_532_9;

/// Rows filled up to a multiple of it leave no vector half empty: those of no machine served have more lanes.
pub const LANES: usize = 4;

/// What of the bits of a number is its exponent's.
const EXPONENT_BITS: u32 = 52;
/// The bits of 1.
const ONE: u64 = 1.0_f64.to_bits();
/// The exponent's bits of 1.
const EXPONENT_OF_ONE: u64 = ONE >> EXPONENT_BITS;
/// About `sqrt(1/2)`, in bits: mantissas are taken from here to twice as much.
const LEAST_MANTISSA: u64 = 0x3fe6_a09e_0000_0000;
/// `2^52`: added to a small whole number, it leaves that number in the lowest bits.
const WHOLE: f64 = 4_503_599_627_370_496.0;
/// `ln 2`, its first 32 bits and the rest.
const LN_2: (f64, f64) = (f64::from_bits(0x3fe6_2e42_fee0_0000), f64::from_bits(0x3dea_39ef_3579_3c76));
/// Of `[ln((1 + s)/(1 - s)) - 2 s]/s` in powers of `s^2`, for `|s| < 0.1716` to `2^-58` (FDLIBM, `e_log.c`).
const SERIES: [f64; 7] = [
    0.666_666_666_666_673_5,
    0.399_999_999_994_094_2,
    0.285_714_287_436_623_9,
    0.222_221_984_321_497_84,
    0.181_835_721_616_180_5,
    0.153_138_376_992_093_73,
    0.147_981_986_051_165_86,
];

/// Of `sin(pi d)/d` in powers of `d^2`: `(-1)^k pi^(2 k + 1)/(2 k + 1)!`.
const SINE: [f64; 11] = [
    std::f64::consts::PI,
    -5.167_712_780_049_97,
    2.550_164_039_877_345_5,
    -0.599_264_529_320_792_1,
    0.082_145_886_611_128_23,
    -0.007_370_430_945_714_350_4,
    0.000_466_302_805_767_612_55,
    -2.191_535_344_783_021_7e-05,
    7.952_054_001_475_513e-07,
    -2.294_842_899_726_987_3e-08,
    5.392_664_662_608_129e-10,
];

/// Of `1 - atan(u)/u` in powers of `u^2`, for `|u| <= 7/16` (FDLIBM, `s_atan.c`).
const ARC_TANGENT: [f64; 11] = [
    0.333_333_333_333_329_3,
    -0.199_999_999_998_764_83,
    0.142_857_142_725_034_66,
    -0.111_111_104_054_623_56,
    0.090_908_871_334_365_07,
    -0.076_918_762_050_448_3,
    0.066_610_731_373_875_31,
    -0.058_335_701_337_905_735,
    0.049_768_779_946_159_324,
    -0.036_531_572_744_216_916,
    0.016_285_820_115_365_782,
];
/// Of `(exp(r) - 1 - r)/r^2` in powers of `r`, for `|r| <= ln(2)/2` to `2^-57`: `1/(k + 2)!`.
const EXPONENTIAL: [f64; 12] = [
    1.0 / 2.0,
    1.0 / 6.0,
    1.0 / 24.0,
    1.0 / 120.0,
    1.0 / 720.0,
    1.0 / 5_040.0,
    1.0 / 40_320.0,
    1.0 / 362_880.0,
    1.0 / 3_628_800.0,
    1.0 / 39_916_800.0,
    1.0 / 479_001_600.0,
    1.0 / 6_227_020_800.0,
];
/// `1.5 2^52`: added to a number of either sign that is small beside it, it rounds that number to a whole one, and
/// leaves it in the lowest bits.
pub const ROUND: f64 = 6_755_399_441_055_744.0;
/// `cot(pi/8)`; `tan(pi/8)` is less by 2.
const STEEP: f64 = 2.414_213_562_373_095;

/// `ln x` for `x > 0` and finite, to one unit in the last place; a subnormal number counts as the least normal one.
#[inline(always)]
pub fn ln(x: f64) -> f64 {
    let x = if x < f64::MIN_POSITIVE { f64::MIN_POSITIVE } else { x };
    let bits = x.to_bits().wrapping_add(ONE - LEAST_MANTISSA);
    let exponent = f64::from_bits((bits >> EXPONENT_BITS) | WHOLE.to_bits()) - (WHOLE + 1023.0);
    let mantissa = f64::from_bits((bits & ((1 << EXPONENT_BITS) - 1)).wrapping_add(LEAST_MANTISSA));
    let f = mantissa - 1.0;
    let s = f / (2.0 + f);
    let z = s * s;
    let w = z * z;
    let [a, b, c, d, e, g, h] = SERIES;
    let rest = w * (b + w * (d + w * g)) + z * (a + w * (c + w * (e + w * h)));
    let half_square = 0.5 * f * f;
    exponent * LN_2.0 - ((half_square - (s * (half_square + rest) + exponent * LN_2.1)) - f)
}

/// `ln(1 + y)` for `y >= 0`, to two units in the last place; beyond the largest number as at it.
#[inline(always)]
pub fn ln_1p(y: f64) -> f64 {
    let y = if y > f64::MAX { f64::MAX } else { y };
    let sum = 1.0 + y;
    // What rounding took off the sum.
    ln(sum) + (y - (sum - 1.0)) / sum
}

/// `asinh y` for `0 <= y < 1e154`, to four units in the last place.
#[inline(always)]
pub fn asinh(y: f64) -> f64 {
    let square = y * y;
    ln_1p(y + square / (1.0 + (1.0 + square).sqrt()))
}

/// `sinh x` for `|x| <= 700`, to three units in the last place.
#[inline(always)]
pub fn sinh(x: f64) -> f64 {
    let size = x.abs();
    let rounded = size * LOG2_E + ROUND;
    let k = rounded - ROUND;
    let r = (size - k * LN_2.0) - k * LN_2.1;
    let mut sum = EXPONENTIAL[EXPONENTIAL.len() - 1];
    for c in EXPONENTIAL[..EXPONENTIAL.len() - 1].iter().rev() {
        sum = sum * r + c;
    }
    // exp(x) - 1 = 2^k [exp(r) - 1 + (1 - 2^-k)] keeps the digits of a small number.
    let exponent = rounded.to_bits().wrapping_add(EXPONENT_OF_ONE) << EXPONENT_BITS;
    let inverse = EXPONENT_OF_ONE.wrapping_sub(rounded.to_bits()) << EXPONENT_BITS;
    let less = f64::from_bits(exponent) * (r + r * r * sum + (1.0 - f64::from_bits(inverse)));
    (0.5 * (less + less / (1.0 + less))).copysign(x)
}

/// `sin(pi d)` for `|d| <= 1/2`, to two units in the last place.
#[inline(always)]
pub fn sin_pi(d: f64) -> f64 {
    let square = d * d;
    let mut sum = SINE[SINE.len() - 1];
    for c in SINE[..SINE.len() - 1].iter().rev() {
        sum = sum * square + c;
    }
    d * sum
}

/// The angle between the axis and the direction to `(x, y)`, `y > 0`, from 0 to `pi`, to two units in the last place;
/// `x` may be infinite.
#[inline(always)]
pub fn angle(x: f64, y: f64) -> f64 {
    let size = x.abs();
    let (is_low, is_high) = (size > STEEP * y, size < (STEEP - 2.0) * y);
    // Less what is taken off it, the rest is within `pi/8`.
    let over = if is_low {
        y
    } else if is_high {
        -size
    } else {
        y - size
    };
    let under = if is_low {
        size
    } else if is_high {
        y
    } else {
        y + size
    };
    let off = if is_low {
        0.0
    } else if is_high {
        FRAC_PI_2
    } else {
        FRAC_PI_4
    };
    let u = over / under;
    let z = u * u;
    let w = z * z;
    let [a, b, c, d, e, f, g, h, i, j, k] = ARC_TANGENT;
    let even = z * (a + w * (c + w * (e + w * (g + w * (i + w * k)))));
    let odd = w * (b + w * (d + w * (f + w * (h + w * j))));
    let angle = off + (u - u * (even + odd));
    if x < 0.0 { PI - angle } else { angle }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Distance in units of the last place.
    fn units(got: f64, expected: f64) -> f64 {
        let unit = f64::from_bits(expected.abs().to_bits() + 1) - expected.abs();
        (got - expected).abs() / unit
    }

    /// Numbers over the whole range, dense about 1.
    fn numbers() -> impl Iterator<Item = f64> {
        let wide = (-1021..1024).flat_map(|e| (0..40).map(move |m| (1.0 + f64::from(m) / 40.0) * 2.0_f64.powi(e)));
        let near_one = (1..2000).flat_map(|i| [1.0 + f64::from(i) * 1e-3, 1.0 - f64::from(i) * 4.9e-4]);
        let nearest = (1..300).flat_map(|i| [1.0 + 0.9_f64.powi(i), 1.0 - 0.9_f64.powi(i + 1)]);
        wide.chain(near_one).chain(nearest)
    }

    #[test]
    fn logarithms_have_all_their_digits() {
        for x in numbers() {
            assert!(units(ln(x), x.ln()) <= 1.0, "ln {x:e}: {} for {}", ln(x), x.ln());
        }
        assert!(ln(1.0).abs() < f64::MIN_POSITIVE);
        assert!((ln(0.0) - f64::MIN_POSITIVE.ln()).abs() < 1e-12, "no infinity");
    }

    #[test]
    fn hyperbolic_sines_have_all_their_digits() {
        let near = (1..4000).map(|i| f64::from(i) * 1e-3);
        for x in near.chain((1..7000).map(|i| f64::from(i) * 0.1)).chain((1..690).map(|i| 0.35_f64.powi(i))) {
            for x in [x, -x] {
                assert!(units(sinh(x), x.sinh()) <= 3.0, "sinh {x:e}: {} for {}", sinh(x), x.sinh());
            }
        }
        assert!(sinh(0.0).abs() < f64::MIN_POSITIVE);
    }

    #[test]
    fn so_have_their_inverses() {
        for y in numbers().filter(|y| *y < 1e154).chain((1..700).map(|i| 0.37_f64.powi(i))) {
            assert!(units(asinh(y), y.asinh()) <= 4.0, "asinh {y:e}: {} for {}", asinh(y), y.asinh());
        }
        assert!(asinh(0.0).abs() < f64::MIN_POSITIVE);
    }

    #[test]
    fn sines_have_all_their_digits() {
        for i in 0..=1000 {
            let d = 0.5 * f64::from(i) / 1000.0;
            for d in [d, -d, d * 1e-5, d * 1e-300] {
                assert!(units(sin_pi(d), (PI * d).sin()) <= 3.0, "{d}: {} for {}", sin_pi(d), (PI * d).sin());
            }
        }
    }

    #[test]
    fn angles_have_all_their_digits() {
        for x in numbers().flat_map(|x| [x, -x]).chain([0.0, f64::INFINITY]) {
            for y in [1.0, 0.3, 7.0] {
                let (got, exact) = (angle(x, y), y.atan2(x));
                assert!(units(got, exact) <= 2.0, "({x:e}, {y}): {got} for {exact}");
            }
        }
    }

    #[test]
    fn so_have_those_of_what_is_added_to_one() {
        for y in numbers().chain((1..700).map(|i| 0.37_f64.powi(i))) {
            assert!(units(ln_1p(y), y.ln_1p()) <= 2.0, "ln(1 + {y:e}): {} for {}", ln_1p(y), y.ln_1p());
        }
        assert!(ln_1p(0.0).abs() < f64::MIN_POSITIVE);
        assert!(units(ln_1p(f64::INFINITY), f64::MAX.ln()) <= 1.0, "no NaN");
    }
}
