//! Spacecraft with devices of every kind and mixed sets, with springs, dampers, friction, wrenches
//! on bodies, uniform gravity, modes of joints and of the hub: `fixtures/kinds.json`, written by
//! `engines/kinds.py`.
//!
//! Pinocchio is held to the bounds of the accelerations. `MuJoCo`'s rounding is larger, so the
//! reference in double-double says of each engine how much of a difference is its own. Run with
//! `--nocapture` to see worst and median of each claim.

mod changes;
mod claim;
mod judge;
mod solver;
mod stored;

use std::collections::BTreeSet;

use precess_dynamics::BuiltInKind;
use precess_tests::bounds::{
    ACCELERATIONS_MEDIAN, ACCELERATIONS_WORST, MUJOCO_MEDIAN, MUJOCO_WORST, ROUTES_IN_DOUBLE_DOUBLE,
};
use precess_tests::double_double::DoubleDouble;

use claim::{Blocks, Claims};
use solver::Case;
use stored::{Craft, Evaluated, StoredHubMode, StoredMode};

#[test]
fn file_holds_every_kind_and_mode_from_two_engines() {
    let file = stored::file();
    println!("pinocchio {}, mujoco {}", file.engines.pinocchio, file.engines.mujoco);
    if !stored::is_stored() {
        return;
    }
    let all = || file.spacecraft.iter().map(|evaluated| &evaluated.craft);
    let of_group = |group: &str| -> BTreeSet<String> {
        let stops = file.stops.iter().map(|stop| &stop.craft);
        let crafts = all().chain(stops).filter(|craft| craft.group == group);
        crafts.flat_map(|craft| &craft.devices).map(|device| device.kind.clone()).collect()
    };
    for group in ["kind", "passive", "modes", "set", "modes of a set", "stop"] {
        for kind in BuiltInKind::ALL {
            assert!(of_group(group).contains(kind.name()), "{group}: no {}", kind.name());
        }
    }
    // A massless gimbal of a flexible VSCMG has no inertia at all: its rotor has all six freedoms.
    let without_mass =
        |kind: &&BuiltInKind| kind.joints().len() > 1 && **kind != BuiltInKind::FlexibleVscmg;
    let gimballed = of_group("massless gimbals").len();
    assert_eq!(gimballed, BuiltInKind::ALL.iter().filter(without_mass).count());
    let hubs = |is: fn(&StoredHubMode) -> bool| {
        let of_set = all().filter(|craft| craft.group == "modes of a set");
        of_set.filter(|craft| is(&craft.hub_mode)).count()
    };
    assert!(hubs(|mode| matches!(mode, StoredHubMode::Free)) >= 3, "free hubs");
    assert!(hubs(|mode| matches!(mode, StoredHubMode::Fixed)) >= 3, "fixed hubs");
    assert!(hubs(|mode| matches!(mode, StoredHubMode::Prescribed { .. })) >= 3, "prescribed hubs");
    let modes = |is: fn(&StoredMode) -> bool| {
        all().flat_map(Craft::joints).filter(|joint| is(&joint.mode)).count()
    };
    assert!(modes(|mode| matches!(mode, StoredMode::Locked)) >= 20, "locked joints");
    assert!(
        modes(|mode| matches!(mode, StoredMode::Prescribed(a) if *a != 0.0)) >= 20,
        "prescribed"
    );
}

#[test]
fn solver_gives_the_accelerations_of_pinocchio() {
    let mut claims = Claims::new("solver against pinocchio");
    for Evaluated { craft, pinocchio, .. } in &stored::file().spacecraft {
        let found = Blocks::of_solver(&Case::<f64>::new(craft));
        claims.take(craft, &found, &Blocks::of_engine(&pinocchio.engine));
    }
    claims.finish(ACCELERATIONS_WORST, ACCELERATIONS_MEDIAN);
}

#[test]
fn solver_gives_the_loads_and_motor_torques_of_pinocchio() {
    let mut claims = Claims::new("loads against pinocchio");
    for evaluated in &stored::file().spacecraft {
        let craft = &evaluated.craft;
        let found = Blocks::of_loads(&Case::new(craft), craft);
        claims.take(craft, &found, &Blocks::of_engines_loads(evaluated));
    }
    claims.finish(ACCELERATIONS_WORST, ACCELERATIONS_MEDIAN);
}

