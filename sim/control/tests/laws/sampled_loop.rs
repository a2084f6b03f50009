//! A loop with hold and delay on a rigid body about one axis against its exact discrete solution.

use nalgebra::{Matrix3, SMatrix, Vector3};
use precess_control::rotation::from_vector;
use precess_control::{
    Gyroscopic, Law, Motion, MrpFeedback, MrpGains, QuaternionFeedback, Reference, Sample, Tracking,
};
use precess_dynamics::{Attitude as _, Quaternion};

use crate::rigid_body::Body;

const INERTIA: f64 = 250.0;
const PERIOD: f64 = 0.1;
const DELAY: f64 = 0.035;
/// 20 s.
const SAMPLES: usize = 200;

/// A function of an angle.
type OfAngle = fn(f64) -> f64;

/// Of the largest angle. A hundred roundings a sample would be 5e-12.
const EXACT: f64 = 1e-10;

/// Angles about z at the samples, of a body at rest at `angle` at first.
fn run(law: &mut dyn Law, angle: f64) -> Vec<f64> {
    let inertia = Matrix3::from_diagonal(&Vector3::new(100.0, 180.0, INERTIA));
    let start =
        Motion { attitude: from_vector(&Vector3::new(0.0, 0.0, angle)), omega: Vector3::zeros() };
    let mut body = Body::new(inertia, &start);
    let reference = Reference::at_rest(Quaternion::identity());
    let mut held = Vector3::zeros();
    let mut angles = Vec::new();
    for _ in 0..SAMPLES {
        let motion = body.motion();
        let turn = Tracking::new(&motion, &reference).attitude;
        angles.push(2.0 * libm::atan2(turn.q3, turn.q0));
        let command = law.torque(&Sample::new(motion, reference));
        // A turn by half a degree a step: the rest of RK4 is below rounding.
        body.run(&held, DELAY, 4);
        held = command;
        body.run(&held, PERIOD - DELAY, 8);
    }
    angles
}

/// State after a time: angle, rate, held torque. By the exponential of the system's matrix, whose series ends: the third
/// power is zero.
fn transition(time: f64) -> SMatrix<f64, 3, 3> {
    let rate = SMatrix::<f64, 3, 3>::new(0.0, 1.0, 0.0, 0.0, 0.0, 1.0 / INERTIA, 0.0, 0.0, 0.0);
    let power = rate * time;
    SMatrix::<f64, 3, 3>::identity() + power + power * power / 2.0
}

/// The linear loop: `u = -stiffness angle - damping rate`, applied after the delay.
#[test]
fn small_angles_are_those_of_the_matrix_exponential() {
    /// Small enough that the sine of half of it is itself to 1e-12.
    const ANGLE: f64 = 1e-6;
    let (stiffness, damping) = (40.0, 90.0);
    let mut mrp = MrpFeedback::new(
        MrpGains::new(4.0 * stiffness, damping),
        Matrix3::zeros(),
        Gyroscopic::Nothing,
    )
    .unwrap();
    let gain = Matrix3::from_diagonal_element;
    let mut quaternion = QuaternionFeedback::new(
        gain(2.0 * stiffness),
        gain(damping),
        Matrix3::zeros(),
        Gyroscopic::Nothing,
    )
    .unwrap();
    let laws: [&mut dyn Law; 2] = [&mut mrp, &mut quaternion];
    let update = SMatrix::<f64, 3, 3>::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, -stiffness, -damping, 0.0);
    // From the moment at which a command acts to the next: the rest of the period, then the delay with the torque still
    // held; the sample in between is what the next command is of.
    let (before, after) = (transition(DELAY), transition(PERIOD - DELAY));
    for law in laws {
        let angles = run(law, ANGLE);
        let mut state = Vector3::new(ANGLE, 0.0, 0.0);
        let mut worst = 0.0_f64;
        for angle in &angles {
            worst = worst.max((angle - state.x).abs() / ANGLE);
            let command = (update * state).z;
            state = before * state;
            state.z = command;
            state = after * state;
        }
        println!("matrix exponential: {worst:.1e} of the angle at first");
        assert!(worst < EXACT, "{worst:e}");
        // The loop does something: it is damped, and passes zero.
        assert!(angles.last().unwrap().abs() < 0.1 * ANGLE);
        assert!(angles.iter().any(|angle| *angle < 0.0));
    }
}

/// Large angles about one axis: between the times at which the torque changes, angle and rate are polynomials of time.
#[test]
fn large_angles_are_those_of_the_recursion() {
    let (k, p) = (160.0, 90.0);
    let zero = Matrix3::zeros();
    let mut mrp = MrpFeedback::new(MrpGains::new(k, p), zero, Gyroscopic::Nothing).unwrap();
    let gain = Matrix3::from_diagonal_element;
    let mut quaternion =
        QuaternionFeedback::new(gain(k / 2.0), gain(p), zero, Gyroscopic::Nothing).unwrap();
    let laws: [(&mut dyn Law, f64, OfAngle); 2] = [
        (&mut mrp, k, |angle| libm::tan(angle / 4.0)),
        (&mut quaternion, k / 2.0, |angle| libm::sin(angle / 2.0)),
    ];
    for (law, k, of_angle) in laws {
        let angles = run(law, 2.5);
        let (mut angle, mut rate, mut held) = (2.5, 0.0, 0.0);
        let mut worst = 0.0_f64;
        let coast = |angle: &mut f64, rate: &mut f64, held: f64, time: f64| {
            *angle += *rate * time + held / INERTIA * time * time / 2.0;
            *rate += held / INERTIA * time;
        };
        for found in &angles {
            worst = worst.max((found - angle).abs());
            let command = -k * of_angle(angle) - p * rate;
            coast(&mut angle, &mut rate, held, DELAY);
            held = command;
            coast(&mut angle, &mut rate, held, PERIOD - DELAY);
        }
        println!("recursion: {worst:.1e} rad");
        assert!(worst < EXACT, "{worst:e}");
    }
}
