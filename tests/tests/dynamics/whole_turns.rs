//! Whole turns of a joint change nothing: `State::wrapped` against the state as it is, in every
//! public function that takes one.
//!
//! Run with `--nocapture` to see the figures.

use std::f64::consts::PI;

use nalgebra::Vector3;
use precess_dynamics::dgvscmg::Joints;
use precess_dynamics::{About, Scalar, SolveError, State};
use precess_tests::blocks::{Figures, errors, largest, worst};
use precess_tests::bounds::{LIMITS, ROUTES_IN_DOUBLE_DOUBLE};
use precess_tests::case::{Case, Set};
use precess_tests::cases;
use precess_tests::double_double::DoubleDouble as Wide;
use precess_tests::random::{Sample, Visitor, visit};

/// Spacecraft tried in each precision.
const SPACECRAFT: u64 = 180;

/// Length of the step, s: 0.06 rad of the fastest wheel.
const STEP: f64 = 1e-4;

/// What wrapping changes in one quantity, in units of the quantity's size.
type Error = (&'static str, f64);

fn distance<T: Scalar>(a: &Vector3<T>, b: &Vector3<T>) -> f64 {
    largest(a.iter().zip(b.iter()).map(|(a, b)| (*a - *b).abs().to_f64()))
}

/// Difference of two vectors in units of the second's largest component; zero if they are equal.
fn relative<T: Scalar>(a: &Vector3<T>, b: &Vector3<T>) -> f64 {
    let unit = largest(b.iter().map(|b| b.abs().to_f64()));
    if a == b { 0.0 } else { distance(a, b) / unit }
}

/// Difference of one of the joints' quantities over all devices, in units of the largest.
fn of_joints<const N: usize, T: Scalar>(
    a: &State<Set<N, T>>,
    b: &State<Set<N, T>>,
    of: impl Fn(&Joints<T>) -> T,
) -> f64 {
    let difference =
        largest(a.devices.iter().zip(&b.devices).map(|(a, b)| (of(a) - of(b)).abs().to_f64()));
    let unit = largest(b.devices.iter().map(|b| of(b).abs().to_f64()));
    if difference == 0.0 { 0.0 } else { difference / unit }
}

/// Difference of the sines and cosines of all joint angles.
fn of_angles<const N: usize, T: Scalar>(a: &State<Set<N, T>>, b: &State<Set<N, T>>) -> f64 {
    let angles = |state: &State<Set<N, T>>| -> Vec<T> {
        state.devices.iter().flat_map(|j| [j.gamma_o, j.gamma_i, j.theta]).collect()
    };
    largest(angles(a).into_iter().zip(angles(b)).map(|(a, b)| {
        let ((sin_a, cos_a), (sin_b, cos_b)) = (a.sin_cos(), b.sin_cos());
        largest([(sin_a - sin_b).abs().to_f64(), (cos_a - cos_b).abs().to_f64()])
    }))
}

/// Everything that wrapping could change, evaluated with and without.
fn changes<const N: usize, T: Scalar>(sample: &Sample<N>) -> Vec<Error> {
    let mut unwrapped: Case<N, T> = sample.case();
    let turns = T::from_f64(100.0);
    for joints in &mut unwrapped.state.devices {
        joints.gamma_o = joints.gamma_o + turns;
        joints.gamma_i = joints.gamma_i - turns;
    }
    let spacecraft = unwrapped.spacecraft(sample);
    let wrapped = Case { state: unwrapped.state.wrapped(&spacecraft), ..unwrapped };
    for joints in &wrapped.state.devices {
        for angle in [joints.gamma_o, joints.gamma_i, joints.theta] {
            assert!(angle.to_f64().abs() <= PI, "{angle:?} ({sample})");
        }
    }

    let rejected = |error: SolveError<T>| -> ! { panic!("{sample}: {error}") };
    let dt = T::from_f64(STEP);
    let [expected, found] = [&unwrapped, &wrapped].map(|case| {
        let energy = spacecraft.energy(&case.state).unwrap_or_else(|e| rejected(e));
        let momentum = spacecraft.momentum(&case.state, About::CentreOfMass);
        let momentum = momentum.unwrap_or_else(|e| rejected(e));
        let centre = spacecraft.centre_of_mass(&case.state).unwrap_or_else(|e| rejected(e));
        let next = spacecraft.step(&case.state, &case.inputs, dt).unwrap_or_else(|e| rejected(e));
        (energy.to_f64(), energy, momentum, centre, next)
    });
    let (size, energy, momentum, centre, next) = expected;
    let (_, found_energy, found_momentum, found_centre, found_next) = found;

    // Momenta may cancel between bodies: their unit is the sum over bodies.
    let magnitudes = unwrapped.snapshot().momenta();
    let (p, h) = (magnitudes.linear_magnitudes.to_f64(), magnitudes.angular_magnitudes.to_f64());
    vec![
        ("accelerations", worst(errors(&wrapped.solved(sample), &unwrapped.solved(sample))).0),
        ("energy", (found_energy - energy).abs().to_f64() / size),
        ("linear momentum", distance(&found_momentum.linear, &momentum.linear) / p),
        ("angular momentum", distance(&found_momentum.angular, &momentum.angular) / h),
        ("centre of mass", relative(&found_centre.c, &centre.c)),
        ("its rate", relative(&found_centre.c_prime, &centre.c_prime)),
        ("position after a step", relative(&found_next.r_b_n, &next.r_b_n)),
        ("velocity after a step", relative(&found_next.r_b_n_dot, &next.r_b_n_dot)),
        ("omega after a step", relative(&found_next.omega, &next.omega)),
        ("gamma_o_dot after a step", of_joints(&found_next, &next, |j| j.gamma_o_dot)),
        ("gamma_i_dot after a step", of_joints(&found_next, &next, |j| j.gamma_i_dot)),
        ("spin after a step", of_joints(&found_next, &next, |j| j.spin)),
        ("angles after a step", of_angles(&found_next, &next)),
    ]
}

/// The largest change, asserted on every spacecraft.
struct Claim<F> {
    bound: f64,
    changes: F,
    figures: Vec<(&'static str, Figures)>,
}

trait Changes {
    fn errors<const N: usize>(&self, sample: &Sample<N>) -> Vec<Error>;
}

impl<F: Changes> Visitor for Claim<F> {
    fn visit<const N: usize>(&mut self, sample: &Sample<N>) {
        let bound = self.bound;
        for (index, (what, error)) in self.changes.errors(sample).into_iter().enumerate() {
            if index == self.figures.len() {
                self.figures.push((what, Figures::default()));
            }
            self.figures[index].1.add(error);
            assert!(error <= bound, "{what}: {error:e} is above {bound:e} ({sample})");
        }
    }
}

fn check(row: &str, bound: f64, changes: impl Changes) {
    let mut claim = Claim { bound, changes, figures: Vec::new() };
    visit(cases(SPACECRAFT), &mut claim);
    for (what, figures) in claim.figures {
        let (worst, median) = (figures.worst(), figures.median());
        println!("{row}, whole turns, {what}: worst {worst:.2e}, median {median:.2e}");
    }
}

#[test]
fn whole_turns_of_any_joint_change_nothing() {
    struct InDouble;
    impl Changes for InDouble {
        fn errors<const N: usize>(&self, sample: &Sample<N>) -> Vec<Error> {
            changes::<N, f64>(sample)
        }
    }
    check("f64", LIMITS, InDouble);
}

#[test]
fn whole_turns_of_any_joint_change_nothing_in_double_double() {
    struct InDoubleDouble;
    impl Changes for InDoubleDouble {
        fn errors<const N: usize>(&self, sample: &Sample<N>) -> Vec<Error> {
            changes::<N, Wide>(sample)
        }
    }
    // Only because the wrapped angle is corrected by a Newton step in the scalar's own precision.
    check("double-double", ROUTES_IN_DOUBLE_DOUBLE, InDoubleDouble);
}
