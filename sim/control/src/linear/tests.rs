//! Sampled loops against their closed forms.

use core::f64::consts::{FRAC_PI_2, PI};
use std::string::ToString as _;
use std::vec;

use nalgebra::{Complex, ComplexField as _, DMatrix};

use crate::{Feedback, Plant, SampledLoop, SampledPlant, Sampling, Section, delay_margin};

/// Closed forms of a few operations, and bisection to rounding: the bound of every margin.
const CLOSED_FORM: f64 = 1e-9;
/// A few operations beside an exponential and a solution of two equations.
const RESPONSE: f64 = 1e-12;

/// A rate of `inertia omega' = u`, fed back with `a inertia / T`: `L = a / (z - 1)`.
fn rate_loop(a: f64, period: f64) -> (Plant, Feedback) {
    const INERTIA: f64 = 7.0;
    let one = |value: f64| DMatrix::from_element(1, 1, value);
    let plant = Plant { a: one(0.0), b: one(1.0 / INERTIA), c: one(1.0) };
    (plant, Feedback::gain(one(-a * INERTIA / period)))
}

/// Axes of unit inertia, attitude and rate measured.
fn turning(inertia: &DMatrix<f64>) -> Plant {
    let n = inertia.nrows();
    let mut a = DMatrix::zeros(2 * n, 2 * n);
    a.view_mut((0, n), (n, n)).fill_with_identity();
    let mut b = DMatrix::zeros(2 * n, n);
    b.view_mut((n, 0), (n, n)).copy_from(&inertia.clone().try_inverse().expect("inertia"));
    Plant { a, b, c: DMatrix::identity(2 * n, 2 * n) }
}

/// `L` of an axis of unit inertia behind hold and a delay of `m` periods and `r`, with `k` and `p`.
fn closed_form(z: Complex<f64>, (k, p): (f64, f64), t: f64, (m, r): (i32, f64)) -> Complex<f64> {
    let rest = t - r;
    let late = z.inv();
    let gamma = |new: f64, old: f64| (late * old + new) * late.powi(m);
    let angle = gamma(rest * rest / 2.0, (t * t - rest * rest) / 2.0);
    let rate = gamma(rest, r);
    let integrator = (z - 1.0).inv();
    (angle * integrator + rate * integrator * integrator * t) * k + rate * integrator * p
}

#[test]
fn margins_of_a_rate_loop() {
    const PERIOD: f64 = 0.25;
    for a in [0.2, 1.0, 1.25, 1.7] {
        let (plant, feedback) = rate_loop(a, PERIOD);
        let sampling = Sampling { period: PERIOD, delay: 0.0 };
        let sampled = SampledPlant::new(&plant, sampling).expect("plant");
        let closed = SampledLoop::new(sampled, feedback.clone()).expect("loop");
        assert!(closed.is_stable().expect("poles"));
        let margins = closed.margins().expect("poles").expect("stable")[0];
        let up = margins.gain_up.expect("a gain");
        assert!((up.value - 2.0 / a).abs() < CLOSED_FORM && (up.omega * PERIOD - PI).abs() < 1e-12);
        assert_eq!(margins.gain_down, None);
        let phase = margins.phase.expect("a phase");
        assert!((phase.value - (FRAC_PI_2 - (a / 2.0).asin())).abs() < CLOSED_FORM);
        assert!((phase.omega * PERIOD - 2.0 * (a / 2.0).asin()).abs() < CLOSED_FORM);
        // |z - 1| / |z - 1 + a| rises to 2 / (2 - a) at z = -1.
        assert!((margins.sensitivity.value - 2.0 / (2.0 - a)).abs() < CLOSED_FORM);
        assert!(
            (closed.peak().expect("poles").expect("stable").value - 2.0 / (2.0 - a)).abs()
                < CLOSED_FORM
        );
        // With a delay of rho periods z² + (a (1 - rho) - 1) z + a rho: on the unit circle where a rho = 1.
        if a >= 1.0 {
            let found = delay_margin(&plant, sampling, &feedback).expect("poles").expect("a delay");
            assert!((found - PERIOD / a).abs() < CLOSED_FORM * PERIOD, "{a}: {found}");
        }
    }
    let (plant, feedback) = rate_loop(2.1, PERIOD);
    let sampling = Sampling { period: PERIOD, delay: 0.0 };
    assert_eq!(delay_margin(&plant, sampling, &feedback), Ok(Some(0.0)));
    let sampled = SampledPlant::new(&plant, sampling).expect("plant");
    let closed = SampledLoop::new(sampled, feedback).expect("loop");
    assert_eq!((closed.margins(), closed.peak()), (Ok(None), Ok(None)));
}

