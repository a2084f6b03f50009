//! A scalar that counts its operations: what an evaluation takes, of the arithmetic as it is run.
//!
//! The table `docs/operations.md` counts what is written in the emitted text; this counts the
//! solver's own work with it. Comparisons, copies and constants count nothing, and neither do the
//! checks that ask for a magnitude or a maximum, which are comparisons, too.

use core::cell::Cell;
use core::ops::{Add, Mul, Neg, Sub};

use precess_dynamics::{Angle, Real, Scalar};

/// Operations by what they are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    /// Products.
    pub mul: u64,
    /// Sums and differences.
    pub add: u64,
    /// Changes of sign.
    pub neg: u64,
    /// Reciprocals.
    pub recip: u64,
    /// Pairs of sine and cosine.
    pub sin_cos: u64,
    /// Square roots.
    pub sqrt: u64,
}

impl Operations {
    /// Arithmetic operations, sines and cosines apart. A change of sign is none: it is a bit, and
    /// mostly the sum that takes it becomes a difference.
    #[must_use]
    pub const fn arithmetic(self) -> u64 {
        self.mul + self.add + self.recip + self.sqrt
    }
}

thread_local! {
    static COUNT: Cell<Operations> = Cell::default();
}

/// What is computed in [`Counted`] numbers meanwhile, by this thread.
pub fn count<R>(work: impl FnOnce() -> R) -> (R, Operations) {
    COUNT.set(Operations::default());
    let result = work();
    (result, COUNT.get())
}

/// Adds one to a count.
fn tick(of: impl FnOnce(&mut Operations) -> &mut u64) {
    let mut count = COUNT.get();
    *of(&mut count) += 1;
    COUNT.set(count);
}

/// An `f64` whose operations are counted.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Counted(f64);

impl Add for Counted {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        tick(|count| &mut count.add);
        Self(self.0 + other.0)
    }
}

impl Sub for Counted {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        tick(|count| &mut count.add);
        Self(self.0 - other.0)
    }
}

impl Mul for Counted {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        tick(|count| &mut count.mul);
        Self(self.0 * other.0)
    }
}

impl Neg for Counted {
    type Output = Self;

    fn neg(self) -> Self {
        tick(|count| &mut count.neg);
        Self(-self.0)
    }
}

impl Real for Counted {
    fn recip(self) -> Self {
        tick(|count| &mut count.recip);
        Self(self.0.recip())
    }

    /// A product and a sum, fused or not.
    fn mul_add(self, a: Self, b: Self) -> Self {
        self * a + b
    }

    fn like(self, value: f64) -> Self {
        Self(value)
    }
}

impl Angle for Counted {
    fn sin_cos(self) -> (Self, Self) {
        tick(|count| &mut count.sin_cos);
        let (sin, cos) = self.0.sin_cos();
        (Self(sin), Self(cos))
    }
}

impl Scalar for Counted {
    const EPSILON: Self = Self(f64::EPSILON);

    fn from_f64(value: f64) -> Self {
        Self(value)
    }

    fn to_f64(self) -> f64 {
        self.0
    }

    fn sqrt(self) -> Self {
        tick(|count| &mut count.sqrt);
        Self(self.0.sqrt())
    }

    fn is_finite(self) -> bool {
        self.0.is_finite()
    }

    fn abs(self) -> Self {
        Self(self.0.abs())
    }
}

#[cfg(test)]
mod tests {
    use super::{Counted, Operations, Real, count};

    #[test]
    fn every_operation_counts_once() {
        let [a, b] = [3.0, 2.0].map(Counted);
        let (_, found) = count(|| -((a + b) * (a - b)).recip().mul_add(a, b));
        assert_eq!(found, Operations { mul: 2, add: 3, neg: 1, recip: 1, ..Operations::default() });
    }
}
