//! A double-double scalar: the unevaluated sum of two `f64`, about 31 decimal digits.
//!
//! Algorithms and error bounds: Joldes, Muller, Popescu, "Tight and rigorous error bounds for basic
//! building blocks of double-word arithmetic", ACM TOMS 44 (2017); their numbers are given with the
//! code. With `u = 2^-53`: sums are right to 3 u^2 of the exact sum (also under cancellation),
//! products to 5 u^2, quotients to 10 u^2.
//!
//! Written here because no crate reaches this precision: `twofloat` 0.8.4 divides with a rounded
//! remainder (measured: 2e-16, as an f64) and its `sin(1)` is off by 6e-24; `qd` 0.8.0 has no
//! sine. Overflow, underflow and signed zeros are not cared for: the suites stay far from them.

// Operations are calls in builds with assertions: suites that compute in it are compiled without an optimiser, this
// crate is not.

mod sin_cos;

use core::ops::{Add, Div, Mul, Neg, Sub};

use precess_dynamics::{Angle, Real, Scalar};

/// The sum `high + low`, with `|low|` at most half a unit in the last place of `high`.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct DoubleDouble {
    high: f64,
    low: f64,
}

impl DoubleDouble {
    /// The exact sum of two `f64`.
    #[must_use]
    pub fn sum(a: f64, b: f64) -> Self {
        let (high, low) = two_sum(a, b);
        Self { high, low }
    }

    /// The leading part: the value rounded to `f64`.
    #[must_use]
    pub const fn high(self) -> f64 {
        self.high
    }

    /// What `high` leaves out.
    #[must_use]
    pub const fn low(self) -> f64 {
        self.low
    }

    /// Algorithm 9 (`DWTimesFP3`): product with an `f64`.
    fn times(self, factor: f64) -> Self {
        let (high, low) = two_product(self.high, factor);
        quick_two_sum(high, self.low.mul_add(factor, low))
    }

    /// Algorithm 4 (`DWPlusFP`): sum with an `f64`.
    fn plus(self, term: f64) -> Self {
        let (high, low) = two_sum(self.high, term);
        quick_two_sum(high, self.low + low)
    }
}

/// Algorithm 2 (Knuth): `a + b = s + e` exactly.
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let a_part = s - b;
    let b_part = s - a_part;
    (s, (a - a_part) + (b - b_part))
}

/// Algorithm 1 (Dekker): as [`two_sum`], where `|a| >= |b|` or `a` is zero.
fn quick_two_sum(a: f64, b: f64) -> DoubleDouble {
    let high = a + b;
    DoubleDouble { high, low: b - (high - a) }
}

/// Algorithm 3: `a b = p + e` exactly; `f64::mul_add` rounds once on every target.
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let p = a * b;
    (p, a.mul_add(b, -p))
}

impl Add for DoubleDouble {
    type Output = Self;

    /// Algorithm 6 (`AccurateDWPlusDW`).
    #[cfg_attr(debug_assertions, inline(never))]
    fn add(self, other: Self) -> Self {
        let (s, s_error) = two_sum(self.high, other.high);
        let (t, t_error) = two_sum(self.low, other.low);
        let v = quick_two_sum(s, s_error + t);
        quick_two_sum(v.high, t_error + v.low)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;

    #[cfg_attr(debug_assertions, inline(never))]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for DoubleDouble {
    type Output = Self;

    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Mul for DoubleDouble {
    type Output = Self;

    /// Algorithm 12 (`DWTimesDW3`).
    #[cfg_attr(debug_assertions, inline(never))]
    fn mul(self, other: Self) -> Self {
        let (high, low) = two_product(self.high, other.high);
        let cross = self.high.mul_add(other.low, self.low * other.low);
        let cross = self.low.mul_add(other.high, cross);
        quick_two_sum(high, low + cross)
    }
}

impl Div for DoubleDouble {
    type Output = Self;

    /// Algorithm 18 (`DWDivDW3`).
    #[expect(clippy::suspicious_arithmetic_impl, reason = "the algorithm multiplies by 1 / other")]
    #[cfg_attr(debug_assertions, inline(never))]
    fn div(self, other: Self) -> Self {
        self * other.recip()
    }
}

impl Real for DoubleDouble {
    /// The reciprocal inside algorithm 18: one Newton step from the `f64` reciprocal, with the
    /// remainder `1 - high * t` exact by fused multiply-add.
    #[cfg_attr(debug_assertions, inline(never))]
    fn recip(self) -> Self {
        let t = self.high.recip();
        let remainder = quick_two_sum((-self.high).mul_add(t, 1.0), -(self.low * t));
        remainder.times(t).plus(t)
    }

    fn like(self, value: f64) -> Self {
        Self::from_f64(value)
    }
}

impl Angle for DoubleDouble {
    #[cfg_attr(debug_assertions, inline(never))]
    fn sin_cos(self) -> (Self, Self) {
        sin_cos::sin_cos(self)
    }
}

impl Scalar for DoubleDouble {
    const ZERO: Self = Self { high: 0.0, low: 0.0 };
    /// `2^-104`: what `2^-52` is to `f64`, with a factor of two for the bounds above.
    const EPSILON: Self = Self { high: f64::EPSILON * f64::EPSILON, low: 0.0 };

    fn from_f64(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }

    fn to_f64(self) -> f64 {
        self.high + self.low
    }

    /// Karp and Markstein: one Newton step from the `f64` root.
    #[cfg_attr(debug_assertions, inline(never))]
    fn sqrt(self) -> Self {
        if self.high == 0.0 {
            return self;
        }
        let root = self.high.sqrt();
        let (square, square_error) = two_product(root, root);
        let remainder = self - Self { high: square, low: square_error };
        Self::sum(root, remainder.high / (2.0 * root))
    }

    fn is_finite(self) -> bool {
        self.high.is_finite() && self.low.is_finite()
    }
}

#[cfg(test)]
mod tests;
