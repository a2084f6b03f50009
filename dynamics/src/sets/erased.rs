//! A device of a kind that is known only at run time, as a table of functions: what
//! [`AnyDevice`](crate::AnyDevice) points to.

use alloc::boxed::Box;
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::any::Any;
use core::fmt::Debug;

use crate::equations::arithmetic::{EliminationOutputs, Rounding, Unfused};
use crate::equations::assembly::Assembly;
use crate::equations::device::Device;
use crate::equations::device_loads::DeviceLoads;
use crate::equations::error::SolveError;
use crate::equations::hub::BodySums;
use crate::equations::joint_inputs::{Environment, JointInputs};
use crate::equations::load_sums::{Along, HubAccelerations, LoadSums};
use crate::equations::system::Solution;
use crate::generated::hub::ConstantShare;
use crate::model::kind::{JointInfo, Kind};
use crate::model::mode::Mode;
use crate::model::passive::Passive;
use crate::model::wrench::Wrench;
use crate::numbers::each::{Each, JointStates, Value};
use crate::numbers::real::Scalar;
use crate::numbers::vec3::Vec3;
use crate::sets::any_device::{AnyDevice, AnyJoints, AnyLoads, AnyPerJoint};
use crate::sets::devices::SetInputs;
use crate::validation::check::check_device;
use crate::validation::parameter_error::ParameterError;

/// A kind's parameters behind a pointer.
pub(crate) trait Stated<T>: Debug + Send + Sync {
    /// Itself, to be compared.
    fn as_any(&self) -> &dyn Any;
    /// Whether it is the same device.
    fn same(&self, other: &dyn Any) -> bool;
    /// Checks the parameters.
    ///
    /// # Errors
    /// The first [`ParameterError`].
    fn check(&self, device: usize) -> Result<(), ParameterError<T>>;
    /// Made ready.
    fn ready(&self) -> Arc<dyn Ready<T>>;
}

impl<K: Kind> Stated<K::Scalar> for K {
    fn as_any(&self) -> &dyn Any {
        self
    }

    fn same(&self, other: &dyn Any) -> bool {
        other.downcast_ref::<K>() == Some(self)
    }

    fn check(&self, device: usize) -> Result<(), ParameterError<K::Scalar>> {
        check_device(device, self)
    }

    fn ready(&self) -> Arc<dyn Ready<K::Scalar>> {
        Arc::new(Device::new(self))
    }
}

/// Motors, modes and external wrenches of one device.
type Erased<'a, T> = SetInputs<'a, AnyDevice<T>>;

/// A precomputed device behind a pointer.
pub trait Ready<T>: Debug + Send + Sync {
    /// Its joints.
    fn infos(&self) -> &'static [JointInfo];
    /// Its constant share of the hub.
    fn constant_share(&self) -> ConstantShare<T>;
    /// By how much its inertias break the triangle inequality.
    fn excesses(&self) -> Vec<T>;
    /// Springs and friction.
    fn passives(&self) -> Vec<Passive<T>>;
    /// As [`Devices::eliminate`].
    ///
    /// # Errors
    /// The first [`SolveError`].
    fn eliminate_erased(
        &self,
        joints: &AnyJoints<T>,
        given: Erased<'_, T>,
        environment: &Environment<T>,
        assembly: &mut Assembly<T>,
        device: usize,
    ) -> Result<Box<dyn Any>, SolveError<T>>
    where
        T: Scalar;
    /// As [`Devices::back_substitute`].
    fn back_substitute(&self, gains: &dyn Any, hub: &Solution<T>) -> Option<Vec<T>>;
    /// As [`Devices::add_sums`].
    fn add_sums(
        &self,
        joints: &AnyJoints<T>,
        r_b_n_dot: Vec3<T>,
        omega: Vec3<T>,
        sums: &mut BodySums<T>,
    );
    /// As [`Devices::add_first_moment`].
    fn add_first_moment(&self, joints: &AnyJoints<T>, moment: &mut [Vec3<T>; 2]);
    /// As [`Devices::loads`].
    #[expect(clippy::too_many_arguments, reason = "state, inputs and accelerations, then results")]
    fn loads(
        &self,
        joints: &AnyJoints<T>,
        given: Erased<'_, T>,
        environment: &Environment<T>,
        hub: &HubAccelerations<T>,
        accelerations: &AnyPerJoint<T>,
        along: &Along<T>,
        totals: &mut LoadSums<T>,
    ) -> AnyLoads<T>
    where
        T: Scalar;
}

