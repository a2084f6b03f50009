//! What acts on devices side by side besides their motors: springs and friction, wrenches on their
//! bodies, a central field.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use super::blocks::DeviceBlocks;
use super::loads::{OnBodies, Summed, wrenches_in_lanes};
use super::passive::with_own;
use super::put::{NO_WRENCH, put_wrenches};
use crate::equations::assembly::Assembly;
use crate::equations::gravity::Central;
use crate::equations::joint_inputs::DeviceInputs;
use crate::equations::stiffness::Stiffness;
use crate::model::kernels::Kernels;
use crate::model::kind::Kind;
use crate::model::mode::Drive;
use crate::model::wrench::Wrench;
use crate::numbers::laned::{Block, Number, WIDEST, Work};
use crate::numbers::real::Scalar;
use crate::numbers::symmetric::Symmetric;
use crate::numbers::vec3::components;

/// The drives of a group's devices, and what acts on their bodies.
pub(crate) struct Loads<K: Kernels, T: Number> {
    /// Torques and modes, with all that adds to them.
    pub(crate) drives: K::PerJoint<Drive<T>>,
    /// Damping and stiffness of the joints.
    pub(crate) stiffness: Option<K::PerJoint<[T; 2]>>,
    pub(crate) on_hub: Option<OnHub<T>>,
}

/// What acts on the bodies of a group's devices, on the hub.
pub(crate) struct OnHub<T> {
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
    pub(crate) fn add_to<U: Scalar>(&self, assembly: &mut Assembly<U>, devices: usize) {
        let Self { wrench, second_moment, acts } = self;
        let wrench = wrench.zip(wrench, |number, _| number.store());
        let second_moment = second_moment.zip(*second_moment, |number, _| number.store());
        for lane in (0..devices).filter(|lane| acts.at(*lane) == 1.0) {
            let wrench = wrench.zip(&wrench, |block, _| U::from_f64(block.at(lane)));
            assembly.add_wrench(components(&wrench.force), components(&wrench.moment));
            let second_moment =
                second_moment.zip(second_moment, |block, _| U::from_f64(block.at(lane)));
            assembly.second_moment = assembly.second_moment.plus(second_moment);
        }
    }
}

/// Adds the stiffness of so many devices, the first, one after another.
#[inline(always)]
pub(crate) fn add_in_order<T: Number, U: Scalar>(
    to: &mut Stiffness<U>,
    stiffness: &Stiffness<T>,
    devices: usize,
) {
    let (damping, spring) = (stiffness.damping.store(), stiffness.spring.store());
    for lane in 0..devices {
        to.damping = to.damping + U::from_f64(damping.at(lane));
        to.spring = to.spring + U::from_f64(spring.at(lane));
    }
}

/// Adds the loads of a group's devices.
pub(crate) struct AddLoads<'a, K: Kind, T: Number> {
    pub(crate) constants: &'a DeviceBlocks<K>,
    /// Of each device.
    pub(crate) inputs: &'a [DeviceInputs<'a, K>; WIDEST],
    pub(crate) joints: &'a K::Joints<T>,
    pub(crate) given: &'a K::PerJoint<Drive<T>>,
    pub(crate) central: Option<&'a Central<K::Scalar>>,
    pub(crate) like: T,
    pub(crate) to: &'a mut Option<Loads<K, T>>,
}

impl<K: Kind, T: Number> Work for AddLoads<'_, K, T> {
    #[inline(always)]
    fn run(self) {
        let Self { constants, inputs, joints, given, central, like, to } = self;
        let (device, everywhere) = (constants.loads_in_lanes(like), like.same(like));
        let constants = constants.in_lanes(like);
        let (drives, stiffness) = with_own::<K, T>((&constants, device.dry), joints, given);
        let mut wrenches = <K as Kind>::all(NO_WRENCH);
        let mut applied = false;
        for (lane, inputs) in inputs.iter().enumerate().take(T::WIDTH) {
            if let Some(bodies) = inputs.bodies {
                put_wrenches::<K>(&mut wrenches, lane, bodies);
                applied = true;
            }
        }
        let wrenches = wrenches_in_lanes::<K, T>(like, &wrenches);
        let on_bodies = OnBodies {
            wrenches: applied.then_some(everywhere),
            central: central
                .map(|central| (central.map(|number| like.like(number.to_f64())), everywhere)),
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
