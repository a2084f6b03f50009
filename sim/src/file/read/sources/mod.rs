//! `[[source]]`: empirical sources of force and torque, by harmonics, spectral densities or records.

mod components;
mod harmonic_table;
mod models;

use std::borrow::Cow;
use std::path::Path;

use nalgebra::{Matrix3, Vector3};

use crate::disturbance::{ALWAYS, Disturbance, JointAxes, Model, SourceTarget};
use crate::file::keys::Keys;
use crate::file::read::devices::device::{Device, DeviceOrPlatform};
use crate::file::read::devices::joints::Joints;
use crate::file::read::structure::Structure;
use crate::file::read::values::mount::rotation_of;
use crate::scenario::Settings;
use crate::units::Measure;
use harmonic_table::harmonics_of_file;
use models::{broadband, harmonics, record};

/// What a source may refer to.
pub(super) struct SourceContext<'a> {
    pub(super) devices: &'a [Device],
    pub(super) joints: &'a Joints,
    pub(super) structure: Option<&'a Structure>,
    pub(super) settings: Option<&'a Settings>,
    pub(super) folder: &'a Path,
}

/// What a table names, or one of the members of the layout that it names.
struct SourceReference<'a> {
    name: Cow<'a, str>,
    on: Option<Cow<'a, str>>,
    wheel: Option<Cow<'a, str>>,
}

/// The sources of a file.
pub(super) fn sources(keys: &Keys<'_>, known: &SourceContext<'_>) -> Vec<Disturbance> {
    keys.tables("source").iter().flat_map(|keys| of_table(keys, known)).collect()
}

/// The sources of one table: one, or one for each member of a layout that its `on` names.
fn of_table(keys: &Keys<'_>, known: &SourceContext<'_>) -> Vec<Disturbance> {
    if !keys.has("name") {
        keys.missing("name", "name = \"bearing\"");
    }
    let name = keys.text("name").unwrap_or_default();
    let [on, wheel] = ["on", "wheel"].map(|key| keys.text(key));
    let layout = on.map(|on| on.split('.').next().unwrap_or(on));
    let members =
        known.devices.iter().filter(|of| of.layout.is_some() && of.layout.as_deref() == layout);
    let members: Vec<&str> = members.map(|of| of.name.as_str()).collect();
    if members.is_empty() {
        let [on, wheel] = [on, wheel].map(|text| text.map(Cow::Borrowed));
        return source(keys, known, &SourceReference { name: Cow::Borrowed(name), on, wheel })
            .into_iter()
            .collect();
    }
    let of_member = |(member, number): (&str, usize)| {
        let own = |text: &str| match text.strip_prefix(layout.unwrap_or_default()) {
            Some(rest) if rest.is_empty() || rest.starts_with('.') => format!("{member}{rest}"),
            _ => text.to_owned(),
        };
        let [on, wheel] = [on, wheel].map(|text| text.map(|text| Cow::Owned(own(text))));
        source(
            keys,
            known,
            &SourceReference { name: Cow::Owned(format!("{name}{number}")), on, wheel },
        )
    };
    members.into_iter().zip(1..).filter_map(of_member).collect()
}

fn source(
    keys: &Keys<'_>,
    known: &SourceContext<'_>,
    named: &SourceReference<'_>,
) -> Option<Disturbance> {
    let name = named.name.as_ref();
    let on = target(keys, known, named.on.as_deref());
    let point = keys.vector("point", Measure::LENGTH).unwrap_or_else(Vector3::zeros);
    let axes = [("x", 0), ("y", 1), ("z", 2)];
    let spin_axis = keys.choice("spin_axis", &axes).unwrap_or(0);
    let named = named.wheel.as_deref().map(|name| known.joints.find(keys, "wheel", name));
    let fundamental_removed = keys.boolean("fundamental_removed").unwrap_or(false);
    let modes_removed = keys.boolean("modes_removed").unwrap_or(false);
    let seed = if keys.has("seed") { Some(keys.count("seed", 0, u32::MAX)?) } else { None };
    let model = model(keys, (name, spin_axis, seed), known);
    let window = window(keys);
    keys.finish();
    let (on, own) = on?;
    let wheel = match named {
        Some(found) => Some(found?),
        None => own,
    };
    Some(Disturbance {
        name: keys.text("name").map(|_| name.to_owned())?,
        on,
        point,
        spin_axis,
        wheel,
        fundamental_removed,
        modes_removed,
        window: window?,
        seed,
        model: model?,
    })
}

