//! [`FixedColumns`]: derivatives of the loads of a number of joints that is known when the program is compiled, without a heap.
//!
//! Devices one after another, by the instructions that the program is compiled for: the bits of
//! `EachDevice`, whose kernels and eliminations they are.

use crate::derivatives::loads::device_reduction::JointModes;
use crate::derivatives::loads::kernel::{Moving, NotEmitted, check_count, check_coupled};
use crate::derivatives::loads::kernel_loads::{KernelInputs, KernelLoads};
use crate::derivatives::loads::load_columns::{DeviceColumns, GivenJoints, HubSums, JointColumns};
use crate::derivatives::loads::mass_system::Block;
use crate::equations::arithmetic::Arithmetic;
use crate::equations::device::Device;
use crate::equations::load_sums::HubAccelerations;
use crate::isolation::carrier::Carrier;
use crate::model::joint_array::MAX_JOINTS;
use crate::model::kind::Kind;
use crate::numbers::real::Scalar;
use crate::numbers::vec3::Vec3;
use crate::sets::bundle::Bundle;
use crate::sets::carrying::{Carrying, PreparedCarrying};
use crate::sets::devices::{DeviceSet, Visit};

/// Columns and gains of the joints, and the results of the kernel of a device.
#[derive(Clone, Debug)]
pub(crate) struct FixedColumns<T, const JOINTS: usize> {
    joints: [JointColumns<T>; JOINTS],
    gains: [Block<T, 1>; JOINTS],
    sums: HubSums<T>,
    loads: KernelLoads<T>,
}

impl<T: Scalar, const JOINTS: usize> FixedColumns<T, JOINTS> {
    pub(crate) const fn none() -> Self {
        Self {
            joints: [JointColumns::none(); JOINTS],
            gains: [[[T::ZERO; 1]; 9]; JOINTS],
            sums: HubSums::none(),
            loads: KernelLoads::none(),
        }
    }
}

/// Evaluates the kernel of each device, and eliminates its joints.
pub(crate) struct FixedDevices<'a, T> {
    omega: Vec3<T>,
    /// As seen from a frame that falls with the field.
    hub: HubAccelerations<T>,
    to: DeviceColumns<'a, T, 1>,
    loads: &'a mut KernelLoads<T>,
}

/// Columns and gains of the joints that there are, and the sums.
type Found<'a, T> = (&'a mut [JointColumns<T>], &'a [Block<T, 1>], &'a HubSums<T>);

impl<'a, T: Scalar> FixedDevices<'a, T> {
    pub(crate) fn new<const JOINTS: usize>(
        (omega, hub): (Vec3<T>, HubAccelerations<T>),
        FixedColumns { joints, gains, sums, loads }: &'a mut FixedColumns<T, JOINTS>,
    ) -> Self {
        *sums = HubSums::none();
        Self { omega, hub, to: DeviceColumns { joints, gains, sums, first: 0 }, loads }
    }

    /// Those of the joints that were shown.
    pub(crate) fn found(self) -> Option<Found<'a, T>> {
        let DeviceColumns { joints, gains, sums, first } = self.to;
        Some((joints.get_mut(..first)?, gains.get(..first)?, sums))
    }

    // Never inlined: one copy of a kind for all sets.
    #[inline(never)]
    fn add<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        modes: JointModes,
    ) -> Result<(), NotEmitted> {
        let count = const { K::JOINTS.len() };
        let given = GivenJoints { mount: &device.mount, modes };
        match const { K::JOINTS.len() } {
            0 | 1 => self.to.add::<1>(&given, self.loads).map(|_| ()),
            2 => self.to.add::<2>(&given, self.loads).map(|_| ()),
            3 => self.to.add::<3>(&given, self.loads).map(|_| ()),
            4 => self.to.add::<4>(&given, self.loads).map(|_| ()),
            5 => self.to.add::<5>(&given, self.loads).map(|_| ()),
            6 => self.to.add::<6>(&given, self.loads).map(|_| ()),
            _ => self.to.add::<MAX_JOINTS>(&given, self.loads).map(|_| ()),
        }
        .ok_or(NotEmitted)?;
        self.to.first = self.to.first.wrapping_add(count);
        Ok(())
    }
}

impl<T: Scalar> Visit<T, Moving> for FixedDevices<'_, T> {
    type Error = NotEmitted;

    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        (joints, given, accelerations): <Moving as Bundle<T>>::Of<'_, K>,
    ) -> Result<(), NotEmitted> {
        check_coupled(device)?;
        check_count::<K>()?;
        let (omega, hub) = (self.omega, self.hub);
        let inputs = KernelInputs { device, joints, accelerations, omega, hub };
        self.loads.evaluate(Arithmetic::Portable, &inputs)?;
        self.add(device, JointModes::of::<K>(given.modes))
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        _: &PreparedCarrying<C, D>,
        _: <Moving as Bundle<T>>::Of<'_, Carrying<C, D>>,
    ) -> Result<(), NotEmitted> {
        Err(NotEmitted)
    }
}
