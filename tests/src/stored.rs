//! Spacecraft as files hold them for programs in every language: hub, devices, motion, forces.
//!
//! The scripts of the engines and of the peers write them; `tests/engines/README.md` has the
//! conventions. Position and attitude are in no file, since no acceleration depends on them.

use std::path::{Path, PathBuf};
use std::{fmt, io};

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::dgvscmg::PerJoint;
use precess_dynamics::generated::dgvscmg::{Motors, Parameters, Rates};
use precess_dynamics::kind::{Each, JointStates};
use precess_dynamics::{
    Attitude, Devices, Dgvscmg, Hub, ImbalanceModel, Inputs, Passive, Quaternion, State,
};
use serde::Deserialize;

use crate::case::{Case, Set};

/// B's axes are N's in another order. The rotation is exact, so it adds no rounding, and a vector
/// taken along the wrong axes shows.
pub const ATTITUDE: Quaternion = Quaternion { q0: 0.5, q1: 0.5, q2: 0.5, q3: 0.5 };

/// A spacecraft with DGVSCMGs in one state under known forces.
#[derive(Clone, Debug, Deserialize)]
pub struct Stored {
    hub: StoredHub,
    /// The devices.
    pub devices: Vec<StoredDevice>,
    omega: [f64; 3],
    r_b_n_dot: [f64; 3],
    force: [f64; 3],
    torque_b: [f64; 3],
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[expect(
    clippy::struct_field_names,
    reason = "the names of `Hub`: frames and points are the paper's"
)]
pub(crate) struct StoredHub {
    pub(crate) m_b: f64,
    pub(crate) r_bc_b: [f64; 3],
    pub(crate) i_b: [f64; 6],
}

impl StoredHub {
    /// The hub as the solver takes it.
    pub(crate) fn hub(self) -> Hub {
        let Self { m_b, r_bc_b, i_b } = self;
        Hub { m_b, r_bc_b: r_bc_b.into(), i_b_bc: symmetric(i_b) }
    }
}

/// One device: the kernel's own parameters, with `r_go_b` along the device's axes.
#[derive(Clone, Copy, Debug, Deserialize)]
pub struct StoredDevice {
    mount: [[f64; 3]; 3],
    /// Parameters.
    #[serde(with = "ParametersInFile")]
    pub parameters: Parameters<f64>,
    /// Angles.
    pub angles: Angles,
    /// Rates.
    #[serde(with = "RatesInFile")]
    pub rates: Rates<f64>,
    #[serde(with = "MotorsInFile")]
    motors: Motors<f64>,
}

/// Joint angles of a device, rad.
#[derive(Clone, Copy, Debug, Deserialize)]
pub struct Angles {
    /// Outer gimbal's.
    pub gamma_o: f64,
    /// Inner gimbal's.
    pub gamma_i: f64,
    /// The wheel's.
    pub theta: f64,
}

/// Why there is no spacecraft.
#[derive(Debug)]
pub enum ReadError {
    /// The file cannot be read.
    File(PathBuf, io::Error),
    /// It holds something else.
    Content(PathBuf, serde_json::Error),
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (path, source): (_, &dyn fmt::Display) = match self {
            Self::File(path, error) => (path, error),
            Self::Content(path, error) => (path, error),
        };
        write!(f, "{}: {source}; write it with `python tests/peers/setup.py`", path.display())
    }
}

impl std::error::Error for ReadError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::File(_, error) => Some(error),
            Self::Content(_, error) => Some(error),
        }
    }
}

impl Stored {
    /// The spacecraft of a file.
    ///
    /// # Errors
    /// When the file cannot be read as one.
    pub fn read(path: &Path) -> Result<Self, ReadError> {
        let text = std::fs::read_to_string(path);
        let text = text.map_err(|error| ReadError::File(path.to_owned(), error))?;
        serde_json::from_str(&text).map_err(|error| ReadError::Content(path.to_owned(), error))
    }

    /// The hub.
    #[must_use]
    pub fn hub(&self) -> Hub {
        self.hub.hub()
    }

