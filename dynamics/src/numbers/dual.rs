//! [`Dual`]: a number with derivatives, for every function that is generic over [`Scalar`].
//!
//! Invariant: the value of a result has the bits that the same operations give without derivatives,
//! because it is computed by the same operations and every comparison is one of values.
//!
//! Operations are calls that take references: the kernels of all kinds have thousands of operations.
//! Inlined, a product of six derivatives takes twenty instructions: five times the code, minutes to
//! compile, for a tenth of the time.

use core::cmp::Ordering;
use core::ops::{Add, Mul, Neg, Sub};

use crate::numbers::real::{Angle, Real, Scalar};

/// A number and its derivatives by `N` variables: `x + sum_k x_k e_k` with `e_j e_k = 0`.
///
/// Sums, products, reciprocals, roots, sines and cosines follow the rules of differentiation, so
/// a function over `Dual` returns its value and its exact derivatives, each to rounding. Two
/// numbers are compared by their values; where a function branches, the derivatives are those of the
/// branch that the value takes.
///
/// ```
/// use precess_dynamics::{Angle, Dual};
///
/// // x² sin(x) at x = 2 has the derivative 2 x sin(x) + x² cos(x).
/// let x = Dual::<f64, 1>::variable(2.0, 0);
/// let (sine, _) = x.sin_cos();
/// let [derivative] = (x * x * sine).derivatives;
/// assert!((derivative - (4.0 * 2_f64.sin() + 4.0 * 2_f64.cos())).abs() < 1e-14);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Dual<T, const N: usize> {
    /// The number.
    pub value: T,
    /// Its derivatives.
    pub derivatives: [T; N],
}

impl<T: Scalar, const N: usize> Dual<T, N> {
    /// A number that depends on no variable.
    #[inline]
    #[must_use]
    pub fn constant(value: T) -> Self {
        Self { value, derivatives: [T::ZERO; N] }
    }

    /// The variable of a number from 0, at a value: its own derivative is one. A constant where
    /// there are not so many variables.
    #[inline]
    #[must_use]
    pub fn variable(value: T, number: usize) -> Self {
        let mut variable = Self::constant(value);
        variable.add_derivative(number, T::from_f64(1.0));
        variable
    }

    /// Adds to the derivative by the variable of a number; nothing where there are not so many.
    #[inline]
    pub fn add_derivative(&mut self, number: usize, derivative: T) {
        if let Some(to) = self.derivatives.get_mut(number) {
            *to = *to + derivative;
        }
    }

    /// The derivative by the variable of a number; zero where there are not so many.
    #[inline]
    #[must_use]
    pub fn derivative(&self, number: usize) -> T {
        self.derivatives.get(number).copied().unwrap_or(T::ZERO)
    }

    /// A value, with each derivative changed.
    #[inline]
    fn mapped(&self, value: T, change: impl Fn(T) -> T) -> Self {
        Self { value, derivatives: self.derivatives.map(change) }
    }

    /// A value, with the derivatives of two numbers joined one by one.
    #[inline]
    fn joined(&self, other: &Self, value: T, join: impl Fn(T, T) -> T) -> Self {
        let mut derivatives = self.derivatives;
        for (derivative, other) in derivatives.iter_mut().zip(other.derivatives) {
            *derivative = join(*derivative, other);
        }
        Self { value, derivatives }
    }

    #[inline(never)]
    fn sum(&self, other: &Self) -> Self {
        self.joined(other, self.value + other.value, |a, b| a + b)
    }

    #[inline(never)]
    fn difference(&self, other: &Self) -> Self {
        self.joined(other, self.value - other.value, |a, b| a - b)
    }

    #[inline(never)]
    fn product(&self, other: &Self) -> Self {
        let (x, y) = (self.value, other.value);
        self.joined(other, x * y, |a, b| x * b + a * y)
    }

    #[inline(never)]
    fn reciprocal(&self) -> Self {
        let value = self.value.recip();
        self.mapped(value, |a| -(a * value * value))
    }
}

/// By value.
impl<T: Scalar, const N: usize> PartialEq for Dual<T, N> {
    #[inline]
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

/// By value.
impl<T: Scalar, const N: usize> PartialOrd for Dual<T, N> {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl<T: Scalar, const N: usize> Add for Dual<T, N> {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        self.sum(&other)
    }
}

impl<T: Scalar, const N: usize> Sub for Dual<T, N> {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self.difference(&other)
    }
}

impl<T: Scalar, const N: usize> Neg for Dual<T, N> {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        self.mapped(-self.value, |a| -a)
    }
}

