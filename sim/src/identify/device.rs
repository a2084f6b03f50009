//! What was identified as parts of a scenario: numbers of the hub, imbalances and friction of devices, with their intervals.
//!
//! A scenario takes it by `base`, or the other way round: `base = ["bus.toml", "bus-identified.toml"]`. The numbers of a device of a
//! layout are those of its `[[device.member]]`. What the data do not tell is a comment.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use super::component::Target;
use super::{Identified, NamedEstimate, WheelEstimate};
use crate::fit::Estimate;
use crate::scenario::Scenario;

/// A number as TOML reads it, to six digits.
fn number(value: f64) -> String {
    let text = format!("{value:.5e}");
    text.parse::<f64>().map_or(text, |rounded| zmij::Buffer::new().format(rounded).to_owned())
}

fn interval(estimate: &Estimate, unit: &str) -> String {
    let [low, high] = estimate.interval;
    format!("95 %: {low:.4e} to {high:.4e} {unit}")
}

/// The text of the file. `layouts` has, of each device of a layout, the layout's name.
#[must_use]
pub fn device(found: &Identified, scenario: &Scenario, layouts: &[Option<String>]) -> String {
    let mut out = String::from(
        "# Identified from telemetry (precess identify). A scenario takes it after its own file:\n\
         # base = [\"SCENARIO.toml\", \"THIS.toml\"]\n",
    );
    if !found.holds() {
        out.push_str("# THE MODEL DOES NOT HOLD: these numbers are not those of the spacecraft.\n");
    }
    for direction in &found.untold {
        let by =
            if direction.has_prior { "the prior tells it" } else { "it is as the scenario has it" };
        let _ = writeln!(out, "# not told by the data: {direction}; {by}");
    }
    hub(&mut out, found, scenario);
    let mut listed: Vec<String> = Vec::new();
    for (index, name) in scenario.names.iter().enumerate() {
        let text = of_device(found, scenario, index);
        if text.is_empty() {
            continue;
        }
        match layouts.get(index).cloned().flatten() {
            Some(layout) => {
                if !listed.contains(&layout) {
                    let _ = write!(out, "\n[[device]]\nname = \"{layout}\"\n");
                    listed.push(layout);
                }
                let _ = write!(out, "\n[[device.member]]\nname = \"{name}\"\n");
                out.push_str(&text.replace("[device.", "[device.member."));
            }
            None => {
                let _ = write!(out, "\n[[device]]\nname = \"{name}\"\n{text}");
            }
        }
    }
    biases(&mut out, found);
    out
}

fn hub(out: &mut String, found: &Identified, scenario: &Scenario) {
    let of = |target: Target| -> Option<&NamedEstimate> {
        let place = found.components.iter().position(|of| of.target == target)?;
        found.numbers.get(place).filter(|of| of.told)
    };
    let elements = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];
    let known: Vec<_> = elements.map(|(row, column)| of(Target::Inertia(row, column))).to_vec();
    let centre: Vec<_> = (0..3).filter_map(|k| of(Target::Centre(k))).collect();
    if known.iter().all(Option::is_none) && centre.is_empty() {
        return;
    }
    out.push_str("\n[hub]\n");
    if known.iter().any(Option::is_some) {
        for found in known.iter().flatten() {
            let _ = writeln!(out, "# {} {}", found.name, interval(&found.estimate, "kg m^2"));
        }
        let value = |index: usize, (row, column): (usize, usize)| {
            known[index].map_or(scenario.hub.i_b_bc[(row, column)], |of| of.estimate.value)
        };
        let numbers: Vec<String> =
            elements.iter().enumerate().map(|(k, of)| number(value(k, *of))).collect();
        let [xx, yy, zz, xy, xz, yz] = [0, 1, 2, 3, 4, 5].map(|k| numbers[k].clone());
        let _ = writeln!(out, "inertia = \"{xx}, {yy}, {zz} kg m^2\"");
        let _ = writeln!(out, "products_of_inertia = \"{xy}, {xz}, {yz} kg m^2\"");
    }
    if let [x, y, z] = centre.as_slice() {
        for of in [x, y, z] {
            let _ = writeln!(out, "# {} {}", of.name, interval(&of.estimate, "m"));
        }
        let [x, y, z] = [x, y, z].map(|of| number(of.estimate.value));
        let _ = writeln!(out, "centre_of_mass = \"{x}, {y}, {z} m\"");
    }
}

