//! Elimination of devices of one kind in a row, side by side in lanes where the set has grouped them.

#![expect(clippy::inline_always, reason = "part of a visit, which is inlined into its operation")]

use crate::equations::device::Device;
use crate::equations::error::SolveError;
use crate::equations::joint_inputs::{DeviceInputs, JointInputs};
use crate::equations::side_by_side::elimination::GroupElimination;
use crate::equations::side_by_side::fallbacks;
use crate::equations::side_by_side::group::DeviceGroup;
use crate::model::kind::{Kind, Wrenches};
use crate::model::mode::Mode;
use crate::model::wrench::Wrench;
use crate::numbers::laned::WIDEST;
use crate::numbers::real::Scalar;
use crate::sets::bundle::{Bundle, MemberIndex, Part};
use crate::sets::devices::{DeviceSet, Devices, SetInputs, Visit};
use crate::sets::enumeration::{DeviceEnum, Variant, WithKind};
use crate::sets::per_device::{Joints, Motors, PerDevice, PerJoint};
use crate::solve::elimination::{Eliminate, Eliminated, Elimination};

/// State and inputs of the joints of a set, and its gains.
type Data<'a, T, W> = <Eliminated as Bundle<T>>::Of<'a, W>;

/// Modes of the joints, and wrenches on the bodies.
type Modes<T> = PerJoint<Mode<T>>;
type Bodies<T> = PerJoint<Wrench<T>>;

/// Eliminates the first of these devices, or the group that it begins. Returns how many.
#[inline(always)]
pub(crate) fn visit<K: Kind<Scalar = T>, T: Scalar, E: Eliminate<T>, W: DeviceSet<Scalar = T>>(
    elimination: &mut Elimination<'_, T, E>,
    devices: &[Device<K>],
    data: &mut Data<'_, T, W>,
    first: usize,
) -> Result<usize, SolveError<T>>
where
    MemberIndex: Part<W, Of = K>,
{
    let mut count = 1;
    if let Some(group) = devices.first().and_then(|device| device.group.as_deref())
        && elimination.groups.is_some()
    {
        count = group.devices;
        let (joints, inputs, _) = &*data;
        let members = members(first, count, |at| of_device::<K, T, W>(at, joints, inputs));
        if members.is_some_and(|members| elimination.group(group, members)) {
            return Ok(count);
        }
    }
    for (lane, device) in devices.iter().enumerate().take(count) {
        let at = MemberIndex(first.saturating_add(lane));
        let Some(data) = Eliminated::part::<W, MemberIndex>(data, at) else { break };
        elimination.visit(device, data)?;
    }
    Ok(count)
}

/// The same with devices of an enumeration.
#[inline(always)]
pub(crate) fn visit_enum<T, E, N, W>(
    elimination: &mut Elimination<'_, T, E>,
    devices: &[N::Prepared],
    data: &mut Data<'_, T, W>,
    first: usize,
) -> Result<usize, SolveError<T>>
where
    T: Scalar,
    E: Eliminate<T>,
    N: DeviceEnum<Scalar = T> + Devices,
    W: DeviceSet<Scalar = T>,
    MemberIndex: Part<W, Of = N>,
{
    let mut count = 1;
    if let Some(device) = devices.first()
        && elimination.groups.is_some()
    {
        let row = Row::<'_, '_, '_, T, E, W> { elimination: &mut *elimination, data, first };
        match N::with(device, row) {
            Group::Eliminated(devices) => return Ok(devices),
            Group::Rejected(devices) => count = devices,
        }
    }
    for (lane, device) in devices.iter().enumerate().take(count) {
        let at = MemberIndex(first.saturating_add(lane));
        let Some(data) = Eliminated::part::<W, MemberIndex>(data, at) else { break };
        elimination.visit_enum::<N>(device, data)?;
    }
    Ok(count)
}

/// What came of the group that a device begins, and how many devices it has.
enum Group {
    Eliminated(usize),
    /// To be eliminated one after another.
    Rejected(usize),
}

/// The row of an enumeration's devices that begins with one whose kind is to be found.
struct Row<'r, 'e: 'r, 'd: 'r, T: Scalar, E, W: DeviceSet<Scalar = T>> {
    elimination: &'r mut Elimination<'e, T, E>,
    data: &'r Data<'d, T, W>,
    first: usize,
}

impl<T, E, N, W> WithKind<N> for Row<'_, '_, '_, T, E, W>
where
    T: Scalar,
    E: Eliminate<T>,
    N: DeviceEnum<Scalar = T>,
    W: DeviceSet<Scalar = T>,
    MemberIndex: Part<W, Of = N>,
{
    type Output = Group;

    fn with<K: Variant<N>>(self, device: &Device<K>) -> Group {
        let Some(group) = device.group.as_deref() else { return Group::Rejected(1) };
        match self.eliminate::<K, N>(group) {
            Some(true) => Group::Eliminated(group.devices),
            _ => Group::Rejected(group.devices),
        }
    }
}

