//! Linearised systems with a closed form, symmetry, and conservation.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::Each;
use precess_dynamics::{
    Accelerations, Attitude, Axis, BalancedDgvscmg, HingedPanel, Hub, HubMode, Inputs,
    Linearization, Mode, Mrp, Output, Outputs, Passive, Quaternion, Spacecraft, State, Variable,
    hinged_panel,
};
use precess_tests::differences::index;

use crate::draw::{Drawn, List, SEED};
use crate::outputs::OUTPUTS;

/// A few units in the last place of numbers of about one.
const ROUNDING: f64 = 4e-15;

fn hub() -> Hub {
    let rows = [9.0, 0.5, 0.3, 0.5, 8.0, 0.2, 0.3, 0.2, 6.0];
    Hub { m_b: 80.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::from_row_slice(&rows) }
}

/// The element of a matrix by its variables.
fn element(
    of: &Linearization<impl precess_dynamics::Devices<Scalar = f64>>,
    row: Variable,
    column: Variable,
) -> f64 {
    let place = |variable| of.states.iter().position(|state| *state == variable).expect("a state");
    of.a[(place(row), place(column))]
}

#[test]
fn a_panel_on_a_spring_has_its_frequency_and_damping() {
    // About the hinge: 2 + 10 * 0.5² kg m².
    let inertia = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 2.0));
    let mut panel = HingedPanel::bare_panel(10.0, inertia);
    panel.r_pc_p = Vector3::new(0.0, 0.5, 0.0);
    panel.passive = hinged_panel::PerJoint::all(Passive::spring(18.0, 0.9));
    let craft = Spacecraft::new(&hub(), &[panel]).unwrap();
    let inputs = Inputs { hub: HubMode::Fixed, ..Inputs::none() };
    let state: State<[HingedPanel; 1]> = State::at_rest();
    let system = craft.linearize(&state, &inputs, &Outputs::accelerations()).unwrap();
    assert_eq!(system.states, [Variable::Coordinate(0), Variable::Rate(0)]);
    assert_eq!(system.inputs, [Variable::Motor(0)]);
    let expected = [0.0, 1.0, -4.0, -0.2];
    let found = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|place| system.a[place]);
    for (found, expected) in found.into_iter().zip(expected) {
        assert!((found - expected).abs() <= ROUNDING, "{:?}", system.a);
    }
    assert!((system.b[(1, 0)] - 1.0 / 4.5).abs() <= ROUNDING && system.b[(0, 0)] == 0.0);
}

#[test]
fn a_balanced_wheel_on_a_fixed_hub_precesses() {
    let (axial, across, spin) = (0.2, 0.1, 300.0);
    let mut wheel = BalancedDgvscmg::bare_wheel(4.0, axial, across);
    wheel.i_go_goc = Matrix3::identity() * 0.05;
    wheel.i_gi_gic = Matrix3::identity() * 0.03;
    let craft = Spacecraft::new(&hub(), &[wheel]).unwrap();
    let inputs = Inputs { hub: HubMode::Fixed, ..Inputs::none() };
    let mut state: State<[BalancedDgvscmg; 1]> = State::at_rest();
    state.devices[0].spin = spin;
    let system = craft.linearize(&state, &inputs, &Outputs::accelerations()).unwrap();
    // The moment of the spin J_11 Omega turned about y is along -z, about z along y.
    let (outer, inner) = (0.05 + 0.03 + across, 0.03 + across);
    let [outer_rate, inner_rate] = [0, 1].map(Variable::Rate);
    let by_inner = element(&system, outer_rate, inner_rate);
    let by_outer = element(&system, inner_rate, outer_rate);
    assert!((by_inner - axial * spin / outer).abs() <= 1e-12 * by_inner.abs(), "{by_inner}");
    assert!((by_outer + axial * spin / inner).abs() <= 1e-12 * by_outer.abs(), "{by_outer}");
    // So the gimbals nutate at J_11 Omega / sqrt(J_o J_i).
    let nutation = (-by_inner * by_outer).sqrt();
    assert!((nutation - axial * spin / (outer * inner).sqrt()).abs() <= 1e-12 * nutation);
}

