//! Wrenches from outside: in body and in inertial axes, on the hub and on a body of a device.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{BuiltIn, ReactionWheel};

use super::{last, recorded, scenario, set_joint, wheel};
use crate::scenario::{AppliedWrench, Profile, Scenario, Target, WrenchAxes};

/// Ten metres at tolerance 1e-13, and the roundings of some hundred steps.
const DISTANCE: f64 = 1e-11;

fn force(body: Target, axes: WrenchAxes, newtons: f64) -> AppliedWrench {
    let zero = || [Profile::ZERO, Profile::ZERO, Profile::ZERO];
    let force = [Profile::Constant(newtons), Profile::ZERO, Profile::ZERO];
    AppliedWrench { body, force, moment: zero(), point: Vector3::zeros(), axes }
}

/// A wheel about B's x axis, everything spinning about z.
fn spinning(devices: Vec<BuiltIn>) -> Scenario {
    let mut scenario = scenario(&["wheel"], devices, 10.0);
    scenario.hub.i_b_bc = Matrix3::from_diagonal(&Vector3::repeat(50.0));
    scenario.initial.omega = Vector3::new(0.0, 0.0, 1.5);
    scenario
}

#[test]
fn a_force_that_keeps_its_direction_in_n_accelerates_along_it() {
    // 100 kg of hub and 4 kg of wheel, pulled by 20.8 N for 10 s: 0.2 m/s², 10 m.
    let axis = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
    let imbalanced: ReactionWheel = ReactionWheel::bare_wheel(4.0, axis);
    for (body, devices) in [
        (Target::Hub, vec![wheel().into()]),
        (Target::Joint(0), vec![wheel().into()]),
        (Target::Joint(0), vec![imbalanced.into()]),
    ] {
        let mut scenario = spinning(devices);
        set_joint(&mut scenario, 0, [0.3, 2.0]);
        scenario.wrenches = vec![force(body, WrenchAxes::Inertial, 20.8)];
        let (outcome, samples) = recorded(&scenario);
        let found = ["position_x", "position_y", "position_z"].map(|name| last(&samples, name));
        assert!((found[0] - 10.0).abs() < DISTANCE, "{body:?}: {found:?}");
        assert!(found[1].abs() < DISTANCE && found[2].abs() < DISTANCE, "{body:?}: {found:?}");
        // 20.8 N over 10 m.
        assert!(
            (last(&samples, "work") - 208.0).abs() < 208.0 * 1e-12,
            "{}",
            last(&samples, "work")
        );
        assert!(outcome.drift.energy.is_some_and(|drift| drift < 1e-12), "{:?}", outcome.drift);
        assert_eq!((outcome.drift.linear, outcome.drift.angular), (None, None));
    }
}

#[test]
fn a_force_fixed_in_the_body_turns_with_it() {
    let mut scenario = spinning(vec![wheel().into()]);
    scenario.wrenches = vec![force(Target::Hub, WrenchAxes::Body, 20.8)];
    let (_, samples) = recorded(&scenario);
    // x'' = 0.2 cos(1.5 t), y'' = 0.2 sin(1.5 t), from rest.
    let (a, w, t) = (0.2, 1.5, 10.0_f64);
    let expected = [a / (w * w) * (1.0 - (w * t).cos()), a / w * t - a / (w * w) * (w * t).sin()];
    let found = ["position_x", "position_y"].map(|name| last(&samples, name));
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < DISTANCE, "{found} {expected}");
    }
}

#[test]
fn a_moment_in_body_axes_of_the_wheel_is_the_force_at_its_arm() {
    // A force of 3 N along y at 0.2 m along x of the wheel: 0.6 N m about z.
    let disc = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
    let with = |wrench: AppliedWrench| {
        let device: ReactionWheel = ReactionWheel::bare_wheel(4.0, disc);
        let mut scenario = spinning(vec![device.into()]);
        set_joint(&mut scenario, 0, [0.3, 2.0]);
        scenario.wrenches = vec![wrench];
        let (_, samples) = recorded(&scenario);
        ["omega_x", "omega_y", "omega_z", "wheel.spin"].map(|name| last(&samples, name))
    };
    let arm = AppliedWrench {
        force: [Profile::ZERO, Profile::Constant(3.0), Profile::ZERO],
        point: Vector3::new(0.2, 0.0, 0.0),
        ..force(Target::Joint(0), WrenchAxes::Body, 0.0)
    };
    let moment = AppliedWrench {
        moment: [Profile::ZERO, Profile::ZERO, Profile::Constant(0.6)],
        force: arm.force.clone(),
        ..force(Target::Joint(0), WrenchAxes::Body, 0.0)
    };
    for (a, b) in with(arm).iter().zip(with(moment)) {
        assert!((a - b).abs() < 1e-12, "{a} {b}");
    }
}
