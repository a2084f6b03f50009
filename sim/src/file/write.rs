//! A [`Scenario`] as the text of a scenario file, in SI units and with every default written out.
//!
//! Reading it back gives the same scenario to the bit: numbers have the fewest digits that do.
//! Layouts and copies are written as the devices they make, data sheets as centres of mass and
//! products of inertia, files of tables as they were named are not needed any more. A key that is
//! not written stands for what the spacecraft does not have: a torque limit, an end stop, gravity.
//! A program of a controller runs in the folder of the file that is read, which is not written.

mod controller;
mod controller_sensors;
mod requirements;
mod source;
pub(super) mod structure;

use std::fmt::Write as _;

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::{ImbalanceModel, JointInfo};
use precess_dynamics::{Gravity, HubMode, JointStates, Passive, Quaternion};

use super::read::{FORMAT, has_inertia, has_mass, has_origin};
use crate::record::columns::Columns;
use crate::scenario::profile::Interpolation;
use crate::scenario::{
    Action, AppliedWrench, BodyPoint, Drive, DryFriction, Format, IntegratorChoice, JointFriction,
    Member, MotorLimits, Profile, Scenario, StopAction, Target, WrenchAxes, body_key, joint_key,
};

/// The text.
#[must_use]
pub fn to_toml(scenario: &Scenario) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = write_all(&mut text, scenario);
    text
}

pub(super) type Written = std::fmt::Result;

fn write_all(out: &mut String, s: &Scenario) -> Written {
    writeln!(out, "format = {FORMAT}")?;
    writeln!(out, "name = {}", quoted(&s.name))?;
    writeln!(out, "title = {}", quoted(&s.title))?;
    writeln!(out, "description = {}", quoted(&s.description))?;
    writeln!(out, "\n[hub]")?;
    writeln!(out, "mass = \"{:?} kg\"", s.hub.m_b)?;
    writeln!(out, "centre_of_mass = {}", vector(&s.hub.r_bc_b, "m"))?;
    inertia(out, &s.hub.i_b_bc)?;
    writeln!(out, "size = {}", vector(&s.hub_size, "m"))?;
    writeln!(out, "mode = \"{}\"", if s.hub_mode == HubMode::Free { "free" } else { "fixed" })?;
    match s.gravity {
        Gravity::None => {}
        Gravity::Uniform(g) => {
            writeln!(out, "\n[gravity]\nuniform = {}", vector(&g, "m/s^2"))?;
        }
        Gravity::Central { mu } => writeln!(out, "\n[gravity]\ncentral = \"{mu:?} m^3/s^2\"")?,
    }
    if let Some(of) = &s.structure {
        structure::write(out, of)?;
    }
    initial(out, s)?;
    devices(out, s)?;
    for wrench in &s.wrenches {
        applied(out, s, wrench)?;
    }
    for BodyPoint { name, body, position } in &s.points {
        writeln!(out, "\n[[point]]\nname = {}\non = {}", quoted(name), target(s, *body))?;
        writeln!(out, "position = {}", vector(position, "m"))?;
    }
    for of in &s.disturbances {
        source::write(out, s, of)?;
    }
    for of in &s.controllers {
        controller::write(out, s, of)?;
    }
    for change in &s.changes {
        writeln!(out, "\n[[at]]\ntime = \"{:?} s\"", change.time)?;
        writeln!(out, "joint = {}", quoted(&joint_name(s, change.joint)))?;
        match &change.action {
            Action::Brake => writeln!(out, "brake = true")?,
            Action::Release => writeln!(out, "controlled = true")?,
            Action::Drive(of) => drive(out, of, info(s, change.joint))?,
        }
    }
    for crossing in &s.crossings {
        writeln!(out, "\n[[crossing]]\nname = {}", quoted(&crossing.name))?;
        writeln!(out, "column = {}", quoted(&crossing.column))?;
        let unit = crossing.unit.as_str();
        writeln!(out, "value = {}\nends = {}", with_unit(crossing.value, unit), crossing.ends)?;
    }
    settings(out, s)?;
    requirements::requirements(out, s)
}

