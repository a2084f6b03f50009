//! A linearised step of RK4 against the step over dual numbers.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::JointStates;
use precess_dynamics::set::WithNumbers;
use precess_dynamics::{
    Axis, Component, Dual, Gravity, Hub, Inputs, ParameterVariable, Passive, Quaternion,
    ReactionWheel, SloshMass, Spacecraft, State, Variable,
};
use precess_tests::differences::index;

pub(crate) type Set = (SloshMass, ReactionWheel);
/// With derivatives by six variables.
pub(crate) type Number = Dual<f64, 6>;
type Dualed = (SloshMass<Number>, ReactionWheel<Number>);

pub(crate) const DT: f64 = 0.05;
/// Of the largest element of a column: both are exact to rounding.
const ROUNDING: f64 = 1e-13;

pub(crate) fn spacecraft() -> (Hub, Set) {
    let hub =
        Hub { m_b: 80.0, r_bc_b: Vector3::new(0.1, 0.0, -0.2), i_b_bc: Matrix3::identity() * 9.0 };
    let mut slosh = SloshMass::bare_slosh_mass(7.0);
    slosh.r_s_b.y = 0.4;
    slosh.passive.slosh_mass = Passive::spring(3.0, 0.1);
    let disc = Matrix3::new(0.2, 0.0, 1e-4, 0.0, 0.1, 0.0, 1e-4, 0.0, 0.1);
    let wheel = ReactionWheel { d: 1e-3, ..ReactionWheel::bare_wheel(4.0, disc) };
    (hub, (slosh, wheel))
}

/// By emitted derivatives of a tree, and of devices on the hub.
pub(crate) const FIELDS: [Gravity; 3] =
    [Gravity::Central { mu: 40.0 }, Gravity::Uniform(Vector3::new(3.0, -8.0, 2.0)), Gravity::None];

pub(crate) fn start(gravity: Gravity) -> (State<Set>, Inputs<Set>) {
    let mut state: State<Set> = State::at_rest();
    state.r_b_n = Vector3::new(3.0, 4.0, -12.0);
    state.r_b_n_dot = Vector3::new(0.3, -0.1, 0.2);
    state.attitude = Quaternion { q0: 0.8, q1: 0.2, q2: -0.4, q3: 0.4 };
    state.omega = Vector3::new(0.5, -0.4, 0.7);
    (state.devices.0.x, state.devices.0.x_dot) = (0.05, -0.3);
    state.devices.1.spin = 30.0;
    let mut inputs: Inputs<Set> = Inputs::none();
    inputs.gravity = gravity;
    inputs.force = Vector3::new(1.0, -2.0, 0.5);
    inputs.motors.1.u_w = 0.3;
    (state, inputs)
}

/// The product of quaternions.
fn product<T: precess_dynamics::Scalar>(a: [T; 4], b: [T; 4]) -> [T; 4] {
    [
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    ]
}

/// The state after the step, with its derivatives by: a turn about x, omega.y, x and x' of the
/// slosh mass, the force along x, the wheel's motor.
fn over_dual_numbers(gravity: Gravity) -> State<Dualed> {
    let (hub, devices) = spacecraft();
    let craft = Spacecraft::new(&hub, &devices).unwrap().with_numbers(Number::constant);
    let (of, acting) = start(gravity);
    let constant = |v: Vector3<f64>| v.map(Number::constant);
    let mut state: State<Dualed> = State::at_rest();
    (state.r_b_n, state.r_b_n_dot) = (constant(of.r_b_n), constant(of.r_b_n_dot));
    state.omega = constant(of.omega);
    state.omega.y = Number::variable(of.omega.y, 1);
    let Quaternion { q0, q1, q2, q3 } = of.attitude;
    let zero = Number::constant(0.0);
    let half = Number::constant(0.5) * Number::variable(0.0, 0);
    let turn = [Number::constant(1.0), half, zero, zero];
    let [q0, q1, q2, q3] = product([q0, q1, q2, q3].map(Number::constant), turn);
    state.attitude = Quaternion { q0, q1, q2, q3 };
    state.devices.0.x = Number::variable(of.devices.0.x, 2);
    state.devices.0.x_dot = Number::variable(of.devices.0.x_dot, 3);
    state.devices.1.spin = Number::constant(of.devices.1.spin);
    let mut inputs: Inputs<Dualed> = Inputs::none();
    inputs.gravity = match gravity {
        Gravity::None => Gravity::None,
        Gravity::Uniform(g) => Gravity::Uniform(constant(g)),
        Gravity::Central { mu } => Gravity::Central { mu: Number::constant(mu) },
    };
    inputs.force = constant(acting.force);
    inputs.force.x = Number::variable(acting.force.x, 4);
    inputs.motors.1.u_w = Number::variable(acting.motors.1.u_w, 5);
    craft.step(&state, &inputs, Number::constant(DT)).unwrap()
}

