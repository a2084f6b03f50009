//! [`AnyDevice`]: a device whose kind is known only at run time, for lists read from a file.
//!
//! The same equations behind a pointer: every call goes through a table of functions, and every
//! joint's data stand in vectors in the order of the joints, from the hub to the tip. For the
//! desktop; an array or a tuple of kinds costs neither.

use alloc::boxed::Box;
use alloc::sync::Arc;
use alloc::vec;
use alloc::vec::Vec;
use core::any::Any;

use crate::equations::arithmetic::Rounding;
use crate::equations::assembly::Assembly;
use crate::equations::device_loads::{DeviceLoads, JointPower};
use crate::equations::error::SolveError;
use crate::equations::hub::BodySums;
use crate::equations::joint_inputs::Environment;
use crate::equations::load_sums::{Along, HubAccelerations, LoadSums};
use crate::equations::system::Solution;
use crate::generated::hub::ConstantShare;
use crate::model::kind::{JointInfo, Kind};
use crate::model::passive::Passive;
use crate::model::wrench::Wrench;
use crate::numbers::each::{Each, JointStates, Value};
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::Vec3;
use crate::sets::devices::{Devices, SetInputs};
use crate::sets::erased::{Ready, Stated};
use crate::validation::parameter_error::ParameterError;

/// A device of any kind, also of one from outside this crate.
///
/// ```
/// # use nalgebra::Matrix3;
/// use precess_dynamics::{AnyDevice, Hub, Inputs, SloshMass, Spacecraft, State, Vscmg};
///
/// # let hub = Hub { m_b: 50.0, r_bc_b: Default::default(), i_b_bc: Matrix3::identity() };
/// let list: Vec<AnyDevice> =
///     vec![Vscmg::bare_wheel(4.0, Matrix3::identity()).into(), SloshMass::bare_slosh_mass(2.0).into()];
/// let craft = Spacecraft::new(&hub, &list)?;
/// let names: Vec<_> = craft.joints().map(|(device, joint)| (device, joint.coordinate)).collect();
/// assert_eq!(names, [(0, "gamma"), (0, "theta"), (1, "x")]);
///
/// let mut state = State::at_rest_for(&craft);
/// state.devices[0].0[1] = [0.0, 100.0]; // theta and spin
/// let state = craft.step(&state, &Inputs::none_for(&craft), 1e-3)?;
/// # let _: State<Vec<AnyDevice>> = state;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct AnyDevice<T = f64>(Arc<dyn Stated<T>>);

/// Coordinate and rate of each joint, from the hub to the tip.
#[derive(Clone, Debug, PartialEq)]
pub struct AnyJoints<T = f64>(pub Vec<[T; 2]>);

/// A value for each joint, from the hub to the tip.
#[derive(Clone, Debug, PartialEq)]
pub struct AnyPerJoint<V>(pub Vec<V>);

/// Loads of a device of any kind.
pub type AnyLoads<T = f64> =
    DeviceLoads<AnyPerJoint<Wrench<T>>, AnyPerJoint<T>, AnyPerJoint<JointPower<T>>, T>;

impl<K: Kind> From<K> for AnyDevice<K::Scalar> {
    fn from(device: K) -> Self {
        Self(Arc::new(device))
    }
}

impl<T: Scalar> PartialEq for AnyDevice<T> {
    fn eq(&self, other: &Self) -> bool {
        self.0.same(other.0.as_any())
    }
}

impl<T: Scalar> AnyDevice<T> {
    /// The device as one of a kind, if it is.
    #[must_use]
    pub fn downcast<K: Kind<Scalar = T>>(&self) -> Option<&K> {
        self.0.as_any().downcast_ref()
    }
}

impl<T: Value> JointStates<T> for AnyJoints<T> {
    fn states(&self) -> impl Iterator<Item = [T; 2]> {
        self.0.iter().copied()
    }

    fn states_mut(&mut self) -> impl Iterator<Item = [&mut T; 2]> {
        self.0.iter_mut().map(|[coordinate, rate]| [coordinate, rate])
    }
}

impl<V: Value> Each<V> for AnyPerJoint<V> {
    fn values(&self) -> impl Iterator<Item = V> {
        self.0.iter().copied()
    }

    fn values_mut(&mut self) -> impl Iterator<Item = &mut V> {
        self.0.iter_mut()
    }
}

impl<T: Scalar> Devices for AnyDevice<T> {
    type Scalar = T;
    type Prepared = Arc<dyn Ready<T>>;
    type Joints = AnyJoints<T>;
    type Motors = AnyPerJoint<T>;
    type Accelerations = AnyPerJoint<T>;
    type PerJoint<V: Value> = AnyPerJoint<V>;
    type Loads = AnyLoads<T>;
    type Scratch = Option<Box<dyn Any>>;

