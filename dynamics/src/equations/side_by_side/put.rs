//! What is given of the joints of a device put into one lane, in place: a block that is moved while its
//! lanes are written one by one costs more than an evaluation.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use nalgebra::Vector3;

use crate::equations::device::Drives;
use crate::model::kind::{Kind, Wrenches};
use crate::model::mode::Drive;
use crate::model::wrench::Wrench;
use crate::numbers::each::Each;
use crate::numbers::laned::Block;
use crate::numbers::real::Scalar;

/// No wrench in any lane.
pub(crate) const NO_WRENCH: Wrench<Block> = Wrench {
    force: Vector3::new(Block::ZERO, Block::ZERO, Block::ZERO),
    moment: Vector3::new(Block::ZERO, Block::ZERO, Block::ZERO),
};

/// Puts torques and modes into one lane.
#[inline(always)]
pub(crate) fn put_drives<K: Kind>(
    blocks: &mut K::PerJoint<Drive<Block>>,
    lane: usize,
    drives: &Drives<K>,
) {
    for (blocks, drive) in blocks.values_mut().zip(drives.values()) {
        blocks.torque.put(lane, drive.torque.to_f64());
        blocks.driven.put(lane, drive.driven.to_f64());
        blocks.held.put(lane, drive.held.to_f64());
        blocks.given.put(lane, drive.given.to_f64());
    }
}

/// Puts wrenches on bodies into one lane.
#[inline(always)]
pub(crate) fn put_wrenches<K: Kind>(
    blocks: &mut K::PerJoint<Wrench<Block>>,
    lane: usize,
    wrenches: &Wrenches<K>,
) {
    for (blocks, wrench) in blocks.values_mut().zip(wrenches.values()) {
        blocks.force.x.put(lane, wrench.force.x.to_f64());
        blocks.force.y.put(lane, wrench.force.y.to_f64());
        blocks.force.z.put(lane, wrench.force.z.to_f64());
        blocks.moment.x.put(lane, wrench.moment.x.to_f64());
        blocks.moment.y.put(lane, wrench.moment.y.to_f64());
        blocks.moment.z.put(lane, wrench.moment.z.to_f64());
    }
}
