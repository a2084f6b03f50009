//! What the kernels need of a number.

use core::ops::{Add, Mul, Neg, Sub};

/// A number that kernels compute with. Product and sum are rounded one after the other, so results
/// are the same on every target.
pub trait Real:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// `1 / self`.
    #[must_use]
    fn recip(self) -> Self;
    /// A constant of the same kind.
    #[must_use]
    fn like(self, value: f64) -> Self;
}

impl Real for f64 {
    #[inline(always)]
    fn recip(self) -> Self {
        1.0 / self
    }
    #[inline(always)]
    fn like(self, value: f64) -> Self {
        value
    }
}

impl Real for f32 {
    #[inline(always)]
    fn recip(self) -> Self {
        1.0 / self
    }
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "the constants are halves")]
    fn like(self, value: f64) -> Self {
        value as Self
    }
}