/// Motors, modes and wrenches of a device in its kind's own structures.
struct Typed<K: Kind> {
    motors: K::Motors,
    modes: K::PerJoint<Mode<K::Scalar>>,
    bodies: Option<K::PerJoint<Wrench<K::Scalar>>>,
}

impl<K: Kind> Typed<K> {
    fn of(given: Erased<'_, K::Scalar>) -> Self {
        let mut motors = K::motors_off();
        copy(&mut motors, given.motors);
        let mut modes = K::all(Mode::Driven);
        copy(&mut modes, given.modes);
        let bodies = given.bodies.map(|bodies| {
            let mut typed = K::all(Wrench::none());
            copy(&mut typed, bodies);
            typed
        });
        Self { motors, modes, bodies }
    }

    fn given(&self) -> SetInputs<'_, K> {
        JointInputs { motors: &self.motors, modes: &self.modes, bodies: self.bodies.as_ref() }
    }
}

fn copy<V: Value>(to: &mut impl Each<V>, from: &impl Each<V>) {
    for (to, from) in to.values_mut().zip(from.values()) {
        *to = from;
    }
}

fn joints_of<K: Kind>(any: &AnyJoints<K::Scalar>) -> K::Joints<K::Scalar> {
    let mut joints = K::at_rest();
    for ([coordinate, rate], [any_coordinate, any_rate]) in joints.states_mut().zip(any.states()) {
        (*coordinate, *rate) = (any_coordinate, any_rate);
    }
    joints
}

impl<K: Kind> Ready<K::Scalar> for Device<K> {
    fn infos(&self) -> &'static [JointInfo] {
        K::JOINTS
    }

    fn constant_share(&self) -> ConstantShare<K::Scalar> {
        K::constant_share(&self.constants)
    }

    fn excesses(&self) -> Vec<K::Scalar> {
        self.excess.values().collect()
    }

    fn passives(&self) -> Vec<Passive<K::Scalar>> {
        self.passive.values().collect()
    }

    fn eliminate_erased(
        &self,
        joints: &AnyJoints<K::Scalar>,
        given: Erased<'_, K::Scalar>,
        environment: &Environment<K::Scalar>,
        assembly: &mut Assembly<K::Scalar>,
        device: usize,
    ) -> Result<Box<dyn Any>, SolveError<K::Scalar>> {
        let (joints, typed) = (joints_of::<K>(joints), Typed::<K>::of(given));
        let mut gains = None;
        let places = EliminationOutputs { assembly, gains: &mut gains };
        Unfused::eliminate_device(self, &joints, typed.given(), environment, places, device)?;
        Ok(Box::new(gains))
    }

    fn back_substitute(
        &self,
        gains: &dyn Any,
        hub: &Solution<K::Scalar>,
    ) -> Option<Vec<K::Scalar>> {
        let gains = gains.downcast_ref::<Option<K::Gains<K::Scalar>>>()?.as_ref()?;
        Some(K::back_substitute(gains, &hub.expressed_in_b()).values().collect())
    }

    fn add_sums(
        &self,
        joints: &AnyJoints<K::Scalar>,
        r_b_n_dot: Vec3<K::Scalar>,
        omega: Vec3<K::Scalar>,
        sums: &mut BodySums<K::Scalar>,
    ) {
        self.add_sums(&joints_of::<K>(joints), r_b_n_dot, omega, sums);
    }

    fn add_first_moment(&self, joints: &AnyJoints<K::Scalar>, moment: &mut [Vec3<K::Scalar>; 2]) {
        self.add_first_moment(&joints_of::<K>(joints), moment);
    }

    fn loads(
        &self,
        joints: &AnyJoints<K::Scalar>,
        given: Erased<'_, K::Scalar>,
        environment: &Environment<K::Scalar>,
        hub: &HubAccelerations<K::Scalar>,
        accelerations: &AnyPerJoint<K::Scalar>,
        along: &Along<K::Scalar>,
        totals: &mut LoadSums<K::Scalar>,
    ) -> AnyLoads<K::Scalar> {
        let (joints, typed) = (joints_of::<K>(joints), Typed::<K>::of(given));
        let mut of_joints = K::no_accelerations();
        copy(&mut of_joints, accelerations);
        let given = typed.given();
        let found = self.loads(&joints, given, environment, hub, &of_joints, along, totals);
        DeviceLoads {
            mount: found.mount,
            joints: AnyPerJoint(found.joints.values().collect()),
            motors: AnyPerJoint(found.motors.values().collect()),
            powers: AnyPerJoint(found.powers.values().collect()),
        }
    }
}
