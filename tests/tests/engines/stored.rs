//! The file of stored values, and its spacecraft as solver and reference take them.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::dgvscmg::{Joints, MotorTorques, PerJoint};
use precess_dynamics::generated::dgvscmg;
use precess_dynamics::{
    Attitude, Dgvscmg, Hub, ImbalanceModel, Inputs, Passive, Quaternion, State,
};
use precess_tests::case::Case;
use serde::Deserialize;

/// Written by `tests/engines/store.py`.
const PATH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/engines.json");

/// B's axes are N's in another order. The rotation is exact, so it adds no rounding, and a vector
/// taken along the wrong axes shows.
pub(crate) const ATTITUDE: Quaternion = Quaternion { q0: 0.5, q1: 0.5, q2: 0.5, q3: 0.5 };

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
    hub: StoredHub,
    pub(crate) devices: Vec<Device>,
    omega: Vector3Stored,
    r_b_n_dot: Vector3Stored,
    force: Vector3Stored,
    torque_b: Vector3Stored,
    pub(crate) pinocchio: Pinocchio,
    pub(crate) mujoco: Motion,
}

type Vector3Stored = [f64; 3];

#[derive(Deserialize)]
#[expect(
    clippy::struct_field_names,
    reason = "the names of `Hub`: frames and points are the paper's"
)]
struct StoredHub {
    m_b: f64,
    r_bc_b: Vector3Stored,
    i_b: [f64; 6],
}

/// One device: the kernel's own parameters, with `r_go_b` along the device's axes.
#[derive(Clone, Copy, Deserialize)]
pub(crate) struct Device {
    mount: [[f64; 3]; 3],
    #[serde(with = "Parameters")]
    pub(crate) parameters: dgvscmg::Parameters<f64>,
    pub(crate) angles: Angles,
    #[serde(with = "Rates")]
    pub(crate) rates: dgvscmg::Rates<f64>,
    #[serde(with = "Motors")]
    motors: dgvscmg::Motors<f64>,
}

#[derive(Clone, Copy, Deserialize)]
pub(crate) struct Angles {
    pub(crate) gamma_o: f64,
    pub(crate) gamma_i: f64,
    pub(crate) theta: f64,
}

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

impl Craft {
    /// The spacecraft away from N's origin, turned by [`ATTITUDE`].
    pub(crate) fn case<const N: usize>(&self) -> Case<N> {
        let devices = || self.devices.iter().copied();
        Case {
            hub: Hub {
                m_b: self.hub.m_b,
                r_bc_b: self.hub.r_bc_b.into(),
                i_b_bc: symmetric(self.hub.i_b),
            },
            devices: array(devices().map(Device::dgvscmg)),
            state: State {
                r_b_n: Vector3::new(3.0, -2.0, 1.0),
                r_b_n_dot: ATTITUDE.dcm().transpose() * Vector3::from(self.r_b_n_dot),
                attitude: ATTITUDE,
                omega: self.omega.into(),
                devices: array(devices().map(Device::joints)),
            },
            inputs: Inputs {
                force: self.force.into(),
                torque_b: self.torque_b.into(),
                motors: array(devices().map(|Device { motors, .. }| MotorTorques {
                    u_o: motors.u_o,
                    u_i: motors.u_i,
                    u_w: motors.u_w,
                })),
                ..Inputs::none()
            },
        }
    }
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

impl Device {
    /// Columns: the device's axes at zero angle, along B.
    pub(crate) fn mount(&self) -> Matrix3<f64> {
        let [x, y, z] = self.mount.map(|row| Vector3::from(row).transpose());
        Matrix3::from_rows(&[x, y, z])
    }

    fn joints(self) -> Joints {
        let Angles { gamma_o, gamma_i, theta } = self.angles;
        let dgvscmg::Rates { gamma_o_dot, gamma_i_dot, spin } = self.rates;
        Joints { gamma_o, gamma_i, theta, gamma_o_dot, gamma_i_dot, spin }
    }

    fn dgvscmg(self) -> Dgvscmg {
        let p = self.parameters;
        Dgvscmg {
            mount: self.mount(),
            r_go_b: self.mount() * Vector3::new(p.r_go_b_bx, p.r_go_b_by, p.r_go_b_bz),
            m_go: p.m_go,
            r_goc_go: Vector3::new(p.r_goc_go_gox, p.r_goc_go_goy, p.r_goc_go_goz),
            i_go_goc: symmetric([p.i_go_11, p.i_go_12, p.i_go_13, p.i_go_22, p.i_go_23, p.i_go_33]),
            l_o: Vector3::new(p.l_o_x, p.l_o_y, p.l_o_z),
            m_gi: p.m_gi,
            r_gic_gi: Vector3::new(p.r_gic_gi_gix, p.r_gic_gi_giy, p.r_gic_gi_giz),
            i_gi_gic: symmetric([p.i_gi_11, p.i_gi_12, p.i_gi_13, p.i_gi_22, p.i_gi_23, p.i_gi_33]),
            l_i: Vector3::new(p.l_i_x, p.l_i_y, p.l_i_z),
            m_w: p.m_w,
            d: p.d,
            i_w_wc: symmetric([p.j_11, p.j_12, p.j_13, p.j_22, p.j_23, p.j_33]),
            passive: PerJoint::all(Passive::none()),
            model: ImbalanceModel::Coupled,
        }
    }
}

/// A tensor from its entries 11, 12, 13, 22, 23, 33.
pub(crate) fn symmetric([xx, xy, xz, yy, yz, zz]: [f64; 6]) -> Matrix3<f64> {
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}

fn array<const N: usize, T>(items: impl Iterator<Item = T>) -> [T; N] {
    let items: Vec<T> = items.collect();
    items.try_into().unwrap_or_else(|items: Vec<T>| panic!("{} devices, not {N}", items.len()))
}

/// The generated parameters, field by field, for serde.
#[derive(Deserialize)]
#[serde(remote = "dgvscmg::Parameters::<f64>")]
struct Parameters {
    r_go_b_bx: f64,
    r_go_b_by: f64,
    r_go_b_bz: f64,
    r_goc_go_gox: f64,
    r_goc_go_goy: f64,
    r_goc_go_goz: f64,
    m_go: f64,
    i_go_11: f64,
    i_go_12: f64,
    i_go_13: f64,
    i_go_22: f64,
    i_go_23: f64,
    i_go_33: f64,
    l_o_x: f64,
    l_o_y: f64,
    l_o_z: f64,
    r_gic_gi_gix: f64,
    r_gic_gi_giy: f64,
    r_gic_gi_giz: f64,
    m_gi: f64,
    i_gi_11: f64,
    i_gi_12: f64,
    i_gi_13: f64,
    i_gi_22: f64,
    i_gi_23: f64,
    i_gi_33: f64,
    l_i_x: f64,
    l_i_y: f64,
    l_i_z: f64,
    d: f64,
    m_w: f64,
    j_11: f64,
    j_12: f64,
    j_13: f64,
    j_22: f64,
    j_23: f64,
    j_33: f64,
}

/// The generated rates, likewise.
#[derive(Deserialize)]
#[serde(remote = "dgvscmg::Rates::<f64>")]
struct Rates {
    gamma_o_dot: f64,
    gamma_i_dot: f64,
    spin: f64,
}

/// The generated motor torques, likewise.
#[derive(Deserialize)]
#[serde(remote = "dgvscmg::Motors::<f64>")]
#[expect(clippy::struct_field_names, reason = "the names of the generated fields")]
struct Motors {
    u_o: f64,
    u_i: f64,
    u_w: f64,
}
