//! [`EachDevice`]: the emitted kernel of each device, one after another or side by side, and its joints eliminated.

#![cfg_attr(
    feature = "lanes",
    expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")
)]

use alloc::vec::Vec;

use crate::derivatives::loads::device_reduction::JointModes;
use crate::derivatives::loads::kernel::{Moving, NotEmitted, check_count, check_coupled};
#[cfg(feature = "lanes")]
use crate::derivatives::loads::kernel_in_lanes::{Found, GroupKernel, LanedKernel, Slopes};
use crate::derivatives::loads::kernel_loads::{KernelInputs, KernelLoads};
use crate::derivatives::loads::load_columns::{GivenJoints, LoadColumns, LoadsWorkspace};
use crate::equations::arithmetic::Arithmetic;
use crate::equations::device::Device;
use crate::equations::load_sums::HubAccelerations;
#[cfg(feature = "lanes")]
use crate::equations::side_by_side::fallbacks;
#[cfg(feature = "lanes")]
use crate::equations::side_by_side::group::DeviceGroup;
use crate::isolation::carrier::Carrier;
#[cfg(feature = "lanes")]
use crate::model::kernels::Kernels;
use crate::model::kind::Kind;
#[cfg(feature = "lanes")]
use crate::model::mode::Mode;
#[cfg(feature = "lanes")]
use crate::numbers::each::Each;
#[cfg(feature = "lanes")]
use crate::numbers::each::JointStates;
#[cfg(feature = "lanes")]
use crate::numbers::laned::WIDEST;
use crate::numbers::real::Scalar;
use crate::numbers::vec3::Vec3;
use crate::sets::bundle::Bundle;
#[cfg(feature = "lanes")]
use crate::sets::bundle::{MemberIndex, Part};
use crate::sets::carrying::{Carrying, PreparedCarrying};
#[cfg(feature = "lanes")]
use crate::sets::devices::Devices;
use crate::sets::devices::{DeviceSet, Visit};
#[cfg(feature = "lanes")]
use crate::sets::enumeration::{DeviceEnum, Variant, WithKind};
#[cfg(feature = "lanes")]
use crate::sets::per_device as data;
#[cfg(feature = "lanes")]
use crate::solve::rows::{copy, members};

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
        Self { by, omega, hub, found, loads }
    }

    /// Keeps the elimination of each device.
    pub(crate) fn keeping_eliminations(self) -> Self {
        self.found.eliminated = Some(Vec::new());
        self
    }
}

/// A device's joints eliminated by the instructions of this CPU.
#[cfg(feature = "lanes")]
struct Dispatched<'a, 'b, T> {
    count: usize,
    given: &'a GivenJoints<'a, T>,
    loads: &'b KernelLoads<T>,
    found: &'b mut LoadColumns<T>,
}

#[cfg(feature = "lanes")]
impl<T: Scalar> pulp::WithSimd for Dispatched<'_, '_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { count, given, loads, found } = self;
        found.add(count, given, loads);
    }
}

/// Eliminates the joints of a device.
fn eliminate<K: Kind>(
    by: Arithmetic,
    device: &Device<K>,
    modes: JointModes,
    loads: &KernelLoads<K::Scalar>,
    found: &mut LoadColumns<K::Scalar>,
) {
    let (count, given) = (K::JOINTS.len(), &GivenJoints { mount: &device.mount, modes });
    match by {
        #[cfg(feature = "lanes")]
        Arithmetic::Dispatched(cpu) => cpu.dispatch(Dispatched { count, given, loads, found }),
        Arithmetic::Portable => portable(count, given, loads, found),
    }
}

// Never inlined: one copy for all kinds.
#[inline(never)]
fn portable<T: Scalar>(
    count: usize,
    given: &GivenJoints<'_, T>,
    loads: &KernelLoads<T>,
    found: &mut LoadColumns<T>,
) {
    found.add(count, given, loads);
}

/// Joints of a device, their modes, their accelerations.
#[cfg(feature = "lanes")]
type Member<'a, K> = (
    &'a <K as Kernels>::Joints<<K as Kind>::Scalar>,
    &'a <K as Kernels>::PerJoint<Mode<<K as Kind>::Scalar>>,
    &'a <K as Kernels>::Accelerations<<K as Kind>::Scalar>,
);

/// Devices of a group side by side.
#[cfg(feature = "lanes")]
impl<T: Scalar> EachDevice<'_, T> {
    /// Adds them; none, and nothing added, where lanes do not support them.
    fn group<'d, K: Kind<Scalar = T>>(
        &mut self,
        group: &DeviceGroup<K>,
        devices: impl Iterator<Item = &'d Device<K>>,
        members: [Member<'_, K>; WIDEST],
    ) -> Option<()> {
        check_count::<K>().ok()?;
        let width = group.registers.width();
        let modes = members.each_ref().map(|(_, modes, _)| JointModes::of::<K>(modes));
        let [first, ..] = modes;
        let alike = modes.iter().all(|of| *of == first) && self.found.eliminated.is_none();
        let kernel = LanedKernel {
            group,
            joints: members.each_ref().map(|(joints, ..)| *joints),
            accelerations: members.each_ref().map(|(.., accelerations)| *accelerations),
            omega: self.omega,
            hub: self.hub,
        };
        if alike {
            let slopes = (!group.blocks.free).then(|| slopes(devices, &kernel.joints));
            let (slopes, columns) = (slopes.as_ref(), &mut *self.found);
            return GroupKernel { kernel, to: Found::Eliminated { modes: first, slopes, columns } }
                .run();
        }
        // Of the widest group so far: a narrower one has the first of them.
        self.loads.resize(width.max(self.loads.len()), KernelLoads::none());
        let lanes = self.loads.get_mut(..width)?;
        GroupKernel { kernel, to: Found::Loads(&mut *lanes) }.run()?;
        // The rest of the row follows the group, and members beyond it repeat its last.
        let each = devices.zip(members).zip(modes).zip(lanes).take(group.devices);
        for (((device, (joints, ..)), modes), loads) in each {
            loads.add_passive(device, joints);
            eliminate(self.by, device, modes, loads, self.found);
        }
        Some(())
    }
}

