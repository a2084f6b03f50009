//! The keys of a joint's friction that sticks, and of its quadratic drag.

use super::joint_measures::JointMeasures;
use crate::file::keys::Keys;
use crate::scenario::{DryFriction, JointFriction};

/// Friction that sticks, and quadratic drag; none where no key states any. Its joint is 0 until the joints are counted.
pub(super) fn friction(keys: &Keys<'_>, measures: &JointMeasures) -> Option<JointFriction> {
    let drag = keys.quantity("quadratic_drag", measures.drag).unwrap_or(0.0);
    let dry = dry(keys, measures);
    (dry.is_some() || drag != 0.0).then_some(JointFriction { joint: 0, dry, drag })
}

fn dry(keys: &Keys<'_>, measures: &JointMeasures) -> Option<DryFriction> {
    let stribeck_rate = keys.quantity("stribeck_rate", measures.rate);
    let unit = measures.torque.usual;
    if !keys.has("static_friction") {
        if stribeck_rate.is_some() {
            let message = "friction falls from `static_friction` about a `stribeck_rate`";
            let help = format!("add `static_friction = \"20 {unit}\"`, or remove it");
            keys.error("stribeck_rate", message, &help);
        }
        return None;
    }
    let static_friction = keys.quantity("static_friction", measures.torque)?;
    if !keys.has("coulomb") {
        keys.missing("coulomb", &format!("coulomb = \"15 {unit}\""));
    }
    if keys.has("coulomb_rate") {
        let message = "a joint with `static_friction` sticks: its friction does not fall to zero at a `coulomb_rate`";
        keys.error("coulomb_rate", message, "remove one of them");
    }
    let coulomb = keys.quantity("coulomb", measures.torque)?;
    Some(DryFriction { static_friction, coulomb, stribeck_rate: stribeck_rate.unwrap_or(0.0) })
}
