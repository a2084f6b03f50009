//! The covariance at last against Farrenkopf's closed form, and latency against a filter without.
//!
//! Farrenkopf, J. Guid. Control 1(4), 1978, in the form of Markley, Reynolds, J. Guid. Control Dyn. 23(6), 2000: with
//! `S_u = s_u T^(3/2) / s_n`, `S_v = s_v sqrt(T) / s_n`, `g² = 1 + S_v² / 4 + S_u² / 48` and
//! `z = g + S_u / 4 + sqrt(2 g S_u + S_v² + S_u² / 3) / 2`, before and after an update
//!
//! ```text
//! attitude  s_n² (z² - 1), s_n² (1 - 1 / z²)      cross before  -s_n s_u sqrt(T) z
//! bias      s_u² T ((z - 1 / z) / S_u +- 1 / 2)
//! ```

use nalgebra::{Matrix3, Vector3};
use precess_control::rotation::{from_vector, product};
use precess_control::{ControlError, Covariance, Estimate, Mekf, MekfParameters};
use precess_dynamics::{Attitude as _, Quaternion};

use crate::truth::{PERIOD, Run, isotropic};

/// What is left of the first covariance after the updates, and rounding of thousands of them.
const CLOSED_FORM: f64 = 1e-9;

fn filter(period: f64, angle: f64, rate: f64, star: f64, longest_latency: usize) -> Mekf {
    let parameters = MekfParameters {
        period,
        angle_random_walk: angle,
        rate_random_walk: rate,
        measured: isotropic(star),
        longest_latency,
    };
    let initial = Estimate {
        attitude: Quaternion::identity(),
        bias: Vector3::zeros(),
        covariance: Covariance::new(1e-3, 1e-4),
    };
    Mekf::new(&parameters, &initial).unwrap()
}

fn assert_isotropic(found: &Matrix3<f64>, wanted: f64) {
    let off = (found - Matrix3::from_diagonal_element(wanted)).amax() / wanted.abs();
    assert!(off < CLOSED_FORM, "{off:e}: {found} {wanted:e}");
}

/// The star tracker at the gyro's rate, and at a fifth of it: the period is that between updates.
#[test]
fn the_covariance_at_last_is_that_of_the_closed_form() {
    for (angle, rate, star, every) in
        [(3e-5, 2e-5, 1e-4, 1), (1e-5, 3e-5, 5e-5, 5), (2e-4, 1e-4, 2e-5, 5)]
    {
        let mut filter = filter(PERIOD, angle, rate, star, 0);
        let mut before = filter.estimate().covariance;
        for _ in 0..400 {
            for _ in 0..every {
                filter.propagate(&Vector3::zeros());
            }
            before = filter.estimate().covariance;
            filter.update(&Quaternion::identity(), 0).unwrap();
        }
        let after = filter.estimate().covariance;
        let between = PERIOD * f64::from(every);
        let (su, sv) = (rate * between.powf(1.5) / star, angle * between.sqrt() / star);
        let g = (1.0 + sv * sv / 4.0 + su * su / 48.0).sqrt();
        let z = g + su / 4.0 + 0.5 * (2.0 * g * su + sv * sv + su * su / 3.0).sqrt();
        assert_isotropic(&before.attitude, star * star * (z * z - 1.0));
        assert_isotropic(&after.attitude, star * star * (1.0 - 1.0 / (z * z)));
        assert_isotropic(&before.cross, -star * rate * between.sqrt() * z);
        let bias = rate * rate * between;
        assert_isotropic(&before.bias, bias * ((z - 1.0 / z) / su + 0.5));
        assert_isotropic(&after.bias, bias * ((z - 1.0 / z) / su - 0.5));
    }
}

/// A measured attitude that arrives later leads to the same bits as one that is there at once.
#[test]
fn latency_changes_no_bit_of_what_is_estimated_at_last() {
    let readings: Vec<Vector3<f64>> = (0..40)
        .map(|k| Vector3::new(0.01 * f64::from(k), 0.2, -0.1 * libm::sin(f64::from(k))))
        .collect();
    let measured = |k: usize| from_vector(&Vector3::new(0.0, 0.02 * readings[k].x, 1e-3));
    let mut at_once = filter(PERIOD, 3e-5, 2e-5, 1e-4, 0);
    let mut late = filter(PERIOD, 3e-5, 2e-5, 1e-4, 7);
    for (k, reading) in readings.iter().enumerate() {
        at_once.propagate(reading);
        late.propagate(reading);
        if k % 10 == 4 {
            at_once.update(&measured(k), 0).unwrap();
        }
        let age = [0, 3, 5][k / 10 % 3];
        if k % 10 == 4 + age {
            late.update(&measured(k - age), age).unwrap();
        }
    }
    assert_eq!(late.estimate(), at_once.estimate());
    assert_eq!(late.motion(), at_once.motion());
}

#[test]
fn a_measurement_that_is_too_old_is_rejected_and_changes_nothing() {
    let mut filter = filter(PERIOD, 3e-5, 2e-5, 1e-4, 3);
    for _ in 0..10 {
        filter.propagate(&Vector3::new(0.1, 0.0, 0.0));
    }
    let before = filter.clone();
    let turned = from_vector(&Vector3::new(0.1, 0.0, 0.0));
    assert_eq!(filter.update(&turned, 4), Err(ControlError::TooOld { age: 4, kept: 3 }));
    let none = Quaternion { q0: 0.0, q1: 0.0, q2: 0.0, q3: 0.0 };
    assert!(filter.update(&none, 0).is_err());
    assert_eq!(filter, before);
    // Another that was taken already bars older ones.
    filter.update(&turned, 1).unwrap();
    assert_eq!(filter.update(&turned, 2), Err(ControlError::TooOld { age: 2, kept: 1 }));
}

/// With a large error at first and a precise star tracker the first update takes the measured attitude.
#[test]
fn a_first_update_takes_over_a_large_error() {
    let mut filter = filter(PERIOD, 3e-5, 2e-5, 1e-6, 0);
    filter.propagate(&Vector3::zeros());
    let measured = from_vector(&Vector3::new(2.0, -1.0, 0.5));
    let square = filter.update(&measured, 0).unwrap();
    assert!(square > 1e6);
    let off = product(&precess_control::rotation::inverse(&filter.motion().attitude), &measured);
    assert!(precess_control::rotation::to_vector(&off).norm() < 1e-4);
}

/// The rate that is reported is the reading less the bias.
#[test]
fn the_estimated_bias_is_taken_from_the_rate() {
    let mut run = Run::new(3, 5, 0, 1.0);
    for _ in 0..300 {
        run.step();
    }
    let estimate = *run.filter.estimate();
    run.filter.propagate(&Vector3::new(0.1, 0.2, 0.3));
    assert_eq!(run.filter.motion().omega, Vector3::new(0.1, 0.2, 0.3) - estimate.bias);
}