impl<T: Scalar, const N: usize> Mul for Dual<T, N> {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        self.product(&other)
    }
}

impl<T: Scalar, const N: usize> Real for Dual<T, N> {
    #[inline]
    fn recip(self) -> Self {
        self.reciprocal()
    }

    #[inline]
    fn like(self, value: f64) -> Self {
        Self::constant(self.value.like(value))
    }
}

impl<T: Scalar, const N: usize> Angle for Dual<T, N> {
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = self.value.sin_cos();
        (self.mapped(sine, |a| a * cosine), self.mapped(cosine, |a| -(a * sine)))
    }
}

impl<T: Scalar, const N: usize> Scalar for Dual<T, N> {
    const ZERO: Self = Self { value: T::ZERO, derivatives: [T::ZERO; N] };
    const EPSILON: Self = Self { value: T::EPSILON, derivatives: [T::ZERO; N] };

    #[inline]
    fn from_f64(value: f64) -> Self {
        Self::constant(T::from_f64(value))
    }

    #[inline]
    fn to_f64(self) -> f64 {
        self.value.to_f64()
    }

    /// The root of a constant zero is a constant zero; that of another zero has infinite
    /// derivatives.
    fn sqrt(self) -> Self {
        let value = self.value.sqrt();
        let slope = (value + value).recip();
        self.mapped(value, |a| if a == T::ZERO { a } else { a * slope })
    }

    /// Of the value and of every derivative.
    fn is_finite(self) -> bool {
        self.value.is_finite() && self.derivatives.into_iter().all(Scalar::is_finite)
    }

    fn vanishes(self) -> bool {
        self.value.vanishes() && self.derivatives.into_iter().all(Scalar::vanishes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Number = Dual<f64, 2>;

    fn x() -> Number {
        Number::variable(0.7, 0)
    }

    fn y() -> Number {
        Number::variable(-1.3, 1)
    }

    /// A few units in the last place.
    const ROUNDING: f64 = 4e-16;

    #[track_caller]
    fn assert_is(found: Number, value: f64, derivatives: [f64; 2]) {
        assert_eq!(found.value.to_bits(), value.to_bits());
        for (found, expected) in found.derivatives.into_iter().zip(derivatives) {
            let bound = ROUNDING * expected.abs().max(1.0);
            assert!((found - expected).abs() <= bound, "{found} is not {expected}");
        }
    }

    #[test]
    fn operations_follow_the_rules_of_differentiation() {
        let (x0, y0) = (0.7_f64, -1.3_f64);
        assert_is(x() + y(), x0 + y0, [1.0, 1.0]);
        assert_is(x() - y(), x0 - y0, [1.0, -1.0]);
        assert_is(-x(), -x0, [-1.0, 0.0]);
        assert_is(x() * y(), x0 * y0, [y0, x0]);
        assert_is(x().recip(), 1.0 / x0, [-1.0 / (x0 * x0), 0.0]);
        assert_is(x() * y() + y(), x0 * y0 + y0, [y0, x0 + 1.0]);
        assert_is(x() - y() * y(), x0 - y0 * y0, [1.0, -2.0 * y0]);
        let (sine, cosine) = Angle::sin_cos(x0);
        assert_is(x().sin_cos().0, sine, [cosine, 0.0]);
        assert_is(x().sin_cos().1, cosine, [-sine, 0.0]);
        assert_is(Scalar::sqrt(x()), libm::sqrt(x0), [0.5 / libm::sqrt(x0), 0.0]);
        assert_is(Scalar::abs(y()), -y0, [0.0, -1.0]);
        assert_is(y().like(3.0), 3.0, [0.0, 0.0]);
    }

    #[test]
    fn values_alone_are_compared() {
        let zero = Number::variable(0.0, 0);
        assert!(zero == Number::ZERO && zero <= Number::ZERO && x() > y());
        assert!(!zero.vanishes() && Number::ZERO.vanishes());
    }

    #[test]
    fn root_of_a_constant_zero_is_constant() {
        assert_is(Scalar::sqrt(Number::ZERO), 0.0, [0.0, 0.0]);
        assert!(!Scalar::is_finite(Scalar::sqrt(Number::variable(0.0, 1))));
    }

    #[test]
    fn a_derivative_that_is_not_finite_is_noticed() {
        let mut number = x();
        assert!(Scalar::is_finite(number));
        number.add_derivative(1, f64::NAN);
        assert!(!Scalar::is_finite(number));
        number.add_derivative(2, 1.0);
        assert_eq!(number.derivative(2), 0.0);
    }
}
