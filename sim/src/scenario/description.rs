//! A scenario's spacecraft as a [`Description`]: the plain numbers from which the generator derives
//! kernels for it.
//!
//! A joint that the scenario locks at rest and never releases is locked for good. What acts on the
//! spacecraft is no part of it.

use nalgebra::Matrix3;
use precess_description::{Body, Description, Device, FORMAT, Hub};
use precess_dynamics::kind::ImbalanceModel;
use precess_dynamics::{Gravity, HubMode, JointStates, Passive};

use super::{Drive, Member, Scenario};

/// Why a spacecraft has no kernels of its own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum UndescribedError {
    /// The hub's mode is not free.
    Hub,
    /// The structure is flexible.
    Structure,
    /// A device whose imbalance is lumped.
    Lumped(String),
    /// A platform.
    Platform(String),
    /// A device that stands on another.
    Carried(String),
}

impl std::fmt::Display for UndescribedError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Hub => write!(
                f,
                "the kernels of one spacecraft are for a free hub; remove `hub.mode` from the scenario"
            ),
            Self::Structure => write!(
                f,
                "the kernels of one spacecraft are for a rigid hub; remove `[structure]` from the \
                 scenario"
            ),
            Self::Lumped(device) => write!(
                f,
                "the imbalance of {device} is lumped, and these kernels couple it; state \
                 `imbalance_model = \"coupled\"`"
            ),
            Self::Platform(name) => write!(
                f,
                "{name} is an isolated platform, and these kernels are for devices on the hub; \
                 remove `[[platform]]`, and `on` of the devices on it"
            ),
            Self::Carried(name) => write!(
                f,
                "{name} stands on another device, and these kernels are for devices on the hub; \
                 remove its `on`"
            ),
        }
    }
}

impl std::error::Error for UndescribedError {}

impl Scenario {
    /// The spacecraft by its numbers. With `unlock`, joints that the scenario locks stay joints.
    ///
    /// # Errors
    /// Where the hub is not free, the structure is flexible, the imbalance of a device is lumped, a device stands on
    /// another, or there is a platform.
    pub fn description(&self, unlock: bool) -> Result<Description, UndescribedError> {
        if self.hub_mode != HubMode::Free {
            return Err(UndescribedError::Hub);
        }
        if self.structure.is_some() {
            return Err(UndescribedError::Structure);
        }
        let mut joint = 0;
        let mut states = self.initial.devices.states();
        let mut device = Vec::new();
        for (name, member) in self.members() {
            let Some(own) = member.device() else {
                return Err(UndescribedError::Platform(name.to_owned()));
            };
            if member.on().is_some() {
                return Err(UndescribedError::Carried(name.to_owned()));
            }
            let parameters = own.parameters();
            if parameters.model == ImbalanceModel::Lumped {
                return Err(UndescribedError::Lumped(name.to_owned()));
            }
            let mut body = Vec::new();
            for (of, _) in parameters.bodies.iter().zip(own.kind().joints()) {
                let [coordinate, rate] = states.next().unwrap_or_default();
                let locked = self.is_locked_for_good(joint) && rate == 0.0 && !unlock;
                body.push(Body {
                    mass: of.mass,
                    origin: of.origin,
                    centre_of_mass: of.centre,
                    inertia: rows(&of.inertia),
                    locked_at: locked.then_some(coordinate),
                });
                joint += 1;
            }
            device.push(Device {
                name: name.to_owned(),
                kind: own.kind().name().to_owned(),
                mount: rows(&parameters.mount),
                turns: self.mounts.get(device.len()).cloned().flatten(),
                body,
                keep: Vec::new(),
            });
        }
        let hub = Hub {
            mass: self.hub.m_b,
            centre_of_mass: self.hub.r_bc_b.into(),
            inertia: rows(&self.hub.i_b_bc),
        };
        let name = self.name.replace('-', "_");
        Ok(Description { format: FORMAT, name, title: self.title.clone(), hub, device })
    }

    /// What acts on the spacecraft of this scenario and is no part of a description.
    #[must_use]
    pub fn not_described(&self) -> Vec<String> {
        let acts = |member: &Member<'_>| {
            member.passive().iter().any(|passive| *passive != Passive::none())
        };
        let passive = self.members().filter(|(_, member)| acts(member));
        let mut list: Vec<_> =
            passive.map(|(name, _)| format!("spring, damper or friction of {name}")).collect();
        list.extend(self.not_in_c_solver());
        if self.gravity != Gravity::None {
            list.push("gravity".to_owned());
        }
        if !self.wrenches.is_empty() {
            list.push("a wrench from outside".to_owned());
        }
        list
    }

    /// What acts in the scenario and is not part of the solver in C that assumes nothing.
    #[must_use]
    pub fn not_in_c_solver(&self) -> Vec<String> {
        let what = "friction that sticks or quadratic drag of";
        let joints = self.friction.iter().filter_map(|of| self.joints().nth(of.joint));
        joints.map(|(_, name, info)| format!("{what} {name}.{}", info.coordinate)).collect()
    }

    /// Whether a joint is locked from the start, and nothing releases it.
    fn is_locked_for_good(&self, joint: usize) -> bool {
        self.drives.get(joint) == Some(&Drive::Locked)
            && self.changes.iter().all(|change| change.joint != joint)
    }
}

fn rows(m: &Matrix3<f64>) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| m[(row, column)]))
}
