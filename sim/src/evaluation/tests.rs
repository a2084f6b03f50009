//! The evaluator against runs, differences and the ledger.

use std::ops::ControlFlow;
use std::path::Path;

use nalgebra::DVector;
use precess_dynamics::kind::Each;
use precess_dynamics::{About, JointStates, Outputs};

use super::*;
use crate::engine::run;
use crate::file::from_toml;
use crate::record::Samples;

/// Two wheels off balance and a panel with a spring, in motion.
fn scenario() -> Scenario {
    let text = r#"
format = 1
[hub]
mass = "350 kg"
inertia = "80, 70, 60 kg m^2"
centre_of_mass = "1, 2, -3 cm"
[initial]
angular_velocity = "0.01, -0.02, 0.03 rad/s"
[[device]]
name = "wheel1"
kind = "reaction_wheel"
position = "0.3, 0.1, 0 m"
mount = { spin_axis = [0, 0, 1] }
imbalance = { static = "100 g cm", dynamic = "2000 g cm^2" }
[device.wheel]
mass = "4 kg"
inertia = "288, 150, 150 kg cm^2"
rate = "300 rpm"
torque = "0.02 N m"
[[device]]
name = "panel"
kind = "hinged_panel"
position = "0, 0.6, 0 m"
[device.panel]
mass = "12 kg"
inertia = "3, 1, 4 kg m^2"
centre_of_mass = "0, 0.8, 0 m"
stiffness = "20 N m/rad"
[run]
duration = "0.05 s"
integrator = "rk4"
step = "1 ms"
[output]
rate = "1 kHz"
"#;
    from_toml("evaluated", text, Path::new("")).expect("a scenario").0
}

#[test]
fn a_flat_state_reads_back_and_has_the_names_of_columns() {
    let scenario = scenario();
    let evaluator = Evaluator::new(&scenario).expect("a spacecraft");
    let y = evaluator.pack(&evaluator.initial());
    assert_eq!(y.len(), evaluator.state_size());
    assert_eq!(evaluator.pack(&evaluator.unpack(&y).expect("its length")), y);
    let names: Vec<_> = evaluator.state_columns().into_iter().map(|column| column.name).collect();
    assert_eq!(names.len(), y.len());
    let ends = [&names[0], &names[6], &names[12], &names[13], &names[names.len() - 1]];
    assert_eq!(ends, ["position_x", "q0", "omega_z", "wheel1.theta", "panel.phi_dot"]);
    assert!(evaluator.unpack(&y[1..]).is_err());
}

#[test]
fn steps_are_bit_identical_to_a_run() {
    let scenario = scenario();
    let evaluator = Evaluator::new(&scenario).expect("a spacecraft");
    let mut samples = Samples::default();
    run(&scenario, &mut samples, &mut |_| ControlFlow::Continue(())).expect("it runs");
    let mut state = evaluator.initial();
    for step in 0..50 {
        let time = f64::from(step) * 1e-3;
        let inputs = evaluator.inputs(time, &state).expect("nothing sticks");
        state = evaluator.step(&state, &inputs, 1e-3).expect("a step");
    }
    let last = samples.rows.last().expect("samples");
    let header = samples.header.as_ref().expect("a header");
    let first = header.index("omega_x").expect("a column");
    assert_eq!(&last[first..first + 3], state.omega.as_slice());
}

#[test]
fn sliding_friction_is_evaluated_and_sticking_is_an_error() {
    let text = include_str!("../../../scenarios/sticking-wheel.toml");
    let read = from_toml("sticking", text, Path::new(""));
    let (scenario, _) = read.unwrap_or_else(|errors| panic!("{errors}"));
    let evaluator = Evaluator::new(&scenario).expect("a spacecraft");
    let mut state = evaluator.initial();
    let joint = || "wheel.theta".to_owned();
    let at_rest = evaluator.inputs(0.0, &state).expect_err("only a run decides it");
    assert_eq!(at_rest, EvaluationError::Sticks { joint: joint() });
    if let Some([_, rate]) = state.devices.states_mut().next() {
        *rate = -50.0;
    }
    // Well above the rate of Stribeck, 1 rad/s, and a motor of 1 mN m/s.
    let inputs = evaluator.inputs(0.5, &state).expect("it slides");
    let torque = inputs.motors.values().next().expect("a motor");
    assert!((torque - (0.5e-3 + 0.5e-3 + 2e-8 * 2500.0)).abs() < 1e-18, "{torque}");
    let none: [&str; 0] = [];
    let rejected = evaluator.linearize(&state, &inputs, &Outputs::accelerations(), &none);
    assert_eq!(rejected, Err(EvaluationError::Friction { joint: joint() }));
    let rejected = evaluator.linearize_steps(&state, &inputs, (1e-3, 1), &none);
    assert_eq!(rejected, Err(EvaluationError::Friction { joint: joint() }));
    let left_out = ["friction that sticks or quadratic drag of wheel.theta"];
    assert_eq!(scenario.not_described(), left_out);
    assert_eq!(scenario.not_in_c_solver(), left_out);
}

