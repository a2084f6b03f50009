//! The servo: its torques give the commanded accelerations exactly; rates converge; limits hold.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::{Each, JointStates};
use precess_dynamics::{
    Gravity, ImbalanceModel, Inputs, LoadAxes, Passive, ReactionWheel, Servo, Spacecraft, State,
    Steered, SteeringError, SteeringLaw, SteeringTerms, Vscmg, Wrench, vscmg,
};
use precess_tests::case::Set;
use precess_tests::random::{SEED, Sample};

const STEERED: [Steered; 6] = {
    let (rate, acceleration) = (Steered::Rate, Steered::Acceleration);
    [rate, rate, acceleration, rate, rate, acceleration]
};

fn servo() -> Servo<f64, 6> {
    Servo { steered: STEERED, gains: [20.0; 6], limits: [f64::INFINITY; 6] }
}

/// Torques that are applied give the accelerations that were commanded.
#[test]
fn torques_give_the_commanded_accelerations() {
    for seed in SEED..SEED + precess_tests::cases(100) {
        let sample = Sample::<2>::new(seed);
        let case = sample.case::<f64>();
        let craft = case.spacecraft(sample);
        let (commands, forward) =
            ([0.1, -0.2, 3.0, 0.3, 0.1, -2.0], [0.5, 0.0, 9.0, -0.5, 0.0, 9.0]);
        let found = craft.servo(&servo(), &case.state, &case.inputs, &commands, &forward).unwrap();
        assert_eq!(found.limited, 0);
        // Those of the loads, bit by bit.
        let loads = craft.loads(&case.state, &case.inputs, &found.accelerations, LoadAxes::Body);
        let motors: Vec<f64> = loads
            .unwrap()
            .devices
            .iter()
            .flat_map(|of| of.motors.values().collect::<Vec<_>>())
            .collect();
        assert_eq!(found.torques.to_vec(), motors, "{sample}");
        let mut inputs = case.inputs;
        for (motor, torque) in inputs.motors.values_mut().zip(found.torques) {
            *motor = torque;
        }
        let solved = craft.accelerations(&case.state, &inputs).unwrap();
        let rates = case.state.devices.states().map(|[_, rate]| rate);
        let expected = rates.zip(commands).zip(forward).zip(STEERED).map(
            |(((rate, command), forward), steered)| match steered {
                Steered::Rate => forward + 20.0 * (command - rate),
                _ => command,
            },
        );
        // Conditioned by the mass matrix: torques of heavy gimbals have the digits of light wheels.
        let largest = solved.devices.values().fold(1.0, |most: f64, x| most.max(x.abs()));
        for (found, expected) in solved.devices.values().zip(expected) {
            assert!((found - expected).abs() < 1e-7 * largest, "{sample}: {found} {expected}");
        }
    }
}

/// A central field, wrenches on bodies, a lumped imbalance, springs and friction: the bits of the loads.
#[test]
fn torques_are_those_of_the_loads_whatever_acts() {
    type Mixed = (Vscmg, ReactionWheel);
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
    let mut devices = (Vscmg::bare_wheel(4.0, inertia), ReactionWheel::bare_wheel(4.0, inertia));
    devices.0.passive =
        vscmg::PerJoint::all(Passive { stiffness: 3.0, ..Passive::friction(0.1, 0.2, 0.3) });
    (devices.1.d, devices.1.model) = (1e-4, ImbalanceModel::Lumped);
    let craft = Spacecraft::new(&precess_tests::measured::hub(), &devices).unwrap();
    let mut state: State<Mixed> = State::at_rest();
    (state.r_b_n.x, state.omega.y) = (7e6, 0.1);
    (state.devices.0.gamma, state.devices.0.gamma_dot, state.devices.0.spin) = (0.4, 0.3, 200.0);
    (state.devices.1.theta, state.devices.1.spin) = (0.7, 300.0);
    let steered = [Steered::Rate, Steered::Acceleration, Steered::Acceleration];
    let servo = Servo { steered, gains: [5.0; 3], limits: [f64::INFINITY; 3] };
    let mut inputs: Inputs<Mixed> = Inputs::none();
    let mut before = [0.0; 3];
    for acts in 0..3 {
        if acts > 0 {
            inputs.gravity = Gravity::Central { mu: 4e14 };
        }
        if acts > 1 {
            let mut bodies = Inputs::no_wrenches_for(&craft);
            for wrench in bodies.values_mut() {
                *wrench = Wrench { force: Vector3::new(1.0, 2.0, 3.0), moment: Vector3::x() };
            }
            inputs.bodies = Some(bodies);
        }
        let found = craft.servo(&servo, &state, &inputs, &[0.1, 2.0, -3.0], &[0.0; 3]).unwrap();
        let loads = craft.loads(&state, &inputs, &found.accelerations, LoadAxes::Body).unwrap();
        let motors: Vec<f64> =
            loads.devices.0.motors.values().chain(loads.devices.1.motors.values()).collect();
        assert_eq!(found.torques.to_vec(), motors);
        assert!(found.torques != before);
        before = found.torques;
    }
}

