//! Columns of controllers: what the hub is to follow and how far it is from that, at the time of a sample of the result;
//! what a controller computed at its last sample.

use precess_dynamics::Steered;

use super::{Column, Quantity, scalar, vector};
use crate::scenario::{SampledController, Scenario};

/// A quantity of a controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ControlQuantity {
    /// Angle between B and R.
    ErrorAngle,
    /// Rotation vector of B from R.
    Error(usize),
    /// Angular velocity of B relative to R.
    RateError(usize),
    /// Euler parameters of R.
    ReferenceQuaternion(usize),
    /// Angular velocity of R.
    ReferenceOmega(usize),
    /// Torque on the spacecraft.
    Torque(usize),
    /// What the commands give less that.
    TorqueError(usize),
    /// Measure of singularity.
    Measure,
    /// How many commands and torques are at a limit.
    Limited,
    /// Command of a joint, by its number among those of the controller.
    Command(usize),
    /// Reading of the gyro.
    Gyro(usize),
    /// Its bias.
    GyroBias(usize),
    /// Reading of the accelerometer.
    Accelerometer(usize),
    /// Angular velocity that the law reads.
    MeasuredOmega(usize),
    /// Attitude that the law reads.
    MeasuredQuaternion(usize),
    /// Rotation vector from that to the true one.
    MeasurementError(usize),
    /// Estimated bias of the gyro.
    EstimatedBias(usize),
    /// Standard deviation of the estimated attitude.
    AttitudeDeviation(usize),
    /// External torque.
    External(usize),
}

/// Of every controller.
pub(super) fn columns(columns: &mut Vec<Column>, scenario: &Scenario) {
    for (index, of_controller) in scenario.controllers.iter().enumerate() {
        let SampledController { name, .. } = of_controller;
        let of = |quantity| Quantity::Control(index, quantity);
        let angle = format!("angle of B from the reference of {name}");
        scalar(
            columns,
            &format!("{name}.error_angle"),
            name,
            "rad",
            &angle,
            of(ControlQuantity::ErrorAngle),
        );
        for k in 0..4 {
            let meaning = format!("reference of {name} with respect to N: Euler parameter {k}");
            let quantity = of(ControlQuantity::ReferenceQuaternion(k));
            scalar(columns, &format!("{name}.reference_q{k}"), name, "1", &meaning, quantity);
        }
        let frame = format!("{name}.reference");
        for (what, unit, frame, meaning, quantity) in [
            (
                "error",
                "rad",
                "B",
                "rotation vector of B from the reference",
                ControlQuantity::Error as fn(usize) -> ControlQuantity,
            ),
            (
                "rate_error",
                "rad/s",
                "B",
                "angular velocity of the hub relative to the reference",
                ControlQuantity::RateError,
            ),
            (
                "reference_omega",
                "rad/s",
                &frame,
                "angular velocity of the reference",
                ControlQuantity::ReferenceOmega,
            ),
            (
                "torque",
                "N m",
                "B",
                "torque on the spacecraft that is commanded",
                ControlQuantity::Torque,
            ),
            (
                "torque_error",
                "N m",
                "B",
                "what the commands of joints give less the torque",
                ControlQuantity::TorqueError,
            ),
        ] {
            let (base, meaning) = (format!("{name}.{what}"), format!("{meaning} of {name}"));
            vector(columns, &base, name, unit, frame, &meaning, |axis| of(quantity(axis)));
        }
        let meaning = format!("measure of singularity of the devices of {name}");
        scalar(
            columns,
            &format!("{name}.measure"),
            name,
            "1",
            &meaning,
            of(ControlQuantity::Measure),
        );
        let meaning = format!("how many commands of {name} are at a limit");
        scalar(
            columns,
            &format!("{name}.limited"),
            name,
            "1",
            &meaning,
            of(ControlQuantity::Limited),
        );
        readings(columns, of_controller, index);
        commands(columns, scenario, index);
    }
}

/// What is read and estimated, of a controller that has sensors or filters; and its external torque.
fn readings(columns: &mut Vec<Column>, of: &SampledController, index: usize) {
    let name = &of.name;
    let quantity = |quantity| Quantity::Control(index, quantity);
    let mut three = |what: &str, unit, meaning: &str, each: fn(usize) -> ControlQuantity| {
        let meaning = format!("{meaning} of {name}");
        let base = format!("{name}.{what}");
        vector(columns, &base, name, unit, "B", &meaning, |axis| quantity(each(axis)));
    };
    let measures = of.sensors.gyro.is_some() || of.sensors.star_tracker.is_some();
    if of.sensors.gyro.is_some() {
        three("gyro", "rad/s", "reading of the gyro", ControlQuantity::Gyro);
        three("gyro_bias", "rad/s", "true bias of the gyro", ControlQuantity::GyroBias);
    }
    if of.sensors.accelerometer.is_some() {
        let meaning = "reading of the accelerometer";
        three("accelerometer", "m/s^2", meaning, ControlQuantity::Accelerometer);
    }
    if measures || !of.filters.is_empty() {
        let meaning = "angular velocity that is read by the law";
        three("measured_omega", "rad/s", meaning, ControlQuantity::MeasuredOmega);
    }
    if measures {
        let meaning = "rotation vector from the attitude that is read to the true one";
        three("measurement_error", "rad", meaning, ControlQuantity::MeasurementError);
    }
    if of.estimator.is_some() {
        let meaning = "estimated bias of the gyro";
        three("estimated_bias", "rad/s", meaning, ControlQuantity::EstimatedBias);
        let meaning = "standard deviation of the estimated attitude";
        three("attitude_deviation", "rad", meaning, ControlQuantity::AttitudeDeviation);
    }
    if of.dumping.is_some() {
        let meaning = "external torque that is commanded";
        three("external_torque", "N m", meaning, ControlQuantity::External);
    }
    for k in (0..4).filter(|_| measures) {
        let meaning = format!("attitude that the law of {name} reads: Euler parameter {k}");
        let base = format!("{name}.measured_q{k}");
        let quantity = quantity(ControlQuantity::MeasuredQuaternion(k));
        scalar(columns, &base, name, "1", &meaning, quantity);
    }
}

/// The commands of joints.
fn commands(columns: &mut Vec<Column>, scenario: &Scenario, controller: usize) {
    let Some(of) = scenario.controllers.get(controller) else { return };
    let joints: Vec<_> = scenario.joints().collect();
    for (index, own) in of.joints.iter().enumerate() {
        let Some((_, device, info)) = joints.get(own.joint) else { continue };
        let [_, rate, acceleration, _] = info.units();
        let (name, unit, what) = if own.steered == Steered::Rate {
            (info.rate, rate, "rate")
        } else {
            (info.acceleration, acceleration, "acceleration")
        };
        let meaning = format!("{what} of the {} that is commanded", info.body);
        let quantity = Quantity::Control(controller, ControlQuantity::Command(index));
        scalar(columns, &format!("{device}.commanded_{name}"), &of.name, unit, &meaning, quantity);
    }
}
