//! [`LoadColumns`]: derivatives of the loads of all devices, with the joints of each eliminated.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use alloc::vec::Vec;

use crate::derivatives::loads::joint_elimination::JointElimination;
use crate::derivatives::loads::kernel_loads::{DRIVE, KernelLoads};
use crate::derivatives::loads::mass_system::Gains;
use crate::derivatives::loads::side_by_side::{HubGroup, LoadGroup, Six, TOGETHER, by_b, turned};
use crate::equations::device::Device;
use crate::model::joint_array::MAX_JOINTS;
use crate::model::kind::Kind;
use crate::model::mode::Mode;
use crate::numbers::each::Each;
use crate::numbers::real::{Scalar, one, zero};
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
    fn none() -> Self {
        let (hub, less) = ([[zero(); TOGETHER]; 6], [[zero(); TOGETHER]; MAX_JOINTS]);
        Self { first: 0, count: 0, free: false, hub, less }
    }
}

/// The number of joints of a device, and these eliminated.
type Kept<T> = (usize, JointElimination<T, MAX_JOINTS>);

/// Those of all devices with their joints eliminated.
#[derive(Debug)]
pub(crate) struct LoadColumns<T> {
    pub(crate) joints: Vec<JointColumns<T>>,
    /// The joint that comes next.
    next: usize,
    /// By the angular velocity of the hub, B axes: what is left for the hub, of all devices.
    pub(crate) omega: HubGroup<T>,
    /// By how much less the joints accelerate.
    pub(crate) gains: Gains<T>,
    /// Of each device, where it is kept.
    pub(crate) eliminated: Option<Vec<Kept<T>>>,
    /// What the devices add to the hub's matrix, by columns: what their free joints take over, and by the angular
    /// acceleration.
    matrix: [Six<T>; 6],
    by_omega_dot: HubGroup<T>,
}

impl<T: Scalar> LoadColumns<T> {
    fn none() -> Self {
        Self {
            joints: Vec::new(),
            next: 0,
            omega: [[zero(); TOGETHER]; 6],
            gains: Gains::none(),
            eliminated: None,
            matrix: [[zero(); 6]; 6],
            by_omega_dot: [[zero(); TOGETHER]; 6],
        }
    }

    /// Of no device; so many joints are expected. What room there is stays.
    pub(crate) fn begin(&mut self, joints: usize) {
        let nothing = [[zero(); TOGETHER]; 6];
        (self.next, self.omega, self.by_omega_dot) = (0, nothing, nothing);
        self.matrix = [[zero(); 6]; 6];
        self.joints.resize(joints, JointColumns::none());
        self.gains.resize(joints);
    }

    /// What the devices add to the hub's matrix, by columns.
    pub(crate) fn matrix(&self) -> [Six<T>; 6] {
        let mut matrix = self.matrix;
        for (row, by_axes) in self.by_omega_dot.iter().enumerate() {
            for (column, entry) in matrix.iter_mut().skip(3).zip(by_axes) {
                column[row] = column[row] + *entry;
            }
        }
        matrix
    }
}

/// Where the columns of all devices are written. Kept from one state to the next, it is allocated once.
#[derive(Debug)]
pub(crate) struct LoadsWorkspace<T> {
    pub(crate) columns: LoadColumns<T>,
    /// Of a device, or of those side by side.
    pub(crate) loads: Vec<KernelLoads<T>>,
}

impl<T: Scalar> LoadsWorkspace<T> {
    pub(crate) fn new() -> Self {
        Self { columns: LoadColumns::none(), loads: Vec::new() }
    }
}

/// What is given of the joints of a device, and its mount.
pub(crate) struct GivenJoints<'a, T> {
    mount: &'a Columns<T>,
    count: usize,
    /// Which joints have an acceleration that is not given.
    free: [bool; MAX_JOINTS],
    /// Which have one that is prescribed.
    accelerated: [bool; MAX_JOINTS],
}

impl<'a, T: Scalar> GivenJoints<'a, T> {
    pub(crate) fn of<K: Kind<Scalar = T>>(
        device: &'a Device<K>,
        modes: &K::PerJoint<Mode<T>>,
    ) -> Self {
        let (mut free, mut accelerated) = ([false; MAX_JOINTS], [false; MAX_JOINTS]);
        let modes = modes.values().zip(K::JOINTS);
        for ((free, accelerated), (mode, info)) in free.iter_mut().zip(&mut accelerated).zip(modes)
        {
            *free = mode == Mode::Driven && info.driven;
            *accelerated = matches!(mode, Mode::Prescribed(_)) && info.driven;
        }
        Self { mount: &device.mount, count: K::JOINTS.len(), free, accelerated }
    }
}

impl<T: Scalar> LoadColumns<T> {
    /// Adds a device.
    #[inline(always)]
    pub(crate) fn add(&mut self, given: &GivenJoints<'_, T>, loads: &KernelLoads<T>) {
        match given.count {
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
        let GivenJoints { mount, free, accelerated, .. } = given;
        let first = self.next;
        let own = self.joints.get_mut(first..).and_then(|of| of.first_chunk_mut::<N>());
        let Some(own) = own else { return };
        let (mut mass, mut coupling) = ([[zero(); N]; N], [[zero(); 6]; N]);
        for (joint, (to, of)) in own.iter_mut().zip(loads.joints()).enumerate() {
            to.hub = turned(&of.hub, mount);
            mass[joint] = core::array::from_fn(|row| of.joints[row][DRIVE]);
            coupling[joint] = to.hub.map(|row| row[DRIVE]);
        }
        let eliminated = JointElimination::new(&mass, &coupling, *free);
        eliminated.reduce(&mut self.matrix);
        for (joint, (to, of)) in own.iter_mut().zip(loads.joints()).enumerate() {
            (to.first, to.count, to.free) = (first, N, free[joint]);
            let mut less = eliminated.reduce_together(&mut to.hub, &of.joints);
            if free[joint] {
                eliminated.motor(joint, &mut to.hub, &mut less);
            } else if accelerated[joint] {
                less[joint][DRIVE] = -one::<T>();
            } else {
                to.hub.iter_mut().chain(&mut less).for_each(|row| row[DRIVE] = zero());
            }
            to.less.iter_mut().zip(less).for_each(|(to, from)| *to = from);
        }
        let LoadGroup { hub, joints } = loads.omega();
        let mut by_omega = turned(&by_b(hub, mount), mount);
        let mut loads_of = [[zero(); TOGETHER]; MAX_JOINTS];
        for (to, from) in loads_of.iter_mut().zip(joints).take(N) {
            [*to] = by_b(&[*from], mount);
        }
        let by_omega_of_joints = eliminated.reduce_together(&mut by_omega, &loads_of);
        add(&mut self.omega, &by_omega);
        for (joint, by_omega) in by_omega_of_joints.iter().enumerate() {
            self.gains.set(first.wrapping_add(joint), &eliminated.gains[joint], by_omega);
        }
        if let Some(list) = &mut self.eliminated {
            list.push((N, eliminated.padded()));
        }
        add(&mut self.by_omega_dot, &turned(&by_b(&loads.omega_dot().hub, mount), mount));
        self.next = first.wrapping_add(N);
    }
}

#[inline(always)]
fn add<T: Scalar>(to: &mut HubGroup<T>, of: &HubGroup<T>) {
    let numbers = to.as_flattened_mut().iter_mut().zip(of.as_flattened());
    numbers.for_each(|(to, from)| *to = *to + *from);
}
