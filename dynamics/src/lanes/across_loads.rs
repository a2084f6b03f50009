//! What acts on devices side by side besides their motors: springs and friction, wrenches on their
//! bodies, a central field.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use super::constants::DeviceBlocks;
use super::loads::{OnBodies, Summed, wrenches_in_lanes};
use super::passive::with_own;
use super::slot::{NO_WRENCH, put_wrenches};
use crate::equations::assembly::Assembly;
use crate::equations::gravity::Central;
use crate::equations::stiffness::Stiffness;
use crate::model::kernels::Kernels;
use crate::model::kind::{Kind, Wrenches};
use crate::model::mode::Drive;
use crate::model::wrench::Wrench;
use crate::numbers::laned::{Block, Number, WIDEST, Work};
use crate::numbers::symmetric::Symmetric;
use crate::numbers::vec3::components;

/// The drives of a group's devices, and what acts on their bodies.
pub(super) struct Loads<K: Kernels, T: Number> {
    /// Torques and modes, with all that adds to them.
    pub(super) drives: K::PerJoint<Drive<T>>,
    /// Damping and stiffness of the joints.
    pub(super) stiffness: Option<K::PerJoint<[T; 2]>>,
    pub(super) on_hub: Option<OnHub<T>>,
}

/// What acts on the bodies of a group's devices, on the hub.
pub(super) struct OnHub<T> {
    /// About B, expressed in B.
    wrench: Wrench<T>,
    /// About B, expressed in B, kg m².
    second_moment: Symmetric<T>,
    /// One in the lanes where anything acts.
    acts: Block,
}

impl<T: Number> OnHub<T> {
    /// Adds that of so many devices, the first, one after another.
    #[inline(always)]
    pub(super) fn add_to(&self, assembly: &mut Assembly<f64>, devices: usize) {
        let Self { wrench, second_moment, acts } = self;
        let wrench = wrench.zip(wrench, |number, _| number.store());
        let second_moment = second_moment.zip(*second_moment, |number, _| number.store());
        for lane in (0..devices).filter(|lane| acts.at(*lane) == 1.0) {
            let wrench = wrench.zip(&wrench, |block, _| block.at(lane));
            assembly.add_wrench(components(&wrench.force), components(&wrench.moment));
            let second_moment = second_moment.zip(second_moment, |block, _| block.at(lane));
            assembly.second_moment = assembly.second_moment.plus(second_moment);
        }
    }
}

/// Adds the stiffness of so many devices, the first, one after another.
#[inline(always)]
pub(super) fn add_in_order<T: Number>(
    to: &mut Stiffness<f64>,
    stiffness: &Stiffness<T>,
    devices: usize,
) {
    let (damping, spring) = (stiffness.damping.store(), stiffness.spring.store());
    for lane in 0..devices {
        to.damping += damping.at(lane);
        to.spring += spring.at(lane);
    }
}

/// Adds the loads of a group's devices.
pub(super) struct AddLoads<'a, K: Kind<Scalar = f64>, T: Number> {
    pub(super) constants: &'a DeviceBlocks<K>,
    /// Of the first device of the group and those after it.
    pub(super) bodies: Option<&'a [Wrenches<K>]>,
    pub(super) joints: &'a K::Joints<T>,
    pub(super) given: &'a K::PerJoint<Drive<T>>,
    pub(super) central: Option<&'a Central<f64>>,
    pub(super) like: T,
    pub(super) to: &'a mut Option<Loads<K, T>>,
}

impl<K: Kind<Scalar = f64>, T: Number> Work for AddLoads<'_, K, T> {
    #[inline(always)]
    fn run(self) {
        let Self { constants, bodies, joints, given, central, like, to } = self;
        let (device, everywhere) = (constants.loads_in_lanes(like), like.same(like));
        let constants = constants.in_lanes(like);
        let (drives, stiffness) = with_own::<K, T>((&constants, device.dry), joints, given);
        let mut wrenches = <K as Kind>::all(NO_WRENCH);
        for (lane, bodies) in bodies.unwrap_or(&[]).iter().take(WIDEST).enumerate() {
            put_wrenches::<K>(&mut wrenches, lane, bodies);
        }
        let wrenches = wrenches_in_lanes::<K, T>(like, &wrenches);
        let on_bodies = OnBodies {
            wrenches: bodies.map(|_| everywhere),
            central: central.map(|central| (central.map(|number| like.like(number)), everywhere)),
        };
        *to = Some(
            match on_bodies.summed::<K>(&constants.constants, &device, joints, &drives, &wrenches) {
                Some(Summed { drives, hub: wrench, second_moment, acts }) => {
                    let acts = like.like(1.0).or(acts, like.like(0.0)).store();
                    let on_hub = Some(OnHub { wrench, second_moment, acts });
                    Loads { drives, stiffness, on_hub }
                }
                None => Loads { drives, stiffness, on_hub: None },
            },
        );
    }
}
