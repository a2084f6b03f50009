//! Quaternion feedback and rate damping: the derivatives of their Lyapunov functions, and the sign of the quaternion.

use nalgebra::{Matrix3, Vector3};
use precess_control::rotation::from_vector;
use precess_control::{
    Gyroscopic, Law as _, Motion, QuaternionFeedback, RateDamping, Reference, Sample, Tracking,
};
use precess_dynamics::{Attitude as _, Quaternion};

use crate::random::Random;
use crate::rigid_body::{definite, vector};

/// Roundings of a sum of thirty terms, in units of the sum of their magnitudes.
const ROUNDING: f64 = 4e-15;

fn sample(random: &mut Random) -> Sample {
    let motion = Motion { attitude: from_vector(&vector(random, 1.8)), omega: vector(random, 0.5) };
    let reference = Reference {
        attitude: from_vector(&vector(random, 1.8)),
        omega: vector(random, 0.3),
        omega_dot: vector(random, 0.2),
    };
    let mut sample = Sample::new(motion, reference);
    sample.momentum = vector(random, 40.0);
    sample.external = vector(random, 0.3);
    sample
}

/// Euler's equation of a rigid body with momentum devices: `omega_bn'`, and the sum of magnitudes of its torques.
fn angular_acceleration(
    inertia: &Matrix3<f64>,
    sample: &Sample,
    torque: &Vector3<f64>,
) -> (Vector3<f64>, f64) {
    let omega = sample.motion.omega;
    let gyroscopic = omega.cross(&(inertia * omega + sample.momentum));
    let exerted = torque + sample.external - gyroscopic;
    let size = torque.norm() + sample.external.norm() + gyroscopic.norm();
    (inertia.try_inverse().unwrap() * exerted, size)
}

/// `V' = -d omega . omega` in units of k, with `K = k I` and `D = d I`.
#[test]
fn the_function_of_the_eigen_axis_law_falls_by_the_rate_gain_only() {
    const K: f64 = 0.3;
    const D: f64 = 0.7;
    let mut random = Random::new(21);
    for _ in 0..500 {
        let (sample, inertia) = (sample(&mut random), definite(&mut random, 300.0));
        let mut law = QuaternionFeedback::eigen_axis(K, D, inertia).unwrap();
        let (omega_dot, size) = angular_acceleration(&inertia, &sample, &law.torque(&sample));
        let error = Tracking::new(&sample.motion, &sample.reference);
        // K^-1 I is 1 / k.
        let kinetic = error.omega_br.dot(&error.omega_br_dot(&omega_dot)) / K;
        let potential = -2.0 * error.attitude.rate(&error.omega_br).x;
        let dissipated = D / K * error.omega_br.norm_squared();
        let unit = error.omega_br.norm() / K
            * (size * inertia.try_inverse().unwrap().norm() + error.feed_forward().norm())
            + dissipated;
        assert!((kinetic + potential + dissipated).abs() < ROUNDING * unit);
    }
}

#[test]
fn kinetic_energy_falls_by_rate_damping_only() {
    let mut random = Random::new(22);
    for _ in 0..500 {
        let (mut sample, inertia) = (sample(&mut random), definite(&mut random, 300.0));
        sample.external = Vector3::zeros();
        let gain = definite(&mut random, 20.0);
        let mut law = RateDamping::new(gain).unwrap();
        let (omega_dot, size) = angular_acceleration(&inertia, &sample, &law.torque(&sample));
        let omega = sample.motion.omega;
        let power = omega.dot(&(inertia * omega_dot));
        let condition = inertia.norm() * inertia.try_inverse().unwrap().norm();
        let rest = power + omega.dot(&(gain * omega));
        assert!(rest.abs() < ROUNDING * condition * size * omega.norm(), "{rest:e}");
    }
}

/// Beyond half a turn the law turns on: the torque has the sign of the shorter way.
#[test]
fn the_torque_turns_by_the_shorter_way_for_either_quaternion() {
    let inertia = Matrix3::from_diagonal(&Vector3::new(100.0, 200.0, 300.0));
    let mut law = QuaternionFeedback::eigen_axis(0.02, 0.2, inertia).unwrap();
    let reference = Reference::at_rest(Quaternion::identity());
    for (angle, sign) in [(1.0, -1.0), (3.1, -1.0), (3.2, 1.0), (6.0, 1.0), (-1.0, 1.0)] {
        let turn = from_vector(&Vector3::new(0.0, 0.0, angle));
        let minus = Quaternion { q0: -turn.q0, q1: -turn.q1, q2: -turn.q2, q3: -turn.q3 };
        for attitude in [turn, minus] {
            let motion = Motion { attitude, omega: Vector3::zeros() };
            let torque = law.torque(&Sample::new(motion, reference));
            assert_eq!(torque.z.signum(), sign, "{angle}");
        }
    }
}

/// Without feed-forward (an inertia of zero) the torque is `-K q - D omega` of any matrices.
#[test]
fn gains_are_matrices_about_b_axes() {
    let mut random = Random::new(23);
    let sample = Sample { external: Vector3::zeros(), ..sample(&mut random) };
    let gain = |random: &mut Random| Matrix3::from_fn(|_, _| random.signed());
    let (k, d) = (gain(&mut random), gain(&mut random));
    let mut law = QuaternionFeedback::new(k, d, Matrix3::zeros(), Gyroscopic::Nothing).unwrap();
    let error = Tracking::new(&sample.motion, &sample.reference);
    let q = Vector3::new(error.attitude.q1, error.attitude.q2, error.attitude.q3);
    assert!((law.torque(&sample) + k * q + d * error.omega_br).amax() < ROUNDING);
}
