//! `reference` of a `[[controller]]`: what the hub is to follow.

use std::f64::consts::{PI, TAU};

use nalgebra::Vector3;
use precess_control::{AttitudeRow, TurnLimits, rotation};
use precess_dynamics::{Attitude as _, Quaternion};

use super::{ControllerContext, Wrong};
use crate::file::document::{Node, Value};
use crate::file::keys::Keys;
use crate::file::read::devices::initial::{attitude_of, of_axes};
use crate::scenario::{AttitudeReference, OrbitalFrame};
use crate::units::{Measure, Plain};

/// Which reference, by its word.
#[derive(Clone, Copy)]
enum ReferenceKind {
    Hold,
    Slew,
    Turning,
    Orbit,
    Table,
}

pub(super) fn reference(
    keys: &Keys<'_>,
    known: &ControllerContext<'_>,
) -> Option<AttitudeReference> {
    let words = [
        ("hold", ReferenceKind::Hold),
        ("slew", ReferenceKind::Slew),
        ("turning", ReferenceKind::Turning),
        ("orbit", ReferenceKind::Orbit),
        ("table", ReferenceKind::Table),
    ];
    let chosen = keys.choice("kind", &words);
    if keys.has("kind") {
        // The keys of another are not known.
        chosen?;
    }
    let found = match chosen.unwrap_or(ReferenceKind::Hold) {
        ReferenceKind::Hold => attitude(keys, "attitude")
            .ok()
            .map(|of| AttitudeReference::Hold(of.unwrap_or(known.attitude))),
        ReferenceKind::Slew => slew(keys, known),
        ReferenceKind::Turning => {
            let start = attitude(keys, "attitude");
            if !keys.has("angular_velocity") {
                keys.missing("angular_velocity", "angular_velocity = \"0, 0.1, 0 deg/s\"");
            }
            let omega = keys.vector("angular_velocity", Measure::ANGULAR_RATE);
            let start = start.ok().map(|of| of.unwrap_or(known.attitude));
            start.zip(omega).map(|(attitude, omega)| AttitudeReference::Turning { attitude, omega })
        }
        ReferenceKind::Orbit => orbit(keys, known),
        ReferenceKind::Table => table(keys),
    };
    keys.finish();
    found
}

/// The attitude of a key, where it is there.
fn attitude(keys: &Keys<'_>, key: &str) -> Result<Option<Quaternion>, Wrong> {
    if !keys.has(key) {
        return Ok(None);
    }
    let table = keys.table(key).ok_or(Wrong)?;
    let found = attitude_of(&table);
    table.finish();
    found.map(Some).ok_or(Wrong)
}

/// The turn of a slew. An attitude is the same after 270 degrees one way and 90 the other, and a slew goes the shorter way.
fn turn(keys: &Keys<'_>) -> Result<Option<Quaternion>, Wrong> {
    let found = attitude(keys, "turn")?;
    let angle = keys.table("turn").filter(|table| table.has("angle"));
    let angle = angle.and_then(|table| table.quantity("angle", Measure::ANGLE).zip(Some(table)));
    // One of 180 degrees in other units is that to rounding.
    let Some((angle, table)) = angle.filter(|(angle, _)| angle.abs() > PI * (1.0 + 1e-9)) else {
        return Ok(found);
    };
    let shorter = angle - TAU * (angle / TAU).round();
    let [angle, shorter] = [angle, shorter].map(|angle| Plain(angle.to_degrees()));
    let message = format!("{angle} deg is more than 180 deg, and a slew goes the shorter way");
    let help = format!(
        "`angle = \"{shorter} deg\"` ends at the same attitude; `kind = \"turning\"` goes on"
    );
    table.error("angle", message, &help);
    Err(Wrong)
}

fn slew(keys: &Keys<'_>, known: &ControllerContext<'_>) -> Option<AttitudeReference> {
    let start = keys.quantity("start", Measure::TIME).unwrap_or(0.0);
    let from = attitude(keys, "from");
    let (to, turn) = (attitude(keys, "attitude"), turn(keys));
    let limit = |key: &str, measure| keys.quantity(key, measure).unwrap_or(f64::INFINITY);
    let limits = TurnLimits {
        rate: limit("rate_limit", Measure::ANGULAR_RATE),
        acceleration: limit("acceleration_limit", Measure::ANGULAR_ACCELERATION),
        jerk: limit("jerk_limit", Measure::ANGULAR_JERK),
    };
    if !keys.has("acceleration_limit") && !keys.has("jerk_limit") {
        keys.missing("acceleration_limit", "acceleration_limit = \"0.1 deg/s^2\"");
    }
    let from = from.ok()?.unwrap_or(known.attitude);
    let to = match (to.ok()?, turn.ok()?) {
        (Some(to), None) => to,
        (None, Some(turn)) => rotation::product(&from, &turn).normalised(),
        (Some(_), Some(_)) => {
            keys.error("turn", "`attitude` is where the slew ends, too", "keep one of them");
            return None;
        }
        (None, None) => {
            keys.missing("turn", "turn = { axis = [0, 0, 1], angle = \"30 deg\" }");
            return None;
        }
    };
    Some(AttitudeReference::Slew { start, from, to, limits })
}

