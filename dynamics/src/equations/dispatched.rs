//! [`Dispatched`]: the joints of one device eliminated in the one function that may use the
//! instructions of the CPU at hand.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use pulp::{Simd, WithSimd};

use crate::equations::arithmetic::{EliminationInputs, Pivots};
use crate::equations::assembly::expressed_in_b;
use crate::equations::eliminate::DeviceElimination;
use crate::equations::error::SolveError;
use crate::equations::fused::Fused;
use crate::equations::sines::Sines;
use crate::generated::hub::{BodyRate, HubShare};
use crate::model::kernels::Kernels;
use crate::model::kind::Kind;
use crate::numbers::each::Value;
use crate::numbers::real::{Real, Scalar};

/// One device; `FUSED` with products and sums rounded once, if its numbers are `f64`.
pub(crate) struct Dispatched<'a, K: Kind, const FUSED: bool> {
    pub(crate) of: DeviceElimination<'a, K>,
    /// Where the share of the hub's equations is written.
    pub(crate) share: &'a mut Option<HubShare<K::Scalar>>,
}

impl<K: Kind, const FUSED: bool> WithSimd for Dispatched<'_, K, FUSED> {
    type Output = Result<(), SolveError<K::Scalar>>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Self { of, share } = self;
        of.run(
            #[inline(always)]
            |inputs, pose, _, gains| {
                let outputs = EliminationOutputs { share, gains };
                if FUSED && K::Scalar::IS_F64 {
                    return fused(simd, inputs, outputs);
                }
                let pose = pose.unwrap_or_else(|| unfused_pose::<K, S>(simd, inputs.joints));
                inputs.evaluate(&pose, |number| number, outputs)
            },
        )
    }
}

/// Sines and cosines in lanes, where they have the bits of one after another.
#[inline(always)]
fn unfused_pose<K: Kind, S: Simd>(simd: S, joints: &K::Joints<K::Scalar>) -> K::Pose<K::Scalar> {
    let sines = if K::Scalar::IS_F64 {
        Sines::of::<K, _, S, false>(simd, joints, K::Scalar::to_f64)
    } else {
        None
    };
    match sines {
        Some(sines) => K::pose_by(joints, |joint, _| sines.at(joint, K::Scalar::from_f64)),
        None => K::pose(joints),
    }
}

/// Eliminates a device's joints by fused numbers: for a scalar that converts to `f64` and back
/// exactly.
#[inline(always)]
fn fused<K: Kind, S: Simd>(
    simd: S,
    inputs: &EliminationInputs<'_, K, K::Scalar>,
    outputs: EliminationOutputs<'_, K, K::Scalar>,
) -> Pivots<K, K::Scalar> {
    let fused = |number: K::Scalar| Fused(number.to_f64());
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
    let pose = match Sines::of::<K, _, S, true>(simd, &joints, |Fused(number)| number) {
        Some(sines) => K::pose_by(&joints, |joint, _| sines.at(joint, Fused)),
        None => K::pose(&joints),
    };
    inputs.evaluate(&pose, |Fused(number)| K::Scalar::from_f64(number), outputs)
}

/// Where the results are written: moving so many numbers afterwards takes time.
#[derive(Debug)]
struct EliminationOutputs<'a, K: Kernels, T: Value> {
    /// The share of the hub's equations.
    share: &'a mut Option<HubShare<T>>,
    gains: &'a mut Option<K::Gains<T>>,
}

impl<K: Kernels, T: Real + Value> EliminationInputs<'_, K, T> {
    /// Eliminates the joints by numbers that are written to `outputs` as others.
    #[inline(always)]
    fn evaluate<U: Real>(
        &self,
        pose: &K::Pose<T>,
        number: impl Fn(T) -> U,
        outputs: EliminationOutputs<'_, K, U>,
    ) -> Pivots<K, U> {
        let eliminated = self.eliminated(pose);
        let EliminationOutputs { share, gains: kept } = outputs;
        *share = Some(K::share(&eliminated).map(&number));
        let gains = K::gains(&eliminated);
        *kept = Some(K::zip_gains(gains, gains, |gain, _| number(gain)));
        let pivots = K::pivots(&eliminated);
        K::zip_per_joint(&pivots, &pivots, |pivot, _| pivot.map(|pivot| pivot.map(&number)))
    }
}
