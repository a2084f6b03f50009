//! [`LoadColumns`]: derivatives of the loads of each device by its emitted kernel, with the device's joints eliminated.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use alloc::vec::Vec;

use crate::derivatives::loads::joint_elimination::JointElimination;
use crate::derivatives::loads::kernel::{NotEmitted, check_count, check_coupled};
#[cfg(feature = "lanes")]
use crate::derivatives::loads::kernel_in_lanes::GroupKernel;
use crate::derivatives::loads::kernel_loads::{DRIVE, KernelInputs, KernelLoads};
use crate::derivatives::loads::mass_system::Gains;
use crate::derivatives::loads::side_by_side::{HubGroup, LoadGroup, Six, TOGETHER, by_b, turned};
use crate::equations::arithmetic::Arithmetic;
use crate::equations::device::Device;
use crate::equations::load_sums::HubAccelerations;
#[cfg(feature = "lanes")]
use crate::equations::side_by_side::fallbacks;
#[cfg(feature = "lanes")]
use crate::equations::side_by_side::group::DeviceGroup;
use crate::isolation::carrier::Carrier;
use crate::model::joint_array::MAX_JOINTS;
use crate::model::kind::Kind;
use crate::model::mode::Mode;
use crate::numbers::each::Each;
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::{Columns, Vec3};
use crate::sets::bundle::{Bundle, Given, Shared};
#[cfg(feature = "lanes")]
use crate::sets::bundle::{MemberIndex, Part};
use crate::sets::carrying::{Carrying, PreparedCarrying};
use crate::sets::devices::{DeviceSet, Visit};
use crate::sets::per_device as data;
#[cfg(feature = "lanes")]
use crate::solve::rows::members;

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
    fn begin(&mut self, joints: usize) {
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
    loads: Vec<KernelLoads<T>>,
}

impl<T: Scalar> LoadsWorkspace<T> {
    pub(crate) fn new() -> Self {
        Self { columns: LoadColumns::none(), loads: Vec::new() }
    }
}

/// Evaluates the kernel of each device.
pub(crate) struct EachDevice<'a, T> {
    by: Arithmetic,
    omega: Vec3<T>,
    /// As seen from a frame that falls with the field.
    hub: HubAccelerations<T>,
    found: &'a mut LoadColumns<T>,
    loads: &'a mut Vec<KernelLoads<T>>,
}

impl<'a, T: Scalar> EachDevice<'a, T> {
    pub(crate) fn new(
        by: Arithmetic,
        (omega, hub): (Vec3<T>, HubAccelerations<T>),
        joints: usize,
        LoadsWorkspace { columns: found, loads }: &'a mut LoadsWorkspace<T>,
    ) -> Self {
        found.begin(joints);
        if loads.is_empty() {
            loads.push(KernelLoads::none());
        }
        Self { by, omega, hub, found, loads }
    }

    /// Keeps the elimination of each device.
    pub(crate) fn keeping_eliminations(self) -> Self {
        self.found.eliminated = Some(Vec::new());
        self
    }
}

/// State, inputs and accelerations of the joints.
pub(crate) type Moving = (Shared<data::Joints>, Given, Shared<data::Accelerations>);

/// A device's joints eliminated by the instructions of this CPU.
#[cfg(feature = "lanes")]
struct Dispatched<'a, 'b, T> {
    given: &'a GivenJoints<'a, T>,
    loads: &'b KernelLoads<T>,
    found: &'b mut LoadColumns<T>,
}

#[cfg(feature = "lanes")]
impl<T: Scalar> pulp::WithSimd for Dispatched<'_, '_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { given, loads, found } = self;
        found.add(given, loads);
    }
}

/// Eliminates the joints of a device.
fn eliminate<T: Scalar>(
    by: Arithmetic,
    given: &GivenJoints<'_, T>,
    loads: &KernelLoads<T>,
    found: &mut LoadColumns<T>,
) {
    match by {
        #[cfg(feature = "lanes")]
        Arithmetic::Dispatched(cpu) => cpu.dispatch(Dispatched { given, loads, found }),
        Arithmetic::Portable => portable(given, loads, found),
    }
}

