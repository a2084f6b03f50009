//! No result is infinite or NaN, and an error names the input or result that is not finite.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{
    BalancedReactionWheel, Hub, Inputs, LoadAxes, Mode, Mrp, Passive, Quantity, Quaternion,
    ReactionWheel, Scalar, SolveError, Spacecraft, State,
};

type One<T> = [BalancedReactionWheel<T>; 1];

fn hub<T: Scalar>() -> Hub<T> {
    let i_b_bc = Matrix3::from_diagonal_element(1.0).map(T::from_f64);
    Hub {
        m_b: T::from_f64(10.0),
        r_bc_b: Vector3::zeros().map(|zero: f64| T::from_f64(zero)),
        i_b_bc,
    }
}

/// A wheel of 1 kg m² under a torque whose power is beyond the largest number.
fn powerful<T: Scalar>(torque: T, spin: T) {
    let one = T::from_f64(1.0);
    let wheel = BalancedReactionWheel::bare_wheel(one, one, T::from_f64(0.5));
    let craft = Spacecraft::new(&hub::<T>(), &[wheel]).expect("valid parameters");
    let mut state = State::<One<T>>::at_rest();
    state.devices[0].spin = spin;
    let mut inputs = Inputs::<One<T>>::none();
    inputs.motors[0].u_w = torque;
    let found = craft.accelerations(&state, &inputs).expect("accelerations are finite");
    let load = SolveError::Overflow { what: Quantity::Load { device: 0, joint: "wheel" } };
    assert_eq!(craft.loads(&state, &inputs, &found, LoadAxes::Body).unwrap_err(), load);
    assert_eq!(craft.ledger(&state, &inputs, &found).unwrap_err(), load);
    let dt = T::from_f64(1e-9);
    let stepped = craft.step_with_work(&state, &inputs, dt).unwrap_err();
    assert_eq!(stepped, load);
}

#[test]
fn powers_beyond_the_largest_number_are_rejected() {
    powerful(1e200, 1e150);
    powerful(1e25_f32, 1e18);
}

/// Friction takes 1e300 W from a wheel that is kept at its rate, for 1e10 s.
#[test]
fn work_beyond_the_largest_number_is_rejected() {
    let mut wheel = BalancedReactionWheel::bare_wheel(1.0, 1.0, 0.5);
    wheel.passive.wheel = Passive::friction(1e100, 0.0, 0.0);
    let craft = Spacecraft::new(&hub(), &[wheel]).expect("valid parameters");
    let mut state = State::<One<f64>>::at_rest();
    state.devices[0].spin = 1e100;
    let mut inputs = Inputs::<One<f64>>::none();
    inputs.modes[0].wheel = Mode::Prescribed(0.0);
    assert!(craft.step(&state, &inputs, 1e10).is_ok());
    let rejected = craft.step_with_work(&state, &inputs, 1e10).unwrap_err();
    assert_eq!(rejected, SolveError::Overflow { what: Quantity::Work });
}

/// A stage that leaves the range of numbers is no input that somebody gave.
#[test]
fn work_of_a_step_calls_an_overflow_what_the_step_calls_it() {
    let craft = Spacecraft::new(&hub(), &[] as &[ReactionWheel; 0]).expect("valid parameters");
    let mut state = State::<[ReactionWheel; 0]>::at_rest();
    state.r_b_n_dot.x = 1e200;
    let inputs = Inputs::<[ReactionWheel; 0]>::none();
    let step = craft.step(&state, &inputs, 1e200).unwrap_err();
    assert_eq!(step, SolveError::Overflow { what: Quantity::Position });
    let with_work = craft.step_with_work(&state, &inputs, 1e200).unwrap_err();
    assert!(matches!(with_work, SolveError::Overflow { .. }), "{with_work:?}");
}

/// The spring of a joint that is not driven acts on nothing.
#[test]
fn locked_joint_does_not_notice_a_spring_beyond_the_largest_number() {
    let mut wheel = BalancedReactionWheel::bare_wheel(1.0, 1.0, 0.5);
    wheel.passive.wheel = Passive::spring(1e300, 0.0);
    let craft = Spacecraft::new(&hub(), &[wheel]).expect("valid parameters");
    let mut state = State::<One<f64>>::at_rest();
    state.devices[0].theta = 1e10;
    state.omega.x = 0.5;
    let mut inputs = Inputs::<One<f64>>::none();
    let overflow = craft.accelerations(&state, &inputs).unwrap_err();
    let what = Quantity::JointAcceleration { device: 0, joint: "wheel" };
    assert_eq!(overflow, SolveError::Overflow { what });
    inputs.modes[0].wheel = Mode::Locked;
    let found = craft.accelerations(&state, &inputs).expect("a locked joint");
    assert_eq!(found.devices[0].spin_dot, 0.0);
}

#[test]
fn kinetic_energy_is_not_negative() {
    // A thin rod that turns in space as its hub turns back: nothing moves but rounding.
    let device = ReactionWheel {
        d: 1.0,
        ..ReactionWheel::bare_wheel(1e9, Matrix3::from_diagonal(&Vector3::new(0.0, 0.0, 0.0)))
    };
    let light = Hub { m_b: 1e-9, ..hub() };
    let craft = Spacecraft::new(&light, &[device]).expect("valid parameters");
    for number in 0..2000 {
        let mut state = State::<[ReactionWheel; 1]>::at_rest();
        let (theta, spin) = (f64::from(number) * 0.37, 1.0 + f64::from(number));
        (state.devices[0].theta, state.devices[0].spin) = (theta, spin);
        state.omega.x = -spin;
        let energy = craft.energy(&state).expect("finite");
        assert!(energy >= 0.0, "{energy} at {theta}");
    }
}

/// Long MRPs and tiny quaternions turn at the rate of their attitude from the first step on.
#[test]
fn first_step_turns_whatever_the_parameters_are_long() {
    let craft = Spacecraft::new(&hub(), &[] as &[ReactionWheel; 0]).expect("valid parameters");
    let inputs = Inputs::<[ReactionWheel; 0]>::none();
    let turned = |attitude: Quaternion| {
        let mut state = State::<[ReactionWheel; 0]>::at_rest();
        (state.attitude, state.omega.x) = (attitude, 1.0);
        craft.step(&state, &inputs, 0.1).expect("a step").attitude
    };
    let expected = turned(Quaternion { q0: 1.0, q1: 0.0, q2: 0.0, q3: 0.0 });
    for size in [5e-324, 1e-310, 1e-200, 1e200] {
        let found = turned(Quaternion { q0: size, q1: 0.0, q2: 0.0, q3: 0.0 });
        assert_eq!(found, expected, "{size:e}");
    }
    for size in [1.5, 100.0, 1000.0, 1e6] {
        let mut state = State::<[ReactionWheel; 0], Mrp>::at_rest();
        state.attitude = Mrp::from_components(0.0, size, 0.0);
        state.omega = Vector3::new(1.0, 0.5, -0.3);
        let found = craft.step(&state, &inputs, 0.01).expect("a step").attitude;
        let mut inner = state;
        inner.attitude = Quaternion::from(Mrp::from_components(0.0, -1.0 / size, 0.0)).into();
        let expected = craft.step(&inner, &inputs, 0.01).expect("a step").attitude;
        assert!((found.0 - expected.0).amax() < 1e-12, "{size}: {found:?} {expected:?}");
    }
}
