//! [`Slot`]: one device in lanes, and what is done with the slots of a whole set.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use std::boxed::Box;
use std::sync::Arc;

use core::convert::Infallible;

use super::constants::EachConstants;
use super::laned_set::LanedSet;
use super::states::States;
use crate::equations::device::Device;
use crate::equations::side_by_side::blocks::DeviceBlocks;
use crate::equations::side_by_side::gather::joints_in_lanes;
use crate::equations::side_by_side::put::{NO_WRENCH, put_drives, put_wrenches};
use crate::model::kernels::Kernels;
use crate::model::kind::Kind;
use crate::model::mode::Drive;
use crate::model::wrench::Wrench;
use crate::numbers::each::{Each, JointStates, Value};
use crate::numbers::laned::{Block, Number, WIDEST};
use crate::sets::bundle::{Bundle, Given, Shared, Unique};
use crate::sets::devices::{DeviceSet, SetInputs, Visit};
use crate::sets::enumeration::{DeviceEnum, Variant};
use crate::sets::per_device::{self as data, PerDevice};

/// One device in lanes: what it is given, and what an evaluation and a step make of it.
#[derive(Clone, Debug)]
pub(super) struct Slot<K: Kernels, T: Value> {
    /// Coordinates and rates on their way out.
    pub(crate) block: K::Joints<Block>,
    /// Torques and modes on their way in.
    pub(crate) given: K::PerJoint<Drive<Block>>,
    /// Wrenches on the bodies on their way in, where any lane has them.
    pub(crate) wrenches: K::PerJoint<Wrench<Block>>,
    /// Accelerations on their way out.
    pub(crate) out: K::Accelerations<Block>,
    /// Coordinates and rates where the step began.
    pub(crate) start: K::Joints<T>,
    /// Coordinates and rates now.
    pub(crate) joints: K::Joints<T>,
    /// What the step adds up to.
    pub(crate) sum: K::Joints<T>,
    /// The constants, where the lanes are of different spacecraft.
    pub(crate) constants: Option<Arc<DeviceBlocks<K>>>,
    /// Torques and modes, without what joints do by themselves; with it, and with what acts on
    /// bodies, where loads were added.
    pub(crate) drives: K::PerJoint<Drive<T>>,
    /// Damping and stiffness of the joints, where loads were added.
    pub(crate) stiffness: K::PerJoint<[T; 2]>,
    /// What back substitution needs; none in new slots, of an earlier evaluation otherwise.
    pub(crate) gains: Option<Aligned<K::Gains<T>>>,
    /// The accelerations.
    pub(crate) found: K::Accelerations<T>,
}

/// As aligned as the widest lanes: what is not is stored and loaded in two halves.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct Aligned<V>(pub(crate) V);

/// What is done with each device of a set and its slot.
pub(crate) trait EachSlot<T: Value> {
    /// Does it with one device.
    fn each<K: Kind<Scalar = f64>>(&mut self, device: &Device<K>, slot: &mut Slot<K, T>);
}

/// The slots of a set, at first filled with a number. No enumeration has any.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slots<T>(pub(crate) T);

impl<T: Value> PerDevice<f64> for Slots<T> {
    type Of<K: Kind<Scalar = f64>> = Box<Slot<K, T>>;
    type OfEnum<E: DeviceEnum<Scalar = f64>> = ();

    fn initial<K: Kind<Scalar = f64>>(&self) -> Box<Slot<K, T>> {
        let (rest, still) = (K::at_rest(), K::no_accelerations());
        let drive = <K as Kind>::all(Drive { torque: 0.0, driven: 0.0, held: 0.0, given: 0.0 });
        let joints = K::zip_joints(&rest, &rest, |_, _| self.0);
        Box::new(Slot {
            block: K::zip_joints(&rest, &rest, |_, _| Block::ZERO),
            given: K::zip_per_joint(&drive, &drive, |drive, _| drive.map(|_| Block::ZERO)),
            wrenches: <K as Kind>::all(NO_WRENCH),
            out: K::zip_accelerations(&still, &still, |_, _| Block::ZERO),
            start: joints,
            joints,
            sum: joints,
            constants: None,
            drives: K::zip_per_joint(&drive, &drive, |drive, _| drive.map(|_| self.0)),
            stiffness: <K as Kind>::all([self.0; 2]),
            gains: None,
            found: K::zip_accelerations(&still, &still, |_, _| self.0),
        })
    }

    fn initial_of_enum<K: Variant<E>, E: DeviceEnum<Scalar = f64>>(&self) {}