// Never inlined: one copy for all kinds.
#[inline(never)]
fn portable<T: Scalar>(
    given: &GivenJoints<'_, T>,
    loads: &KernelLoads<T>,
    found: &mut LoadColumns<T>,
) {
    found.add(given, loads);
}

/// What is given of the joints of a device, and its mount.
struct GivenJoints<'a, T> {
    mount: &'a Columns<T>,
    count: usize,
    /// Which joints have an acceleration that is not given.
    free: [bool; MAX_JOINTS],
    /// Which have one that is prescribed.
    accelerated: [bool; MAX_JOINTS],
}

impl<'a, T: Scalar> GivenJoints<'a, T> {
    fn of<K: Kind<Scalar = T>>(device: &'a Device<K>, modes: &K::PerJoint<Mode<T>>) -> Self {
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
    fn add(&mut self, given: &GivenJoints<'_, T>, loads: &KernelLoads<T>) {
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

/// Devices of a group side by side.
#[cfg(feature = "lanes")]
impl<T: Scalar> EachDevice<'_, T> {
    /// Adds them; none, and nothing added, where lanes do not support them.
    fn group<K: Kind<Scalar = T>, W: DeviceSet<Scalar = T>>(
        &mut self,
        group: &DeviceGroup<K>,
        devices: &[Device<K>],
        (joints, inputs, accelerations): &<Moving as Bundle<T>>::Of<'_, W>,
        first: usize,
    ) -> Option<()>
    where
        MemberIndex: Part<W, Of = K>,
    {
        check_count::<K>().ok()?;
        let members = members(first, group.devices, |at| {
            Some((
                at.of::<data::Joints>(joints)?,
                at.of::<data::PerJoint<Mode<T>>>(inputs.modes)?,
                at.of::<data::Accelerations>(accelerations)?,
            ))
        })?;
        let width = group.registers.width();
        // Of the widest group so far: a narrower one has the first of them.
        self.loads.resize(width.max(self.loads.len()), KernelLoads::none());
        let lanes = self.loads.get_mut(..width)?;
        GroupKernel {
            group,
            joints: members.each_ref().map(|(joints, ..)| *joints),
            accelerations: members.each_ref().map(|(.., accelerations)| *accelerations),
            omega: self.omega,
            hub: self.hub,
            loads: &mut *lanes,
        }
        .run()?;
        // The rest of the row follows the group, and members beyond it repeat its last.
        for ((device, (joints, modes, _)), loads) in
            devices.iter().zip(members).zip(lanes).take(group.devices)
        {
            loads.add_passive(device, joints);
            eliminate(self.by, &GivenJoints::of(device, modes), loads, self.found);
        }
        Some(())
    }
}

impl<T: Scalar> Visit<T, Moving> for EachDevice<'_, T> {
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
        let [loads, ..] = self.loads.as_mut_slice() else { return Ok(()) };
        loads.evaluate(self.by, &inputs)?;
        eliminate(self.by, &GivenJoints::of(device, given.modes), loads, self.found);
        Ok(())
    }

    #[cfg(feature = "lanes")]
    const ROWS: bool = T::IS_F64;

    #[cfg(feature = "lanes")]
    fn visit_row<K: Kind<Scalar = T>, W: DeviceSet<Scalar = T>>(
        &mut self,
        devices: &[Device<K>],
        data: &mut <Moving as Bundle<T>>::Of<'_, W>,
        first: usize,
    ) -> Result<usize, NotEmitted>
    where
        MemberIndex: Part<W, Of = K>,
    {
        let mut count = 1;
        if let Some(group) = devices.first().and_then(|device| device.group.as_deref()) {
            count = group.devices;
            if self.group(group, devices, data, first).is_some() {
                return Ok(count);
            }
            fallbacks::count();
        }
        for (lane, device) in devices.iter().enumerate().take(count) {
            let at = MemberIndex(first.saturating_add(lane));
            let Some(data) = Moving::part::<W, MemberIndex>(data, at) else { break };
            self.visit(device, data)?;
        }
        Ok(count)
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        _: &PreparedCarrying<C, D>,
        _: <Moving as Bundle<T>>::Of<'_, Carrying<C, D>>,
    ) -> Result<(), NotEmitted> {
        Err(NotEmitted)
    }
}
