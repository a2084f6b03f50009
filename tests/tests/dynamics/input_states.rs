//! Faulty states and inputs: each is rejected by a typed error that names it, with value, bound and
//! remedy; unusual but valid ones give a result.

use std::f64::consts::FRAC_PI_2;
use std::fmt::Debug;

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::dgvscmg::PerJoint;
use precess_dynamics::{
    About, Gravity, Hub, HubMode, Inputs, Mode, Quantity, Quaternion, SolveError, Spacecraft,
    State, Wrench,
};
use precess_tests::blocks::{errors, worst};
use precess_tests::bounds::ACCELERATIONS_WORST;
use precess_tests::case::{Case, Set};
use precess_tests::double_double::DoubleDouble as Wide;
use precess_tests::table1::{self, pair};

/// Sets one input to a number.
type Spoil = fn(&mut Case<2>, f64);

fn accepted<const N: usize>(case: &Case<N>) -> Spacecraft<Set<N>> {
    Spacecraft::new(&case.hub, &case.devices).unwrap_or_else(|error| panic!("{error}"))
}

#[track_caller]
fn unsolved(spoil: impl FnOnce(&mut Case<2>)) -> SolveError {
    let mut case = pair();
    let spacecraft = accepted(&case);
    assert!(spacecraft.accelerations(&case.state, &case.inputs).is_ok());
    spoil(&mut case);
    match spacecraft.accelerations(&case.state, &case.inputs) {
        Ok(found) => panic!("the state was solved: {found:?}"),
        Err(error) => error,
    }
}

/// A device whose gimbals weigh nothing, at an inner gimbal angle.
fn massless_gimbals(gamma_i: f64) -> Case<2> {
    let mut case = pair();
    let device = &mut case.devices[1];
    (device.m_go, device.m_gi) = (0.0, 0.0);
    (device.i_go_goc, device.i_gi_gic) = (Matrix3::zeros(), Matrix3::zeros());
    (device.d, device.i_w_wc) = (0.0, Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1)));
    case.state.devices[1].gamma_i = gamma_i;
    case
}

/// At 90 degrees the outer gimbal turns about the wheel's own axis, and nothing resists it.
#[test]
fn massless_gimbals_at_ninety_degrees_are_a_typed_error() {
    for gamma_i in [FRAC_PI_2, -FRAC_PI_2, 3.0 * FRAC_PI_2] {
        let case = massless_gimbals(gamma_i);
        let error = match accepted(&case).accelerations(&case.state, &case.inputs) {
            Ok(found) => panic!("gamma_i = {gamma_i}: {found:?}"),
            Err(error) => error,
        };
        let SolveError::Singular { device, joint, pivot, bound } = error else {
            panic!("{error}");
        };
        assert_eq!((device, joint), (Some(1), Some("outer gimbal")));
        assert!(pivot.abs() <= bound && bound < 1e-13, "{pivot}, {bound}");
        assert_eq!(
            error.to_string(),
            format!(
                "pivot {pivot:?} of device 1 (outer gimbal) is not above {bound:?}; check \
                 mass and inertia of the outer gimbal and of all bodies outboard of it; a massless gimbal is \
                 singular where it would turn about the spin axis"
            ),
        );
    }
}

#[test]
fn massless_gimbals_elsewhere_are_solved() {
    for gamma_i in [0.0, 0.5, -1.0, 1.5] {
        let case = massless_gimbals(gamma_i);
        let found = accepted(&case)
            .accelerations(&case.state, &case.inputs)
            .unwrap_or_else(|error| panic!("gamma_i = {gamma_i}: {error}"));
        let (error, block) = worst(errors(&found, &case.converted::<Wide>().reference()));
        assert!(error <= ACCELERATIONS_WORST, "gamma_i = {gamma_i}: {error:e} in {block}");
    }
}

#[test]
fn hub_without_inertia_and_devices_is_a_typed_error() {
    let hub = Hub { i_b_bc: Matrix3::zeros(), ..table1::hub() };
    let spacecraft = Spacecraft::<Set<0>>::new(&hub, &[]).unwrap_or_else(|error| panic!("{error}"));
    let state: State<Set<0>> = State::at_rest();
    let error = spacecraft.accelerations(&state, &Inputs::none()).unwrap_err();
    let SolveError::Singular { device: None, joint: None, pivot, bound } = error else {
        panic!("{error}");
    };
    assert!(pivot <= bound, "{pivot}, {bound}");
    assert!(error.to_string().contains("check the hub's mass and inertia"), "{error}");
}

/// The sine of a large angle is as good as the angle: nothing is lost after 160,000 turns.
#[test]
fn angles_of_a_million_radians_are_solved() {
    let mut case = pair();
    for (joints, far) in case.state.devices.iter_mut().zip([1e6, -1e6]) {
        (joints.gamma_o, joints.gamma_i, joints.theta) = (far, 0.7 * far, -far);
    }
    let spacecraft = accepted(&case);
    let found = spacecraft
        .accelerations(&case.state, &case.inputs)
        .unwrap_or_else(|error| panic!("{error}"));
    let (error, block) = worst(errors(&found, &case.converted::<Wide>().reference()));
    assert!(error <= ACCELERATIONS_WORST, "{error:e} in {block}");
}

/// A hub with prescribed accelerations, of these components only.
fn prescribed(r_b_n_ddot: f64, omega_dot: f64) -> HubMode {
    HubMode::Prescribed {
        r_b_n_ddot: Vector3::new(r_b_n_ddot, 0.0, 0.0),
        omega_dot: Vector3::new(0.0, omega_dot, 0.0),
    }
}

