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
}

/// Of every controller.
pub(super) fn columns(columns: &mut Vec<Column>, scenario: &Scenario) {
    for (index, SampledController { name, .. }) in scenario.controllers.iter().enumerate() {
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
        commands(columns, scenario, index);
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
