//! [`Fused`]: one number whose products and sums are rounded once, by the CPU's own instruction.

#![expect(clippy::inline_always, reason = "one reaches the instruction only in what is inlined")]

use core::ops::{Add, Mul, Neg, Sub};

use crate::numbers::real::{Angle, Real};
use crate::numbers::sincos::{LARGEST_ANGLE, QuarterTurns, sin_cos};

/// An `f64` that is fused. Where the CPU has no such instruction, or a caller does not use it, the
/// result is the same and takes long.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Fused(pub(crate) f64);

macro_rules! operation {
    ($trait:ident, $function:ident) => {
        impl $trait for Fused {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self($trait::$function(self.0, other.0))
            }
        }
    };
}

operation!(Add, add);
operation!(Sub, sub);
operation!(Mul, mul);

impl Neg for Fused {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Real for Fused {
    #[inline(always)]
    fn recip(self) -> Self {
        Self(1.0 / self.0)
    }

    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        Self(f64::mul_add(self.0, a.0, b.0))
    }

    #[inline(always)]
    fn like(self, value: f64) -> Self {
        Self(value)
    }
}

impl QuarterTurns for Fused {
    #[inline(always)]
    fn turned(count: Self, sine: Self, cosine: Self) -> (Self, Self) {
        let (sine, cosine) = QuarterTurns::turned(count.0, sine.0, cosine.0);
        (Self(sine), Self(cosine))
    }
}

impl Angle for Fused {
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        if self.0.abs() <= LARGEST_ANGLE {
            return sin_cos(self);
        }
        let (sine, cosine) = libm::sincos(self.0);
        (Self(sine), Self(cosine))
    }
}
