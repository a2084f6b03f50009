//! A scalar that counts its operations: what an evaluation takes, of the arithmetic as it is run,
//! and the longest chain of operations that wait for each other.
//!
//! The table `docs/operations.md` counts what is written in the emitted text; this counts the
//! solver's own work with it. Comparisons, copies and constants count nothing, and neither do the
//! checks that take a magnitude or a maximum, which are comparisons, too.

use core::cell::Cell;
use core::cmp::Ordering;
use core::ops::{Add, Mul, Neg, Sub};

use precess_dynamics::{Angle, Real, Scalar};

/// Operations of an evaluation, sines and cosines apart: what a hub takes, and each DGVSCMG on it. The
/// tests `dynamics/operations.rs` assert them.
pub const EVALUATION: [u64; 2] = [276, 907];

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

/// How long the result of an operation is waited for, ns.
#[derive(Clone, Copy, Debug, Default)]
pub struct Latencies {
    /// Of a product.
    pub mul: f64,
    /// Of a sum.
    pub add: f64,
    /// Of a reciprocal.
    pub recip: f64,
    /// Of a sine and a cosine.
    pub sin_cos: f64,
}

thread_local! {
    static COUNT: Cell<Operations> = Cell::default();
    static LATENCIES: Cell<Latencies> = Cell::default();
}

/// What is computed in [`Counted`] numbers meanwhile, by this thread.
pub fn count<R>(work: impl FnOnce() -> R) -> (R, Operations) {
    COUNT.set(Operations::default());
    let result = work();
    (result, COUNT.get())
}

/// Every number computed meanwhile by this thread has the time at which it was ready: see
/// [`Counted::ready`].
pub fn timed<R>(latencies: Latencies, work: impl FnOnce() -> R) -> R {
    LATENCIES.set(latencies);
    let result = work();
    LATENCIES.set(Latencies::default());
    result
}

/// Adds one to a count.
fn tick(of: impl FnOnce(&mut Operations) -> &mut u64) {
    let mut count = COUNT.get();
    *of(&mut count) += 1;
    COUNT.set(count);
}

/// An `f64` whose operations are counted.
#[derive(Clone, Copy, Debug)]
pub struct Counted {
    value: f64,
    ready: f64,
}

impl Counted {
    /// When it was ready, ns, if every operation ran as soon as it could: the longest chain of
    /// operations before it. Of constants, zero.
    #[must_use]
    pub fn ready(self) -> f64 {
        self.ready
    }

    /// A number that was there from the start.
    const fn given(value: f64) -> Self {
        Self { value, ready: 0.0 }
    }

    /// The result of an operation that had to wait for its operands.
    fn after<const N: usize>(value: f64, operands: [Self; N], time: fn(&Latencies) -> f64) -> Self {
        let start = operands.iter().map(|operand| operand.ready).fold(0.0, f64::max);
        Self { value, ready: start + time(&LATENCIES.get()) }
    }
}

impl PartialEq for Counted {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl PartialOrd for Counted {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl Add for Counted {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        tick(|count| &mut count.add);
        Self::after(self.value + other.value, [self, other], |time| time.add)
    }
}

impl Sub for Counted {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        tick(|count| &mut count.add);
        Self::after(self.value - other.value, [self, other], |time| time.add)
    }
}

impl Mul for Counted {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        tick(|count| &mut count.mul);
        Self::after(self.value * other.value, [self, other], |time| time.mul)
    }
}

impl Neg for Counted {
    type Output = Self;

    fn neg(self) -> Self {
        tick(|count| &mut count.neg);
        Self { value: -self.value, ..self }
    }
}

impl Real for Counted {
    fn recip(self) -> Self {
        tick(|count| &mut count.recip);
        Self::after(self.value.recip(), [self], |time| time.recip)
    }

    fn like(self, value: f64) -> Self {
        Self::given(value)
    }
}

impl Angle for Counted {
    fn sin_cos(self) -> (Self, Self) {
        tick(|count| &mut count.sin_cos);
        let (sin, cos) = self.value.sin_cos();
        let found = [sin, cos].map(|value| Self::after(value, [self], |time| time.sin_cos));
        found.into()
    }
}

impl Scalar for Counted {
    const ZERO: Self = Self::given(0.0);
    const EPSILON: Self = Self::given(f64::EPSILON);

    fn from_f64(value: f64) -> Self {
        Self::given(value)
    }

    fn to_f64(self) -> f64 {
        self.value
    }

    fn sqrt(self) -> Self {
        tick(|count| &mut count.sqrt);
        Self::after(self.value.sqrt(), [self], |time| time.recip)
    }

    fn is_finite(self) -> bool {
        self.value.is_finite()
    }

    fn abs(self) -> Self {
        Self { value: self.value.abs(), ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::{Counted, Latencies, Operations, Real, count, timed};

    #[test]
    fn every_operation_counts_once() {
        let [a, b] = [3.0, 2.0].map(Counted::given);
        let (_, found) = count(|| -(((a + b) * (a - b)).recip() * a + b));
        assert_eq!(found, Operations { mul: 2, add: 3, neg: 1, recip: 1, ..Operations::default() });
    }
    #[test]
    fn result_is_ready_after_the_longest_chain() {
        let [a, b] = [3.0, 2.0].map(Counted::given);
        let latencies = Latencies { mul: 4.0, add: 3.0, recip: 5.0, sin_cos: 60.0 };
        let found = timed(latencies, || (a + b) * (a * b * b) + a.recip());
        assert_eq!(found.ready(), 4.0 + 4.0 + 4.0 + 3.0);
    }
}
