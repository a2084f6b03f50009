//! One evaluation in lanes: what [`Spacecraft::accelerations`] does, several states at a time.
//!
//! The same kernels and the same arithmetic in the same order: lanes have the bits of single
//! numbers. Nothing stops where a lane fails; which lanes hold is returned at the end.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use super::laned_set::LanedSet;
use super::slot::{Aligned, EachSlot, Slot, SlotsOf, each_slot};
use crate::equations::assembly::{Assembly, expressed_in_b};
use crate::equations::device::Device;
use crate::equations::hub::HubConstants;
use crate::equations::side_by_side::blocks::{DeviceConstants, same_in_lanes};
use crate::equations::side_by_side::checks::{regular, within_reach};
use crate::equations::side_by_side::passive::{add_stiffness, viscous, where_sprung, with_passive};
use crate::equations::stiffness::Stiffness;
use crate::equations::system::{PIVOT_EPSILONS, Pivots, WELL_SCALED};
use crate::generated::hub::BodyAcceleration;
use crate::model::kind::Kind;
use crate::numbers::laned::Number;
use crate::numbers::vec3::{Vec3, add};

/// What acts on the hub, expressed in B.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HubInputs<T> {
    pub(crate) omega: Vec3<T>,
    pub(crate) force: Vec3<T>,
    pub(crate) torque_b: Vec3<T>,
    /// The field at B.
    pub(crate) at_b: Vec3<T>,
    /// Whether loads were added: then the drives in the slots are complete.
    pub(crate) with_loads: bool,
}

/// What an evaluation finds of the hub, and the lanes where it holds; what it finds of the devices
/// is in their slots.
#[derive(Clone, Copy)]
pub(crate) struct HubResults<T: Number> {
    pub(crate) r_b_n_ddot: Vec3<T>,
    pub(crate) omega_dot: Vec3<T>,
    /// Of springs and friction.
    pub(crate) stiffness: Stiffness<T>,
    pub(crate) holds: T::Holds,
}

/// The spacecraft in the lanes, apart from the constants of their devices.
pub(crate) struct LanedCraft<'a, D: LanedSet, T> {
    /// The devices of one of them: all have the same shape.
    pub(crate) devices: &'a D::Prepared,
    /// The hub with the constant shares of the devices.
    pub(crate) body: HubConstants<T>,
    /// Whether a joint has a spring, a damper or dry friction.
    pub(crate) passive: bool,
}

/// Evaluates the devices in their slots, and the hub; `EACH` with the constants in the
/// slots, else with those of the devices.
#[inline(always)]
pub(crate) fn evaluate<D: LanedSet, T: Number, const EACH: bool>(
    craft: &LanedCraft<'_, D, T>,
    slots: &mut SlotsOf<D, T>,
    acting: &HubInputs<T>,
) -> HubResults<T> {
    let [like, ..] = acting.omega;
    let body = craft.body;
    let mut elimination = Elimination::<T, EACH> {
        omega: acting.omega,
        with_loads: acting.with_loads,
        assembly: Assembly::new(&body, acting.force, acting.torque_b),
        holds: like.same(like),
    };
    each_slot::<D, _>(craft.devices, slots, &mut elimination);
    let Elimination { assembly, mut holds, .. } = elimination;
    let system = assembly.system(acting.omega);
    let scale = assembly.scale(&body);
    let (solution, pivots) = system.solved();
    let mut stiffness = assembly.stiffness;
    if craft.passive {
        stiffness = stiffness.on_free_hub(pivots, scale);
    }
    let zero = like.like(0.0);
    let (mass, [x, y, z]) = scale;
    let mut regular = all_above(pivots, [mass, mass, mass, x, y, z], like.like(WELL_SCALED));
    if like.like(1.0).or(regular, zero).store().0.iter().take(T::WIDTH).any(|holds| *holds != 1.0) {
        let grown = system.grown_scales(&scale);
        regular = all_above(pivots, grown, like.like(PIVOT_EPSILONS * f64::EPSILON));
    }
    holds = like.both(regular, holds);
    let [x, y, z] = solution.r_b_n_ddot;
    let [p, q, r] = solution.omega_dot;
    let vanishing = (x + y + z + p + q + r) * zero;
    let mut back = BackSubstitution { hub: solution.expressed_in_b(), zero, vanishing };
    each_slot::<D, _>(craft.devices, slots, &mut back);
    let r_b_n_ddot = add(solution.r_b_n_ddot, acting.at_b);
    let [x, y, z] = r_b_n_ddot;
    let vanishing = back.vanishing + (x + y + z) * zero;
    let holds = like.both(holds, vanishing.same(zero));
    HubResults { r_b_n_ddot, omega_dot: solution.omega_dot, stiffness, holds }
}

