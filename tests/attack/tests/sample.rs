//! A fixed sample of the campaign: some cases of every property, the same every time.

use precess_attack::campaign::chunk;
use precess_attack::properties::{PROPERTIES, named};

/// The sample's seed.
const SEED: u64 = 0x1AC_17C1;

/// The first cases of a property.
#[track_caller]
fn holds(name: &str, cases: u32) {
    let property = named(name).unwrap_or_else(|| panic!("no property {name}"));
    let (tally, failure) = chunk(property, SEED, 0, cases);
    if let Some(failure) = failure {
        panic!("{}: {}\n{}", failure.name(), failure.message, failure.code());
    }
    assert!(tally.rejected < tally.cases, "{name}: every case is rejected");
}

macro_rules! sample {
    ($($test:ident: $name:literal, $cases:literal;)*) => {
        $(#[test]
        fn $test() {
            holds($name, $cases);
        })*

        #[test]
        fn every_property_is_sampled() {
            let sampled = [$($name),*];
            assert!(PROPERTIES.iter().map(|property| property.name).eq(sampled));
        }
    };
}

sample! {
    result_or_error: "result-or-error", 600;
    first_bad_input_is_named: "first-bad-input-is-named", 1500;
    shapes_are_bit_identical: "shapes-are-bit-identical", 200;
    batch_is_spacecraft: "batch-is-spacecraft", 150;
    singular_is_refused: "singular-is-refused", 2000;
    inverse_dynamics_residual: "inverse-dynamics-residual", 1000;
    wrapping_changes_nothing: "wrapping-changes-nothing", 500;
    order_changes_only_rounding: "order-changes-only-rounding", 500;
    attitudes_agree: "attitudes-agree", 100;
    ledger_balances: "ledger-balances", 1000;
    kinetic_energy_is_not_negative: "kinetic-energy-is-not-negative", 5000;
    stop_conserves: "stop-conserves", 500;
    locked_stays_locked: "locked-stays-locked", 200;
    longest_step_holds: "longest-step-holds", 100;
    runs_conserve_or_refuse: "runs-conserve-or-refuse", 100;
    errors_are_typed: "errors-are-typed", 500;
    central_gravity: "central-gravity", 2000;
    near_singular: "near-singular", 500;
    derivatives_or_error: "derivatives-or-error", 200;
    derivatives_are_differences: "derivatives-are-differences", 100;
}
