//! [`LoadColumns`]: derivatives of the loads of all devices, with the joints of each eliminated.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

#[cfg(feature = "alloc")]
use alloc::vec::Vec;

use crate::derivatives::loads::device_reduction::{DeviceReduction, JointModes};
use crate::derivatives::loads::joint_elimination::JointElimination;
use crate::derivatives::loads::kernel_loads::KernelLoads;
#[cfg(feature = "alloc")]
use crate::derivatives::loads::mass_system::Gains;
use crate::derivatives::loads::mass_system::{Block, set_gains};
use crate::derivatives::loads::side_by_side::{HubGroup, Six, TOGETHER};
use crate::model::joint_array::MAX_JOINTS;
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::Columns;

/// By coordinate, rate and drive of a joint: what is left for the hub's equations, on their right side, and by how much less
/// the joints of its device accelerate, a line for each. What drives it is the motor of a free joint, the acceleration of
/// one whose acceleration is given.
#[derive(Clone, Copy, Debug)]
pub(crate) struct JointColumns<T> {
    /// The first joint of its device, of all, and the number of them.
    pub(crate) first: usize,
    pub(crate) count: usize,
    /// Whether the joint's acceleration is not given.
    pub(crate) free: bool,
    pub(crate) hub: HubGroup<T>,
    pub(crate) less: [[T; TOGETHER]; MAX_JOINTS],
}

impl<T: Scalar> JointColumns<T> {
    pub(crate) const fn none() -> Self {
        let (hub, less) = ([[T::ZERO; TOGETHER]; 6], [[T::ZERO; TOGETHER]; MAX_JOINTS]);
        Self { first: 0, count: 0, free: false, hub, less }
    }
}

/// The sums of all devices.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HubSums<T> {
    /// By the angular velocity of the hub, B axes: what is left for the hub.
    pub(crate) omega: HubGroup<T>,
    /// What the devices add to the hub's matrix, by columns, what is not below the diagonal.
    pub(crate) matrix: [Six<T>; 6],
}

impl<T: Scalar> HubSums<T> {
    pub(crate) const fn none() -> Self {
        Self { omega: [[T::ZERO; TOGETHER]; 6], matrix: [[T::ZERO; 6]; 6] }
    }
}

/// The number of joints of a device, and these eliminated.
#[cfg(feature = "alloc")]
type Kept<T> = (usize, JointElimination<T, MAX_JOINTS>);

/// Those of all devices with their joints eliminated.
#[cfg(feature = "alloc")]
#[derive(Debug)]
pub(crate) struct LoadColumns<T> {
    /// Those of the joints, and of lanes without a device in the last group, which are written, too.
    joints: Vec<JointColumns<T>>,
    /// How many joints there are.
    count: usize,
    /// The joint that comes next.
    pub(crate) next: usize,
    /// By how much less the joints accelerate.
    pub(crate) gains: Vec<Block<T>>,
    pub(crate) sums: HubSums<T>,
    /// Of each device, where it is kept.
    pub(crate) eliminated: Option<Vec<Kept<T>>>,
}

#[cfg(feature = "alloc")]
impl<T: Scalar> LoadColumns<T> {
    fn none() -> Self {
        Self {
            joints: Vec::new(),
            count: 0,
            next: 0,
            gains: Vec::new(),
            sums: HubSums::none(),
            eliminated: None,
        }
    }

    /// Of no device; so many joints are expected. What room there is stays.
    pub(crate) fn begin(&mut self, joints: usize) {
        (self.count, self.next) = (joints, 0);
        self.sums = HubSums::none();
        self.make_room(joints);
        self.gains.resize(joints.div_ceil(TOGETHER), [[zero(); TOGETHER]; 9]);
    }

    /// Makes room for so many joints, where there is less.
    fn make_room(&mut self, joints: usize) {
        if self.joints.len() < joints {
            self.joints.reserve_exact(joints.saturating_sub(self.joints.len()));
            self.joints.resize(joints, JointColumns::none());
        }
    }

    /// How the joints follow the hub.
    pub(crate) fn gains(&self) -> Gains<'_, T> {
        Gains { blocks: &self.gains }
    }

    /// Those of each joint.
    pub(crate) fn joints(&self) -> &[JointColumns<T>] {
        self.joints.get(..self.count).unwrap_or_default()
    }

    /// Those of each joint, to be changed, and the sums.
    pub(crate) fn joints_and_sums(&mut self) -> (&mut [JointColumns<T>], &HubSums<T>) {
        (self.joints.get_mut(..self.count).unwrap_or_default(), &self.sums)
    }

    /// Those of so many joints that come next, of lanes without a device, too.
    // Never inlined: room is made at the last group of the first state only.
    #[cfg(feature = "lanes")]
    #[inline(never)]
    pub(crate) fn next_joints_of_group(&mut self, joints: usize) -> &mut [JointColumns<T>] {
        self.make_room(self.next.saturating_add(joints));
        self.joints.get_mut(self.next..).unwrap_or_default()
    }
}

