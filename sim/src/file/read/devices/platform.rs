//! `[[platform]]`: isolated platforms, and which devices stand on each.
//!
//! A joint of a platform has the keys of a device's joint. Instead of `stiffness` and `damping` it
//! may have a corner frequency f and a damping ratio zeta, of the platform with the devices on it,
//! on a fixed hub, at the initial coordinates:
//!
//! ```text
//! k = m (2 pi f)²,   c = 2 zeta m 2 pi f
//! ```
//!
//! with m their mass for a slide, and for a turn their moment of inertia about that axis through P,
//! in the platform's axes.

use std::f64::consts::TAU;
use std::path::Path;

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::{JointInfo, Kind};
use precess_dynamics::{
    About, BuiltIn, Hub, Isolated, JointStates, Passive, Platform, Spacecraft, State, platform,
};

use super::body::{Joint, joint, mass};
use super::device::{Device, DeviceOrPlatform, nodes};
use super::inertia::inertia;
use super::joint_measures::JointMeasures;
use super::suspension::suspension;
use crate::file::keys::Keys;
use crate::file::read::structure::Structure;
use crate::file::read::values::mount::rotation_of;
use crate::file::read::values::turns::Mount;
use crate::scenario::{Set, joint_key};
use crate::units::{Measure, Plain};

/// What a joint's spring is given by.
struct Corner {
    /// Hz.
    frequency: f64,
    ratio: f64,
}

/// The devices, and the platforms of `[[platform]]`, in the order of the set.
pub(in crate::file::read) fn with_platforms(
    keys: &Keys<'_>,
    devices: Vec<Device>,
    folder: &Path,
    structure: Option<&Structure>,
) -> Vec<Device> {
    let tables = keys.tables("platform");
    let platforms =
        tables.iter().filter_map(|keys| read(keys, &devices, folder, structure)).collect();
    // Also those in which something is wrong: their devices are not.
    let names: Vec<_> = tables.iter().filter_map(|keys| keys.text("name")).collect();
    arranged(keys, devices, platforms, &names)
}

fn read(
    keys: &Keys<'_>,
    devices: &[Device],
    folder: &Path,
    structure: Option<&Structure>,
) -> Option<Device> {
    if !keys.has("name") {
        keys.missing("name", "name = \"isolator\"");
    }
    if let Some(on) = keys.text("on").filter(|on| *on != "hub") {
        let message = format!("a platform on `{on}`: platforms stand on the hub");
        keys.error("on", message, "remove `on`; on a structure, name its `node`");
    }
    let name = keys.text("name");
    let m_p = mass(keys);
    let r_pc_p = keys.vector("centre_of_mass", Measure::LENGTH).unwrap_or_else(Vector3::zeros);
    let i_p_pc = inertia(keys);
    let node = node(keys, structure);
    let at_node = node.and_then(|node| structure?.position(node));
    let r_p_b = keys.vector("position", Measure::LENGTH).or(at_node);
    let r_p_b = r_p_b.unwrap_or_else(Vector3::zeros);
    let mount = if keys.has("mount") {
        keys.table("mount").and_then(|mount| rotation_of(&mount))
    } else {
        Some(Mount { matrix: Matrix3::identity(), turns: Some(Vec::new()) })
    };
    let infos = <Platform as Kind>::JOINTS;
    let joints: Vec<_> = infos.iter().map(|info| of_joint(keys, info, folder)).collect();
    let suspension = suspension(keys);
    keys.finish();
    let mut joints = joints.into_iter().collect::<Option<Vec<_>>>()?;
    let (name, mount) = (name?.to_owned(), mount?);
    let mut of = Isolated {
        carrier: Platform {
            mount: mount.matrix,
            r_p_b,
            r_pc_p,
            passive: platform::PerJoint::all(Passive::none()),
            ..Platform::bare(m_p?, i_p_pc?)
        },
        suspension: suspension?,
        carried: Vec::<BuiltIn>::new(),
    };
    let corners = joints.iter().zip(infos).filter(|((_, corner), _)| corner.is_some());
    if let Some((_, info)) = corners.into_iter().next() {
        let sizes = sizes(&of, &name, devices);
        // What the solver rejects is reported with the whole, by its own key.
        let rejected = sizes.is_none() && is_rejected(&of, &name, devices);
        let Some(sizes) = sizes.or_else(|| rejected.then_some([0.0; 6])) else {
            let message = format!("the inertia of `{name}` with its devices cannot be computed");
            let help = "give `stiffness` and `damping`";
            keys.error(&joint_key(info), message, help);
            return None;
        };
        for ((joint, corner), size) in joints.iter_mut().zip(sizes) {
            if let Some(Corner { frequency, ratio }) = corner {
                let omega = TAU * *frequency;
                joint.passive.stiffness = size * omega * omega;
                joint.passive.viscous = 2.0 * *ratio * size * omega;
            }
        }
    }
    let passive: Vec<_> = joints.iter().map(|(joint, _)| joint.passive).collect();
    of.carrier.passive = platform::PerJoint::of(<[Passive; 6]>::try_from(passive).ok()?);
    let joints: Vec<Joint> = joints.into_iter().map(|(joint, _)| joint).collect();
    let device =
        Device::new(name, DeviceOrPlatform::Platform(Box::new(of)), mount.turns, "", &joints);
    Some(Device { node, ..device })
}