fn initial(out: &mut String, s: &Scenario) -> Written {
    let state = &s.initial;
    writeln!(out, "\n[initial]\nposition = {}", vector(&state.r_b_n, "m"))?;
    writeln!(out, "velocity = {}", vector(&state.r_b_n_dot, "m/s"))?;
    writeln!(out, "angular_velocity = {}", vector(&state.omega, "rad/s"))?;
    let mut attitude = |key: &str, q: &Quaternion| {
        let numbers = [q.q0, q.q1, q.q2, q.q3];
        writeln!(out, "{key} = {{ quaternion = {numbers:?}, scalar = \"first\" }}")
    };
    attitude("attitude", &state.attitude)?;
    if s.reference == state.attitude { Ok(()) } else { attitude("rotation_from", &s.reference) }
}

fn devices(out: &mut String, s: &Scenario) -> Written {
    let mut joint = 0;
    for (index, (name, member)) in s.members().enumerate() {
        let first = joint;
        joint += member.joints().len();
        let (device, on) = match member {
            Member::Device { device, on } => (device, on),
            Member::Platform { platform, suspension, on } => {
                let of = (platform, suspension, on);
                super::write_platform::platform(out, s, name, of, [index, first])?;
                continue;
            }
        };
        let parameters = device.parameters();
        writeln!(out, "\n[[device]]\nname = {}", quoted(name))?;
        let base = on.and_then(|on| s.names.get(on)).map_or("hub", String::as_str);
        writeln!(out, "on = {}", quoted(base))?;
        writeln!(out, "kind = {}", quoted(device.kind().name()))?;
        writeln!(out, "position = {}", vector(&Vector3::from(parameters.bodies[0].origin), "m"))?;
        if on.is_none() {
            structure::node(out, s, index)?;
        }
        mount(out, &parameters.mount)?;
        let model = match parameters.model {
            ImbalanceModel::Coupled => "coupled",
            ImbalanceModel::Lumped => "lumped",
        };
        writeln!(out, "imbalance_model = \"{model}\"")?;
        let bodies = parameters.bodies.iter().zip(&parameters.passive);
        for (info, (body, passive)) in device.kind().joints().iter().zip(bodies) {
            writeln!(out, "\n[device.{}]", body_key(info))?;
            if has_mass(device.kind(), info) {
                writeln!(out, "mass = \"{:?} kg\"", body.mass)?;
                writeln!(out, "centre_of_mass = {}", vector(&Vector3::from(body.centre), "m"))?;
            }
            if has_inertia(device.kind(), info) {
                inertia(out, &body.inertia)?;
            }
            if has_origin(device.kind(), info) {
                writeln!(out, "origin = {}", vector(&Vector3::from(body.origin), "m"))?;
            }
            of_joint(out, s, first + info.index, (info, passive))?;
        }
    }
    Ok(())
}

pub(super) fn mount(out: &mut String, m: &Matrix3<f64>) -> Written {
    let row = |k: usize| format!("[{:?}, {:?}, {:?}]", m[(k, 0)], m[(k, 1)], m[(k, 2)]);
    writeln!(out, "mount = {{ dcm = [{}, {}, {}] }}", row(0), row(1), row(2))
}

/// The keys of a joint.
pub(super) fn of_joint(
    out: &mut String,
    s: &Scenario,
    joint: usize,
    (info, passive): (&JointInfo, &Passive),
) -> Written {
    let [q, q_dot] = s.initial.devices.states().nth(joint).unwrap_or_default();
    let [unit, rate_unit, ..] = units(info);
    let [coordinate, rate] =
        if info.slides { ["displacement", "speed"] } else { ["angle", "rate"] };
    writeln!(out, "{coordinate} = \"{q:?} {unit}\"\n{rate} = \"{q_dot:?} {rate_unit}\"")?;
    passive_of(out, passive, (info, s.friction_of(joint)))?;
    if let Some(of) = s.drives.get(joint) {
        drive(out, of, Some(info))?;
    }
    for stop in s.stops.iter().filter(|stop| stop.joint == joint) {
        for (key, bound) in [("lower_stop", stop.lower), ("upper_stop", stop.upper)] {
            if bound.is_finite() {
                writeln!(out, "{key} = \"{bound:?} {unit}\"")?;
            }
        }
        let action = if stop.action == StopAction::End { "end" } else { "lock" };
        writeln!(out, "at_stop = \"{action}\"")?;
    }
    Ok(())
}

