//! The devices: of any kind, one by one, in a layout, or as a copy turned by half a turn.

use std::path::Path;

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::{BodyParameters, ImbalanceModel, JointInfo, no_inertia};
use precess_dynamics::{BuiltIn, BuiltInKind, DeviceParameters, Imbalance, Parameter, Passive};

use super::super::document::{Node, Value};
use super::super::keys::Keys;
use super::super::load::merged;
use super::body::{Body, Needs, body};
use super::layout::{Place, layout, turned};
use super::mount::{DeviceAxes, mount};
use crate::scenario::{Drive, EndStop, StopAction};
use crate::units::Measure;

/// A device as a file gives it.
pub(super) struct Device {
    pub(super) name: String,
    pub(super) of_kind: BuiltIn,
    /// Coordinate and rate of each joint at the start.
    pub(super) state: Vec<[f64; 2]>,
    drives: Vec<Drive>,
    stops: Vec<Option<([f64; 2], StopAction)>>,
}

/// All joints in order, by name.
pub(super) struct Joints {
    /// `cmg1.inner_gimbal`, and the joint.
    names: Vec<(String, &'static JointInfo)>,
    drives: Vec<Drive>,
    stops: Vec<EndStop>,
}

/// The key of a body: `inner_gimbal`.
pub(crate) fn body_key(joint: &JointInfo) -> String {
    joint.body.replace(' ', "_")
}

impl Joints {
    pub(super) fn of(devices: &[Device]) -> Self {
        let mut joints = Self { names: Vec::new(), drives: Vec::new(), stops: Vec::new() };
        for device in devices {
            let infos = device.of_kind.kind().joints();
            for ((info, drive), stop) in infos.iter().zip(&device.drives).zip(&device.stops) {
                if let Some(([lower, upper], action)) = *stop {
                    let joint = joints.names.len();
                    joints.stops.push(EndStop { joint, lower, upper, action });
                }
                joints.names.push((format!("{}.{}", device.name, body_key(info)), info));
                joints.drives.push(drive.clone());
            }
        }
        joints
    }

    /// The number of a joint by the name of its body; reports where there is none.
    pub(super) fn find(&self, keys: &Keys<'_>, key: &str, name: &str) -> Option<usize> {
        let found = self.names.iter().position(|(known, _)| known == name);
        if found.is_none() {
            let known: Vec<_> = self.names.iter().map(|(name, _)| name.as_str()).collect();
            let help = match known.as_slice() {
                [] => "there is no device".to_owned(),
                known => format!("there are {}", known.join(", ")),
            };
            keys.error(key, format!("no joint is named `{name}`"), &help);
        }
        found
    }

    pub(super) fn info(&self, joint: usize) -> Option<&'static JointInfo> {
        self.names.get(joint).map(|(_, info)| *info)
    }

    pub(super) fn drives_and_stops(self) -> (Vec<Drive>, Vec<EndStop>) {
        (self.drives, self.stops)
    }
}

/// `[[device]]`, in order.
pub(super) fn devices(keys: &Keys<'_>, folder: &Path) -> Vec<Device> {
    let mut devices = Vec::new();
    let Some(node) = keys.node("device") else { return devices };
    let Value::List(list) = &node.value else {
        // Reports what it is instead.
        let _ = keys.tables("device");
        return devices;
    };
    for (index, node) in list.iter().enumerate() {
        let nodes = with_original(node, list, keys);
        let name = nodes.name().map_or_else(|| index.to_string(), str::to_owned);
        if let Some(device) = Keys::new(&nodes, &format!("device.{name}"), keys.reports()) {
            devices.extend(read(&device, &name, folder));
        }
    }
    devices
}

/// A copy with the keys of its original under its own.
fn with_original(node: &Node, list: &[Node], keys: &Keys<'_>) -> Node {
    let Value::Table(table) = &node.value else { return node.clone() };
    let Some(original) = table.text("copy_of") else { return node.clone() };
    let found = list.iter().find(|other| other.name() == Some(original));
    let own =
        |node: &Node| matches!(&node.value, Value::Table(table) if table.get("copy_of").is_none());
    match found {
        Some(found) if own(found) => merged(found, node),
        _ => {
            let message = match found {
                Some(_) => format!("`{original}` is a copy itself"),
                None => format!("no device is named `{original}`"),
            };
            let span = table.get("copy_of").map_or(&node.span, |entry| &entry.node.span);
            let help = "name a device that is no copy";
            keys.reports().borrow_mut().error(span, message, "", help);
            node.clone()
        }
    }
}

