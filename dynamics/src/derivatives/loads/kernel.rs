//! [`load_derivatives`]: the emitted kernel of a device, with the motion of what it stands on in the device's axes.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use crate::equations::assembly::expressed_in_b;
use crate::equations::device::Device;
use crate::equations::load_sums::HubAccelerations;
use crate::equations::system::Solution;
use crate::model::kind::{Kind, LoadDerivatives};
use crate::numbers::vec3::{Vec3, rotate_transposed};
use crate::sets::bundle::{Given, Shared};
use crate::sets::per_device as data;

/// State, inputs and accelerations of the joints.
pub(crate) type Moving = (Shared<data::Joints>, Given, Shared<data::Accelerations>);

/// A device has no emitted derivatives: a platform, the lumped model, more joints than
/// [`MAX_JOINTS`](crate::MAX_JOINTS).
#[derive(Debug)]
pub(crate) struct NotEmitted;

/// Rejects a device with lumped imbalance, which acts from outside.
pub(crate) fn check_coupled<K: Kind>(device: &Device<K>) -> Result<(), NotEmitted> {
    if device.lumped.is_some() { Err(NotEmitted) } else { Ok(()) }
}

/// Rejects kinds of more joints than arrays of one device have.
pub(crate) fn check_count<K: Kind>() -> Result<(), NotEmitted> {
    let fits = K::JOINTS.len() <= crate::model::joint_array::MAX_JOINTS;
    if fits { Ok(()) } else { Err(NotEmitted) }
}

/// Of a device on a base of this motion, in the axes of the base: results are in those of the device.
#[inline(always)]
pub(crate) fn load_derivatives<K: Kind>(
    device: &Device<K>,
    joints: &K::Joints<K::Scalar>,
    accelerations: &K::Accelerations<K::Scalar>,
    (omega, base): (Vec3<K::Scalar>, &HubAccelerations<K::Scalar>),
) -> Result<LoadDerivatives<K, K::Scalar>, NotEmitted> {
    let within = |v| rotate_transposed(&device.mount, v);
    let hub = Solution { r_b_n_ddot: within(base.r_b_n_ddot), omega_dot: within(base.omega_dot) };
    let (pose, omega) = (K::pose(joints), expressed_in_b(within(omega)));
    let hub = hub.expressed_in_b();
    K::load_derivatives(&device.constants, &pose, joints, &omega, &hub, accelerations)
        .ok_or(NotEmitted)
}
