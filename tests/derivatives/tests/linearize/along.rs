//! Changes along directions against the matrices that they are products with.

use nalgebra::{DMatrix, Matrix3, Vector3};
use precess_dynamics::kind::BodyParameters;
use precess_dynamics::{
    Axis, Component, DerivativeError, DeviceParameters, Gravity, Hub, ImbalanceModel, MAX_JOINTS,
    Outputs, ParameterDirection, ParameterVariable, Passive, Spacecraft, Variable,
};

use crate::step::{DT, FIELDS, Set, spacecraft, start};

/// Of the largest element of a column: sums in another order.
const ROUNDING: f64 = 1e-13;

/// The parameters along which the directions change something.
const BY: [ParameterVariable<'_>; 7] = [
    ParameterVariable::HubMass,
    ParameterVariable::HubInertia(Axis::X, Axis::Z),
    ParameterVariable::Device { device: 0, name: "m_s", component: Component::Number },
    ParameterVariable::Device { device: 0, name: "r_s_b", component: Component::Along(Axis::Y) },
    ParameterVariable::Device {
        device: 0,
        name: "passive.slosh_mass.stiffness",
        component: Component::Number,
    },
    ParameterVariable::Device { device: 1, name: "d", component: Component::Number },
    ParameterVariable::MountRotation { device: 1, about: Axis::X },
];
/// The changes of each direction by them.
const MULTIPLES: [[f64; 7]; 3] = [
    [2.0, 0.3, -0.4, 0.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, 0.5, 0.1, 0.7, 0.02, -0.3],
    [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
];
/// Of the force along `b_x` and of the motor.
const HELD: [[f64; 2]; 3] = [[0.0, 0.0], [1.5, 0.0], [-0.5, 0.2]];

fn unchanged() -> DeviceParameters {
    let body =
        BodyParameters { origin: [0.0; 3], mass: 0.0, centre: [0.0; 3], inertia: Matrix3::zeros() };
    DeviceParameters {
        mount: Matrix3::zeros(),
        bodies: [body; MAX_JOINTS],
        passive: [Passive::none(); MAX_JOINTS],
        model: ImbalanceModel::Coupled,
    }
}

fn directions((_, wheel): &Set) -> Vec<ParameterDirection> {
    let of = |([mass, product, slosh_mass, place, stiffness, d, turn], [force, motor]): (
        [f64; 7],
        [f64; 2],
    )| {
        let (mut first, mut second) = (unchanged(), unchanged());
        (first.bodies[0].mass, first.bodies[0].origin[1]) = (slosh_mass, place);
        first.passive[0].stiffness = stiffness;
        second.bodies[0].centre[1] = d;
        let turned = |column: usize| Vector3::x().cross(&wheel.mount.column(column)) * turn;
        second.mount = Matrix3::from_columns(&[turned(0), turned(1), turned(2)]);
        let inertia = Matrix3::new(0.0, 0.0, product, 0.0, 0.0, 0.0, product, 0.0, 0.0);
        ParameterDirection {
            hub: Hub { m_b: mass, r_bc_b: Vector3::zeros(), i_b_bc: inertia },
            devices: vec![first, second],
            held: vec![(Variable::Force(Axis::X), force), (Variable::Motor(1), motor)],
        }
    };
    MULTIPLES.into_iter().zip(HELD).map(of).collect()
}

/// Some changes of the state before the step.
fn changes(rows: usize) -> DMatrix<f64> {
    let float = |index: usize| f64::from(u16::try_from(index).expect("a small matrix"));
    DMatrix::from_fn(rows, 3, |row, column| (1.0 + float(row) * 0.7 + float(column) * 2.3).sin())
}

fn compare(found: &DMatrix<f64>, expected: &DMatrix<f64>) {
    assert_eq!(found.shape(), expected.shape());
    for (found, expected) in found.column_iter().zip(expected.column_iter()) {
        let apart = (found - expected).amax();
        assert!(apart <= ROUNDING * expected.amax(), "{found}{expected}");
    }
}

fn held(inputs: &[Variable]) -> DMatrix<f64> {
    let place = |variable| inputs.iter().position(|input| *input == variable).unwrap();
    let [force, motor] = [Variable::Force(Axis::X), Variable::Motor(1)].map(place);
    let mut held = DMatrix::zeros(inputs.len(), 3);
    for (column, of) in HELD.into_iter().enumerate() {
        (held[(force, column)], held[(motor, column)]) = (of[0], of[1]);
    }
    held
}

fn multiples() -> DMatrix<f64> {
    DMatrix::from_fn(BY.len(), 3, |row, column| MULTIPLES[column][row])
}

#[test]
fn step_along_directions_is_the_product_with_the_linearised_step() {
    for gravity in FIELDS.into_iter().skip(1) {
        let (hub, devices) = spacecraft();
        let craft = Spacecraft::new(&hub, &devices).unwrap();
        let (state, inputs) = start(gravity);
        let at = (&state, &inputs);
        let of = craft.linearize_step(&state, &inputs, DT).unwrap();
        let by = Spacecraft::step_parameter_derivatives(&hub, &devices, at, DT, &BY).unwrap();
        let (changes, directions) = (changes(of.states.len()), directions(&devices));
        let found = craft.step_along((&hub, &devices), at, DT, &changes, &directions);
        let (next, found) = found.unwrap().unwrap();
        assert_eq!(next, of.state);
        compare(&found, &(&of.a * changes + of.b * held(&of.inputs) + by * multiples()));
    }
}

#[test]
fn accelerations_along_directions_are_the_product_with_the_linearised_system() {
    for gravity in FIELDS.into_iter().skip(1) {
        let (hub, devices) = spacecraft();
        let craft = Spacecraft::new(&hub, &devices).unwrap();
        let (state, inputs) = start(gravity);
        let at = (&state, &inputs);
        let none = Outputs::accelerations();
        let of = craft.linearize(&state, &inputs, &none).unwrap();
        let mut by = Vec::new();
        let column = |_, column: &precess_dynamics::Column<Set>| by.extend(column.outputs());
        Spacecraft::parameter_derivatives(&hub, &devices, at, &none, BY, column).unwrap();
        let by = DMatrix::from_vec(of.outputs.len(), BY.len(), by);
        let (changes, directions) = (changes(of.states.len()), directions(&devices));
        let found = craft.accelerations_along((&hub, &devices), at, &changes, &directions);
        let (accelerations, found) = found.unwrap().unwrap();
        assert_eq!(accelerations, of.accelerations);
        compare(&found, &(&of.c * changes + of.d * held(&of.inputs) + by * multiples()));
    }
}

#[test]
fn directions_of_another_size_and_of_what_is_not_held_are_errors() {
    let (hub, devices) = spacecraft();
    let craft = Spacecraft::new(&hub, &devices).unwrap();
    let (state, inputs) = start(Gravity::None);
    let (of, at) = ((&hub, &devices), (&state, &inputs));
    let rows = craft.state_variables(&inputs).count();
    let found = |changes: &DMatrix<f64>, directions: &[ParameterDirection]| {
        craft.step_along(of, at, DT, changes, directions).unwrap_err()
    };
    let one = [ParameterDirection::none()];
    let length = |expected, found| DerivativeError::Length { expected, found };
    assert_eq!(found(&DMatrix::zeros(rows + 1, 1), &one), length(rows, rows + 1));
    assert_eq!(found(&DMatrix::zeros(rows, 2), &one), length(1, 2));
    for variable in [Variable::Rate(0), Variable::Coordinate(1), Variable::Gravity(Axis::X)] {
        let of = ParameterDirection { held: vec![(variable, 1.0)], ..ParameterDirection::none() };
        let rejected = found(&DMatrix::zeros(rows, 1), &[of]);
        assert_eq!(rejected, DerivativeError::NotAnInput { variable });
    }
    let many = ParameterDirection { devices: vec![unchanged(); 3], ..ParameterDirection::none() };
    let kept = craft.step_along(of, at, DT, &DMatrix::zeros(rows, 1), std::slice::from_ref(&many));
    assert!(kept.is_ok(), "what does not change is not looked up");
    let mut third = many;
    third.devices[2].bodies[0].mass = 1.0;
    let rejected = found(&DMatrix::zeros(rows, 1), &[third]);
    assert_eq!(rejected, DerivativeError::NoSuchDevice { device: 2, devices: 2 });
}

#[test]
fn a_central_field_has_no_changes_along_directions() {
    let (hub, devices) = spacecraft();
    let craft = Spacecraft::new(&hub, &devices).unwrap();
    let (state, inputs) = start(FIELDS[0]);
    let rows = craft.state_variables(&inputs).count();
    let (of, changes) = ((&hub, &devices), DMatrix::zeros(rows, 1));
    let one = [ParameterDirection::none()];
    assert!(craft.step_along(of, (&state, &inputs), DT, &changes, &one).unwrap().is_none());
    let found = craft.accelerations_along(of, (&state, &inputs), &changes, &one).unwrap();
    assert!(found.is_none());
}
