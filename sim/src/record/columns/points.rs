//! Columns of points that move with the hub or with a device's body.

use super::{Column, Quantity, vector};
use crate::scenario::{BodyPoint, Scenario, Target, body_key};

/// Place and velocity in N, acceleration in the axes of the body.
pub(super) fn columns(columns: &mut Vec<Column>, scenario: &Scenario) {
    for (index, BodyPoint { name, body, .. }) in scenario.points.iter().enumerate() {
        let body = match body {
            Target::Joint(joint) => scenario.joints().nth(*joint),
            Target::Hub | Target::Node(_) => None,
        };
        let axes = body.map_or_else(
            || "B".to_owned(),
            |(_, device, info)| format!("{device}.{}", body_key(info)),
        );
        let of = [
            (
                Quantity::BodyPointPosition as fn(usize, usize) -> Quantity,
                "position",
                "m",
                "N",
                "position with respect to the inertial origin",
            ),
            (Quantity::BodyPointVelocity, "velocity", "m/s", "N", "inertial velocity"),
            (
                Quantity::BodyPointAcceleration,
                "acceleration",
                "m/s²",
                axes.as_str(),
                "inertial acceleration",
            ),
        ];
        for (quantity, what, unit, frame, meaning) in of {
            let (base, meaning) = (format!("{name}.{what}"), format!("{meaning} of {name}"));
            vector(columns, &base, name, unit, frame, &meaning, |axis| quantity(index, axis));
        }
    }
}
