//! Spacecraft whose devices are listed by kind and bodies, as files hold them for steps:
//! `tests/peers/listed.py` writes them.

use std::path::Path;

use nalgebra::Matrix3;
use precess_dynamics::kind::BodyParameters;
use precess_dynamics::{BuiltIn, BuiltInKind, Each as _, Hub, Passive, Platform, platform};
use precess_tests::stored::symmetric;
use serde::Deserialize;

use super::Rejected;
use super::parameters::parameters;
use super::step::fill;

/// A spacecraft in one state under known forces.
#[derive(Clone, Debug, Deserialize)]
pub(super) struct Listed {
    /// Step of the integrator where motions are compared, s.
    pub(super) step: f64,
    hub: Body,
    pub(super) omega: [f64; 3],
    pub(super) force: [f64; 3],
    pub(super) torque_b: [f64; 3],
    devices: Vec<Device>,
    /// Of a flexible structure.
    #[serde(default)]
    pub(super) modes: usize,
}

#[derive(Clone, Debug, Deserialize)]
struct Body {
    mass: f64,
    #[serde(default)]
    origin: [f64; 3],
    centre: [f64; 3],
    inertia: [f64; 6],
}

#[derive(Clone, Debug, Deserialize)]
struct Device {
    kind: String,
    mount: [[f64; 3]; 3],
    bodies: Vec<Body>,
    coordinates: Vec<f64>,
    rates: Vec<f64>,
    motors: Vec<f64>,
    /// Of each joint; none where nothing is said.
    #[serde(default)]
    stiffness: Vec<f64>,
    #[serde(default)]
    damping: Vec<f64>,
}

/// What a device of six joints that carries the others is called.
const PLATFORM: &str = "platform";

impl Listed {
    /// The spacecraft of a file.
    pub(super) fn read(path: &Path) -> Result<Self, Rejected> {
        let wrong = |error: &dyn std::fmt::Display| {
            format!("{}: {error}; write it with `python tests/peers/setup.py`", path.display())
        };
        let text = std::fs::read_to_string(path).map_err(|error| wrong(&error))?;
        serde_json::from_str(&text).map_err(|error| wrong(&error).into())
    }

    /// The hub.
    pub(super) fn hub(&self) -> Hub {
        let Body { mass, centre, inertia, .. } = self.hub;
        Hub { m_b: mass, r_bc_b: centre.into(), i_b_bc: symmetric(inertia) }
    }

    /// The devices, of any kinds.
    pub(super) fn devices(&self) -> Result<Vec<BuiltIn>, Rejected> {
        let devices = self.devices.iter().filter(|device| device.kind != PLATFORM);
        devices.map(Device::built_in).collect()
    }

    /// What carries them, if not the hub.
    pub(super) fn platform(&self) -> Option<Platform> {
        self.devices.iter().find(|device| device.kind == PLATFORM)?.platform()
    }

    /// Coordinate and rate of each joint.
    pub(super) fn joints(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.devices.iter().flat_map(|device| {
            device.coordinates.iter().zip(&device.rates).map(|(at, rate)| [*at, *rate])
        })
    }

    /// Torque of each motor.
    pub(super) fn motors(&self) -> impl Iterator<Item = f64> + '_ {
        self.devices.iter().flat_map(|device| device.motors.iter().copied())
    }
}

impl Device {
    fn mount(&self) -> Matrix3<f64> {
        Matrix3::from_fn(|row, column| self.mount[row][column])
    }

    /// Spring and damper of each joint.
    fn passive(&self) -> impl Iterator<Item = Passive> + '_ {
        let joints = self.stiffness.iter().zip(&self.damping);
        joints.map(|(k, c)| Passive { stiffness: *k, viscous: *c, ..Passive::none() })
    }

    fn platform(&self) -> Option<Platform> {
        let Body { mass, origin, centre, inertia } = self.bodies.first()?;
        let mut passive = platform::PerJoint::all(Passive::none());
        fill(passive.values_mut(), self.passive());
        Some(Platform {
            mount: self.mount(),
            r_p_b: (*origin).into(),
            r_pc_p: (*centre).into(),
            passive,
            ..Platform::bare(*mass, symmetric(*inertia))
        })
    }

    fn built_in(&self) -> Result<BuiltIn, Rejected> {
        let kind = BuiltInKind::of_name(&self.kind).ok_or_else(|| format!("no {}", self.kind))?;
        let bodies = self.bodies.iter().map(|body| BodyParameters {
            origin: body.origin,
            mass: body.mass,
            centre: body.centre,
            inertia: symmetric(body.inertia),
        });
        let mut parameters = parameters(self.mount(), bodies);
        fill(parameters.passive.iter_mut(), self.passive());
        Ok(BuiltIn::new(kind, &parameters)?)
    }
}
