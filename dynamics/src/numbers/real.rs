//! The number traits: [`Real`] for the emitted kernels, [`Angle`] for sine and cosine of
//! a joint, [`Scalar`] for the solver around them.
//!
//! A kernel needs nothing but ring arithmetic and a reciprocal, so it can also run on lanes or dual
//! numbers, which have no total order. Everything that compares or takes a root requires
//! [`Scalar`]. All are implemented for `f64` and `f32`; nothing in this crate rounds a
//! result through `f64`, so a wider type keeps its full accuracy.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use core::ops::{Add, Mul, Neg, Sub};

use crate::numbers::each::Value;
use crate::numbers::sincos::{LARGEST_ANGLE, sin_cos};

/// What an emitted kernel does with a number. Product and sum of `f64` and of `f32` are rounded one
/// after the other, so the bits are the same on every IEEE-754 target.
pub trait Real:
    Value + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// `1 / self`.
    #[must_use]
    fn recip(self) -> Self;

    /// The constant `value` as a number of the same kind as `self`.
    #[must_use]
    fn like(self, value: f64) -> Self;
}

/// `from + by`, except that a `by` of zero leaves every bit of `from`: -0.0 plus 0.0 would be 0.0.
///
/// By differences, without a branch: of dual numbers the derivative of `by` counts also where `by` is zero.
#[must_use]
#[inline(always)]
pub(crate) fn advanced_by<T: Real>(from: T, by: T) -> T {
    from - (by.like(0.0) - by)
}

/// What a kernel's arguments are made of: a number that has a sine.
pub trait Angle: Real {
    /// Sine and cosine of an angle in radians, with the same bits on every target.
    #[must_use]
    fn sin_cos(self) -> (Self, Self);
}

/// What the solver does with a number, on top of [`Angle`].
pub trait Scalar: Angle + PartialOrd {
    /// 0.
    const ZERO: Self;

    /// Distance from 1 to the next larger number: `2^-52` for `f64`, `2^-23` for `f32`.
    const EPSILON: Self;

    /// The nearest number to `value`. The solver passes small exact constants and first guesses
    /// only.
    #[must_use]
    fn from_f64(value: f64) -> Self;

    /// The nearest `f64`, for messages and first guesses.
    #[must_use]
    fn to_f64(self) -> f64;

    /// Square root; NaN for a negative number.
    #[must_use]
    fn sqrt(self) -> Self;

    /// Whether the number is neither infinite nor NaN.
    #[must_use]
    fn is_finite(self) -> bool;

    /// Whether it converts to `f64` and back exactly, so that its sines may be computed in lanes of
    /// `f64`.
    const IS_F64: bool = false;

    /// Whether the number is zero and remains zero: of a [`Dual`](crate::Dual) number, whether its
    /// derivatives are zero too.
    #[must_use]
    fn vanishes(self) -> bool {
        self == zero()
    }

    /// Magnitude. NaN stays NaN.
    #[must_use]
    fn abs(self) -> Self {
        if self < zero() { -self } else { self }
    }

    /// The larger of two numbers; `self` if either is NaN.
    #[must_use]
    fn max(self, other: Self) -> Self {
        if other > self { other } else { self }
    }
}

impl Real for f64 {
    #[inline]
    fn recip(self) -> Self {
        1.0 / self
    }

    #[inline]
    fn like(self, value: f64) -> Self {
        value
    }
}

impl Angle for f64 {
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        if self.abs() <= LARGEST_ANGLE { sin_cos(self) } else { libm::sincos(self) }
    }
}

impl Scalar for f64 {
    const ZERO: Self = 0.0;
    const EPSILON: Self = Self::EPSILON;
    const IS_F64: bool = true;

    #[inline]
    fn from_f64(value: f64) -> Self {
        value
    }

    #[inline]
    fn to_f64(self) -> f64 {
        self
    }

    #[inline]
    fn sqrt(self) -> Self {
        libm::sqrt(self)
    }

    #[inline]
    fn is_finite(self) -> bool {
        Self::is_finite(self)
    }
}

