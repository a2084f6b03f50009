//! What the summary of a run says of its controllers.

use precess_control::rotation;

use crate::report::number;
use crate::scenario::{AttitudeReference, ControlLaw, SampledController, Scenario};

/// A sentence for each.
pub(super) fn sentences(scenario: &Scenario) -> Vec<String> {
    scenario.controllers.iter().map(|of| sentence(of, scenario)).collect()
}

fn sentence(of: &SampledController, scenario: &Scenario) -> String {
    let rate = number::short(of.rate, 6);
    let delay = if of.delay == 0.0 {
        "acting at once".to_owned()
    } else {
        format!("acting after {} s", number::short(of.delay, 6))
    };
    let law = match &of.law {
        ControlLaw::MrpFeedback { .. } => "feedback of modified Rodrigues parameters",
        ControlLaw::QuaternionFeedback { .. } => "quaternion feedback",
        ControlLaw::EigenAxis { .. } => "eigen-axis feedback",
        ControlLaw::RateDamping { .. } => "rate damping",
        ControlLaw::Program { .. } => "a program",
    };
    let joints: Vec<_> = scenario.joints().collect();
    let own = of.joints.iter().filter_map(|own| joints.get(own.joint));
    let mut devices: Vec<&str> = own.map(|(_, device, _)| *device).collect();
    devices.dedup();
    let reference = match &of.reference {
        AttitudeReference::Hold(_) => "an attitude at rest".to_owned(),
        AttitudeReference::Slew { start, from, to, .. } => {
            let turn = rotation::product(&rotation::inverse(from), to);
            let angle = number::short(rotation::to_vector(&turn).norm().to_degrees(), 5);
            let end = of.reference.slew_end().unwrap_or(f64::NAN);
            format!(
                "a slew by {angle} deg from {} s to {} s",
                number::time(*start),
                number::time(end)
            )
        }
        AttitudeReference::Turning { omega, .. } => {
            format!("a frame that turns at {} deg/s", number::short(omega.norm().to_degrees(), 5))
        }
        AttitudeReference::Table(rows) => format!("a table of {} attitudes", rows.len()),
    };
    format!(
        "The controller {} samples at {rate} Hz, {delay}: {law} commands {}. It follows {reference}{}.",
        of.name,
        devices.join(", "),
        reads(of)
    )
}

/// What it reads, where that is not the truth.
fn reads(of: &SampledController) -> String {
    let sensors = &of.sensors;
    let read: Vec<_> = [
        (sensors.gyro.is_some(), "a gyro"),
        (sensors.star_tracker.is_some(), "a star tracker"),
        (sensors.encoder_quantum > 0.0, "encoders"),
        (sensors.tachometer_quantum > 0.0, "tachometers"),
    ]
    .into_iter()
    .filter_map(|(has, what)| has.then_some(what))
    .collect();
    if read.is_empty() {
        return String::new();
    }
    let by = if of.estimator.is_some() { " by a Kalman filter" } else { "" };
    format!(", and reads {}{by}", read.join(", "))
}
