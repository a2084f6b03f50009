//! [`Member`]: a device or a platform of a scenario's set.
//!
//! The order of the set: the devices on the hub that carry nothing; platform by platform the platform, the devices
//! on it, and platform by platform those that stand on it, each with its devices; panel by panel the panels on the
//! hub that carry devices, each with what stands on it in the same order. Names, mounts, joints
//! and drives of a scenario are in this order.

use nalgebra::Matrix3;
use precess_dynamics::kind::{BodyParameters, Each, ImbalanceModel, JointInfo, Kind};
use precess_dynamics::{BuiltIn, CarryingPanel, Passive, Platform, Suspension};

use super::Scenario;

pub use precess_craft::Set;

/// A device, or a platform without what stands on it.
#[expect(clippy::large_enum_variant, reason = "members are looked at one by one, and not kept")]
#[derive(Clone, Copy, Debug)]
pub enum Member<'a> {
    /// A device of some kind.
    Device {
        /// Its parameters.
        device: BuiltIn,
        /// The number of the platform or panel that it stands on, as a member; none on the hub.
        on: Option<usize>,
    },
    /// A platform.
    Platform {
        /// Its body, mount and joints.
        platform: &'a Platform,
        /// Springs and dampers that couple its joints.
        suspension: &'a Suspension,
        /// As of a device.
        on: Option<usize>,
    },
}

/// The members of a set, in order.
#[must_use]
pub fn members((on_hub, isolated, rows): &Set) -> Vec<Member<'_>> {
    let mut all = Vec::new();
    extend(&mut all, on_hub, None);
    for of in isolated {
        let outer = Some(all.len());
        all.push(Member::Platform { platform: &of.carrier, suspension: &of.suspension, on: None });
        let (devices, platforms) = &of.carried;
        extend(&mut all, devices, outer);
        for of in platforms {
            let on = Some(all.len());
            let (platform, suspension) = (&of.carrier, &of.suspension);
            all.push(Member::Platform { platform, suspension, on: outer });
            extend(&mut all, &of.carried, on);
        }
    }
    for first in rows {
        let on_first = push(&mut all, first.carrier, None);
        extend(&mut all, &first.carried.0, on_first);
        for second in &first.carried.1 {
            let on_second = push(&mut all, second.carrier, on_first);
            extend(&mut all, &second.carried.0, on_second);
            for third in &second.carried.1 {
                let on_third = push(&mut all, third.carrier, on_second);
                extend(&mut all, &third.carried, on_third);
            }
        }
    }
    all
}

fn extend(all: &mut Vec<Member<'_>>, devices: &[BuiltIn], on: Option<usize>) {
    all.extend(devices.iter().map(|device| Member::Device { device: *device, on }));
}

/// A panel that carries devices; its number.
fn push(all: &mut Vec<Member<'_>>, panel: CarryingPanel, on: Option<usize>) -> Option<usize> {
    all.push(Member::Device { device: BuiltIn::HingedPanel(panel.0), on });
    all.len().checked_sub(1)
}

/// Some devices and platforms of a scenario by themselves; what stands on one comes with it.
#[must_use]
pub fn set_of(scenario: &Scenario, chosen: &[usize]) -> Set {
    let (on_hub, isolated, rows) = &scenario.devices;
    let members = members(&scenario.devices);
    // What stands on the hub, in order: all devices that carry nothing, then platforms, then panels.
    let standing = members.iter().enumerate().filter(|(_, member)| member.on().is_none());
    let mut is_chosen = standing.map(|(index, _)| chosen.contains(&index));
    let mut next = || is_chosen.next().unwrap_or(false);
    (
        on_hub.iter().filter(|_| next()).copied().collect(),
        isolated.iter().filter(|_| next()).cloned().collect(),
        rows.iter().filter(|_| next()).cloned().collect(),
    )
}

