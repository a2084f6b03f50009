//! Table 1 of the paper: drifts, the flight library's integrator, samples within steps.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::dgvscmg::MotorTorques;
use precess_dynamics::{Dgvscmg, Hub, Inputs, Spacecraft, State, dgvscmg};

use super::{DOP853, recorded, scenario, set_joint};
use crate::engine::{Advance, Run};
use crate::scenario::{Drive, IntegratorChoice, Profile, Scenario};

/// What ten seconds at tolerance 1e-13 may drift: a hundred times what a good integrator does.
const DRIFT: f64 = 1e-12;

/// Torques of the outer gimbal, the inner gimbal and the wheel, N m.
const MOTORS: [f64; 3] = [0.1, 0.1, 0.2];

/// The spacecraft as printed.
pub(crate) fn craft() -> (Hub, Dgvscmg) {
    let symmetric =
        |[a, b, c]: [f64; 3], [ab, ac, bc]: [f64; 3]| Matrix3::new(a, ab, ac, ab, b, bc, ac, bc, c);
    let gimbal = symmetric([9.0, 11.0, 5.0], [0.81, 0.24, 0.93]);
    let hub = Hub {
        m_b: 810.0,
        r_bc_b: Vector3::new(-0.02e-2, 0.01e-2, 10e-2),
        i_b_bc: symmetric([900.0, 800.0, 600.0], [4.15, 2.93, 2.75]),
    };
    let device = Dgvscmg {
        r_go_b: Vector3::new(0.3, 0.0, 0.0),
        m_go: 24.0,
        i_go_goc: gimbal,
        m_gi: 24.0,
        i_gi_gic: gimbal,
        d: 8e-3,
        ..Dgvscmg::bare_wheel(4.0, symmetric([0.2, 0.1, 0.1], [0.0, 0.0154, 0.0]))
    };
    (hub, device)
}

/// `count` of its devices, torques on.
pub(crate) fn table1(count: usize, duration: f64) -> Scenario {
    let (hub, device) = craft();
    let names: Vec<String> = (1..=count).map(|number| format!("cmg{number}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let devices = vec![device.into(); count];
    let mut scenario = scenario(&names, devices, duration);
    scenario.hub = hub;
    scenario.initial.omega = Vector3::new(4.85_f64.to_radians(), 0.57_f64.to_radians(), 0.0);
    for device in 0..count {
        set_joint(&mut scenario, 3 * device + 2, [0.0, spin()]);
    }
    for (joint, drive) in scenario.drives.iter_mut().enumerate() {
        *drive = Drive::Torque { profile: Profile::Constant(MOTORS[joint % 3]), limit: None };
    }
    scenario
}

fn spin() -> f64 {
    500.0 * std::f64::consts::TAU / 60.0
}

#[test]
fn conserved_quantities_drift_by_less_than_a_millionth_of_a_millionth() {
    for count in [1, 3] {
        let (outcome, _) = recorded(&table1(count, 10.0));
        let drift = outcome.drift;
        for part in [drift.energy, drift.linear, drift.angular] {
            assert!(part.is_some_and(|part| part < DRIFT), "{drift:?}");
        }
        assert_eq!(outcome.end_time, 10.0);
    }
}

#[test]
fn rk4_has_the_bits_of_a_loop_over_the_solvers_step() {
    let mut scenario = table1(1, 2.0);
    scenario.settings.integrator = IntegratorChoice::Rk4 { step: 1e-3 };
    // A sample in every third step, which must change nothing.
    scenario.output.rate = 1000.0 / 3.0;
    let (hub, device) = craft();
    let spacecraft = Spacecraft::new(&hub, &[device]).expect("Table 1");
    let mut state: State<[Dgvscmg; 1]> = State::at_rest();
    state.omega = scenario.initial.omega;
    state.devices[0].spin = spin();
    let [u_o, u_i, u_w] = MOTORS;
    let inputs = Inputs { motors: [MotorTorques { u_o, u_i, u_w }], ..Inputs::none() };
    let mut run = Run::new(&scenario).expect("Table 1");
    let mut steps = 0;
    while let Advance::Stepped = run.advance().expect("a step") {
        state = spacecraft.step(&state, &inputs, 1e-3).expect("a step");
        steps += 1;
        let found = run.state();
        assert_eq!(
            (found.r_b_n, found.r_b_n_dot, found.attitude, found.omega),
            (state.r_b_n, state.r_b_n_dot, state.attitude, state.omega)
        );
        let dgvscmg::Joints { gamma_o, gamma_i, theta, gamma_o_dot, gamma_i_dot, spin } =
            state.devices[0];
        let expected = [[gamma_o, gamma_o_dot], [gamma_i, gamma_i_dot], [theta, spin]];
        assert_eq!(found.devices.0[0].as_slice(), expected);
    }
    assert_eq!(steps, 2000);
    // The error of the method: 52 rad/s times 1 ms, to the fourth power.
    assert!(run.drift().energy.is_some_and(|drift| drift < 1e-6), "{:?}", run.drift());
}

/// A polynomial of order 7 against one of order 8, both at the tolerance.
const WITHIN: f64 = 1e-12;

#[test]
fn a_sample_within_a_step_is_that_of_a_step_of_its_own() {
    let mut scenario = table1(1, 1.0);
    scenario.settings.integrator = DOP853;
    let mut run = Run::new(&scenario).expect("Table 1");
    let mut largest: f64 = 0.0;
    while let Advance::Stepped = run.advance().expect("a step") {
        let (from, to) = (run.stepper.time_before(), run.time());
        for share in [0.1, 0.37, 0.5, 0.83] {
            let time = from + share * (to - from);
            let (mut dense, mut own) = (run.moment.clone(), run.moment.clone());
            run.stepper.at(&run.system, time, &mut dense).expect("a state");
            run.stepper.restep(&run.system, time, &mut own).expect("a state");
            let (dense, own) = (
                run.system.layout.pack(&dense.state, dense.integrals),
                run.system.layout.pack(&own.state, own.integrals),
            );
            // But for the throughput, which has no tolerance.
            let pairs = dense.iter().zip(&own).take(dense.len() - 1);
            for (a, b) in pairs {
                largest = largest.max((a - b).abs() / b.abs().max(1.0));
            }
        }
    }
    assert!(largest < WITHIN, "{largest:e}");
}