/// The node of the structure that carries a platform.
fn node(keys: &Keys<'_>, structure: Option<&Structure>) -> Option<usize> {
    match nodes(keys, structure)?[..] {
        [node] => Some(node),
        ref several => {
            let message = format!("{} nodes for a platform", several.len());
            keys.error("node", message, "name one node");
            None
        }
    }
}

/// A joint: `[platform.z_slide]`; nothing acts on one without a table.
fn of_joint(
    keys: &Keys<'_>,
    info: &'static JointInfo,
    folder: &Path,
) -> Option<(Joint, Option<Corner>)> {
    let key = joint_key(info);
    if !keys.has(&key) {
        return Some((Joint::free(), None));
    }
    let table = keys.table(&key)?;
    let corner = corner(&table);
    let found = joint(&table, info, &JointMeasures::of_joint(info), folder);
    table.finish();
    Some((found?, corner?))
}

/// `corner_frequency` and `damping_ratio`; nothing where they are wrong, which has been reported.
#[expect(clippy::option_option, reason = "wrong, none, some")]
fn corner(keys: &Keys<'_>) -> Option<Option<Corner>> {
    let frequency = keys.quantity("corner_frequency", Measure::FREQUENCY);
    let ratio = keys.number("damping_ratio");
    if !keys.has("corner_frequency") {
        if keys.has("damping_ratio") {
            let message = "a damping ratio is of a corner frequency";
            keys.error("damping_ratio", message, "give `corner_frequency`, or `damping` instead");
            return None;
        }
        return Some(None);
    }
    for (key, other) in [("stiffness", "corner_frequency"), ("damping", "damping_ratio")] {
        if keys.has(key) {
            let message = format!("`{}` has `{key}` and `corner_frequency`", keys.path());
            let help = format!("keep `{key}`, or `corner_frequency` with `damping_ratio`");
            keys.error(if keys.has(other) { other } else { "corner_frequency" }, message, &help);
            return None;
        }
    }
    let (frequency, ratio) = (frequency?, ratio.unwrap_or(0.0));
    for (key, value) in [("corner_frequency", frequency), ("damping_ratio", ratio)] {
        if !(value >= 0.0 && value.is_finite()) {
            let message = format!("`{}.{key}` is {}", keys.path(), Plain(value));
            keys.error(key, message, "it is not negative");
            return None;
        }
    }
    Some(Some(Corner { frequency, ratio }))
}

