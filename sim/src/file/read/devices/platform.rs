//! `[[platform]]`: isolated platforms.
//!
//! A joint of a platform has the keys of a device's joint. Instead of `stiffness` and `damping` it
//! may have a corner frequency f and a damping ratio zeta, of the platform with all that stands on it,
//! on a fixed base, at the initial coordinates:
//!
//! ```text
//! k = m (2 pi f)²,   c = 2 zeta m 2 pi f
//! ```
//!
//! with m their mass for a slide, and for a turn their moment of inertia about that axis through P,
//! in the platform's axes.

use std::path::Path;

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::{Each, JointInfo, Kind};
use precess_dynamics::{About, Hub, JointStates, Passive, Platform, State, platform};

use super::arrangement::{arranged, standing_on};
use super::body::{Joint, joint, mass};
use super::corner::{Corner, corner};
use super::device::{Device, DeviceOrPlatform, nodes, none_of_its_own};
use super::inertia::inertia;
use super::joint_measures::JointMeasures;
use super::rows::set_on;
use super::springs::springs_of_devices;
use super::suspension::suspension;
use crate::file::keys::Keys;
use crate::file::read::structure::Structure;
use crate::file::read::values::mount::rotation_of;
use crate::file::read::values::turns::Mount;
use crate::scenario::{Set, joint_key};
use crate::units::Measure;

/// Those of the joints of a platform, in order.
type Corners = Vec<Option<Corner>>;

/// The devices, and the platforms of `[[platform]]`, in the order of the set.
pub(in crate::file::read) fn with_platforms(
    keys: &Keys<'_>,
    devices: Vec<Device>,
    folder: &Path,
    structure: Option<&Structure>,
) -> Vec<Device> {
    let tables = keys.tables("platform");
    let read = tables.iter().filter_map(|keys| Some((keys, read(keys, folder, structure)?)));
    let (mut platforms, mut corners) = (Vec::new(), Vec::new());
    for (keys, (platform, of_joints)) in read {
        corners.push((keys, platform.name.clone(), of_joints));
        platforms.push(platform);
    }
    let mut arranged = arranged(keys, devices, platforms, &tables);
    springs_of_devices(keys, &mut arranged);
    for (keys, name, corners) in corners {
        spring(keys, &mut arranged, &name, &corners);
    }
    arranged
}

fn read(
    keys: &Keys<'_>,
    folder: &Path,
    structure: Option<&Structure>,
) -> Option<(Device, Corners)> {
    if !keys.has("name") {
        keys.missing("name", "name = \"isolator\"");
    }
    let on = keys.text("on").unwrap_or("hub");
    let name = keys.text("name");
    let m_p = mass(keys);
    let r_pc_p = keys.vector("centre_of_mass", Measure::LENGTH).unwrap_or_else(Vector3::zeros);
    let i_p_pc = inertia(keys);
    let node =
        if on == "hub" { node(keys, structure) } else { none_of_its_own(keys, "platform", on) };
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
    let joints = joints.into_iter().collect::<Option<Vec<_>>>()?;
    let (name, mount) = (name?.to_owned(), mount?);
    let (joints, corners): (Vec<Joint>, Corners) = joints.into_iter().unzip();
    let passive: Vec<_> = joints.iter().map(|joint| joint.passive).collect();
    let platform = Platform {
        mount: mount.matrix,
        r_p_b,
        r_pc_p,
        passive: platform::PerJoint::of(<[Passive; 6]>::try_from(passive).ok()?),
        ..Platform::bare(m_p?, i_p_pc?)
    };
    let of = DeviceOrPlatform::Platform(Box::new((platform, suspension?)));
    let device = Device::new(name, of, mount.turns, on, &joints);
    Some((Device { node, ..device }, corners))
}

/// Springs and dampers of the joints of a platform that have a corner frequency.
fn spring(keys: &Keys<'_>, arranged: &mut [Device], name: &str, corners: &[Option<Corner>]) {
    let infos = <Platform as Kind>::JOINTS;
    let Some((_, info)) = corners.iter().zip(infos).find(|(corner, _)| corner.is_some()) else {
        return;
    };
    let is_own = |device: &Device| device.name == name && device.built_in().is_none();
    let Some(place) = arranged.iter().position(is_own) else { return };
    let Some((device, rest)) = arranged.get_mut(place..).and_then(<[Device]>::split_first_mut)
    else {
        return;
    };
    let DeviceOrPlatform::Platform(of) = &mut device.of else { return };
    let carried = standing_on(name, rest);
    let Some(sizes) = sizes(&of.0, name, carried) else {
        // What the solver rejects is reported with the whole, by its own key.
        if !is_rejected(device, carried) {
            let message = format!("the inertia of `{name}` with its devices cannot be computed");
            let help = "give `stiffness` and `damping`";
            keys.error(&joint_key(info), message, help);
        }
        return;
    };
    for ((passive, corner), size) in of.0.passive.values_mut().zip(corners).zip(sizes) {
        if let Some(corner) = corner {
            corner.act(passive, size);
        }
    }
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

/// Whether the solver rejects a platform or what stands on it.
fn is_rejected(platform: &Device, carried: &[Device]) -> bool {
    let hub = Hub { m_b: 1.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() };
    let all = std::iter::once(platform).chain(carried);
    precess_craft::spacecraft(&hub, &set_on(&platform.on, all)).is_err()
}

/// Of a platform with what stands on it, joints locked: the mass for each slide, and the moments of
/// inertia about the platform's axes through P for the turns.
fn sizes(of: &Platform, name: &str, carried: &[Device]) -> Option<[f64; 6]> {
    let Platform { m_p, r_pc_p, i_p_pc, .. } = *of;
    let hub = Hub { m_b: m_p, r_bc_b: r_pc_p, i_b_bc: i_p_pc };
    let spacecraft = precess_craft::spacecraft(&hub, &set_on(name, carried)).ok()?;
    let mut state: State<Set> = State::at_rest_for(&spacecraft);
    let given = carried.iter().flat_map(|device| device.state.iter());
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
