//! The column of a joint's friction that sticks, and of its quadratic drag.

use precess_dynamics::kind::JointInfo;

use super::{Column, Quantity, scalar};
use crate::scenario::Scenario;

/// Of a joint that has any.
pub(super) fn column(
    columns: &mut Vec<Column>,
    scenario: &Scenario,
    device: &str,
    (joint, info): (usize, &JointInfo),
) {
    if scenario.friction_of(joint).is_none() {
        return;
    }
    let [.., unit] = info.units();
    let (name, body) = (format!("{device}.friction_{}", info.coordinate), info.body);
    let meaning = format!("dry friction that sticks, and quadratic drag, on the {body}");
    scalar(columns, &name, device, unit, &meaning, Quantity::Friction(joint));
}