/// Where each pivot exceeds a share of its scale.
#[inline(always)]
fn all_above<T: Number>(pivots: Pivots<T>, scales: [T; 6], share: T) -> T::Holds {
    let above = |pivot: T, scale: T| pivot.above(share * scale);
    let ([a, b, c, d, e, f], [p, q, r, s, t, u]) = (pivots, scales);
    let first = share.both(above(a, p), share.both(above(b, q), above(c, r)));
    share.both(first, share.both(above(d, s), share.both(above(e, t), above(f, u))))
}

/// Eliminates each device into the hub's system.
struct Elimination<T: Number, const EACH: bool> {
    omega: Vec3<T>,
    with_loads: bool,
    assembly: Assembly<T>,
    holds: T::Holds,
}

impl<T: Number, const EACH: bool> EachSlot<T> for Elimination<T, EACH> {
    #[inline(always)]
    fn each<K: Kind<Scalar = f64>>(&mut self, device: &Device<K>, slot: &mut Slot<K, T>) {
        let [like, ..] = self.omega;
        let blocks = match &slot.constants {
            Some(blocks) if EACH => Some(&**blocks),
            None if EACH => {
                self.holds = like.above(like);
                return;
            }
            _ => None,
        };
        // Loaded again where each is used: what is loaded before a branch is copied to the stack.
        let constants = || match blocks {
            Some(blocks) => blocks.in_lanes(like),
            None => same_in_lanes(device, like),
        };
        let DeviceConstants { passive, sprung, .. } = constants();
        let within = within_reach::<K, T>(like, &slot.joints);
        let drives = match &passive {
            Some(passive) if !self.with_loads => {
                let drives = with_passive::<K, T>(&slot.joints, &slot.drives, passive);
                if EACH { where_sprung::<K, T>(sprung, &drives, &slot.drives) } else { drives }
            }
            _ => slot.drives,
        };
        let pose = K::pose(&slot.joints);
        let omega = expressed_in_b(self.omega);
        let DeviceConstants { constants: of_device, bound, .. } = constants();
        let eliminated = K::eliminate(&of_device, &pose, &slot.joints, &omega, &drives);
        let regular = regular::<K, T>(like, &eliminated, &drives, &bound);
        self.holds = like.both(self.holds, like.both(within, regular));
        if let Some(passive) = &passive {
            let joints = if self.with_loads { slot.stiffness } else { viscous::<K, T>(passive) };
            add_stiffness::<K, T>(&mut self.assembly.stiffness, &joints, &eliminated, &drives);
        }
        self.assembly.add(K::share(&eliminated));
        slot.gains = Some(Aligned(*K::gains(&eliminated)));
    }
}

/// Finds each device's own accelerations.
struct BackSubstitution<T> {
    hub: BodyAcceleration<T>,
    zero: T,
    /// Zero where every acceleration so far is finite, else NaN.
    vanishing: T,
}

impl<T: Number> EachSlot<T> for BackSubstitution<T> {
    #[inline(always)]
    fn each<K: Kind<Scalar = f64>>(&mut self, _: &Device<K>, slot: &mut Slot<K, T>) {
        let Some(Aligned(gains)) = &slot.gains else { return };
        let found = K::back_substitute(gains, &self.hub);
        slot.found = K::zip_accelerations(&found, &found, |number, _| {
            self.vanishing = self.vanishing + number * self.zero;
            number
        });
    }
}
