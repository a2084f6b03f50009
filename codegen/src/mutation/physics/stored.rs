//! The engines' stored values, read: spacecraft with one device on an identity mount.

use std::collections::BTreeMap;
use std::fmt;

use nalgebra::{Matrix3, Vector3};
use serde::Deserialize;

use crate::kinds::Kind;
use crate::mutation::state::{Accelerations, Case, Drive, Hub, Motion, parameters_of};

/// One spacecraft and what the engines say of it.
#[derive(Clone)]
pub(super) struct Stored {
    pub(super) case: Case,
    pub(super) accelerations: [Accelerations; 2],
    pub(super) energy: [f64; 2],
    pub(super) linear: Vector3<f64>,
    pub(super) angular: Vector3<f64>,
    pub(super) bodies: Vec<Body>,
}

/// Why stored values cannot be used.
#[derive(Debug)]
pub enum EngineError {
    /// Not the JSON that is expected.
    Json(serde_json::Error),
    /// A quantity of the kind has no value.
    Missing {
        /// The spacecraft.
        spacecraft: String,
        /// The quantity.
        name: String,
    },
    /// No spacecraft has one device on an identity mount.
    None,
}

impl std::error::Error for EngineError {}

impl fmt::Display for EngineError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Json(error) => write!(f, "engines' values: {error}"),
            Self::Missing { spacecraft, name } => {
                write!(
                    f,
                    "engines' values: spacecraft `{spacecraft}` has no `{name}`; store it again"
                )
            }
            Self::None => write!(
                f,
                "engines' values: no spacecraft with one device on an identity mount and scales of \
                 order one; store some"
            ),
        }
    }
}

/// One body, along B.
#[derive(Clone, Deserialize)]
pub(super) struct Body {
    pub(super) r: [f64; 3],
    pub(super) r_prime: [f64; 3],
    pub(super) r_dprime: [f64; 3],
    pub(super) omega_b: [f64; 3],
    pub(super) i_b: [f64; 6],
}

#[derive(Deserialize)]
struct File {
    spacecraft: Vec<Spacecraft>,
}

#[derive(Deserialize)]
struct Spacecraft {
    name: String,
    hub: HubText,
    devices: Vec<DeviceText>,
    omega: [f64; 3],
    r_b_n_dot: [f64; 3],
    force: [f64; 3],
    torque_b: [f64; 3],
    pinocchio: Pinocchio,
    mujoco: Mujoco,
}

#[derive(Deserialize)]
struct HubText {
    #[serde(rename = "m_b")]
    mass: f64,
    #[serde(rename = "r_bc_b")]
    centre: [f64; 3],
    #[serde(rename = "i_b")]
    inertia: [f64; 6],
}

type Numbers = BTreeMap<String, f64>;

#[derive(Deserialize)]
struct DeviceText {
    mount: [[f64; 3]; 3],
    parameters: Numbers,
    angles: Numbers,
    rates: Numbers,
    motors: Numbers,
}

#[derive(Deserialize)]
struct Pinocchio {
    r_b_n_ddot: [f64; 3],
    omega_dot: [f64; 3],
    accelerations: Vec<Numbers>,
    energy: f64,
    linear: [f64; 3],
    angular_b: [f64; 3],
    bodies: Vec<Vec<Body>>,
}

#[derive(Deserialize)]
struct Mujoco {
    r_b_n_ddot: [f64; 3],
    omega_dot: [f64; 3],
    accelerations: Vec<Numbers>,
    energy: f64,
}

/// How the fixture calls the spacecraft whose every number is of order one.
const UNIT_SCALES: &str = "unit scales";

impl Stored {
    /// Reads the spacecraft of a kind that count here.
    pub(super) fn read(kind: &Kind, json: &str) -> Result<Vec<Self>, EngineError> {
        let file: File = serde_json::from_str(json).map_err(EngineError::Json)?;
        let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let mut cases = Vec::new();
        for spacecraft in &file.spacecraft {
            let [device] = spacecraft.devices.as_slice() else { continue };
            if device.mount == identity && spacecraft.name.contains(UNIT_SCALES) {
                cases.push(Self::of(kind, spacecraft, device)?);
            }
        }
        if cases.is_empty() { Err(EngineError::None) } else { Ok(cases) }
    }

    fn of(kind: &Kind, spacecraft: &Spacecraft, device: &DeviceText) -> Result<Self, EngineError> {
        let missing = |name: &str| EngineError::Missing {
            spacecraft: spacecraft.name.clone(),
            name: name.to_owned(),
        };
        let find =
            |numbers: &Numbers, name: &str| numbers.get(name).copied().ok_or_else(|| missing(name));
        let joints = |numbers: &Numbers, name: fn(&crate::kinds::Joint) -> &'static str| {
            let names = kind.links.iter().map(|link| name(&link.joint));
            names.map(|name| find(numbers, name)).collect::<Result<Vec<f64>, _>>()
        };
        let accelerations = |point: [f64; 3], omega: [f64; 3], of: &[Numbers]| {
            let numbers = of.first().ok_or_else(|| missing("accelerations"))?;
            Ok(Accelerations {
                point: point.into(),
                omega: omega.into(),
                joints: joints(numbers, |joint| joint.acceleration)?,
            })
        };
        let names = parameters_of(kind);
        let values = names.iter().map(|name| find(&device.parameters, name));
        let (hub, theirs, other) = (&spacecraft.hub, &spacecraft.pinocchio, &spacecraft.mujoco);
        Ok(Self {
            case: Case {
                hub: Hub {
                    mass: hub.mass,
                    centre: hub.centre.into(),
                    inertia: tensor(hub.inertia),
                },
                parameters: values.collect::<Result<_, _>>()?,
                motion: Motion {
                    angles: joints(&device.angles, |joint| joint.coordinate)?,
                    rates: joints(&device.rates, |joint| joint.rate)?,
                    omega: spacecraft.omega.into(),
                    velocity: spacecraft.r_b_n_dot.into(),
                },
                drive: Drive {
                    motors: joints(&device.motors, |joint| joint.torque)?,
                    force: spacecraft.force.into(),
                    torque: spacecraft.torque_b.into(),
                },
            },
            accelerations: [
                accelerations(theirs.r_b_n_ddot, theirs.omega_dot, &theirs.accelerations)?,
                accelerations(other.r_b_n_ddot, other.omega_dot, &other.accelerations)?,
            ],
            energy: [theirs.energy, other.energy],
            linear: theirs.linear.into(),
            angular: theirs.angular_b.into(),
            bodies: theirs.bodies.first().cloned().ok_or_else(|| missing("bodies"))?,
        })
    }
}

/// A symmetric tensor from its entries 11, 12, 13, 22, 23, 33.
pub(super) fn tensor([xx, xy, xz, yy, yz, zz]: [f64; 6]) -> Matrix3<f64> {
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}