#[test]
fn mass_matrix_and_bias_return_the_inputs_of_the_accelerations() {
    let scenario = scenario();
    let evaluator = Evaluator::new(&scenario).expect("a spacecraft");
    let state = evaluator.initial();
    let inputs = evaluator.inputs(0.0, &state).expect("nothing sticks");
    let found = evaluator.accelerations(&state, &inputs).expect("accelerations");
    let MassMatrix { matrix, bias, coordinates } =
        evaluator.mass_matrix(&state, &inputs).expect("a mass matrix");
    assert_eq!(coordinates[6..], ["wheel1.spin_dot", "panel.phi_ddot"]);
    let hub = found.r_b_n_ddot.iter().chain(found.omega_dot.iter()).copied();
    let a: Vec<_> = hub.chain(found.devices.values()).collect();
    let forces = &matrix * DVector::from_vec(a) + &bias;
    let motors: Vec<_> = inputs.motors.values().collect();
    let scale = bias.amax().max(1.0);
    for (force, expected) in forces.iter().zip([0.0; 6].iter().chain(&motors)) {
        assert!((force - expected).abs() < 1e-12 * scale, "{force} for {expected}");
    }
    assert!((&matrix - matrix.transpose()).amax() < 1e-12 * matrix.amax());
    // T = v' M v / 2 of a state with B along N.
    let mut v = vec![0.1, -0.2, 0.3, 0.01, -0.02, 0.03];
    v.extend(state.devices.states().map(|[_, rate]| rate));
    let mut moving = state.clone();
    moving.r_b_n_dot = nalgebra::Vector3::new(0.1, -0.2, 0.3);
    let energy = evaluator.energy_and_momentum(&moving, About::InertialOrigin).expect("energy");
    let v = DVector::from_vec(v);
    let expected = 0.5 * (v.transpose() * &matrix * &v)[(0, 0)];
    assert!((energy.energy / expected - 1.0).abs() < 1e-12);
}

#[test]
fn columns_by_parameters_are_those_of_differences() {
    let scenario = scenario();
    let evaluator = Evaluator::new(&scenario).expect("a spacecraft");
    let mut state = evaluator.initial();
    // Off the rest of its spring, whose stiffness has no effect there.
    if let Some([phi, _]) = state.devices.states_mut().nth(1) {
        *phi = 0.2;
    }
    let inputs = evaluator.inputs(0.0, &state).expect("nothing sticks");
    // Each with a step of differences that is small beside what it is added to.
    let steps = [
        ("hub.m_b", 1e-2),
        ("hub.i_b_bc_xy", 1e-3),
        ("wheel1.d", 1e-7),
        ("panel.passive.panel.stiffness", 1e-2),
    ];
    let names = steps.map(|(name, _)| name);
    let outputs = Outputs::accelerations();
    let found = evaluator.linearize(&state, &inputs, &outputs, &names).expect("matrices");
    assert_eq!(found.parameters, names);
    assert_eq!(found.outputs[..2], ["acceleration_b_x", "acceleration_b_y"]);
    for (column, (name, step)) in steps.iter().enumerate() {
        let parameters = Parameter::named(&scenario, &[name]).expect("known");
        let value = parameters[0].value(&scenario.hub, &scenario.devices).expect("a number");
        let shifted = |by: f64| {
            let mut other = scenario.clone();
            assert!(parameters[0].set(&mut other.hub, &mut other.devices, value + by));
            let evaluator = Evaluator::new(&other).expect("a spacecraft");
            let found = evaluator.accelerations(&state, &inputs).expect("accelerations");
            let hub = found.r_b_n_ddot.iter().chain(found.omega_dot.iter()).copied();
            DVector::from_vec(hub.chain(found.devices.values()).collect())
        };
        let slope = (shifted(*step) - shifted(-*step)) / (2.0 * step);
        let exact = found.q.column(column);
        let scale = exact.amax();
        assert!(scale > 0.0, "{name}");
        assert!((slope - exact).amax() < 1e-6 * scale, "{name}");
    }
    let error = evaluator.linearize(&state, &inputs, &outputs, &["wheel1.m_v"]);
    assert!(error.is_err_and(|error| error.to_string().contains("`wheel1.m_w`")));
}