#[test]
fn a_rigid_body_has_euler_s_equations_linearised() {
    let craft = Spacecraft::new(&hub(), &List::new()).unwrap();
    let mut state: State<List> = State::at_rest_for(&craft);
    state.attitude = Quaternion { q0: 0.5, q1: -0.5, q2: 0.1, q3: 0.7 };
    state.omega = Vector3::new(0.3, -0.2, 0.5);
    let mut inputs = Inputs::none_for(&craft);
    inputs.force = Vector3::new(8.0, -4.0, 2.0);
    let system = craft.linearize(&state, &inputs, &Outputs::accelerations()).unwrap();
    let (inertia, omega) = (hub().i_b_bc, state.omega);
    let inverse = inertia.try_inverse().unwrap();
    let euler = inverse * ((inertia * omega).cross_matrix() - omega.cross_matrix() * inertia);
    let tangent = -omega.cross_matrix();
    // d([BN]^T F / m) = [BN]^T (dtheta x F) / m.
    let turning = -state.attitude.dcm().transpose() * inputs.force.cross_matrix() / 80.0;
    for row in Axis::ALL {
        for column in Axis::ALL {
            let at = (index(row), index(column));
            let unit = if row == column { 1.0 } else { 0.0 };
            for (found, expected) in [
                ((Variable::Omega(row), Variable::Omega(column)), euler[at]),
                ((Variable::Attitude(row), Variable::Attitude(column)), tangent[at]),
                ((Variable::Attitude(row), Variable::Omega(column)), unit),
                ((Variable::Velocity(row), Variable::Attitude(column)), turning[at]),
                ((Variable::Position(row), Variable::Velocity(column)), unit),
                ((Variable::Omega(row), Variable::Attitude(column)), 0.0),
            ] {
                let (of, by) = found;
                let found = element(&system, of, by);
                assert!((found - expected).abs() <= ROUNDING, "{of} by {by}: {found}");
            }
            let inverse = inverse[at];
            assert!((system.b[(9 + at.0, 3 + at.1)] - inverse).abs() <= ROUNDING);
            let mass = system.c[(at.0, 0)];
            assert_eq!(mass, 0.0, "no field, no effect of the position");
        }
    }
    let names: Vec<_> =
        system.states.iter().map(|state| craft.variable_name(*state).to_string()).collect();
    assert_eq!(names[3..7], ["attitude.x", "attitude.y", "attitude.z", "r_b_n_dot.x"]);
    assert_eq!(system.outputs[3], Output::AngularAcceleration(Axis::X));
}

#[test]
fn the_tangent_is_that_of_every_parameterisation() {
    let drawn = Drawn::new(SEED + 1);
    let case = drawn.case::<f64>();
    let craft = case.craft();
    let State { r_b_n, r_b_n_dot, attitude, omega, devices, .. } = case.state.clone();
    let state =
        State { attitude: Mrp::from(attitude), r_b_n, r_b_n_dot, omega, devices, modal: () };
    let by_mrp = craft.linearize(&state, &case.inputs, &OUTPUTS).unwrap();
    let by_quaternion = craft.linearize(&case.state, &case.inputs, &OUTPUTS).unwrap();
    let unit = by_quaternion.a.amax();
    assert!((by_mrp.a - by_quaternion.a).amax() <= 1e-13 * unit);
}

/// By forces and torques the accelerations change by the inverse of the mass matrix.
#[test]
fn derivatives_by_forces_are_symmetric() {
    for seed in SEED..SEED + 30 {
        let mut case = Drawn::new(seed).case::<f64>();
        case.inputs.hub = HubMode::Free;
        let craft = case.craft();
        let forces: Vec<_> = craft
            .input_variables(&case.inputs)
            .filter(|input| {
                matches!(input, Variable::Force(_) | Variable::TorqueB(_) | Variable::Motor(_))
            })
            .collect();
        let mut columns = Vec::new();
        let outputs = Outputs::accelerations();
        craft
            .derivatives(
                &case.state,
                &case.inputs,
                &outputs,
                forces.iter().copied(),
                |_, column| {
                    let Accelerations { r_b_n_ddot, omega_dot, devices, .. } =
                        &column.accelerations;
                    let joints: Vec<_> = devices.values().collect();
                    let of = |force: &Variable| match *force {
                        Variable::Force(axis) => r_b_n_ddot[index(axis)],
                        Variable::TorqueB(axis) => omega_dot[index(axis)],
                        other => joints[other.joint().unwrap()],
                    };
                    columns.push(forces.iter().map(of).collect::<Vec<_>>());
                },
            )
            .unwrap();
        for (j, column) in columns.iter().enumerate() {
            assert!(column[j] > 0.0, "the inverse of a mass matrix is positive definite");
            for (k, other) in columns.iter().enumerate() {
                let unit = (column[j] * other[k]).sqrt();
                let apart = (column[k] - other[j]).abs();
                assert!(apart <= 1e-11 * unit, "seed {seed:#x}: {apart:e} of {unit:e}");
            }
        }
    }
}

