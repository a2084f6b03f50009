//! [`LoadColumns`]: derivatives of the loads of each device by its emitted kernel, with the device's joints eliminated.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use alloc::vec;
use alloc::vec::Vec;

use crate::derivatives::loads::joint_elimination::JointElimination;
use crate::derivatives::loads::kernel::{NotEmitted, check_count, check_coupled};
#[cfg(feature = "lanes")]
use crate::derivatives::loads::kernel_in_lanes::GroupKernel;
use crate::derivatives::loads::kernel_loads::{KernelInputs, KernelLoads};
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

/// A joint's device.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// The device's first joint, of all.
    pub(crate) first: usize,
    /// The number of its joints.
    pub(crate) count: usize,
    /// The number of its first group of [`LoadColumns::groups`], and of the first line of [`LoadColumns::lines`].
    pub(crate) group: usize,
    pub(crate) line: usize,
    /// Whether the joint's acceleration is not given.
    pub(crate) free: bool,
}

/// The number of joints of a device, and these eliminated.
type Kept<T> = (usize, JointElimination<T, MAX_JOINTS>);

/// Those of all devices with their joints eliminated.
#[derive(Debug)]
pub(crate) struct LoadColumns<T> {
    /// Of each joint.
    pub(crate) places: Vec<Place>,
    /// By the coordinates of the joints of a device, by their rates and by what drives them (the motor of a free joint, the
    /// acceleration of one whose acceleration is given), some side by side, device by device: what is left for the hub's
    /// equations, on their right side.
    pub(crate) groups: Vec<HubGroup<T>>,
    /// The same, by how much less the device's joints accelerate: a line for each joint, group by group.
    pub(crate) lines: Vec<[T; TOGETHER]>,
    /// By the angular velocity of the hub, B axes: what is left for the hub, of all devices.
    pub(crate) omega: [Six<T>; 3],
    /// The same, of each joint.
    pub(crate) joints_by_omega: Vec<Vec3<T>>,
    pub(crate) gains: Gains<T>,
    /// Of each device, where it is kept.
    pub(crate) eliminated: Option<Vec<Kept<T>>>,
    /// What the devices add to the hub's matrix, by columns.
    pub(crate) matrix: [Six<T>; 6],
}

impl<T: Scalar> LoadColumns<T> {
    /// Of no device; `joints` are expected.
    fn new(joints: usize) -> Self {
        Self {
            places: Vec::with_capacity(joints),
            // Of devices of one joint, which have most groups.
            groups: Vec::with_capacity(joints),
            // Of devices of three.
            lines: Vec::with_capacity(joints.saturating_mul(3)),
            omega: [[zero(); 6]; 3],
            joints_by_omega: Vec::with_capacity(joints),
            gains: Gains::new(joints),
            eliminated: None,
            matrix: [[zero(); 6]; 6],
        }
    }
}

/// Evaluates the kernel of each device.
pub(crate) struct EachDevice<T> {
    by: Arithmetic,
    omega: Vec3<T>,
    /// As seen from a frame that falls with the field.
    hub: HubAccelerations<T>,
    pub(crate) found: LoadColumns<T>,
    /// Of a device, or of those side by side.
    loads: Vec<KernelLoads<T>>,
}

impl<T: Scalar> EachDevice<T> {
    pub(crate) fn new(
        by: Arithmetic,
        omega: Vec3<T>,
        hub: HubAccelerations<T>,
        joints: usize,
    ) -> Self {
        Self { by, omega, hub, found: LoadColumns::new(joints), loads: vec![KernelLoads::none()] }
    }

    /// Keeps the elimination of each device.
    pub(crate) fn keeping_eliminations(mut self) -> Self {
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
        let (mass, coupling) = loads.by_accelerations::<N>(mount);
        let eliminated = JointElimination::new(&mass, &coupling, *free);
        eliminated.reduce(&mut self.matrix);
        let (first, group, line) = (self.places.len(), self.groups.len(), self.lines.len());
        for (gains, free) in eliminated.gains.iter().zip(free) {
            self.gains.push(gains);
            self.places.push(Place { first, count: N, group, line, free: *free });
        }
        for number in 0..(3 * N).div_ceil(TOGETHER) {
            let (mut hub, mut lines) = match loads.states().get(number) {
                Some(LoadGroup { hub, joints }) if number < (2 * N).div_ceil(TOGETHER) => {
                    eliminated.reduced_together(&turned(hub, mount), joints)
                }
                _ => ([[zero(); TOGETHER]; 6], [[zero(); TOGETHER]; N]),
            };
            for place in 0..TOGETHER {
                let joint = (number * TOGETHER + place).wrapping_sub(2 * N);
                if joint >= N {
                    continue;
                }
                let (of_hub, of_joints) = match (free[joint], accelerated[joint]) {
                    (true, _) => eliminated.motor(joint),
                    (_, true) => {
                        let mut reduced = eliminated.reduced(&coupling[joint], &mass[joint]);
                        reduced.1[joint] = -one::<T>();
                        reduced
                    }
                    _ => ([zero(); 6], [zero(); N]),
                };
                hub.iter_mut().zip(of_hub).for_each(|(to, from)| to[place] = from);
                lines.iter_mut().zip(of_joints).for_each(|(to, from)| to[place] = from);
            }
            self.groups.push(hub);
            self.lines.extend_from_slice(&lines);
        }
        self.add_hub_rate(&loads.omega().by_b(mount), mount, &eliminated);
        if let Some(list) = &mut self.eliminated {
            list.push((N, eliminated.padded()));
        }
        let by_omega_dot = turned(&by_b(&loads.omega_dot().hub, mount), mount);
        for (row, by_axes) in by_omega_dot.iter().enumerate() {
            for (column, entry) in self.matrix.iter_mut().skip(3).zip(by_axes) {
                column[row] = column[row] + *entry;
            }
        }
    }

    /// By the angular velocity of the hub.
    #[inline(always)]
    fn add_hub_rate<const N: usize>(
        &mut self,
        LoadGroup { hub, joints }: &LoadGroup<T>,
        mount: &Columns<T>,
        eliminated: &JointElimination<T, N>,
    ) {
        let (hub, joints) = eliminated.reduced_together(&turned(hub, mount), joints);
        for (row, by_axes) in hub.iter().enumerate() {
            for (sum, entry) in self.omega.iter_mut().zip(by_axes) {
                sum[row] = sum[row] + *entry;
            }
        }
        self.joints_by_omega.extend(joints.iter().map(|[x, y, z, _]| [*x, *y, *z]));
    }
}

/// Devices of a group side by side.
#[cfg(feature = "lanes")]
impl<T: Scalar> EachDevice<T> {
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
            eliminate(self.by, &GivenJoints::of(device, modes), loads, &mut self.found);
        }
        Some(())
    }
}

impl<T: Scalar> Visit<T, Moving> for EachDevice<T> {
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
        eliminate(self.by, &GivenJoints::of(device, given.modes), loads, &mut self.found);
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
