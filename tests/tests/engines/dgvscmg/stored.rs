//! The file of stored values.

use precess_tests::stored::Stored;
use serde::Deserialize;

/// Written by `tests/engines/store.py`.
const PATH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/engines.json");

/// Accelerations of a spacecraft with any number of devices, in the order of `blocks::NAMES`.
pub(crate) type Blocks = [Vec<f64>; 5];

/// The file.
#[derive(Deserialize)]
pub(crate) struct File {
    pub(crate) engines: Engines,
    pub(crate) spacecraft: Vec<Craft>,
}

/// The versions that gave the values.
#[derive(Deserialize)]
pub(crate) struct Engines {
    pub(crate) pinocchio: String,
    pub(crate) mujoco: String,
}

/// A spacecraft in one state, and what the engines give for it.
#[derive(Deserialize)]
pub(crate) struct Craft {
    pub(crate) name: String,
    #[serde(flatten)]
    pub(crate) stored: Stored,
    pub(crate) pinocchio: Pinocchio,
    pub(crate) mujoco: Motion,
}

type Vector3Stored = [f64; 3];

/// What both engines give.
#[derive(Deserialize)]
pub(crate) struct Motion {
    r_b_n_ddot: Vector3Stored,
    omega_dot: Vector3Stored,
    pub(crate) accelerations: Vec<StoredJoints>,
    pub(crate) energy: f64,
}

#[derive(Clone, Copy, Deserialize)]
pub(crate) struct StoredJoints {
    pub(crate) gamma_o_ddot: f64,
    pub(crate) gamma_i_ddot: f64,
    pub(crate) spin_dot: f64,
}

/// What Pinocchio gives, along B.
#[derive(Deserialize)]
pub(crate) struct Pinocchio {
    #[serde(flatten)]
    pub(crate) motion: Motion,
    pub(crate) linear: Vector3Stored,
    pub(crate) angular_b: Vector3Stored,
    /// Outer gimbal, inner gimbal and wheel of every device.
    pub(crate) bodies: Vec<[StoredBody; 3]>,
}

/// A body seen from B and along B; `i_b` is about the point B.
#[derive(Deserialize)]
pub(crate) struct StoredBody {
    pub(crate) r: Vector3Stored,
    pub(crate) r_prime: Vector3Stored,
    pub(crate) r_dprime: Vector3Stored,
    pub(crate) omega_b: Vector3Stored,
    pub(crate) i_b: [f64; 6],
}

/// The file as text.
pub(crate) fn text() -> String {
    std::fs::read_to_string(PATH).unwrap_or_else(|error| {
        panic!("{PATH}: {error}; write it with `python tests/engines/store.py`")
    })
}

/// The file.
pub(crate) fn file() -> File {
    serde_json::from_str(&text()).unwrap_or_else(|error| panic!("{PATH}: {error}"))
}

impl Motion {
    /// The accelerations, block by block.
    pub(crate) fn blocks(&self) -> Blocks {
        let joints = || self.accelerations.iter();
        [
            self.r_b_n_ddot.to_vec(),
            self.omega_dot.to_vec(),
            joints().map(|joint| joint.gamma_o_ddot).collect(),
            joints().map(|joint| joint.gamma_i_ddot).collect(),
            joints().map(|joint| joint.spin_dot).collect(),
        ]
    }
}