    fn get<K: Variant<E>, E: DeviceEnum<Scalar = f64>>((): &()) -> Option<Box<Slot<K, T>>> {
        None
    }

    fn put<K: Variant<E>, E: DeviceEnum<Scalar = f64>>(_: &Box<Slot<K, T>>, (): &mut ()) {}

    fn count<E: DeviceEnum<Scalar = f64>>((): &()) -> Option<usize> {
        None
    }
}

/// The slots of a set.
pub(crate) type SlotsOf<D, T> = <D as DeviceSet>::Per<Slots<T>>;

/// Does something with each device in order.
#[inline(always)]
pub(crate) fn each_slot<D: LanedSet, T: Value>(
    devices: &D::Prepared,
    slots: &mut SlotsOf<D, T>,
    each: &mut impl EachSlot<T>,
) {
    let Ok(()) = D::visit::<Unique<Slots<T>>, _>(devices, slots, &mut ByEach(each));
}

/// A visitor that does something with each slot.
struct ByEach<'a, E>(&'a mut E);

impl<T: Value, E: EachSlot<T>> Visit<f64, Unique<Slots<T>>> for ByEach<'_, E> {
    type Error = Infallible;

    #[inline(always)]
    fn visit<K: Kind<Scalar = f64>>(
        &mut self,
        device: &Device<K>,
        slot: &mut Box<Slot<K, T>>,
    ) -> Result<(), Infallible> {
        self.0.each(device, slot);
        Ok(())
    }
}

/// Takes the joints of as many states in as the widest lanes have.
#[inline(always)]
pub(crate) fn load_joints<D: LanedSet, T: Number>(
    devices: &D::Prepared,
    slots: &mut SlotsOf<D, T>,
    like: T,
    states: [&D::Per<data::Joints>; WIDEST],
) {
    let data = (slots, states);
    let Ok(()) = D::visit::<(Unique<Slots<T>>, States), _>(devices, data, &mut Load(like));
}

/// Takes joints in.
struct Load<T>(T);

impl<T: Number> Visit<f64, (Unique<Slots<T>>, States)> for Load<T> {
    type Error = Infallible;

    #[inline(always)]
    fn visit<K: Kind<Scalar = f64>>(
        &mut self,
        _: &Device<K>,
        (slot, states): (&mut Box<Slot<K, T>>, [&K::Joints<f64>; WIDEST]),
    ) -> Result<(), Infallible> {
        slot.joints = joints_in_lanes::<K, T>(self.0, states);
        Ok(())
    }
}

/// Puts what is given of the joints into one lane. False where modes are rejected.
#[inline(always)]
pub(crate) fn put_given<D: LanedSet, T: Value>(
    devices: &D::Prepared,
    slots: &mut SlotsOf<D, T>,
    lane: usize,
    joints: &D::Per<data::Joints>,
    given: SetInputs<'_, D>,
) -> bool {
    let data = (slots, joints, given);
    D::visit::<InputData<T>, _>(devices, data, &mut WriteInputs { lane }).is_ok()
}

type InputData<T> = (Unique<Slots<T>>, Shared<data::Joints>, Given);

/// Puts what is given into a lane.
struct WriteInputs {
    lane: usize,
}

impl<T: Value> Visit<f64, InputData<T>> for WriteInputs {
    type Error = Rejected;

    #[inline(always)]
    fn visit<K: Kind<Scalar = f64>>(
        &mut self,
        _: &Device<K>,
        (slot, joints, given): <InputData<T> as Bundle<f64>>::Of<'_, K>,
    ) -> Result<(), Rejected> {
        let drives = Device::<K>::given_drives(joints, given).ok_or(Rejected)?;
        put_drives::<K>(&mut slot.given, self.lane, &drives);
        if let Some(wrenches) = given.bodies {
            put_wrenches::<K>(&mut slot.wrenches, self.lane, wrenches);
        }
        Ok(())
    }
}

/// Modes of a device that are rejected.
struct Rejected;

/// Takes the joints of one lane out.
#[inline(always)]
pub(crate) fn take_joints<D: LanedSet, T: Value>(
    devices: &D::Prepared,
    slots: &mut SlotsOf<D, T>,
    lane: usize,
    joints: &mut D::Per<data::Joints>,
) {
    let data = (slots, joints);
    let Ok(()) =
        D::visit::<(Unique<Slots<T>>, Unique<data::Joints>), _>(devices, data, &mut Take { lane });
}