#[test]
fn solver_gives_energies_momenta_and_centre_of_mass_of_both_engines() {
    let mut of_pinocchio = Claims::new("energies, momenta, centre of mass against pinocchio");
    let mut of_mujoco = Claims::new("energies, momenta, centre of mass against mujoco");
    for Evaluated { craft, pinocchio, mujoco } in &stored::file().spacecraft {
        let found = Blocks::of_sums(&Case::new(craft));
        of_pinocchio.take(craft, &found, &Blocks::of_engines_sums(&pinocchio.engine));
        of_mujoco.take(craft, &found, &Blocks::of_engines_sums(mujoco));
    }
    of_pinocchio.finish(ACCELERATIONS_WORST, ACCELERATIONS_MEDIAN);
    of_mujoco.finish(MUJOCO_WORST, MUJOCO_MEDIAN);
}

#[test]
fn solver_stops_joints_impulsively_as_pinocchio_does() {
    let mut claims = Claims::new("impulsive stops against pinocchio");
    for stop in &stored::file().stops {
        let found = Blocks::of_stop(&Case::new(&stop.craft));
        claims.take(&stop.craft, &found, &Blocks::of_engines_stop(stop));
    }
    claims.finish(ACCELERATIONS_WORST, ACCELERATIONS_MEDIAN);
}

/// Largest error of the energy lost in a stop, of itself. As a difference of two energies it was
/// 6.8e-12.
const ENERGY_LOST: f64 = 1e-12;

/// In double-double the difference of the two kinetic energies has digits to spare.
#[test]
fn energy_lost_is_the_difference_of_energies_in_double_double() {
    let mut solver = Claims::new("energy lost against double-double");
    let mut twofold = Claims::new("energy lost against its difference, both double-double");
    let mut of_pinocchio = Claims::new("energy lost of pinocchio against double-double");
    for stop in &stored::file().stops {
        let (craft, case) = (&stop.craft, Case::<DoubleDouble>::new(&stop.craft));
        let lost = Blocks::of_energy_lost(case.energy_difference());
        let found = Case::<f64>::new(craft).stopped().energy_lost;
        solver.take(craft, &Blocks::of_energy_lost(found), &lost);
        twofold.take(craft, &Blocks::of_energy_lost(case.stopped().energy_lost), &lost);
        of_pinocchio.take(craft, &Blocks::of_energy_lost(stop.pinocchio.energy_lost), &lost);
    }
    solver.finish(ENERGY_LOST, ACCELERATIONS_MEDIAN);
    twofold.finish(ROUTES_IN_DOUBLE_DOUBLE, ROUTES_IN_DOUBLE_DOUBLE);
    of_pinocchio.finish(ENERGY_LOST, ACCELERATIONS_MEDIAN);
}

/// Whose rounding separates solver, Pinocchio and `MuJoCo`: each against the reference.
#[test]
fn reference_in_double_double_is_within_the_rounding_of_all() {
    let mut solver = Claims::new("solver against the reference");
    let mut twofold = Claims::new("solver against the reference, both double-double");
    let mut of_pinocchio = Claims::new("pinocchio against the reference");
    let mut of_mujoco = Claims::new("mujoco against the reference");
    for Evaluated { craft, pinocchio, mujoco } in &stored::file().spacecraft {
        let judge = judge::craft::<DoubleDouble>(craft);
        let motion = judge.motion().unwrap_or_else(|| panic!("{}: singular", craft.name));
        let case = Case::<f64>::new(craft);
        let expected = Blocks::of_reference(&motion, &case);
        solver.take(craft, &Blocks::of_solver(&case), &expected);
        twofold.take(craft, &Blocks::of_solver(&Case::<DoubleDouble>::new(craft)), &expected);
        of_pinocchio.take(craft, &Blocks::of_engine(&pinocchio.engine), &expected);
        of_mujoco.take(craft, &Blocks::of_engine(mujoco), &expected);
    }
    solver.finish(ACCELERATIONS_WORST, ACCELERATIONS_MEDIAN);
    twofold.finish(ROUTES_IN_DOUBLE_DOUBLE, ROUTES_IN_DOUBLE_DOUBLE);
    of_pinocchio.finish(ACCELERATIONS_WORST, ACCELERATIONS_MEDIAN);
    of_mujoco.finish(MUJOCO_WORST, MUJOCO_MEDIAN);
}
