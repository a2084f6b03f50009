//! [`Dispatched`]: the joints of one device eliminated in the one function that may use the
//! instructions of the CPU at hand.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use pulp::{Simd, WithSimd};

use crate::equations::eliminate::DeviceElimination;
use crate::equations::error::SolveError;
use crate::equations::sines::Sines;
use crate::generated::hub::HubShare;
use crate::model::kind::Kind;
use crate::numbers::real::Scalar;

/// One device.
pub(crate) struct Dispatched<'a, K: Kind> {
    pub(crate) of: DeviceElimination<'a, K>,
    /// Where the share of the hub's equations is written.
    pub(crate) share: &'a mut Option<HubShare<K::Scalar>>,
}

impl<K: Kind> WithSimd for Dispatched<'_, K> {
    type Output = Result<(), SolveError<K::Scalar>>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Self { of, share } = self;
        of.run(
            #[inline(always)]
            |inputs, pose, _, gains| {
                let pose = pose.unwrap_or_else(|| pose_in_lanes::<K, S>(simd, inputs.joints));
                let eliminated = inputs.eliminated(&pose);
                // Written where they belong: moving so many numbers afterwards takes time.
                *share = Some(*K::share(&eliminated));
                *gains = Some(*K::gains(&eliminated));
                K::pivots(&eliminated)
            },
        )
    }
}

/// Sines and cosines in lanes, where they have the bits of one after another.
#[inline(always)]
fn pose_in_lanes<K: Kind, S: Simd>(simd: S, joints: &K::Joints<K::Scalar>) -> K::Pose<K::Scalar> {
    let sines = if K::Scalar::IS_F64 {
        Sines::of::<K, _, S>(simd, joints, K::Scalar::to_f64)
    } else {
        None
    };
    match sines {
        Some(sines) => K::pose_by(joints, |joint, _| sines.at(joint, K::Scalar::from_f64)),
        None => K::pose(joints),
    }
}
