//! MRP feedback: the derivative of its Lyapunov function along the motion of a rigid body with momentum devices.

use nalgebra::{Matrix3, Vector3};
use precess_control::rotation::from_vector;
use precess_control::{
    Gyroscopic, Law as _, Motion, MrpFeedback, MrpGains, Reference, Sample, Tracking,
};
use precess_dynamics::{Attitude as _, Mrp};

use crate::random::Random;
use crate::rigid_body::{definite, vector};

/// Roundings of a sum of thirty terms, in units of the sum of their magnitudes.
const ROUNDING: f64 = 4e-15;

struct Case {
    sample: Sample,
    gains: MrpGains,
    inertia: Matrix3<f64>,
}

fn case(random: &mut Random, integral: bool) -> Case {
    let motion = Motion { attitude: from_vector(&vector(random, 1.8)), omega: vector(random, 0.5) };
    let reference = Reference {
        attitude: from_vector(&vector(random, 1.8)),
        omega: vector(random, 0.3),
        omega_dot: vector(random, 0.2),
    };
    let mut sample = Sample::new(motion, reference);
    sample.momentum = vector(random, 40.0);
    sample.external = vector(random, 0.3);
    sample.elapsed = 0.1;
    let mut gains = MrpGains::new(3.0 + random.signed(), 1.0);
    gains.rate = definite(random, 20.0);
    if integral {
        gains.integral = definite(random, 0.02);
        gains.integral_limit = 100.0;
    }
    Case { sample, gains, inertia: definite(random, 300.0) }
}

/// `V'` by the chain rule, `V' + (omega_br + K_I z) . P (omega_br + K_I z)` and the sum of its terms' magnitudes.
fn derivative(case: &Case, law: &MrpFeedback, torque: &Vector3<f64>) -> (f64, f64, f64) {
    let Case { sample, gains, inertia } = case;
    let error = Tracking::new(&sample.motion, &sample.reference);
    // Euler's equation of a rigid body with devices whose momentum relative to it does not change but by the torque.
    let gyroscopic = error.omega_bn.cross(&(inertia * error.omega_bn + sample.momentum));
    let exerted = torque + sample.external - gyroscopic;
    let omega_dot = inertia.try_inverse().unwrap() * exerted;
    let momentum_dot = inertia * error.omega_br_dot(&omega_dot);
    let sigma = error.sigma();
    let sigma_dot = Mrp(sigma).rate(&error.omega_br);
    let kinetic = error.omega_br.dot(&momentum_dot);
    let potential = 4.0 * gains.attitude * sigma.dot(&sigma_dot) / (1.0 + sigma.norm_squared());
    let z = law.integral() + inertia * error.omega_br;
    let z_dot = sigma * gains.attitude + momentum_dot;
    let of_integral = z.dot(&(gains.integral * z_dot));
    let rate = error.omega_br + gains.integral * z;
    let dissipated = rate.dot(&(gains.rate * rate));
    let unit = rate.norm() * (exerted.norm() + torque.norm() + gyroscopic.norm())
        + inertia.norm() * error.feed_forward().norm() * rate.norm()
        + gains.attitude * sigma.norm() * rate.norm()
        + dissipated;
    let total = kinetic + potential + of_integral;
    (total, total + dissipated, unit)
}

/// `V' = -omega . P omega` of the law without integral, and with it the same of `omega + K_I z`.
#[test]
fn the_function_falls_by_the_rate_gain_only() {
    let mut random = Random::new(7);
    for gyroscopic in [Gyroscopic::Whole, Gyroscopic::Reference] {
        for integral in [false, true] {
            let mut worst = 0.0_f64;
            for _ in 0..500 {
                let case = case(&mut random, integral);
                let mut law = MrpFeedback::new(case.gains, case.inertia, gyroscopic).unwrap();
                let torque = law.torque(&case.sample);
                let (total, rest, unit) = derivative(&case, &law, &torque);
                assert!(total < 0.0, "{total}");
                worst = worst.max(rest.abs() / unit);
            }
            println!("{gyroscopic:?}, integral {integral}: {worst:.1e} of the terms");
            assert!(worst < ROUNDING, "{gyroscopic:?} {integral}: {worst:e}");
        }
    }
}

/// With `omega_rn + K_I z` in place of `omega_rn - K_I z` the function has `2 omega_br . (K_I z x H)` more.
#[test]
fn the_sign_of_the_integral_in_the_gyroscopic_term_is_a_minus() {
    let mut random = Random::new(8);
    for _ in 0..100 {
        let case = case(&mut random, true);
        let mut law = MrpFeedback::new(case.gains, case.inertia, Gyroscopic::Reference).unwrap();
        let torque = law.torque(&case.sample);
        let error = Tracking::new(&case.sample.motion, &case.sample.reference);
        let z = law.integral() + case.inertia * error.omega_br;
        let momentum = case.inertia * error.omega_bn + case.sample.momentum;
        let cross = (case.gains.integral * z).cross(&momentum);
        let (_, rest, unit) = derivative(&case, &law, &(torque + cross * 2.0));
        let more = 2.0 * error.omega_br.dot(&cross);
        assert!((rest - more).abs() < ROUNDING * (unit + more.abs()), "{rest} {more}");
        assert!(more.abs() > 1e3 * ROUNDING * unit);
    }
}

/// Without compensation of the gyroscopic torque and a reference at rest, the function falls by the rate gain as well.
#[test]
fn at_a_reference_at_rest_the_gyroscopic_torque_has_no_power() {
    let mut random = Random::new(9);
    for _ in 0..100 {
        let mut case = case(&mut random, false);
        case.sample.reference = Reference::at_rest(case.sample.reference.attitude);
        let mut law = MrpFeedback::new(case.gains, case.inertia, Gyroscopic::Nothing).unwrap();
        let torque = law.torque(&case.sample);
        let (_, rest, unit) = derivative(&case, &law, &torque);
        assert!(rest.abs() < ROUNDING * unit, "{rest:e} {unit:e}");
    }
}

#[test]
fn the_integral_grows_by_the_time_since_the_last_sample_and_stops_at_its_limit() {
    let mut random = Random::new(10);
    let mut case = case(&mut random, true);
    case.gains.integral_limit = 0.5;
    let mut law = MrpFeedback::new(case.gains, case.inertia, Gyroscopic::Whole).unwrap();
    let sigma = Tracking::new(&case.sample.motion, &case.sample.reference).sigma();
    let step = sigma * (case.gains.attitude * case.sample.elapsed);
    let _ = law.torque(&Sample { elapsed: 0.0, ..case.sample });
    assert_eq!(law.integral(), Vector3::zeros());
    let _ = law.torque(&case.sample);
    assert_eq!(law.integral(), step);
    let _ = law.torque(&Sample { limited: true, ..case.sample });
    assert_eq!(law.integral(), step);
    for _ in 0..100 {
        let _ = law.torque(&case.sample);
    }
    assert_eq!(law.integral().amax(), 0.5);
    law.reset();
    assert_eq!(law.integral(), Vector3::zeros());
}
