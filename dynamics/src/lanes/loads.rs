//! Applied loads in lanes, and all that a device's drives are besides motors, springs and dampers:
//! wrenches on the bodies, the gradient of a central field, the lumped model of an imbalance, dry
//! friction.
//!
//! They are added before the elimination, in a function of its own, and only for groups of lanes
//! that have one of them. A lane that has none keeps its numbers: adding zero to minus zero would
//! change its sign.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use super::evaluate::HubInputs;
use super::group::GroupLoads;
use super::laned_set::LanedSet;
use super::motion::Motion;
use super::slot::{EachSlot, Slot, SlotsOf, each_slot};
use crate::attitude::quaternion::bn;
use crate::equations::device::Device;
use crate::equations::gravity::{Central, powers};
use crate::equations::hub::HubConstants;
use crate::equations::side_by_side::blocks::{DeviceConstants, loads_in_lanes, same_in_lanes};
use crate::equations::side_by_side::loads::{OnBodies, Summed, wrenches_in_lanes};
use crate::equations::side_by_side::passive::{keeps_turning, with_own};
use crate::model::kind::Kind;
use crate::numbers::laned::{Number, Work};
use crate::numbers::symmetric::Symmetric;
use crate::numbers::vec3::{Vec3, add, components, dot, rotate, scale};

/// A vector where something holds, else another one.
#[inline(always)]
fn vector_where<T: Number>(holds: T::Holds, v: Vec3<T>, other: Vec3<T>) -> Vec3<T> {
    [v[0].or(holds, other[0]), v[1].or(holds, other[1]), v[2].or(holds, other[2])]
}

/// A central field at the hub: what it adds to the field at B, and the lanes where its powers are
/// numbers; those beyond are the scalar path's.
#[inline(always)]
fn central<T: Number>(mu: T, motion: &Motion<T>) -> (Vec3<T>, Central<T>, T::Holds) {
    let r = rotate(&bn(motion.q), motion.r);
    let near = f64::EPSILON * f64::EPSILON;
    let size = r[0].abs().larger(r[1].abs()).larger(r[2].abs());
    let regular = size.both(size.above(mu.like(near)), mu.like(near.recip()).above(size));
    let per_r = dot(r, r).sqrt().recip();
    let (at_b, central) = Central::of(scale(per_r, r), powers(mu, per_r));
    (at_b, central, regular)
}

/// Adds the loads of a group to what acts on the hub, and to the drives of its devices, which are
/// complete then.
pub(super) struct AddLoads<'a, D: LanedSet, T: Number, const EACH: bool> {
    pub(super) devices: &'a D::Prepared,
    pub(super) slots: &'a mut SlotsOf<D, T>,
    pub(super) loads: &'a GroupLoads,
    pub(super) motion: &'a Motion<T>,
    pub(super) acting: &'a mut HubInputs<T>,
    /// Cleared where this evaluation, or a step that it is part of, is the scalar path's.
    pub(super) holds: &'a mut T::Holds,
    /// Whether it is part of a step, which began at the start of the slots.
    pub(super) in_step: bool,
}

impl<D: LanedSet, T: Number, const EACH: bool> Work for AddLoads<'_, D, T, EACH> {
    #[inline(always)]
    fn run(self) {
        let Self { devices, slots, loads, motion, acting, holds, in_step } = self;
        let [like, ..] = motion.omega;
        let (zero, one) = (like.like(0.0), like.like(1.0));
        let given = like.load(&loads.wrenches).above(zero);
        let wrenches = if loads.any_wrenches { Some(given) } else { None };
        let mut field = None;
        if loads.any_central {
            let has = like.load(&loads.central).above(zero);
            let (at_b, central, regular) = central(like.load(&loads.mu), motion);
            acting.at_b = vector_where(has, at_b, acting.at_b);
            let regular = one.or(regular, zero).or(has, one);
            *holds = like.both(*holds, regular.above(zero));
            field = Some((central, has));
        }
        let mut each = EachLoads::<T, EACH> {
            on_bodies: OnBodies { wrenches, central: field },
            force: acting.force,
            moment: acting.torque_b,
            second_moment: Symmetric::filled(zero),
            holds: *holds,
            in_step,
        };
        each_slot::<D, _>(devices, slots, &mut each);
        *holds = each.holds;
        if let Some((central, has)) = &each.on_bodies.central {
            let hub: HubConstants<T> = loads.hub.map(|block| like.load(&block));
            let second = hub.second_moment();
            let (force, moment) = central.wrench(hub.first_moment, &second);
            let whole = central.third_order(&each.second_moment.plus(second));
            let force = add(each.force, add(force, whole));
            each.force = vector_where(*has, force, each.force);
            each.moment = vector_where(*has, add(each.moment, moment), each.moment);
        }
        (acting.force, acting.torque_b) = (each.force, each.moment);
    }
}