fn passive_of(
    out: &mut String,
    passive: &Passive,
    (info, friction): (&JointInfo, Option<&JointFriction>),
) -> Written {
    let [unit, rate_unit, _, torque] = units(info);
    let Passive { stiffness, rest, viscous, coulomb, coulomb_rate } = passive;
    writeln!(out, "stiffness = \"{stiffness:?} {torque}/{unit}\"\nrest = \"{rest:?} {unit}\"")?;
    writeln!(out, "damping = \"{viscous:?} {torque} s/{unit}\"")?;
    if let Some(JointFriction { drag, .. }) = friction {
        writeln!(out, "quadratic_drag = \"{drag:?} {torque} s^2/{unit}^2\"")?;
    }
    if let Some(dry) = friction.and_then(|of| of.dry) {
        let DryFriction { static_friction, coulomb, stribeck_rate } = dry;
        writeln!(out, "coulomb = \"{coulomb:?} {torque}\"")?;
        writeln!(out, "static_friction = \"{static_friction:?} {torque}\"")?;
        return writeln!(out, "stribeck_rate = \"{stribeck_rate:?} {rate_unit}\"");
    }
    writeln!(
        out,
        "coulomb = \"{coulomb:?} {torque}\"\ncoulomb_rate = \"{coulomb_rate:?} {rate_unit}\""
    )
}

/// Units of coordinate, rate, acceleration and torque, as a file writes them.
fn units(info: &JointInfo) -> [&'static str; 4] {
    if info.slides { ["m", "m/s", "m/s^2", "N"] } else { ["rad", "rad/s", "rad/s^2", "N m"] }
}

fn info(s: &Scenario, joint: usize) -> Option<&'static JointInfo> {
    s.joints().nth(joint).map(|(_, _, info)| info)
}

fn joint_name(s: &Scenario, joint: usize) -> String {
    let found = s.joints().nth(joint);
    found.map_or_else(String::new, |(_, name, info)| format!("{name}.{}", joint_key(info)))
}

fn drive(out: &mut String, drive: &Drive, info: Option<&JointInfo>) -> Written {
    let slides = info.is_some_and(|info| info.slides);
    let [_, rate_unit, acceleration, torque_unit] =
        info.map_or(["rad", "rad/s", "rad/s^2", "N m"], units);
    let [torque, rate] = if slides { ["force", "speed"] } else { ["torque", "rate"] };
    match drive {
        Drive::Torque { profile, limit } => {
            writeln!(out, "{torque} = {}", of_profile(profile, torque_unit))?;
            let MotorLimits { torque: of_torque, power, rate: of_rate } = limit.unwrap_or_default();
            let limits = [
                (torque, of_torque, torque_unit),
                ("power", power, "W"),
                (rate, of_rate, rate_unit),
            ];
            limits.iter().try_for_each(|(key, limit, unit)| match limit {
                Some(limit) => writeln!(out, "{key}_limit = \"{limit:?} {unit}\""),
                None => Ok(()),
            })
        }
        Drive::Acceleration(profile) => {
            writeln!(out, "acceleration = {}", of_profile(profile, acceleration))
        }
        Drive::Locked => writeln!(out, "locked = true"),
    }
}

/// A profile as a value.
fn of_profile(profile: &Profile, unit: &str) -> String {
    match profile {
        Profile::Constant(value) => format!("\"{value:?} {unit}\""),
        other => format!("{{ {} }}", keys_of(other, unit)),
    }
}

