//! Of each joint what limits its motor, and its spring with the frequency on it: a table of `check`.

use std::f64::consts::TAU;

use precess_dynamics::kind::JointInfo;
use precess_dynamics::units;

use super::table::{aligned, six};
use crate::scenario::mass::{JointInertia, MassMatrix};
use crate::scenario::{Drive, Scenario, joint_key};

/// The rate of a joint: of a wheel in rpm, of another turn in degrees per second.
pub(super) fn shown_rate(info: &JointInfo, rate: f64) -> String {
    if info.slides {
        format!("{} m/s", six(rate))
    } else if info.body == "wheel" {
        format!("{} rpm", six(units::to_rpm(rate)))
    } else {
        format!("{} deg/s", six(rate.to_degrees()))
    }
}

/// A row for each joint that has a spring or a limit; nothing where none has.
pub(super) fn limits_and_springs(scenario: &Scenario, matrix: Option<&MassMatrix>) -> String {
    let mut drives = scenario.drives.iter();
    let mut inertias = matrix.into_iter().flat_map(|matrix| &matrix.joints);
    let heads = [
        "joint",
        "torque limit",
        "power limit",
        "rate limit",
        "stiffness",
        "damping",
        "frequency, all else held",
        "all else free",
    ];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    for (name, member) in scenario.members() {
        for (info, spring) in member.joints().iter().zip(member.passive()) {
            let drive = drives.next();
            let limits = drive.map(Drive::limits).unwrap_or_default();
            let JointInertia { held, free } = inertias.next().copied().unwrap_or_default();
            let is_locked = matches!(drive, Some(Drive::Locked | Drive::Acceleration(_)));
            let units =
                if info.slides { ["N", "N/m", "N s/m"] } else { ["N m", "N m/rad", "N m s/rad"] };
            let [force, stiffness, damping] = units;
            let of = |value: f64, unit: &str| {
                if value == 0.0 { String::new() } else { format!("{} {unit}", six(value)) }
            };
            let frequency = |inertia: Option<f64>| match inertia {
                Some(inertia) if inertia > 0.0 && spring.stiffness > 0.0 && !is_locked => {
                    format!("{} Hz", six((spring.stiffness / inertia).sqrt() / TAU))
                }
                _ => String::new(),
            };
            let row = [
                format!("{name}.{}", joint_key(info)),
                of(limits.torque.unwrap_or(0.0), force),
                of(limits.power.unwrap_or(0.0), "W"),
                limits.rate.map_or_else(String::new, |rate| shown_rate(info, rate)),
                of(spring.stiffness, stiffness),
                of(spring.viscous, damping),
                frequency(held),
                frequency(free),
            ];
            if row.iter().skip(1).any(|cell| !cell.is_empty()) {
                rows.push(row.to_vec());
            }
        }
    }
    if rows.len() == 1 {
        return String::new();
    }
    let is_empty = |column: &usize| {
        rows.iter().skip(1).all(|row| row.get(*column).is_none_or(String::is_empty))
    };
    let empty: Vec<usize> = (0..heads.len()).filter(is_empty).collect();
    let filled = |row: &Vec<String>| {
        let cells = row.iter().enumerate().filter(|(column, _)| !empty.contains(column));
        cells.map(|(_, cell)| cell.clone()).collect::<Vec<_>>()
    };
    format!("\n{}", aligned(&rows.iter().map(filled).collect::<Vec<_>>()))
}
