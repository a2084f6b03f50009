//! The solver's accelerations against the Newton-Euler reference: backward error, error against
//! double-double, and difference with both in double-double.
//!
//! Run with `--nocapture` to see worst and median of each.

use precess_tests::blocks::{Figures, errors, worst};
use precess_tests::bounds::{
    ACCELERATIONS_MEDIAN, ACCELERATIONS_WORST, BACKWARD_EPSILONS, ROUTES_IN_DOUBLE_DOUBLE,
    SPACECRAFT,
};
use precess_tests::case::converted;
use precess_tests::cases;
use precess_tests::double_double::DoubleDouble as Wide;
use precess_tests::newton_euler::to_list;
use precess_tests::random::{Sample, Visitor, visit};

/// The unit of errors in accelerations.
const BLOCK: &str = "of the block";

/// Runs a measurement of one spacecraft over all of them; no single one may exceed `bound`.
struct Measurement<F> {
    name: &'static str,
    bound: f64,
    unit: &'static str,
    of: F,
    figures: Figures,
}

/// What is measured on one spacecraft, and what it was.
trait Measure {
    fn measure<const N: usize>(&self, sample: &Sample<N>) -> (f64, &'static str);
}

impl<F: Measure> Visitor for Measurement<F> {
    fn visit<const N: usize>(&mut self, sample: &Sample<N>) {
        let (error, what) = self.of.measure(sample);
        self.figures.add(error);
        assert!(
            error <= self.bound,
            "{}: {error:e} {} in {what} is above {:e} ({sample})",
            self.name,
            self.unit,
            self.bound
        );
    }
}

fn measure(name: &'static str, bound: f64, unit: &'static str, of: impl Measure) -> Figures {
    let mut measurement = Measurement { name, bound, unit, of, figures: Figures::default() };
    visit(cases(SPACECRAFT), &mut measurement);
    let figures = measurement.figures;
    println!(
        "{name}: worst {:.2e} {unit}, median {:.2e} {unit}",
        figures.worst(),
        figures.median()
    );
    figures
}

#[test]
fn backward_error_is_rounding() {
    struct BackwardError;
    impl Measure for BackwardError {
        fn measure<const N: usize>(&self, sample: &Sample<N>) -> (f64, &'static str) {
            let solution = sample.case::<f64>().solved(sample);
            let solution = to_list(&converted::<N, f64, Wide>(&solution));
            let error = sample.case::<Wide>().system().backward_error(&solution);
            (error / f64::EPSILON, "the worst row")
        }
    }
    measure("backward error", BACKWARD_EPSILONS, "eps", BackwardError);
}

#[test]
fn accelerations_agree_with_higher_precision() {
    struct ForwardError;
    impl Measure for ForwardError {
        fn measure<const N: usize>(&self, sample: &Sample<N>) -> (f64, &'static str) {
            let solution = sample.case::<f64>().solved(sample);
            worst(errors(&solution, &sample.case::<Wide>().reference()))
        }
    }
    let figures = measure("forward error", ACCELERATIONS_WORST, BLOCK, ForwardError);
    assert!(
        figures.median() <= ACCELERATIONS_MEDIAN,
        "forward error: median {:e}",
        figures.median()
    );
}

#[test]
fn solver_and_reference_agree_in_double_double() {
    struct Routes;
    impl Measure for Routes {
        fn measure<const N: usize>(&self, sample: &Sample<N>) -> (f64, &'static str) {
            let case = sample.case::<Wide>();
            worst(errors(&case.solved(sample), &case.reference()))
        }
    }
    measure("difference in double-double", ROUTES_IN_DOUBLE_DOUBLE, BLOCK, Routes);
}
