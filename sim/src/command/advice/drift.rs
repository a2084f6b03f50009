//! Advice about a hub that drifts beside its vibration, where a requirement counts that: it starts at rest, or its rotors
//! exchange power in the second order of their imbalances.

use super::Advice;
use crate::jitter::mean_acceleration::MeanAcceleration;
use crate::jitter::settled::settle;
use crate::scenario::{Requirement, Scenario, Statistic};

/// Quantities of the hub that a mean rate or velocity is in.
const MEAN_QUANTITIES: [&str; 5] = ["omega", "rotation", "sigma", "velocity", "position"];

/// A drift of less than this part of the vibration's RMS is left out: it adds a few thousandths to an RMS.
const DRIFT_SHARE: f64 = 0.1;

/// The mean rate and velocity of a hub that starts at rest under rotors out of balance, where a requirement has them.
pub(super) fn at_rest(scenario: &Scenario) -> Option<Advice> {
    let state = &scenario.initial;
    if state.omega.norm() > 0.0 || state.r_b_n_dot.norm() > 0.0 {
        return None;
    }
    let requirement = scenario.requirements.iter().find(|of| has_mean(of))?.name.clone();
    let mut settled = scenario.clone();
    settle(&mut settled).ok()?;
    let mean = [settled.initial.omega.norm(), settled.initial.r_b_n_dot.norm()];
    (mean != [0.0; 2]).then_some(Advice::Drift { requirement, mean })
}

/// Whether a requirement has the mean of a quantity of the hub.
fn has_mean(of: &Requirement) -> bool {
    let without =
        matches!(of.statistic, Statistic::BandRms(_) | Statistic::Smear(_) | Statistic::Jitter(_));
    MEAN_QUANTITIES.contains(&stem(of)) && !without
}

/// The quantity of a requirement without its axis.
fn stem(of: &Requirement) -> &str {
    of.quantity.trim_end_matches("_x").trim_end_matches("_y").trim_end_matches("_z")
}

/// The mean accelerations of a hub that starts in the vibration of its rotors, where a requirement counts what they come to.
pub(super) fn second_order(scenario: &Scenario) -> Option<Advice> {
    scenario.mean.as_ref()?;
    if !scenario.requirements.iter().any(has_mean) {
        return None;
    }
    let MeanAcceleration { angular, linear, moved, turned } =
        MeanAcceleration::new(scenario).ok()??;
    let counts = |of: &&Requirement| {
        let [_, time] = of.window;
        let (acceleration, [place, rate]) = match stem(of) {
            "omega" | "rotation" | "sigma" => (angular.norm(), turned),
            _ => (linear.norm(), moved),
        };
        let (reached, vibration) = match stem(of) {
            "omega" | "velocity" => (acceleration * time, rate),
            _ => (0.5 * acceleration * time * time, place),
        };
        has_mean(of) && reached > DRIFT_SHARE * vibration
    };
    let requirement = scenario.requirements.iter().find(counts)?.name.clone();
    Some(Advice::SecondOrder { requirement, mean: [angular.norm(), linear.norm()] })
}
