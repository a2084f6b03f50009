//! The power balance of single states, with no integrator in it: row E1.
//!
//! Run with `--nocapture` to see the figures.

use precess_dynamics::{Real, Scalar, Spacecraft};
use precess_tests::blocks::Figures;
use precess_tests::case::{Case, converted};
use precess_tests::double_double::DoubleDouble as Wide;
use precess_tests::random::{Sample, Visitor, visit};
use precess_tests::table1::{self, SCENARIOS};

/// E1: epsilons of the sum of the absolute values of all terms; no integrator in it.
const POWER_EPSILONS: f64 = 50.0;

/// E1 is tried on as many random spacecraft as A2.
const SPACECRAFT: u64 = 1000;

/// The power balance of the solver's accelerations, in epsilons of its unit, evaluated in
/// double-double: what remains is the solver's rounding.
fn imbalance<const N: usize>(case: &Case<N>, spacecraft: &Spacecraft<N>) -> f64 {
    let solution = spacecraft
        .accelerations(&case.state, &case.torques)
        .unwrap_or_else(|error| panic!("N = {N}: {error}"));
    let balance = case.converted::<Wide>().snapshot().power_balance(&converted(&solution));
    let error = (balance.energy_dot - balance.power).abs();
    (error * balance.magnitudes.recip()).to_f64() / f64::EPSILON
}

fn spacecraft<const N: usize, T: Scalar>(case: &Case<N, T>) -> Spacecraft<N, T> {
    Spacecraft::new(&case.hub, &case.devices).unwrap_or_else(|error| panic!("N = {N}: {error}"))
}

#[test]
fn power_fed_in_is_the_rate_of_the_energy_on_random_spacecraft() {
    struct Check(Figures);
    impl Visitor for Check {
        fn visit<const N: usize>(&mut self, sample: &Sample<N>) {
            let case = sample.case::<f64>();
            let error = imbalance(&case, &spacecraft(&case));
            self.0.add(error);
            assert!(
                error <= POWER_EPSILONS,
                "E1: {error} epsilons are above {POWER_EPSILONS} (seed {:#x}, N = {N})",
                sample.seed
            );
        }
    }
    let mut check = Check(Figures::default());
    visit(SPACECRAFT, &mut check);
    println!("E1: worst {:.2}, median {:.2} epsilons", check.0.worst(), check.0.median());
}

/// Ten seconds of every scenario, every tenth of a second.
#[test]
fn power_fed_in_is_the_rate_of_the_energy_along_table_1() {
    let mut figures = Figures::default();
    for (wheel, drive) in SCENARIOS {
        let mut case = table1::scenario(wheel, drive);
        let spacecraft = spacecraft(&case);
        for step in 0..2560 {
            if step % 25 == 0 {
                let error = imbalance(&case, &spacecraft);
                figures.add(error);
                assert!(
                    error <= POWER_EPSILONS,
                    "E1: {error} epsilons are above {POWER_EPSILONS} ({wheel:?} {drive:?}, step \
                     {step})"
                );
            }
            case.state = spacecraft
                .step(&case.state, &case.torques, 1.0 / 256.0)
                .unwrap_or_else(|error| panic!("{wheel:?} {drive:?}: {error}"));
        }
    }
    println!("E1, Table 1: worst {:.2}, median {:.2} epsilons", figures.worst(), figures.median());
}
