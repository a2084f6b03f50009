//! What is rejected, with its name, value and bound.

use nalgebra::Vector3;
use precess_dynamics::{
    Isolated, ModalQuantity, ModesError, Platform, Quantity, ReactionWheel, SolveError, Spacecraft,
    Suspension, platform,
};

use crate::craft::{Case, ON_MOUNT, SEED, Size};

fn case() -> Case {
    Case::new(SEED + 700, Size { modes: 4, contained: true, rotation: 0.1, free: false })
}

/// The error of a change of the modes.
fn rejected(change: impl Fn(&mut Case)) -> ModesError {
    let mut case = case();
    change(&mut case);
    Spacecraft::flexible(&case.hub, &case.modes, &case.devices, &ON_MOUNT).expect_err("rejected")
}

#[test]
fn modes_are_rejected_by_name() {
    const BAD: f64 = f64::INFINITY;
    let not_finite = |what, mode| ModesError::NotFinite { what, mode, value: BAD };
    assert_eq!(
        rejected(|case| case.modes.frequencies[2] = BAD),
        not_finite(ModalQuantity::Frequency, 2)
    );
    assert_eq!(
        rejected(|case| case.modes.angular[1].y = BAD),
        not_finite(ModalQuantity::AngularIntegral, 1)
    );
    assert_eq!(
        rejected(|case| case.modes.mounts[2].point.rotation[3].z = BAD),
        not_finite(ModalQuantity::Rotation { mount: 2 }, 3)
    );
    assert_eq!(
        rejected(|case| case.modes.mounts[1].point.position.x = BAD),
        not_finite(ModalQuantity::Position { mount: 1 }, 0)
    );
    assert_eq!(
        rejected(|case| case.modes.damping[0] = -0.1),
        ModesError::Negative { what: ModalQuantity::Damping, mode: 0, value: -0.1 }
    );
    assert_eq!(
        rejected(|case| case.modes.linear.push(Vector3::zeros())),
        ModesError::ModeCount { what: ModalQuantity::LinearIntegral, expected: 4, found: 5 }
    );
    assert_eq!(
        rejected(|case| case.modes.mounts.truncate(2)),
        ModesError::NoMount { device: 2, mount: 2, mounts: 2 }
    );
    let contained = rejected(|case| {
        case.modes.mounts[1].contained.as_mut().expect("a body").mass = -1.0;
    });
    assert!(matches!(contained, ModesError::Contained { mount: 1, .. }));
    assert!(matches!(rejected(|case| case.hub.m_b = -1.0), ModesError::Rigid(_)));
    // Shapes normalised in grams carry thirty times the structure's momentum.
    let heavy = rejected(|case| case.modes.linear.iter_mut().for_each(|p| *p *= 1e3_f64.sqrt()));
    assert!(matches!(heavy, ModesError::MoreThanStructure { .. }), "{heavy}");
    let text = rejected(|case| case.modes.mounts.truncate(2)).to_string();
    assert_eq!(text, "device 2 stands on mount 2 of 2; mounts count from 0");
}

#[test]
fn states_and_inputs_are_rejected_by_name() {
    const BAD: f64 = f64::NEG_INFINITY;
    let rejected = |change: &dyn Fn(&mut Case)| {
        let mut case = case();
        change(&mut case);
        let found = case.craft.accelerations(&case.state, &case.inputs).expect_err("rejected");
        assert_eq!(case.craft.step(&case.state, &case.inputs, 1e-3), Err(found));
        found
    };
    let not_finite = |what| SolveError::NotFinite { what, value: BAD };
    assert_eq!(
        rejected(&|case| case.state.modal.eta[3] = BAD),
        not_finite(Quantity::ModalCoordinate { mode: 3 })
    );
    assert_eq!(
        rejected(&|case| case.state.modal.eta_dot[0] = BAD),
        not_finite(Quantity::ModalRate { mode: 0 })
    );
    assert_eq!(
        rejected(&|case| case.inputs.modal.forces[1] = BAD),
        not_finite(Quantity::ModalForce { mode: 1 })
    );
    assert_eq!(
        rejected(&|case| case.inputs.modal.mounts[2].moment.y = BAD),
        not_finite(Quantity::MountWrench { mount: 2 })
    );
    assert_eq!(rejected(&|case| case.state.omega.x = BAD), not_finite(Quantity::BodyRate));
    assert_eq!(
        rejected(&|case| case.state.modal.eta.push(0.0)),
        SolveError::ModalCount { expected: 4, found: 5 }
    );
    assert_eq!(
        rejected(&|case| case.inputs.modal.mounts.clear()),
        SolveError::ModalCount { expected: 3, found: 0 }
    );
    assert!(matches!(
        rejected(&|case| case.state.modal.eta_dot[0] = 1e200),
        SolveError::Overflow { .. }
    ));
}

/// Subtracted bodies far heavier than what the modes move, and than the devices in their place.
#[test]
fn modes_without_mass_are_rejected() {
    let mut case = case();
    for mount in &mut case.modes.mounts {
        mount.contained.as_mut().expect("a body").mass = 100.0;
    }
    let craft = Spacecraft::flexible(&case.hub, &case.modes, &case.devices, &ON_MOUNT).unwrap();
    let found = craft.accelerations(&case.state, &case.inputs);
    let Err(SolveError::ModalMass { pivot, bound }) = found else { panic!("{found:?}") };
    assert!(pivot <= bound);
}

#[test]
fn springs_of_joints_bound_the_step() {
    let mut case = case();
    case.devices.1.passive.wheel.stiffness = 1e6;
    case.craft = Spacecraft::flexible(&case.hub, &case.modes, &case.devices, &ON_MOUNT).unwrap();
    let found = case.craft.step(&case.state, &case.inputs, 0.02);
    assert!(
        matches!(found, Err(SolveError::Unstable { device: 1, joint: "wheel", .. })),
        "{found:?}"
    );
}

/// It counts as the device before those that it carries, whose own mounts are not read.
#[test]
fn a_platform_on_a_mount_that_is_not_there_is_rejected() {
    let case = case();
    let wheel = ReactionWheel::bare_wheel(3.0, nalgebra::Matrix3::identity());
    let platform = Platform::bare(5.0, nalgebra::Matrix3::identity());
    let suspension = Suspension::none();
    let isolated = Isolated { carrier: platform, suspension, carried: [wheel] };
    let (devices, carried) = ((isolated, wheel), [9]);
    let on_mount = |platform, wheel| (platform::Data { carrier: platform, carried }, wheel);
    let built = |on_mount| Spacecraft::flexible(&case.hub, &case.modes, &devices, &on_mount);
    assert!(built(on_mount(0, 1)).is_ok());
    let rejected = |device| ModesError::NoMount { device, mount: 3, mounts: 3 };
    assert_eq!(built(on_mount(3, 1)).expect_err("rejected"), rejected(0));
    assert_eq!(built(on_mount(0, 3)).expect_err("rejected"), rejected(2));
}
