//! [`LoadColumns`]: derivatives of the loads of each device by its emitted kernel, with the device's joints eliminated.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use alloc::vec::Vec;

use crate::derivatives::loads::kernel::{NotEmitted, check_count, check_coupled, load_derivatives};
use crate::derivatives::loads::mass_system::{Gains, JointElimination, Reduced, Six};
use crate::equations::arithmetic::Arithmetic;
use crate::equations::device::Device;
use crate::equations::joint_inputs::DeviceInputs;
use crate::equations::load_sums::HubAccelerations;
use crate::isolation::carrier::Carrier;
use crate::model::joint_array::MAX_JOINTS;
use crate::model::kind::{Kind, LoadColumn, LoadDerivatives};
use crate::model::mode::Mode;
use crate::numbers::each::{Each, JointStates};
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::{Columns, Vec3, components, rotate};
use crate::sets::bundle::{Bundle, Given, Shared};
use crate::sets::carrying::{Carrying, PreparedCarrying};
use crate::sets::devices::{DeviceSet, Visit};
use crate::sets::per_device as data;

/// By one variable: force and moment about B that the hub exerts on a device, B axes, and what each of its motors exerts
/// less spring and friction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Load<T> {
    pub(crate) hub: Six<T>,
    pub(crate) joints: [T; MAX_JOINTS],
}

/// A joint's device.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// The device's first joint, of all.
    pub(crate) first: usize,
    /// The number of its joints.
    pub(crate) count: usize,
    /// Whether the joint's acceleration is not given.
    pub(crate) free: bool,
}

/// Those of all devices with their joints eliminated, joint by joint.
#[derive(Debug)]
pub(crate) struct LoadColumns<T> {
    pub(crate) places: Vec<Place>,
    pub(crate) coordinates: Vec<Reduced<T>>,
    pub(crate) rates: Vec<Reduced<T>>,
    /// By the motor of a free joint, by the acceleration of one whose acceleration is given.
    pub(crate) driven: Vec<Reduced<T>>,
    /// By the angular velocity of the hub, B axes: what is left for the hub, of all devices.
    pub(crate) omega: [Six<T>; 3],
    /// The same, of each joint.
    pub(crate) joints_by_omega: Vec<Vec3<T>>,
    pub(crate) gains: Gains<T>,
    /// Of each device.
    pub(crate) eliminated: Vec<JointElimination<T>>,
    /// What the devices add to the hub's matrix, by columns.
    pub(crate) matrix: [Six<T>; 6],
}

impl<T: Scalar> LoadColumns<T> {
    /// Of no device; `joints` are expected.
    fn new(joints: usize) -> Self {
        let list = || Vec::with_capacity(joints);
        Self {
            places: Vec::with_capacity(joints),
            coordinates: list(),
            rates: list(),
            driven: list(),
            omega: [[zero(); 6]; 3],
            joints_by_omega: Vec::with_capacity(joints),
            gains: Gains::new(joints),
            eliminated: Vec::with_capacity(joints),
            matrix: [[zero(); 6]; 6],
        }
    }
}

impl<T: Scalar> Load<T> {
    pub(crate) fn none() -> Self {
        Self { hub: [zero(); 6], joints: [zero(); MAX_JOINTS] }
    }
}

/// Evaluates the kernel of each device.
pub(crate) struct EachDevice<T> {
    by: Arithmetic,
    omega: Vec3<T>,
    /// As seen from a frame that falls with the field.
    hub: HubAccelerations<T>,
    pub(crate) found: LoadColumns<T>,
}

impl<T: Scalar> EachDevice<T> {
    pub(crate) fn new(
        by: Arithmetic,
        omega: Vec3<T>,
        hub: HubAccelerations<T>,
        joints: usize,
    ) -> Self {
        Self { by, omega, hub, found: LoadColumns::new(joints) }
    }
}

/// State, inputs and accelerations of the joints.
pub(crate) type Moving = (Shared<data::Joints>, Given, Shared<data::Accelerations>);