/// Adds the loads of each device.
struct EachLoads<T: Number, const EACH: bool> {
    on_bodies: OnBodies<T>,
    force: Vec3<T>,
    moment: Vec3<T>,
    second_moment: Symmetric<T>,
    holds: T::Holds,
    in_step: bool,
}

impl<T: Number, const EACH: bool> EachSlot<T> for EachLoads<T, EACH> {
    #[inline(always)]
    fn each<K: Kind<Scalar = f64>>(&mut self, device: &Device<K>, slot: &mut Slot<K, T>) {
        let [like, ..] = self.force;
        let (constants, device) = match &slot.constants {
            Some(blocks) if EACH => (blocks.in_lanes(like), blocks.loads_in_lanes(like)),
            _ => (same_in_lanes(device, like), loads_in_lanes(device, like)),
        };
        let given = K::zip_per_joint(
            &slot.given,
            &slot.given,
            #[inline(always)]
            |given, _| given.map(|b| like.load(&b)),
        );
        let (drives, coefficients) =
            with_own::<K, T>((&constants, device.dry), &slot.joints, &given);
        slot.drives = drives;
        if let Some(coefficients) = coefficients {
            slot.stiffness = coefficients;
        }
        if let (true, true, Some(passive)) = (self.in_step, device.dry, &constants.passive) {
            let turns = keeps_turning::<K, T>(like, passive, &slot.start, &slot.joints);
            self.holds = like.both(self.holds, turns);
        }
        let bodies = wrenches_in_lanes::<K, T>(like, &slot.wrenches);
        let summed = self.on_bodies.summed::<K>(
            &constants.constants,
            &device,
            &slot.joints,
            &drives,
            &bodies,
        );
        let Some(Summed { drives, hub, second_moment, acts }) = summed else { return };
        slot.drives = drives;
        let force = add(self.force, components(&hub.force));
        self.force = vector_where(acts, force, self.force);
        let moment = add(self.moment, components(&hub.moment));
        self.moment = vector_where(acts, moment, self.moment);
        self.second_moment = self.second_moment.plus(second_moment);
    }
}

/// Clears the lanes where a joint with dry friction is at rest after a step, or has reversed.
pub(super) struct CheckFriction<'a, D: LanedSet, T: Number, const EACH: bool> {
    pub(super) devices: &'a D::Prepared,
    pub(super) slots: &'a mut SlotsOf<D, T>,
    pub(super) like: T,
    pub(super) holds: &'a mut T::Holds,
}

impl<D: LanedSet, T: Number, const EACH: bool> Work for CheckFriction<'_, D, T, EACH> {
    #[inline(always)]
    fn run(self) {
        let Self { devices, slots, like, holds } = self;
        let mut each = EachFriction::<T, EACH> { like, holds: *holds };
        each_slot::<D, _>(devices, slots, &mut each);
        *holds = each.holds;
    }
}

/// Checks the joints of each device after a step.
struct EachFriction<T: Number, const EACH: bool> {
    like: T,
    holds: T::Holds,
}

impl<T: Number, const EACH: bool> EachSlot<T> for EachFriction<T, EACH> {
    #[inline(always)]
    fn each<K: Kind<Scalar = f64>>(&mut self, device: &Device<K>, slot: &mut Slot<K, T>) {
        let (DeviceConstants { passive, .. }, dry) = match &slot.constants {
            Some(blocks) if EACH => (blocks.in_lanes(self.like), blocks.dry),
            _ => (same_in_lanes(device, self.like), device.is_dry()),
        };
        if let (true, Some(passive)) = (dry, &passive) {
            let next = K::zip_joints(&slot.start, &slot.sum, |start, sum| start + sum);
            let turns = keeps_turning::<K, T>(self.like, passive, &slot.start, &next);
            self.holds = self.like.both(self.holds, turns);
        }
    }
}