/// What of a state belongs to a variable, by a number of the six.
pub(crate) fn row<D: WithNumbers<Scalar = Number>>(
    state: &State<D>,
    variable: Variable,
    number: usize,
) -> f64 {
    let joint = |joint| state.devices.states().nth(joint).unwrap();
    let of = match variable {
        Variable::Position(axis) => state.r_b_n[index(axis)],
        Variable::Velocity(axis) => state.r_b_n_dot[index(axis)],
        Variable::Omega(axis) => state.omega[index(axis)],
        Variable::Coordinate(of) => joint(of)[0],
        Variable::Rate(of) => joint(of)[1],
        Variable::Attitude(axis) => {
            let Quaternion { q0, q1, q2, q3 } = state.attitude;
            let q = [q0, q1, q2, q3];
            let [s, v @ ..] = q.map(|q| q.value);
            let size = s * s + v.iter().map(|v| v * v).sum::<f64>();
            let inverse = [s, -v[0], -v[1], -v[2]];
            let change = product(inverse, q.map(|q| q.derivative(number)));
            return 2.0 * change[1 + index(axis)] / size;
        }
        other => panic!("{other:?} is no state"),
    };
    of.derivative(number)
}

#[test]
fn linearised_step_is_that_of_dual_numbers() {
    FIELDS.into_iter().for_each(compare_with_dual_numbers);
}

fn compare_with_dual_numbers(gravity: Gravity) {
    let (hub, devices) = spacecraft();
    let craft = Spacecraft::new(&hub, &devices).unwrap();
    let (state, inputs) = start(gravity);
    let found = craft.linearize_step(&state, &inputs, DT).unwrap();
    assert_eq!(found.state, craft.step(&state, &inputs, DT).unwrap());
    let expected = over_dual_numbers(gravity);
    let by = [
        Variable::Attitude(Axis::X),
        Variable::Omega(Axis::Y),
        Variable::Coordinate(0),
        Variable::Rate(0),
        Variable::Force(Axis::X),
        Variable::Motor(1),
    ];
    for (number, variable) in by.into_iter().enumerate() {
        let place = |all: &[Variable]| all.iter().position(|other| *other == variable);
        let column: Vec<f64> = match (place(&found.states), place(&found.inputs)) {
            (Some(at), _) => found.a.column(at).iter().copied().collect(),
            (None, Some(at)) => found.b.column(at).iter().copied().collect(),
            (None, None) => panic!("{variable:?} is no column"),
        };
        let expected = found.states.iter().map(|state| row(&expected, *state, number));
        let expected: Vec<f64> = expected.collect();
        let unit = expected.iter().fold(0.0_f64, |unit, value| unit.max(value.abs()));
        for ((state, found), expected) in found.states.iter().zip(&column).zip(&expected) {
            let error = (found - expected).abs();
            assert!(error <= ROUNDING * unit, "{state:?} by {variable:?}: {found}, {expected}");
        }
    }
}

#[test]
fn step_by_a_parameter_is_the_difference_of_steps() {
    FIELDS.into_iter().for_each(compare_with_difference);
}

/// By the wheel's offset: half the difference of two steps, which errs by the square of the change.
fn compare_with_difference(gravity: Gravity) {
    let (hub, devices) = spacecraft();
    let (state, inputs) = start(gravity);
    let variable = ParameterVariable::Device { device: 1, name: "d", component: Component::Number };
    let at = (&state, &inputs);
    let found =
        Spacecraft::step_parameter_derivatives(&hub, &devices, at, DT, &[variable]).unwrap();
    let change = 1e-5;
    let stepped = |sign: f64| {
        let mut devices = devices;
        devices.1.d += sign * change;
        Spacecraft::new(&hub, &devices).unwrap().step(&state, &inputs, DT).unwrap()
    };
    let (less, more) = (stepped(-1.0), stepped(1.0));
    let craft = Spacecraft::new(&hub, &devices).unwrap();
    let states: Vec<_> = craft.state_variables(&inputs).collect();
    let unit = found.amax();
    assert!(unit > 1e-3, "{found}");
    for (row, variable) in states.iter().enumerate() {
        let difference = match variable {
            Variable::Omega(Axis::Z) => more.omega.z - less.omega.z,
            Variable::Velocity(Axis::Y) => more.r_b_n_dot.y - less.r_b_n_dot.y,
            Variable::Rate(1) => more.devices.1.spin - less.devices.1.spin,
            _ => continue,
        } / (2.0 * change);
        let found = found[(row, 0)];
        assert!((found - difference).abs() < 1e-7 * unit, "{variable:?}: {found}, {difference}");
    }
}