/// Force and moment of a column along B.
#[inline(always)]
fn along_b<K: Kind>(column: &LoadColumn<K>, mount: &Columns<K::Scalar>) -> Six<K::Scalar> {
    let [a, b, c] = rotate(mount, components(&column.hub.force));
    let [d, e, f] = rotate(mount, components(&column.hub.moment));
    [a, b, c, d, e, f]
}

/// Columns by components along B, of those by components along the device's axes.
#[inline(always)]
fn by_b<T: Scalar, const N: usize>(of: &[[T; N]; 3], mount: &Columns<T>) -> [[T; N]; 3] {
    let ([x, y, z], [a, b, c]) = (mount, of);
    [0, 1, 2].map(|axis| {
        let mut sum = [zero(); N];
        for (to, ((a, b), c)) in sum.iter_mut().zip(a.iter().zip(b).zip(c)) {
            *to = x[axis] * *a + y[axis] * *b + z[axis] * *c;
        }
        sum
    })
}

#[inline(always)]
fn numbers<T: Scalar>(values: impl Iterator<Item = T>) -> [T; MAX_JOINTS] {
    let mut list = [zero(); MAX_JOINTS];
    list.iter_mut().zip(values).for_each(|(to, from)| *to = from);
    list
}

/// What the kernel of a device is called with.
struct KernelInputs<'a, K: Kind> {
    device: &'a Device<K>,
    joints: &'a K::Joints<K::Scalar>,
    accelerations: &'a K::Accelerations<K::Scalar>,
    omega: Vec3<K::Scalar>,
    hub: HubAccelerations<K::Scalar>,
}

impl<K: Kind> KernelInputs<'_, K> {
    #[inline(always)]
    fn load_derivatives(&self) -> Result<LoadDerivatives<K>, NotEmitted> {
        let Self { device, joints, accelerations, omega, hub } = self;
        load_derivatives(device, joints, accelerations, (*omega, hub))
    }
}

/// A device by the instructions of this CPU.
#[cfg(feature = "lanes")]
struct Dispatched<'a, 'b, K: Kind> {
    inputs: KernelInputs<'a, K>,
    given: DeviceInputs<'a, K>,
    found: &'b mut LoadColumns<K::Scalar>,
}

#[cfg(feature = "lanes")]
impl<K: Kind> pulp::WithSimd for Dispatched<'_, '_, K> {
    type Output = Result<(), NotEmitted>;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> Self::Output {
        let Self { inputs, given, found } = self;
        let kernel = inputs.load_derivatives()?;
        found.add(inputs.device, inputs.joints, &given, &kernel);
        Ok(())
    }
}

// Never inlined: one copy for all sets.
#[inline(never)]
fn portable<K: Kind>(
    inputs: &KernelInputs<'_, K>,
    given: &DeviceInputs<'_, K>,
    found: &mut LoadColumns<K::Scalar>,
) -> Result<(), NotEmitted> {
    let kernel = inputs.load_derivatives()?;
    found.add(inputs.device, inputs.joints, given, &kernel);
    Ok(())
}

