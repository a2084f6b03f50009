//! Modes that change from step to step: brakes close and open over a run, momentum stays, and a
//! locked joint does not move at all.

use nalgebra::Vector3;
use precess_dynamics::kind::{Each, JointStates};
use precess_dynamics::{
    About, BalancedDgvscmg, Dgvscmg, HingedPanel, Mode, ReactionWheel, SloshMass,
};

use crate::bench::{Bench, Joint, World, joints, largest};
use crate::cloud::Cloud;
use crate::devices::Drawn;
use crate::random::{Random, errors_of};
use crate::stops::sizes;

/// E3, drift of both momenta over a run; and E2, of energy less what the brakes took.
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
fn coasting(random: &mut Random) -> (Bench<Set>, Cloud) {
    let mut world = World::drawn(random);
    (world.force, world.torque_b) = (Vector3::zeros(), Vector3::zeros());
    let heaviest = world.hub.m_b;
    let wheel = ReactionWheel::drawn(random, heaviest);
    let double = Dgvscmg::drawn(random, heaviest);
    let balanced = BalancedDgvscmg::drawn(random, heaviest);
    let (panel, slosh) = (HingedPanel::drawn(random, heaviest), SloshMass::drawn(random, heaviest));
    let told = [
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
    let told: Vec<_> = told.concat().iter().map(&mut slow).collect();
    let bench = world.bench(&(wheel, [double], balanced, (panel, slosh)), &told);
    let chains =
        vec![wheel.chain(), double.chain(), balanced.chain(), panel.chain(), slosh.chain()];
    let cloud = Cloud::of(&world, &bench, chains);
    (bench, cloud)
}

#[test]
fn brakes_that_close_and_open_conserve_momentum_and_take_what_energy_is_lost() {
    let error = |random: &mut Random| {
        let (mut bench, cloud) = coasting(random);
        let [linear, angular] = sizes(&cloud);
        let momentum = |bench: &Bench<Set>| {
            bench.sound(bench.craft.momentum(&bench.state, About::InertialOrigin))
        };
        let energy = |bench: &Bench<Set>| bench.sound(bench.craft.energy(&bench.state));
        let (at_first, mut left) = (momentum(&bench), energy(&bench));
        let unit = left;
        let mut errors = Vec::new();
        for step in 0..STEPS {
            if step % HELD == 0 {
                let mut told = bench.told();
                for joint in &mut told {
                    joint.mode =
                        if random.within(0.0, 1.0) < 0.25 { Mode::Locked } else { Mode::Driven };
                }
                bench.tell(&told);
                let stopped = bench.sound(bench.craft.stop(&bench.state, &bench.inputs));
                left -= stopped.energy_lost;
                bench.state = stopped.state;
            }
            let before = bench.state;
            bench.state = bench.sound(bench.craft.step(&bench.state, &bench.inputs, STEP));
            let joints = before.devices.states().zip(bench.state.devices.states());
            for (([q, _], [same, rate]), mode) in joints.zip(bench.inputs.modes.values()) {
                if mode == Mode::Locked {
                    assert_eq!((same, rate), (q, 0.0), "a locked joint moves, step {step}");
                }
            }
            let now = momentum(&bench);
            errors.extend([
                (now.linear - at_first.linear).norm() / linear,
                (now.angular - at_first.angular).norm() / angular,
                (energy(&bench) - left).abs() / unit,
            ]);
        }
        largest(errors)
    };
    errors_of(RUNS, error).are_within(DRIFT);
}
