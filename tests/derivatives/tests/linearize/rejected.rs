//! What is rejected: states as the solver rejects them, variables that do not exist, derivatives
//! that are not finite.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{
    Axis, BalancedReactionWheel, Component, DerivativeError, Dgvscmg, Gravity, Hub, HubMode,
    Inputs, Outputs, ParameterVariable, Passive, Sgcmg, SolveError, Spacecraft, State, Variable,
};

type Set = (Dgvscmg, Sgcmg, BalancedReactionWheel);

const OUTPUTS: Outputs = Outputs::accelerations();

fn set() -> (Hub, Set) {
    let hub = Hub { m_b: 80.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() * 9.0 };
    let disc = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
    let wheel = Dgvscmg::bare_wheel(4.0, disc);
    (hub, (wheel, Sgcmg::bare_wheel(4.0, disc), BalancedReactionWheel::bare_wheel(4.0, 0.2, 0.1)))
}

/// The error of one variable.
fn error(
    change: impl Fn(&mut State<Set>, &mut Inputs<Set>),
    variable: Variable,
) -> Option<DerivativeError> {
    let (hub, set) = set();
    let craft = Spacecraft::new(&hub, &set).unwrap();
    let (mut state, mut inputs) = (State::at_rest(), Inputs::none());
    change(&mut state, &mut inputs);
    let found = craft.derivatives(&state, &inputs, &OUTPUTS, [variable], |_, _| ());
    let expected = craft.accelerations(&state, &inputs);
    if let Err(error) = expected {
        // NaN equals nothing, so as text.
        let error: Result<(), _> = Err(DerivativeError::Solve(error));
        let text = format!("{:?}", found.map(|_| ()));
        assert_eq!(text, format!("{error:?}"), "as the solver says");
    }
    found.err()
}

#[test]
fn a_state_is_rejected_as_by_the_solver() {
    let omega = Variable::Omega(Axis::X);
    let singular = error(|state, _| state.devices.0.gamma_i = core::f64::consts::FRAC_PI_2, omega);
    assert!(matches!(singular, Some(DerivativeError::Solve(SolveError::Singular { .. }))));
    let nan = error(|state, _| state.devices.1.gamma = f64::NAN, omega);
    assert!(matches!(nan, Some(DerivativeError::Solve(SolveError::NotFinite { .. }))));
    let large = error(|state, _| state.omega.y = 1e200, omega);
    assert!(matches!(large, Some(DerivativeError::Solve(SolveError::Overflow { .. }))));
    let centre = error(|_, inputs| inputs.gravity = Gravity::Central { mu: 1.0 }, omega);
    assert_eq!(centre, Some(DerivativeError::Solve(SolveError::AtCentre)));
    assert_eq!(error(|_, _| (), omega), None);
}

#[test]
fn a_variable_that_does_not_exist_is_named() {
    let plain = |variable| error(|_, _| (), variable);
    let none = |joint| Some(DerivativeError::NoSuchJoint { joint, joints: 6 });
    for of in [Variable::Coordinate, Variable::Rate, Variable::Motor, Variable::Acceleration] {
        assert_eq!(plain(of(6)), none(6));
    }
    assert_eq!(plain(Variable::BodyForce(usize::MAX, Axis::X)), none(usize::MAX));
    // A driven joint, a wheel that its kind keeps at its rate, a free hub, no gravity.
    for variable in [
        Variable::Acceleration(0),
        Variable::Acceleration(4),
        Variable::HubAcceleration(Axis::X),
        Variable::HubAngularAcceleration(Axis::X),
        Variable::Gravity(Axis::X),
        Variable::Mu,
    ] {
        assert_eq!(plain(variable), Some(DerivativeError::NotAnInput { variable }));
    }
    assert_eq!(plain(Variable::BodyForce(2, Axis::X)), None, "a wrench of zero may change");
    let text = DerivativeError::<f64>::NoSuchJoint { joint: 6, joints: 6 }.to_string();
    assert_eq!(text, "no joint 6; joints count from 0, and there are 6");
    let text = DerivativeError::<f64>::NotAnInput { variable: Variable::Mu }.to_string();
    assert_eq!(
        text,
        "gravity.mu is not an input; prescribe it in `Inputs`, or take another variable"
    );
}

