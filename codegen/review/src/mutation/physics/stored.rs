//! The engines' stored values, read: spacecraft with one device on an identity mount.

use std::collections::BTreeMap;
use std::fmt;

use nalgebra::{Matrix3, Vector3};
use serde::Deserialize;

use crate::mutation::state::{
    Accelerations, Case, CaseName, Drive, Hub, Mode, Motion, parameters_of,
};
use precess_codegen::kinds::{Joint, Kind};

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
    /// A list has more or fewer entries than the kind requires.
    Count {
        /// The spacecraft.
        spacecraft: String,
        /// The list.
        list: String,
        /// How many entries it has.
        count: usize,
        /// How many it should have.
        expected: usize,
    },
    /// No spacecraft has one device on an identity mount.
    None,
}

/// The remedy, whatever is wrong with the values.
const STORE: &str = "store the values again with `python tests/engines/store.py`";

impl std::error::Error for EngineError {}

impl fmt::Display for EngineError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Json(error) => write!(f, "{error}; {STORE}"),
            Self::Missing { spacecraft, name } => {
                write!(f, "spacecraft `{spacecraft}` has no `{name}`; {STORE}")
            }
            Self::Count { spacecraft, list, count, expected } => write!(
                f,
                "spacecraft `{spacecraft}` has {count} entries in `{list}`, not {expected}; {STORE}"
            ),
            Self::None => write!(
                f,
                "no spacecraft has unit scales and one device on an identity mount; {STORE}"
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
    scales: Scales,
    hub: HubText,
    devices: Vec<DeviceText>,
    omega: [f64; 3],
    r_b_n_dot: [f64; 3],
    force: [f64; 3],
    torque_b: [f64; 3],
    pinocchio: Pinocchio,
    mujoco: Mujoco,
}

/// Over which ranges its numbers were drawn.
#[derive(Deserialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
enum Scales {
    /// Every number is of order one.
    Unit,
    /// Over the ranges that the suites declare.
    Declared,
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

impl Stored {
    /// Reads the spacecraft of a kind that count here.
    pub(super) fn read(kind: &Kind, json: &str) -> Result<Vec<Self>, EngineError> {
        let file: File = serde_json::from_str(json).map_err(EngineError::Json)?;
        let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let mut cases = Vec::new();
        for spacecraft in &file.spacecraft {
            let [device] = spacecraft.devices.as_slice() else { continue };
            if device.mount == identity && spacecraft.scales == Scales::Unit {
                cases.push(Self::from_text(
                    kind,
                    CaseName::Stored(cases.len()),
                    spacecraft,
                    device,
                )?);
            }
        }
        if cases.is_empty() { Err(EngineError::None) } else { Ok(cases) }
    }

    fn from_text(
        kind: &Kind,
        name: CaseName,
        spacecraft: &Spacecraft,
        device: &DeviceText,
    ) -> Result<Self, EngineError> {
        let reader = Reader { kind, spacecraft: &spacecraft.name };
        let names = parameters_of(kind);
        let names: Vec<_> = names.iter().map(String::as_str).collect();
        let (hub, theirs, other) = (&spacecraft.hub, &spacecraft.pinocchio, &spacecraft.mujoco);
        let bodies = reader.only("bodies", &theirs.bodies)?;
        reader.counted("bodies", bodies.len(), kind.links.len())?;
        Ok(Self {
            case: Case {
                name,
                hub: Hub {
                    mass: hub.mass,
                    centre: hub.centre.into(),
                    inertia: tensor(hub.inertia),
                },
                mount: Matrix3::identity(),
                parameters: reader.values("parameters", &device.parameters, &names)?,
                motion: Motion {
                    coordinates: reader
                        .joints("angles", &device.angles, |joint| joint.coordinate)?,
                    rates: reader.joints("rates", &device.rates, |joint| joint.rate)?,
                    omega: spacecraft.omega.into(),
                    velocity: spacecraft.r_b_n_dot.into(),
                },
                drive: Drive {
                    motors: reader.joints("motors", &device.motors, |joint| joint.torque)?,
                    modes: Mode::of_kind(kind, |_| Mode::DRIVEN),
                    force: spacecraft.force.into(),
                    torque: spacecraft.torque_b.into(),
                },
            },
            accelerations: [
                reader.accelerations(theirs.r_b_n_ddot, theirs.omega_dot, &theirs.accelerations)?,
                reader.accelerations(other.r_b_n_ddot, other.omega_dot, &other.accelerations)?,
            ],
            energy: [theirs.energy, other.energy],
            linear: theirs.linear.into(),
            angular: theirs.angular_b.into(),
            bodies: bodies.clone(),
        })
    }
}

/// Takes the numbers of one spacecraft: each that the kind requires, and no more.
struct Reader<'a> {
    kind: &'a Kind,
    spacecraft: &'a str,
}

impl Reader<'_> {
    fn counted(&self, list: &str, count: usize, expected: usize) -> Result<(), EngineError> {
        if count == expected {
            return Ok(());
        }
        let (spacecraft, list) = (self.spacecraft.to_owned(), list.to_owned());
        Err(EngineError::Count { spacecraft, list, count, expected })
    }

    /// The entry of the one device.
    fn only<'a, T>(&self, list: &str, of: &'a [T]) -> Result<&'a T, EngineError> {
        self.counted(list, of.len(), 1)?;
        of.first().ok_or_else(|| self.missing(list))
    }

    fn missing(&self, name: &str) -> EngineError {
        EngineError::Missing { spacecraft: self.spacecraft.to_owned(), name: name.to_owned() }
    }

    /// The numbers under these names, in their order.
    fn values(
        &self,
        list: &str,
        numbers: &Numbers,
        names: &[&str],
    ) -> Result<Vec<f64>, EngineError> {
        let value = |name: &&str| numbers.get(*name).copied().ok_or_else(|| self.missing(name));
        let values = names.iter().map(value).collect::<Result<_, _>>()?;
        self.counted(list, numbers.len(), names.len())?;
        Ok(values)
    }

    /// A number of each joint.
    fn joints(
        &self,
        list: &str,
        numbers: &Numbers,
        name: fn(&Joint) -> &'static str,
    ) -> Result<Vec<f64>, EngineError> {
        let names: Vec<_> = self.kind.links.iter().map(|link| name(&link.joint)).collect();
        self.values(list, numbers, &names)
    }

    fn accelerations(
        &self,
        point: [f64; 3],
        omega: [f64; 3],
        joints: &[Numbers],
    ) -> Result<Accelerations, EngineError> {
        let numbers = self.only("accelerations", joints)?;
        let joints = self.joints("accelerations", numbers, |joint| joint.acceleration)?;
        Ok(Accelerations { point: point.into(), omega: omega.into(), joints })
    }
}

/// A symmetric tensor from its entries 11, 12, 13, 22, 23, 33.
pub(super) fn tensor([xx, xy, xz, yy, yz, zz]: [f64; 6]) -> Matrix3<f64> {
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}
