//! Sine and cosine together, without a branch: one text for `f64` and lanes.
//!
//! The angle is taken less its nearest whole number `k` of quarter turns (after Cody and Waite,
//! with pi / 2 in four parts), sine and cosine of what is left come from two polynomials, and `k`
//! modulo 4 swaps them and sets their signs. Worst error of 1.2e8 angles up to [`LARGEST_ANGLE`]:
//! 0.83 of the last place, 0.50 next to multiples of pi / 2; the suite `sines` compares it with 31
//! digits. Sine is odd to the bit, `-0.0` included, and cosine even. Only `+ - *` and what
//! [`QuarterTurns`] adds: the same bits on every IEEE-754 target.

use core::f64::consts::FRAC_2_PI;

use crate::numbers::real::Real;

/// What sine and cosine need of a number on top of [`Real`].
pub(crate) trait QuarterTurns: Real {
    /// Sine and cosine of an angle, from those of what `k` quarter turns leave of it.
    ///
    /// `count` is `1.5 * 2^52 + k`, whose unit in the last place is 1: the last two bits of its
    /// significand are `k` modulo 4, of a negative `k` too.
    ///
    /// | `k` modulo 4 | sine | cosine |
    /// |---|---|---|
    /// | 0 | `sine` | `cosine` |
    /// | 1 | `cosine` | `-sine` |
    /// | 2 | `-sine` | `-cosine` |
    /// | 3 | `-cosine` | `sine` |
    fn turned(count: Self, sine: Self, cosine: Self) -> (Self, Self);
}

impl QuarterTurns for f64 {
    #[inline]
    fn turned(count: Self, sine: Self, cosine: Self) -> (Self, Self) {
        let (count, sine, cosine) = (count.to_bits(), sine.to_bits(), cosine.to_bits());
        let swap = (sine ^ cosine) & (count & 1).wrapping_neg();
        let sine_sign = (count & 2) << 62;
        let cosine_sign = (count.wrapping_add(1) & 2) << 62;
        (Self::from_bits(sine ^ swap ^ sine_sign), Self::from_bits(cosine ^ swap ^ cosine_sign))
    }
}

/// Up to this magnitude of the angle, rad, [`sin_cos`] is accurate: 7 hours of a wheel at 6000 rpm.
///
/// Beyond it digits are lost without notice; whoever calls has to look.
pub(crate) const LARGEST_ANGLE: f64 = 16_777_216.0; // 2^24

/// `x + SHIFT - SHIFT` is the integer nearest to `x`, for `|x| <= 2^51`: between `2^52` and `2^53`
/// numbers are one apart.
const SHIFT: f64 = 6_755_399_441_055_744.0; // 1.5 * 2^52

/// Pi / 2, cut after 28, 53 and 82 bits after the point, and 53 bits of what is left. None is
/// negative, so that no product with `k = 0` turns `-0.0` into `0.0`.
pub(crate) const HALF_PI: [f64; 4] = [
    f64::from_bits(0x3ff9_21fb_5400_0000),
    f64::from_bits(0x3e11_0b46_0000_0000),
    f64::from_bits(0x3c91_a626_3300_0000),
    f64::from_bits(0x3a94_5c06_e0e6_8948),
];

/// `(x - sin x) / x^3` in powers of `x^2`, for `|x|` up to pi / 4: each coefficient by Remez'
/// method after the one before it was rounded. Error below `2^-57.8` of the sine.
const SINE: [f64; 6] = [
    0.166_666_666_666_666_3,
    -0.008_333_333_333_321_84,
    0.000_198_412_698_293_585_28,
    -2.755_731_353_851_465_7e-6,
    2.505_073_438_942_144_4e-8,
    -1.589_543_330_486_331_7e-10,
];

/// `(cos x - 1 + x^2 / 2) / x^4` likewise. Error below `2^-63.9` of the cosine.
const COSINE: [f64; 6] = [
    0.041_666_666_666_666_595,
    -0.001_388_888_888_887_334_2,
    2.480_158_728_900_208e-5,
    -2.755_731_421_703_904_6e-7,
    2.087_570_539_610_012e-9,
    -1.135_874_924_665_069_6e-11,
];

