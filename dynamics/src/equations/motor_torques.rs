//! The motor torques of one device for known accelerations: those of [`DeviceLoads`], and nothing that they do not need.
//!
//! [`DeviceLoads`]: crate::DeviceLoads

use crate::equations::assembly::expressed_in_b;
use crate::equations::device::Device;
use crate::equations::device_loads::along_joints;
use crate::equations::joint_inputs::Environment;
use crate::equations::load_sums::HubAccelerations;
use crate::equations::system::Solution;
use crate::model::kind::{Kernels, Kind, Wrenches};
use crate::numbers::each::{Each, JointStates};
use crate::numbers::vec3::rotate_transposed;

impl<K: Kind> Device<K> {
    /// The load about each joint's axis less what acts from outside, spring and friction; with the bits of
    /// [`Self::loads`].
    #[inline(never)]
    pub(crate) fn motor_torques(
        &self,
        joints: &K::Joints<K::Scalar>,
        bodies: Option<&Wrenches<K>>,
        environment: &Environment<K::Scalar>,
        hub: &HubAccelerations<K::Scalar>,
        accelerations: &K::Accelerations<K::Scalar>,
    ) -> <K as Kernels>::PerJoint<K::Scalar> {
        let pose = K::pose(joints);
        let within = |v| rotate_transposed(&self.mount, v);
        let hub = Solution { r_b_n_ddot: within(hub.r_b_n_ddot), omega_dot: within(hub.omega_dot) };
        let needed = K::loads(
            &self.constants,
            &pose,
            joints,
            &expressed_in_b(within(environment.omega)),
            &hub.expressed_in_b(),
            accelerations,
        );
        let mut motors = along_joints::<K>(&needed.joints);
        // Each is rare, and a wrench of nothing is none.
        if bodies.is_some() || self.lumped.is_some() {
            let applied = self.carried(&pose, &self.applied(joints, bodies));
            subtract::<K>(&mut motors, &applied.joints);
        }
        if let Some(central) = &environment.central {
            let (wrenches, _) = self.gradient(&pose, central);
            subtract::<K>(&mut motors, &self.carried(&pose, &wrenches).joints);
        }
        let passive = joints.states().zip(self.passive.values());
        for (motor, ([coordinate, rate], passive)) in motors.values_mut().zip(passive) {
            *motor = *motor - passive.of_spring(coordinate) - passive.of_friction(rate);
        }
        motors
    }
}

/// Subtracts the component of each wrench along its joint.
fn subtract<K: Kind>(motors: &mut <K as Kernels>::PerJoint<K::Scalar>, wrenches: &Wrenches<K>) {
    for (motor, wrench) in motors.values_mut().zip(along_joints::<K>(wrenches).values()) {
        *motor = *motor - wrench;
    }
}
