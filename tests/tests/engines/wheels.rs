//! A run of three imbalanced reaction wheels with motors against Basilisk's own effector for wheels,
//! fully coupled, 20,000 steps of RK4: `fixtures/wheels.json`, written by `engines/wheels.py`; and
//! with lumped imbalances and viscous friction: `fixtures/lumped.json`, by `engines/lumped.py`.
//!
//! Run with `--nocapture` to see the differences.

use precess_tests::blocks::largest;
use precess_tests::bounds::WHEELS_BESIDE_BASILISK;
use precess_tests::wheels::{Difference, Stored};

#[test]
fn three_imbalanced_wheels_move_as_basilisk_moves_them() {
    move_as_basilisk_moves_them(&coupled());
}

#[test]
fn wheels_with_lumped_imbalances_and_friction_move_as_basilisk_moves_them() {
    move_as_basilisk_moves_them(&lumped());
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn a_change_of_any_input_shows() {
    // There is no friction.
    changes_show(&coupled(), &["friction"]);
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn a_change_of_any_input_of_the_lumped_wheels_shows() {
    changes_show(&lumped(), &[]);
}

/// What every input is changed by, to see whether the comparison notices.
const CHANGE: f64 = 1.0 + 1e-8;

fn coupled() -> Stored {
    Stored::read().expect("fixtures/wheels.json; write it with engines/wheels.py")
}

fn lumped() -> Stored {
    Stored::read_lumped().expect("fixtures/lumped.json; write it with engines/lumped.py")
}

fn move_as_basilisk_moves_them(stored: &Stored) {
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

fn changes_show(stored: &Stored, without: &[&str]) {
    for (name, changed) in stored.changed(CHANGE) {
        let differences = changed.differences().expect("a run");
        let worst = largest(differences.map(|found| found.error));
        println!("{name}: {worst:.1e}");
        let shows = worst > 10.0 * WHEELS_BESIDE_BASILISK;
        assert!(shows || without.contains(&name), "{name}, changed by 1e-8: {worst:e}");
    }
}
