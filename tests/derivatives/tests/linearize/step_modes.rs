//! Linearised steps from rest, with fixed and prescribed hubs, locked and prescribed joints, against the step over dual
//! numbers.

use nalgebra::{DMatrix, Vector3};
use precess_dynamics::kind::{Each, JointStates};
use precess_dynamics::{Gravity, HubMode, Inputs, Mode, SolveError, Variable};

use crate::draw::{Case, Drawn, SEED};
use crate::perturb::changed;
use crate::step::{Number, row};

/// How many spacecraft of each sort.
const SPACECRAFT: u64 = 36;

/// Length of a step; shorter where springs and friction are stiff.
const DT: f64 = 0.01;
/// Of the largest element of a column: both are exact to rounding, 2e-14 at worst.
const ROUNDING: f64 = 1e-12;

/// The length of the step of a spacecraft.
fn length(case: &Case<f64>) -> f64 {
    match case.craft().step(&case.state, &case.inputs, DT) {
        Err(SolveError::Unstable { longest, .. }) => 0.5 * longest,
        found => found.map(|_| DT).unwrap(),
    }
}

/// The derivatives of the state after the step over dual numbers by all of these variables, six at a time.
fn over_dual_numbers(drawn: &Drawn, dt: f64, states: &[Variable], by: &[Variable]) -> DMatrix<f64> {
    let dual = drawn.case::<Number>();
    let craft = dual.craft();
    let mut found = DMatrix::zeros(states.len(), by.len());
    for (group, some) in by.chunks(6).enumerate() {
        let seeded = some.iter().enumerate().fold(dual.clone(), |case, (number, variable)| {
            changed(&case, *variable, Number::variable(0.0, number))
        });
        let Case { state, inputs, .. } = &seeded;
        let next = craft.step(state, inputs, Number::constant(dt)).unwrap();
        for number in 0..some.len() {
            let column = states.iter().map(|state| row(&next, *state, number));
            found
                .column_mut(6 * group + number)
                .iter_mut()
                .zip(column)
                .for_each(|(to, of)| *to = of);
        }
    }
    found
}

/// The largest error of an element, of the largest of its column.
fn error(drawn: &Drawn) -> f64 {
    let case = drawn.case::<f64>();
    let dt = length(&case);
    let found = case.craft().linearize_step(&case.state, &case.inputs, dt).unwrap();
    assert_eq!(found.state, case.craft().step(&case.state, &case.inputs, dt).unwrap());
    let mut worst = 0.0_f64;
    for (variables, matrix) in [(&found.states, &found.a), (&found.inputs, &found.b)] {
        let expected = over_dual_numbers(drawn, dt, &found.states, variables);
        for (found, expected) in matrix.column_iter().zip(expected.column_iter()) {
            let unit = expected.amax();
            let difference = (found - expected).amax();
            worst = worst.max(if unit > 0.0 { difference / unit } else { difference });
        }
    }
    worst
}

/// Of some spacecraft changed so.
fn check(change: impl Fn(&mut Case<f64>)) {
    let mut worst = 0.0_f64;
    for seed in SEED..SEED + SPACECRAFT {
        let mut drawn = Drawn::new(seed);
        change(&mut drawn.case);
        let error = error(&drawn);
        assert!(error <= ROUNDING, "{seed:#x}: {error:e}");
        worst = worst.max(error);
    }
    println!("worst {worst:.1e}");
}

fn stop_hub(case: &mut Case<f64>) {
    (case.state.r_b_n_dot, case.state.omega) = (Vector3::zeros(), Vector3::zeros());
}

#[test]
fn steps_of_drawn_spacecraft_are_those_of_dual_numbers() {
    check(|_| ());
}

/// Nothing acts and nothing moves: by the states the accelerations do not change, but for springs.
#[test]
fn steps_from_rest_without_a_field_are_those_of_dual_numbers() {
    check(|case| {
        stop_hub(case);
        let (craft, inputs) = (case.craft(), &mut case.inputs);
        (inputs.hub, inputs.gravity, inputs.bodies) = (HubMode::Free, Gravity::None, None);
        (inputs.force, inputs.torque_b) = (Vector3::zeros(), Vector3::zeros());
        inputs.motors.values_mut().for_each(|motor| *motor = 0.0);
        inputs.modes = Inputs::none_for(&craft).modes;
        case.state.devices.states_mut().for_each(|[_, rate]| *rate = 0.0);
    });
}

#[test]
fn steps_of_a_fixed_hub_are_those_of_dual_numbers() {
    check(|case| {
        stop_hub(case);
        case.inputs.hub = HubMode::Fixed;
    });
}

#[test]
fn steps_of_a_prescribed_hub_are_those_of_dual_numbers() {
    let (r_b_n_ddot, omega_dot) = (Vector3::new(0.3, -0.2, 0.5), Vector3::new(0.1, 0.4, -0.2));
    check(|case| case.inputs.hub = HubMode::Prescribed { r_b_n_ddot, omega_dot });
}

/// In turn driven, locked and prescribed.
#[test]
fn steps_with_locked_and_prescribed_joints_are_those_of_dual_numbers() {
    check(|case| {
        let driven: Vec<bool> = case.craft().joints().map(|(_, info)| info.driven).collect();
        let own = Inputs::none_for(&case.craft()).modes;
        let modes = case.inputs.modes.values_mut().zip(case.state.devices.states_mut());
        let modes = modes.zip(own.values()).zip(driven);
        for (number, (((mode, [_, rate]), own), driven)) in modes.enumerate() {
            match number % 3 {
                1 => (*mode, *rate) = (Mode::Locked, 0.0),
                2 if driven => *mode = Mode::Prescribed(0.7),
                _ => *mode = own,
            }
        }
    });
}
