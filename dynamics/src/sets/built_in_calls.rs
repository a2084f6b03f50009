//! What [`BuiltIn`] asks of the one kind it is: data of its joints into the kind's own structures,
//! and results out of them.

use crate::equations::arithmetic::Rounding;
use crate::equations::assembly::Assembly;
use crate::equations::device::Device;
use crate::equations::device_loads::{DeviceLoads, JointPower};
use crate::equations::error::SolveError;
use crate::equations::joint_inputs::{Environment, JointInputs};
use crate::equations::load_sums::{Along, HubAccelerations, LoadSums};
use crate::equations::system::Solution;
use crate::model::joint_array::{JointArray, MAX_JOINTS};
use crate::model::kernels::Kernels;
use crate::model::kind::{BodyParameters, Kind, no_inertia};
use crate::model::mode::Mode;
use crate::model::passive::Passive;
use crate::model::wrench::Wrench;
use crate::numbers::each::{Each, JointStates, Value};
use crate::numbers::real::{Scalar, zero};
use crate::sets::built_in::{BuiltIn, BuiltInLoads};
use crate::sets::device_parameters::{DeviceParameters, UnsupportedParameter};
use crate::sets::devices::{Devices, SetInputs};
use crate::validation::parameter_error::Parameter;

/// What back substitution needs of a device.
type Eliminated<K> =
    Result<Option<<K as Kernels>::Gains<<K as Kind>::Scalar>>, SolveError<<K as Kind>::Scalar>>;

/// The device of a kind with these parameters.
pub(crate) fn device_of<K: Kind>(
    parameters: &DeviceParameters<K::Scalar>,
) -> Result<K, UnsupportedParameter> {
    let mut bodies = <K as Kind>::all(no_body());
    copy(&mut bodies, parameters.bodies);
    let mut passive = <K as Kind>::all(Passive::none());
    copy(&mut passive, parameters.passive);
    let made = K::of_bodies(&parameters.mount, &bodies, &passive, parameters.model);
    let taken = made.bodies();
    for ((asked, taken), info) in bodies.values().zip(taken.values()).zip(K::JOINTS) {
        let unsupported =
            |parameter| Err(UnsupportedParameter { body: info.body, parameter: Some(parameter) });
        if !same(&asked.centre, &taken.centre) {
            return unsupported(Parameter::CentreOfMass);
        }
        if !same(asked.inertia.as_slice(), taken.inertia.as_slice()) {
            return unsupported(Parameter::Inertia);
        }
    }
    if made.model() != parameters.model {
        let body = K::JOINTS.last().map_or("device", |tip| tip.body);
        return Err(UnsupportedParameter { body, parameter: None });
    }
    Ok(made)
}

/// The parameters of a device.
pub(crate) fn parameters_of<K: Kind>(device: &K) -> DeviceParameters<K::Scalar> {
    let mut bodies = [no_body(); MAX_JOINTS];
    for (to, from) in bodies.iter_mut().zip(device.bodies().values()) {
        *to = from;
    }
    let mut passive = [Passive::none(); MAX_JOINTS];
    for (to, from) in passive.iter_mut().zip(device.passive().values()) {
        *to = from;
    }
    DeviceParameters { mount: *device.mount(), bodies, passive, model: device.model() }
}

/// Values of joints; `fill` where there is none.
pub(crate) fn joint_array<V: Value>(values: &impl Each<V>, fill: V) -> JointArray<V> {
    let mut array = JointArray::all(values.values().count(), fill);
    array.fill(values.values());
    array
}

/// Coordinates and rates in the kind's own structure.
pub(crate) fn joints<K: Kind>(array: &JointArray<[K::Scalar; 2]>) -> K::Joints<K::Scalar> {
    let mut joints = <K as Kind>::at_rest();
    for ([coordinate, rate], [from, rate_from]) in joints.states_mut().zip(array.states()) {
        (*coordinate, *rate) = (from, rate_from);
    }
    joints
}