    fn check(&self, device: &mut usize) -> Result<(), ParameterError<T>> {
        self.0.check(*device)?;
        *device = device.wrapping_add(1);
        Ok(())
    }

    fn prepare(&self) -> Arc<dyn Ready<T>> {
        self.0.ready()
    }

    fn constant_shares(device: &Arc<dyn Ready<T>>) -> impl Iterator<Item = ConstantShare<T>> {
        core::iter::once(device.constant_share())
    }

    fn infos(device: &Arc<dyn Ready<T>>) -> impl Iterator<Item = &'static JointInfo> {
        device.infos().iter()
    }

    fn excesses(device: &Arc<dyn Ready<T>>) -> impl Iterator<Item = T> {
        device.excesses().into_iter()
    }

    fn passives(device: &Arc<dyn Ready<T>>) -> impl Iterator<Item = Passive<T>> {
        device.passives().into_iter()
    }

    fn at_rest_for(device: &Arc<dyn Ready<T>>) -> AnyJoints<T> {
        AnyJoints(vec![[zero(); 2]; device.infos().len()])
    }

    fn motors_off_for(device: &Arc<dyn Ready<T>>) -> AnyPerJoint<T> {
        Self::all_for(device, zero())
    }

    fn no_accelerations_for(device: &Arc<dyn Ready<T>>) -> AnyPerJoint<T> {
        Self::all_for(device, zero())
    }

    fn all_for<V: Value>(device: &Arc<dyn Ready<T>>, value: V) -> AnyPerJoint<V> {
        AnyPerJoint(vec![value; device.infos().len()])
    }

    fn no_loads_for(device: &Arc<dyn Ready<T>>) -> AnyLoads<T> {
        DeviceLoads {
            mount: Wrench::none(),
            joints: Self::all_for(device, Wrench::none()),
            motors: Self::all_for(device, zero()),
            powers: Self::all_for(device, JointPower::none()),
        }
    }

    fn scratch(_: &Arc<dyn Ready<T>>) -> Option<Box<dyn Any>> {
        None
    }

    fn fits(
        device: &Arc<dyn Ready<T>>,
        joints: &AnyJoints<T>,
        given: Option<SetInputs<'_, Self>>,
        accelerations: Option<&AnyPerJoint<T>>,
    ) -> Result<(), SolveError<T>> {
        let expected = device.infos().len();
        let counts = [
            Some(joints.0.len()),
            given.map(|given| given.motors.0.len()),
            given.map(|given| given.modes.0.len()),
            given.and_then(|given| Some(given.bodies?.0.len())),
            accelerations.map(|found| found.0.len()),
        ];
        let wrong = counts.into_iter().flatten().find(|count| *count != expected);
        wrong.map_or(Ok(()), |found| Err(SolveError::Count { expected, found }))
    }

    fn eliminate_set<W: Rounding>(
        device: &Arc<dyn Ready<T>>,
        joints: &AnyJoints<T>,
        given: SetInputs<'_, Self>,
        environment: &Environment<T>,
        assembly: &mut Assembly<T>,
        scratch: &mut Option<Box<dyn Any>>,
        index: &mut usize,
    ) -> Result<(), SolveError<T>> {
        *scratch = Some(device.eliminate_erased(joints, given, environment, assembly, *index)?);
        *index = index.wrapping_add(1);
        Ok(())
    }

    fn back_substitute(
        device: &Arc<dyn Ready<T>>,
        scratch: &Option<Box<dyn Any>>,
        hub: &Solution<T>,
        out: &mut AnyPerJoint<T>,
    ) {
        let gains = scratch.as_deref();
        if let Some(found) = gains.and_then(|gains| device.back_substitute(gains, hub)) {
            *out = AnyPerJoint(found);
        }
    }

    fn add_sums(
        device: &Arc<dyn Ready<T>>,
        joints: &AnyJoints<T>,
        r_b_n_dot: Vec3<T>,
        omega: Vec3<T>,
        sums: &mut BodySums<T>,
    ) {
        device.add_sums(joints, r_b_n_dot, omega, sums);
    }

    fn add_first_moment(
        device: &Arc<dyn Ready<T>>,
        joints: &AnyJoints<T>,
        moment: &mut [Vec3<T>; 2],
    ) {
        device.add_first_moment(joints, moment);
    }

    fn loads(
        device: &Arc<dyn Ready<T>>,
        joints: &AnyJoints<T>,
        given: SetInputs<'_, Self>,
        environment: &Environment<T>,
        hub: &HubAccelerations<T>,
        accelerations: &AnyPerJoint<T>,
        along: &Along<T>,
        out: &mut AnyLoads<T>,
        totals: &mut LoadSums<T>,
    ) {
        *out = device.loads(joints, given, environment, hub, accelerations, along, totals);
    }
}