impl<T: Scalar, E: Eliminate<T>, W: DeviceSet<Scalar = T>> Row<'_, '_, '_, T, E, W> {
    /// Eliminates a group; none where its data are not those of its kind.
    #[inline(always)]
    fn eliminate<K: Variant<N>, N: DeviceEnum<Scalar = T>>(
        self,
        group: &DeviceGroup<K>,
    ) -> Option<bool>
    where
        MemberIndex: Part<W, Of = N>,
    {
        let Self { elimination, data: (joints, inputs, _), first } = self;
        let count = group.devices;
        // Copies in the structures of the kind, written where they stay.
        let mut joints_of = [K::at_rest(); WIDEST];
        copy::<K, N, Joints, W>(joints, first, joints_of.get_mut(..count)?)?;
        let mut motors_of = [K::motors_off(); WIDEST];
        copy::<K, N, Motors, W>(inputs.motors, first, motors_of.get_mut(..count)?)?;
        let mut modes_of = [K::all(Mode::Driven); WIDEST];
        copy::<K, N, Modes<T>, W>(inputs.modes, first, modes_of.get_mut(..count)?)?;
        let mut bodies_of = None;
        if let Some(bodies) = inputs.bodies {
            let copies = bodies_of.insert([K::all(Wrench::none()); WIDEST]);
            copy::<K, N, Bodies<T>, W>(bodies, first, copies.get_mut(..count)?)?;
        }
        let of_lane = |MemberIndex(lane)| {
            let bodies = match &bodies_of {
                Some(bodies) => Some(bodies.get(lane)?),
                None => None,
            };
            let (motors, modes) = (motors_of.get(lane)?, modes_of.get(lane)?);
            Some((joints_of.get(lane)?, JointInputs { motors, modes, bodies }))
        };
        let members = members(0, count, of_lane)?;
        Some(elimination.group(group, members))
    }
}

/// Copies of the data of devices in a row in the structures of their kind; none where they are of another.
#[inline(always)]
pub(crate) fn copy<K, N, F, W>(of: &W::Per<F>, first: usize, to: &mut [F::Of<K>]) -> Option<()>
where
    K: Variant<N>,
    N: DeviceEnum,
    F: PerDevice<N::Scalar, Of<K>: Copy>,
    W: DeviceSet<Scalar = N::Scalar>,
    MemberIndex: Part<W, Of = N>,
{
    for (lane, copy) in to.iter_mut().enumerate() {
        let data = MemberIndex(first.saturating_add(lane)).of::<F>(of)?;
        if N::count::<F>(data).is_some_and(|count| count != K::JOINTS.len()) {
            return None;
        }
        *copy = *N::held::<F, K>(data)?.refer();
    }
    Some(())
}

/// Joints of a device, and what is given of them.
type Member<'a, K> =
    (&'a <K as crate::model::kernels::Kernels>::Joints<<K as Kind>::Scalar>, DeviceInputs<'a, K>);

/// Those of a device in a set.
#[inline(always)]
fn of_device<'a, K: Kind<Scalar = T>, T: Scalar, W: DeviceSet<Scalar = T>>(
    at: MemberIndex,
    joints: &'a W::Per<Joints>,
    inputs: &SetInputs<'a, W>,
) -> Option<Member<'a, K>>
where
    MemberIndex: Part<W, Of = K>,
{
    let bodies: Option<&Wrenches<K>> = match inputs.bodies {
        Some(bodies) => Some(at.of::<Bodies<T>>(bodies)?),
        None => None,
    };
    let (motors, modes) = (at.of::<Motors>(inputs.motors)?, at.of::<Modes<T>>(inputs.modes)?);
    Some((at.of::<Joints>(joints)?, JointInputs { motors, modes, bodies }))
}

/// What each device of a group has, the last one's repeated; none where one has none.
#[inline(always)]
pub(crate) fn members<M: Copy>(
    first: usize,
    count: usize,
    of: impl Fn(MemberIndex) -> Option<M>,
) -> Option<[M; WIDEST]> {
    let mut members = [of(MemberIndex(first))?; WIDEST];
    for (lane, member) in members.iter_mut().enumerate().skip(1) {
        *member = of(MemberIndex(first.saturating_add(lane.min(count.saturating_sub(1)))))?;
    }
    Some(members)
}

impl<T: Scalar, E: Eliminate<T>> Elimination<'_, T, E> {
    /// Eliminates a group of devices side by side. False where lanes do not support the inputs, or fail.
    #[inline(always)]
    fn group<K: Kind<Scalar = T>>(
        &mut self,
        group: &DeviceGroup<K>,
        members: [Member<'_, K>; WIDEST],
    ) -> bool {
        let Self { environment, assembly, device, groups, .. } = self;
        let Some(gains) = groups else { return false };
        let joints = members.each_ref().map(|(joints, _)| *joints);
        let given = members.each_ref().map(|(_, given)| *given);
        let done = GroupElimination { group, joints, given, environment, assembly, gains }.run();
        if done {
            *device = device.wrapping_add(group.devices);
        } else {
            fallbacks::count();
        }
        done
    }
}