/// Does something with the device of a number; nothing of a platform.
pub(crate) fn with_device<R>(
    (on_hub, isolated, rows): &mut Set,
    index: usize,
    change: impl FnOnce(&mut BuiltIn) -> R,
) -> Option<R> {
    enum Place<'a> {
        Device(&'a mut BuiltIn),
        Panel(&'a mut CarryingPanel),
        Platform,
    }
    let mut all: Vec<Place<'_>> = on_hub.iter_mut().map(Place::Device).collect();
    for of in isolated {
        let (devices, platforms) = &mut of.carried;
        all.push(Place::Platform);
        all.extend(devices.iter_mut().map(Place::Device));
        for of in platforms {
            all.push(Place::Platform);
            all.extend(of.carried.iter_mut().map(Place::Device));
        }
    }
    for first in rows {
        all.push(Place::Panel(&mut first.carrier));
        all.extend(first.carried.0.iter_mut().map(Place::Device));
        for second in &mut first.carried.1 {
            all.push(Place::Panel(&mut second.carrier));
            all.extend(second.carried.0.iter_mut().map(Place::Device));
            for third in &mut second.carried.1 {
                all.push(Place::Panel(&mut third.carrier));
                all.extend(third.carried.iter_mut().map(Place::Device));
            }
        }
    }
    match all.into_iter().nth(index)? {
        Place::Device(device) => Some(change(device)),
        Place::Panel(panel) => {
            let mut device = BuiltIn::HingedPanel(panel.0);
            let result = change(&mut device);
            if let BuiltIn::HingedPanel(changed) = device {
                panel.0 = changed;
            }
            Some(result)
        }
        Place::Platform => None,
    }
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
    /// The devices, where all stand on the hub and none carries another.
    #[must_use]
    pub fn devices_on_hub(&self) -> Option<&[BuiltIn]> {
        let (on_hub, platforms, rows) = &self.devices;
        (platforms.is_empty() && rows.is_empty()).then_some(on_hub)
    }

    /// The body of a member on which others stand: `isolator.platform`, `inner.panel`.
    pub(crate) fn body_of(&self, member: usize) -> Option<String> {
        let (name, of) = self.members().nth(member)?;
        Some(format!("{name}.{}", body_key(of.joints().last()?)))
    }

    /// The members that stand on the hub or on a node, each with what stands on it, by their numbers.
    pub(crate) fn groups(&self) -> Vec<Vec<usize>> {
        let mut groups: Vec<Vec<usize>> = Vec::new();
        for (index, member) in members(&self.devices).into_iter().enumerate() {
            // What stands on a member follows it.
            match groups.last_mut().filter(|_| member.on().is_some()) {
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
            Self::Platform { .. } => <Platform as Kind>::NAME,
        }
    }

    /// Its joints from the base to the tip.
    #[must_use]
    pub fn joints(&self) -> &'static [JointInfo] {
        match self {
            Self::Device { device, .. } => device.kind().joints(),
            Self::Platform { .. } => <Platform as Kind>::JOINTS,
        }
    }

    /// Columns: its axes at zero, in those of its base.
    #[must_use]
    pub fn mount(&self) -> Matrix3<f64> {
        match self {
            Self::Device { device, .. } => device.parameters().mount,
            Self::Platform { platform, .. } => platform.mount,
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
            Self::Platform { platform, .. } => platform.bodies().values().collect(),
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
            Self::Platform { platform, .. } => platform.passive.values().collect(),
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
        self.suspension().is_some_and(|of| *of != Suspension::none())
    }

    /// The device; none of a platform.
    #[must_use]
    pub fn device(&self) -> Option<BuiltIn> {
        match self {
            Self::Device { device, .. } => Some(*device),
            Self::Platform { .. } => None,
        }
    }

    /// The platform; none of a device.
    #[must_use]
    pub fn platform(&self) -> Option<&'a Platform> {
        match self {
            Self::Device { .. } => None,
            Self::Platform { platform, .. } => Some(platform),
        }
    }

    /// Springs and dampers that couple the joints of a platform; none of a device.
    #[must_use]
    pub fn suspension(&self) -> Option<&'a Suspension> {
        match self {
            Self::Device { .. } => None,
            Self::Platform { suspension, .. } => Some(suspension),
        }
    }

    /// The number of the platform or panel that it stands on, as a member; none on the hub.
    #[must_use]
    pub fn on(&self) -> Option<usize> {
        match self {
            Self::Device { on, .. } | Self::Platform { on, .. } => *on,
        }
    }
}
