//! [`Fused`]: one number whose products and sums are rounded once, by the CPU's own instruction.

#![expect(clippy::inline_always, reason = "one reaches the instruction only in what is inlined")]

use core::ops::{Add, Mul, Neg, Sub};

use pulp::{Simd, WithSimd};

use crate::attitude::parameterisation::Attitude;
use crate::generated::hub::BodyRate;
use crate::model::kernels::Kernels;
use crate::model::spacecraft::Spacecraft;
use crate::numbers::real::{Angle, Real};
use crate::numbers::sincos::{LARGEST_ANGLE, QuarterTurns, sin_cos};
use crate::sets::devices::Devices;
use crate::solve::arithmetic::{Asked, AtOnce, Pivots, Places};
use crate::solve::assembly::along_b;
use crate::solve::error::SolveError;
use crate::solve::inputs::Inputs;
use crate::solve::stability::Stiffness;
use crate::solve::state::{Accelerations, State};

/// An `f64` that is fused. Where the CPU has no such instruction, or a caller does not use it, the
/// result is the same and takes long.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Fused(pub(crate) f64);

/// An evaluation by fused numbers.
pub(crate) struct Solving<'a, D: Devices, A> {
    pub(crate) craft: &'a Spacecraft<D>,
    pub(crate) state: &'a State<D, A>,
    pub(crate) inputs: &'a Inputs<D>,
    pub(crate) found: &'a mut Accelerations<D>,
    pub(crate) stiffness: Option<&'a mut Stiffness<D::Scalar>>,
}

impl<D: Devices, A: Attitude<D::Scalar>> WithSimd for Solving<'_, D, A> {
    type Output = Result<(), SolveError<D::Scalar>>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Self::Output {
        let Self { craft, state, inputs, found, stiffness } = self;
        craft.solve_by::<_, AtOnce>(state, inputs, found, stiffness)
    }
}

/// Eliminates a device's joints by fused numbers.
#[inline(always)]
pub(crate) fn eliminate<K: Kernels>(
    asked: &Asked<'_, K, f64>,
    places: Places<'_, K, f64>,
) -> Pivots<K, f64> {
    let Asked { constants, joints, omega, drives } = asked;
    let constants = K::zip_constants(constants, constants, |number, _| Fused(number));
    let joints = K::zip_joints(joints, joints, |number, _| Fused(number));
    let drives = K::zip_per_joint(drives, drives, |drive, _| drive.map(Fused));
    let BodyRate { omega_bx, omega_by, omega_bz } = *omega;
    let omega = along_b([omega_bx, omega_by, omega_bz].map(Fused));
    let asked = Asked::<K, _> { constants: &constants, joints: &joints, omega, drives: &drives };
    asked.eliminate(&K::pose(&joints), |Fused(number)| number, places)
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
