//! Modes: what is given comes out as given, what it takes is what would have driven it.

use precess_dynamics::kind::Each;
use precess_dynamics::{
    Accelerations, BalancedDgcmg, BalancedDgvscmg, BalancedReactionWheel, BalancedSgcmg,
    BalancedVscmg, Dgcmg, Dgvscmg, HingedPanel, LoadAxes, Mode, ReactionWheel, Sgcmg, SloshMass,
    Vscmg,
};

use crate::balance::pair;
use crate::bench::{Bench, Joint, LIMITS};
use crate::devices::Drawn;
use crate::random::{Random, errors_of};

/// Spacecraft per combination of modes; a double gimbal has 729 of them.
const SEEDS: u64 = 10;

/// Every combination of modes that the joints of two devices can have, on random spacecraft, and
/// the largest error of a claim.
fn every_combination<K: Drawn>(claim: impl Fn(&Bench<[K; 2]>) -> f64) {
    let error = |random: &mut Random| {
        let (_, bench, _) = pair::<K>(random);
        let driven = bench.craft.joints().filter(|(_, info)| info.driven).count();
        let combinations = 3_usize.pow(u32::try_from(driven).expect("six at most"));
        let errors = (0..combinations).map(|combination| {
            let mut bench = bench.clone();
            set(&mut bench, combination, random);
            claim(&bench)
        });
        crate::bench::largest(errors)
    };
    errors_of(SEEDS, error).are_within(LIMITS);
}

/// The modes that are the digits of a number to base three, from the first joint.
fn set<K: Drawn>(bench: &mut Bench<[K; 2]>, mut combination: usize, random: &mut Random) {
    let mut told = bench.told();
    let joints = told.iter_mut().zip(bench.craft.joints());
    for (joint, _) in joints.filter(|(_, (_, info))| info.driven) {
        *joint = match combination % 3 {
            0 => *joint,
            1 => joint.prescribed(random.within(-10.0, 10.0)),
            _ => Joint::locked(joint.state[0]),
        };
        combination /= 3;
    }
    bench.tell(&told);
}

/// A joint that is not driven has the acceleration it is given, to the bit.
fn given_comes_out<K: Drawn>(bench: &Bench<[K; 2]>, found: &Accelerations<[K; 2]>) {
    for (found, mode) in found.devices.values().zip(bench.inputs.modes.values()) {
        let given = match mode {
            Mode::Driven => continue,
            Mode::Prescribed(given) => given,
            Mode::Locked => 0.0,
        };
        assert_eq!(found.to_bits(), given.to_bits(), "seed {:#x}", bench.seed);
    }
}

/// The motor torques that accelerations need, joint by joint.
fn motors<K: Drawn>(bench: &Bench<[K; 2]>, found: &Accelerations<[K; 2]>) -> Vec<f64> {
    let loads = bench.craft.loads(&bench.state, &bench.inputs, found, LoadAxes::Body);
    bench.sound(loads).devices.iter().flat_map(|device| device.motors.values()).collect()
}

/// What `loads` says it takes gives the same motion when it drives: only rounding differs.
fn what_it_takes_drives_it<K: Drawn>() {
    every_combination(|bench: &Bench<[K; 2]>| {
        let found = bench.accelerations();
        given_comes_out(bench, &found);
        let [mut drives, mut given, mut free] = [(); 3].map(|()| bench.told());
        let joints = drives.iter_mut().zip(&mut given).zip(&mut free);
        let own = joints.zip(motors(bench, &found)).zip(bench.craft.joints());
        for ((((drive, given), free), torque), _) in own.filter(|(_, (_, info))| info.driven) {
            *drive = Joint { torque, mode: Mode::Driven, ..*drive };
            // So that a locked joint is compared too.
            if given.mode == Mode::Locked {
                *given = given.prescribed(0.0);
            }
            free.mode = Mode::Driven;
        }
        // A joint that is held needs a unit: how it would move if nothing were.
        let solved = |told: &[Joint]| bench.telling(told).solved();
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
}