    /// The devices as the solver takes them.
    pub fn dgvscmgs(&self) -> impl Iterator<Item = Dgvscmg> + '_ {
        self.devices.iter().map(StoredDevice::dgvscmg)
    }

    /// A state at rest set in motion, away from N's origin and turned by [`ATTITUDE`].
    #[must_use]
    pub fn motion<D: Devices<Scalar = f64>>(&self, at_rest: State<D>) -> State<D> {
        let mut state = State {
            r_b_n: Vector3::new(3.0, -2.0, 1.0),
            r_b_n_dot: ATTITUDE.dcm().transpose() * Vector3::from(self.r_b_n_dot),
            attitude: ATTITUDE,
            omega: self.omega.into(),
            ..at_rest
        };
        let joints = self.devices.iter().flat_map(StoredDevice::joints);
        for ([coordinate, rate], joint) in state.devices.states_mut().zip(joints) {
            [*coordinate, *rate] = joint;
        }
        state
    }

    /// Force and torques on inputs that are none.
    #[must_use]
    pub fn forces<D: Devices<Scalar = f64>>(&self, none: Inputs<D>) -> Inputs<D> {
        let mut inputs =
            Inputs { force: self.force.into(), torque_b: self.torque_b.into(), ..none };
        let torques = self.devices.iter().flat_map(|device| {
            let Motors { u_o, u_i, u_w } = device.motors;
            [u_o, u_i, u_w]
        });
        for (motor, torque) in inputs.motors.values_mut().zip(torques) {
            *motor = torque;
        }
        inputs
    }

    /// The whole as solver and references take it.
    ///
    /// # Panics
    /// Unless there are `N` devices.
    #[must_use]
    pub fn case<const N: usize>(&self) -> Case<N> {
        let devices: Vec<_> = self.dgvscmgs().collect();
        let found = devices.len();
        Case {
            hub: self.hub(),
            devices: devices.try_into().unwrap_or_else(|_| panic!("{found} devices, not {N}")),
            state: self.motion(State::<Set<N>>::at_rest()),
            inputs: self.forces(Inputs::none()),
        }
    }
}

impl StoredDevice {
    /// Columns: the device's axes at zero angle, along B.
    #[must_use]
    pub fn mount(&self) -> Matrix3<f64> {
        by_rows(self.mount)
    }

    fn joints(&self) -> [[f64; 2]; 3] {
        let Angles { gamma_o, gamma_i, theta } = self.angles;
        let Rates { gamma_o_dot, gamma_i_dot, spin } = self.rates;
        [[gamma_o, gamma_o_dot], [gamma_i, gamma_i_dot], [theta, spin]]
    }

    fn dgvscmg(&self) -> Dgvscmg {
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
#[must_use]
pub fn symmetric([xx, xy, xz, yy, yz, zz]: [f64; 6]) -> Matrix3<f64> {
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}

/// The matrix with these rows.
pub(crate) fn by_rows(rows: [[f64; 3]; 3]) -> Matrix3<f64> {
    Matrix3::from_rows(&rows.map(|row| Vector3::from(row).transpose()))
}

/// On the diagonal of a mount that is none.
fn one() -> f64 {
    1.0
}

/// The generated parameters, field by field, for serde; the files have the mount in a field of its
/// own.
#[derive(Deserialize)]
#[serde(remote = "Parameters::<f64>")]
struct ParametersInFile {
    #[serde(default = "one")]
    mount_11: f64,
    #[serde(default)]
    mount_12: f64,
    #[serde(default)]
    mount_13: f64,
    #[serde(default)]
    mount_21: f64,
    #[serde(default = "one")]
    mount_22: f64,
    #[serde(default)]
    mount_23: f64,
    #[serde(default)]
    mount_31: f64,
    #[serde(default)]
    mount_32: f64,
    #[serde(default = "one")]
    mount_33: f64,
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
#[serde(remote = "Rates::<f64>")]
struct RatesInFile {
    gamma_o_dot: f64,
    gamma_i_dot: f64,
    spin: f64,
}

/// The generated motor torques, likewise.
#[derive(Deserialize)]
#[serde(remote = "Motors::<f64>")]
#[expect(clippy::struct_field_names, reason = "the names of the generated fields")]
struct MotorsInFile {
    u_o: f64,
    u_i: f64,
    u_w: f64,
}
