//! [`Joints`]: the joints of all devices and platforms of a file in order, by the names that other
//! tables use.

use precess_dynamics::kind::JointInfo;

use super::device::Device;
use crate::file::keys::Keys;
use crate::scenario::{Drive, EndStop, JointFriction, body_key, joint_key};

/// All joints in order, by name.
#[derive(Default)]
pub(in crate::file::read) struct Joints {
    /// `cmg1.inner_gimbal`, and the joint.
    names: Vec<(String, &'static JointInfo)>,
    /// `isolator.platform`, the body of the joint `isolator.z_turn`.
    bodies: Vec<(String, usize)>,
    drives: Vec<Drive>,
    stops: Vec<EndStop>,
    friction: Vec<JointFriction>,
}

impl Joints {
    pub(in crate::file::read) fn of_devices(devices: &[Device]) -> Self {
        let mut joints = Self::default();
        for device in devices {
            let infos = device.joints();
            let own = infos.iter().zip(&device.drives).zip(&device.stops).zip(&device.friction);
            for (((info, drive), stop), friction) in own {
                let joint = joints.names.len();
                joints.friction.extend(friction.map(|of| JointFriction { joint, ..of }));
                if let Some(([lower, upper], action)) = *stop {
                    joints.stops.push(EndStop { joint, lower, upper, action });
                }
                if joint_key(info) != body_key(info) {
                    let body = format!("{}.{}", device.name, body_key(info));
                    joints.bodies.push((body, joints.names.len()));
                }
                joints.names.push((format!("{}.{}", device.name, joint_key(info)), info));
                joints.drives.push(drive.clone());
            }
        }
        joints
    }

    /// The number of a joint by the name of its body; reports where there is none.
    pub(in crate::file::read) fn find(
        &self,
        keys: &Keys<'_>,
        key: &str,
        name: &str,
    ) -> Option<usize> {
        let body = || self.bodies.iter().find(|(known, _)| known == name).map(|(_, joint)| *joint);
        let found = self.names.iter().position(|(known, _)| known == name).or_else(body);
        if found.is_none() {
            let known: Vec<_> = self.names.iter().map(|(name, _)| name.as_str()).collect();
            let help = match known.as_slice() {
                [] => "there is no device".to_owned(),
                known => format!("there are {}", known.join(", ")),
            };
            keys.error(key, format!("no joint is named `{name}`"), &help);
        }
        found
    }

    pub(in crate::file::read) fn info(&self, joint: usize) -> Option<&'static JointInfo> {
        self.names.get(joint).map(|(_, info)| *info)
    }

    pub(in crate::file::read) fn acting(self) -> (Vec<Drive>, Vec<EndStop>, Vec<JointFriction>) {
        (self.drives, self.stops, self.friction)
    }
}
