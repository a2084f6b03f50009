//! [`LoadColumns`]: derivatives of the loads of each device by its emitted kernel, with the device's joints eliminated.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use alloc::vec::Vec;

use crate::derivatives::loads::joint_elimination::JointElimination;
use crate::derivatives::loads::kernel::{NotEmitted, check_count, check_coupled, load_derivatives};
use crate::derivatives::loads::mass_system::Gains;
use crate::derivatives::loads::side_by_side::{HubGroup, LoadGroup, Six, TOGETHER, by_b, turned};
use crate::equations::arithmetic::Arithmetic;
use crate::equations::device::Device;
use crate::equations::joint_inputs::DeviceInputs;
use crate::equations::load_sums::HubAccelerations;
use crate::isolation::carrier::Carrier;
use crate::model::joint_array::MAX_JOINTS;
use crate::model::kind::Kind;
use crate::model::mode::Mode;
use crate::numbers::each::{Each, JointStates};
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::{Columns, Vec3};
use crate::sets::bundle::{Bundle, Given, Shared};
use crate::sets::carrying::{Carrying, PreparedCarrying};
use crate::sets::devices::{DeviceSet, Visit};
use crate::sets::per_device as data;

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
    kernel: KernelLoads<T>,
}

impl<T: Scalar> EachDevice<T> {
    pub(crate) fn new(
        by: Arithmetic,
        omega: Vec3<T>,
        hub: HubAccelerations<T>,
        joints: usize,
    ) -> Self {
        Self { by, omega, hub, found: LoadColumns::new(joints), kernel: KernelLoads::none() }
    }

    /// Keeps the elimination of each device.
    pub(crate) fn keeping_eliminations(mut self) -> Self {
        self.found.eliminated = Some(Vec::new());
        self
    }
}

/// State, inputs and accelerations of the joints.
pub(crate) type Moving = (Shared<data::Joints>, Given, Shared<data::Accelerations>);

/// What the kernel of a device is called with.
struct KernelInputs<'a, K: Kind> {
    device: &'a Device<K>,
    joints: &'a K::Joints<K::Scalar>,
    accelerations: &'a K::Accelerations<K::Scalar>,
    omega: Vec3<K::Scalar>,
    hub: HubAccelerations<K::Scalar>,
}

/// Results of the kernel of a device, in the device's axes, some variables side by side. Places of no variable of the
/// device keep numbers of devices before it.
#[derive(Debug)]
struct KernelLoads<T> {
    /// By the joints' coordinates and then by their rates, with springs and friction.
    states: [LoadGroup<T>; (2 * MAX_JOINTS).div_ceil(TOGETHER)],
    accelerations: [LoadGroup<T>; MAX_JOINTS.div_ceil(TOGETHER)],
    omega: LoadGroup<T>,
    omega_dot: LoadGroup<T>,
}

impl<T: Scalar> KernelLoads<T> {
    fn none() -> Self {
        let none = LoadGroup::none();
        Self {
            states: [none; (2 * MAX_JOINTS).div_ceil(TOGETHER)],
            accelerations: [none; MAX_JOINTS.div_ceil(TOGETHER)],
            omega: none,
            omega_dot: none,
        }
    }

    /// Evaluates the kernel of a device.
    #[inline(always)]
    fn set<K: Kind<Scalar = T>>(&mut self, of: &KernelInputs<'_, K>) -> Result<(), NotEmitted> {
        let KernelInputs { device, joints, accelerations, omega, hub } = of;
        let found = load_derivatives(device, joints, accelerations, (*omega, hub))?;
        let count = K::JOINTS.len();
        let passive = joints.states().zip(device.passive.values());
        let passive = passive.map(|([_, rate], of)| [of.stiffness, of.damping(rate)]);
        let columns = found.coordinates.values().zip(found.rates.values());
        for (joint, ((by_coordinate, by_rate), slopes)) in columns.zip(passive).enumerate() {
            let places = [joint, joint.saturating_add(count)];
            let columns = [&by_coordinate, &by_rate];
            for ((place, column), slope) in places.into_iter().zip(columns).zip(slopes) {
                if let Some(group) = self.states.get_mut(place / TOGETHER) {
                    group.put::<K>(place % TOGETHER, column);
                    group.add_to_joint(joint, place % TOGETHER, slope);
                }
            }
        }
        for (joint, column) in found.accelerations.values().enumerate() {
            if let Some(group) = self.accelerations.get_mut(joint / TOGETHER) {
                group.put::<K>(joint % TOGETHER, &column);
            }
        }
        self.omega.put_axes::<K>(&found.omega);
        self.omega_dot.put_axes::<K>(&found.omega_dot);
        Ok(())
    }

