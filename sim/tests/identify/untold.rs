//! What the data cannot tell is named, in three constructed cases.

use std::path::Path;

use precess::file::from_toml;
use precess::file::identification_example as example;
use precess::identify::recording::Recording;
use precess::identify::{Direction, Identified, Unknown, UnknownPrior, Unknowns};
use precess::scenario::Scenario;
use precess_dynamics::JointStates as _;

use super::identified;
use super::recovered::unknowns;

/// s.
const SHORT: f64 = 4.0;

/// The scenario of the example without friction of its wheels.
pub(crate) fn frictionless() -> Scenario {
    let text = example::SCENARIO.replace("damping = \"1e-5 N m s/rad\"\n", "");
    from_toml("bus", &text, Path::new("")).expect("a scenario").0
}

/// These unknowns, with priors of imbalances and moments, near the truth.
pub(crate) fn known(of: &[Unknown], others: &Unknowns) -> Unknowns {
    let prior = |unknown: &Unknown| UnknownPrior {
        unknown: *unknown,
        deviations: match unknown {
            Unknown::Imbalance(_) => vec![1e-5, 1e-6],
            Unknown::HubMoments => vec![1.0],
            _ => Vec::new(),
        },
    };
    Unknowns { unknowns: of.iter().map(prior).collect(), is_near: true, ..others.clone() }
}

/// A short record under torques of this amplitude, N m.
pub(crate) fn record(scenario: &Scenario, torque: f64) -> String {
    let recording = Recording { duration: SHORT, torque, ..example::RECORDING };
    recording.csv(scenario).expect("telemetry")
}

pub(crate) fn found(scenario: &Scenario, torque: f64, of: &[Unknown]) -> Identified {
    let own = known(of, &unknowns(scenario));
    identified(scenario, &record(scenario, torque), &own).expect("estimates")
}

fn names(direction: &Direction) -> Vec<&str> {
    direction.changes.iter().map(|(name, ..)| name.as_str()).collect()
}

/// Without torques nothing but the lines of the wheels depends on the inertia of the hub, and those on imbalances as much.
#[test]
fn without_a_manoeuvre_the_moments_of_the_hub_are_named() {
    let scenario = frictionless();
    let wheels = [0, 1, 2, 3].map(Unknown::Imbalance);
    let all: Vec<_> = wheels.into_iter().chain([Unknown::HubMoments]).collect();
    let quiet = found(&scenario, 0.0, &all);
    let moments = |of: &Direction| names(of).iter().any(|name| name.starts_with("hub.i_b_bc_"));
    assert!(quiet.untold.iter().any(moments), "{:?}", quiet.untold);
    let turned = found(&scenario, 0.05, &all);
    assert!(!turned.untold.iter().any(moments), "{:?}", turned.untold);
}

/// Wheels at one speed have one line: which of them has which imbalance, nobody knows.
#[test]
fn imbalances_of_wheels_at_one_speed_are_named() {
    let mut scenario = frictionless();
    for [_, rate] in scenario.initial.devices.states_mut() {
        *rate = 120.0;
    }
    let found = found(&scenario, 0.0, &[0, 1, 2, 3].map(Unknown::Imbalance));
    let of_several = |of: &Direction| {
        let has = |wheel: &&&str| names(of).iter().any(|name| name.starts_with(**wheel));
        ["rw1", "rw2", "rw3", "rw4"].iter().filter(has).count() > 1
    };
    assert!(found.untold.iter().any(of_several), "{:?}", found.untold);
    // Each has a prior, which tells it.
    assert!(found.is_told());
}

/// A mount that turns about the spin axis is an angle of the wheel.
#[test]
fn a_mount_about_the_spin_axis_is_named() {
    let truth = example::truth().expect("a scenario");
    let found = found(&truth, 0.05, &[Unknown::Imbalance(1), Unknown::Mount(1)]);
    let of_mount = |of: &Direction| names(of).iter().any(|name| name.starts_with("rw2.mount_"));
    assert!(!found.is_told() && found.untold.iter().any(of_mount), "{:?}", found.untold);
}
