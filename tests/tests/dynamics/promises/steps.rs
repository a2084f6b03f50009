//! A step that spring, damper or friction makes unstable is rejected with the longest one that
//! holds, in every service that steps; one at that length keeps the energy ledger.

use nalgebra::{Matrix3, Vector3};
#[cfg(feature = "lanes")]
use precess_dynamics::lanes::Batch;
use precess_dynamics::{
    BuiltIn, HingedPanel, Hub, Inputs, Passive, ReactionWheel, SolveError, Spacecraft, State,
};

type One = [ReactionWheel; 1];

fn hub(inertia: f64) -> Hub {
    Hub { m_b: 50.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() * inertia }
}

/// A wheel of so much inertia about its axis.
fn wheel(inertia: f64, passive: Passive) -> ReactionWheel {
    let disc = Matrix3::from_diagonal(&Vector3::new(1.0, 0.6, 0.6)) * inertia;
    let mut wheel = ReactionWheel::bare_wheel(1.0, disc);
    wheel.passive.wheel = passive;
    wheel
}

fn spinning(spin: f64) -> State<One> {
    let mut state = State::<One>::at_rest();
    state.devices[0].spin = spin;
    state
}

/// Steps until an error or the end.
fn run(
    craft: &Spacecraft<One>,
    mut state: State<One>,
    dt: f64,
    steps: usize,
) -> Result<State<One>, SolveError> {
    for _ in 0..steps {
        state = craft.step(&state, &Inputs::none(), dt)?;
    }
    Ok(state)
}

/// Dry friction brings a wheel to rest: too long a step would chatter there for ever.
#[test]
fn dry_friction_is_resolved_or_rejected_where_the_wheel_comes_to_rest() {
    let friction = Passive::friction(0.0, 1e-3, 1e-4);
    let craft = Spacecraft::new(&hub(10.0), &[wheel(1e-3, friction)]).expect("valid parameters");
    // Far from rest friction is a constant torque for any step.
    assert!(run(&craft, spinning(1.0), 1e-3, 900).is_ok());
    let rejected = run(&craft, spinning(1.0), 1e-3, 1100).unwrap_err();
    let SolveError::Unstable { device: 0, joint: "wheel", dt, longest } = rejected else {
        panic!("{rejected:?}");
    };
    assert_eq!(dt, 1e-3);
    // 2.785 J q_c' / u_c, a little more since the hub is free.
    let wanted = 2.785_293_563_405_28e-4 * 10.0 / 10.001;
    assert!((longest / wanted - 1.0).abs() < 1e-9, "{longest}");

    // At that length the wheel stops, and the ledger holds.
    let start = spinning(0.05);
    let mut state = start;
    let mut work = 0.0;
    for _ in 0..2000 {
        let stepped =
            craft.step_with_work(&state, &Inputs::none(), 0.9 * longest).expect("a stable step");
        (state, work) = (stepped.state, work + stepped.work.total());
    }
    let [before, after] = [&start, &state].map(|state| craft.energy(state).expect("energy"));
    assert!(state.devices[0].spin.abs() < 1e-9, "{}", state.devices[0].spin);
    assert!((after - before - work).abs() < 0.02 * before, "{before} {after} {work}");
}

/// Just below the limit a disturbance dies out, just above it is rejected.
#[test]
fn limit_of_a_damper_and_of_a_spring_is_that_of_the_method() {
    // The wheel against the hub: 1/m = 1/0.5 + 1/2.
    for inertia in [2.0, 0.1, 1e3] {
        let response: f64 = 1.0 / 0.5 + 1.0 / inertia;
        for (passive, limit) in [
            (Passive::spring(0.0, 4.0), 2.785_293_563_405_28 / (4.0 * response)),
            (Passive::spring(9.0, 0.0), 8.0_f64.sqrt() / (9.0 * response).sqrt()),
        ] {
            let craft = Spacecraft::new(&hub(inertia), &[wheel(0.5, passive)]).expect("valid");
            let held = run(&craft, spinning(1.0), 0.999 * limit, 500).expect("a stable step");
            assert!(held.devices[0].spin.abs() <= 1.0, "{}", held.devices[0].spin);
            let rejected = run(&craft, spinning(1.0), 1.001 * limit, 1).unwrap_err();
            let SolveError::Unstable { longest, .. } = rejected else { panic!("{rejected:?}") };
            assert!((longest / limit - 1.0).abs() < 1e-6, "{longest} {limit}");
        }
    }
}