#[test]
fn loads_and_ledger_are_those_of_a_run() {
    let mut scenario = scenario();
    scenario.output.columns = vec!["loads".to_owned(), "energy".to_owned()];
    let evaluator = Evaluator::new(&scenario).expect("a spacecraft");
    let mut samples = Samples::default();
    run(&scenario, &mut samples, &mut |_| ControlFlow::Break(())).expect("it runs");
    let state = evaluator.initial();
    let inputs = evaluator.inputs(0.0, &state).expect("nothing sticks");
    let found = evaluator.accelerations(&state, &inputs).expect("accelerations");
    let loads = evaluator.loads(&state, &inputs, &found).expect("loads");
    let header = samples.header.as_ref().expect("a header");
    let recorded = |name: &str| samples.rows[0][header.index(name).expect("a column")];
    for (column, value) in evaluator.load_columns().iter().zip(&loads) {
        assert_eq!(recorded(&column.name), *value, "{}", column.name);
    }
    let ledger = evaluator.ledger(&state, &inputs, &found).expect("a ledger");
    assert_eq!(recorded("energy"), ledger.energy());
}

/// A beam with two modes, a wheel at its tip, and a node at its root that carries nothing.
fn structure() -> Scenario {
    let text = r#"
format = 1
[hub]
mass = "40 kg"
centre_of_mass = "5, 0, 1 cm"
inertia = "3, 8, 7 kg m^2"
[initial]
angular_velocity = "0.1, -0.2, 0.3 rad/s"
velocity = "0.1, 0, -0.1 m/s"
[structure]
contains_devices = false
coordinates = [0.01, -0.02]
rates = [0.1, 0.2]
[[structure.point]]
name = "root"
[[structure.node]]
name = "root"
position = "0, 0, 0 m"
[[structure.node]]
name = "tip"
position = "1.2, 0, 0 m"
[[structure.mode]]
frequency = "9 Hz"
damping = 0.01
linear_momentum = [0, 0, 1.2]
angular_momentum = [0, -1.1, 0]
[[structure.mode.shape]]
node = "tip"
translation = [0, 0, 1.1]
rotation = [0, -1.3, 0]
[[structure.mode]]
frequency = "25 Hz"
damping = 0.02
linear_momentum = [0, 0.7, 0]
angular_momentum = [0.1, 0, 0.2]
[[structure.mode.shape]]
node = "tip"
translation = [0, 0.9, 0]
rotation = [0.2, 0, 2.0]
[[device]]
name = "rw"
kind = "reaction_wheel"
node = "tip"
mount = { spin_axis = [1, 1, 0] }
imbalance = { static = "20 g cm", dynamic = "30 g cm^2" }
[device.wheel]
mass = "2 kg"
inertia = "40, 25, 25 kg cm^2"
rate = "90 rpm"
torque = "5 mN m"
damping = "1 mN m s/rad"
[run]
duration = "0.4 s"
integrator = "rk4"
step = "1 ms"
"#;
    from_toml("structure", text, Path::new("")).expect("a scenario").0
}

/// A number of the inputs.
type Input = fn(&mut CraftInputs) -> &mut f64;

/// Of central differences with steps of 1e-4 of numbers of size one, relative to the largest of a column.
const DIFFERENCES: f64 = 1e-7;