/// The devices of one table: one, or those of its layout.
fn read(keys: &Keys<'_>, name: &str, folder: &Path) -> Vec<Device> {
    if keys.text("name").is_none() && !keys.has("name") {
        keys.missing("name", "name = \"wheel1\"");
    }
    let Some(kind) = kind(keys) else { return Vec::new() };
    let infos = kind.joints();
    let (Some(first), Some(last)) = (infos.first(), infos.last()) else { return Vec::new() };
    let axes = DeviceAxes { first: first.axis, last: last.axis, single: infos.len() == 1 };
    let places = keys.has("layout").then(|| layout(keys, axes));
    let position = keys.vector("position", Measure::LENGTH).unwrap_or_else(Vector3::zeros);
    let single = mount(keys, axes).map(|mount| (position, mount));
    // Read where it was merged.
    let is_copy = keys.text("copy_of").is_some();
    let single = if is_copy && keys.has("turned_180_about") {
        single.and_then(|place| turned(keys, "turned_180_about", &place))
    } else {
        single
    };
    let model = model(keys);
    let imbalance = imbalance(keys);
    let bodies: Vec<_> = infos
        .iter()
        .map(|joint| {
            let key = body_key(joint);
            let Some(table) = keys.table(&key) else {
                if !keys.has(&key) {
                    keys.missing(&key, &format!("[device.{key}]"));
                }
                return None;
            };
            let needs = Needs { joint, inertia: has_inertia(kind, joint), first: joint.index == 0 };
            body(&table, needs, folder)
        })
        .collect();
    keys.finish();
    let Some(bodies) = bodies.into_iter().collect::<Option<Vec<_>>>() else { return Vec::new() };
    let parameters = parameters(keys, &bodies, imbalance.as_ref(), model);
    let Some(parameters) = parameters else { return Vec::new() };
    let places = match places {
        Some(places) => places.unwrap_or_default(),
        None => single.into_iter().collect::<Vec<Place>>(),
    };
    let many = keys.has("layout");
    let numbered = places.iter().zip(1..);
    numbered
        .filter_map(|(place, number)| {
            let name = if many { format!("{name}{number}") } else { name.to_owned() };
            device(keys, name, kind, &parameters, &bodies, place)
        })
        .collect()
}

fn kind(keys: &Keys<'_>) -> Option<BuiltInKind> {
    let words: Vec<_> = BuiltInKind::ALL.iter().map(|kind| (kind.name(), *kind)).collect();
    if !keys.has("kind") {
        keys.missing("kind", "kind = \"reaction_wheel\"");
    }
    keys.choice("kind", &words)
}

/// Whether a body of a kind has an inertia: a parameter of it in its unit.
pub(crate) fn has_inertia(kind: BuiltInKind, joint: &JointInfo) -> bool {
    let of_body = |body: Option<&str>| body == Some(joint.body);
    kind.parameters().iter().any(|parameter| of_body(parameter.body) && parameter.unit == "kg m²")
}

/// How the imbalance of a wheel acts.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Model {
    Coupled,
    Lumped,
    Balanced,
}

fn model(keys: &Keys<'_>) -> Model {
    let words =
        [("coupled", Model::Coupled), ("lumped", Model::Lumped), ("balanced", Model::Balanced)];
    keys.choice("imbalance_model", &words).unwrap_or(Model::Coupled)
}

/// The data sheet of a wheel's imbalance.
fn imbalance(keys: &Keys<'_>) -> Option<Imbalance> {
    let sheet = keys.table("imbalance")?;
    let u_s = sheet.quantity("static", Measure::STATIC_IMBALANCE).unwrap_or(0.0);
    let u_d = sheet.quantity("dynamic", Measure::DYNAMIC_IMBALANCE).unwrap_or(0.0);
    let phase = sheet.quantity("phase", Measure::ANGLE).unwrap_or(0.0);
    sheet.finish();
    Some(Imbalance { u_s, u_d, phase })
}

fn parameters(
    keys: &Keys<'_>,
    bodies: &[Body],
    imbalance: Option<&Imbalance>,
    model: Model,
) -> Option<DeviceParameters> {
    let nothing =
        BodyParameters { origin: [0.0; 3], mass: 0.0, centre: [0.0; 3], inertia: no_inertia() };
    let mut parameters = DeviceParameters {
        mount: Matrix3::identity(),
        bodies: [nothing; 3],
        passive: [Passive::none(); 3],
        model: if model == Model::Lumped {
            ImbalanceModel::Lumped
        } else {
            ImbalanceModel::Coupled
        },
    };
    for (to, from) in parameters.bodies.iter_mut().zip(bodies) {
        *to = from.parameters;
    }
    for (to, from) in parameters.passive.iter_mut().zip(bodies) {
        *to = from.passive;
    }
    let wheel = parameters.bodies.get_mut(bodies.len().saturating_sub(1))?;
    if let Some(sheet) = imbalance {
        let products = [wheel.inertia.m12, wheel.inertia.m13];
        if wheel.centre != [0.0; 3] || products != [0.0; 2] {
            let message = "the wheel has an imbalance twice: as a data sheet, and as a centre of \
                           mass or products of inertia 12 or 13";
            keys.error("imbalance", message, "keep one of them");
            return None;
        }
        match sheet.in_wheel(wheel.mass) {
            Ok(found) => {
                wheel.centre[1] = found.d;
                (wheel.inertia.m12, wheel.inertia.m21) = (found.j_12, found.j_12);
                (wheel.inertia.m13, wheel.inertia.m31) = (found.j_13, found.j_13);
            }
            Err(error) => {
                keys.error("imbalance", error.to_string(), "");
                return None;
            }
        }
    }
    if model == Model::Balanced {
        wheel.centre = [0.0; 3];
        wheel.inertia = Matrix3::from_diagonal(&wheel.inertia.diagonal());
    }
    Some(parameters)
}

fn device(
    keys: &Keys<'_>,
    name: String,
    kind: BuiltInKind,
    parameters: &DeviceParameters,
    bodies: &[Body],
    (position, mount): &Place,
) -> Option<Device> {
    let mut parameters = *parameters;
    parameters.mount = *mount;
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
                _ => "take an imbalanced kind, or `imbalance_model = \"coupled\"`",
            };
            keys.error(&key, format!("{kind_name}: {error}", kind_name = kind.name()), help);
            return None;
        }
    };
    Some(Device {
        name,
        of_kind: device,
        state: bodies.iter().map(|body| body.state).collect(),
        drives: bodies.iter().map(|body| body.drive.clone()).collect(),
        stops: bodies.iter().map(|body| body.stop).collect(),
    })
}
