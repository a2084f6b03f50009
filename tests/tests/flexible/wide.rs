//! A case in double-double, made of its parameters, and its variables changed by hand.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::{Each, JointStates, Kind, Value};
use precess_dynamics::set::{Change, OnMount, WithNumbers};
use precess_dynamics::{
    ContainedBody, DeviceSet, Devices, Flexible, Gravity, HubMode, Inputs, ListedModes, ModalMount,
    ModalPoint, Mode, Modes, ParameterValue, Quaternion, Real, Scalar, Spacecraft, State, Variable,
    Wrench,
};
use precess_tests::differences::{index, turned};
use precess_tests::double_double::DoubleDouble as Wide;

use crate::craft::Case;

/// State and inputs in double-double.
#[derive(Clone)]
pub(crate) struct Point<D: Devices<Scalar = Wide>> {
    pub(crate) state: State<D, Quaternion<Wide>, Flexible<ListedModes>>,
    pub(crate) inputs: Inputs<D, Flexible<ListedModes>>,
}

/// The spacecraft of a case with so many residual coordinates.
pub(crate) fn craft<D: WithNumbers<Scalar = f64>>(
    case: &Case<D>,
    residual: usize,
    on_mount: &<D::With<Wide> as DeviceSet>::Per<OnMount>,
) -> Spacecraft<D::With<Wide>, Flexible<ListedModes>> {
    let mut devices = case.devices.with_numbers(Wide::from_f64);
    devices.change(&mut Orthonormal);
    let hub = case.hub.map(Wide::from_f64);
    let Modes { frequencies, damping, linear, angular, mounts } = &case.modes;
    let modes = Modes {
        frequencies: numbers(frequencies),
        damping: numbers(damping),
        linear: vectors(linear),
        angular: vectors(angular),
        mounts: mounts.iter().map(mount).collect(),
    };
    Spacecraft::flexible_with_residual(&hub, &modes, residual, &devices, on_mount)
        .unwrap_or_else(|error| panic!("seed {:#x}: {error}", case.seed))
}

impl<D: Devices<Scalar = Wide>> Point<D> {
    /// Those of a case, number by number.
    pub(crate) fn new<E: Devices<Scalar = f64>>(
        craft: &Spacecraft<D, Flexible<ListedModes>>,
        case: &Case<E>,
    ) -> Self {
        let wide = Wide::from_f64;
        let (of, given) = (&case.state, &case.inputs);
        let mut state = State::at_rest_for(craft);
        (state.r_b_n, state.r_b_n_dot) = (vector(&of.r_b_n), vector(&of.r_b_n_dot));
        state.omega = vector(&of.omega);
        let Quaternion { q0, q1, q2, q3 } = of.attitude;
        let [q0, q1, q2, q3] = [q0, q1, q2, q3].map(wide);
        state.attitude = Quaternion { q0, q1, q2, q3 };
        for (to, from) in state.devices.states_mut().zip(of.devices.states()) {
            for (to, from) in to.into_iter().zip(from) {
                *to = wide(from);
            }
        }
        state.modal.eta = numbers(&of.modal.eta);
        state.modal.eta_dot = numbers(&of.modal.eta_dot);
        let mut inputs = Inputs::none_for(craft);
        (inputs.force, inputs.torque_b) = (vector(&given.force), vector(&given.torque_b));
        copy(&mut inputs.motors, &given.motors, wide);
        copy(&mut inputs.modes, &given.modes, |mode| match mode {
            Mode::Driven => Mode::Driven,
            Mode::Prescribed(value) => Mode::Prescribed(wide(value)),
            Mode::Locked => Mode::Locked,
        });
        inputs.hub = match &given.hub {
            HubMode::Free => HubMode::Free,
            HubMode::Fixed => HubMode::Fixed,
            HubMode::Prescribed { r_b_n_ddot, omega_dot } => {
                HubMode::Prescribed { r_b_n_ddot: vector(r_b_n_ddot), omega_dot: vector(omega_dot) }
            }
        };
        inputs.gravity = match &given.gravity {
            Gravity::None => Gravity::None,
            Gravity::Uniform(g) => Gravity::Uniform(vector(g)),
            Gravity::Central { mu } => Gravity::Central { mu: wide(*mu) },
        };
        inputs.bodies = given.bodies.as_ref().map(|bodies| {
            let mut to = Inputs::no_wrenches_for(craft);
            copy(&mut to, bodies, wrench);
            to
        });
        inputs.modal.forces = numbers(&given.modal.forces);
        inputs.modal.mounts = given.modal.mounts.iter().copied().map(wrench).collect();
        Self { state, inputs }
    }

