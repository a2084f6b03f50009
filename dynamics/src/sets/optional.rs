//! A set that may be absent: `[Option<BuiltIn>; 8]` carries up to eight devices, without a heap.
//!
//! What is absent has no joints, counts as no device and costs nothing but its place.

#![expect(
    clippy::inline_always,
    reason = "fused numbers reach their instruction only where inlined"
)]

use crate::equations::arithmetic::Rounding;
use crate::equations::assembly::Assembly;
use crate::equations::error::SolveError;
use crate::equations::hub::BodySums;
use crate::equations::joint_inputs::{Environment, JointInputs};
use crate::equations::load_sums::{Along, HubAccelerations, LoadSums};
use crate::equations::system::Solution;
use crate::generated::hub::ConstantShare;
use crate::model::kind::JointInfo;
use crate::model::passive::Passive;
use crate::numbers::each::{Each, JointStates, Value};
use crate::numbers::vec3::Vec3;
use crate::sets::devices::{Devices, SetInputs};
use crate::validation::parameter_error::ParameterError;

impl<V: Value, P: Each<V>> Each<V> for Option<P> {
    fn values(&self) -> impl Iterator<Item = V> {
        self.iter().flat_map(P::values)
    }

    fn values_mut(&mut self) -> impl Iterator<Item = &mut V> {
        self.iter_mut().flat_map(P::values_mut)
    }
}

impl<T: Value, J: JointStates<T>> JointStates<T> for Option<J> {
    fn states(&self) -> impl Iterator<Item = [T; 2]> {
        self.iter().flat_map(J::states)
    }

    fn states_mut(&mut self) -> impl Iterator<Item = [&mut T; 2]> {
        self.iter_mut().flat_map(J::states_mut)
    }
}

impl<'a, M, P, W> JointInputs<'a, Option<M>, Option<P>, Option<W>> {
    /// What is given of the member that there is.
    fn present(self) -> Option<JointInputs<'a, M, P, W>> {
        let bodies = self.bodies.and_then(Option::as_ref);
        Some(JointInputs { motors: self.motors.as_ref()?, modes: self.modes.as_ref()?, bodies })
    }
}

impl<D: Devices> Devices for Option<D> {
    type Scalar = D::Scalar;
    type Prepared = Option<D::Prepared>;
    type Joints = Option<D::Joints>;
    type Motors = Option<D::Motors>;
    type Accelerations = Option<D::Accelerations>;
    type PerJoint<V: Value> = Option<D::PerJoint<V>>;
    type Loads = Option<D::Loads>;
    type Scratch = Option<D::Scratch>;

    fn check(&self, device: &mut usize) -> Result<(), ParameterError<D::Scalar>> {
        self.as_ref().map_or(Ok(()), |member| member.check(device))
    }

    fn prepare(&self) -> Self::Prepared {
        self.as_ref().map(D::prepare)
    }

    fn constant_shares(devices: &Self::Prepared) -> impl Iterator<Item = ConstantShare<D::Scalar>> {
        devices.iter().flat_map(D::constant_shares)
    }

