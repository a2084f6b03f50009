//! Initial coordinate and rate of a joint; and its motion, where one of them is a profile: `rate = { ... }` prescribes the
//! rate at any time, `angle = { ... }` the angle. What the run takes is the acceleration, their derivative.

use std::path::Path;

use precess_dynamics::kind::JointInfo;

use super::joint_measures::JointMeasures;
use crate::file::document::Value;
use crate::file::keys::Keys;
use crate::file::read::values::drive::profile;
use crate::scenario::{NoDerivative, Profile};
use crate::units::{Measure, Plain};

/// An initial rate that is stated beside the profile of an angle may differ from its slope by this part.
const RATE_APART: f64 = 1e-9;

/// Drives that a joint whose motion is prescribed does not have.
const OTHER_DRIVES: [&str; 9] = [
    "torque",
    "torque_limit",
    "force",
    "force_limit",
    "power_limit",
    "rate_limit",
    "speed_limit",
    "acceleration",
    "locked",
];

/// The key of a profile that prescribes a motion, and the acceleration; none where it is wrong, which has been reported.
type Motion = (&'static str, Option<Profile>);

/// Initial coordinate and rate, and what prescribes the motion.
pub(super) fn motion(
    keys: &Keys<'_>,
    joint: &JointInfo,
    measures: &JointMeasures,
    folder: &Path,
) -> ([f64; 2], Option<Motion>) {
    // A joint that slides has a displacement and a speed.
    let [coordinate, rate] =
        if joint.slides { ["displacement", "speed"] } else { ["angle", "rate"] };
    let quantity = |key, measure| keys.quantity(key, measure).unwrap_or(0.0);
    let of = |key: &str, measure: Measure| {
        let node = keys.node(key).filter(|node| matches!(node.value, Value::Table(_)))?;
        Some(profile(keys, key, node, measure, folder))
    };
    match (of(coordinate, measures.coordinate), of(rate, measures.rate)) {
        (None, None) => {
            ([quantity(coordinate, measures.coordinate), quantity(rate, measures.rate)], None)
        }
        (None, Some(profile)) => {
            let initial = quantity(coordinate, measures.coordinate);
            let Some(profile) = profile else { return ([initial, 0.0], Some((rate, None))) };
            let acceleration = derivative(keys, rate, &profile, ["", measures.rate.unit]);
            ([initial, profile.at(0.0, false)], Some((rate, acceleration)))
        }
        (Some(of_coordinate), of_rate) => {
            if of_rate.is_some() {
                let message = format!("`{coordinate}` and `{rate}` are both profiles");
                keys.error(rate, message, "keep one of them: the other follows from it");
                return ([0.0; 2], Some((coordinate, None)));
            }
            let Some(profile) = of_coordinate else { return ([0.0; 2], Some((coordinate, None))) };
            let slope = derivative(keys, coordinate, &profile, ["", measures.coordinate.unit]);
            let Some(slope) = slope else { return ([0.0; 2], Some((coordinate, None))) };
            let state = [profile.at(0.0, false), slope.at(0.0, false)];
            agrees(keys, rate, measures.rate, state[1]);
            let words = ["slope of ", measures.rate.unit];
            (state, Some((coordinate, derivative(keys, coordinate, &slope, words))))
        }
    }
}

/// Reports keys of other drives beside a profile that prescribes the motion.
pub(super) fn only_motion(keys: &Keys<'_>, key: &str) {
    // `locked = false` is no drive: a member of a layout takes the lock of the others off by it.
    let is_given = |other: &&str| match *other {
        "locked" => keys.boolean("locked").unwrap_or(false),
        other => keys.has(other),
    };
    for other in OTHER_DRIVES.into_iter().filter(is_given) {
        let message = format!("a joint whose `{key}` is a profile has no `{other}`");
        let help = match other {
            "locked" => format!("write `locked = false`, or the initial `{key}` only"),
            _ if other.ends_with("_limit") => {
                "remove it; a `[[requirement]]` limits what the motor needs".to_owned()
            }
            _ => format!("remove it, or write the initial `{key}` only"),
        };
        keys.error(other, message, &help);
    }
}

/// The derivative of a profile; reports where it has none.
fn derivative(
    keys: &Keys<'_>,
    key: &str,
    profile: &Profile,
    [what, unit]: [&str; 2],
) -> Option<Profile> {
    let (message, help) = match profile.derivative() {
        Ok(derivative) => return Some(derivative),
        Err(NoDerivative::Jump { time, before, after }) => {
            let [time, before, after] = [time, before, after].map(Plain);
            (
                format!("the {what}`{key}` jumps at {time} s, from {before} to {after} {unit}"),
                "a motion takes a finite torque: use a ramp, or `interpolation = \"linear\"`; of an angle, prescribe \
                 the rate",
            )
        }
        Err(NoDerivative::Chirp) => (
            format!("the derivative of `{key}`, a chirp, is no profile"),
            "prescribe the `acceleration` by a chirp",
        ),
    };
    keys.error(key, message, help);
    None
}

/// Reports an initial rate beside the profile of an angle that is not its slope.
fn agrees(keys: &Keys<'_>, key: &str, measure: Measure, slope: f64) {
    let Some(stated) = keys.quantity(key, measure) else { return };
    if (stated - slope).abs() > RATE_APART * stated.abs().max(slope.abs()) {
        let [stated, slope] = [stated, slope].map(Plain);
        let unit = measure.unit;
        let message = format!("`{key}` is {stated} {unit}, the profile begins with {slope} {unit}");
        keys.error(key, message, "remove it: the profile has the initial rate");
    }
}
