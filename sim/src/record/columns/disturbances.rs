//! Columns of disturbances: force and moment of each source, so that spectra can name what contributes.

use super::{Column, Quantity, vector};
use crate::scenario::Scenario;

/// Force and moment along the axes of the data sheet.
pub(super) fn columns(columns: &mut Vec<Column>, scenario: &Scenario) {
    for (index, source) in scenario.disturbances.iter().enumerate() {
        let name = &source.name;
        let group = format!("source_{name}");
        for (what, unit, first) in [("force", "N", 0), ("moment", "N m", 3)] {
            let base = format!("{group}.{what}");
            let meaning = format!("{what} that the source {name} exerts, component");
            let of = |axis| Quantity::Disturbance(index, first + axis);
            let frame = format!("data sheet of {name}");
            vector(columns, &base, &group, unit, &frame, &meaning, of);
        }
    }
}
