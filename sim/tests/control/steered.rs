//! Arrays of gyros and wheels under a controller.

use super::{column, ran, read};
use precess::file::to_toml;

/// Four gyros of one gimbal in a pyramid, imbalanced wheels.
const PYRAMID: &str = r#"format = 1
[hub]
mass = "500 kg"
inertia = "200, 210, 190 kg m^2"
[initial]
angular_velocity = "0.2, -0.1, 0.3 deg/s"
[initial.attitude]
axis = [1, 2, 3]
angle = "4 deg"
[[device]]
name = "cmg"
kind = "KIND"
layout.pyramid = { count = 4, half_angle = "54.74 deg", radius = "40 cm" }
imbalance = { static = "1 g cm", dynamic = "10 g cm^2" }
wheel = { mass = "6 kg", inertia = "0.4, 0.25, 0.25 kg m^2", rate = "600 rpm" }
BODIES
[[controller]]
name = "aocs"
rate = "10 Hz"
SERVO
[controller.law]
kind = "mrp_feedback"
attitude_gain = "800 N m"
rate_gain = "360 N m s"
[controller.reference]
kind = "slew"
start = "1 s"
turn = { axis = [0, 0, 1], angle = "5 deg" }
rate_limit = "2 deg/s"
acceleration_limit = "1 deg/s^2"
jerk_limit = "2 deg/s^3"
[run]
duration = "8 s"
integrator = "dop853"
tolerance = 1e-9
[output]
rate = "10 Hz"
"#;

const GIMBAL: &str =
    "{ mass = \"1 kg\", inertia = \"0.02, 0.02, 0.02 kg m^2\", torque_limit = \"40 N m\" }";

fn pyramid(kind: &str, bodies: &[&str], servo: &str) -> String {
    let bodies: Vec<_> = bodies.iter().map(|body| format!("{body} = {GIMBAL}")).collect();
    PYRAMID.replace("KIND", kind).replace("BODIES", &bodies.join("\n")).replace("SERVO", servo)
}

#[test]
fn pyramids_of_gyros_come_to_their_reference() {
    for (kind, bodies) in
        [("sgcmg", &["gimbal"][..]), ("dgvscmg", &["outer_gimbal", "inner_gimbal"])]
    {
        let text = pyramid(kind, bodies, "servo = { rate = \"50 Hz\" }");
        let scenario = read(&text);
        let (outcome, samples) = ran(&scenario);
        let angle = column(&samples, "aocs.error_angle");
        let error = column(&samples, "aocs.torque_error_x");
        let measure = column(&samples, "aocs.measure");
        println!(
            "{kind}: {:?} error {:e} -> {:e} rad, drift {:?}, steps {:?}, measure {} -> {}",
            outcome.end,
            angle[0],
            angle[angle.len() - 1],
            outcome.drift,
            outcome.steps,
            measure[0],
            measure[measure.len() - 1]
        );
        assert!(outcome.end.is_complete(), "{kind}: {}", outcome.end);
        assert!(angle[0] < 1e-12, "it starts at its reference");
        assert!(angle[angle.len() - 1] < 1e-3, "{kind}: {}", angle[angle.len() - 1]);
        assert!(error.iter().all(|error| error.abs() < 1e-9));
        assert!(outcome.drift.energy < Some(1e-8) && outcome.drift.angular < Some(1e-9));
        let written = to_toml(&scenario);
        assert_eq!(to_toml(&read(&written)), written, "{kind}");
        assert_eq!(read(&written).controllers, scenario.controllers);
    }
}

/// Four gyros that hold, then slew: gimbals go to preferred angles with the momentum of rest, and exert nothing by that.
#[test]
fn preferred_angles_are_reached_without_torque() {
    /// Of the command: the steering matrix is well-conditioned at all samples.
    const TORQUE_ERROR: f64 = 1e-12;
    /// About a pose without momentum, opposite gimbals turned alike and neighbours oppositely: rad.
    const ANGLE: f64 = 0.3;
    let keys = format!(
        "servo = {{ rate = \"50 Hz\" }}\nallocation.preferred_angles = [\"{ANGLE} rad\", \"-{ANGLE} rad\", \"{ANGLE} rad\", \"-{ANGLE} rad\"]\n\
         allocation.angle_gain = \"0.5 1/s\""
    );
    let own = pyramid("sgcmg", &["gimbal"], &keys)
        .replace(
            "angular_velocity = \"0.2, -0.1, 0.3 deg/s\"",
            "angular_velocity = \"0, 0, 0 deg/s\"",
        )
        .replace("duration = \"8 s\"", "duration = \"30 s\"");
    let (outcome, samples) = ran(&read(&own));
    assert!(outcome.end.is_complete(), "{}", outcome.end);
    let [torque, error] = ["torque", "torque_error"]
        .map(|name| ["x", "y", "z"].map(|axis| column(&samples, &format!("aocs.{name}_{axis}"))));
    let norm =
        |of: &[Vec<f64>; 3], row: usize| of.iter().map(|c| c[row] * c[row]).sum::<f64>().sqrt();
    let rows = error[0].len();
    let largest = (0..rows).map(|row| norm(&torque, row)).fold(0.0, f64::max);
    let worst = (0..rows).map(|row| norm(&error, row)).fold(0.0, f64::max);
    let least = column(&samples, "aocs.measure").into_iter().fold(f64::INFINITY, f64::min);
    println!("torque {largest} N m, error {worst:e} N m, least measure {least}");
    assert!(largest > 1.0 && worst < TORQUE_ERROR * largest, "{worst:e} of {largest}");
    assert!(least > 0.1, "away from singular poses: {least}");
    let last = |name: &str| column(&samples, name)[rows - 1];
    for (number, expected) in [ANGLE, -ANGLE, ANGLE, -ANGLE].into_iter().enumerate() {
        let found = last(&format!("cmg{}.gamma", number + 1));
        println!("gimbal {}: {found}", number + 1);
        assert!((found - expected).abs() < 2e-3, "{found}");
    }
    assert!(last("aocs.error_angle") < 1e-3);
}