/// A small spacecraft of two DGVSCMGs.
fn small() -> (Spacecraft<Set<2>>, State<Set<2>>) {
    let mut devices = [precess_tests::measured::dgvscmg(); 2];
    devices[1].mount = nalgebra::Rotation3::from_euler_angles(0.0, 1.2, 0.5).into_inner();
    let craft = Spacecraft::new(&precess_tests::measured::hub(), &devices).unwrap();
    let mut state: State<Set<2>> = State::at_rest();
    for (joints, angle) in state.devices.iter_mut().zip([0.4, -0.3]) {
        (joints.gamma_o, joints.gamma_i, joints.spin) = (angle, 0.2, 500.0);
    }
    (craft, state)
}

/// Steering, servo and steps together: the hub is torqued as demanded.
#[test]
fn rates_follow_their_commands_and_the_hub_turns_as_demanded() {
    let (craft, mut state) = small();
    let (torque, dt) = (Vector3::new(0.5, -0.3, 0.4), 1e-3);
    let mut inputs: Inputs<Set<2>> = Inputs::none();
    for _ in 0..1000 {
        let terms: SteeringTerms<f64, 6> = craft.steering_terms(&state).unwrap();
        let found = SteeringLaw::exact().allocate(&terms.matrix(&STEERED), &torque).unwrap();
        let torques = craft.servo(&servo(), &state, &inputs, &found.commands, &[0.0; 6]).unwrap();
        for (motor, torque) in inputs.motors.values_mut().zip(torques.torques) {
            *motor = torque;
        }
        state = craft.step(&state, &inputs, dt).unwrap();
    }
    let expected = precess_tests::measured::hub::<f64>().i_b_bc.try_inverse().unwrap() * torque;
    let error = (state.omega - expected).norm() / expected.norm();
    // The accelerations of the gimbals while they speed up are not part of the matrix.
    assert!(error < 0.2, "{} {expected}", state.omega);
}

#[test]
fn limits_hold_and_what_is_not_commanded_keeps_its_torque() {
    let (craft, state) = small();
    let mut inputs: Inputs<Set<2>> = Inputs::none();
    inputs.motors[0].u_w = 0.25;
    let mut limited = servo();
    limited.limits = [1e-3; 6];
    limited.steered[2] = Steered::Nothing;
    let found = craft.servo(&limited, &state, &inputs, &[1.0; 6], &[0.0; 6]).unwrap();
    assert!(found.limited > 0 && found.torques[2] == 0.25, "{found:?}");
    let others = found.torques.iter().enumerate().filter(|(joint, _)| *joint != 2);
    assert!(
        others.clone().count() == 5
            && others.map(|(_, torque)| torque.abs()).all(|torque| torque <= 1e-3)
    );
    limited.limits[4] = -1.0;
    let refused = craft.servo(&limited, &state, &inputs, &[1.0; 6], &[0.0; 6]).unwrap_err();
    assert_eq!(refused, SteeringError::Argument { what: "torque limit", index: 4, value: -1.0 });
    let refused = craft.servo(&servo(), &state, &inputs, &[f64::NAN; 6], &[0.0; 6]).unwrap_err();
    assert!(matches!(refused, SteeringError::Argument { what: "command", index: 0, .. }));
}