#[test]
fn a_parameter_that_does_not_exist_is_named() {
    let (hub, set) = set();
    let of = |variable| {
        let at = (&State::<Set>::at_rest(), &Inputs::none());
        let found =
            Spacecraft::parameter_derivatives(&hub, &set, at, &OUTPUTS, [variable], |_, _| ());
        found.err()
    };
    let device = 3;
    let named = |device, name, component| ParameterVariable::Device { device, name, component };
    let none = Some(DerivativeError::NoSuchDevice { device, devices: 3 });
    assert_eq!(of(ParameterVariable::Phase { device }), none);
    assert_eq!(
        of(ParameterVariable::Phase { device: 2 }),
        Some(DerivativeError::NoImbalance { device: 2 })
    );
    for variable in [
        named(0, "m", Component::Number),
        named(0, "m_w", Component::Along(Axis::X)),
        named(0, "mount", Component::Element(Axis::X, Axis::X)),
        named(0, "passive.wheel.mass", Component::Number),
    ] {
        assert!(matches!(of(variable), Some(DerivativeError::NoSuchParameter { device: 0, .. })));
    }
    assert_eq!(of(named(2, "passive.wheel.viscous", Component::Number)), None);
    let mut bad = hub;
    bad.m_b = f64::NAN;
    let at = (&State::<Set>::at_rest(), &Inputs::none());
    let variables = [ParameterVariable::HubMass];
    let found = Spacecraft::parameter_derivatives(&bad, &set, at, &OUTPUTS, variables, |_, _| ());
    assert!(matches!(found, Err(DerivativeError::Parameter(_))));
}

/// The acceleration is finite and its derivative is not: which variable, by its place in the list.
#[test]
fn a_derivative_that_is_not_finite_is_rejected() {
    let (hub, mut set) = set();
    set.2.passive.wheel = Passive::spring(1e300, 0.0);
    let craft = Spacecraft::new(&hub, &set).unwrap();
    let (mut state, inputs) = (State::<Set>::at_rest(), Inputs::none());
    state.devices.2.spin = 1.0;
    assert!(craft.accelerations(&state, &inputs).is_ok());
    let by = (0..6).map(Variable::Motor).chain([Variable::Omega(Axis::X), Variable::Coordinate(5)]);
    let found = craft.derivatives(&state, &inputs, &OUTPUTS, by.clone(), |_, _| ());
    assert!(found.is_ok(), "1e300 over 0.2 is a number: {found:?}");
    set.2.j_11 = 1e-9;
    let craft = Spacecraft::new(&hub, &set).unwrap();
    assert!(craft.accelerations(&state, &inputs).is_ok());
    let found = craft.derivatives(&state, &inputs, &OUTPUTS, by, |_, _| ());
    assert_eq!(found, Err(DerivativeError::NotFinite { variable: 7 }));
}

/// A long step moves the hub finitely far, by one order of the step less than its derivative by the angular velocity:
/// which variable, the states first.
#[test]
fn a_derivative_of_a_step_that_is_not_finite_is_rejected() {
    let (hub, set) = set();
    let craft = Spacecraft::new(&hub, &set).unwrap();
    let (state, mut inputs) = (State::<Set>::at_rest(), Inputs::none());
    let rejected = |inputs: &Inputs<Set>, dt| {
        assert!(craft.linearize(&state, inputs, &OUTPUTS).is_ok());
        assert!(craft.step(&state, inputs, dt).is_ok());
        match craft.linearize_step(&state, inputs, dt) {
            Err(DerivativeError::NotFinite { variable }) => variable,
            found => panic!("{:?}", found.map(|_| ())),
        }
    };
    let place = |of| craft.state_variables(&inputs).position(|other| other == of).unwrap();
    let (turning, states) =
        (place(Variable::Omega(Axis::Y)), craft.state_variables(&inputs).count());
    // Nothing moves; of a force the position is by half the square of the step, over the mass.
    assert_eq!(rejected(&inputs, 1e156), states);
    inputs.force.x = 1.0;
    assert_eq!(rejected(&inputs, 1e110), turning);
}

/// A wheel of nearly no inertia turns far, but finitely far, in a long step.
#[test]
fn a_derivative_of_a_step_by_a_parameter_that_is_not_finite_is_rejected() {
    let (hub, mut set) = set();
    set.2.j_11 = 1e-9;
    let craft = Spacecraft::new(&hub, &set).unwrap();
    let (state, mut inputs) = (State::<Set>::at_rest(), Inputs::<Set>::none());
    (inputs.hub, inputs.motors.2.u_w) = (HubMode::Fixed, 1e-5);
    let dt = 1e150;
    assert!(craft.step(&state, &inputs, dt).is_ok());
    let named = |name| ParameterVariable::Device { device: 2, name, component: Component::Number };
    let by = [ParameterVariable::HubMass, named("j_11")];
    let at = (&state, &inputs);
    let found = Spacecraft::parameter_derivatives(&hub, &set, at, &OUTPUTS, by, |_, _| ());
    assert!(found.is_ok());
    let found = Spacecraft::step_parameter_derivatives(&hub, &set, at, dt, &by);
    assert_eq!(found, Err(DerivativeError::NotFinite { variable: 1 }));
}
