//! [`Sines`]: sines and cosines of the joints of one device, side by side in lanes.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use pulp::Simd;

use crate::model::kernels::Kernels;
use crate::numbers::each::{JointStates, Value};
use crate::numbers::lane::Lane;
use crate::numbers::laned::{Block, Number, WIDEST};
use crate::numbers::real::Angle;
use crate::numbers::sincos::LARGEST_ANGLE;

/// Sine and cosine of each joint's angle.
pub(crate) struct Sines {
    sines: Block,
    cosines: Block,
}

impl Sines {
    /// Those of the joints whose angle the equations depend on, with the bits of a single number.
    /// None of a single joint, which is quicker by itself, and where an angle is beyond those
    /// that lanes support.
    #[inline(always)]
    pub(crate) fn of<K: Kernels, T: Value, S: Simd>(
        simd: S,
        joints: &K::Joints<T>,
        number: impl Fn(T) -> f64,
    ) -> Option<Self> {
        let (mut angles, mut supported, mut count) = (Block::ZERO, true, 0);
        let _ = K::pose_by(joints, |joint, angle| {
            let value = number(angle);
            supported &= joint < WIDEST && value.abs() <= LARGEST_ANGLE;
            angles.put(joint, value);
            count += 1;
            (angle, angle)
        });
        if !supported || count < 2 {
            return None;
        }
        let zero = Lane::<S>::splat(simd, 0.0);
        let mut found = Self { sines: Block::ZERO, cosines: Block::ZERO };
        for start in (0..joints.states().count()).step_by(S::F64_LANES) {
            let mut block = Block::ZERO;
            (0..S::F64_LANES).for_each(|lane| block.put(lane, angles.at(start + lane)));
            let (sine, cosine) = zero.load(&block).sin_cos();
            let (sine, cosine) = (sine.store(), cosine.store());
            for lane in 0..S::F64_LANES {
                found.sines.put(start + lane, sine.at(lane));
                found.cosines.put(start + lane, cosine.at(lane));
            }
        }
        Some(found)
    }

    /// Sine and cosine of one joint's angle.
    #[inline(always)]
    pub(crate) fn at<T>(&self, joint: usize, number: impl Fn(f64) -> T) -> (T, T) {
        (number(self.sines.at(joint)), number(self.cosines.at(joint)))
    }
}
