//! MRP feedback against Basilisk's `mrpFeedback`, as `tests/engines/mrp_feedback.py` stores it.

use nalgebra::{Matrix3, Vector3};
use precess_control::{
    Gyroscopic, Law as _, Motion, MrpFeedback, MrpGains, Reference, Sample, Tracking,
};
use precess_dynamics::{Attitude as _, Mrp, Quaternion};
use serde_json::Value;

const FIXTURE: &str =
    include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/fixtures/mrp_feedback.json"));

/// Of the magnitudes of the terms, which are turned to R and back here.
const ROUNDING: f64 = 1e-14;

fn number(of: &Value) -> f64 {
    of.as_f64().unwrap()
}

fn three(of: &Value) -> Vector3<f64> {
    Vector3::from_fn(|row, _| number(&of[row]))
}

/// The law and what it reads at a sample.
fn case(of: &Value) -> (MrpFeedback, Sample, Matrix3<f64>) {
    let inertia = Matrix3::from_fn(|row, column| number(&of["inertia"][row][column]));
    let gains = MrpGains {
        integral: Matrix3::from_diagonal_element(number(&of["integral_gain"])),
        integral_limit: number(&of["integral_limit"]),
        ..MrpGains::new(number(&of["attitude_gain"]), number(&of["rate_gain"]))
    };
    let gyroscopic = if of["law"] == 0 { Gyroscopic::Reference } else { Gyroscopic::Whole };
    let law = MrpFeedback::new(gains, inertia, gyroscopic).unwrap();
    // R has the axes of N at this moment.
    let attitude = Quaternion::from(Mrp(three(&of["sigma"])));
    let omega = three(&of["omega_br"]) + three(&of["omega_rn"]);
    let to_r = attitude.dcm().transpose();
    let reference = Reference {
        attitude: Quaternion::identity(),
        omega: to_r * three(&of["omega_rn"]),
        omega_dot: to_r * three(&of["omega_rn_dot"]),
    };
    let mut sample = Sample::new(Motion { attitude, omega }, reference);
    for wheel in of["wheels"].as_array().unwrap() {
        let axis = three(&wheel["axis"]);
        let speed = number(&wheel["spin"]) + omega.dot(&axis);
        sample.momentum += axis * (number(&wheel["inertia"]) * speed);
    }
    sample.external = three(&of["external"]);
    (law, sample, inertia)
}

#[test]
fn torques_are_those_of_basilisk_but_for_a_sign_that_its_proof_has_otherwise() {
    let document: Value = serde_json::from_str(FIXTURE).unwrap();
    let (mut worst, mut others) = (0.0_f64, 0);
    for of in document["cases"].as_array().unwrap() {
        let (mut law, mut sample, inertia) = case(of);
        // Of Basilisk's three samples the second has no interval, either.
        let _ = law.torque(&sample);
        sample.elapsed = number(&document["period"]);
        let torque = law.torque(&sample);
        let error = Tracking::new(&sample.motion, &sample.reference);
        let momentum = inertia * error.omega_bn + sample.momentum;
        let gain = number(&of["integral_gain"]);
        let mut expected = torque;
        if of["law"] == 0 && gain > 0.0 {
            let z = law.integral() + inertia * error.omega_br;
            let twice = (z * (2.0 * gain)).cross(&momentum);
            assert!(twice.norm() > 1e-3);
            expected += twice;
            others += 1;
        }
        let unit = torque.norm() + error.omega_bn.norm() * momentum.norm();
        worst = worst.max((expected - three(&of["torque"])).norm() / unit);
    }
    println!("basilisk: {worst:.1e} of the terms");
    assert!(worst < ROUNDING, "{worst:e}");
    assert_eq!(others, 8);
}