/// The slopes of springs and friction of each device: by coordinates, by rates.
#[cfg(feature = "lanes")]
fn slopes<'d, K: Kind>(
    devices: impl Iterator<Item = &'d Device<K>>,
    joints: &[&K::Joints<K::Scalar>; WIDEST],
) -> Slopes<K> {
    let none = <K as Kind>::all(0.0);
    let mut slopes = [[none; WIDEST]; 2];
    let [stiffness, damping] = &mut slopes;
    let lanes = stiffness.iter_mut().zip(damping).zip(devices.zip(joints));
    for ((stiffness, damping), (device, joints)) in lanes {
        let passive = joints.states().zip(device.passive.values());
        let to = stiffness.values_mut().zip(damping.values_mut());
        for ((stiffness, damping), ([_, rate], of)) in to.zip(passive) {
            (*stiffness, *damping) = (of.stiffness.to_f64(), of.damping(rate).to_f64());
        }
    }
    slopes
}

/// The row of an enumeration's devices that begins with one whose kind is to be found.
#[cfg(feature = "lanes")]
struct Row<'r, 'a: 'r, 'd: 'r, T: Scalar, N: DeviceEnum<Scalar = T>, W: DeviceSet<Scalar = T>> {
    each: &'r mut EachDevice<'a, T>,
    devices: &'r [N::Prepared],
    data: &'r <Moving as Bundle<T>>::Of<'d, W>,
    first: usize,
}

#[cfg(feature = "lanes")]
impl<T: Scalar, N, W> WithKind<N> for Row<'_, '_, '_, T, N, W>
where
    N: DeviceEnum<Scalar = T>,
    W: DeviceSet<Scalar = T>,
    MemberIndex: Part<W, Of = N>,
{
    /// How many devices the group has, and whether it was added; otherwise they are to be added one after another.
    type Output = (usize, bool);

    fn with<K: Variant<N>>(self, device: &Device<K>) -> (usize, bool) {
        let Some(group) = device.group.as_deref() else { return (1, false) };
        let added = self.add(group).is_some();
        if !added {
            fallbacks::count();
        }
        (group.devices, added)
    }
}

#[cfg(feature = "lanes")]
impl<T: Scalar, N: DeviceEnum<Scalar = T>, W: DeviceSet<Scalar = T>> Row<'_, '_, '_, T, N, W> {
    /// Adds a group; none where its data are not those of its kind, and where lanes do not support it.
    fn add<K: Variant<N>>(self, group: &DeviceGroup<K>) -> Option<()>
    where
        MemberIndex: Part<W, Of = N>,
    {
        let Self { each, devices, data: (joints, inputs, accelerations), first } = self;
        let count = group.devices;
        // Copies in the structures of the kind.
        let mut joints_of = [K::at_rest(); WIDEST];
        copy::<K, N, data::Joints, W>(joints, first, joints_of.get_mut(..count)?)?;
        let mut modes_of = [K::all(Mode::Driven); WIDEST];
        copy::<K, N, data::PerJoint<Mode<T>>, W>(inputs.modes, first, modes_of.get_mut(..count)?)?;
        let mut accelerations_of = [K::no_accelerations(); WIDEST];
        let to = accelerations_of.get_mut(..count)?;
        copy::<K, N, data::Accelerations, W>(accelerations, first, to)?;
        let members = members(0, count, |MemberIndex(lane)| {
            Some((joints_of.get(lane)?, modes_of.get(lane)?, accelerations_of.get(lane)?))
        })?;
        each.group(group, devices.iter().map_while(K::device_in_enum), members)
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
        if self.loads.is_empty() {
            self.loads.push(KernelLoads::none());
        }
        let [loads, ..] = self.loads.as_mut_slice() else { return Ok(()) };
        loads.evaluate(self.by, &inputs)?;
        eliminate(self.by, device, JointModes::of::<K>(given.modes), loads, self.found);
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
            let (joints, inputs, accelerations) = &*data;
            let members = members(first, count, |at| {
                Some((
                    at.of::<data::Joints>(joints)?,
                    at.of::<data::PerJoint<Mode<T>>>(inputs.modes)?,
                    at.of::<data::Accelerations>(accelerations)?,
                ))
            });
            if members.and_then(|of| self.group(group, devices.iter(), of)).is_some() {
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

    #[cfg(feature = "lanes")]
    fn visit_row_of_enum<N: DeviceEnum<Scalar = T> + Devices, W: DeviceSet<Scalar = T>>(
        &mut self,
        devices: &[N::Prepared],
        data: &mut <Moving as Bundle<T>>::Of<'_, W>,
        first: usize,
    ) -> Result<usize, NotEmitted>
    where
        MemberIndex: Part<W, Of = N>,
    {
        let mut count = 1;
        if let Some(device) = devices.first() {
            let row = Row::<'_, '_, '_, T, N, W> { each: &mut *self, devices, data: &*data, first };
            let (found, added) = N::with(device, row);
            if added {
                return Ok(found);
            }
            count = found;
        }
        for (lane, device) in devices.iter().enumerate().take(count) {
            let at = MemberIndex(first.saturating_add(lane));
            let Some(data) = Moving::part::<W, MemberIndex>(data, at) else { break };
            self.visit_enum::<N>(device, data)?;
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