/// `x' = x + u` with `u = -K x` is stable from K = 1 up to `coth(T / 2)`: both ends of its frequencies are real.
#[test]
fn an_unstable_plant_needs_a_least_gain() {
    const PERIOD: f64 = 0.5;
    const GAIN: f64 = 2.0;
    let one = |value: f64| DMatrix::from_element(1, 1, value);
    let plant = Plant { a: one(1.0), b: one(1.0), c: one(1.0) };
    let sampled = SampledPlant::new(&plant, Sampling { period: PERIOD, delay: 0.0 });
    let closed = SampledLoop::new(sampled.expect("plant"), Feedback::gain(one(-GAIN)));
    let margins = closed.expect("loop").margins().expect("poles").expect("stable")[0];
    let (down, up) = (margins.gain_down.expect("a least"), margins.gain_up.expect("a largest"));
    assert!((down.value - 1.0 / GAIN).abs() < CLOSED_FORM && down.omega == 0.0);
    assert!((up.value - (PERIOD / 2.0).tanh().recip() / GAIN).abs() < CLOSED_FORM);
}

#[test]
fn response_and_poles_of_pd_with_hold_and_delay() {
    const PERIOD: f64 = 0.1;
    let one = |value: f64| DMatrix::from_element(1, 1, value);
    for (m, r) in [(0, 0.0), (0, 0.03), (1, 0.0), (2, 0.07)] {
        let delay = f64::from(m) * PERIOD + r;
        let plant = SampledPlant::new(&turning(&one(1.0)), Sampling { period: PERIOD, delay });
        let (k, p) = (0.8, 1.4);
        let feedback = Feedback::pid([&one(k), &one(p), &one(0.0)], PERIOD);
        let closed = SampledLoop::new(plant.expect("plant"), feedback).expect("loop");
        for omega in [0.01, 0.3, 2.0, 17.0, 31.0] {
            let z = Complex::new(0.0, omega * PERIOD).exp();
            let expected = closed_form(z, (k, p), PERIOD, (m, r));
            let found = closed.response(omega).expect("no pole");
            assert!((found.open[(0, 0)] - expected).modulus() < RESPONSE * expected.modulus());
            assert!(
                (found.axis(0).expect("an axis") - expected).modulus()
                    < RESPONSE * expected.modulus()
            );
        }
        for pole in closed.poles().expect("poles").into_iter().filter(|pole| pole.modulus() > 1e-3)
        {
            assert!((closed_form(pole, (k, p), PERIOD, (m, r)) + 1.0).modulus() < CLOSED_FORM);
        }
    }
}

/// Gains that are multiples of the inertia make each axis a loop of unit inertia, whatever its products are.
#[test]
fn coupled_axes_with_gains_in_proportion_are_alike() {
    const PERIOD: f64 = 0.1;
    let inertia = DMatrix::from_row_slice(3, 3, &[9.0, -1.0, 2.0, -1.0, 7.0, 0.5, 2.0, 0.5, 8.0]);
    let sampling = Sampling { period: PERIOD, delay: 0.04 };
    let of = |inertia: &DMatrix<f64>| {
        let plant = SampledPlant::new(&turning(inertia), sampling).expect("plant");
        let gains = [0.8, 1.4, 0.1].map(|gain| inertia * gain);
        let feedback = Feedback::pid([&gains[0], &gains[1], &gains[2]], PERIOD);
        SampledLoop::new(plant, feedback).expect("loop")
    };
    let (coupled, single) = (of(&inertia), of(&DMatrix::identity(1, 1)));
    let expected = single.margins().expect("poles").expect("stable")[0];
    for axis in coupled.margins().expect("poles").expect("stable") {
        for (found, expected) in [
            (axis.gain_up, expected.gain_up),
            (axis.gain_down, expected.gain_down),
            (axis.phase, expected.phase),
            (Some(axis.sensitivity), Some(expected.sensitivity)),
        ] {
            let (found, expected) = (found.expect("found"), expected.expect("expected"));
            assert!((found.value / expected.value - 1.0).abs() < CLOSED_FORM);
        }
    }
    // The peak over all commands together is larger where the gains mix the axes, and no smaller.
    let (all, alone) = (
        coupled.peak().expect("poles").expect("stable"),
        single.peak().expect("poles").expect("stable"),
    );
    assert!(all.value >= alone.value * (1.0 - CLOSED_FORM));
}

