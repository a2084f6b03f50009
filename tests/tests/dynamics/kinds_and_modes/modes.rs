//! Modes: prescribed accelerations are returned unchanged, and the torques that they need, as motor
//! torques, give the same motion.

use precess_dynamics::kind::Each;
use precess_dynamics::{
    Accelerations, BalancedDgcmg, BalancedDgvscmg, BalancedReactionWheel, BalancedSgcmg,
    BalancedVscmg, Dgcmg, Dgvscmg, FlexibleReactionWheel, FlexibleVscmg, HingedPanel, LoadAxes,
    Mode, ReactionWheel, Sgcmg, SloshMass, Vscmg,
};
use precess_tests::all_or;

use super::balance::pair;
use super::case::{Case, Joint, LIMITS};
use super::devices::Drawn;
use super::random::{Random, errors_of};

/// Spacecraft per combination of modes, two in a default run; a double gimbal has 729 of them.
const SEEDS: u64 = 10;

/// The most combinations on a spacecraft. The kinds with flexible bearings have 3^12 and 3^14: of these so many
/// at random.
const COMBINATIONS: usize = 729;

/// Combinations of modes that the joints of two devices can have, on random spacecraft, and the largest error
/// of a claim.
fn every_combination<K: Drawn>(claim: impl Fn(&Case<[K; 2]>) -> f64) {
    let error = |random: &mut Random| {
        let (_, case, _) = pair::<K>(random);
        let driven = case.craft.joints().filter(|(_, info)| info.driven).count();
        let all = 3_usize.pow(u32::try_from(driven).expect("fourteen at most"));
        let errors = (0..all.min(COMBINATIONS)).map(|number| {
            let mut drawn = || usize::try_from(random.bits()).expect("64 bits") % all;
            let combination = if all <= COMBINATIONS { number } else { drawn() };
            let mut case = case.clone();
            set(&mut case, combination, random);
            claim(&case)
        });
        super::case::largest(errors)
    };
    errors_of(all_or(SEEDS, 2), error).are_within(LIMITS);
}

/// The modes that are the digits of a number to base three, from the first joint.
fn set<K: Drawn>(case: &mut Case<[K; 2]>, mut combination: usize, random: &mut Random) {
    let mut settings = case.settings();
    let joints = settings.iter_mut().zip(case.craft.joints());
    for (joint, _) in joints.filter(|(_, (_, info))| info.driven) {
        *joint = match combination % 3 {
            0 => *joint,
            1 => joint.prescribed(random.within(-10.0, 10.0)),
            _ => Joint::locked(joint.state[0]),
        };
        combination /= 3;
    }
    case.set(&settings);
}

/// A joint that is not driven has the prescribed acceleration, to the bit.
fn given_comes_out<K: Drawn>(case: &Case<[K; 2]>, found: &Accelerations<[K; 2]>) {
    for (found, mode) in found.devices.values().zip(case.inputs.modes.values()) {
        let given = match mode {
            Mode::Driven => continue,
            Mode::Prescribed(given) => given,
            Mode::Locked => 0.0,
        };
        assert_eq!(found.to_bits(), given.to_bits(), "seed {:#x}", case.seed);
    }
}

/// The motor torques that accelerations need, joint by joint.
fn motors<K: Drawn>(case: &Case<[K; 2]>, found: &Accelerations<[K; 2]>) -> Vec<f64> {
    let loads = case.craft.loads(&case.state, &case.inputs, found, LoadAxes::Body);
    case.expect_ok(loads).devices.iter().flat_map(|device| device.motors.values()).collect()
}

/// The torques that `loads` returns give the same motion as motor torques: only rounding differs.
fn what_it_takes_drives_it<K: Drawn>() {
    every_combination(|case: &Case<[K; 2]>| {
        let found = case.accelerations();
        given_comes_out(case, &found);
        let [mut drives, mut given, mut free] = [(); 3].map(|()| case.settings());
        let joints = drives.iter_mut().zip(&mut given).zip(&mut free);
        let own = joints.zip(motors(case, &found)).zip(case.craft.joints());
        for ((((drive, given), free), torque), _) in own.filter(|(_, (_, info))| info.driven) {
            *drive = Joint { torque, mode: Mode::Driven, ..*drive };
            // So that a locked joint is compared too.
            if given.mode == Mode::Locked {
                *given = given.prescribed(0.0);
            }
            free.mode = Mode::Driven;
        }
        // The unit of a joint that is held: its acceleration if all joints were driven.
        let solved = |settings: &[Joint]| case.with_settings(settings).solved();
        solved(&drives).error_beside(&solved(&given), &solved(&free))
    });
}

macro_rules! every_kind {
    ($check:ident: $($claim:ident $kind:ident;)*) => {$(
        #[test]
        fn $claim() {
            $check::<$kind>();
        }
    )*};
}

every_kind! { what_it_takes_drives_it:
    what_a_reaction_wheels_modes_take_drives_it ReactionWheel;
    what_a_vscmgs_modes_take_drives_it Vscmg;
    what_an_sgcmgs_modes_take_drives_it Sgcmg;
    what_a_dgvscmgs_modes_take_drives_it Dgvscmg;
    what_a_dgcmgs_modes_take_drives_it Dgcmg;
    what_a_balanced_reaction_wheels_modes_take_drives_it BalancedReactionWheel;
    what_a_balanced_vscmgs_modes_take_drives_it BalancedVscmg;
    what_a_balanced_sgcmgs_modes_take_drives_it BalancedSgcmg;
    what_a_balanced_dgvscmgs_modes_take_drives_it BalancedDgvscmg;
    what_a_balanced_dgcmgs_modes_take_drives_it BalancedDgcmg;
    what_a_panels_modes_take_drives_it HingedPanel;
    what_a_slosh_masss_modes_take_drives_it SloshMass;
    what_a_flexible_wheels_modes_take_drives_it FlexibleReactionWheel;
    what_a_flexible_vscmgs_modes_take_drives_it FlexibleVscmg;
}
