//! [`Arithmetic`]: how an evaluation is rounded, and [`Rounding`], what that is for one device.

#![expect(
    clippy::inline_always,
    reason = "fused numbers reach their instruction only where inlined"
)]

use crate::equations::assembly::Assembly;
use crate::equations::device::Device;
use crate::equations::error::SolveError;
use crate::equations::joint_inputs::{DeviceInputs, Environment};
use crate::generated::hub::BodyRate;
use crate::model::kernels::Kernels;
use crate::model::kind::Kind;
use crate::model::mode::Drive;
use crate::numbers::each::Value;
#[cfg(feature = "lanes")]
use crate::numbers::real::Scalar;
use crate::numbers::real::{Angle, Real};

/// How products and sums of an evaluation are rounded.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Arithmetic {
    /// One by one: the same bits on every target.
    Unfused,
    /// A product and a sum once in the devices' equations, by instructions of this CPU.
    #[cfg(feature = "lanes")]
    Fused(pulp::Arch),
}

#[cfg(feature = "lanes")]
impl Arithmetic {
    /// Fused if this CPU has the instruction; without it, fused products would be slow.
    pub(crate) fn fused() -> Self {
        let cpu = pulp::Arch::new();
        if matches!(cpu, pulp::Arch::Scalar) { Self::Unfused } else { Self::Fused(cpu) }
    }
}

/// Fused or unfused elimination of one device: that of one [`Arithmetic`].
pub(crate) trait Rounding {
    /// Eliminates the joints; see [`Device::eliminate_joints`].
    ///
    /// # Errors
    ///
    /// The first [`SolveError`].
    fn eliminate_device<K: Kind>(
        device: &Device<K>,
        joints: &K::Joints<K::Scalar>,
        given: DeviceInputs<'_, K>,
        environment: &Environment<K::Scalar>,
        outputs: EliminationOutputs<'_, K, K::Scalar>,
        index: usize,
    ) -> Result<(), SolveError<K::Scalar>>;
}

/// Product and sum one by one.
#[derive(Debug)]
pub(crate) struct Unfused;

impl Rounding for Unfused {
    // Never inlined: one copy of the kernel for all sets.
    #[inline(never)]
    fn eliminate_device<K: Kind>(
        device: &Device<K>,
        joints: &K::Joints<K::Scalar>,
        given: DeviceInputs<'_, K>,
        environment: &Environment<K::Scalar>,
        outputs: EliminationOutputs<'_, K, K::Scalar>,
        index: usize,
    ) -> Result<(), SolveError<K::Scalar>> {
        device.eliminate_joints(
            joints,
            given,
            environment,
            outputs,
            index,
            #[expect(
                clippy::redundant_closure_for_method_calls,
                reason = "one method has only one lifetime"
            )]
            |inputs, pose, outputs| inputs.evaluate_unfused(pose, outputs),
        )
    }
}

/// Product and sum at once. Part of what calls it, which may use the instruction.
#[cfg(feature = "lanes")]
#[derive(Debug)]
pub(crate) struct FusedMultiplyAdd;

#[cfg(feature = "lanes")]
impl Rounding for FusedMultiplyAdd {
    #[inline(always)]
    fn eliminate_device<K: Kind>(
        device: &Device<K>,
        joints: &K::Joints<K::Scalar>,
        given: DeviceInputs<'_, K>,
        environment: &Environment<K::Scalar>,
        outputs: EliminationOutputs<'_, K, K::Scalar>,
        index: usize,
    ) -> Result<(), SolveError<K::Scalar>> {
        device.eliminate_joints(
            joints,
            given,
            environment,
            outputs,
            index,
            #[inline(always)]
            |inputs, pose, outputs| {
                if K::Scalar::IS_F64 {
                    crate::equations::fused::evaluate(inputs, outputs)
                } else {
                    inputs.evaluate_unfused(pose, outputs)
                }
            },
        )
    }
}

/// What the kernel `eliminate` takes of one device.
#[derive(Debug)]
pub(crate) struct EliminationInputs<'a, K: Kernels, T: Value> {
    pub(crate) constants: &'a K::Constants<T>,
    pub(crate) joints: &'a K::Joints<T>,
    pub(crate) omega: BodyRate<T>,
    pub(crate) drives: &'a K::PerJoint<Drive<T>>,
}

/// Where the results are written: moving so many numbers afterwards takes time.
#[derive(Debug)]
pub(crate) struct EliminationOutputs<'a, K: Kernels, T: Value> {
    pub(crate) assembly: &'a mut Assembly<T>,
    pub(crate) gains: &'a mut Option<K::Gains<T>>,
}

/// Pivot and diagonal of each driven joint.
pub(crate) type Pivots<K, T> = <K as Kernels>::PerJoint<Option<[T; 2]>>;

impl<K: Kernels, T: Angle> EliminationInputs<'_, K, T> {
    /// Eliminates the joints, whose sines may be known, by the numbers as they are.
    #[inline(always)]
    pub(crate) fn evaluate_unfused(
        &self,
        pose: Option<K::Pose<T>>,
        outputs: EliminationOutputs<'_, K, T>,
    ) -> Pivots<K, T> {
        let pose = pose.unwrap_or_else(|| K::pose(self.joints));
        self.evaluate(&pose, |number| number, outputs)
    }

    /// Eliminates the joints by numbers that are written to `outputs` as others.
    #[inline(always)]
    pub(crate) fn evaluate<U: Real>(
        &self,
        pose: &K::Pose<T>,
        number: impl Fn(T) -> U,
        outputs: EliminationOutputs<'_, K, U>,
    ) -> Pivots<K, U> {
        let Self { constants, joints, omega, drives } = self;
        let eliminated = K::eliminate(constants, pose, joints, omega, drives);
        let EliminationOutputs { assembly, gains: kept } = outputs;
        assembly.add(&K::share(&eliminated).map(&number));
        let gains = K::gains(&eliminated);
        *kept = Some(K::zip_gains(gains, gains, |gain, _| number(gain)));
        let pivots = K::pivots(&eliminated);
        K::zip_per_joint(&pivots, &pivots, |pivot, _| pivot.map(|pivot| pivot.map(&number)))
    }
}
