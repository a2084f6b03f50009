//! The versions of the interface: the set of devices that a spacecraft of each has, and how the caller's
//! entries become that set.
//!
//! Version 1: up to eight devices of up to three joints on the hub. Version 2: entries of up to seven joints,
//! and platforms, of which an entry may name one as what it stands on, a platform one on the hub; and rows of panels.

use precess_dynamics::{BuiltIn, DeviceLoads, DeviceSet, Devices, Each, Isolated, Value, Wrench};

use crate::device::device_of;
use crate::entry_map::EntryMap;
use crate::error::{Code, Rejection};
use crate::memory::Plain;
use crate::platform::{is_platform, platform_of};
use crate::rows::{self, Rows, is_panel};
use crate::table::Pass;
use crate::types::{self, Device, Entry};
use crate::{MAX_DEVICES, MAX_LOWER, MAX_ON_PLATFORM, MAX_PLATFORMS, MAX_UPPER};

/// The devices on a hub.
pub(crate) type List = [Option<BuiltIn>; MAX_DEVICES];
/// The devices on a platform.
type PlatformDevices = [Option<BuiltIn>; MAX_ON_PLATFORM];
/// A platform that carries devices only.
type Upper = Isolated<PlatformDevices>;
/// Those on the hub.
type Platforms = [Option<Upper>; MAX_PLATFORMS];
/// What stands on a platform that carries platforms.
type Carried = (PlatformDevices, [Option<Upper>; MAX_UPPER]);
/// Platforms on the hub that carry platforms.
type Lower = [Option<Isolated<Carried>>; MAX_LOWER];
/// The set of version 2.
type Second = (List, Platforms, Lower, Rows);

/// Carries the versions, each by the joints that a device has at most.
pub(crate) struct Versions;

/// The set of a version.
pub(crate) type SetOf<const J: usize> = <Versions as Interface<J>>::Set;
/// The structure of an entry of a version.
pub(crate) type EntryOf<const J: usize> = <Versions as Interface<J>>::Entry;
/// Loads of the devices of a set.
pub(crate) type LoadsOf<D> = <D as DeviceSet>::Per<precess_dynamics::set::Loads>;

/// What differs between the versions.
pub(crate) trait Interface<const J: usize> {
    /// The set of a spacecraft.
    type Set: Devices<Scalar = f64>;
    /// `precess_device`.
    type Entry: Plain;
    /// `PRECESS_SPACECRAFT_SIZE`.
    const SIZE: usize;
    /// `PRECESS_JOINT_GAINS_SIZE`.
    const GAINS_SIZE: usize;
    /// An entry of zeros.
    const EMPTY: Self::Entry;

    /// The set of some entries, at most `MAX_DEVICES`, and where its joints are in the caller's arrays.
    fn set(entries: &[Self::Entry]) -> Result<(Self::Set, EntryMap), Rejection>;
    /// Passes over an entry of a table of a layout.
    fn pass(pass: &mut impl Pass, entry: &mut Self::Entry, layout: usize) -> Option<()>;
    /// Writes the loads of the devices.
    fn loads(from: &LoadsOf<Self::Set>, to: &mut LoadsByEntry<'_, J>);
}

impl Interface<3> for Versions {
    type Set = List;
    type Entry = Device<3>;

    const SIZE: usize = 16_384;
    const GAINS_SIZE: usize = 5120;
    const EMPTY: Device<3> = Device::EMPTY;

    fn set(entries: &[Device<3>]) -> Result<(List, EntryMap), Rejection> {
        let mut list: List = [None; MAX_DEVICES];
        let mut entry_map = EntryMap::none();
        for (index, (to, entry)) in list.iter_mut().zip(entries).enumerate() {
            let device = device_of(index, entry)?;
            entry_map.add(index, device.kind().joints().len());
            *to = Some(device);
        }
        Ok((list, entry_map))
    }

    fn pass(pass: &mut impl Pass, entry: &mut Device<3>, _: usize) -> Option<()> {
        pass.device(entry, 3)
    }