impl Real for f32 {
    #[inline]
    fn recip(self) -> Self {
        1.0 / self
    }

    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is intended")]
    fn like(self, value: f64) -> Self {
        value as Self
    }
}

impl Angle for f32 {
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        libm::sincosf(self)
    }
}

impl Scalar for f32 {
    const ZERO: Self = 0.0;
    const EPSILON: Self = Self::EPSILON;

    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is intended")]
    fn from_f64(value: f64) -> Self {
        value as Self
    }

    #[inline]
    fn to_f64(self) -> f64 {
        f64::from(self)
    }

    #[inline]
    fn sqrt(self) -> Self {
        libm::sqrtf(self)
    }

    #[inline]
    fn is_finite(self) -> bool {
        Self::is_finite(self)
    }
}

/// 0 as a `T`.
pub(crate) fn zero<T: Scalar>() -> T {
    T::from_f64(0.0)
}

/// A zero to fill a record with. Compilers for 32-bit processors do not know its value: they would
/// clear the record by a function that takes five instructions a word, where a store takes one for
/// two words.
#[inline(always)]
#[expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]
pub(crate) fn filling<T>(zero: T) -> T {
    if cfg!(target_pointer_width = "32") { core::hint::black_box(zero) } else { zero }
}

/// 1 as a `T`.
pub(crate) fn one<T: Scalar>() -> T {
    T::from_f64(1.0)
}

/// 2 as a `T`.
pub(crate) fn two<T: Scalar>() -> T {
    T::from_f64(2.0)
}

/// 1/2 as a `T`.
pub(crate) fn half<T: Scalar>() -> T {
    T::from_f64(0.5)
}

/// The reciprocal of a magnitude, in two factors to be multiplied by one after the other.
///
/// The first is a power of two, so that neither the reciprocal of a subnormal magnitude overflows
/// nor that of a huge one is subnormal. Both factors are finite for every finite magnitude but
/// zero, whose product with them is NaN, as is that of infinity.
pub(crate) fn reciprocal_in_two<T: Scalar>(magnitude: T) -> (T, T) {
    let power = if magnitude < T::EPSILON {
        T::EPSILON.recip()
    } else if magnitude > T::EPSILON.recip() {
        T::EPSILON
    } else {
        one()
    };
    (power, (power * magnitude).recip())
}

#[cfg(test)]
mod tests {
    use super::{Scalar, reciprocal_in_two};

    #[test]
    fn epsilon_is_the_step_above_one() {
        assert_eq!(<f64 as Scalar>::EPSILON, 2.0_f64.powi(-52));
        assert_eq!(<f32 as Scalar>::EPSILON, 2.0_f32.powi(-23));
    }

    #[test]
    fn reciprocal_in_two_factors_is_finite_down_to_the_smallest_number() {
        for x in [f64::from_bits(1), 1e-310, f64::MIN_POSITIVE, 3.0, f64::MAX] {
            let (first, second) = reciprocal_in_two(x);
            assert!((x * first * second - 1.0).abs() <= 2.0 * f64::EPSILON, "{x}");
        }
        for x in [f32::from_bits(1), f32::MIN_POSITIVE, f32::MAX] {
            let (first, second) = reciprocal_in_two(x);
            assert!((x * first * second - 1.0).abs() <= 2.0 * f32::EPSILON, "{x}");
        }
        for x in [0.0, f64::INFINITY, f64::NAN] {
            let (first, second) = reciprocal_in_two(x);
            assert!((x * first * second).is_nan(), "{x}");
        }
    }

    #[test]
    fn provided_magnitude_and_maximum_agree_with_the_standard_ones() {
        fn magnitude<T: Scalar>(x: T) -> T {
            x.abs()
        }
        fn larger<T: Scalar>(a: T, b: T) -> T {
            a.max(b)
        }
        assert_eq!(magnitude(-2.5), 2.5);
        assert_eq!(magnitude(2.5_f32), 2.5);
        assert!(magnitude(f64::NAN).is_nan());
        assert_eq!(larger(-1.0, 3.0), 3.0);
        assert_eq!(larger(3.0, f64::NAN), 3.0);
    }
}
