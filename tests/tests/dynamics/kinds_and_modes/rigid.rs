//! Locked joints make a rigid body: the hub with their masses, by parallel axes.

use precess_dynamics::kind::JointInfo;
use precess_dynamics::{
    BalancedDgcmg, BalancedDgvscmg, BalancedReactionWheel, BalancedSgcmg, BalancedVscmg, Dgcmg,
    Dgvscmg, ReactionWheel, Sgcmg, Vscmg,
};
use precess_dynamics::{FlexibleReactionWheel, FlexibleVscmg, HingedPanel, SloshMass};
use precess_point_masses::{Rigid, posed};

use super::case::{Joint, LIMITS, SEEDS, World};
use super::devices::Drawn;
use super::random::{Random, errors_of};

/// Two devices of a kind with every joint still, against the hub that has taken their bodies.
fn locked_is_rigid<K: Drawn>() {
    let error = |random: &mut Random| {
        let world = World::drawn(random);
        let devices = [(); 2].map(|()| K::drawn(random, world.hub.m_b));
        let still = |info: &JointInfo, random: &mut Random| {
            let locked = Joint::locked(random.joint(info)[0]);
            // A kind's own prescribed joint takes no lock: at rest it keeps still.
            if info.driven { locked } else { locked.prescribed(0.0) }
        };
        let pose =
            [(); 2].map(|()| K::JOINTS.iter().map(|info| still(info, random)).collect::<Vec<_>>());
        let mut bodies = vec![Rigid::of_hub(&world.hub)];
        for (device, pose) in devices.iter().zip(&pose) {
            let coordinates: Vec<_> = pose.iter().map(|joint| joint.state[0]).collect();
            bodies.extend(posed(&device.chain(), &coordinates));
        }
        let rigid = world.on(Rigid::merged(&bodies).hub());
        let expected = rigid.case::<[Dgvscmg; 0]>(&[], &[]).solved();
        let mut found = world.case(&devices, &pose.concat()).solved();
        assert!(found.joints.iter().all(|(_, acceleration)| *acceleration == 0.0));
        found.joints.clear();
        found.error(&expected)
    };
    errors_of(SEEDS, error).are_within(LIMITS);
}

#[test]
fn locked_wheel_is_part_of_the_hub() {
    locked_is_rigid::<ReactionWheel>();
    locked_is_rigid::<BalancedReactionWheel>();
}

#[test]
fn locked_single_gimbal_is_part_of_the_hub_at_any_angle() {
    locked_is_rigid::<Vscmg>();
    locked_is_rigid::<BalancedVscmg>();
    locked_is_rigid::<Sgcmg>();
    locked_is_rigid::<BalancedSgcmg>();
}

#[test]
fn locked_double_gimbal_is_part_of_the_hub_at_any_angles() {
    locked_is_rigid::<Dgvscmg>();
    locked_is_rigid::<BalancedDgvscmg>();
    locked_is_rigid::<Dgcmg>();
    locked_is_rigid::<BalancedDgcmg>();
}

#[test]
fn wheel_on_locked_bearings_is_part_of_the_hub_wherever_they_stand() {
    locked_is_rigid::<FlexibleReactionWheel>();
    locked_is_rigid::<FlexibleVscmg>();
}

#[test]
fn locked_panel_is_part_of_the_hub_at_any_angle() {
    locked_is_rigid::<HingedPanel>();
}

#[test]
fn locked_slosh_mass_is_a_point_mass_wherever_it_stands() {
    locked_is_rigid::<SloshMass>();
}