    /// The same with a variable changed.
    pub(crate) fn changed(&self, variable: Variable, by: Wide) -> Self {
        let mut at = self.clone();
        let Self { state, inputs } = &mut at;
        let of = match variable {
            Variable::Position(axis) => &mut state.r_b_n[index(axis)],
            Variable::Velocity(axis) => &mut state.r_b_n_dot[index(axis)],
            Variable::Omega(axis) => &mut state.omega[index(axis)],
            Variable::Attitude(axis) => {
                state.attitude = turned(&state.attitude, axis, by);
                return at;
            }
            Variable::Coordinate(joint) => state.devices.states_mut().nth(joint).unwrap()[0],
            Variable::Rate(joint) => {
                let [_, rate] = state.devices.states_mut().nth(joint).unwrap();
                rate
            }
            Variable::ModalCoordinate(mode) => &mut state.modal.eta[mode],
            Variable::ModalRate(mode) => &mut state.modal.eta_dot[mode],
            Variable::Force(axis) => &mut inputs.force[index(axis)],
            Variable::TorqueB(axis) => &mut inputs.torque_b[index(axis)],
            Variable::Motor(joint) => inputs.motors.values_mut().nth(joint).unwrap(),
            Variable::BodyForce(joint, axis) => {
                let mut wrenches = inputs.bodies.iter_mut().flat_map(Each::values_mut);
                &mut wrenches.nth(joint).unwrap().force[index(axis)]
            }
            Variable::BodyMoment(joint, axis) => {
                let mut wrenches = inputs.bodies.iter_mut().flat_map(Each::values_mut);
                &mut wrenches.nth(joint).unwrap().moment[index(axis)]
            }
            Variable::ModalForce(mode) => &mut inputs.modal.forces[mode],
            Variable::MountForce(mount, axis) => &mut inputs.modal.mounts[mount].force[index(axis)],
            Variable::MountMoment(mount, axis) => {
                &mut inputs.modal.mounts[mount].moment[index(axis)]
            }
            Variable::Mu => match &mut inputs.gravity {
                Gravity::Central { mu } => mu,
                other => panic!("{other:?} is not central"),
            },
            Variable::HubAcceleration(axis) | Variable::HubAngularAcceleration(axis) => {
                let HubMode::Prescribed { r_b_n_ddot, omega_dot } = &mut inputs.hub else {
                    panic!("the hub is not prescribed");
                };
                let linear = matches!(variable, Variable::HubAcceleration(_));
                let of = if linear { r_b_n_ddot } else { omega_dot };
                &mut of[index(axis)]
            }
            other => panic!("{other} is not drawn here"),
        };
        *of = *of + by;
        at
    }
}

/// Makes each mount orthonormal to the rounding of double-double.
struct Orthonormal;

impl Change<Wide> for Orthonormal {
    fn change<K: Kind<Scalar = Wide>>(&mut self, device: &mut K) {
        let dot = |a: [Wide; 3], b: [Wide; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let unit = |a: [Wide; 3]| a.map(|x| x * dot(a, a).sqrt().recip());
        let column = |k: usize| [0, 1, 2].map(|row| device.mount()[(row, k)]);
        let x = unit(column(0));
        let (y, along) = (column(1), dot(x, column(1)));
        let y = unit([0, 1, 2].map(|k| y[k] - along * x[k]));
        let z = [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]];
        let mount = Matrix3::from_fn(|row, k| [x, y, z][k][row]);
        device.set_parameter("mount", ParameterValue::Matrix(mount)).unwrap();
    }
}

fn mount(of: &ModalMount<ListedModes>) -> ModalMount<ListedModes, Wide> {
    let ModalMount { point: ModalPoint { position, translation, rotation }, contained } = of;
    ModalMount {
        point: ModalPoint {
            position: vector(position),
            translation: vectors(translation),
            rotation: vectors(rotation),
        },
        contained: contained.map(|ContainedBody { mass, centre, inertia }| ContainedBody {
            mass: Wide::from_f64(mass),
            centre: vector(&centre),
            inertia: inertia.map(Wide::from_f64),
        }),
    }
}

fn numbers(of: &[f64]) -> Vec<Wide> {
    of.iter().copied().map(Wide::from_f64).collect()
}

fn vector(of: &Vector3<f64>) -> Vector3<Wide> {
    of.map(Wide::from_f64)
}

fn vectors(of: &[Vector3<f64>]) -> Vec<Vector3<Wide>> {
    of.iter().map(vector).collect()
}

fn wrench(of: Wrench) -> Wrench<Wide> {
    Wrench { force: vector(&of.force), moment: vector(&of.moment) }
}

/// Copies value by value.
fn copy<V: Value, W: Value>(to: &mut impl Each<V>, from: &impl Each<W>, of: impl Fn(W) -> V) {
    for (to, from) in to.values_mut().zip(from.values()) {
        *to = of(from);
    }
}
