//! The file of spacecraft with devices of every kind, and what the engines give for them.
//!
//! `PRECESS_ENGINES_KINDS` in the environment names another file of the same form, which
//! `cargo xtask engines --more` writes.

use std::collections::BTreeMap;
use std::{env, fs};

use precess_dynamics::BuiltInKind;
use serde::Deserialize;

/// Written by `tests/engines/kinds.py`.
const PATH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/kinds.json");

/// The variable that names another file.
const OTHER: &str = "PRECESS_ENGINES_KINDS";

type Triple = [f64; 3];

/// The file.
#[derive(Deserialize)]
pub(crate) struct File {
    pub(crate) engines: Engines,
    pub(crate) spacecraft: Vec<Evaluated>,
    /// Spacecraft of which joints are stopped impulsively.
    pub(crate) stops: Vec<Stop>,
}

/// The versions that gave the values.
#[derive(Deserialize)]
pub(crate) struct Engines {
    pub(crate) pinocchio: String,
    pub(crate) mujoco: String,
}

/// A spacecraft, and what the engines give for it.
#[derive(Deserialize)]
pub(crate) struct Evaluated {
    #[serde(flatten)]
    pub(crate) craft: Craft,
    pub(crate) pinocchio: Pinocchio,
    pub(crate) mujoco: Engine,
}

/// A spacecraft, and its velocities after an impulsive stop by Pinocchio.
#[derive(Deserialize)]
pub(crate) struct Stop {
    #[serde(flatten)]
    pub(crate) craft: Craft,
    pub(crate) pinocchio: Stopped,
}

/// Velocities along B, and the kinetic energy that was lost.
#[derive(Deserialize)]
pub(crate) struct Stopped {
    pub(crate) r_b_n_dot: Triple,
    pub(crate) omega: Triple,
    /// Of each device.
    pub(crate) rates: Vec<Vec<f64>>,
    pub(crate) energy_lost: f64,
}

/// A spacecraft in one state under its inputs.
#[derive(Deserialize)]
pub(crate) struct Craft {
    pub(crate) name: String,
    pub(crate) group: String,
    pub(crate) hub: StoredHub,
    pub(crate) omega: Triple,
    pub(crate) r_b_n_dot: Triple,
    pub(crate) force: Triple,
    pub(crate) torque_b: Triple,
    /// Along B.
    pub(crate) gravity: Triple,
    pub(crate) hub_mode: StoredHubMode,
    pub(crate) devices: Vec<StoredDevice>,
}

