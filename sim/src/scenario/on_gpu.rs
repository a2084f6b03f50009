//! [`Scenario::not_on_gpu`]: what of a scenario no kernel of a GPU has.

use std::fmt;

use super::{IntegratorChoice, Scenario};

/// What of a scenario a campaign on a GPU does not support.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotOnGpu {
    /// Steps of adaptive length.
    AdaptiveSteps,
    /// A flexible structure.
    Structure,
    /// A member that stands on another, or on which others stand.
    Platform(String),
    /// A source of force or torque.
    Source(String),
    /// A controller.
    Controller(String),
    /// A crossing, which is an event.
    Crossing(String),
    /// An end stop of a joint, which is an event.
    EndStop(String),
    /// A limit of a motor that its rate reaches: an event of a joint.
    MotorLimit(String),
    /// Friction of a joint that sticks, or quadratic drag.
    Friction(String),
}

impl fmt::Display for NotOnGpu {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::AdaptiveSteps => {
                write!(
                    f,
                    "a GPU takes steps of fixed length; state `integrator = \"rk4\"` and `step`"
                )
            }
            Self::Structure => write!(f, "a GPU has no flexible structure; remove `[structure]`"),
            Self::Platform(name) => write!(
                f,
                "a GPU has devices on the hub only; remove the platforms and the `on` of devices, `{name}` among them"
            ),
            Self::Source(name) => {
                write!(f, "a GPU has no sources; remove `[[source]]` {name}")
            }
            Self::Controller(name) => {
                write!(f, "a GPU has no controllers; remove `[[controller]]` {name}")
            }
            Self::Crossing(name) => write!(f, "a GPU has no events; remove the crossing `{name}`"),
            Self::EndStop(joint) => {
                write!(f, "a GPU has no events; remove the end stops of {joint}")
            }
            Self::MotorLimit(joint) => write!(
                f,
                "a GPU has no events; remove the limits of the motor of {joint} that depend on its rate"
            ),
            Self::Friction(joint) => write!(
                f,
                "a GPU has no friction that sticks and no quadratic drag; give {joint} `coulomb` with `coulomb_rate`"
            ),
        }
    }
}

impl std::error::Error for NotOnGpu {}

impl Scenario {
    /// The first thing of the scenario that a campaign on a GPU does not support.
    #[must_use]
    pub fn not_on_gpu(&self) -> Option<NotOnGpu> {
        let joint = |number: usize| {
            let found = self.joints().nth(number);
            found.map_or_else(String::new, |(_, name, info)| format!("{name}.{}", info.coordinate))
        };
        if !matches!(self.settings.integrator, IntegratorChoice::Rk4 { .. }) {
            return Some(NotOnGpu::AdaptiveSteps);
        }
        if self.structure.is_some() {
            return Some(NotOnGpu::Structure);
        }
        if self.devices_on_hub().is_none() {
            let mut members = self.members();
            let other =
                members.find(|(_, member)| member.device().is_none() || member.on().is_some());
            return Some(NotOnGpu::Platform(
                other.map_or_else(String::new, |(name, _)| name.to_owned()),
            ));
        }
        if let Some(of) = self.disturbances.first() {
            return Some(NotOnGpu::Source(of.name.clone()));
        }
        if let Some(of) = self.controllers.first() {
            return Some(NotOnGpu::Controller(of.name.clone()));
        }
        if let Some(of) = self.crossings.first() {
            return Some(NotOnGpu::Crossing(of.name.clone()));
        }
        if let Some(of) = self.stops.first() {
            return Some(NotOnGpu::EndStop(joint(of.joint)));
        }
        let limited = |drive: &super::Drive| drive.limits().depend_on_rate();
        if let Some(number) = self.drives.iter().position(limited) {
            return Some(NotOnGpu::MotorLimit(joint(number)));
        }
        self.friction.first().map(|of| NotOnGpu::Friction(joint(of.joint)))
    }
}
