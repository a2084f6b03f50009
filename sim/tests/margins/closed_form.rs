//! A rigid spacecraft whose axes are double integrators with proportional and rate gain, behind hold and delay.

use nalgebra::{Complex, ComplexField as _};

use super::{BUS, K, P, controller, loop_of, read};

/// T, s.
const PERIOD: f64 = 0.25;
/// Inertia about each axis, the wheels' included, kg m².
const INERTIA: [f64; 3] = [12.04, 11.04, 10.04];
/// Closed forms of a few operations, and bisection to rounding.
const CLOSED_FORM: f64 = 1e-9;
/// A few operations beside an exponential and the solution of thirty equations.
const RESPONSE: f64 = 1e-11;

/// Gains by the inertia: 1/s² and 1/s.
fn gains(axis: usize) -> [f64; 2] {
    [K / 4.0 / INERTIA[axis], P / INERTIA[axis]]
}

/// `L` with a delay of m periods and r.
fn closed_form(z: Complex<f64>, [k, p]: [f64; 2], (m, r): (i32, f64)) -> Complex<f64> {
    let (t, rest, late) = (PERIOD, PERIOD - r, z.inv());
    let gamma = |new: f64, old: f64| (late * old + new) * late.powi(m);
    let angle = gamma(rest * rest / 2.0, (t * t - rest * rest) / 2.0);
    let rate = gamma(rest, r);
    let integrator = (z - 1.0).inv();
    (angle * integrator + rate * integrator * integrator * t) * k + rate * integrator * p
}

/// With `z = exp(j phi)`, `c` and `s` cosine and sine of `phi / 2`, and a delay of m periods:
/// `L = -(k T² c + 2 j p T s) exp(-j phi (m + 1/2)) / (4 s²)`. It has the magnitude one where
/// `16 s⁴ + (k² T⁴ - 4 p² T²) s² - k² T⁴ = 0`.
fn phase_margin([k, p]: [f64; 2], m: f64) -> [f64; 2] {
    let [k, p] = [k * PERIOD * PERIOD, 2.0 * p * PERIOD];
    let b = k * k - p * p;
    let square = (-b + (b * b + 64.0 * k * k).sqrt()) / 32.0;
    let half = square.sqrt().asin();
    let phase = (p * half.sin()).atan2(k * half.cos()) - half * (2.0 * m + 1.0);
    [phase, 2.0 * half / PERIOD]
}

#[test]
fn margins_of_each_axis_are_those_of_its_closed_form() {
    for periods in [0, 1] {
        let delay = f64::from(periods) * PERIOD;
        let scenario = read(&format!("{BUS}{}", controller(&format!("delay = \"{delay} s\""))));
        let found = loop_of(&scenario);
        let analysis = found.analysis().expect("an analysis");
        assert!(analysis.stable);
        let axes = analysis.axes.expect("stable");
        for (axis, margins) in axes.iter().enumerate() {
            let own = gains(axis);
            let [phase, omega] = phase_margin(own, f64::from(periods));
            let found = margins.phase.expect("a phase margin");
            println!("{periods} {axis}: {:e}", found.value - phase);
            assert!((found.value - phase).abs() < CLOSED_FORM, "{} {phase}", found.value);
            assert!((found.omega - omega).abs() < CLOSED_FORM, "{} {omega}", found.omega);
            if periods == 0 {
                // At z = -1 the loop is -p T / 2.
                let up = margins.gain_up.expect("a gain margin");
                let expected = 2.0 / (own[1] * PERIOD);
                assert!((up.value / expected - 1.0).abs() < CLOSED_FORM, "{}", up.value);
            }
        }
        // Six states of the hub are stable, three wheels keep what momentum there is.
        assert_eq!(analysis.neutral, 3);
        assert_eq!(analysis.periodic.map(|of| of.value), Some(0.0), "balanced rotors");
    }
}

#[test]
fn response_and_poles_are_those_of_the_closed_form() {
    for (m, r) in [(0, 0.0), (0, 0.06), (1, 0.0), (2, 0.1)] {
        let delay = f64::from(m) * PERIOD + r;
        let scenario = read(&format!("{BUS}{}", controller(&format!("delay = \"{delay} s\""))));
        let found = loop_of(&scenario);
        for omega in [0.02, 0.3, 2.0, 11.0] {
            let z = Complex::new(0.0, omega * PERIOD).exp();
            let response = found.closed.response(omega).expect("no pole");
            for axis in 0..3 {
                let expected = closed_form(z, gains(axis), (m, r));
                let own = response.axis(axis).expect("an axis");
                let apart = (own - expected).modulus() / expected.modulus();
                assert!(apart < RESPONSE, "{m} {r} {omega} {axis}: {apart:e}");
            }
        }
        // Two rates and angles of each axis; not what is over within a sample, and the momentum of three wheels.
        let poles = found.closed.poles().expect("poles");
        let listed = poles.iter().filter(|z| z.modulus() > 1e-3 && (*z - 1.0).modulus() > 1e-6);
        let mut count = 0;
        for pole in listed {
            let of = |axis| (closed_form(*pole, gains(axis), (m, r)) + 1.0).modulus();
            let least = (0..3).map(of).fold(f64::INFINITY, f64::min);
            assert!(least < 1e-8, "{m} {r} {pole}: {least:e}");
            count += 1;
        }
        assert!(count >= 6, "{count}");
    }
}

/// A servo that computes more often changes nothing of wheels without friction: their torques are the same each time.
#[test]
fn a_servo_at_its_own_rate_holds_the_same_torques_of_wheels() {
    let texts = ["delay = \"0.1 s\"", "delay = \"0.1 s\"\nservo = { rate = \"20 Hz\" }"];
    let [once, often] = texts.map(|keys| loop_of(&read(&format!("{BUS}{}", controller(keys)))));
    for omega in [0.05, 1.0, 9.0] {
        let [a, b] = [&once, &often].map(|of| of.closed.response(omega).expect("no pole").open);
        assert!((a - &b).norm() < RESPONSE * b.norm());
    }
}

/// Noise of the rate of an axis: the sum of squares of the recursion's impulse response.
#[test]
fn noise_is_the_sum_of_its_impulse_response() {
    let found = loop_of(&read(&format!("{BUS}{}", controller(""))));
    let noise = found.noise().expect("a stable loop");
    let [k, p] = gains(2);
    let (mut theta, mut omega, mut sum) = (0.0_f64, 0.0_f64, 0.0);
    for sample in 0..2000 {
        let read = if sample == 0 { omega + 1.0 } else { omega };
        let acceleration = -k * theta - p * read;
        sum += theta * theta;
        theta += omega * PERIOD + 0.5 * acceleration * PERIOD * PERIOD;
        omega += acceleration * PERIOD;
    }
    let apart = noise.rate[2][2] / sum.sqrt() - 1.0;
    assert!(apart.abs() < 1e-10, "{apart:e}");
    assert!(noise.rate[2][0].abs() < 1e-12 && noise.attitude[1][1] > 0.0);
}
