//! [`DeviceGroup`]: devices of one kind in a row that are evaluated side by side.

use std::sync::{Arc, OnceLock};
use std::vec::Vec;

use super::blocks::DeviceBlocks;
use super::registers::Registers;
use super::thresholds::side_by_side;
use crate::equations::device::Device;
use crate::model::kernels::Kernels;
use crate::model::kind::Kind;
use crate::numbers::laned::Block;
use crate::numbers::real::Scalar;

/// Devices of one kind in a row that are evaluated side by side.
#[derive(Clone, Debug)]
pub(crate) struct DeviceGroup<K: Kernels> {
    pub(crate) blocks: DeviceBlocks<K>,
    pub(crate) registers: Registers,
    /// How many devices there are.
    pub(crate) devices: usize,
    /// One in their lanes, the first.
    pub(crate) weight: Block,
    /// How many gains there are: known once the devices were eliminated.
    pub(crate) shape: OnceLock<K::Gains<()>>,
}

/// The group of a device and of those after it, and how many devices it has; none of one device, and
/// of devices that are faster one after another.
pub(crate) fn group<'a, K: Kind>(
    devices: impl Iterator<Item = &'a Device<K>>,
) -> (usize, Option<Arc<DeviceGroup<K>>>) {
    let widest = match Registers::widest() {
        Some(registers) if K::Scalar::IS_F64 => registers.width(),
        _ => return (1, None),
    };
    let mut devices: Vec<_> = devices.take(widest).collect();
    let Some(count) = side_by_side(K::NAME, K::JOINTS.len(), devices.len(), widest) else {
        return (1, None);
    };
    devices.truncate(count);
    let Some(registers) = Registers::for_devices(count) else { return (1, None) };
    let mut weight = Block::ZERO;
    (0..count).for_each(|lane| weight.put(lane, 1.0));
    let made = |blocks| {
        let shape = OnceLock::new();
        Arc::new(DeviceGroup { blocks, registers, devices: count, weight, shape })
    };
    (count, DeviceBlocks::of(&devices).map(made))
}

/// Writes the group of each device in a row that begins one.
pub(crate) fn set_groups<K: Kind>(devices: &mut [Device<K>]) {
    let mut rest = devices;
    loop {
        let (count, group) = group(rest.iter());
        let Some((first, _)) = rest.split_first_mut() else { return };
        first.group = group;
        rest = match rest.split_at_mut_checked(count) {
            Some((_, rest)) => rest,
            None => return,
        };
    }
}
