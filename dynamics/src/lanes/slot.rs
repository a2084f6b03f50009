//! [`Slot`]: one device in lanes, and [`LanedSet`]: the slots of a whole set.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use super::gather::joints_in_lanes;
use super::number::{Block, Number, WIDEST};
use crate::equations::device::Device;
use crate::model::kernels::Kernels;
use crate::model::kind::Kind;
use crate::model::mode::Drive;
use crate::numbers::each::{Each, JointStates, Value};
use crate::numbers::real::Real;
use crate::sets::devices::{Devices, SetInputs};

/// One device in lanes: what it is given, and what an evaluation and a step make of it.
#[derive(Clone, Debug)]
pub struct Slot<K: Kernels, T: Value> {
    /// Coordinates and rates on their way out.
    pub(crate) block: K::Joints<Block>,
    /// Torques and modes on their way in.
    pub(crate) given: K::PerJoint<Drive<Block>>,
    /// Accelerations on their way out.
    pub(crate) out: K::Accelerations<Block>,
    /// Coordinates and rates where the step began.
    pub(crate) start: K::Joints<T>,
    /// Coordinates and rates now.
    pub(crate) joints: K::Joints<T>,
    /// What the step adds up to.
    pub(crate) sum: K::Joints<T>,
    /// Torques and modes, without what joints do by themselves.
    pub(crate) drives: K::PerJoint<Drive<T>>,
    /// What back substitution needs; none before the first evaluation.
    pub(crate) gains: Option<Aligned<K::Gains<T>>>,
    /// The accelerations.
    pub(crate) found: K::Accelerations<T>,
}

/// As aligned as the widest lanes: what is not is stored and loaded in two halves.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct Aligned<V>(pub(crate) V);

/// What is done with each device of a set.
pub trait Visit<T: Value> {
    /// Does it with one device.
    fn visit<K: Kind<Scalar = f64>>(&mut self, device: &Device<K>, slot: &mut Slot<K, T>);
}

/// A set of devices that can be evaluated in lanes: every kind, arrays, tuples, vectors.
pub trait LanedSet: Devices<Scalar = f64> {
    /// The devices in lanes.
    type Slots<T: Value>;

    /// Slots filled with a number.
    fn slots<T: Real>(devices: &Self::Prepared, fill: T) -> Self::Slots<T>;
    /// Each device in order.
    fn each<T: Value>(
        devices: &Self::Prepared,
        slots: &mut Self::Slots<T>,
        visitor: &mut impl Visit<T>,
    );
    /// Takes the joints of as many states in as the widest lanes have.
    fn load<T: Number>(
        devices: &Self::Prepared,
        slots: &mut Self::Slots<T>,
        like: T,
        joints: [&Self::Joints; WIDEST],
    );
    /// Puts what is given of the joints into one lane. False where a device or its modes are
    /// unsupported in lanes, or are rejected.
    fn put<T: Value>(
        devices: &Self::Prepared,
        slots: &mut Self::Slots<T>,
        lane: usize,
        joints: &Self::Joints,
        given: SetInputs<'_, Self>,
    ) -> bool;
    /// Takes the joints of one lane out.
    fn take_joints<T: Value>(slots: &mut Self::Slots<T>, lane: usize, joints: &mut Self::Joints);
    /// Takes the accelerations of one lane out.
    fn take_found<T: Value>(
        slots: &mut Self::Slots<T>,
        lane: usize,
        found: &mut Self::Accelerations,
    );
}

impl<K: Kind<Scalar = f64>> LanedSet for K {
    type Slots<T: Value> = Slot<K, T>;

    fn slots<T: Real>(_: &Device<K>, fill: T) -> Slot<K, T> {
        let rest = <K as Kind>::at_rest();
        let still = K::no_accelerations();
        let drive = <K as Kind>::all(Drive { torque: 0.0, driven: 0.0, held: 0.0, given: 0.0 });
        let joints = K::zip_joints(&rest, &rest, |_, _| fill);
        Slot {
            block: K::zip_joints(&rest, &rest, |_, _| Block::ZERO),
            given: K::zip_per_joint(&drive, &drive, |drive, _| drive.map(|_| Block::ZERO)),
            out: K::zip_accelerations(&still, &still, |_, _| Block::ZERO),
            start: joints,
            joints,
            sum: joints,
            drives: K::zip_per_joint(&drive, &drive, |drive, _| drive.map(|_| fill)),
            gains: None,
            found: K::zip_accelerations(&still, &still, |_, _| fill),
        }
    }

    #[inline(always)]
    fn each<T: Value>(device: &Device<K>, slot: &mut Slot<K, T>, visitor: &mut impl Visit<T>) {
        visitor.visit(device, slot);
    }

    #[inline(always)]
    fn load<T: Number>(
        _: &Device<K>,
        slot: &mut Slot<K, T>,
        like: T,
        joints: [&K::Joints<f64>; WIDEST],
    ) {
        slot.joints = joints_in_lanes::<K, T>(like, joints);
    }

    #[inline(always)]
    fn put<T: Value>(
        device: &Device<K>,
        slot: &mut Slot<K, T>,
        lane: usize,
        joints: &K::Joints<f64>,
        given: SetInputs<'_, Self>,
    ) -> bool {
        let Some(drives) = device.given_drives(joints, given) else { return false };
        put_drives::<K>(&mut slot.given, lane, &drives);
        true
    }

    #[inline(always)]
    fn take_joints<T: Value>(slot: &mut Slot<K, T>, lane: usize, joints: &mut K::Joints<f64>) {
        // The blocks in place: by value, each would be copied for one of its numbers.
        for (numbers, blocks) in joints.states_mut().zip(slot.block.states_mut()) {
            let ([q, q_dot], [coordinate, rate]) = (numbers, blocks);
            (*q, *q_dot) = (coordinate.at(lane), rate.at(lane));
        }
    }

    #[inline(always)]
    fn take_found<T: Value>(slot: &mut Slot<K, T>, lane: usize, found: &mut K::Accelerations<f64>) {
        for (number, block) in found.values_mut().zip(slot.out.values_mut()) {
            *number = block.at(lane);
        }
    }
}

/// Puts torques and modes into one lane, in place: a block that is moved while its lanes are
/// written one by one costs more than an evaluation.
#[inline(always)]
pub(super) fn put_drives<K: Kernels>(
    blocks: &mut K::PerJoint<Drive<Block>>,
    lane: usize,
    drives: &K::PerJoint<Drive<f64>>,
) {
    for (blocks, drive) in blocks.values_mut().zip(drives.values()) {
        blocks.torque.put(lane, drive.torque);
        blocks.driven.put(lane, drive.driven);
        blocks.held.put(lane, drive.held);
        blocks.given.put(lane, drive.given);
    }
}

/// Takes the torques and modes that were put into blocks into lanes.
pub(crate) struct Enter<T>(pub(crate) T);

impl<T: Number> Visit<T> for Enter<T> {
    #[inline(always)]
    fn visit<K: Kind<Scalar = f64>>(&mut self, _: &Device<K>, slot: &mut Slot<K, T>) {
        slot.drives =
            K::zip_per_joint(&slot.given, &slot.given, |given, _| given.map(|b| self.0.load(&b)));
    }
}

/// Brings accelerations from lanes into blocks.
pub(crate) struct Leave;

impl<T: Number> Visit<T> for Leave {
    #[inline(always)]
    fn visit<K: Kind<Scalar = f64>>(&mut self, _: &Device<K>, slot: &mut Slot<K, T>) {
        slot.out = K::zip_accelerations(&slot.found, &slot.found, |number, _| number.store());
    }
}
