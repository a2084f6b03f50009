//! A run of three imbalanced reaction wheels with motors against Basilisk's own effector for wheels,
//! fully coupled, 20,000 steps of RK4: `fixtures/wheels.json`, written by `engines/wheels.py`.
//!
//! Run with `--nocapture` to see the differences.

use precess_tests::blocks::largest;
use precess_tests::bounds::WHEELS_BESIDE_BASILISK;
use precess_tests::wheels::{Difference, Stored};

#[test]
fn three_imbalanced_wheels_move_as_basilisk_moves_them() {
    let stored = Stored::read().expect("fixtures/wheels.json; write it with engines/wheels.py");
    assert_eq!(stored.steps, 20_000);
    for Difference { quantity, unit, largest, error } in stored.differences().expect("a run") {
        println!("{quantity}: {error:.1e} of {largest:.3} {unit}");
        assert!(
            error <= WHEELS_BESIDE_BASILISK,
            "{quantity} differs from Basilisk {} by {error:e} of {largest} {unit}, above \
             {WHEELS_BESIDE_BASILISK:e}",
            stored.basilisk
        );
    }
}

/// What every input is changed by, to see whether the comparison notices.
const CHANGE: f64 = 1.0 + 1e-8;

#[test]
fn a_change_of_any_input_shows() {
    let stored = Stored::read().expect("fixtures/wheels.json; write it with engines/wheels.py");
    for (name, changed) in stored.changed(CHANGE) {
        let differences = changed.differences().expect("a run");
        let worst = largest(differences.map(|found| found.error));
        println!("{name}: {worst:.1e}");
        assert!(worst > 10.0 * WHEELS_BESIDE_BASILISK, "{name}, changed by 1e-8: {worst:e}");
    }
}