/// Along the flow, momenta do not change without forces, and energy changes by the motors' power.
#[test]
fn momentum_is_constant_along_the_flow() {
    let mut cases = 0;
    for seed in SEED..SEED + 200 {
        let mut case = Drawn::new(seed).case::<f64>();
        case.inputs = Inputs { hub: HubMode::Free, ..Inputs::none_for(&case.craft()) };
        if case
            .devices
            .iter()
            .any(|device| device.parameters().model == precess_dynamics::ImbalanceModel::Lumped)
        {
            continue;
        }
        cases += 1;
        for motor in case.inputs.motors.values_mut() {
            *motor = 0.7;
        }
        let craft = case.craft();
        let about = precess_dynamics::About::InertialOrigin;
        let outputs = Outputs { momentum: Some(about), ..Outputs::accelerations() };
        let states: Vec<_> = craft.state_variables(&case.inputs).collect();
        let found = craft.accelerations(&case.state, &case.inputs).unwrap();
        let velocity = case.state.attitude.dcm().transpose() * found.r_b_n_ddot;
        let accelerations: Vec<_> = found.devices.values().collect();
        let rates: Vec<_> = precess_dynamics::kind::JointStates::states(&case.state.devices)
            .map(|[_, rate]| rate)
            .collect();
        let (mut sum, mut unit) = ([0.0; 7], [0.0; 7]);
        craft
            .derivatives(&case.state, &case.inputs, &outputs, states, |state, column| {
                let slope = match state {
                    Variable::Position(axis) => case.state.r_b_n_dot[index(axis)],
                    Variable::Attitude(axis) => case.state.omega[index(axis)],
                    Variable::Velocity(axis) => velocity[index(axis)],
                    Variable::Omega(axis) => found.omega_dot[index(axis)],
                    Variable::Coordinate(joint) => rates[joint],
                    Variable::Rate(joint) => accelerations[joint],
                    other => panic!("{other} is no state"),
                };
                let of = column.momentum.expect("requested");
                let numbers = of.momentum.linear.iter().chain(&of.momentum.angular);
                let numbers = numbers.copied().chain([of.energy]);
                for ((sum, unit), number) in sum.iter_mut().zip(&mut unit).zip(numbers) {
                    *sum += number * slope;
                    *unit += (number * slope).abs();
                }
            })
            .unwrap();
        let ledger = craft.ledger(&case.state, &case.inputs, &found).unwrap();
        sum[6] -= ledger.power.total();
        let share = |sum: &[f64], unit: &[f64]| {
            let unit = unit.iter().copied().fold(0.0, f64::max);
            sum.iter().map(|x| x.abs()).fold(0.0, f64::max) / unit
        };
        for range in [0..3, 3..6, 6..7] {
            let share = share(&sum[range.clone()], &unit[range]);
            assert!(share <= 1e-12, "seed {seed:#x}: {share:e}");
        }
    }
    assert!(cases > 80, "{cases}");
}

/// What is locked or fixed is no state; a column by its rate is there nevertheless.
#[test]
fn what_does_not_move_is_no_state() {
    let drawn = Drawn::new(SEED);
    let mut case = drawn.case::<f64>();
    let craft = case.craft();
    case.inputs = Inputs { hub: HubMode::Fixed, ..Inputs::none_for(&craft) };
    for mode in case.inputs.modes.values_mut() {
        *mode = Mode::Locked;
    }
    let still: State<List> = State::at_rest_for(&craft);
    assert_eq!(craft.state_variables(&case.inputs).count(), 0);
    let by = [Variable::Rate(0), Variable::Omega(Axis::X)];
    let mut columns = 0;
    let outputs = Outputs::accelerations();
    craft
        .derivatives(&still, &case.inputs, &outputs, by, |_, column| {
            assert!(column.accelerations.devices.values().all(|value| value == 0.0));
            columns += 1;
        })
        .unwrap();
    assert_eq!(columns, 2);
}
