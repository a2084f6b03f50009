//! Modes that a joint or the hub rejects.

use nalgebra::Vector3;
use precess_dynamics::kind::Each;
use precess_dynamics::{
    BalancedDgcmg, BalancedSgcmg, Dgcmg, Dgvscmg, HubMode, Mode, Sgcmg, SloshMass, SolveError,
};

use super::case::{Case, World, joints};
use super::devices::Drawn;
use super::random::Random;

fn case<K: Drawn>() -> Case<[K; 2]> {
    let random = &mut Random::new(5);
    let world = World::drawn(random);
    let devices = [(); 2].map(|()| K::drawn(random, world.hub.m_b));
    let settings = devices.map(|_| joints::<K>(random)).concat();
    world.case(&devices, &settings)
}

/// Accelerations and steps reject with the same error.
fn rejected<K: Drawn>(case: &Case<[K; 2]>) -> SolveError {
    let error = case.craft.accelerations(&case.state, &case.inputs).expect_err("rejected");
    assert_eq!(case.craft.step(&case.state, &case.inputs, 1e-3), Err(error));
    error
}

#[test]
fn locking_a_joint_that_moves_names_device_joint_and_rate() {
    let case = case::<Dgvscmg>();
    for (joint, name) in ["outer gimbal", "inner gimbal", "wheel"].into_iter().enumerate() {
        for device in 0..2 {
            let mut settings = case.settings();
            let moving = &mut settings[3 * device + joint];
            moving.mode = Mode::Locked;
            let rate = moving.state[1];
            let expected = SolveError::LockedJointMoves { device, joint: name, rate };
            assert_eq!(rejected(&case.with_settings(&settings)), expected);
            settings[3 * device + joint].state[1] = 0.0;
            case.with_settings(&settings).accelerations();
        }
    }
    let mut sliding = self::case::<SloshMass>();
    sliding.inputs.modes[1].slosh_mass = Mode::Locked;
    let rate = sliding.state.devices[1].x_dot;
    let expected = SolveError::LockedJointMoves { device: 1, joint: "slosh mass", rate };
    assert_eq!(rejected(&sliding), expected);
}

#[test]
fn fixing_a_hub_that_moves_tells_its_velocity() {
    let still = Vector3::zeros();
    let mut case = case::<Dgvscmg>();
    case.inputs.hub = HubMode::Fixed;
    (case.state.r_b_n_dot, case.state.omega) = (still, Vector3::new(0.1, -0.4, 0.2));
    assert_eq!(rejected(&case), SolveError::FixedHubMoves { value: -0.4 });
    (case.state.r_b_n_dot, case.state.omega) = (Vector3::new(0.0, 0.0, 3.0), still);
    assert_eq!(rejected(&case), SolveError::FixedHubMoves { value: 3.0 });
    case.state.r_b_n_dot = still;
    assert!(case.craft.accelerations(&case.state, &case.inputs).is_ok());
}

/// The wheel of a kind that holds its rate accepts no other mode, in any call.
fn wheel_takes_no_other_mode<K: Drawn>() {
    let case = case::<K>();
    let last = K::JOINTS.len() - 1;
    assert!(case.craft.accelerations(&case.state, &case.inputs).is_ok());
    for mode in [Mode::Driven, Mode::Locked, Mode::Prescribed(0.5)] {
        let mut settings = case.settings();
        settings[K::JOINTS.len() + last].mode = mode;
        let changed = case.with_settings(&settings);
        let expected = SolveError::NotDriven { device: 1, joint: "wheel" };
        assert_eq!(rejected(&changed), expected, "{mode:?}");
        assert_eq!(changed.craft.stop(&changed.state, &changed.inputs), Err(expected), "{mode:?}");
    }
    assert_eq!(case.inputs.modes.values().last(), Some(Mode::Prescribed(0.0)));
}

#[test]
fn wheel_of_a_cmg_takes_no_other_mode() {
    wheel_takes_no_other_mode::<Sgcmg>();
    wheel_takes_no_other_mode::<Dgcmg>();
    wheel_takes_no_other_mode::<BalancedSgcmg>();
    wheel_takes_no_other_mode::<BalancedDgcmg>();
}