/// A wrench on the wheel of device 1, no other component than these.
fn on_a_wheel(force: f64, moment: f64) -> [PerJoint<Wrench>; 2] {
    let (force, moment) = (Vector3::new(0.0, force, 0.0), Vector3::new(0.0, moment, 0.0));
    let nothing = PerJoint::all(Wrench::none());
    [nothing, PerJoint { wheel: Wrench { force, moment }, ..nothing }]
}

#[test]
fn any_state_that_is_not_finite_is_named() {
    let joint = |field| Quantity::Joint { device: 1, field };
    let motor = |joint| Quantity::Motor { device: 1, joint };
    let wrench = Quantity::Wrench { device: 1, body: "wheel" };
    let spoils: [(Spoil, Quantity); 22] = [
        (|c, x| c.state.r_b_n.x = x, Quantity::Position),
        (|c, x| c.state.r_b_n_dot.y = x, Quantity::Velocity),
        (|c, x| c.state.attitude.q2 = x, Quantity::Attitude),
        (|c, x| c.state.omega.z = x, Quantity::BodyRate),
        (|c, x| c.state.devices[1].gamma_o = x, joint("gamma_o")),
        (|c, x| c.state.devices[1].gamma_i = x, joint("gamma_i")),
        (|c, x| c.state.devices[1].theta = x, joint("theta")),
        (|c, x| c.state.devices[1].gamma_o_dot = x, joint("gamma_o_dot")),
        (|c, x| c.state.devices[1].gamma_i_dot = x, joint("gamma_i_dot")),
        (|c, x| c.state.devices[1].spin = x, joint("spin")),
        (|c, x| c.inputs.force.x = x, Quantity::Force),
        (|c, x| c.inputs.torque_b.y = x, Quantity::TorqueB),
        (|c, x| c.inputs.motors[1].u_o = x, motor("outer gimbal")),
        (|c, x| c.inputs.motors[1].u_i = x, motor("inner gimbal")),
        (|c, x| c.inputs.motors[1].u_w = x, motor("wheel")),
        (
            |c, x| c.inputs.modes[1].inner_gimbal = Mode::Prescribed(x),
            Quantity::JointAcceleration { device: 1, joint: "inner gimbal" },
        ),
        (|c, x| c.inputs.hub = prescribed(x, 0.0), Quantity::HubAcceleration),
        (|c, x| c.inputs.hub = prescribed(0.0, x), Quantity::HubAcceleration),
        (|c, x| c.inputs.gravity = Gravity::Uniform(Vector3::new(0.0, 0.0, x)), Quantity::Gravity),
        (|c, x| c.inputs.gravity = Gravity::Central { mu: x }, Quantity::Gravity),
        (|c, x| c.inputs.bodies = Some(on_a_wheel(x, 0.0)), wrench),
        (|c, x| c.inputs.bodies = Some(on_a_wheel(0.0, x)), wrench),
    ];
    for (spoil, what) in spoils {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let error = unsolved(|case| spoil(case, bad));
            assert_named(Err::<(), _>(error), what, bad);
        }
    }
    assert_eq!(
        unsolved(|case| case.state.devices[1].theta = f64::NAN).to_string(),
        "NaN in theta of device 1 is not finite; give finite numbers in SI units",
    );
    assert_eq!(
        unsolved(|case| case.inputs.motors[1].u_w = f64::INFINITY).to_string(),
        "inf in motor torque of device 1 (wheel) is not finite; give finite numbers in SI units",
    );
}

#[test]
fn quaternion_of_length_zero_is_named() {
    let zero = Quaternion { q0: 0.0, q1: 0.0, q2: 0.0, q3: 0.0 };
    let error = unsolved(|case| case.state.attitude = zero);
    assert_eq!(
        error.to_string(),
        "largest attitude parameter 0.0 leaves no usable length; give a unit quaternion, or MRPs \
         up to 1"
    );
}

#[test]
fn result_that_overflows_is_a_typed_error() {
    let error = unsolved(|case| case.state.devices[1].spin = 1e200);
    let what = Quantity::JointAcceleration { device: 1, joint: "wheel" };
    assert_eq!(error, SolveError::Overflow { what });
    assert_eq!(
        error.to_string(),
        "acceleration of device 1 (wheel) is not finite although every input is; check the \
         units of large or tiny inputs",
    );
}

/// Stepping, energy and momentum name the same input as the accelerations do.
#[test]
fn nan_leaves_no_public_function_unnoticed() {
    let valid = pair();
    let spacecraft = accepted(&valid);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut case = valid;
        case.state.omega.x = bad;
        let what = Quantity::BodyRate;
        assert_named(spacecraft.step(&case.state, &case.inputs, 0.01), what, bad);
        assert_named(spacecraft.energy(&case.state), what, bad);
        assert_named(spacecraft.momentum(&case.state, About::CentreOfMass), what, bad);
        assert_named(spacecraft.centre_of_mass(&case.state), what, bad);

        assert_named(spacecraft.step(&valid.state, &valid.inputs, bad), Quantity::TimeStep, bad);
        let about = About::Point(Vector3::new(0.0, bad, 0.0));
        assert_named(spacecraft.momentum(&valid.state, about), Quantity::ReferencePoint, bad);
    }
}

/// The result is the error that names this input and gives this value, which may be NaN.
#[track_caller]
fn assert_named<R: Debug>(result: Result<R, SolveError>, what: Quantity, value: f64) {
    match result {
        Err(SolveError::NotFinite { what: named, value: shown }) => {
            assert_eq!((named, shown.to_bits()), (what, value.to_bits()));
        }
        other => panic!("{value} in {what}: {other:?}"),
    }
}
