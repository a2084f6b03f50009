//! Columns of the attitude in the orbital frame, and of what the motion about the centre of mass has, of a scenario with a
//! central body.

use precess_dynamics::Gravity;

use super::{Column, Quantity, ROLL_PITCH_YAW, scalar, vector};
use crate::scenario::Scenario;

/// Roll, pitch and yaw, and the angular velocity with respect to the orbital frame; the angular momentum about the centre of
/// mass.
pub(super) fn columns(columns: &mut Vec<Column>, scenario: &Scenario) {
    if !matches!(scenario.gravity, Gravity::Central { .. }) {
        return;
    }
    for (index, (name, turn)) in ROLL_PITCH_YAW.into_iter().enumerate() {
        let meaning = format!("{name} of B from the orbital frame: the turn about {turn} of three");
        let name = format!("orbit.{name}");
        scalar(columns, &name, "orbit", "rad", &meaning, Quantity::OrbitAngle(index));
    }
    let meaning = "angular velocity of the hub with respect to the orbital frame";
    vector(columns, "orbit.omega", "orbit", "rad/s", "B", meaning, Quantity::OrbitOmega);
    let (name, unit) = ("orbit.momentum_about_centre", "kg m²/s");
    let meaning = "angular momentum about the centre of mass";
    vector(columns, name, "orbit", unit, "N", meaning, Quantity::CentreMomentum);
}
