//! The devices: of any kind, one by one, in a layout, or as a copy turned by half a turn.

use std::path::Path;

use nalgebra::Vector3;
use precess_description::Turn;
use precess_dynamics::kind::{JointInfo, Kind};
use precess_dynamics::{BuiltIn, BuiltInKind, Parameter, Platform, Suspension};

use super::body::Joint;
use super::copies::{help_of_copy, original, with_original};
use super::corner::Corner;
use super::device_bodies::DeviceBodies;
use super::layout::{MountedPosition, layout, turned};
use super::layout_members::members;
use crate::file::diagnostic::Span;
use crate::file::document::Value;
use crate::file::keys::{Keys, shown_name};
use crate::file::read::structure::Structure;
use crate::file::read::values::mount::{DeviceAxes, mount};
use crate::scenario::{Drive, JointFriction, StopAction};
use crate::units::Measure;

/// A device of a kind, or a platform with its suspension, without what stands on it.
pub(in crate::file::read) enum DeviceOrPlatform {
    BuiltIn(Box<BuiltIn>),
    Platform(Box<(Platform, Suspension)>),
}

/// A device or a platform as a file gives it.
pub(in crate::file::read) struct Device {
    pub(in crate::file::read) name: String,
    /// The name of the layout that it is a member of.
    pub(in crate::file::read) layout: Option<String>,
    pub(in crate::file::read) of: DeviceOrPlatform,
    /// The name of the platform or panel that it stands on, or `hub`.
    pub(in crate::file::read) on: String,
    /// Where that is written.
    pub(in crate::file::read) place: Option<Span>,
    /// Those of its mount, where it is written as turns.
    pub(in crate::file::read) turns: Option<Vec<Turn>>,
    /// The node of the structure that carries it.
    pub(in crate::file::read) node: Option<usize>,
    /// Coordinate and rate of each joint at the start.
    pub(in crate::file::read) state: Vec<[f64; 2]>,
    pub(in crate::file::read) drives: Vec<Drive>,
    pub(in crate::file::read) stops: Vec<Option<([f64; 2], StopAction)>>,
    pub(in crate::file::read) friction: Vec<Option<JointFriction>>,
    /// Of each joint of a device what gives its spring; empty of a platform.
    pub(super) corners: Vec<Option<Corner>>,
}

impl Device {
    /// From what its joints say.
    pub(in crate::file::read) fn new(
        name: String,
        of: DeviceOrPlatform,
        turns: Option<Vec<Turn>>,
        on: &str,
        joints: &[Joint],
    ) -> Self {
        Self {
            name,
            layout: None,
            of,
            on: on.to_owned(),
            place: None,
            turns,
            node: None,
            state: joints.iter().map(|joint| joint.state).collect(),
            drives: joints.iter().map(|joint| joint.drive.clone()).collect(),
            stops: joints.iter().map(|joint| joint.stop).collect(),
            friction: joints.iter().map(|joint| joint.friction).collect(),
            corners: Vec::new(),
        }
    }

    /// The device; none of a platform.
    pub(in crate::file::read) fn built_in(&self) -> Option<BuiltIn> {
        match &self.of {
            DeviceOrPlatform::BuiltIn(device) => Some(**device),
            DeviceOrPlatform::Platform(_) => None,
        }
    }

    /// Whether it is a hinged panel, on which devices may stand.
    pub(super) fn is_panel(&self) -> bool {
        matches!(&self.of, DeviceOrPlatform::BuiltIn(of) if of.kind() == BuiltInKind::HingedPanel)
    }

    pub(in crate::file::read) fn joints(&self) -> &'static [JointInfo] {
        match &self.of {
            DeviceOrPlatform::BuiltIn(device) => device.kind().joints(),
            DeviceOrPlatform::Platform(_) => <Platform as Kind>::JOINTS,
        }
    }
}

/// `[[device]]`, in order.
pub(in crate::file::read) fn devices(
    keys: &Keys<'_>,
    folder: &Path,
    structure: Option<&Structure>,
) -> Vec<Device> {
    let mut devices = Vec::new();
    let Some(node) = keys.node("device") else { return devices };
    let Value::List(list) = &node.value else {
        // Reports what it is instead.
        let _ = keys.tables("device");
        return devices;
    };
    keys.check_names("device", list);
    for (index, node) in list.iter().enumerate() {
        let nodes = with_original(node, list, keys);
        let name = nodes.name().map_or_else(|| index.to_string(), str::to_owned);
        let path = format!("device.{}", shown_name(&name));
        if let Some(device) = Keys::new(&nodes, &path, keys.reports()) {
            let first = keys.reports().borrow().all.len();
            devices.extend(read(&device, &name, folder, structure));
            if let Some(original) = original(node) {
                keys.reports().borrow_mut().add_help(first, &help_of_copy(original));
            }
        }
    }
    devices
}

