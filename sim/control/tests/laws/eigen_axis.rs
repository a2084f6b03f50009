//! The eigen-axis law: a body with full inertia tensor turns about the axis of its error, by the pendulum's equation.

use nalgebra::{Matrix3, Vector3};
use precess_control::rotation::from_vector;
use precess_control::{Law as _, Motion, QuaternionFeedback, Reference, Sample, Tracking};
use precess_dynamics::{Attitude as _, Quaternion};

use crate::rigid_body::Body;

/// The law is held for a step: by a period of 10 ms the axis drifts and the angle differs by the period times
/// coefficients of the motion.
const BY_HOLD: f64 = 1e-3;

#[test]
fn a_body_turns_about_the_axis_of_its_error() {
    const K: f64 = 0.08;
    const D: f64 = 0.35;
    let inertia = Matrix3::new(300.0, 20.0, -10.0, 20.0, 200.0, 15.0, -10.0, 15.0, 120.0);
    let axis = Vector3::new(0.6, -0.48, 0.64);
    let start = Motion { attitude: from_vector(&(axis * 2.5)), omega: Vector3::zeros() };
    let mut law = QuaternionFeedback::eigen_axis(K, D, inertia).unwrap();
    let reference = Reference::at_rest(Quaternion::identity());
    let run = |law: &mut QuaternionFeedback, samples: u32| {
        let period = 10.0 / f64::from(samples);
        let mut body = Body::new(inertia, &start);
        let (mut phi, mut rate) = (2.5, 0.0);
        let (mut off_axis, mut off_angle) = (0.0_f64, 0.0_f64);
        for _ in 0..samples {
            let sample = Sample::new(body.motion(), reference);
            body.run(&law.torque(&sample), period, 1);
            // The pendulum, with the same hold.
            let acceleration = -D * rate - K * f64::sin(phi / 2.0);
            phi += rate * period + acceleration * period * period / 2.0;
            rate += acceleration * period;
            let error = Tracking::new(&body.motion(), &reference).attitude;
            let part = Vector3::new(error.q1, error.q2, error.q3);
            off_axis = off_axis.max(part.cross(&axis).norm());
            off_angle = off_angle.max((part.dot(&axis) - f64::sin(phi / 2.0)).abs());
        }
        (off_axis, off_angle)
    };
    let (coarse, fine) = (run(&mut law, 500), run(&mut law, 1000));
    assert!(fine.0 < BY_HOLD && fine.1 < BY_HOLD, "{fine:?}");
    // What is left is of the hold: it halves with the period.
    let ratio = coarse.0 / fine.0;
    assert!((1.9..2.1).contains(&ratio), "{coarse:?} {fine:?}");
}
