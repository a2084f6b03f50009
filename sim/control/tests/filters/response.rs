//! Frequency responses from impulse responses, against transfer functions of s in closed form; what is rejected.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use precess_control::{AnalogSection, ControlError, Discretisation, Section};

const PERIOD: f64 = 0.01;

/// Roundings of a sum of a thousand terms, and what is left of the impulse response after it.
const SUM: f64 = 1e-12;

/// Gain and phase at a frequency, rad/s: the sum of the impulse response by powers of z.
fn response(section: Section, omega: f64) -> (f64, f64) {
    let mut section = section;
    section.reset();
    let (mut real, mut imaginary) = (0.0, 0.0);
    for k in 0..20_000 {
        let output = section.filter(if k == 0 { 1.0 } else { 0.0 });
        let (sin, cos) = libm::sincos(omega * PERIOD * f64::from(k));
        real += output * cos;
        imaginary -= output * sin;
    }
    (libm::hypot(real, imaginary), libm::atan2(imaginary, real))
}

/// Gain and phase of `(b2 s² + b1 s + b0) / (a2 s² + a1 s + a0)` at `s = i omega`.
fn analog(b: [f64; 3], a: [f64; 3], omega: f64) -> (f64, f64) {
    let parts =
        |[second, first, constant]: [f64; 3]| (constant - second * omega * omega, first * omega);
    let (b, a) = (parts(b), parts(a));
    let gain = libm::hypot(b.0, b.1) / libm::hypot(a.0, a.1);
    (gain, libm::atan2(b.1, b.0) - libm::atan2(a.1, a.0))
}

fn assert_same(found: (f64, f64), wanted: (f64, f64)) {
    let turn = (found.1 - wanted.1) / (2.0 * PI);
    let phase = (turn - turn.round()) * 2.0 * PI;
    assert!((found.0 - wanted.0).abs() < SUM && phase.abs() < SUM, "{found:?} {wanted:?}");
}

/// The bilinear transform has at w what the analog filter has at `2 / T tan(w T / 2)`; prewarped, at its frequency.
#[test]
fn responses_are_those_of_the_analog_filter_at_the_warped_frequency() {
    let (b, a) = ([0.3, 2.0, 40.0], [0.8, 12.0, 90.0]);
    let filter = AnalogSection::new(b, a).unwrap();
    let plain = filter.discrete(PERIOD, Discretisation::Bilinear).unwrap();
    for omega in [0.0, 1.0, 20.0, 100.0, 250.0] {
        let warped = 2.0 / PERIOD * libm::tan(0.5 * omega * PERIOD);
        assert_same(response(plain, omega), analog(b, a, warped));
    }
    for omega in [1.0, 20.0, 100.0, 250.0] {
        let prewarped = filter.discrete(PERIOD, Discretisation::Prewarped(omega)).unwrap();
        assert_same(response(prewarped, omega), analog(b, a, omega));
    }
}

#[test]
fn gains_at_the_named_frequencies_are_those_of_the_page() {
    const OMEGA: f64 = 60.0;
    let prewarped = |of: AnalogSection| {
        response(of.discrete(PERIOD, Discretisation::Prewarped(OMEGA)).unwrap(), OMEGA)
    };
    let first = AnalogSection::low_pass_of_first_order(OMEGA).unwrap();
    assert_same(prewarped(first), (FRAC_1_SQRT_2, -PI / 4.0));
    assert_same(prewarped(AnalogSection::butterworth(OMEGA).unwrap()), (FRAC_1_SQRT_2, -PI / 2.0));
    assert_same(prewarped(AnalogSection::notch(OMEGA, 0.02, 0.5).unwrap()), (0.04, 0.0));
    let blocked = prewarped(AnalogSection::notch(OMEGA, 0.0, 0.5).unwrap());
    assert!(blocked.0 < SUM);
    // A lead has its largest phase at the mean of its frequencies: asin((p - z) / (p + z)).
    let lead = AnalogSection::lead_lag(OMEGA / 3.0, OMEGA * 3.0).unwrap();
    assert_same(prewarped(lead), (3.0, libm::asin(0.8)));
    for of in [first, lead, AnalogSection::butterworth(OMEGA).unwrap()] {
        let section = of.discrete(PERIOD, Discretisation::Bilinear).unwrap();
        assert!((section.gain() - 1.0).abs() < SUM);
    }
}

#[test]
fn what_is_no_stable_filter_is_rejected() {
    assert!(matches!(
        AnalogSection::new([0.0, 0.0, 1.0], [1.0, -0.1, 1.0]),
        Err(ControlError::Unstable { .. })
    ));
    assert!(matches!(
        AnalogSection::new([0.0, 0.0, 1.0], [0.0, 1.0, 0.0]),
        Err(ControlError::Unstable { .. })
    ));
    // An integrator, a pole outside.
    for a in [[-1.0, 0.0], [0.0, 1.0], [-2.1, 1.05], [1.2, 0.1]] {
        assert!(matches!(Section::new([1.0, 0.0, 0.0], a), Err(ControlError::Unstable { .. })));
    }
    let above = AnalogSection::butterworth(400.0)
        .unwrap()
        .discrete(PERIOD, Discretisation::Prewarped(400.0))
        .unwrap_err();
    assert!(
        above.to_string().starts_with("400 rad/s is not below half of the sampling rate, 314.")
    );
    assert!(AnalogSection::notch(10.0, 0.1, 0.0).is_err());
    assert!(AnalogSection::low_pass(f64::NAN, 0.7).is_err());
}
