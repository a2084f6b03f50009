//! [`GroupElimination`]: the joints of devices of one kind, side by side, eliminated from the equations of
//! the hub.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use pulp::{Simd, WithSimd};

use super::back_substitution::write;
use super::blocks::DeviceConstants;
use super::checks::{regular, within_reach};
use super::gains::GroupGains;
use super::gather::{joints_in_lanes, values_in_lanes};
use super::group::DeviceGroup;
use super::group_loads::{AddLoads, Loads, add_in_order};
use super::passive::{add_stiffness, viscous, with_passive};
use super::put::put_drives;
use crate::equations::assembly::{Assembly, expressed_in_b};
use crate::equations::device::Device;
use crate::equations::joint_inputs::{DeviceInputs, Environment};
use crate::equations::stiffness::Stiffness;
use crate::model::kind::Kind;
use crate::model::mode::{Drive, Mode};
use crate::numbers::each::Each;
use crate::numbers::lane::Lane;
use crate::numbers::laned::{Block, Number, WIDEST};
use crate::numbers::real::Scalar;
use crate::numbers::vec3::map;

/// Devices whose joints are to be eliminated side by side; lanes without a device repeat the last.
pub(crate) struct GroupElimination<'a, K: Kind> {
    pub(crate) group: &'a DeviceGroup<K>,
    pub(crate) joints: [&'a K::Joints<K::Scalar>; WIDEST],
    pub(crate) given: [DeviceInputs<'a, K>; WIDEST],
    pub(crate) environment: &'a Environment<K::Scalar>,
    /// The hub's system, to which the devices are added one after another.
    pub(crate) assembly: &'a mut Assembly<K::Scalar>,
    /// What back substitution needs, to be written.
    pub(crate) gains: &'a mut GroupGains,
}

impl<K: Kind> GroupElimination<'_, K> {
    /// Eliminates the joints. False where lanes do not support the inputs, or fail: then nothing was
    /// written.
    ///
    /// Never inlined: one function of a kind and a width for all sets and services.
    #[inline(never)]
    pub(crate) fn run(self) -> bool {
        self.group.registers.dispatch(self)
    }
}

impl<K: Kind> WithSimd for GroupElimination<'_, K> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> bool {
        self.eliminate(Lane::splat(simd, 0.0)).is_some()
    }
}

impl<K: Kind> GroupElimination<'_, K> {
    #[inline(always)]
    fn eliminate<T: Number>(self, zero: T) -> Option<()> {
        let Self { group, joints, given, environment, assembly, gains } = self;
        let DeviceGroup { blocks, devices, weight, .. } = group;
        let omega = map(environment.omega, |component| zero.like(component.to_f64()));
        let drives = drives_in_lanes::<K, T>(&joints, &given, zero)?;
        let joints = joints_in_lanes::<K, T>(zero, joints);
        let [first, ..] = &given;
        let applied = first.bodies.is_some() || environment.central.is_some();
        let DeviceConstants { passive, .. } = blocks.in_lanes(zero);
        let loads = if applied || blocks.dry || blocks.is_lumped() {
            // Copies: numbers whose place another function knows do not stay in registers.
            let (mut to, joints, drives) = (None, joints, drives);
            zero.apart(AddLoads::<K, T> {
                constants: blocks,
                inputs: &given,
                joints: &joints,
                given: &drives,
                central: environment.central.as_ref(),
                like: zero,
                to: &mut to,
            });
            to
        } else {
            None
        };
        let drives = match (&passive, &loads) {
            (_, Some(Loads { drives, .. })) => *drives,
            (Some(passive), None) => with_passive::<K, T>(&joints, &drives, passive),
            (None, None) => drives,
        };
        let pose = K::pose(&joints);
        // Loaded here: what is loaded before a branch is copied to the stack.
        let DeviceConstants { constants, bound, .. } = blocks.in_lanes(zero);
        let eliminated = K::eliminate(&constants, &pose, &joints, &expressed_in_b(omega), &drives);
        let regular = regular::<K, T>(zero, &eliminated, &drives, &bound);
        let holds = zero.both(within_reach::<K, T>(zero, &joints), regular);
        let holds = zero.like(1.0).or(holds, zero).store();
        if (0..T::WIDTH).any(|lane| holds.at(lane) != 1.0) {
            return None;
        }
        if let Some(passive) = &passive {
            let mut stiffness = Stiffness::none(zero);
            let of_loads = loads.as_ref().and_then(|loads| loads.stiffness);
            let joints = of_loads.unwrap_or_else(|| viscous::<K, T>(passive));
            add_stiffness::<K, T>(&mut stiffness, &joints, &eliminated, &drives);
            add_in_order(&mut assembly.stiffness, &stiffness, *devices);
        }
        if let Some(Loads { on_hub: Some(on_hub), .. }) = &loads {
            on_hub.add_to(assembly, *devices);
        }
        let mut share = *K::share(&eliminated);
        if *devices < T::WIDTH {
            let real = zero.load(weight).above(zero);
            // Minus zero changes no sum.
            let none = zero.like(-0.0);
            share = share.map(
                #[inline(always)]
                |number| number.or(real, none),
            );
        }
        assembly.add_by(
            &share,
            #[inline(always)]
            |sum, number| K::Scalar::from_f64(number.added_to(sum.to_f64())),
        );
        let found = K::gains(&eliminated);
        group.shape.get_or_init(|| K::zip_gains(found, found, |_, _| ()));
        write::<K, T>(found, gains);
        Some(())
    }
}

/// What is given of the joints of a group's devices.
#[inline(always)]
fn drives_in_lanes<K: Kind, T: Number>(
    joints: &[&K::Joints<K::Scalar>; WIDEST],
    given: &[DeviceInputs<'_, K>; WIDEST],
    zero: T,
) -> Option<K::PerJoint<Drive<T>>> {
    let (mut torques, mut driven) = ([<K as Kind>::all(0.0); WIDEST], true);
    for (torques, given) in torques.iter_mut().zip(given).take(T::WIDTH) {
        driven &= given.modes.values().all(|mode| mode == Mode::Driven);
        for (place, torque) in torques.values_mut().zip(given.motors.values()) {
            *place = torque.to_f64();
        }
    }
    if driven && K::JOINTS.iter().all(|info| info.driven) {
        let one = zero.like(1.0);
        let torques = values_in_lanes::<K, T>(zero, torques.each_ref());
        return Some(K::zip_per_joint(&torques, &torques, |torque, _| Drive {
            torque,
            driven: one,
            held: zero,
            given: zero,
        }));
    }
    let drive = <K as Kind>::all(Mode::Driven.drive(0.0));
    let mut drives_of = K::zip_per_joint(&drive, &drive, |drive, _| drive.map(|_| Block::ZERO));
    for (lane, (joints, given)) in joints.iter().zip(given).enumerate().take(T::WIDTH) {
        let own = DeviceInputs::<K> { bodies: None, ..*given };
        put_drives::<K>(&mut drives_of, lane, &Device::<K>::given_drives(joints, own)?);
    }
    let load = |block: Block| zero.load(&block);
    Some(K::zip_per_joint(&drives_of, &drives_of, |drive, _| drive.map(load)))
}
