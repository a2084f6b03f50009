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
        let inputs = evaluator.inputs(time, &state);
        state = evaluator.step(&state, &inputs, 1e-3).expect("a step");
    }
    let last = samples.rows.last().expect("samples");
    let header = samples.header.as_ref().expect("a header");
    let first = header.index("omega_x").expect("a column");
    assert_eq!(&last[first..first + 3], state.rigid.omega.as_slice());
}

#[test]
fn mass_matrix_and_bias_return_the_inputs_of_the_accelerations() {
    let scenario = scenario();
    let evaluator = Evaluator::new(&scenario).expect("a spacecraft");
    let state = evaluator.initial();
    let inputs = evaluator.inputs(0.0, &state);
    let found = evaluator.accelerations(&state, &inputs).expect("accelerations").rigid;
    let MassMatrix { matrix, bias, coordinates } =
        evaluator.mass_matrix(&state, &inputs).expect("a mass matrix");
    assert_eq!(coordinates[6..], ["wheel1.spin_dot", "panel.phi_ddot"]);
    let hub = found.r_b_n_ddot.iter().chain(found.omega_dot.iter()).copied();
    let a: Vec<_> = hub.chain(found.devices.values()).collect();
    let forces = &matrix * DVector::from_vec(a) + &bias;
    let motors: Vec<_> = inputs.rigid.motors.values().collect();
    let scale = bias.amax().max(1.0);
    for (force, expected) in forces.iter().zip([0.0; 6].iter().chain(&motors)) {
        assert!((force - expected).abs() < 1e-12 * scale, "{force} for {expected}");
    }
    assert!((&matrix - matrix.transpose()).amax() < 1e-12 * matrix.amax());
    // T = v' M v / 2 of a state with B along N.
    let mut v = vec![0.1, -0.2, 0.3, 0.01, -0.02, 0.03];
    v.extend(state.rigid.devices.states().map(|[_, rate]| rate));
    let mut moving = state.clone();
    moving.rigid.r_b_n_dot = nalgebra::Vector3::new(0.1, -0.2, 0.3);
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
    if let Some([phi, _]) = state.rigid.devices.states_mut().nth(1) {
        *phi = 0.2;
    }
    let inputs = evaluator.inputs(0.0, &state);
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
            let found = evaluator.accelerations(&state, &inputs).expect("accelerations").rigid;
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
    let inputs = evaluator.inputs(0.0, &state);
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