/// Sine and cosine of an angle in radians, at most [`LARGEST_ANGLE`] in magnitude; NaN of an
/// infinite angle and of NaN.
#[inline(always)]
#[expect(clippy::inline_always, reason = "lanes reach their instructions only where inlined")]
pub(crate) fn sin_cos<T: QuarterTurns>(angle: T) -> (T, T) {
    let shift = angle.like(SHIFT);
    let count = angle * angle.like(FRAC_2_PI) + shift;
    let (rest, excess) = reduced(angle, count - shift);
    let (sine, cosine) = of_small(rest, excess);
    T::turned(count, sine, cosine)
}

/// `angle - k pi / 2` as the difference `rest - excess`, right to `2^-114` and `2^-106` of itself,
/// for the nearest `k`, which [`LARGEST_ANGLE`] keeps below `2^23.4`.
///
/// Only the last sum of `rest` is rounded, and `excess` has what that sum gained.
/// For `k = 0` all is `angle`; else `|angle| > 1/2`, a multiple of `2^-53`, and:
///
/// 1. The first part is a multiple of `2^-28` below 2: its product with `k` is one below `2^25`, so
///    has 53 bits at most. The difference is a multiple of `2^-53` and, since the angle is within
///    pi / 4 (and `2^-28`, for the rounding of `k`) of `k pi / 2` and the parts left out are worth
///    `2^-29` of `k`, below 1: 53 bits, exact.
/// 2. The second part, below `2^-29`, is a multiple of `2^-53`: so are product and difference, both
///    below 1. Exact.
/// 3. The third part, below `2^-53.8`, is a multiple of `2^-82`: its product with `k`, below
///    `2^-30`, has 52 bits at most. If the difference so far is the larger of the two,
///    `(rest - before) - step` is what their sum gained by rounding (Dekker). If not, both are
///    multiples of `2^-82` below `2^-30`: the sum is exact, and has gained nothing.
/// 4. The fourth part, below `2^-85`, is rounded at `2^-139`, which `k` takes to `2^-115`; its
///    product with `k`, below `2^-61`, is rounded at `2^-115`.
///
/// The angle nearest to a multiple of pi / 2, of all up to [`LARGEST_ANGLE`], is off by `2^-60.5`.
#[inline(always)]
#[expect(clippy::inline_always, reason = "lanes reach their instructions only where inlined")]
fn reduced<T: Real>(angle: T, k: T) -> (T, T) {
    let [first, second, third, fourth] = HALF_PI;
    let before = angle - k * angle.like(first);
    let before = before - k * angle.like(second);
    let step = -k * angle.like(third);
    let rest = before + step;
    (rest, k * angle.like(fourth) + ((rest - before) - step))
}

/// Sine and cosine of `x - excess`, for `|x|` up to pi / 4 and an excess that is lost in it.
///
/// To first order in the excess `e`, `sin(x - e) = sin x - e cos x` and
/// `cos(x - e) = cos x + e sin x`; at most `1 - x^2 / 2` of that cosine and `x` of that sine count.
/// What `1 - x^2 / 2` loses by rounding is added to its small companions. Of the sine everything
/// but `x` is subtracted, so that `x = -0.0` remains what it is.
#[inline(always)]
#[expect(clippy::inline_always, reason = "lanes reach their instructions only where inlined")]
fn of_small<T: Real>(x: T, excess: T) -> (T, T) {
    let one = x.like(1.0);
    let x2 = x * x;
    let x4 = x2 * x2;
    let half = x2 * x.like(0.5);
    let parabola = one - half;
    let sine = x - (x * x2 * polynomial(x2, x4, SINE) + excess * parabola);
    let small = x4 * polynomial(x2, x4, COSINE) + x * excess;
    (sine, parabola + (((one - parabola) - half) + small))
}

/// A polynomial of the fifth degree in `x`, in pairs: half as deep as by Horner's rule.
#[inline(always)]
#[expect(clippy::inline_always, reason = "lanes reach their instructions only where inlined")]
fn polynomial<T: Real>(x: T, squared: T, coefficients: [f64; 6]) -> T {
    let [c0, c1, c2, c3, c4, c5] = coefficients;
    let low = x * x.like(c1) + x.like(c0);
    let middle = x * x.like(c3) + x.like(c2);
    let high = x * x.like(c5) + x.like(c4);
    squared * (squared * high + middle) + low
}
