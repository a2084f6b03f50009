//! [`MemberLoads`]: the loads of a set, member by member and joint by joint in the order of the set,
//! and what each platform or panel exerts on what stands on it.
//!
//! ```text
//! F = sum of F_k,   M = sum of (M_k + r_k x F_k)
//! ```
//!
//! over the devices and platforms k on a platform or panel, with `F_k` and `M_k` the load at the mount of each about its
//! `position`, `r_k` from P; expressed in the axes of the platform or panel, about P.

use nalgebra::Vector3;
use precess_dynamics::kind::Each;
use precess_dynamics::{DeviceLoads, Loads, StructureData, Wrench};

use crate::engine::equations::kinematics::Chain;
use crate::record::columns::Quantity;
use crate::scenario::Set;

/// The loads of a set.
pub(crate) struct MemberLoads {
    /// At the mount of each device and platform.
    pub(crate) mounts: Vec<Wrench>,
    /// At each joint.
    pub(crate) joints: Vec<Wrench>,
    /// Motor torque or force of each joint.
    pub(crate) motors: Vec<f64>,
    /// On all that stands on the platform or panel of each number.
    pub(crate) carried: Vec<Wrench>,
}

impl MemberLoads {
    pub(crate) fn new<S: StructureData>(loads: &Loads<Set, S>, chains: &[Chain]) -> Self {
        let (mounts, joints, motors) = (Vec::new(), Vec::new(), Vec::new());
        let mut of = Self { mounts, joints, motors, carried: vec![Wrench::none(); chains.len()] };
        let (on_hub, isolated, rows) = &loads.devices;
        for device in on_hub {
            of.push(device);
        }
        for member in isolated {
            of.push(&member.carrier);
            let (devices, platforms) = &member.carried;
            for device in devices {
                of.push(device);
            }
            for member in platforms {
                of.push(&member.carrier);
                for device in &member.carried {
                    of.push(device);
                }
            }
        }
        for first in rows {
            of.push(&first.carrier);
            for device in &first.carried.0 {
                of.push(device);
            }
            for second in &first.carried.1 {
                of.push(&second.carrier);
                for device in &second.carried.0 {
                    of.push(device);
                }
                for third in &second.carried.1 {
                    of.push(&third.carrier);
                    for device in &third.carried {
                        of.push(device);
                    }
                }
            }
        }
        for (chain, mount) in chains.iter().zip(&of.mounts) {
            let Some(carried) = chain.on().and_then(|on| of.carried.get_mut(on)) else { continue };
            let r: Vector3<f64> = chain.mount_point();
            carried.force += mount.force;
            carried.moment += mount.moment + r.cross(&mount.force);
        }
        of
    }

    /// A load by its quantity; none of any other quantity.
    pub(crate) fn number(&self, quantity: Quantity) -> Option<f64> {
        let force = |of: &[Wrench], index: usize, axis: usize| Some(of.get(index)?.force[axis]);
        let moment = |of: &[Wrench], index: usize, axis: usize| Some(of.get(index)?.moment[axis]);
        match quantity {
            Quantity::MountForce(member, axis) => force(&self.mounts, member, axis),
            Quantity::MountMoment(member, axis) => moment(&self.mounts, member, axis),
            Quantity::CarriedForce(member, axis) => force(&self.carried, member, axis),
            Quantity::CarriedMoment(member, axis) => moment(&self.carried, member, axis),
            Quantity::LoadForce(joint, axis) => force(&self.joints, joint, axis),
            Quantity::LoadMoment(joint, axis) => moment(&self.joints, joint, axis),
            _ => None,
        }
    }

    fn push<W: Each<Wrench>, U: Each<f64>, P>(&mut self, device: &DeviceLoads<W, U, P, f64>) {
        self.mounts.push(device.mount);
        self.joints.extend(device.joints.values());
        self.motors.extend(device.motors.values());
    }
}
