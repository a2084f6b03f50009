//! What a joint does not have whose kind keeps its rate: a motor torque, another acceleration than none, a lock, a motion by a
//! profile, a spring, a stop that locks it. A friction torque is the motor's, which the kind has.

use precess_dynamics::Passive;

use crate::file::keys::Keys;
use crate::scenario::{Profile, StopAction};

/// Reports drives: `torque` is the key of a motor torque or force, whose profile does not matter.
pub(super) fn reject_drives(
    keys: &Keys<'_>,
    torque: &str,
    acceleration: Option<&Profile>,
    locked: bool,
) {
    if keys.has(torque) {
        reject(keys, torque);
    }
    if acceleration.is_some_and(|profile| !profile.is_zero()) {
        reject(keys, "acceleration");
    }
    if locked {
        reject(keys, "locked");
    }
}

/// Reports a profile of a coordinate or rate.
pub(super) fn reject_motion(keys: &Keys<'_>, key: &str) {
    let message = format!("the kind keeps the rate of the joint: `{key}` is no profile");
    keys.error(
        key,
        message,
        "write the quantity that it starts with, or take a kind that drives the joint",
    );
}

/// Reports a spring, and a stop that locks the joint.
pub(super) fn reject_spring(
    keys: &Keys<'_>,
    passive: &Passive,
    stop: Option<([f64; 2], StopAction)>,
) {
    if passive.stiffness != 0.0 {
        reject(keys, "stiffness");
    }
    if stop.is_some_and(|(_, action)| action == StopAction::Lock) {
        reject(keys, "at_stop");
    }
}

/// Reports a brake at a time.
pub(in crate::file::read) fn reject_brake(keys: &Keys<'_>) {
    reject(keys, "brake");
}

fn reject(keys: &Keys<'_>, key: &str) {
    let message = format!("the kind keeps the rate of the joint: no `{key}`");
    keys.error(key, message, "remove it, or take a kind that drives the joint");
}
