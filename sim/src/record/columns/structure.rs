//! Columns of a flexible structure: modal coordinates and rates, and the motion of recorded points.

use super::{Column, Quantity, scalar, vector};
use crate::scenario::Scenario;

/// Modal coordinates and rates, numbered from 1.
pub(super) fn modal(columns: &mut Vec<Column>, modes: usize) {
    let two = [
        (Quantity::ModalCoordinate as fn(usize) -> Quantity, "eta", "m kg^1/2", "coordinate"),
        (Quantity::ModalRate, "eta_dot", "m kg^1/2/s", "rate"),
    ];
    for (quantity, name, unit, what) in two {
        for mode in 0..modes {
            let number = mode + 1;
            let meaning = format!("modal {what} of mode {number}");
            let name = format!("modes.{name}_{number}");
            scalar(columns, &name, "modes", unit, &meaning, quantity(mode));
        }
    }
}

/// Modal coordinates, and the motion of the recorded points.
pub(super) fn columns(columns: &mut Vec<Column>, scenario: &Scenario) {
    let Some(structure) = &scenario.structure else { return };
    modal(columns, structure.modes.len());
    for (index, point) in structure.points.iter().enumerate() {
        let name = &point.name;
        let of = [
            (
                Quantity::Displacement as fn(usize, usize) -> Quantity,
                "displacement",
                "m",
                "displacement by the deformation",
            ),
            (Quantity::Rotation, "rotation", "rad", "rotation vector of the deformation"),
            (Quantity::PointOmega, "omega", "rad/s", "inertial angular velocity"),
            (Quantity::PointAcceleration, "acceleration", "m/s²", "inertial acceleration"),
        ];
        for (quantity, what, unit, meaning) in of {
            let (base, meaning) = (format!("{name}.{what}"), format!("{meaning} of {name}"));
            vector(columns, &base, name, unit, "B", &meaning, |axis| quantity(index, axis));
        }
        for axis in 0..3 {
            columns.push(Column {
                name: format!("{name}.sigma_{}", axis + 1),
                unit: "1",
                frame: None,
                meaning: format!(
                    "attitude of {name} with respect to N: modified Rodrigues parameter {}",
                    axis + 1
                ),
                group: name.clone(),
                vector: Some(format!("{name}.sigma")),
                quantity: Quantity::PointSigma(index, axis),
            });
        }
    }
}