/// Loads the constants of a group of spacecraft into the slots.
pub(crate) fn enter_constants<D: LanedSet, T: Value>(
    devices: &D::Prepared,
    slots: &mut SlotsOf<D, T>,
    constants: &D::Per<EachConstants>,
) {
    let data = (slots, constants);
    let Ok(()) = D::visit::<(Unique<Slots<T>>, Shared<EachConstants>), _>(
        devices,
        data,
        &mut EnterConstants,
    );
}

/// Loads constants.
struct EnterConstants;

impl<T: Value> Visit<f64, (Unique<Slots<T>>, Shared<EachConstants>)> for EnterConstants {
    type Error = Infallible;

    fn visit<K: Kind<Scalar = f64>>(
        &mut self,
        _: &Device<K>,
        (slot, constants): (&mut Box<Slot<K, T>>, &Option<Arc<DeviceBlocks<K>>>),
    ) -> Result<(), Infallible> {
        slot.constants.clone_from(constants);
        Ok(())
    }
}

/// Takes the constants of a group of spacecraft out of the slots.
pub(crate) fn forget_constants<D: LanedSet, T: Value>(
    devices: &D::Prepared,
    slots: &mut SlotsOf<D, T>,
) {
    each_slot::<D, T>(devices, slots, &mut ForgetConstants);
}

/// Takes constants out.
struct ForgetConstants;

impl<T: Value> EachSlot<T> for ForgetConstants {
    #[inline(always)]
    fn each<K: Kind<Scalar = f64>>(&mut self, _: &Device<K>, slot: &mut Slot<K, T>) {
        slot.constants = None;
    }
}

/// Takes the accelerations of one lane out.
#[inline(always)]
pub(crate) fn take_found<D: LanedSet, T: Value>(
    devices: &D::Prepared,
    slots: &mut SlotsOf<D, T>,
    lane: usize,
    found: &mut D::Per<data::Accelerations>,
) {
    let data = (slots, found);
    let Ok(()) = D::visit::<(Unique<Slots<T>>, Unique<data::Accelerations>), _>(
        devices,
        data,
        &mut Take { lane },
    );
}

/// Takes something out of a lane.
struct Take {
    lane: usize,
}

impl<T: Value> Visit<f64, (Unique<Slots<T>>, Unique<data::Joints>)> for Take {
    type Error = Infallible;

    #[inline(always)]
    fn visit<K: Kind<Scalar = f64>>(
        &mut self,
        _: &Device<K>,
        (slot, joints): (&mut Box<Slot<K, T>>, &mut K::Joints<f64>),
    ) -> Result<(), Infallible> {
        // The blocks in place: by value, each would be copied for one of its numbers.
        for (numbers, blocks) in joints.states_mut().zip(slot.block.states_mut()) {
            let ([q, q_dot], [coordinate, rate]) = (numbers, blocks);
            (*q, *q_dot) = (coordinate.at(self.lane), rate.at(self.lane));
        }
        Ok(())
    }
}

impl<T: Value> Visit<f64, (Unique<Slots<T>>, Unique<data::Accelerations>)> for Take {
    type Error = Infallible;

    #[inline(always)]
    fn visit<K: Kind<Scalar = f64>>(
        &mut self,
        _: &Device<K>,
        (slot, found): (&mut Box<Slot<K, T>>, &mut K::Accelerations<f64>),
    ) -> Result<(), Infallible> {
        for (number, block) in found.values_mut().zip(slot.out.values_mut()) {
            *number = block.at(self.lane);
        }
        Ok(())
    }
}

/// Takes the torques and modes that were put into blocks into lanes.
pub(crate) struct LoadDrives<T>(pub(crate) T);

impl<T: Number> EachSlot<T> for LoadDrives<T> {
    #[inline(always)]
    fn each<K: Kind<Scalar = f64>>(&mut self, _: &Device<K>, slot: &mut Slot<K, T>) {
        slot.drives =
            K::zip_per_joint(&slot.given, &slot.given, |given, _| given.map(|b| self.0.load(&b)));
    }
}

/// Brings accelerations from lanes into blocks.
pub(crate) struct StoreAccelerations;

impl<T: Number> EachSlot<T> for StoreAccelerations {
    #[inline(always)]
    fn each<K: Kind<Scalar = f64>>(&mut self, _: &Device<K>, slot: &mut Slot<K, T>) {
        slot.out = K::zip_accelerations(&slot.found, &slot.found, |number, _| number.store());
    }
}
