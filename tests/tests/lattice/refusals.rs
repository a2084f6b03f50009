//! What a mode may not ask.

use nalgebra::Vector3;
use precess_dynamics::kind::Each;
use precess_dynamics::{
    BalancedDgcmg, BalancedSgcmg, Dgcmg, Dgvscmg, HubMode, Mode, Sgcmg, SloshMass, SolveError,
};

use crate::bench::{Bench, World, joints};
use crate::devices::Drawn;
use crate::random::Random;

fn bench<K: Drawn>() -> Bench<[K; 2]> {
    let random = &mut Random::new(5);
    let world = World::drawn(random);
    let devices = [(); 2].map(|()| K::drawn(random, world.hub.m_b));
    let told = devices.map(|_| joints::<K>(random)).concat();
    world.bench(&devices, &told)
}

/// Accelerations and steps refuse alike.
fn refused<K: Drawn>(bench: &Bench<[K; 2]>) -> SolveError {
    let error = bench.craft.accelerations(&bench.state, &bench.inputs).expect_err("refused");
    assert_eq!(bench.craft.step(&bench.state, &bench.inputs, 1e-3), Err(error));
    error
}

#[test]
fn locking_a_joint_that_moves_names_device_joint_and_rate() {
    let bench = bench::<Dgvscmg>();
    for (joint, name) in ["outer gimbal", "inner gimbal", "wheel"].into_iter().enumerate() {
        for device in 0..2 {
            let mut told = bench.told();
            let moving = &mut told[3 * device + joint];
            moving.mode = Mode::Locked;
            let rate = moving.state[1];
            let expected = SolveError::LockedJointMoves { device, joint: name, rate };
            assert_eq!(refused(&bench.telling(&told)), expected);
            told[3 * device + joint].state[1] = 0.0;
            bench.telling(&told).accelerations();
        }
    }
    let mut sliding = self::bench::<SloshMass>();
    sliding.inputs.modes[1].slosh_mass = Mode::Locked;
    let rate = sliding.state.devices[1].x_dot;
    let expected = SolveError::LockedJointMoves { device: 1, joint: "slosh mass", rate };
    assert_eq!(refused(&sliding), expected);
}

#[test]
fn fixing_a_hub_that_moves_tells_its_velocity() {
    let still = Vector3::zeros();
    let mut bench = bench::<Dgvscmg>();
    bench.inputs.hub = HubMode::Fixed;
    (bench.state.r_b_n_dot, bench.state.omega) = (still, Vector3::new(0.1, -0.4, 0.2));
    assert_eq!(refused(&bench), SolveError::FixedHubMoves { value: -0.4 });
    (bench.state.r_b_n_dot, bench.state.omega) = (Vector3::new(0.0, 0.0, 3.0), still);
    assert_eq!(refused(&bench), SolveError::FixedHubMoves { value: 3.0 });
    bench.state.r_b_n_dot = still;
    assert!(bench.craft.accelerations(&bench.state, &bench.inputs).is_ok());
}

/// The wheel of a kind that holds it: no mode but its own, in whatever is asked.
fn wheel_takes_no_other_mode<K: Drawn>() {
    let bench = bench::<K>();
    let last = K::JOINTS.len() - 1;
    assert!(bench.craft.accelerations(&bench.state, &bench.inputs).is_ok());
    for mode in [Mode::Driven, Mode::Locked, Mode::Prescribed(0.5)] {
        let mut told = bench.told();
        told[K::JOINTS.len() + last].mode = mode;
        let asked = bench.telling(&told);
        let expected = SolveError::NotDriven { device: 1, joint: "wheel" };
        assert_eq!(refused(&asked), expected, "{mode:?}");
        assert_eq!(asked.craft.stop(&asked.state, &asked.inputs), Err(expected), "{mode:?}");
    }
    assert_eq!(bench.inputs.modes.values().last(), Some(Mode::Prescribed(0.0)));
}

#[test]
fn wheel_of_a_cmg_takes_no_other_mode() {
    wheel_takes_no_other_mode::<Sgcmg>();
    wheel_takes_no_other_mode::<Dgcmg>();
    wheel_takes_no_other_mode::<BalancedSgcmg>();
    wheel_takes_no_other_mode::<BalancedDgcmg>();
}
