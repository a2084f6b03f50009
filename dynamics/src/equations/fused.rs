//! [`Fused`]: one number whose products and sums are rounded once, by the CPU's own instruction.

#![expect(clippy::inline_always, reason = "one reaches the instruction only in what is inlined")]

use core::ops::{Add, Mul, Neg, Sub};

use crate::equations::arithmetic::{EliminationInputs, EliminationOutputs, Pivots};
use crate::equations::assembly::expressed_in_b;
use crate::generated::hub::BodyRate;
use crate::model::kernels::Kernels;
use crate::numbers::real::{Angle, Real, Scalar};
use crate::numbers::sincos::{LARGEST_ANGLE, QuarterTurns, sin_cos};

/// An `f64` that is fused. Where the CPU has no such instruction, or a caller does not use it, the
/// result is the same and takes long.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Fused(pub(crate) f64);

/// Eliminates a device's joints by fused numbers: for a scalar that converts to `f64` and back
/// exactly.
#[inline(always)]
pub(crate) fn evaluate<K: Kernels, T: Scalar>(
    inputs: &EliminationInputs<'_, K, T>,
    outputs: EliminationOutputs<'_, K, T>,
) -> Pivots<K, T> {
    let fused = |number: T| Fused(number.to_f64());
    let EliminationInputs { constants, joints, omega, drives } = inputs;
    let constants = K::zip_constants(constants, constants, |number, _| fused(number));
    let joints = K::zip_joints(joints, joints, |number, _| fused(number));
    let drives = K::zip_per_joint(drives, drives, |drive, _| drive.map(fused));
    let BodyRate { omega_bx, omega_by, omega_bz } = *omega;
    let omega = expressed_in_b([omega_bx, omega_by, omega_bz].map(fused));
    let inputs = EliminationInputs::<K, _> {
        constants: &constants,
        joints: &joints,
        omega,
        drives: &drives,
    };
    inputs.evaluate(&K::pose(&joints), |Fused(number)| T::from_f64(number), outputs)
}

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
