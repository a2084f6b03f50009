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
use crate::model::few::{Few, MAX_JOINTS};
use crate::model::kernels::Kernels;
use crate::model::kind::{BodyParameters, Kind, no_inertia};
use crate::model::mode::Mode;
use crate::model::passive::Passive;
use crate::model::wrench::Wrench;
use crate::numbers::each::{Each, JointStates, Value};
use crate::numbers::real::{Scalar, zero};
use crate::sets::built_in::{BuiltIn, BuiltInLoads};
use crate::sets::built_in_parameters::{BuiltInParameters, Misfit};
use crate::sets::devices::{Devices, SetInputs};
use crate::validation::parameter_error::Parameter;

/// What back substitution needs of a device.
type Eliminated<K> =
    Result<Option<<K as Kernels>::Gains<<K as Kind>::Scalar>>, SolveError<<K as Kind>::Scalar>>;

/// The device of a kind that is made of these bodies.
pub(crate) fn made<K: Kind>(stated: &BuiltInParameters<K::Scalar>) -> Result<K, Misfit> {
    let mut bodies = <K as Kind>::all(no_body());
    copy(&mut bodies, stated.bodies);
    let mut passive = <K as Kind>::all(Passive::none());
    copy(&mut passive, stated.passive);
    let made = K::of_bodies(&stated.mount, &bodies, &passive, stated.model);
    let taken = made.bodies();
    for ((asked, taken), info) in bodies.values().zip(taken.values()).zip(K::JOINTS) {
        let misfit = |parameter| Err(Misfit { body: info.body, parameter: Some(parameter) });
        if !same(&asked.centre, &taken.centre) {
            return misfit(Parameter::CentreOfMass);
        }
        if !same(asked.inertia.as_slice(), taken.inertia.as_slice()) {
            return misfit(Parameter::Inertia);
        }
    }
    if made.model() != stated.model {
        let body = K::JOINTS.last().map_or("device", |tip| tip.body);
        return Err(Misfit { body, parameter: None });
    }
    Ok(made)
}

/// The bodies of a device.
pub(crate) fn stated<K: Kind>(device: &K) -> BuiltInParameters<K::Scalar> {
    let mut bodies = [no_body(); MAX_JOINTS];
    for (to, from) in bodies.iter_mut().zip(device.bodies().values()) {
        *to = from;
    }
    let mut passive = [Passive::none(); MAX_JOINTS];
    for (to, from) in passive.iter_mut().zip(device.passive().values()) {
        *to = from;
    }
    BuiltInParameters { mount: *device.mount(), bodies, passive, model: device.model() }
}

/// Values of joints; `fill` stands where there is none.
pub(crate) fn few<V: Value>(values: &impl Each<V>, fill: V) -> Few<V> {
    let mut few = Few::all(values.values().count(), fill);
    few.fill(values.values());
    few
}

/// Coordinates and rates in the kind's own structure.
pub(crate) fn joints<K: Kind>(few: &Few<[K::Scalar; 2]>) -> K::Joints<K::Scalar> {
    let mut joints = <K as Kind>::at_rest();
    for ([coordinate, rate], [from, rate_from]) in joints.states_mut().zip(few.states()) {
        (*coordinate, *rate) = (from, rate_from);
    }
    joints
}

/// As [`Devices::eliminate`]; what back substitution needs.
pub(crate) fn eliminate_typed<K: Kind, W: Rounding>(
    device: &Device<K>,
    few: &Few<[K::Scalar; 2]>,
    given: SetInputs<'_, BuiltIn<K::Scalar>>,
    environment: &Environment<K::Scalar>,
    assembly: &mut Assembly<K::Scalar>,
    index: &mut usize,
) -> Eliminated<K> {
    let mut gains = None;
    let typed = Typed::<K>::of(given);
    let joints = joints::<K>(few);
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
    out: &mut Few<K::Scalar>,
) {
    out.fill(K::back_substitute(gains, &hub.expressed_in_b()).values());
}

/// As [`Devices::loads`].
#[expect(clippy::too_many_arguments, reason = "as `Devices::loads`")]
pub(crate) fn loads<K: Kind>(
    device: &Device<K>,
    few_joints: &Few<[K::Scalar; 2]>,
    given: SetInputs<'_, BuiltIn<K::Scalar>>,
    environment: &Environment<K::Scalar>,
    hub: &HubAccelerations<K::Scalar>,
    accelerations: &Few<K::Scalar>,
    along: &Along<K::Scalar>,
    totals: &mut LoadSums<K::Scalar>,
) -> BuiltInLoads<K::Scalar> {
    let (joints, typed) = (joints::<K>(few_joints), Typed::<K>::of(given));
    let mut of_joints = K::no_accelerations();
    copy(&mut of_joints, accelerations.values());
    let found = device.loads(&joints, typed.given(), environment, hub, &of_joints, along, totals);
    DeviceLoads {
        mount: found.mount,
        joints: few(&found.joints, Wrench::none()),
        motors: few(&found.motors, zero()),
        powers: few(&found.powers, JointPower::none()),
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
