//! [`KernelLoads`]: results of the emitted kernel `load_derivatives` of a device, some variables side by side.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use crate::derivatives::loads::device_reduction::DeviceGroups;
use crate::derivatives::loads::kernel::{NotEmitted, load_derivatives};
use crate::derivatives::loads::side_by_side::{LoadGroup, TOGETHER};
use crate::equations::arithmetic::Arithmetic;
use crate::equations::device::Device;
use crate::equations::load_sums::HubAccelerations;
use crate::model::joint_array::MAX_JOINTS;
use crate::model::kind::{Kernels, Kind, LoadColumn, LoadDerivatives};
use crate::numbers::each::{Each, JointStates};
use crate::numbers::real::{Real, Scalar};
use crate::numbers::vec3::{Vec3, components};

/// Groups of variables: of each joint its coordinate, rate and acceleration; the hub's angular velocity and its
/// derivative.
pub(crate) const OMEGA: usize = MAX_JOINTS;
pub(crate) const OMEGA_DOT: usize = OMEGA + 1;
const GROUPS: usize = OMEGA_DOT + 1;

/// Places in the group of a joint.
pub(crate) const COORDINATE: usize = 0;
pub(crate) const RATE: usize = 1;
/// Its acceleration; where joints are eliminated, what drives it.
pub(crate) const DRIVE: usize = 2;

/// What the kernel of a device is called with.
pub(crate) struct KernelInputs<'a, K: Kind> {
    pub(crate) device: &'a Device<K>,
    pub(crate) joints: &'a K::Joints<K::Scalar>,
    pub(crate) accelerations: &'a K::Accelerations<K::Scalar>,
    pub(crate) omega: Vec3<K::Scalar>,
    pub(crate) hub: HubAccelerations<K::Scalar>,
}

/// Results of the kernel of a device, in the device's axes, with springs and friction. Places of no variable of the device
/// keep numbers of devices before it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct KernelLoads<T> {
    groups: [LoadGroup<T>; GROUPS],
}

impl<T: Scalar> KernelLoads<T> {
    pub(crate) const fn none() -> Self {
        Self { groups: [LoadGroup::none(T::ZERO); GROUPS] }
    }

    /// Evaluates the kernel of a device.
    pub(crate) fn evaluate<K: Kind<Scalar = T>>(
        &mut self,
        by: Arithmetic,
        inputs: &KernelInputs<'_, K>,
    ) -> Result<(), NotEmitted> {
        match by {
            #[cfg(feature = "lanes")]
            Arithmetic::Dispatched(cpu) => cpu.dispatch(Dispatched { inputs, loads: self }),
            Arithmetic::Portable => portable(inputs, self),
        }
    }

    #[inline(always)]
    fn set<K: Kind<Scalar = T>>(&mut self, of: &KernelInputs<'_, K>) -> Result<(), NotEmitted> {
        let KernelInputs { device, joints, accelerations, omega, hub } = of;
        let found = load_derivatives(device, joints, accelerations, (*omega, hub))?;
        show(
            &found,
            #[inline(always)]
            |place, number| self.put(place, number),
        );
        self.add_passive(device, joints);
        Ok(())
    }

    /// Sets a number.
    #[inline(always)]
    pub(crate) fn put(&mut self, [group, row, place]: [usize; 3], number: T) {
        if let Some(group) = self.groups.get_mut(group) {
            group.put(row, place, number);
        }
    }

    /// Adds the slopes of springs and friction.
    #[inline(always)]
    pub(crate) fn add_passive<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        joints: &K::Joints<T>,
    ) {
        let passive = joints.states().zip(device.passive.values());
        for (joint, (([_, rate], of), group)) in passive.zip(&mut self.groups).enumerate() {
            let Some(own) = group.joints.get_mut(joint) else { continue };
            own[COORDINATE] = own[COORDINATE] + of.stiffness;
            own[RATE] = own[RATE] + of.damping(rate);
        }
    }

    /// As a reduction takes them, and of joints that the device does not have.
    #[inline(always)]
    pub(crate) fn groups(&self) -> DeviceGroups<'_, T, MAX_JOINTS, TOGETHER> {
        let [joints @ .., omega, omega_dot] = &self.groups;
        DeviceGroups { joints, omega, omega_dot: &omega_dot.hub }
    }
}

/// Shows each number of a device with its group, row (of the hub's load, then of the joints') and place.
#[inline(always)]
pub(crate) fn show<K: Kernels, T: Real>(
    found: &LoadDerivatives<K, T>,
    mut put: impl FnMut([usize; 3], T),
) {
    let mut joint = 0;
    K::zip_per_joint(
        &found.coordinates,
        &found.rates,
        #[inline(always)]
        |by_coordinate, by_rate| {
            show_column::<K, T>([joint, COORDINATE], &by_coordinate, &mut put);
            show_column::<K, T>([joint, RATE], &by_rate, &mut put);
            joint = joint.wrapping_add(1);
        },
    );
    let mut joint = 0;
    K::zip_per_joint(
        &found.accelerations,
        &found.accelerations,
        #[inline(always)]
        |column, _| {
            show_column::<K, T>([joint, DRIVE], &column, &mut put);
            joint = joint.wrapping_add(1);
        },
    );
    let ([a, b, c], [d, e, f]) = (&found.omega, &found.omega_dot);
    show_column::<K, T>([OMEGA, 0], a, &mut put);
    show_column::<K, T>([OMEGA, 1], b, &mut put);
    show_column::<K, T>([OMEGA, 2], c, &mut put);
    show_column::<K, T>([OMEGA_DOT, 0], d, &mut put);
    show_column::<K, T>([OMEGA_DOT, 1], e, &mut put);
    show_column::<K, T>([OMEGA_DOT, 2], f, &mut put);
}

/// The same of one column.
#[inline(always)]
fn show_column<K: Kernels, T: Real>(
    [group, place]: [usize; 2],
    of: &LoadColumn<K, T>,
    put: &mut impl FnMut([usize; 3], T),
) {
    let ([a, b, c], [d, e, f]) = (components(&of.hub.force), components(&of.hub.moment));
    put([group, 0, place], a);
    put([group, 1, place], b);
    put([group, 2, place], c);
    put([group, 3, place], d);
    put([group, 4, place], e);
    put([group, 5, place], f);
    let mut row = 6;
    K::zip_per_joint(
        &of.joints,
        &of.joints,
        #[inline(always)]
        |number, _| {
            put([group, row, place], number);
            row = row.wrapping_add(1);
        },
    );
}

/// The kernel of a device by the instructions of this CPU.
#[cfg(feature = "lanes")]
struct Dispatched<'a, 'b, K: Kind> {
    inputs: &'a KernelInputs<'a, K>,
    loads: &'b mut KernelLoads<K::Scalar>,
}

#[cfg(feature = "lanes")]
impl<K: Kind> pulp::WithSimd for Dispatched<'_, '_, K> {
    type Output = Result<(), NotEmitted>;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> Self::Output {
        self.loads.set(self.inputs)
    }
}

// Never inlined: one copy for all sets.
#[inline(never)]
fn portable<K: Kind>(
    inputs: &KernelInputs<'_, K>,
    loads: &mut KernelLoads<K::Scalar>,
) -> Result<(), NotEmitted> {
    loads.set(inputs)
}
