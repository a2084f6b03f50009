//! Table 1 over ten seconds, every variant: energy less work and both momenta are conserved.

use precess::run::{Settings, run};
use precess::scenario::table1::{Imbalance, variants};

/// Largest drift of energy less work, unit = largest kinetic energy + integral of sum |u rate|; the
/// bound is a hundred times what a good integrator has reached at this tolerance.
const ENERGY_DRIFT: f64 = 1e-12;
/// Largest drift of both momenta, unit = sum over the bodies of magnitudes; the same runs.
const MOMENTUM_DRIFT: f64 = 1e-12;

#[test]
fn energy_less_work_and_both_momenta_stay_within_the_bounds() {
    // Few samples: the ledger enters every step by itself.
    let settings = Settings { duration: 10.0, tolerance: 1e-13, rate: 10.0 };
    for variant in variants(None, None) {
        let history = run(&variant.scenario(), &settings, &mut |_| {}).expect("every variant runs");
        for (of, ledger) in [("steps", &history.ledger), ("samples", &history.sampled_ledger())] {
            let drift = ledger.drift();
            let name = variant.name();
            assert!(
                drift.energy <= ENERGY_DRIFT,
                "{name}, {of}: energy drifts by {:e}",
                drift.energy
            );
            assert!(
                drift.linear <= MOMENTUM_DRIFT,
                "{name}, {of}: linear momentum by {:e}",
                drift.linear
            );
            assert!(
                drift.angular <= MOMENTUM_DRIFT,
                "{name}, {of}: angular momentum by {:e}",
                drift.angular
            );
        }
        assert!(history.steps.accepted > 500, "a ledger of every step, and steps below a turn");
    }
}

/// With its angle kept to a turn the printed wheel's momentum stays within 4e-14; rounding an angle
/// of 600 rad in every step changes it by 3e-13 and 9e-13.
const MOMENTUM_OF_TURNS: f64 = 1e-13;

#[test]
fn linear_momentum_is_conserved_over_many_turns_of_the_wheel() {
    let settings = Settings { duration: 10.0, tolerance: 1e-13, rate: 10.0 };
    for variant in variants(Some(Imbalance::Printed), None) {
        let history = run(&variant.scenario(), &settings, &mut |_| {}).expect("every variant runs");
        let drift = history.ledger.drift().linear;
        assert!(drift <= MOMENTUM_OF_TURNS, "{}: linear momentum by {drift:e}", variant.name());
    }
}
