//! A single device as a set.

#![expect(
    clippy::inline_always,
    reason = "fused numbers reach their instruction only where inlined"
)]

use crate::equations::arithmetic::{EliminationOutputs, Rounding};
use crate::equations::assembly::Assembly;
use crate::equations::device::Device;
use crate::equations::device_loads::LoadsOf;
use crate::equations::device_loads::{DeviceLoads, JointPower};
use crate::equations::error::SolveError;
use crate::equations::hub::BodySums;
use crate::equations::joint_inputs::Environment;
use crate::equations::load_sums::{Along, HubAccelerations, LoadSums};
use crate::equations::system::Solution;
use crate::generated::hub::ConstantShare;
use crate::model::kind::{JointInfo, Kind};
use crate::model::mode::Mode;
use crate::model::passive::Passive;
use crate::model::wrench::Wrench;
use crate::numbers::each::{Each, Value};
use crate::numbers::real::zero;
use crate::numbers::vec3::Vec3;
use crate::sets::devices::{Devices, FixedSet, SetInputs};
use crate::validation::check::check_device;
use crate::validation::parameter_error::ParameterError;

impl<K: Kind> Devices for K {
    type Scalar = K::Scalar;
    type Prepared = Device<K>;
    type Joints = K::Joints<K::Scalar>;
    type Motors = K::Motors;
    type Accelerations = K::Accelerations<K::Scalar>;
    type PerJoint<V: Value> = K::PerJoint<V>;
    type Loads = LoadsOf<K>;
    type Scratch = Option<K::Gains<K::Scalar>>;

    fn check(&self, device: &mut usize) -> Result<(), ParameterError<K::Scalar>> {
        check_device(*device, self)?;
        *device = device.wrapping_add(1);
        Ok(())
    }

    fn prepare(&self) -> Device<K> {
        Device::new(self)
    }

    fn constant_shares(device: &Device<K>) -> impl Iterator<Item = ConstantShare<K::Scalar>> {
        core::iter::once(K::constant_share(&device.constants))
    }

    fn infos(_: &Device<K>) -> impl Iterator<Item = &'static JointInfo> {
        K::JOINTS.iter()
    }

    fn excesses(device: &Device<K>) -> impl Iterator<Item = K::Scalar> {
        device.excess.values()
    }

    fn passives(device: &Device<K>) -> impl Iterator<Item = Passive<K::Scalar>> {
        device.passive.values()
    }

    fn at_rest_for(_: &Device<K>) -> K::Joints<K::Scalar> {
        <K as Kind>::at_rest()
    }

    fn motors_off_for(_: &Device<K>) -> K::Motors {
        <K as Kind>::motors_off()
    }

    fn no_accelerations_for(_: &Device<K>) -> K::Accelerations<K::Scalar> {
        K::no_accelerations()
    }

    fn all_for<V: Value>(_: &Device<K>, value: V) -> K::PerJoint<V> {
        <K as Kind>::all(value)
    }

    fn no_loads_for(_: &Device<K>) -> Self::Loads {
        DeviceLoads {
            mount: Wrench::none(),
            joints: <K as Kind>::all(Wrench::none()),
            motors: <K as Kind>::all(zero()),
            powers: <K as Kind>::all(JointPower::none()),
        }
    }

    fn scratch(_: &Device<K>) -> Option<K::Gains<K::Scalar>> {
        None
    }

    fn fits(
        _: &Device<K>,
        _: &K::Joints<K::Scalar>,
        _: Option<SetInputs<'_, Self>>,
        _: Option<&K::Accelerations<K::Scalar>>,
    ) -> Result<(), SolveError<K::Scalar>> {
        Ok(())
    }

    #[inline(always)]
    fn eliminate_set<W: Rounding>(
        device: &Device<K>,
        joints: &K::Joints<K::Scalar>,
        given: SetInputs<'_, Self>,
        environment: &Environment<K::Scalar>,
        assembly: &mut Assembly<K::Scalar>,
        scratch: &mut Option<K::Gains<K::Scalar>>,
        index: &mut usize,
    ) -> Result<(), SolveError<K::Scalar>> {
        W::eliminate_device(
            device,
            joints,
            given,
            environment,
            EliminationOutputs { assembly, gains: scratch },
            *index,
        )?;
        *index = index.wrapping_add(1);
        Ok(())
    }

    #[inline(always)]
    fn back_substitute(
        _: &Device<K>,
        scratch: &Option<K::Gains<K::Scalar>>,
        hub: &Solution<K::Scalar>,
        out: &mut K::Accelerations<K::Scalar>,
    ) {
        if let Some(gains) = scratch {
            *out = K::back_substitute(gains, &hub.expressed_in_b());
        }
    }

    fn add_sums(
        device: &Device<K>,
        joints: &K::Joints<K::Scalar>,
        r_b_n_dot: Vec3<K::Scalar>,
        omega: Vec3<K::Scalar>,
        sums: &mut BodySums<K::Scalar>,
    ) {
        device.add_sums(joints, r_b_n_dot, omega, sums);
    }

    fn add_first_moment(
        device: &Device<K>,
        joints: &K::Joints<K::Scalar>,
        moment: &mut [Vec3<K::Scalar>; 2],
    ) {
        device.add_first_moment(joints, moment);
    }

    fn loads(
        device: &Device<K>,
        joints: &K::Joints<K::Scalar>,
        given: SetInputs<'_, Self>,
        environment: &Environment<K::Scalar>,
        hub: &HubAccelerations<K::Scalar>,
        accelerations: &K::Accelerations<K::Scalar>,
        along: &Along<K::Scalar>,
        out: &mut Self::Loads,
        totals: &mut LoadSums<K::Scalar>,
    ) {
        *out = device.loads(joints, given, environment, hub, accelerations, along, totals);
    }
}

impl<K: Kind> FixedSet for K {
    fn at_rest() -> K::Joints<K::Scalar> {
        <K as Kind>::at_rest()
    }

    fn motors_off() -> K::Motors {
        <K as Kind>::motors_off()
    }

    fn all<V: Value>(value: V) -> K::PerJoint<V> {
        <K as Kind>::all(value)
    }

    fn modes() -> K::PerJoint<Mode<K::Scalar>> {
        let mut modes = <K as Kind>::all(Mode::Driven);
        for (mode, info) in modes.values_mut().zip(K::JOINTS) {
            *mode = info.own_mode();
        }
        modes
    }

    fn joint_infos() -> impl Iterator<Item = &'static JointInfo> {
        K::JOINTS.iter()
    }
}
