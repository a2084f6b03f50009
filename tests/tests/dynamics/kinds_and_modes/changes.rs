//! Modes that change from step to step: brakes close and open over a run, momentum stays, and a
//! locked joint does not move at all.

use nalgebra::Vector3;
use precess_dynamics::kind::{Each, JointStates};
use precess_dynamics::{
    About, BalancedDgvscmg, Dgvscmg, HingedPanel, Mode, ReactionWheel, SloshMass,
};
use precess_point_masses::PointMasses;

use super::case::{Case, Joint, World, joints, largest};
use super::devices::Drawn;
use super::random::{Random, errors_of};
use super::stops::sizes;

/// Largest drift of both momenta over a run, and of energy less what the brakes dissipate.
const DRIFT: f64 = 1e-12;

/// Eight runs of two thousand steps: some tenths of a second.
const RUNS: u64 = 8;

/// The fastest joint turns 10 rad/s, a thousandth of a radian a step: what RK4 leaves over a run,
/// 2000 times 1e-15 / 120, is rounding.
const STEP: f64 = 1e-4;
const FASTEST: f64 = 10.0;

/// A brake closes or opens every so many steps.
const HELD: u32 = 100;
const STEPS: u32 = 2000;

type Set = (ReactionWheel, [Dgvscmg; 1], BalancedDgvscmg, (HingedPanel, SloshMass));

/// No springs, no motors, no forces: nothing but the brakes takes energy.
fn coasting(random: &mut Random) -> (Case<Set>, PointMasses) {
    let mut world = World::drawn(random);
    (world.force, world.torque_b) = (Vector3::zeros(), Vector3::zeros());
    let heaviest = world.hub.m_b;
    let wheel = ReactionWheel::drawn(random, heaviest);
    let double = Dgvscmg::drawn(random, heaviest);
    let balanced = BalancedDgvscmg::drawn(random, heaviest);
    let (panel, slosh) = (HingedPanel::drawn(random, heaviest), SloshMass::drawn(random, heaviest));
    let settings = [
        joints::<ReactionWheel>(random),
        joints::<Dgvscmg>(random),
        joints::<BalancedDgvscmg>(random),
        joints::<HingedPanel>(random),
        joints::<SloshMass>(random),
    ];
    let mut slow = |joint: &Joint| {
        let [q, rate] = joint.state;
        let rate = rate.clamp(-FASTEST, FASTEST) * random.within(0.1, 1.0);
        Joint { state: [q, rate], torque: 0.0, ..*joint }
    };
    let settings: Vec<_> = settings.concat().iter().map(&mut slow).collect();
    let case = world.case(&(wheel, [double], balanced, (panel, slosh)), &settings);
    let chains =
        vec![wheel.chain(), double.chain(), balanced.chain(), panel.chain(), slosh.chain()];
    let masses = PointMasses::of_spacecraft(&world.hub, &case.state, chains);
    (case, masses)
}

#[test]
fn brakes_that_close_and_open_conserve_momentum_and_take_what_energy_is_lost() {
    let error = |random: &mut Random| {
        let (mut case, masses) = coasting(random);
        let [linear, angular] = sizes(&masses);
        let momentum = |case: &Case<Set>| {
            case.expect_ok(case.craft.momentum(&case.state, About::InertialOrigin))
        };
        let energy = |case: &Case<Set>| case.expect_ok(case.craft.energy(&case.state));
        let (at_first, mut left) = (momentum(&case), energy(&case));
        let unit = left;
        let mut errors = Vec::new();
        for step in 0..STEPS {
            if step % HELD == 0 {
                let mut settings = case.settings();
                for joint in &mut settings {
                    joint.mode =
                        if random.within(0.0, 1.0) < 0.25 { Mode::Locked } else { Mode::Driven };
                }
                case.set(&settings);
                let stopped = case.expect_ok(case.craft.stop(&case.state, &case.inputs));
                left -= stopped.energy_lost;
                case.state = stopped.state;
            }
            let before = case.state;
            case.state = case.expect_ok(case.craft.step(&case.state, &case.inputs, STEP));
            let joints = before.devices.states().zip(case.state.devices.states());
            for (([q, _], [same, rate]), mode) in joints.zip(case.inputs.modes.values()) {
                if mode == Mode::Locked {
                    assert_eq!((same, rate), (q, 0.0), "a locked joint moves, step {step}");
                }
            }
            let now = momentum(&case);
            errors.extend([
                (now.linear - at_first.linear).norm() / linear,
                (now.angular - at_first.angular).norm() / angular,
                (energy(&case) - left).abs() / unit,
            ]);
        }
        largest(errors)
    };
    errors_of(RUNS, error).are_within(DRIFT);
}
