//! [`Member`]: a device or a platform of a scenario's set.
//!
//! The order of the set: the devices on the hub, then platform by platform the platform and the
//! devices on it. Names, mounts, joints and drives of a scenario are in this order.

use nalgebra::Matrix3;
use precess_dynamics::kind::{BodyParameters, Each, ImbalanceModel, JointInfo, Kind};
use precess_dynamics::{BuiltIn, Isolated, Passive, Platform, Suspension};

use super::Scenario;

pub use precess_craft::Set;

/// A device, or a platform without the devices on it.
#[derive(Clone, Copy, Debug)]
pub enum Member<'a> {
    /// A device of some kind.
    Device {
        /// Its parameters.
        device: &'a BuiltIn,
        /// The number of the platform that it stands on, as a member; none on the hub.
        on: Option<usize>,
    },
    /// A platform on the hub.
    Platform(&'a Isolated<Vec<BuiltIn>>),
}

/// The members of a set, in order.
#[must_use]
pub fn members((on_hub, isolated): &Set) -> Vec<Member<'_>> {
    let mut all: Vec<_> = on_hub.iter().map(|device| Member::Device { device, on: None }).collect();
    for of in isolated {
        let on = Some(all.len());
        all.push(Member::Platform(of));
        all.extend(of.carried.iter().map(|device| Member::Device { device, on }));
    }
    all
}

/// Some devices and platforms of a scenario by themselves; a device on a platform comes with it.
#[must_use]
pub fn set_of(scenario: &Scenario, chosen: &[usize]) -> Set {
    let members = members(&scenario.devices);
    let chosen: Vec<_> = chosen.iter().filter_map(|index| members.get(*index)).collect();
    let on_hub = chosen.iter().filter(|member| member.on().is_none());
    (
        on_hub.filter_map(|member| member.device().copied()).collect(),
        chosen.iter().filter_map(|member| member.platform().cloned()).collect(),
    )
}

/// The key of a body: `inner_gimbal`.
pub(crate) fn body_key(joint: &JointInfo) -> String {
    joint.body.replace(' ', "_")
}

/// The key of a joint: that of its body, but of a platform's last joint `z_turn`.
pub(crate) fn joint_key(joint: &JointInfo) -> String {
    if joint.body == <Platform as Kind>::NAME { "z_turn".to_owned() } else { body_key(joint) }
}

impl Scenario {
    /// The members that stand on the hub or on a node, each with the devices on it, by their numbers.
    pub(crate) fn groups(&self) -> Vec<Vec<usize>> {
        let mut groups: Vec<Vec<usize>> = Vec::new();
        for (index, member) in members(&self.devices).into_iter().enumerate() {
            match member.on().and_then(|on| groups.iter_mut().find(|group| group.contains(&on))) {
                Some(group) => group.push(index),
                None => groups.push(vec![index]),
            }
        }
        groups
    }
}

impl<'a> Member<'a> {
    /// The name of its kind; of a platform `platform`.
    #[must_use]
    pub fn kind_name(&self) -> &'static str {
        match self {
            Self::Device { device, .. } => device.kind().name(),
            Self::Platform(_) => <Platform as Kind>::NAME,
        }
    }

    /// Its joints from the base to the tip.
    #[must_use]
    pub fn joints(&self) -> &'static [JointInfo] {
        match self {
            Self::Device { device, .. } => device.kind().joints(),
            Self::Platform(_) => <Platform as Kind>::JOINTS,
        }
    }

    /// Columns: its axes at zero, in those of its base.
    #[must_use]
    pub fn mount(&self) -> Matrix3<f64> {
        match self {
            Self::Device { device, .. } => device.parameters().mount,
            Self::Platform(of) => of.carrier.mount,
        }
    }

    /// The child body of each joint.
    #[must_use]
    pub fn bodies(&self) -> Vec<BodyParameters<f64>> {
        match self {
            Self::Device { device, .. } => {
                let bodies = device.parameters().bodies.into_iter();
                bodies.take(self.joints().len()).collect()
            }
            Self::Platform(of) => of.carrier.bodies().values().collect(),
        }
    }

    /// Spring, damper and friction of each joint.
    #[must_use]
    pub fn passive(&self) -> Vec<Passive> {
        match self {
            Self::Device { device, .. } => {
                let passive = device.parameters().passive.into_iter();
                passive.take(self.joints().len()).collect()
            }
            Self::Platform(of) => of.carrier.passive.values().collect(),
        }
    }

    /// Whether the imbalance of its wheel is lumped.
    #[must_use]
    pub fn is_lumped(&self) -> bool {
        self.device().is_some_and(|of| of.parameters().model == ImbalanceModel::Lumped)
    }

    /// Whether springs or dampers couple its joints.
    #[must_use]
    pub fn has_suspension(&self) -> bool {
        matches!(self, Self::Platform(of) if of.suspension != Suspension::none())
    }

    /// The device; none of a platform.
    #[must_use]
    pub fn device(&self) -> Option<&'a BuiltIn> {
        match self {
            Self::Device { device, .. } => Some(device),
            Self::Platform(_) => None,
        }
    }

    /// The platform; none of a device.
    #[must_use]
    pub fn platform(&self) -> Option<&'a Isolated<Vec<BuiltIn>>> {
        match self {
            Self::Device { .. } => None,
            Self::Platform(of) => Some(of),
        }
    }

    /// The number of the platform that it stands on, as a member; none on the hub.
    #[must_use]
    pub fn on(&self) -> Option<usize> {
        match self {
            Self::Device { on, .. } => *on,
            Self::Platform(_) => None,
        }
    }
}