/// Attitudes and rates at times: as many of each.
fn table(keys: &Keys<'_>) -> Option<AttitudeReference> {
    let times = all(keys, "times", "times = \"0, 10 s\"", |keys, node, path| {
        keys.values_of(node, path, Measure::TIME)
    });
    if !keys.has("scalar") {
        keys.missing("scalar", "scalar = \"first\"");
    }
    let first = keys.choice("scalar", &[("first", true), ("last", false)]);
    let quaternions = all(
        keys,
        "quaternions",
        "quaternions = [[1, 0, 0, 0], [0, 0, 0, 1]]",
        |keys, node, path| {
            let of = quaternion(node, first == Some(true));
            if of.is_none() {
                keys.error("quaternions", format!("`{path}` is no list of lists of 4 numbers"), "");
            }
            of.map(|of| vec![of])
        },
    );
    let example = "angular_velocities = [\"0, 0, 0 deg/s\", \"0, 0, 1 deg/s\"]";
    let rates = all(keys, "angular_velocities", example, |keys, node, path| {
        let of = keys.values_of(node, path, Measure::ANGULAR_RATE)?;
        let found = <[f64; 3]>::try_from(of).ok();
        if found.is_none() {
            keys.error("angular_velocities", format!("`{path}` needs 3 numbers in each text"), "");
        }
        found.map(|of| vec![Vector3::from(of)])
    });
    let (times, quaternions, rates, _) = (times?, quaternions?, rates?, first?);
    if times.len() != quaternions.len() || times.len() != rates.len() {
        let [times, quaternions, rates] = [times.len(), quaternions.len(), rates.len()];
        let message =
            format!("{times} times, {quaternions} quaternions and {rates} angular velocities");
        keys.error("times", message, "a row has one of each");
        return None;
    }
    let rows = times.into_iter().zip(quaternions).zip(rates);
    let rows = rows.map(|((time, attitude), omega)| AttitudeRow { time, attitude, omega });
    Some(AttitudeReference::Table(rows.collect()))
}

/// What each node of a list says, or the value by itself, of a key that must be there.
fn all<'a, T>(
    keys: &Keys<'a>,
    key: &str,
    example: &str,
    read: impl Fn(&Keys<'a>, &Node, &str) -> Option<Vec<T>>,
) -> Option<Vec<T>> {
    let Some(node) = keys.node(key) else {
        keys.missing(key, example);
        return None;
    };
    let path = format!("{}.{key}", keys.path());
    match &node.value {
        Value::List(list) => {
            let each = list.iter().map(|node| read(keys, node, &path));
            Some(each.collect::<Option<Vec<_>>>()?.into_iter().flatten().collect())
        }
        _ => read(keys, node, &path),
    }
}

/// A list of four numbers.
fn quaternion(node: &Node, first: bool) -> Option<Quaternion> {
    let Value::List(list) = &node.value else { return None };
    let numbers = list.iter().map(|node| match node.value {
        Value::Number(value, _) => Some(value),
        _ => None,
    });
    let four = <[f64; 4]>::try_from(numbers.collect::<Option<Vec<_>>>()?).ok()?;
    let [q0, q1, q2, q3] = if first { four } else { [four[3], four[0], four[1], four[2]] };
    Some(Quaternion { q0, q1, q2, q3 })
}

/// The orbital frame of the start, which turns at its rate there.
fn orbit(keys: &Keys<'_>, known: &ControllerContext<'_>) -> Option<AttitudeReference> {
    let from_frame = attitude(keys, "attitude").ok()?.unwrap_or_else(Quaternion::identity);
    let Some(frame) = OrbitalFrame::new(&known.position, &known.velocity) else {
        let message =
            "position and velocity at the start are parallel or zero, so there is no orbital frame";
        keys.error(
            "kind",
            message,
            "give the `position` and `velocity` of an orbit in `[initial]`",
        );
        return None;
    };
    let attitude = rotation::product(&of_axes(&frame.axes.transpose()), &from_frame).normalised();
    let omega = attitude.dcm() * frame.omega;
    Some(AttitudeReference::Turning { attitude, omega })
}
