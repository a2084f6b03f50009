//! [`DeviceBodies`]: bodies and joints of a device, with the imbalance of its wheel.

use std::path::Path;

use nalgebra::Matrix3;
use precess_dynamics::kind::{BodyParameters, ImbalanceModel, JointInfo, no_inertia};
use precess_dynamics::{BuiltInKind, DeviceParameters, Imbalance, MAX_JOINTS, Passive};

use super::body::{Body, BodyRequirements, Joint, body};
use super::corner::Corner;
use crate::file::document::Node;
use crate::file::keys::Keys;
use crate::scenario::body_key;
use crate::units::Measure;

/// What the tables of a device's bodies say; its place is not in it.
pub(super) struct DeviceBodies {
    pub(super) parameters: DeviceParameters,
    pub(super) joints: Vec<Joint>,
    /// Of each joint.
    pub(super) corners: Vec<Option<Corner>>,
}

impl DeviceBodies {
    /// Of the table of a device; none where something is wrong, which has been reported.
    pub(super) fn new(keys: &Keys<'_>, kind: BuiltInKind, folder: &Path) -> Option<Self> {
        let model = model(keys);
        let imbalance = imbalance(keys);
        let empty = keys.empty();
        let one = |joint: &'static JointInfo| {
            let key = body_key(joint);
            let (mass, inertia) = (has_mass(kind, joint), has_inertia(kind, joint));
            let needs = BodyRequirements { joint, mass, inertia, origin: has_origin(kind, joint) };
            // Of a link without a body every key has a default.
            let table =
                if mass || inertia { keys.table(&key) } else { keys.table_or(&key, &empty) };
            let Some(table) = table else {
                if !keys.has(&key) {
                    keys.missing(&key, &format!("[device.{key}]"));
                }
                return None;
            };
            body(&table, needs, folder)
        };
        // All of them, so that every error is reported.
        let bodies: Vec<Option<Body>> = kind.joints().iter().map(one).collect();
        let bodies = bodies.into_iter().collect::<Option<Vec<_>>>()?;
        let parameters = parameters(keys, &bodies, imbalance.as_ref(), model)?;
        let (joints, corners) = bodies.into_iter().map(|body| (body.joint, body.corner)).unzip();
        Some(Self { parameters, joints, corners })
    }

    /// Of a member of a layout, whose own keys are over those of the layout.
    pub(super) fn of_member(
        keys: &Keys<'_>,
        member: &Node,
        kind: BuiltInKind,
        folder: &Path,
    ) -> Option<Self> {
        let node = keys.with(member);
        let path = format!("device.{}", member.name().unwrap_or_default());
        Self::new(&Keys::new(&node, &path, keys.reports())?, kind, folder)
    }
}

/// Whether a body of a kind has an inertia.
pub(crate) fn has_inertia(kind: BuiltInKind, joint: &JointInfo) -> bool {
    has(kind, joint, "kg m²")
}

/// Whether a link of a kind has a body: those of flexible bearings have none.
pub(crate) fn has_mass(kind: BuiltInKind, joint: &JointInfo) -> bool {
    has(kind, joint, "kg")
}

/// Whether the table of a link has the origin of its joint. The first one's is the device's position; of links
/// without a body only one in a body, as the bearings of a wheel in a gimbal are, has one.
pub(crate) fn has_origin(kind: BuiltInKind, joint: &JointInfo) -> bool {
    joint.index > 0 && (has_mass(kind, joint) || has(kind, joint, "m"))
}

/// Whether a body has a parameter in a unit.
fn has(kind: BuiltInKind, joint: &JointInfo, unit: &str) -> bool {
    let of_body = |body: Option<&str>| body == Some(joint.body);
    kind.parameters().iter().any(|parameter| of_body(parameter.body) && parameter.unit == unit)
}

/// The largest usual distance of a wheel's centre of mass from its spin axis, m; beyond it, a warning.
const OFFSET_USUAL: f64 = 1e-3;

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
        bodies: [nothing; MAX_JOINTS],
        passive: [Passive::none(); MAX_JOINTS],
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
        *to = from.joint.passive;
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
                if found.d.abs() > OFFSET_USUAL {
                    let message = format!(
                        "the imbalance puts the wheel's centre of mass {} mm off its spin axis",
                        1e3 * found.d.abs()
                    );
                    keys.warn(
                        "imbalance",
                        message,
                        "of a wheel it is micrometres; is the unit right?",
                    );
                }
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
