//! [`EntryMap`]: where the devices and joints of a set, in its order, are in the caller's arrays, which have
//! the order of the entries.

use precess_dynamics::MAX_JOINTS;

use crate::MAX_DEVICES;

const JOINTS: usize = MAX_DEVICES * MAX_JOINTS;

/// Entry of each device, entry and number of each joint, in the order of the set.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EntryMap {
    entries: [u8; MAX_DEVICES],
    devices: u8,
    joints: [[u8; 2]; JOINTS],
    count: u8,
}

impl EntryMap {
    /// Of no devices.
    pub(crate) const fn none() -> Self {
        Self { entries: [0; MAX_DEVICES], devices: 0, joints: [[0; 2]; JOINTS], count: 0 }
    }

    /// Adds the next device, of an entry, with so many joints.
    pub(crate) fn add(&mut self, entry: usize, joints: usize) {
        let small = |number: usize| u8::try_from(number).unwrap_or(u8::MAX);
        if let Some(to) = self.entries.get_mut(usize::from(self.devices)) {
            *to = small(entry);
            self.devices = self.devices.saturating_add(1);
        }
        for joint in 0..joints.min(MAX_JOINTS) {
            if let Some(to) = self.joints.get_mut(usize::from(self.count)) {
                *to = [small(entry), small(joint)];
                self.count = self.count.saturating_add(1);
            }
        }
    }

    /// The entry of a device of the set.
    pub(crate) fn entry(&self, device: usize) -> usize {
        self.entries.get(device).map_or(device, |entry| usize::from(*entry))
    }

    /// Entry and number of each joint, in the order of the set.
    pub(crate) fn joints(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        let joints = self.joints.iter().take(usize::from(self.count));
        joints.map(|joint| joint.map(usize::from))
    }

    /// How many joints an entry has.
    pub(crate) fn joints_of(&self, entry: usize) -> usize {
        self.joints().filter(|[of, _]| *of == entry).count()
    }

    /// How many joints there are.
    pub(crate) fn count(&self) -> usize {
        usize::from(self.count)
    }
}