fn of_device(found: &Identified, scenario: &Scenario, index: usize) -> String {
    let mut out = String::new();
    let wheel = found.wheels.iter().find(|of| of.index == index);
    if let Some(of) = wheel {
        imbalance(&mut out, of);
    }
    let joints: Vec<_> =
        scenario.joints().enumerate().filter(|(_, (of, ..))| *of == index).collect();
    let last = joints.last().map(|(joint, _)| *joint);
    for (joint, (_, _, info)) in joints {
        let mut keys = String::new();
        for (of, estimate) in found.components.iter().zip(&found.numbers) {
            let (key, unit) = match (of.target, info.slides) {
                (Target::Viscous(own), false) if own == joint => ("damping", "N m s/rad"),
                (Target::Viscous(own), true) if own == joint => ("damping", "N s/m"),
                (Target::Coulomb(own), false) if own == joint => ("coulomb", "N m"),
                (Target::Coulomb(own), true) if own == joint => ("coulomb", "N"),
                _ => continue,
            };
            if estimate.told {
                let note = interval(&estimate.estimate, unit);
                let value = number(estimate.estimate.value);
                let _ = writeln!(keys, "{key} = \"{value} {unit}\"  # {note}");
            }
        }
        if let (Some(of), true) = (wheel.filter(|of| of.told), last == Some(joint)) {
            let note = if of.hidden[0] {
                "hidden by noise".to_owned()
            } else {
                interval(&of.angle, "rad")
            };
            let _ = writeln!(keys, "angle = \"{} rad\"  # {note}", number(of.angle.value));
        }
        if !keys.is_empty() {
            let body = info.body.replace(' ', "_");
            let _ = write!(out, "[device.{body}]\n{keys}");
        }
    }
    for (of, estimate) in found.components.iter().zip(&found.numbers) {
        if matches!(of.target, Target::Mount(device, _) if device == index) {
            let [low, high] = estimate.estimate.interval.map(|end| end * 360.0 / TAU);
            let value = estimate.estimate.value * 360.0 / TAU;
            let told = if estimate.told { "" } else { ", not told by the data" };
            let _ = writeln!(
                out,
                "# {}: the mount is turned by {value:.5} deg about this axis of B, 95 %: {low:.5} to {high:.5}{told}",
                of.name
            );
        }
    }
    out
}

fn imbalance(out: &mut String, of: &WheelEstimate) {
    if !of.told {
        out.push_str("# the data do not tell its imbalance\n");
        return;
    }
    let amplitude = |estimate: &Estimate, hidden: bool, unit: &str| {
        let [_, high] = estimate.interval;
        if hidden {
            format!("hidden by noise, 95 %: up to {high:.4e} {unit}")
        } else {
            interval(estimate, unit)
        }
    };
    let _ = writeln!(out, "# U_s {}", amplitude(&of.u_s, of.hidden[0], "kg m"));
    let _ = writeln!(out, "# U_d {}", amplitude(&of.u_d, of.hidden[1], "kg m^2"));
    let phase = if of.hidden == [false; 2] {
        interval(&of.phase, "rad")
    } else {
        "hidden by noise".to_owned()
    };
    let _ = writeln!(out, "# phase {phase}");
    let _ = writeln!(
        out,
        "imbalance = {{ static = \"{} kg m\", dynamic = \"{} kg m^2\", phase = \"{} rad\" }}",
        number(of.u_s.value),
        number(of.u_d.value),
        number(of.phase.value)
    );
}

fn biases(out: &mut String, found: &Identified) {
    let of = found.components.iter().zip(&found.numbers);
    let own: Vec<_> = of.filter(|(of, _)| matches!(of.target, Target::Bias(_))).collect();
    if own.is_empty() {
        return;
    }
    out.push_str("\n# bias of the gyro at the start of the record\n");
    for (of, estimate) in own {
        let told = if estimate.told { "" } else { ", not told by the data" };
        let note = interval(&estimate.estimate, "rad/s");
        let _ =
            writeln!(out, "# {} {} rad/s, {note}{told}", of.name, number(estimate.estimate.value));
    }
}