/// As [`Devices::eliminate`]; what back substitution needs.
pub(crate) fn eliminate_typed<K: Kind, W: Rounding>(
    device: &Device<K>,
    array: &JointArray<[K::Scalar; 2]>,
    given: SetInputs<'_, BuiltIn<K::Scalar>>,
    environment: &Environment<K::Scalar>,
    assembly: &mut Assembly<K::Scalar>,
    index: &mut usize,
) -> Eliminated<K> {
    let mut gains = None;
    let typed = Typed::<K>::of(given);
    let joints = joints::<K>(array);
    <K as Devices>::eliminate_set::<W>(
        device,
        &joints,
        typed.given(),
        environment,
        assembly,
        &mut gains,
        index,
    )?;
    Ok(gains)
}

/// As [`Devices::back_substitute`].
pub(crate) fn back_substitute<K: Kind>(
    gains: &K::Gains<K::Scalar>,
    hub: &Solution<K::Scalar>,
    out: &mut JointArray<K::Scalar>,
) {
    out.fill(K::back_substitute(gains, &hub.expressed_in_b()).values());
}

/// As [`Devices::loads`].
#[expect(clippy::too_many_arguments, reason = "as `Devices::loads`")]
pub(crate) fn loads<K: Kind>(
    device: &Device<K>,
    array: &JointArray<[K::Scalar; 2]>,
    given: SetInputs<'_, BuiltIn<K::Scalar>>,
    environment: &Environment<K::Scalar>,
    hub: &HubAccelerations<K::Scalar>,
    accelerations: &JointArray<K::Scalar>,
    along: &Along<K::Scalar>,
    totals: &mut LoadSums<K::Scalar>,
) -> BuiltInLoads<K::Scalar> {
    let (joints, typed) = (joints::<K>(array), Typed::<K>::of(given));
    let mut of_joints = K::no_accelerations();
    copy(&mut of_joints, accelerations.values());
    let found = device.loads(&joints, typed.given(), environment, hub, &of_joints, along, totals);
    DeviceLoads {
        mount: found.mount,
        joints: joint_array(&found.joints, Wrench::none()),
        motors: joint_array(&found.motors, zero()),
        powers: joint_array(&found.powers, JointPower::none()),
    }
}

/// Motors, modes and wrenches of a device in its kind's own structures.
struct Typed<K: Kind> {
    motors: K::Motors,
    modes: K::PerJoint<Mode<K::Scalar>>,
    bodies: Option<K::PerJoint<Wrench<K::Scalar>>>,
}

impl<K: Kind> Typed<K> {
    fn of(given: SetInputs<'_, BuiltIn<K::Scalar>>) -> Self {
        let mut motors = <K as Kind>::motors_off();
        copy(&mut motors, given.motors.values());
        let mut modes = <K as Kind>::all(Mode::Driven);
        copy(&mut modes, given.modes.values());
        let bodies = given.bodies.map(|bodies| {
            let mut typed = <K as Kind>::all(Wrench::none());
            copy(&mut typed, bodies.values());
            typed
        });
        Self { motors, modes, bodies }
    }

    fn given(&self) -> SetInputs<'_, K> {
        JointInputs { motors: &self.motors, modes: &self.modes, bodies: self.bodies.as_ref() }
    }
}

fn copy<V: Value>(to: &mut impl Each<V>, from: impl IntoIterator<Item = V>) {
    for (to, from) in to.values_mut().zip(from) {
        *to = from;
    }
}

fn no_body<T: Scalar>() -> BodyParameters<T> {
    BodyParameters { origin: [zero(); 3], mass: zero(), centre: [zero(); 3], inertia: no_inertia() }
}

/// Whether all numbers are equal; what is no number equals itself, for validation to name.
fn same<T: Scalar>(a: &[T], b: &[T]) -> bool {
    a.iter().zip(b).all(|(a, b)| a == b || !(a.is_finite() || b.is_finite()))
}
