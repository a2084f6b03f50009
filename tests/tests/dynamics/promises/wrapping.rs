//! Wrapping angles changes no result: the angle of a joint with a spring is not wrapped.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{
    BuiltIn, HingedPanel, Hub, Inputs, JointStates, Passive, ReactionWheel, Spacecraft, State,
};

type Set = (ReactionWheel, ReactionWheel, HingedPanel);

fn hub() -> Hub {
    Hub { m_b: 50.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() * 5.0 }
}

/// A wheel with a spring, one without, a panel with a spring.
fn devices() -> Set {
    let disc = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
    let free = ReactionWheel { d: 1e-3, ..ReactionWheel::bare_wheel(4.0, disc) };
    let mut sprung = free;
    sprung.passive.wheel = Passive::spring(1e-3, 0.0);
    let mut panel = HingedPanel::bare_panel(3.0, disc);
    panel.passive.panel = Passive::spring(0.5, 0.1);
    (sprung, free, panel)
}

#[test]
fn spring_energy_and_accelerations_stay() {
    let craft = Spacecraft::new(&hub(), &devices()).expect("valid parameters");
    let mut state = State::<Set>::at_rest();
    (state.devices.0.theta, state.devices.1.theta) = (100.0, 100.0);
    (state.devices.0.spin, state.devices.1.spin, state.devices.2.phi) = (3.0, 5.0, 40.0);
    let wrapped = state.wrapped(&craft);
    assert_eq!(wrapped.devices.0, state.devices.0);
    assert_eq!(wrapped.devices.2, state.devices.2);
    assert!(wrapped.devices.1.theta.abs() <= std::f64::consts::PI);

    let inputs = Inputs::<Set>::none();
    let [before, after] = [&state, &wrapped].map(|state| {
        let found = craft.accelerations(state, &inputs).expect("accelerations");
        (found, craft.ledger(state, &inputs, &found).expect("ledger").springs)
    });
    assert_eq!(before.1.to_bits(), after.1.to_bits());
    assert!((before.1 - (5.0 + 400.0)).abs() < 1e-12);
    assert!((before.0.omega_dot - after.0.omega_dot).amax() < 1e-13 * before.0.omega_dot.amax());
}

#[test]
fn lists_keep_the_turns_of_a_spring_too() {
    let (sprung, free, panel) = devices();
    let on_board: [Option<BuiltIn>; 4] =
        [Some(sprung.into()), None, Some(free.into()), Some(panel.into())];
    kept(&Spacecraft::new(&hub(), &on_board).expect("valid parameters"));
    let list = vec![BuiltIn::from(sprung), free.into(), panel.into()];
    kept(&Spacecraft::new(&hub(), &list).expect("valid parameters"));
}

fn kept<D: precess_dynamics::Devices<Scalar = f64>>(craft: &Spacecraft<D>) {
    let mut state = State::<D>::at_rest_for(craft);
    state.devices.states_mut().for_each(|[coordinate, _]| *coordinate = 100.0);
    let wrapped = state.wrapped(craft);
    let angles: Vec<_> = wrapped.devices.states().map(|[coordinate, _]| coordinate).collect();
    assert!(angles[0] == 100.0 && angles[1].abs() < 3.2 && angles[2] == 100.0, "{angles:?}");
}