#[test]
fn linearised_structure_is_that_of_differences() {
    let evaluator = Evaluator::new(&structure()).expect("a spacecraft");
    let state = evaluator.initial();
    let inputs = evaluator.inputs(0.0, &state).expect("nothing sticks");
    let (outputs, none) = (Outputs::accelerations(), &[] as &[&str]);
    let found = evaluator.linearize(&state, &inputs, &outputs, none).expect("derivatives");
    let columns = evaluator.state_columns();
    let place = |name: &String| columns.iter().position(|column| column.name == *name);
    // All but the attitude.
    let rows = found.states.iter().enumerate();
    let rows: Vec<_> = rows.filter_map(|(row, name)| Some((row, place(name)?))).collect();
    assert_eq!(rows.len() + 3, found.states.len());
    let slopes = |state: &CraftState, inputs: &CraftInputs| {
        let a = evaluator.accelerations(state, inputs).expect("accelerations");
        evaluator.derivative(&evaluator.pack(state), state, &a)
    };
    let compare = |column: &[f64], size: f64, [up, down]: [Vec<f64>; 2], name: &str| {
        let unit = column.iter().fold(0.0_f64, |unit, value| unit.max(value.abs()));
        for (row, place) in &rows {
            let slope = (up[*place] - down[*place]) / (2.0 * size);
            let error = (column[*row] - slope).abs();
            assert!(error <= DIFFERENCES * unit, "{} by {name}: {error:e}", found.states[*row]);
        }
    };
    for (number, at) in &rows {
        let size = 1e-4;
        let ends = [size, -size].map(|by| {
            let mut y = evaluator.pack(&state);
            y[*at] += by;
            slopes(&evaluator.unpack(&y).expect("its length"), &inputs)
        });
        compare(found.a.column(*number).as_slice(), size, ends, &found.states[*number]);
    }
    let by_inputs: [(&str, Input); 6] = [
        ("force_y", |of| &mut of.force.y),
        ("torque_z", |of| &mut of.torque_b.z),
        ("rw.u_w", |of| of.motors.values_mut().next().expect("a wheel")),
        ("modes.force_2", |of| &mut of.modal.forces[1]),
        ("tip.force_z", |of| &mut of.modal.mounts[0].force.z),
        ("tip.moment_x", |of| &mut of.modal.mounts[0].moment.x),
    ];
    for (name, input) in by_inputs {
        let number = found.inputs.iter().position(|other| other == name).expect(name);
        let ends = [1.0, -1.0].map(|by| {
            let mut changed = inputs.clone();
            *input(&mut changed) += by;
            slopes(&state, &changed)
        });
        compare(found.b.column(number).as_slice(), 1.0, ends, name);
    }
    let by_parameters = evaluator.linearize(&state, &inputs, &outputs, &["hub.m_b"]);
    assert_eq!(by_parameters, Err(EvaluationError::Flexible));
}

#[test]
fn linearised_steps_of_a_structure_are_those_of_steps() {
    let evaluator = Evaluator::new(&structure()).expect("a spacecraft");
    let state = evaluator.initial();
    let inputs = evaluator.inputs(0.0, &state).expect("nothing sticks");
    let none: &[&str] = &[];
    let found = evaluator.linearize_steps(&state, &inputs, (1e-3, 2), none).expect("derivatives");
    let stepped = |state: &CraftState| {
        let first = evaluator.step(state, &inputs, 1e-3).expect("a step");
        evaluator.step(&first, &inputs, 1e-3).expect("a step")
    };
    assert_eq!(found.state, stepped(&state));
    let number = |name: &str| found.states.iter().position(|other| other == name).expect(name);
    let size = 1e-4;
    let [up, down] = [size, -size].map(|by| {
        let mut changed = state.clone();
        changed.modal.eta[0] += by;
        stepped(&changed)
    });
    for (name, of) in [
        ("modes.eta_dot_1", [&up, &down].map(|of| of.modal.eta_dot[0])),
        ("velocity_z", [&up, &down].map(|of| of.r_b_n_dot.z)),
        ("omega_y", [&up, &down].map(|of| of.omega.y)),
    ] {
        let slope = (of[0] - of[1]) / (2.0 * size);
        let exact = found.a[(number(name), number("modes.eta_1"))];
        assert!((slope - exact).abs() <= DIFFERENCES * exact.abs(), "{name}: {slope}, {exact}");
    }
}

#[test]
fn mass_matrix_of_a_structure_returns_the_inputs_of_the_accelerations() {
    let evaluator = Evaluator::new(&structure()).expect("a spacecraft");
    let state = evaluator.initial();
    let mut inputs = evaluator.inputs(0.0, &state).expect("nothing sticks");
    inputs.modal.forces[1] = 0.7;
    let found = evaluator.accelerations(&state, &inputs).expect("accelerations");
    let MassMatrix { matrix, bias, coordinates } =
        evaluator.mass_matrix(&state, &inputs).expect("a mass matrix");
    let names = ["rw.spin_dot", "structure.eta_ddot_1", "structure.eta_ddot_2"];
    assert_eq!(coordinates[6..], names);
    let hub = found.r_b_n_ddot.iter().chain(found.omega_dot.iter()).copied();
    let joints = found.devices.values().chain(found.modal.eta_ddot);
    let forces = &matrix * DVector::from_vec(hub.chain(joints).collect()) + &bias;
    let motor = inputs.motors.values().next().expect("a wheel");
    let expected = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, motor, 0.0, 0.7];
    for (force, expected) in forces.iter().zip(expected) {
        assert!((force - expected).abs() < 1e-12 * bias.amax(), "{force} for {expected}");
    }
    assert!((&matrix - matrix.transpose()).amax() < 1e-12 * matrix.amax());
    // A mode has the mass one; the wheel moves with it.
    assert!((matrix[(7, 7)] - (1.0 + 2.0 * 1.1 * 1.1)).abs() < 0.1, "{}", matrix[(7, 7)]);
}