impl<T: Scalar> LoadColumns<T> {
    /// Adds a device.
    #[inline(always)]
    fn add<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        joints: &K::Joints<T>,
        given: &DeviceInputs<'_, K>,
        kernel: &LoadDerivatives<K>,
    ) {
        let mount = &device.mount;
        let count = K::JOINTS.len().min(MAX_JOINTS);
        let mut free = [false; MAX_JOINTS];
        let mut accelerated = [false; MAX_JOINTS];
        let modes = given.modes.values().zip(K::JOINTS);
        for ((free, accelerated), (mode, info)) in free.iter_mut().zip(&mut accelerated).zip(modes)
        {
            *free = mode == Mode::Driven && info.driven;
            *accelerated = matches!(mode, Mode::Prescribed(_)) && info.driven;
        }
        let first = self.places.len();
        let mut by_accelerations = [Load::none(); MAX_JOINTS];
        for (to, column) in by_accelerations.iter_mut().zip(kernel.accelerations.values()) {
            *to =
                Load { hub: along_b::<K>(&column, mount), joints: numbers(column.joints.values()) };
        }
        let eliminated = JointElimination::new(&by_accelerations, free, count);
        eliminated.reduce(&mut self.matrix);
        for joint in 0..count {
            self.gains.push(&eliminated.gains[joint]);
            self.places.push(Place { first, count, free: free[joint] });
            self.driven.push(match (free[joint], accelerated[joint]) {
                (true, _) => eliminated.motor(joint),
                (_, true) => {
                    let Load { hub, joints } = &by_accelerations[joint];
                    let mut reduced = eliminated.reduced(hub, joints);
                    reduced.joints[joint] = -one::<T>();
                    reduced
                }
                _ => Reduced::none(),
            });
        }
        self.add_states::<K>(device, joints, kernel, &eliminated);
        self.add_hub_rate::<K>(device, kernel, &eliminated);
        self.eliminated.push(eliminated);
        let by_axes = kernel.omega_dot.each_ref();
        let of_hub = by_b(&by_axes.map(|column| along_b::<K>(column, mount)), mount);
        for (axis, hub) in of_hub.iter().enumerate() {
            let column = self.matrix[axis.wrapping_add(3)].iter_mut().zip(hub);
            column.for_each(|(to, from)| *to = *to + *from);
        }
    }

    /// By coordinates and rates of its joints, springs and friction among the loads.
    #[inline(always)]
    fn add_states<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        joints: &K::Joints<T>,
        kernel: &LoadDerivatives<K>,
        eliminated: &JointElimination<T>,
    ) {
        let passive = joints.states().zip(device.passive.values());
        let columns = kernel.coordinates.values().zip(kernel.rates.values());
        let each = columns.zip(passive).enumerate().take(MAX_JOINTS);
        for (joint, ((coordinate, rate), ([_, speed], passive))) in each {
            let mut by_coordinate = numbers(coordinate.joints.values());
            by_coordinate[joint] = by_coordinate[joint] + passive.stiffness;
            let mut by_rate = numbers(rate.joints.values());
            by_rate[joint] = by_rate[joint] + passive.damping(speed);
            let of_hub = [&coordinate, &rate].map(|column| along_b::<K>(column, &device.mount));
            self.coordinates.push(eliminated.reduced(&of_hub[0], &by_coordinate));
            self.rates.push(eliminated.reduced(&of_hub[1], &by_rate));
        }
    }

    /// By the angular velocity of the hub.
    #[inline(always)]
    fn add_hub_rate<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        kernel: &LoadDerivatives<K>,
        eliminated: &JointElimination<T>,
    ) {
        let (mount, by_axes) = (&device.mount, kernel.omega.each_ref());
        let of_hub = by_b(&by_axes.map(|column| along_b::<K>(column, mount)), mount);
        let of_joints = by_b(&by_axes.map(|column| numbers(column.joints.values())), mount);
        let mut by_joint = [[zero(); 3]; MAX_JOINTS];
        for (axis, (hub, own)) in of_hub.iter().zip(&of_joints).enumerate() {
            let Reduced { hub, joints } = eliminated.reduced(hub, own);
            self.omega[axis].iter_mut().zip(hub).for_each(|(to, from)| *to = *to + from);
            by_joint.iter_mut().zip(joints).for_each(|(to, from)| to[axis] = from);
        }
        self.joints_by_omega.extend(by_joint.iter().take(K::JOINTS.len()));
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
        let Self { omega, hub, found, .. } = self;
        let inputs = KernelInputs { device, joints, accelerations, omega: *omega, hub: *hub };
        match self.by {
            #[cfg(feature = "lanes")]
            Arithmetic::Dispatched(cpu) => cpu.dispatch(Dispatched { inputs, given, found }),
            Arithmetic::Portable => portable(&inputs, &given, found),
        }
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        _: &PreparedCarrying<C, D>,
        _: <Moving as Bundle<T>>::Of<'_, Carrying<C, D>>,
    ) -> Result<(), NotEmitted> {
        Err(NotEmitted)
    }
}