#[test]
fn two_wheels_on_a_light_hub_count_together() {
    type Two = [ReactionWheel; 2];
    let passive = Passive::spring(0.0, 1.0);
    let craft = Spacecraft::new(&hub(0.01), &[wheel(1.0, passive); 2]).expect("valid parameters");
    // Both turn against the hub: the fastest mode has c (1/J + 2/I), with their transverse inertia.
    let fastest = 1.0 + 2.0 / 0.01;
    let mut state = State::<Two>::at_rest();
    (state.devices[0].spin, state.devices[1].spin) = (1.0, 1.0);
    let limit = 2.785_293_563_405_28 / fastest;
    assert!(craft.step(&state, &Inputs::none(), 0.99 * limit).is_ok());
    let rejected = craft.step(&state, &Inputs::none(), 1.01 * limit).unwrap_err();
    assert!(matches!(rejected, SolveError::Unstable { .. }), "{rejected:?}");
}

/// Every service that steps: the same error, for a damper, a spring and dry friction.
#[test]
fn every_service_rejects_the_same_step() {
    let reversing = spinning(1e-5);
    for (passive, dt) in [
        (Passive::spring(0.0, 4.0), 1.0),
        (Passive::spring(4e3, 0.0), 1.0),
        (Passive::friction(0.0, 1.0, 1e-6), 1e-2),
    ] {
        let device = wheel(0.5, passive);
        let craft = Spacecraft::new(&hub(2.0), &[device]).expect("valid parameters");
        let (state, inputs) = (reversing, Inputs::<One>::none());
        let expected = craft.step(&state, &inputs, dt).unwrap_err();
        assert!(matches!(expected, SolveError::Unstable { .. }), "{expected:?}");
        assert_eq!(craft.step_with_work(&state, &inputs, dt).unwrap_err(), expected);
        #[cfg(feature = "lanes")]
        rejected_in_lanes(device, reversing, dt, expected);
        let on_board = [Some(BuiltIn::from(device)), None];
        assert_eq!(listed(&Spacecraft::new(&hub(2.0), &on_board).expect("valid"), dt), expected);
        let list = vec![BuiltIn::from(device)];
        assert_eq!(listed(&Spacecraft::new(&hub(2.0), &list).expect("valid"), dt), expected);
    }
}

/// The services in lanes give that error, too.
#[cfg(feature = "lanes")]
fn rejected_in_lanes(device: ReactionWheel, reversing: State<One>, dt: f64, expected: SolveError) {
    let inputs = Inputs::<One>::none();
    let batch = Batch::new(&hub(2.0), &[device]).expect("valid parameters");
    let (mut states, mut out) = ([reversing; 9], Vec::new());
    batch.run(&mut states, &inputs, dt, 3, &mut out).expect("as many inputs as states");
    assert!(out.iter().all(|done| *done == Err(expected)), "{out:?}");
    assert_eq!(states, [reversing; 9]);
}

fn listed<D: precess_dynamics::Devices<Scalar = f64>>(
    craft: &Spacecraft<D>,
    dt: f64,
) -> SolveError {
    use precess_dynamics::JointStates;
    let mut state = State::<D>::at_rest_for(craft);
    state.devices.states_mut().for_each(|[_, rate]| *rate = 1e-5);
    craft.step(&state, &Inputs::none_for(craft), dt).unwrap_err()
}

/// The motion of a joint that is not driven is prescribed: no spring makes its step unstable.
#[test]
fn spring_of_a_locked_joint_limits_nothing() {
    let mut panel = HingedPanel::bare_panel(3.0, Matrix3::identity());
    panel.passive.panel = Passive::spring(1e9, 0.0);
    let craft = Spacecraft::new(&hub(2.0), &[panel]).expect("valid parameters");
    let mut inputs = Inputs::<[HingedPanel; 1]>::none();
    let state = State::<[HingedPanel; 1]>::at_rest();
    assert!(craft.step(&state, &inputs, 1.0).is_err());
    inputs.modes[0].panel = precess_dynamics::Mode::Locked;
    assert!(craft.step(&state, &inputs, 1.0).is_ok());
}