fn keys_of(profile: &Profile, unit: &str) -> String {
    let span = |[from, to]: &[f64; 2]| format!("from = \"{from:?} s\", to = \"{to:?} s\"");
    match profile {
        Profile::Constant(value) => format!("constant = \"{value:?} {unit}\""),
        Profile::Step { at, before, after } => format!(
            "step = \"{after:?} {unit}\", at = \"{at:?} s\", before = \"{before:?} {unit}\""
        ),
        Profile::Ramp { between, values: [a, b] } => {
            format!("ramp = \"{a:?}, {b:?} {unit}\", {}", span(between))
        }
        Profile::Sine { mean, amplitude, frequency, phase } => format!(
            "sine = \"{amplitude:?} {unit}\", frequency = \"{frequency:?} Hz\", \
             phase = \"{phase:?} rad\", mean = \"{mean:?} {unit}\""
        ),
        Profile::Chirp { amplitude, between, frequencies: [a, b] } => format!(
            "chirp = \"{amplitude:?} {unit}\", frequency = \"{a:?}, {b:?} Hz\", {}",
            span(between)
        ),
        Profile::Table(table) => {
            let word = match table.interpolation {
                Interpolation::Hold => "hold",
                Interpolation::Linear => "linear",
            };
            let list = |numbers: &[f64]| {
                numbers.iter().map(|number| format!("{number:?}")).collect::<Vec<_>>().join(", ")
            };
            let (times, values) = (list(&table.times), list(&table.values));
            format!(
                "times = \"{times} s\", values = \"{values} {unit}\", interpolation = \"{word}\""
            )
        }
        Profile::During { between, profile } => {
            format!("{}, {}", keys_of(profile, unit), span(between))
        }
    }
}

fn target(s: &Scenario, body: Target) -> String {
    match body {
        Target::Hub => quoted("hub"),
        Target::Joint(joint) => quoted(&joint_name(s, joint)),
        Target::Node(node) => quoted(structure::node_name(s, node)),
    }
}

fn applied(out: &mut String, s: &Scenario, wrench: &AppliedWrench) -> Written {
    writeln!(out, "\n[[wrench]]\non = {}", target(s, wrench.body))?;
    for (key, three, unit) in [("force", &wrench.force, "N"), ("moment", &wrench.moment, "N m")] {
        let [x, y, z] = three.each_ref().map(|profile| of_profile(profile, unit));
        writeln!(out, "{key} = {{ x = {x}, y = {y}, z = {z} }}")?;
    }
    writeln!(out, "point = {}", vector(&wrench.point, "m"))?;
    let axes = if wrench.axes == WrenchAxes::Body { "body" } else { "inertial" };
    writeln!(out, "axes = \"{axes}\"")
}

fn settings(out: &mut String, s: &Scenario) -> Written {
    writeln!(out, "\n[run]\nduration = \"{:?} s\"", s.settings.duration)?;
    match s.settings.integrator {
        IntegratorChoice::Dop853 { tolerance } => {
            writeln!(out, "integrator = \"dop853\"\ntolerance = {tolerance:?}")?;
        }
        IntegratorChoice::Rk4 { step } => {
            writeln!(out, "integrator = \"rk4\"\nstep = \"{step:?} s\"")?;
        }
    }
    let word = |format: &Format| match format {
        Format::Csv => "\"csv\"",
        Format::Npz => "\"npz\"",
        Format::Parquet => "\"parquet\"",
        Format::Mcap => "\"mcap\"",
    };
    let formats: Vec<_> = s.output.formats.iter().map(word).collect();
    let columns = if s.output.columns.is_empty() {
        Columns::default_groups(s)
    } else {
        s.output.columns.clone()
    };
    let columns: Vec<_> = columns.iter().map(|column| quoted(column)).collect();
    writeln!(out, "\n[output]\nrate = \"{:?} Hz\"", s.output.rate)?;
    writeln!(out, "columns = [{}]\nformats = [{}]", columns.join(", "), formats.join(", "))
}

pub(super) fn inertia(out: &mut String, i: &Matrix3<f64>) -> Written {
    writeln!(out, "inertia = \"{:?}, {:?}, {:?} kg m^2\"", i.m11, i.m22, i.m33)?;
    writeln!(out, "products_of_inertia = \"{:?}, {:?}, {:?} kg m^2\"", i.m12, i.m13, i.m23)
}

pub(super) fn vector(v: &Vector3<f64>, unit: &str) -> String {
    format!("\"{:?}, {:?}, {:?} {unit}\"", v.x, v.y, v.z)
}

fn with_unit(value: f64, unit: &str) -> String {
    quoted(format!("{value:?} {unit}").trim_end())
}

/// A text as TOML writes it.
pub(super) fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}
