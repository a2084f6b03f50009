//! What happens over time: `[[at]]`, changes at times, and `[[wrench]]`, wrenches from outside; and `[[point]]`, points
//! of bodies that are recorded.

use std::path::Path;

use nalgebra::Vector3;

use super::structure::Structure;
use crate::file::document::Value;
use crate::file::keys::Keys;
use crate::file::read::devices::body::drive;
use crate::file::read::devices::joint_measures::JointMeasures;
use crate::file::read::devices::joints::Joints;
use crate::file::read::devices::kept_rate::reject_brake;
use crate::file::read::values::drive::profile;
use crate::scenario::{
    Action, AppliedWrench, BodyPoint, Change, Profile, Settings, Target, WrenchAxes,
};
use crate::units::{Measure, Plain};

/// `[[at]]`: `time`, `joint`, and `brake = true`, `controlled = true`, `locked = true`, a `torque`, an `acceleration`;
/// in the order of time.
pub(super) fn changes(
    keys: &Keys<'_>,
    joints: &Joints,
    settings: Option<&Settings>,
    folder: &Path,
) -> Vec<Change> {
    let duration = settings.map_or(f64::INFINITY, |settings| settings.duration);
    let of_table = |keys: &Keys<'_>| change(keys, joints, duration, folder);
    let mut changes: Vec<_> = keys.tables("at").iter().filter_map(of_table).collect();
    changes.sort_by(|a, b| a.time.total_cmp(&b.time));
    changes
}

fn change(keys: &Keys<'_>, joints: &Joints, duration: f64, folder: &Path) -> Option<Change> {
    // A name is only for messages and for overrides.
    let _ = keys.text("name");
    let time = keys.required("time", Measure::TIME);
    if let Some(time) = time.filter(|time| !(0.0..=duration).contains(time)) {
        let [time, duration] = [time, duration].map(Plain);
        let message = format!("`{}.time` is {time} s", keys.path());
        let help = format!("a change is within the run, 0 s to {duration} s");
        keys.error("time", message, &help);
    }
    let joint = joint(keys, "joint", joints);
    let brake = keys.boolean("brake").unwrap_or(false);
    let released = keys.boolean("controlled").unwrap_or(false);
    let info = joints.info(joint?)?;
    let given = ["torque", "force", "acceleration", "locked"].into_iter().find(|key| keys.has(key));
    let drive = drive(keys, info, &JointMeasures::of_joint(info), folder);
    keys.finish();
    if brake && released {
        let message = "a brake locks the joint, and a controller moves it";
        keys.error("controlled", message, "keep one of them");
        return None;
    }
    if brake && !info.driven {
        reject_brake(keys);
    }
    let action = match (brake, given) {
        (true, None) => Action::Brake,
        (false, None) if released => Action::Release,
        (false, Some(key)) if released => {
            keys.error(key, "a controller commands the joint", "remove `controlled`, or this");
            return None;
        }
        (true, Some(key)) => {
            keys.error(key, "a brake stops and locks the joint", "remove `brake`, or this");
            return None;
        }
        (false, Some(_)) => Action::Drive(drive?),
        (false, None) => {
            let help = "give a `torque`, an `acceleration`, `locked = true`, `brake = true` or `controlled = true`";
            let message = format!("`{}` changes nothing", keys.path());
            keys.reports().borrow_mut().error(keys.span(), message, "", help);
            return None;
        }
    };
    Some(Change { time: time?, joint: joint?, action })
}

fn joint(keys: &Keys<'_>, key: &str, joints: &Joints) -> Option<usize> {
    if !keys.has(key) {
        keys.missing(key, &format!("{key} = \"wheel1.wheel\""));
    }
    let name = keys.text(key)?;
    joints.find(keys, key, name)
}

/// `[[wrench]]`: `on`, `force`, `moment`, `point`, `axes`.
pub(super) fn wrenches(
    keys: &Keys<'_>,
    joints: &Joints,
    structure: Option<&Structure>,
    folder: &Path,
) -> Vec<AppliedWrench> {
    let tables = keys.tables("wrench");
    tables.iter().filter_map(|keys| wrench(keys, joints, structure, folder)).collect()
}

fn wrench(
    keys: &Keys<'_>,
    joints: &Joints,
    structure: Option<&Structure>,
    folder: &Path,
) -> Option<AppliedWrench> {
    let _ = keys.text("name");
    if !keys.has("on") {
        keys.missing("on", "on = \"hub\"");
    }
    let body = keys.text("on").and_then(|name| target(keys, name, joints, structure));
    let force = three(keys, "force", Measure::FORCE, folder);
    let moment = three(keys, "moment", Measure::TORQUE, folder);
    let point = keys.vector("point", Measure::LENGTH).unwrap_or_else(Vector3::zeros);
    let words = [("body", WrenchAxes::Body), ("inertial", WrenchAxes::Inertial)];
    let axes = keys.choice("axes", &words).unwrap_or(WrenchAxes::Body);
    if !keys.has("force") && !keys.has("moment") {
        keys.missing("force", "force = \"0, 0, 1 mN\"");
    }
    keys.finish();
    Some(AppliedWrench { body: body?, force: force?, moment: moment?, point, axes })
}

/// The body of a name in `on`: a node, the hub, or the child body of a joint.
fn target(
    keys: &Keys<'_>,
    name: &str,
    joints: &Joints,
    structure: Option<&Structure>,
) -> Option<Target> {
    match name {
        name if structure.is_some_and(|structure| structure.has_node(name)) => {
            structure.and_then(|structure| structure.used(name)).map(Target::Node)
        }
        "hub" => Some(Target::Hub),
        name => joints.find(keys, "on", name).map(Target::Joint),
    }
}

/// `[[point]]`: `name`, `on`, `position`; points whose motion is recorded.
pub(super) fn points(
    keys: &Keys<'_>,
    joints: &Joints,
    structure: Option<&Structure>,
) -> Vec<BodyPoint> {
    let tables = keys.tables("point").into_iter().filter_map(|keys| {
        if !keys.has("name") {
            keys.missing("name", "name = \"accelerometer\"");
        }
        let name = keys.text("name");
        let body = target(&keys, keys.text("on").unwrap_or("hub"), joints, structure);
        let position = keys.vector("position", Measure::LENGTH).unwrap_or_else(Vector3::zeros);
        keys.finish();
        Some(BodyPoint { name: name?.to_owned(), body: body?, position })
    });
    tables.collect()
}

/// Three components: constants as a vector, or profiles by axis:
/// `{ z = { sine = "1 mN", frequency = "3 Hz" } }`.
fn three(keys: &Keys<'_>, key: &str, measure: Measure, folder: &Path) -> Option<[Profile; 3]> {
    let Some(node) = keys.node(key) else { return Some([Profile::ZERO; 3]) };
    let Value::Table(_) = &node.value else {
        return keys.quantities::<3>(key, measure).map(|three| three.map(Profile::Constant));
    };
    let axes = ["x", "y", "z"];
    let table = keys.table(key)?;
    let known: Vec<_> = axes.into_iter().filter(|axis| table.has(axis)).collect();
    if known.is_empty() {
        table.missing("x", "x = { sine = \"1 mN\", frequency = \"3 Hz\" }");
    }
    let profiles = axes.map(|axis| match table.node(axis) {
        Some(node) => profile(&table, axis, node, measure, folder),
        None => Some(Profile::ZERO),
    });
    table.finish();
    let [x, y, z] = profiles;
    Some([x?, y?, z?])
}
