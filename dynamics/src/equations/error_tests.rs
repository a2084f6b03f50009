//! The messages of [`SolveError`](crate::SolveError).

use std::string::ToString;

use crate::{Quantity, SolveError};

#[test]
fn singular_pivot_shows_value_bound_and_remedy() {
    let error = SolveError::Singular {
        device: Some(2),
        joint: Some("outer gimbal"),
        pivot: 3e-19,
        bound: 1e-12,
    };
    assert_eq!(
        error.to_string(),
        "pivot 3e-19 of device 2 (outer gimbal) is not above 1e-12; check mass and inertia of \
         the outer gimbal and of all bodies outboard of it; a massless gimbal is singular where \
         it would turn about the spin axis"
    );
    let error = SolveError::Singular { device: None, joint: None, pivot: -1.0, bound: 0.5 };
    assert_eq!(
        error.to_string(),
        "pivot -1.0 of the hub is not above 0.5; check the hub's mass and inertia, and that its \
         centre of mass is not far from B"
    );
}

#[test]
fn input_that_is_not_finite_is_named() {
    let text = |what, value| SolveError::NotFinite { what, value }.to_string();
    assert_eq!(
        text(Quantity::Joint { device: 3, field: "gamma_i_dot" }, f64::NAN),
        "NaN in gamma_i_dot of device 3 is not finite; give finite numbers in SI units"
    );
    assert_eq!(
        text(Quantity::Motor { device: 1, joint: "wheel" }, f64::NEG_INFINITY),
        "-inf in motor torque of device 1 (wheel) is not finite; give finite numbers in SI \
         units"
    );
}

#[test]
fn attitude_names_the_parameter_at_fault() {
    let text = |value: f32| SolveError::NotFinite { what: Quantity::Attitude, value }.to_string();
    assert_eq!(
        text(f32::INFINITY),
        "inf in the attitude is not finite; give a unit quaternion, or MRPs up to 1"
    );
    assert_eq!(
        text(0.0),
        "largest attitude parameter 0.0 leaves no usable length; give a unit quaternion, or MRPs \
         up to 1"
    );
}

#[test]
fn what_is_locked_and_moves_is_named_with_its_rate() {
    let (device, joint) = (1, "gimbal");
    assert_eq!(
        SolveError::LockedJointMoves { device, joint, rate: 0.5 }.to_string(),
        "locked joint of device 1 (gimbal) moves at 0.5, not 0; stop it first, or unlock it"
    );
    assert_eq!(
        SolveError::FixedHubMoves { value: -2.0 }.to_string(),
        "fixed hub moves at -2.0 m/s or rad/s, not 0; set its velocities to zero, or stop it \
         first"
    );
    assert_eq!(
        SolveError::<f64>::NotDriven { device, joint: "wheel" }.to_string(),
        "joint of device 1 (wheel) is held at its rate by its kind and takes no other mode; \
         use a kind that drives it"
    );
    assert_eq!(
        SolveError::<f64>::Count { expected: 3, found: 2 }.to_string(),
        "a list has 2 entries, not 3; give one for each device, and in it one for each joint"
    );
}

#[test]
fn overflow_names_the_remedy() {
    let error = SolveError::<f32>::Overflow { what: Quantity::Load { device: 1, joint: "wheel" } };
    assert_eq!(
        error.to_string(),
        "load of device 1 (wheel) is not finite although every input is; check the units of \
         large or tiny inputs"
    );
    let error = SolveError::Unstable { device: 0, joint: "wheel", dt: 1e-3, longest: 2.5e-4 };
    assert_eq!(
        error.to_string(),
        "step of 0.001 s is too long for spring and friction of device 0 (wheel): the method is \
         stable up to 0.00025 s; shorten the step, or raise coulomb_rate"
    );
}
