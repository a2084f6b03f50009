//! Accelerations of the joints of devices of one kind in a row that were eliminated side by side.

#![expect(clippy::inline_always, reason = "part of a visit, which is inlined into its operation")]

use core::convert::Infallible;

use crate::equations::device::Device;
use crate::equations::side_by_side::back_substitution::GroupBackSubstitution;
use crate::equations::side_by_side::group::DeviceGroup;
use crate::model::kind::Kind;
use crate::numbers::each::Each;
use crate::numbers::laned::Block;
use crate::numbers::real::Scalar;
use crate::sets::bundle::{Bundle, MemberIndex, Part};
use crate::sets::devices::{DeviceSet, Devices, Visit};
use crate::sets::enumeration::{DeviceEnum, Variant, WithKind};
use crate::sets::kind_data::KindDataMut;
use crate::sets::per_device::{Accelerations, Gains, PerDevice};
use crate::solve::elimination::{BackSubstitution, Substituted};

/// Gains of a set, and its accelerations.
type Data<'a, T, W> = <Substituted as Bundle<T>>::Of<'a, W>;

/// Finds the accelerations of the first of these devices, or of the group that it begins. Returns how
/// many.
#[inline(always)]
pub(crate) fn visit<K: Kind<Scalar = T>, T: Scalar, W: DeviceSet<Scalar = T>>(
    substitution: &mut BackSubstitution<'_, T>,
    devices: &[Device<K>],
    data: &mut Data<'_, T, W>,
    first: usize,
) -> Result<usize, Infallible>
where
    MemberIndex: Part<W, Of = K>,
{
    let Some(device) = devices.first() else { return Ok(1) };
    let (gains, out) = &mut *data;
    // A group that fell back has the gains of each device.
    if let Some(group) = device.group.as_deref()
        && MemberIndex(first).of::<Gains>(gains).is_some_and(Option::is_none)
        && let Some(mut found) = substitution.group(group)
    {
        for lane in 0..group.devices {
            if let Some(out) = MemberIndex(first.saturating_add(lane)).of_mut::<Accelerations>(out)
            {
                substitution.take::<K>(&mut found, lane, out);
            }
        }
        return Ok(group.devices);
    }
    if let Some(data) = Substituted::part::<W, MemberIndex>(data, MemberIndex(first)) {
        substitution.visit(device, data)?;
    }
    Ok(1)
}

/// The same with devices of an enumeration.
#[inline(always)]
pub(crate) fn visit_enum<T, N, W>(
    substitution: &mut BackSubstitution<'_, T>,
    devices: &[N::Prepared],
    data: &mut Data<'_, T, W>,
    first: usize,
) -> Result<usize, Infallible>
where
    T: Scalar,
    N: DeviceEnum<Scalar = T> + Devices,
    W: DeviceSet<Scalar = T>,
    MemberIndex: Part<W, Of = N>,
{
    let Some(device) = devices.first() else { return Ok(1) };
    let row = Row::<'_, '_, '_, T, W> { substitution: &mut *substitution, data: &mut *data, first };
    if let Some(count) = N::with(device, row) {
        return Ok(count);
    }
    if let Some(data) = Substituted::part::<W, MemberIndex>(data, MemberIndex(first)) {
        substitution.visit_enum::<N>(device, data)?;
    }
    Ok(1)
}

/// The row of an enumeration's devices that begins with one whose kind is to be found.
struct Row<'r, 'e: 'r, 'd: 'r, T: Scalar, W: DeviceSet<Scalar = T>> {
    substitution: &'r mut BackSubstitution<'e, T>,
    data: &'r mut Data<'d, T, W>,
    first: usize,
}

impl<T, N, W> WithKind<N> for Row<'_, '_, '_, T, W>
where
    T: Scalar,
    N: DeviceEnum<Scalar = T>,
    W: DeviceSet<Scalar = T>,
    MemberIndex: Part<W, Of = N>,
{
    /// How many devices the group has; none where there is none, or it fell back.
    type Output = Option<usize>;

    fn with<K: Variant<N>>(self, device: &Device<K>) -> Option<usize> {
        let Self { substitution, data: (gains, out), first } = self;
        let group = device.group.as_deref()?;
        N::held::<Gains, K>(MemberIndex(first).of::<Gains>(gains)?)?
            .refer()
            .is_none()
            .then_some(())?;
        let mut found = substitution.group(group)?;
        for lane in 0..group.devices {
            let out = MemberIndex(first.saturating_add(lane)).of_mut::<Accelerations>(out);
            if let Some(mut out) = out.and_then(N::held_mut::<Accelerations, K>) {
                substitution.take::<K>(&mut found, lane, out.refer());
                if let KindDataMut::Copied(copy, to) = out {
                    <Accelerations as PerDevice<T>>::put::<K, N>(&copy, to);
                }
            }
        }
        Some(group.devices)
    }
}

impl<T: Scalar> BackSubstitution<'_, T> {
    /// The accelerations of a group; none where no groups were eliminated.
    #[inline(always)]
    fn group<K: Kind<Scalar = T>>(
        &mut self,
        group: &DeviceGroup<K>,
    ) -> Option<K::Accelerations<Block>> {
        let mut found = None;
        let gains = self.groups.as_deref_mut()?;
        GroupBackSubstitution { group, gains, hub: &self.hub, found: &mut found }.run();
        found
    }

    /// Takes the accelerations of one device out of its lane.
    #[inline(always)]
    fn take<K: Kind<Scalar = T>>(
        &mut self,
        found: &mut K::Accelerations<Block>,
        lane: usize,
        out: &mut K::Accelerations<T>,
    ) {
        for (number, block) in out.values_mut().zip(found.values_mut()) {
            *number = T::from_f64(block.at(lane));
            self.finite &= number.is_finite();
        }
    }
}