/// The devices of one table: one, or those of its layout.
fn read(keys: &Keys<'_>, name: &str, folder: &Path, structure: Option<&Structure>) -> Vec<Device> {
    if keys.text("name").is_none() && !keys.has("name") {
        keys.missing("name", "name = \"wheel1\"");
    }
    let Some(kind) = kind(keys) else { return Vec::new() };
    let infos = kind.joints();
    let (Some(first), Some(last)) = (infos.first(), infos.last()) else { return Vec::new() };
    let single = first.axis == last.axis;
    let axes = DeviceAxes { first: first.axis, last: last.axis, single };
    let places = keys.has("layout").then(|| layout(keys, axes));
    let on = keys.text("on").unwrap_or("hub");
    let nodes =
        if on == "hub" { nodes(keys, structure) } else { none_of_its_own(keys, "device", on) };
    let at_node = nodes.as_ref().and_then(|on| structure?.position(*on.first()?));
    let position = keys.vector("position", Measure::LENGTH).or(at_node);
    let position = position.unwrap_or_else(Vector3::zeros);
    let single = mount(keys, axes).map(|mount| (position, mount));
    // Read where it was merged.
    let is_copy = keys.text("copy_of").is_some();
    let single = if is_copy && keys.has("turned_180_about") {
        single.and_then(|place| turned(keys, "turned_180_about", &place))
    } else {
        single
    };
    let common = DeviceBodies::new(keys, kind, folder);
    let places = match places {
        Some(places) => places.unwrap_or_default(),
        None => single.into_iter().collect::<Vec<MountedPosition>>(),
    };
    let many = keys.has("layout");
    let names: Vec<String> = (1..=places.len())
        .map(|number| if many { format!("{name}{number}") } else { name.to_owned() })
        .collect();
    let members = members(keys, kind, if many { &names } else { &[] });
    keys.finish();
    let Some(common) = common else { return Vec::new() };
    if let Some(nodes) = nodes.as_ref().filter(|on| on.len() > 1 && on.len() != places.len()) {
        let message = format!("{} nodes for {} devices", nodes.len(), places.len());
        keys.error("node", message, "name one node, or one for each device of the layout");
        return Vec::new();
    }
    let named = places.iter().zip(names).enumerate();
    named
        .filter_map(|(index, (place, own))| {
            let member = members.iter().find(|member| member.name() == Some(&own));
            let bodies = match member {
                Some(member) => &DeviceBodies::of_member(keys, member, kind, folder)?,
                None => &common,
            };
            let mut device = device(keys, own, kind, bodies, place)?;
            device.layout = many.then(|| name.to_owned());
            device.node = nodes.as_ref().and_then(|on| on.get(index).or(on.first())).copied();
            device.place = Some(keys.place("on"));
            on.clone_into(&mut device.on);
            Some(device)
        })
        .collect()
}

/// Of a device or platform on a platform or panel, which has the node of both.
pub(super) fn none_of_its_own<T>(keys: &Keys<'_>, what: &str, base: &str) -> Option<T> {
    if keys.has("node") {
        let message = format!("a {what} on `{base}` has the node of `{base}`");
        keys.error("node", message, &format!("remove `node` here; give it to `{base}`"));
    }
    None
}

/// `node`: the node of the structure that carries the device, or one for each of a layout.
pub(in crate::file::read) fn nodes(
    keys: &Keys<'_>,
    structure: Option<&Structure>,
) -> Option<Vec<usize>> {
    let Some(structure) = structure else {
        if keys.has("node") {
            let help = "add `[structure]`, or remove `node`";
            keys.error("node", "a rigid hub has no nodes", help);
        }
        return None;
    };
    if !keys.has("node") {
        keys.missing("node", &format!("node = \"{}\"", structure.an_example()));
        return None;
    }
    let names = keys.texts("node")?;
    let found: Option<Vec<_>> =
        names.into_iter().map(|name| structure.node(keys, "node", name)).collect();
    found.filter(|found| !found.is_empty())
}

fn kind(keys: &Keys<'_>) -> Option<BuiltInKind> {
    let words: Vec<_> = BuiltInKind::ALL.iter().map(|kind| (kind.name(), *kind)).collect();
    if !keys.has("kind") {
        keys.missing("kind", "kind = \"reaction_wheel\"");
    }
    keys.choice("kind", &words)
}

fn device(
    keys: &Keys<'_>,
    name: String,
    kind: BuiltInKind,
    bodies: &DeviceBodies,
    (position, mount): &MountedPosition,
) -> Option<Device> {
    let mut parameters = bodies.parameters;
    parameters.mount = mount.matrix;
    parameters.bodies[0].origin = (*position).into();
    let device = match BuiltIn::new(kind, &parameters) {
        Ok(device) => device,
        Err(error) => {
            let key = error.body.replace(' ', "_");
            let help = match error.parameter {
                Some(Parameter::CentreOfMass) => {
                    "the wheel's centre of mass is along its y axis; a balanced kind has none"
                }
                Some(Parameter::Inertia) => {
                    "a balanced rotor has equal transverse moments and no products"
                }
                Some(Parameter::Origin) => "the wheel is at the centre of its bearings",
                _ => "take an imbalanced kind, or `imbalance_model = \"coupled\"`",
            };
            keys.error(&key, format!("{kind_name}: {error}", kind_name = kind.name()), help);
            return None;
        }
    };
    let of = DeviceOrPlatform::BuiltIn(Box::new(device));
    let device = Device::new(name, of, mount.turns.clone(), "hub", &bodies.joints);
    Some(Device { corners: bodies.corners.clone(), ..device })
}