/// Three coupled axes with an oscillation and a delay: the response in Hessenberg form against a solution with the matrix itself.
#[test]
fn a_curve_has_the_responses_of_single_frequencies() {
    const PERIOD: f64 = 0.1;
    /// Rounding by `1 / (w T)²`, twice integrated, is 1e-12 at the lowest of these.
    const REDUCED: f64 = 1e-9;
    let inertia = DMatrix::from_row_slice(3, 3, &[9.0, -1.0, 2.0, -1.0, 7.0, 0.5, 2.0, 0.5, 8.0]);
    let mut plant = turning(&inertia);
    // A spring on the first axis of 1e4 times the other numbers; without damping its pole on the unit circle is a frequency at
    // which neither response is exact.
    (plant.a[(3, 0)], plant.a[(3, 3)]) = (-1e4, -4.0);
    let plant = SampledPlant::new(&plant, Sampling { period: PERIOD, delay: 0.24 });
    let gains = [0.8, 1.4, 0.1].map(|gain| &inertia * gain);
    let feedback = Feedback::pid([&gains[0], &gains[1], &gains[2]], PERIOD);
    let closed = SampledLoop::new(plant.expect("plant"), feedback).expect("loop");
    let curve = closed.curve().expect("poles");
    let above = |at: &&crate::LoopResponse| at.omega * PERIOD > 0.01;
    let mut count = 0;
    for found in curve.responses().iter().filter(above) {
        let expected = closed.response(found.omega).expect("no pole").open;
        let apart = (&found.open - &expected).norm() / expected.norm();
        assert!(apart < REDUCED, "{}: {apart:e}", found.omega);
        count += 1;
    }
    assert!(count > 200, "{count}");
}

/// A delay within the matrices, and a delay beside them.
#[test]
fn a_plant_of_its_matrices_is_the_same_loop() {
    const PERIOD: f64 = 0.1;
    let one = |value: f64| DMatrix::from_element(1, 1, value);
    for delay in [0.0, 0.07, 0.23] {
        let sampling = Sampling { period: PERIOD, delay };
        let plant = SampledPlant::new(&turning(&one(1.0)), sampling).expect("plant");
        let within = SampledPlant::from_matrices(sampling, plant.with_waiting()).expect("plant");
        let feedback = Feedback::pid([&one(0.8), &one(1.4), &one(0.0)], PERIOD);
        let [a, b] =
            [plant, within].map(|plant| SampledLoop::new(plant, feedback.clone()).expect("a loop"));
        for omega in [0.05, 1.0, 20.0] {
            let [a, b] = [&a, &b].map(|of| of.response(omega).expect("no pole").open[(0, 0)]);
            assert!((a - b).modulus() < RESPONSE * a.modulus());
        }
        let [a, b] =
            [a, b].map(|of| of.margins().expect("poles").expect("stable")[0].phase.expect("one"));
        assert!((a.value - b.value).abs() < CLOSED_FORM);
    }
    let sampling = Sampling { period: PERIOD, delay: 0.0 };
    let wrong = [one(1.0), DMatrix::zeros(2, 1), one(1.0)];
    let text = SampledPlant::from_matrices(sampling, wrong).expect_err("a shape").to_string();
    assert_eq!(text, "rows of Gamma: 2; there must be 1");
}

