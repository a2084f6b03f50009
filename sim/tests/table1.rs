//! Table 1 over ten seconds, every variant: what must not drift does not (rows E2 and E3).

use precess::run::{Settings, run};
use precess::scenario::table1::{Imbalance, variants};

/// E2: energy less work, unit = largest kinetic energy + integral of sum |u rate|; the bound is a
/// hundred times what a good integrator has reached at this tolerance.
const E2: f64 = 1e-12;
/// E3: both momenta, unit = sum over the bodies of magnitudes; the same runs.
const E3: f64 = 1e-12;

#[test]
fn energy_less_work_and_both_momenta_stay_within_the_bounds() {
    // Few samples: the ledger enters every step by itself.
    let settings = Settings { duration: 10.0, tolerance: 1e-13, rate: 10.0 };
    for variant in variants(None, None) {
        let history = run(&variant.scenario(), &settings, &mut |_| {}).expect("every variant runs");
        for (of, ledger) in [("steps", &history.ledger), ("samples", &history.sampled_ledger())] {
            let drift = ledger.drift();
            let name = variant.name();
            assert!(drift.energy <= E2, "{name}, {of}: energy drifts by {:e}", drift.energy);
            assert!(drift.linear <= E3, "{name}, {of}: linear momentum by {:e}", drift.linear);
            assert!(drift.angular <= E3, "{name}, {of}: angular momentum by {:e}", drift.angular);
        }
        assert!(history.steps.accepted > 500, "a ledger of every step, and steps below a turn");
    }
}

/// With its angle kept to a turn the printed wheel's momentum stays within 4e-14; rounding an angle
/// of 600 rad in every step walks it to 3e-13 and 9e-13.
const WALK: f64 = 1e-13;

#[test]
fn a_wheel_of_many_turns_does_not_walk_away_from_the_hub() {
    let settings = Settings { duration: 10.0, tolerance: 1e-13, rate: 10.0 };
    for variant in variants(Some(Imbalance::Printed), None) {
        let history = run(&variant.scenario(), &settings, &mut |_| {}).expect("every variant runs");
        let drift = history.ledger.drift().linear;
        assert!(drift <= WALK, "{}: linear momentum by {drift:e}", variant.name());
    }
}