/// `from`, `to`: when it acts.
fn window(keys: &Keys<'_>) -> Option<[f64; 2]> {
    let mut window = ALWAYS;
    for (end, key) in window.iter_mut().zip(["from", "to"]) {
        if keys.has(key) {
            *end = keys.quantity(key, Measure::TIME)?;
        }
    }
    Some(window)
}

/// What it exerts: of a name, a spin axis and a seed.
fn model(
    keys: &Keys<'_>,
    of: (&str, usize, Option<u32>),
    known: &SourceContext<'_>,
) -> Option<Model> {
    let kinds = ["harmonic", "harmonics", "broadband", "record"];
    let given: Vec<_> = kinds.into_iter().filter(|kind| keys.has(kind)).collect();
    let &[kind] = given.as_slice() else {
        let message = format!("`{}` is given in {} ways", keys.path(), given.len());
        let help = "give one of `harmonic`, `harmonics`, `broadband`, `record`, and others as sources of their own";
        keys.reports().borrow_mut().error(keys.span(), message, "", help);
        return None;
    };
    match kind {
        "harmonic" => harmonics(keys, of).map(Model::Harmonic),
        "harmonics" => harmonics_of_file(&keys.table(kind)?, of, known.folder).map(Model::Harmonic),
        "broadband" => broadband(&keys.table(kind)?, of.1, known.settings).map(Model::Broadband),
        _ => record(&keys.table(kind)?, of.1, known.folder).map(Model::Measured),
    }
}

/// What it acts on, and the wheel that this has.
fn target(
    keys: &Keys<'_>,
    known: &SourceContext<'_>,
    on: Option<&str>,
) -> Option<(SourceTarget, Option<usize>)> {
    if !keys.has("on") {
        keys.missing("on", "on = \"rw\"");
    }
    let words = [("body", JointAxes::Body), ("parent", JointAxes::Parent)];
    let axes = keys.choice("axes", &words);
    let mount = if keys.has("mount") { Some(matrix(keys)) } else { None };
    let name = on?;
    let of_device = known.devices.iter().position(|device| device.name == name);
    let of_node = || known.structure.filter(|structure| structure.has_node(name));
    let own_axes = |keys: &Keys<'_>| {
        if keys.has("axes") {
            let help = "remove `axes`; `mount` turns them";
            keys.error("axes", "only a body on a joint has `axes`", help);
        }
    };
    if let Some(member) = of_device {
        own_axes(keys);
        no_mount(keys);
        if matches!(known.devices.get(member)?.of, DeviceOrPlatform::Platform(_)) {
            let help = format!("write `on = \"{name}.platform\"`");
            keys.error("on", format!("`{name}` is a platform"), &help);
            return None;
        }
        return Some((SourceTarget::Mount(member), wheel_of(known.devices, member)));
    }
    if let Some(structure) = of_node() {
        own_axes(keys);
        let node = structure.used(name)?;
        return Some((
            SourceTarget::Node { node, axes: mount.unwrap_or(Some(Matrix3::identity()))? },
            None,
        ));
    }
    if name == "hub" {
        own_axes(keys);
        return Some((
            SourceTarget::Hub { axes: mount.unwrap_or(Some(Matrix3::identity()))? },
            None,
        ));
    }
    no_mount(keys);
    let joint = known.joints.find(keys, "on", name)?;
    let is_wheel = known.joints.info(joint)?.body == "wheel";
    let default = if is_wheel { JointAxes::Parent } else { JointAxes::Body };
    let member = member_of(known.devices, joint);
    let wheel = if is_wheel { Some(joint) } else { wheel_of(known.devices, member?) };
    Some((SourceTarget::Joint { joint, axes: axes.unwrap_or(default) }, wheel))
}

fn matrix(keys: &Keys<'_>) -> Option<Matrix3<f64>> {
    let table = keys.table("mount")?;
    let found = rotation_of(&table).map(|mount| mount.matrix);
    table.finish();
    found
}

fn no_mount(keys: &Keys<'_>) {
    if keys.has("mount") {
        let help = "remove `mount`; `spin_axis` says which axis of the data sheet is the wheel's";
        keys.error("mount", "a source on a device has the axes of the device", help);
    }
}

/// The number of the wheel's joint of a device.
fn wheel_of(devices: &[Device], member: usize) -> Option<usize> {
    let first: usize = devices.iter().take(member).map(|device| device.joints().len()).sum();
    let wheel = devices.get(member)?.joints().iter().position(|info| info.body == "wheel")?;
    Some(first + wheel)
}

/// The device or platform of a joint.
fn member_of(devices: &[Device], joint: usize) -> Option<usize> {
    let mut first = 0;
    devices.iter().position(|device| {
        first += device.joints().len();
        joint < first
    })
}