    /// By the joints' accelerations: the loads of the joints, and those of the hub, B axes.
    #[inline(always)]
    fn by_accelerations<const N: usize>(&self, mount: &Columns<T>) -> ([[T; N]; N], [Six<T>; N]) {
        let (mut mass, mut coupling) = ([[zero(); N]; N], [[zero(); 6]; N]);
        let by_joint = mass.chunks_mut(TOGETHER).zip(coupling.chunks_mut(TOGETHER));
        for (group, (mass, coupling)) in self.accelerations.iter().zip(by_joint) {
            let hub = turned(&group.hub, mount);
            for (place, (mass, coupling)) in mass.iter_mut().zip(coupling).enumerate() {
                for (to, from) in mass.iter_mut().zip(&group.joints) {
                    *to = from[place % TOGETHER];
                }
                for (to, from) in coupling.iter_mut().zip(&hub) {
                    *to = from[place % TOGETHER];
                }
            }
        }
        (mass, coupling)
    }
}

/// The kernel of a device by the instructions of this CPU.
#[cfg(feature = "lanes")]
struct DispatchedKernel<'a, 'b, K: Kind> {
    inputs: KernelInputs<'a, K>,
    loads: &'b mut KernelLoads<K::Scalar>,
}

#[cfg(feature = "lanes")]
impl<K: Kind> pulp::WithSimd for DispatchedKernel<'_, '_, K> {
    type Output = Result<(), NotEmitted>;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> Self::Output {
        let Self { inputs, loads } = self;
        loads.set(&inputs)
    }
}

/// A device's joints eliminated by the instructions of this CPU.
#[cfg(feature = "lanes")]
struct DispatchedElimination<'a, 'b, T> {
    given: GivenJoints<'a, T>,
    loads: &'b KernelLoads<T>,
    found: &'b mut LoadColumns<T>,
}

#[cfg(feature = "lanes")]
impl<T: Scalar> pulp::WithSimd for DispatchedElimination<'_, '_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { given, loads, found } = self;
        found.add(&given, loads);
    }
}

// Never inlined: one copy for all sets.
#[inline(never)]
fn kernel<K: Kind>(
    inputs: &KernelInputs<'_, K>,
    loads: &mut KernelLoads<K::Scalar>,
) -> Result<(), NotEmitted> {
    loads.set(inputs)
}

// Never inlined: one copy for all kinds.
#[inline(never)]
fn eliminate<T: Scalar>(
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
    fn of<K: Kind<Scalar = T>>(device: &'a Device<K>, given: &DeviceInputs<'_, K>) -> Self {
        let (mut free, mut accelerated) = ([false; MAX_JOINTS], [false; MAX_JOINTS]);
        let modes = given.modes.values().zip(K::JOINTS);
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
        let eliminated = JointElimination::new(&mass, &coupling, free);
        eliminated.reduce(&mut self.matrix);
        let (first, group, line) = (self.places.len(), self.groups.len(), self.lines.len());
        for joint in 0..N {
            self.gains.push(&eliminated.gains[joint]);
            self.places.push(Place { first, count: N, group, line, free: free[joint] });
        }
        for number in 0..(3 * N).div_ceil(TOGETHER) {
            let (mut hub, mut lines) = match loads.states.get(number) {
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
        self.add_hub_rate(&loads.omega.by_b(mount), mount, &eliminated);
        if let Some(list) = &mut self.eliminated {
            list.push((N, eliminated.padded()));
        }
        let by_omega_dot = turned(&by_b(&loads.omega_dot.hub, mount), mount);
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

impl<T: Scalar> Visit<T, Moving> for EachDevice<T> {
    type Error = NotEmitted;

    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        (joints, given, accelerations): <Moving as Bundle<T>>::Of<'_, K>,
    ) -> Result<(), NotEmitted> {
        check_coupled(device)?;
        check_count::<K>()?;
        let Self { omega, hub, found, kernel: loads, .. } = self;
        let inputs = KernelInputs { device, joints, accelerations, omega: *omega, hub: *hub };
        match self.by {
            #[cfg(feature = "lanes")]
            Arithmetic::Dispatched(cpu) => {
                cpu.dispatch(DispatchedKernel { inputs, loads: &mut *loads })?;
                let given = GivenJoints::of(device, &given);
                cpu.dispatch(DispatchedElimination { given, loads, found });
            }
            Arithmetic::Portable => {
                kernel(&inputs, loads)?;
                eliminate(&GivenJoints::of(device, &given), loads, found);
            }
        }
        Ok(())
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        _: &PreparedCarrying<C, D>,
        _: <Moving as Bundle<T>>::Of<'_, Carrying<C, D>>,
    ) -> Result<(), NotEmitted> {
        Err(NotEmitted)
    }
}