    fn loads(from: &LoadsOf<List>, to: &mut LoadsByEntry<'_, 3>) {
        from.iter().flatten().for_each(|of| to.put(of));
    }
}

impl Interface<7> for Versions {
    type Set = Second;
    type Entry = Entry;

    const SIZE: usize = 73_728;
    const GAINS_SIZE: usize = 28_672;
    const EMPTY: Entry = Entry::EMPTY;

    fn set(entries: &[Entry]) -> Result<(Second, EntryMap), Rejection> {
        let mut list: List = [None; MAX_DEVICES];
        let mut platforms: Platforms = [const { None }; MAX_PLATFORMS];
        let mut lower: Lower = [const { None }; MAX_LOWER];
        let mut entry_map = EntryMap::none();
        let on_hub = standing_on(entries, None, false);
        let alone = on_hub.filter(|(index, _)| !rows::carries(entries, *index));
        for (to, (index, entry)) in list.iter_mut().zip(alone) {
            *to = Some(placed(index, entry, &mut entry_map)?);
        }
        for (index, entry) in entries.iter().enumerate().filter(|(_, entry)| entry.on != 0) {
            let named =
                usize::try_from(entry.on).ok().and_then(|on| entries.get(on.wrapping_sub(1)));
            // What a platform stands on stands on the hub; what carries a panel is no platform.
            let known = named.is_some_and(|of| {
                let on_platform = is_platform(of) && (of.on == 0 || !is_platform(entry));
                (on_platform && !rows::carries(entries, index))
                    || (is_panel(of) && rows::may_stand(entries, entry))
            });
            if !known {
                return Err(at(index, Code::NoPlatform));
            }
        }
        let carries = |index: usize| standing_on(entries, Some(index), true).next().is_some();
        let mut free = platforms.iter_mut();
        for (index, entry) in standing_on(entries, None, true).filter(|(index, _)| !carries(*index))
        {
            let to = free.next().ok_or(at(index, Code::TooMany))?;
            *to = Some(upper(entries, (index, entry), &mut entry_map)?);
        }
        let mut free = lower.iter_mut();
        for (index, entry) in standing_on(entries, None, true).filter(|(index, _)| carries(*index))
        {
            let to = free.next().ok_or(at(index, Code::TooMany))?;
            let Upper { carrier: platform, suspension, carried } =
                upper(entries, (index, entry), &mut entry_map)?;
            let mut platforms = [const { None }; MAX_UPPER];
            let mut room = platforms.iter_mut();
            for (index, entry) in standing_on(entries, Some(index), true) {
                let to = room.next().ok_or(at(index, Code::TooMany))?;
                *to = Some(upper(entries, (index, entry), &mut entry_map)?);
            }
            *to = Some(Isolated { carrier: platform, suspension, carried: (carried, platforms) });
        }
        let rows = rows::rows(entries, &mut entry_map)?;
        Ok(((list, platforms, lower, rows), entry_map))
    }

    fn pass(pass: &mut impl Pass, entry: &mut Entry, layout: usize) -> Option<()> {
        pass.device(&mut entry.device, layout)?;
        if layout == 7 { pass.standing(entry) } else { Some(()) }
    }

