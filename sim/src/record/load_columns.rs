//! Columns of the loads: at mounts, on the devices of a platform, across joints.

use precess_dynamics::kind::JointInfo;

use super::columns::{Column, Quantity, vector};

/// The load at the mount of a device or platform on the hub, or on the body of a name of another.
pub(super) fn of_mount(
    columns: &mut Vec<Column>,
    (index, name): (usize, &str),
    base: Option<String>,
) {
    let two = [
        (Quantity::MountForce as fn(usize, usize) -> Quantity, "force", "N"),
        (Quantity::MountMoment, "moment", "N m"),
    ];
    let axes = base.clone().unwrap_or_else(|| "B".to_owned());
    let base = base.unwrap_or_else(|| "the hub".to_owned());
    for (quantity, what, unit) in two {
        let about = if what == "moment" { " about its position," } else { "" };
        let meaning = format!("{what} that {base} exerts on {name} at its mount,{about} component");
        let own = format!("{name}.mount.{what}");
        let of = |axis| quantity(index, axis);
        vector(columns, &own, &format!("{name}.loads"), unit, &axes, &meaning, of);
    }
}

/// The load above an isolator: on all devices of a platform.
pub(super) fn of_carried(columns: &mut Vec<Column>, (index, name): (usize, &str)) {
    let two = [
        (Quantity::CarriedForce as fn(usize, usize) -> Quantity, "force", "N"),
        (Quantity::CarriedMoment, "moment", "N m"),
    ];
    for (quantity, what, unit) in two {
        let meaning = format!("{what} that {name} exerts on its devices, about P, component");
        let own = format!("{name}.carried.{what}");
        let of = |axis| quantity(index, axis);
        let axes = format!("{name}.platform");
        vector(columns, &own, &format!("{name}.loads"), unit, &axes, &meaning, of);
    }
}

pub(super) fn of_load(
    columns: &mut Vec<Column>,
    device: &str,
    group: &str,
    joint: usize,
    info: &JointInfo,
) {
    let body = info.body.replace(' ', "_");
    // A rotor that is the same from every angle has the axes of its parent body; of the first body
    // in a device those are the device's own, which stand on the hub as `mount` has it.
    let frame = match (info.ignorable, info.index) {
        (false, _) => format!("{device}.{body}"),
        (true, 0) => format!("mount of {device}"),
        (true, _) => format!("parent body of {device}.{body}"),
    };
    let two = [
        (Quantity::LoadForce as fn(usize, usize) -> Quantity, "force", "N"),
        (Quantity::LoadMoment, "moment", "N m"),
    ];
    for (quantity, what, unit) in two {
        let meaning =
            format!("{what} that its parent body exerts on the {} at its origin", info.body);
        let base = format!("{device}.{body}.load_{what}");
        vector(columns, &base, group, unit, &frame, &meaning, |axis| quantity(joint, axis));
    }
}
