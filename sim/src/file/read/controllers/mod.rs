//! `[[controller]]`: when it samples, what it commands, `law`, `reference`, `allocation`, `servo`; what it reads is in
//! `sensors`.

mod allocation;
mod reference;
mod sensors;

use std::path::Path;

use nalgebra::{Matrix3, Vector3};
use precess_control::{Gyroscopic, MrpGains};
use precess_dynamics::{Quaternion, State, Steered};

use super::devices::device::Device;
use super::devices::inertia::{INERTIA_KEYS, inertia};
use crate::file::document::Value;
use crate::file::keys::Keys;
use crate::file::read::structure::Structure;
use crate::scenario::{
    CommandedJoint, ControlLaw, SampledController, ServoSettings, Set, body_key, steered,
};
use crate::units::Measure;
use allocation::allocation;
use reference::reference;

/// Rate feedback of the servo without a key, in samples.
const SERVO_GAIN: f64 = 0.5;
/// How long a program may take for an answer without a key, s.
const TIME_LIMIT: f64 = 10.0;

/// What the tables of controllers refer to.
struct ControllerContext<'a> {
    devices: &'a [Device],
    structure: Option<&'a Structure>,
    /// The attitude at the start.
    attitude: Quaternion,
    /// Position and velocity at the start, N, m and m/s.
    position: Vector3<f64>,
    velocity: Vector3<f64>,
    /// In which a program runs.
    folder: &'a Path,
}

/// All of a file: of these devices, with this attitude and this state at the start.
pub(super) fn controllers(
    keys: &Keys<'_>,
    (devices, structure): (&[Device], Option<&Structure>),
    (attitude, initial): (Quaternion, &State<Set>),
    folder: &Path,
) -> Vec<SampledController> {
    let (position, velocity) = (initial.r_b_n, initial.r_b_n_dot);
    let known = ControllerContext { devices, structure, attitude, position, velocity, folder };
    keys.tables("controller").iter().filter_map(|keys| controller(keys, &known)).collect()
}

fn controller(keys: &Keys<'_>, known: &ControllerContext<'_>) -> Option<SampledController> {
    if !keys.has("name") {
        keys.missing("name", "name = \"attitude\"");
    }
    let name = keys.text("name");
    let rate = keys.required("rate", Measure::FREQUENCY);
    let offset = keys.quantity("offset", Measure::TIME).unwrap_or(0.0);
    let delay = keys.quantity("delay", Measure::TIME).unwrap_or(0.0);
    let joints = commanded(keys, known.devices);
    let law = required_table(keys, "law", "law = { kind = \"mrp_feedback\" }")
        .and_then(|keys| law(&keys, known.folder));
    let empty = keys.empty();
    let reference = keys.table_or("reference", &empty).and_then(|keys| reference(&keys, known));
    let has_gimbals = joints.iter().flatten().any(|of| of.steered == Steered::Rate);
    let allocation = keys
        .table_or("allocation", &empty)
        .and_then(|keys| allocation(&keys, has_gimbals, known.folder));
    let servo = keys.table_or("servo", &empty).map(|keys| {
        let gain = keys.quantity("gain", Measure::FREQUENCY);
        let own = keys.quantity("rate", Measure::FREQUENCY);
        keys.finish();
        (gain, own)
    });
    let reads = sensors::sensing(keys, known.structure);
    keys.finish();
    let ((gain, servo_rate), rate) = (servo?, rate?);
    let (sensors, filters, estimator, dumping) = reads?;
    let servo = ServoSettings {
        gain: gain.unwrap_or(SERVO_GAIN * servo_rate.unwrap_or(rate)),
        rate: servo_rate,
    };
    Some(SampledController {
        name: name?.to_owned(),
        rate,
        offset,
        delay,
        joints: joints?,
        law: law?,
        reference: reference?,
        allocation: allocation?,
        servo,
        sensors,
        filters,
        estimator,
        dumping,
    })
}

fn required_table<'a>(keys: &Keys<'a>, key: &str, example: &str) -> Option<Keys<'a>> {
    if !keys.has(key) {
        keys.missing(key, example);
    }
    keys.table(key)
}

/// The gimbals and wheels of devices that have a motor.
fn commanded(keys: &Keys<'_>, devices: &[Device]) -> Option<Vec<CommandedJoint>> {
    let names = keys.texts("devices");
    if keys.has("devices") && names.is_none() {
        return None;
    }
    let mut joints = Vec::new();
    let mut first = 0;
    for device in devices {
        let infos = device.joints();
        let chosen = match &names {
            Some(names) => names.contains(&device.name.as_str()),
            None => device.on == "hub",
        };
        let own = infos.iter().enumerate().filter(|_| chosen);
        let own = own.filter_map(|(k, info)| {
            steered(info).map(|steered| CommandedJoint { joint: first + k, steered })
        });
        let before = joints.len();
        joints.extend(own);
        if names.is_some() && chosen && joints.len() == before {
            let bodies: Vec<_> = infos.iter().map(body_key).collect();
            let message = format!("`{}` has no gimbal and no wheel with a motor", device.name);
            let help = format!("its bodies are {}; command other devices", bodies.join(", "));
            keys.error("devices", message, &help);
        }
        first += infos.len();
    }
    for name in names.unwrap_or_default() {
        if !devices.iter().any(|device| device.name == name) {
            let known: Vec<_> = devices.iter().map(|device| device.name.as_str()).collect();
            let help = match known.as_slice() {
                [] => "there is no device".to_owned(),
                known => format!("there are {}", known.join(", ")),
            };
            keys.error("devices", format!("no device is named `{name}`"), &help);
        }
    }
    Some(joints)
}