/// Whether the solver rejects a platform or a device on it.
fn is_rejected(of: &Isolated<Vec<BuiltIn>>, name: &str, devices: &[Device]) -> bool {
    let hub = Hub { m_b: 1.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() };
    let own = devices.iter().filter(|device| device.on == name);
    let carried = own.filter_map(Device::built_in).collect();
    Spacecraft::new(&hub, &Isolated { carried, ..of.clone() }).is_err()
}

/// Of a platform with its devices, joints locked: the mass for each slide, and the moments of
/// inertia about the platform's axes through P for the turns.
fn sizes(of: &Isolated<Vec<BuiltIn>>, name: &str, devices: &[Device]) -> Option<[f64; 6]> {
    let Platform { m_p, r_pc_p, i_p_pc, .. } = of.carrier;
    let hub = Hub { m_b: m_p, r_bc_b: r_pc_p, i_b_bc: i_p_pc };
    let own = || devices.iter().filter(|device| device.on == name);
    let carried: Vec<_> = own().filter_map(Device::built_in).collect();
    let spacecraft = Spacecraft::new(&hub, &carried).ok()?;
    let mut state: State<Vec<BuiltIn>> = State::at_rest_for(&spacecraft);
    let given = own().flat_map(|device| device.state.iter());
    for ([own, _], [coordinate, _]) in state.devices.states_mut().zip(given) {
        *own = *coordinate;
    }
    let mut sizes = [spacecraft.mass(); 6];
    for (axis, size) in sizes.iter_mut().skip(3).enumerate() {
        state.omega = Vector3::ith(axis, 1.0);
        *size = spacecraft.momentum(&state, About::InertialOrigin).ok()?.angular[axis];
    }
    Some(sizes)
}

/// Devices and platforms in the order of the set; reports a device on what is no platform.
fn arranged(
    keys: &Keys<'_>,
    devices: Vec<Device>,
    platforms: Vec<Device>,
    names: &[&str],
) -> Vec<Device> {
    let all: Vec<_> = devices.iter().map(|device| device.name.clone()).collect();
    let mut reported = Vec::new();
    for device in &devices {
        // A layout makes several of one table.
        let known = device.on == "hub" || names.contains(&device.on.as_str());
        if known || reported.contains(&device.place) {
            continue;
        }
        let own = device.name == device.on;
        let what = if own {
            format!("`{}` stands on itself", device.on)
        } else if all.contains(&device.on) {
            format!("`{}` is a device: devices stand on the hub and on platforms", device.on)
        } else {
            format!("no platform is named `{}`", device.on)
        };
        let help = match names {
            [] => "add a `[[platform]]` of this name, or remove `on`".to_owned(),
            names => format!("there are {}; without `on` it stands on the hub", names.join(", ")),
        };
        if let Some(place) = &device.place {
            keys.reports().borrow_mut().error(place, what, "", &help);
        }
        reported.push(device.place.clone());
    }
    let (mut arranged, mut rest): (Vec<_>, Vec<_>) =
        devices.into_iter().partition(|device| device.on == "hub");
    for platform in platforms {
        let name = platform.name.clone();
        let node = platform.node;
        arranged.push(platform);
        let (own, others): (Vec<_>, _) =
            rest.into_iter().partition(|device: &Device| device.on == name);
        arranged.extend(own.into_iter().map(|device| Device { node, ..device }));
        rest = others;
    }
    // Of a platform in which something is wrong: their joints are known by name.
    arranged.extend(rest);
    arranged
}

/// The set of arranged devices and platforms.
pub(in crate::file::read) fn set(arranged: &[Device]) -> Set {
    let mut set = Set::default();
    for device in arranged {
        match &device.of {
            DeviceOrPlatform::BuiltIn(own) => match set.1.last_mut() {
                Some(platform) => platform.carried.push(**own),
                None => set.0.push(**own),
            },
            DeviceOrPlatform::Platform(platform) => set.1.push((**platform).clone()),
        }
    }
    set
}
