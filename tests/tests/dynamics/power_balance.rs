//! The power balance of single states, with no integrator: the rate of the kinetic energy
//! is the power of forces and motors.
//!
//! Run with `--nocapture` to see the figures.

use std::fmt::Display;

use precess_dynamics::{Real, Scalar, Spacecraft};
use precess_tests::blocks::Figures;
use precess_tests::bounds::{POWER_EPSILONS, SPACECRAFT};
use precess_tests::case::{Case, Set, converted};
use precess_tests::cases;
use precess_tests::double_double::DoubleDouble as Wide;
use precess_tests::random::{Sample, Visitor, visit};
use precess_tests::table1::{self, SCENARIOS};

/// The power balance of the solver's accelerations, in epsilons of its unit, evaluated in
/// double-double: what remains is the solver's rounding.
fn imbalance<const N: usize>(
    case: &Case<N>,
    spacecraft: &Spacecraft<Set<N>>,
    whose: impl Display,
) -> f64 {
    let solution = spacecraft
        .accelerations(&case.state, &case.inputs)
        .unwrap_or_else(|error| panic!("{whose}: {error}"));
    let balance = case.converted::<Wide>().snapshot().power_balance(&converted(&solution));
    let error = (balance.energy_dot - balance.power).abs();
    (error * balance.magnitudes.recip()).to_f64() / f64::EPSILON
}

#[test]
fn power_fed_in_is_the_rate_of_the_energy_on_random_spacecraft() {
    struct Check(Figures);
    impl Visitor for Check {
        fn visit<const N: usize>(&mut self, sample: &Sample<N>) {
            let case = sample.case::<f64>();
            let error = imbalance(&case, &case.spacecraft(sample), sample);
            self.0.add(error);
            assert!(
                error <= POWER_EPSILONS,
                "{error} epsilons are above {POWER_EPSILONS} ({sample})"
            );
        }
    }
    let mut check = Check(Figures::default());
    visit(cases(SPACECRAFT), &mut check);
    println!("worst {:.2} eps, median {:.2} eps", check.0.worst(), check.0.median());
}

/// Ten seconds of every scenario, every tenth of a second.
#[test]
fn power_fed_in_is_the_rate_of_the_energy_along_table_1() {
    let mut figures = Figures::default();
    for (wheel, drive) in SCENARIOS {
        let mut case = table1::scenario(wheel, drive);
        let whose = format!("{wheel:?} {drive:?}");
        let spacecraft = case.spacecraft(&whose);
        for step in 0..2560 {
            if step % 25 == 0 {
                let error = imbalance(&case, &spacecraft, &whose);
                figures.add(error);
                assert!(
                    error <= POWER_EPSILONS,
                    "{error} epsilons are above {POWER_EPSILONS} ({whose}, step {step})"
                );
            }
            case.state = spacecraft
                .step(&case.state, &case.inputs, 1.0 / 256.0)
                .unwrap_or_else(|error| panic!("{whose}, step {step}: {error}"));
        }
    }
    println!("Table 1: worst {:.2} eps, median {:.2} eps", figures.worst(), figures.median());
}