#[derive(Deserialize)]
#[expect(clippy::struct_field_names, reason = "the names of `Hub`: frames and points")]
pub(crate) struct StoredHub {
    pub(crate) m_b: f64,
    pub(crate) r_bc_b: Triple,
    pub(crate) i_b: [f64; 6],
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum StoredHubMode {
    Free,
    Fixed,
    Prescribed { r_b_n_ddot: Triple, omega_dot: Triple },
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum StoredMode {
    Driven,
    Locked,
    Prescribed(f64),
}

#[derive(Deserialize)]
pub(crate) struct StoredDevice {
    pub(crate) kind: String,
    /// A quaternion of any length, scalar first.
    pub(crate) mount: [f64; 4],
    pub(crate) joints: Vec<StoredJoint>,
}

/// A joint with its child body, its state and its inputs.
#[derive(Clone, Copy, Deserialize)]
pub(crate) struct StoredJoint {
    pub(crate) origin: Triple,
    pub(crate) mass: f64,
    pub(crate) centre: Triple,
    pub(crate) inertia: [f64; 6],
    pub(crate) coordinate: f64,
    pub(crate) rate: f64,
    pub(crate) motor: f64,
    pub(crate) mode: StoredMode,
    /// Stiffness, coordinate at rest, viscous and Coulomb friction, rate below which that fades.
    #[serde(default)]
    pub(crate) passive: [f64; 5],
    /// Force, and moment about the body's origin.
    #[serde(default)]
    pub(crate) wrench: [f64; 6],
}

/// What both engines give, along B.
#[derive(Deserialize)]
pub(crate) struct Engine {
    pub(crate) r_b_n_ddot: Triple,
    pub(crate) omega_dot: Triple,
    /// Of each device, by the name of the acceleration.
    pub(crate) accelerations: Vec<BTreeMap<String, f64>>,
    pub(crate) energy: f64,
    /// Of gravity with B at the origin, and of springs.
    pub(crate) potential: f64,
    pub(crate) linear: Triple,
    pub(crate) angular_b: Triple,
    /// From B.
    pub(crate) centre_of_mass: Triple,
}

/// What Pinocchio gives.
#[derive(Deserialize)]
pub(crate) struct Pinocchio {
    #[serde(flatten)]
    pub(crate) engine: Engine,
    /// Torque or force of each motor.
    pub(crate) motors: Vec<Vec<f64>>,
    /// Across each joint.
    pub(crate) loads: Vec<Vec<StoredLoad>>,
    /// On a hub that is not free, about B.
    pub(crate) hub_load: Option<StoredHubLoad>,
}

#[derive(Deserialize)]
pub(crate) struct StoredLoad {
    pub(crate) force: Triple,
    pub(crate) moment: Triple,
}

#[derive(Deserialize)]
pub(crate) struct StoredHubLoad {
    pub(crate) hub_force: Triple,
    pub(crate) hub_moment: Triple,
}

impl Craft {
    /// The joints of all devices, in order.
    pub(crate) fn joints(&self) -> impl Iterator<Item = &StoredJoint> {
        self.devices.iter().flat_map(|device| &device.joints)
    }

    /// Whether all numbers of a block of accelerations are given: then they are exact, and say
    /// nothing of rounding.
    pub(crate) fn is_given(&self, block: &str) -> bool {
        if ["r_b_n_ddot", "omega_dot"].contains(&block) {
            return !matches!(self.hub_mode, StoredHubMode::Free);
        }
        let names = self.devices.iter().flat_map(|device| device.kind().joints());
        let of_block = names.zip(self.joints()).filter(|(info, _)| info.acceleration == block);
        let driven: Vec<bool> =
            of_block.map(|(_, joint)| matches!(joint.mode, StoredMode::Driven)).collect();
        !driven.is_empty() && !driven.contains(&true)
    }

    /// Whether a rotor on bearings in a gimbal is free in all six freedoms: every bearing and the spin are
    /// driven, and no bearing has a spring. Real bearings have springs.
    pub(crate) fn has_free_rotor_in_gimbal(&self) -> bool {
        let free = |joint: &StoredJoint| {
            matches!(joint.mode, StoredMode::Driven) && joint.passive[0] == 0.0
        };
        self.devices.iter().any(|device| {
            device.kind() == BuiltInKind::FlexibleVscmg && device.joints.iter().skip(1).all(free)
        })
    }
}

impl StoredDevice {
    pub(crate) fn kind(&self) -> BuiltInKind {
        BuiltInKind::of_name(&self.kind)
            .unwrap_or_else(|| panic!("{} is no built-in kind", self.kind))
    }
}

impl StoredJoint {
    /// Whether the child body is a point mass on which no wrench acts: no moment is transmitted to
    /// it.
    pub(crate) fn takes_no_moment(&self) -> bool {
        // A massless gimbal transmits what the bodies outboard of it take.
        self.mass > 0.0 && self.inertia == [0.0; 6] && self.wrench == [0.0; 6]
    }
}

/// The file as text.
pub(crate) fn text() -> String {
    let path = env::var(OTHER).unwrap_or_else(|_| PATH.to_owned());
    fs::read_to_string(&path).unwrap_or_else(|error| {
        panic!("{path}: {error}; write it with `python tests/engines/kinds.py`")
    })
}

/// The file.
pub(crate) fn file() -> File {
    serde_json::from_str(&text())
        .unwrap_or_else(|error| panic!("no file of `kinds.py`: {error}; write it again"))
}

/// Whether the stored file is read, and no other.
pub(crate) fn is_stored() -> bool {
    env::var_os(OTHER).is_none()
}