    fn loads((list, platforms, lower, rows): &LoadsOf<Second>, to: &mut LoadsByEntry<'_, 7>) {
        list.iter().flatten().for_each(|of| to.put(of));
        platforms.iter().flatten().for_each(|of| to.put_platform(of));
        for of in lower.iter().flatten() {
            let (devices, platforms) = &of.carried;
            to.put(&of.carrier);
            devices.iter().flatten().for_each(|of| to.put(of));
            platforms.iter().flatten().for_each(|of| to.put_platform(of));
        }
        rows::loads(rows, to);
    }
}

/// A rejection of an entry.
pub(crate) fn at(index: usize, code: Code) -> Rejection {
    Rejection { entry: Some(index), ..code.into() }
}

/// The entries that stand on the hub, or on an entry, with their indices: all platforms, or all devices.
fn standing_on(
    entries: &[Entry],
    base: Option<usize>,
    platforms: bool,
) -> impl Iterator<Item = (usize, &Entry)> {
    let on = base.map_or(0, |base| base.wrapping_add(1));
    let stands = move |entry: &Entry| usize::try_from(entry.on).is_ok_and(|of| of == on);
    let all = entries.iter().enumerate();
    all.filter(move |(_, entry)| is_platform(entry) == platforms && stands(entry))
}

/// A platform with the devices on it, whose joints are added to the map.
fn upper(
    entries: &[Entry],
    (index, entry): (usize, &Entry),
    entry_map: &mut EntryMap,
) -> Result<Upper, Rejection> {
    let (platform, suspension) = platform_of(index, entry)?;
    entry_map.add(index, types::PLATFORM_JOINTS);
    let mut carried: PlatformDevices = [None; MAX_ON_PLATFORM];
    let mut room = carried.iter_mut();
    for (index, entry) in standing_on(entries, Some(index), false) {
        let to = room.next().ok_or(at(index, Code::TooMany))?;
        *to = Some(placed(index, entry, entry_map)?);
    }
    Ok(Isolated { carrier: platform, suspension, carried })
}

/// The device of an entry, whose joints are added to the map.
fn placed(index: usize, entry: &Entry, entry_map: &mut EntryMap) -> Result<BuiltIn, Rejection> {
    let device = device_of(index, &entry.device)?;
    entry_map.add(index, device.kind().joints().len());
    Ok(device)
}

/// Loads by entry: devices come in the order of the set.
pub(crate) struct LoadsByEntry<'a, const J: usize> {
    pub(crate) entry_map: &'a EntryMap,
    /// The number of the next device.
    pub(crate) next: usize,
    pub(crate) to: &'a mut types::Loads<J>,
}

impl<const J: usize> LoadsByEntry<'_, J> {
    fn put_platform(&mut self, of: &LoadsOf<Upper>) {
        self.put(&of.carrier);
        of.carried.iter().flatten().for_each(|of| self.put(of));
    }

    pub(crate) fn put<W: Each<Wrench>, U: Each<f64>, P>(&mut self, of: &DeviceLoads<W, U, P, f64>) {
        let entry = self.entry_map.entry(self.next);
        self.next = self.next.wrapping_add(1);
        if let Some(mount) = self.to.mount.get_mut(entry) {
            *mount = types::Wrench::from_wrench(&of.mount);
        }
        let joints = self.to.joint.get_mut(entry).into_iter().flatten();
        copy(joints, of.joints.values().map(|wrench| types::Wrench::from_wrench(&wrench)));
        copy(self.to.motor.get_mut(entry).into_iter().flatten(), of.motors.values());
    }
}

fn copy<'a, V: Copy + 'a>(to: impl Iterator<Item = &'a mut V>, from: impl Iterator<Item = V>) {
    to.zip(from).for_each(|(to, from)| *to = from);
}

/// Copies to the numbers of a set from `[entry][joint]`.
pub(crate) fn take<'a, V: Value + 'a, U: 'a, const J: usize>(
    to: impl Iterator<Item = &'a mut V>,
    from: &types::PerJoint<U, J>,
    entry_map: &EntryMap,
    of: impl Fn(&U) -> V,
) {
    let mut joints = entry_map.joints();
    // Not a loop: it would look for the device of each number anew.
    to.for_each(|to| {
        let from = joints.next().and_then(|[entry, joint]| from.get(entry)?.get(joint));
        if let Some(from) = from {
            *to = of(from);
        }
    });
}

/// Copies the numbers of a set to `[entry][joint]`.
pub(crate) fn give<V, U, const J: usize>(
    to: &mut types::PerJoint<U, J>,
    from: impl Iterator<Item = V>,
    entry_map: &EntryMap,
    of: impl Fn(V) -> U,
) {
    let mut joints = entry_map.joints();
    from.for_each(|from| {
        let to = joints.next().and_then(|[entry, joint]| to.get_mut(entry)?.get_mut(joint));
        if let Some(to) = to {
            *to = of(from);
        }
    });
}