/// Which law, by its word.
#[derive(Clone, Copy)]
enum LawKind {
    Mrp,
    Quaternion,
    EigenAxis,
    Damping,
    Program,
}

fn law(keys: &Keys<'_>, folder: &Path) -> Option<ControlLaw> {
    let words = [
        ("mrp_feedback", LawKind::Mrp),
        ("quaternion_feedback", LawKind::Quaternion),
        ("eigen_axis", LawKind::EigenAxis),
        ("rate_damping", LawKind::Damping),
        ("program", LawKind::Program),
    ];
    let law = match kind(keys, &words, "mrp_feedback") {
        Some(LawKind::Mrp) => mrp_feedback(keys),
        Some(LawKind::Quaternion) => {
            let attitude = required_diagonal(keys, "attitude_gain", Measure::TORQUE);
            let rate = required_diagonal(keys, "rate_gain", Measure::ANGULAR_MOMENTUM);
            let (tensor, gyroscopic) = (own_inertia(keys), gyroscopic(keys));
            (|| {
                let (attitude, rate, inertia) = (attitude?, rate?, tensor.ok()?);
                Some(ControlLaw::QuaternionFeedback { attitude, rate, inertia, gyroscopic })
            })()
        }
        Some(LawKind::EigenAxis) => {
            let frequency = keys.required("frequency", Measure::FREQUENCY);
            let damping_ratio = keys.required("damping_ratio", Measure::NUMBER);
            let tensor = own_inertia(keys);
            (|| {
                let (frequency, damping_ratio, inertia) =
                    (frequency?, damping_ratio?, tensor.ok()?);
                Some(ControlLaw::EigenAxis { frequency, damping_ratio, inertia })
            })()
        }
        Some(LawKind::Damping) => required_diagonal(keys, "rate_gain", Measure::ANGULAR_MOMENTUM)
            .map(|rate| ControlLaw::RateDamping { rate }),
        Some(LawKind::Program) => {
            if !keys.has("command") {
                keys.missing("command", "command = [\"python3\", \"law.py\"]");
            }
            let command = keys.texts("command");
            let time_limit = keys.quantity("time_limit", Measure::TIME).unwrap_or(TIME_LIMIT);
            let folder = folder.to_owned();
            command.map(|words| ControlLaw::Program {
                command: words.into_iter().map(str::to_owned).collect(),
                folder,
                time_limit,
            })
        }
        // Its keys are not known.
        None => return None,
    };
    keys.finish();
    law
}

fn mrp_feedback(keys: &Keys<'_>) -> Option<ControlLaw> {
    let attitude = keys.required("attitude_gain", Measure::TORQUE);
    let rate = required_diagonal(keys, "rate_gain", Measure::ANGULAR_MOMENTUM);
    let integral = diagonal(keys, "integral_gain", Measure::INVERSE_INERTIA);
    let limit = keys.quantity("integral_limit", Measure::ANGULAR_MOMENTUM);
    if keys.has("integral_gain") && !keys.has("integral_limit") {
        keys.missing("integral_limit", "integral_limit = \"1 N m s\"");
    }
    let (tensor, gyroscopic) = (own_inertia(keys), gyroscopic(keys));
    let gains = MrpGains {
        attitude: attitude?,
        rate: rate?,
        integral: integral.unwrap_or_else(Matrix3::zeros),
        integral_limit: limit.unwrap_or(0.0),
    };
    Some(ControlLaw::MrpFeedback { gains, inertia: tensor.ok()?, gyroscopic })
}

/// A value that is wrong, which has been reported.
struct Wrong;

/// An inertia, where one is stated.
fn own_inertia(keys: &Keys<'_>) -> Result<Option<Matrix3<f64>>, Wrong> {
    let given = INERTIA_KEYS.into_iter().filter(|key| keys.has(key)).count() > 0;
    if given { inertia(keys).map(Some).ok_or(Wrong) } else { Ok(None) }
}

fn gyroscopic(keys: &Keys<'_>) -> Gyroscopic {
    let words = [
        ("whole", Gyroscopic::Whole),
        ("reference", Gyroscopic::Reference),
        ("nothing", Gyroscopic::Nothing),
    ];
    keys.choice("gyroscopic", &words).unwrap_or_default()
}

fn required_diagonal(keys: &Keys<'_>, key: &str, measure: Measure) -> Option<Matrix3<f64>> {
    if !keys.has(key) {
        keys.missing(key, &format!("{key} = \"10 {}\"", measure.usual));
    }
    diagonal(keys, key, measure)
}

fn kind<T: Copy>(keys: &Keys<'_>, of: &[(&str, T)], example: &str) -> Option<T> {
    if !keys.has("kind") {
        keys.missing("kind", &format!("kind = \"{example}\""));
    }
    keys.choice("kind", of)
}

/// A diagonal matrix: one number for all axes, or three.
fn diagonal(keys: &Keys<'_>, key: &str, measure: Measure) -> Option<Matrix3<f64>> {
    let node = keys.node(key)?;
    let one = match &node.value {
        Value::Text(text) => !text.contains(','),
        Value::List(_) => false,
        _ => true,
    };
    if one {
        return keys.quantity(key, measure).map(Matrix3::from_diagonal_element);
    }
    keys.quantities::<3>(key, measure).map(|three| Matrix3::from_diagonal(&Vector3::from(three)))
}
