//! Wrenches on the bodies of devices in lanes: applied ones, the gradient of a central field, the lumped
//! model of an imbalance.
//!
//! A lane that has none keeps its numbers: adding zero to minus zero would change its sign.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use super::blocks::LoadConstants;
use crate::equations::gravity::{Central, gradient};
use crate::model::kernels::Kernels;
use crate::model::kind::Kind;
use crate::model::mode::Drive;
use crate::model::wrench::Wrench;
use crate::numbers::each::JointStates;
use crate::numbers::laned::{Block, Number};
use crate::numbers::symmetric::Symmetric;

/// What acts on bodies from outside, and the lanes where it does.
pub(crate) struct OnBodies<T: Number> {
    /// The lanes that have wrenches on bodies.
    pub(crate) wrenches: Option<T::Holds>,
    /// A central field, and the lanes that have one.
    pub(crate) central: Option<(Central<T>, T::Holds)>,
}

/// What acts on the bodies of one device, summed.
pub(crate) struct Summed<K: Kernels, T: Number> {
    /// Torques and modes of the joints.
    pub(crate) drives: K::PerJoint<Drive<T>>,
    /// On the hub, about B, expressed in B.
    pub(crate) hub: Wrench<T>,
    /// The second moment about B, expressed in B, kg m².
    pub(crate) second_moment: Symmetric<T>,
    /// The lanes where anything acts.
    pub(crate) acts: T::Holds,
}

impl<T: Number> OnBodies<T> {
    /// The sum of what acts on the bodies of a device, by joints and on the hub, as
    /// `Device::add_wrenches`; none where nothing acts in any lane.
    #[inline(always)]
    pub(crate) fn summed<K: Kind>(
        &self,
        constants: &K::Constants<T>,
        device: &LoadConstants<T>,
        joints: &K::Joints<T>,
        drives: &K::PerJoint<Drive<T>>,
        bodies: &K::PerJoint<Wrench<T>>,
    ) -> Option<Summed<K, T>> {
        if self.wrenches.is_none() && self.central.is_none() && device.lumped.is_none() {
            return None;
        }
        let [[like, ..], ..] = device.mount;
        let zero = like.like(0.0);
        let mut acts = zero.above(zero);
        let mut sum = K::zip_per_joint(
            bodies,
            bodies,
            #[inline(always)]
            |wrench, _| wrench.zip(&wrench, |_, _| zero),
        );
        if let Some(given) = self.wrenches {
            sum = K::zip_per_joint(
                bodies,
                &sum,
                #[inline(always)]
                |wrench, none| where_acts(given, &wrench, &none),
            );
            acts = like.either(acts, given);
        }
        if let Some((lumped, has)) = &device.lumped {
            let (mut states, mut joint) = (joints.states(), 0);
            sum = K::zip_per_joint(
                &sum,
                &sum,
                #[inline(always)]
                |wrench, _| {
                    joint += 1;
                    let [_, spin] = states.next().unwrap_or([zero; 2]);
                    let at_tip = joint == K::JOINTS.len();
                    let with = wrench.zip(&lumped.at(spin), |sum, number| sum + number);
                    if at_tip { where_acts(*has, &with, &wrench) } else { wrench }
                },
            );
            acts = like.either(acts, *has);
        }
        let (pose, mut second_moment) = (K::pose(joints), Symmetric::filled(zero));
        if let Some((central, has)) = &self.central {
            let (wrenches, second) = gradient::<K, T>(constants, &device.mount, &pose, central);
            second_moment = second.rotated(&device.mount);
            sum = K::zip_per_joint(
                &sum,
                &wrenches,
                #[inline(always)]
                |sum, wrench| where_acts(*has, &sum.zip(&wrench, |sum, number| sum + number), &sum),
            );
            acts = like.either(acts, *has);
        }
        let carried = K::external(constants, &pose, &sum);
        let mut infos = K::JOINTS.iter();
        let drives = K::zip_per_joint(
            drives,
            &carried.joints,
            #[inline(always)]
            |drive, wrench| {
                let along = infos.next().map_or(zero, |info| wrench.along(info));
                let torque = drive.torque + along * drive.driven;
                Drive { torque: torque.or(acts, drive.torque), ..drive }
            },
        );
        Some(Summed { drives, hub: carried.hub.turned(&device.mount), second_moment, acts })
    }
}

/// A wrench where it acts, else another one.
#[inline(always)]
fn where_acts<T: Number>(acts: T::Holds, wrench: &Wrench<T>, other: &Wrench<T>) -> Wrench<T> {
    wrench.zip(other, |number, other| number.or(acts, other))
}

/// Wrenches on bodies as numbers in lanes.
#[inline(always)]
pub(crate) fn wrenches_in_lanes<K: Kernels, T: Number>(
    like: T,
    blocks: &K::PerJoint<Wrench<Block>>,
) -> K::PerJoint<Wrench<T>> {
    K::zip_per_joint(
        blocks,
        blocks,
        #[inline(always)]
        |wrench, _| wrench.zip(&wrench, |block, _| like.load(&block)),
    )
}