/// Twelve commands that wait for ten periods: 120 eigenvalues at zero in ten long chains, beside those of three axes.
#[test]
fn many_commands_that_wait_have_eigenvalues() {
    const PERIOD: f64 = 0.1;
    let unit = DMatrix::<f64>::identity(3, 3);
    let plant = turning(&unit);
    // Four alike for each axis, each with a quarter.
    let spread = DMatrix::from_fn(3, 12, |row, column| if column % 3 == row { 0.25 } else { 0.0 });
    let plant = Plant { b: &plant.b * &spread, ..plant };
    let sampling = Sampling { period: PERIOD, delay: 1.0 };
    let sampled = SampledPlant::new(&plant, sampling).expect("plant");
    let gains = [0.1, 0.4, 0.0].map(|gain| &unit * gain);
    let law = Feedback::pid([&gains[0], &gains[1], &gains[2]], PERIOD);
    let each = Feedback::gain(spread.map(|part| if part > 0.0 { 1.0 } else { 0.0 }).transpose());
    let closed = SampledLoop::new(sampled, law.then(&each).expect("shapes")).expect("a loop");
    let poles = closed.poles().expect("they converge");
    assert_eq!(poles.len(), 6 + 11 * 12);
    let one = |value: f64| DMatrix::from_element(1, 1, value);
    let single = SampledPlant::new(&turning(&one(1.0)), sampling).expect("plant");
    let single = SampledLoop::new(single, Feedback::pid([&one(0.1), &one(0.4), &one(0.0)], PERIOD));
    let slowest = single.expect("a loop").poles().expect("they converge")[0];
    // Three times the same, which rounding takes apart.
    assert!((poles[0].modulus() - slowest.modulus()).abs() < 1e-6);
}

#[test]
fn feedback_in_series_multiplies() {
    let section = |a: f64, b: f64, c: f64, d: f64| {
        let one = |value: f64| DMatrix::from_element(1, 1, value);
        Feedback { a: one(a), b: one(b), c: one(c), d: one(d) }
    };
    let (first, second) = (section(0.5, 0.3, -0.7, 2.0), section(-0.2, 0.9, 0.4, 0.6));
    let both = first.then(&second).expect("shapes");
    let z = Complex::new(0.3, 0.8);
    let at = |of: &Feedback| of.transfer(z).expect("no pole")[(0, 0)];
    assert!((at(&both) - at(&first) * at(&second)).modulus() < RESPONSE);
}

#[test]
fn a_section_has_its_transfer_function_on_each_signal() {
    let (b, a) = ([0.4, -0.3, 0.2], [-1.1, 0.6]);
    let feedback = Feedback::section(&Section::new(b, a).expect("a section"), 2);
    let z = Complex::new(0.6, 0.7);
    let late = z.inv();
    let polynomial = |[c0, c1, c2]: [f64; 3]| late * late * c2 + late * c1 + c0;
    let expected = polynomial(b) / polynomial([1.0, a[0], a[1]]);
    let found = feedback.transfer(z).expect("no pole");
    for (row, column) in [(0, 0), (1, 1), (0, 1)] {
        let expected = if row == column { expected } else { Complex::new(0.0, 0.0) };
        assert!((found[(row, column)] - expected).modulus() < RESPONSE);
    }
}

#[test]
fn shapes_and_ranges_are_checked() {
    let (plant, feedback) = rate_loop(1.0, 0.1);
    let of = |period, delay| SampledPlant::new(&plant, Sampling { period, delay });
    let texts = vec![
        of(0.0, 0.0).expect_err("a period").to_string(),
        of(0.1, 3.3).expect_err("a delay").to_string(),
        SampledLoop::new(of(0.1, 0.0).expect("plant"), Feedback::gain(DMatrix::zeros(2, 1)))
            .expect_err("a shape")
            .to_string(),
    ];
    assert_eq!(
        texts,
        [
            "period is 0; it must be finite and positive",
            "delay is 3.3; it must be from 0 to 3.2",
            "rows of its C: 2; there must be 1",
        ]
    );
    assert_eq!(
        delay_margin(&plant, Sampling { period: 0.1, delay: 0.0 }, &feedback)
            .map(|found| found.is_some()),
        Ok(true)
    );
}