/// Where the columns of all devices are written. Kept from one state to the next, it is allocated once.
#[cfg(feature = "alloc")]
#[derive(Debug)]
pub(crate) struct LoadsWorkspace<T> {
    pub(crate) columns: LoadColumns<T>,
    /// Of a device, or of those side by side.
    pub(crate) loads: Vec<KernelLoads<T>>,
}

#[cfg(feature = "alloc")]
impl<T: Scalar> LoadsWorkspace<T> {
    pub(crate) fn new() -> Self {
        Self { columns: LoadColumns::none(), loads: Vec::new() }
    }
}

/// What is given of the joints of a device, and its mount.
pub(crate) struct GivenJoints<'a, T> {
    pub(crate) mount: &'a Columns<T>,
    pub(crate) modes: JointModes,
}

#[cfg(feature = "alloc")]
impl<T: Scalar> LoadColumns<T> {
    /// Adds a device of a number of joints.
    #[inline(always)]
    pub(crate) fn add(&mut self, count: usize, given: &GivenJoints<'_, T>, loads: &KernelLoads<T>) {
        match count {
            0 | 1 => self.add_joints::<1>(given, loads),
            2 => self.add_joints::<2>(given, loads),
            3 => self.add_joints::<3>(given, loads),
            4 => self.add_joints::<4>(given, loads),
            5 => self.add_joints::<5>(given, loads),
            6 => self.add_joints::<6>(given, loads),
            _ => self.add_joints::<MAX_JOINTS>(given, loads),
        }
    }

    /// Adds a device of so many joints.
    #[inline(always)]
    fn add_joints<const N: usize>(&mut self, given: &GivenJoints<'_, T>, loads: &KernelLoads<T>) {
        let Self { joints, gains, sums, next, eliminated, .. } = self;
        let mut to = DeviceColumns { joints, gains, sums, first: *next };
        let Some(found) = to.add::<N>(given, loads) else { return };
        if let Some(list) = eliminated {
            list.push((N, found.padded()));
        }
        *next = next.wrapping_add(N);
    }
}

/// Where a device is added: columns and gains of all joints, of which those from the first on are its own.
pub(crate) struct DeviceColumns<'a, T, const P: usize> {
    pub(crate) joints: &'a mut [JointColumns<T>],
    pub(crate) gains: &'a mut [Block<T, P>],
    pub(crate) sums: &'a mut HubSums<T>,
    pub(crate) first: usize,
}

impl<T: Scalar, const P: usize> DeviceColumns<'_, T, P> {
    /// Adds a device of so many joints; none, and nothing added, where there is no room for them.
    #[inline(always)]
    pub(crate) fn add<const N: usize>(
        &mut self,
        GivenJoints { mount, modes, .. }: &GivenJoints<'_, T>,
        loads: &KernelLoads<T>,
    ) -> Option<JointElimination<T, N>> {
        let Self { joints, gains, sums, first } = self;
        let first = *first;
        let own = joints.get_mut(first..)?.first_chunk_mut::<N>()?;
        let groups = loads.groups();
        let show = |joint: usize, hub: &HubGroup<T>, less: &[[T; TOGETHER]; N]| {
            let Some(to) = own.get_mut(joint) else { return };
            (to.first, to.count, to.free) = (first, N, modes.free[joint % MAX_JOINTS]);
            to.hub = *hub;
            to.less.iter_mut().zip(less).for_each(|(to, from)| *to = *from);
        };
        let found = DeviceReduction::<T, N, TOGETHER>::new(zero(), mount, modes, &groups, show);
        let DeviceReduction { eliminated, omega, less_by_omega, matrix } = found;
        add(sums.omega.as_flattened_mut(), omega.as_flattened());
        add(sums.matrix.as_flattened_mut(), matrix.as_flattened());
        let of_joints = eliminated.gains.iter().zip(&less_by_omega);
        for (joint, (of, [x, y, z, _])) in (first..).zip(of_joints) {
            set_gains(gains, joint, of, &[*x, *y, *z]);
        }
        Some(eliminated)
    }
}

#[inline(always)]
fn add<T: Scalar>(to: &mut [T], of: &[T]) {
    to.iter_mut().zip(of).for_each(|(to, from)| *to = *to + *from);
}