    fn infos(devices: &Self::Prepared) -> impl Iterator<Item = &'static JointInfo> {
        devices.iter().flat_map(D::infos)
    }

    fn excesses(devices: &Self::Prepared) -> impl Iterator<Item = D::Scalar> {
        devices.iter().flat_map(D::excesses)
    }

    fn passives(devices: &Self::Prepared) -> impl Iterator<Item = Passive<D::Scalar>> {
        devices.iter().flat_map(D::passives)
    }

    fn at_rest_for(devices: &Self::Prepared) -> Self::Joints {
        devices.as_ref().map(D::at_rest_for)
    }

    fn motors_off_for(devices: &Self::Prepared) -> Self::Motors {
        devices.as_ref().map(D::motors_off_for)
    }

    fn no_accelerations_for(devices: &Self::Prepared) -> Self::Accelerations {
        devices.as_ref().map(D::no_accelerations_for)
    }

    fn all_for<V: Value>(devices: &Self::Prepared, value: V) -> Self::PerJoint<V> {
        devices.as_ref().map(|member| D::all_for(member, value))
    }

    fn no_loads_for(devices: &Self::Prepared) -> Self::Loads {
        devices.as_ref().map(D::no_loads_for)
    }

    fn scratch(devices: &Self::Prepared) -> Self::Scratch {
        devices.as_ref().map(D::scratch)
    }

    fn fits(
        devices: &Self::Prepared,
        joints: &Self::Joints,
        given: Option<SetInputs<'_, Self>>,
        accelerations: Option<&Self::Accelerations>,
    ) -> Result<(), SolveError<D::Scalar>> {
        let expected = usize::from(devices.is_some());
        let counts = [
            Some(joints.is_some()),
            given.map(|given| given.motors.is_some()),
            given.map(|given| given.modes.is_some()),
            given.and_then(|given| Some(given.bodies?.is_some())),
            accelerations.map(Option::is_some),
        ];
        let mut counts = counts.into_iter().flatten().map(usize::from);
        if let Some(found) = counts.find(|count| *count != expected) {
            return Err(SolveError::Count { expected, found });
        }
        let (Some(member), Some(joints)) = (devices, joints) else { return Ok(()) };
        D::fits(
            member,
            joints,
            given.and_then(JointInputs::present),
            accelerations.and_then(Option::as_ref),
        )
    }

    #[inline(always)]
    fn eliminate_set<W: Rounding>(
        devices: &Self::Prepared,
        joints: &Self::Joints,
        given: SetInputs<'_, Self>,
        environment: &Environment<D::Scalar>,
        assembly: &mut Assembly<D::Scalar>,
        scratch: &mut Self::Scratch,
        device: &mut usize,
    ) -> Result<(), SolveError<D::Scalar>> {
        let present = devices.as_ref().zip(joints.as_ref()).zip(given.present());
        if let (Some(((member, joints), given)), Some(scratch)) = (present, scratch) {
            D::eliminate_set::<W>(member, joints, given, environment, assembly, scratch, device)?;
        }
        Ok(())
    }

    #[inline(always)]
    fn back_substitute(
        devices: &Self::Prepared,
        scratch: &Self::Scratch,
        hub: &Solution<D::Scalar>,
        out: &mut Self::Accelerations,
    ) {
        if let (Some(member), Some(scratch), Some(out)) = (devices, scratch, out) {
            D::back_substitute(member, scratch, hub, out);
        }
    }

    fn add_sums(
        devices: &Self::Prepared,
        joints: &Self::Joints,
        r_b_n_dot: Vec3<D::Scalar>,
        omega: Vec3<D::Scalar>,
        sums: &mut BodySums<D::Scalar>,
    ) {
        if let (Some(member), Some(joints)) = (devices, joints) {
            D::add_sums(member, joints, r_b_n_dot, omega, sums);
        }
    }

    fn add_first_moment(
        devices: &Self::Prepared,
        joints: &Self::Joints,
        moment: &mut [Vec3<D::Scalar>; 2],
    ) {
        if let (Some(member), Some(joints)) = (devices, joints) {
            D::add_first_moment(member, joints, moment);
        }
    }

    fn loads(
        devices: &Self::Prepared,
        joints: &Self::Joints,
        given: SetInputs<'_, Self>,
        environment: &Environment<D::Scalar>,
        hub: &HubAccelerations<D::Scalar>,
        accelerations: &Self::Accelerations,
        along: &Along<D::Scalar>,
        out: &mut Self::Loads,
        totals: &mut LoadSums<D::Scalar>,
    ) {
        let present = devices.as_ref().zip(joints.as_ref()).zip(given.present());
        if let (Some(((member, joints), given)), Some(accelerations), Some(out)) =
            (present, accelerations, out)
        {
            D::loads(member, joints, given, environment, hub, accelerations, along, out, totals);
        }
    }
}
