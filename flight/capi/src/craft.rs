//! A spacecraft in the caller's memory: made of the caller's structures, checked, queried.

use core::ffi::c_void;

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{self as dynamics, Devices, Spacecraft};

use crate::entry_map::EntryMap;
use crate::error::{Code, Fault, Rejection};
use crate::memory::{self, OutputPointer, Plain, check, slice};
use crate::types::Hub;
use crate::version::{EntryOf, Interface, SetOf, Versions};
use crate::{MAX_DEVICES, VERSIONS};

/// `PRECESS_SPACECRAFT_ALIGN`.
pub const ALIGN: usize = 8;

/// The first field of a valid spacecraft; with the version, so that other builds reject it, and with the
/// joints that a device has at most, so that structures of another version of the interface are rejected.
pub(crate) const fn made_by(joints: usize) -> u64 {
    0x5052_4543_0000_0000 | (joints as u64) << 24 | crate::VERSION as u64
}

/// The beginning of the caller's memory.
#[repr(C)]
pub struct Craft {
    made: u64,
}

/// The contents of the caller's memory.
#[repr(C)]
pub struct StoredSpacecraft<D: Devices<Scalar = f64>> {
    craft: Craft,
    pub(crate) entry_map: EntryMap,
    pub(crate) spacecraft: Spacecraft<D>,
}

const fn fits<const J: usize>() -> bool
where
    Versions: Interface<J>,
{
    size_of::<StoredSpacecraft<SetOf<J>>>() <= Versions::SIZE
        && align_of::<StoredSpacecraft<SetOf<J>>>() <= ALIGN
}

const _: () = assert!(fits::<3>() && fits::<7>());

/// The spacecraft at a pointer.
///
/// # Errors
///
/// [`Code::Null`], [`Code::Misaligned`], [`Code::NotInitialised`].
///
/// # Safety
///
/// The pointer points to `PRECESS_SPACECRAFT_SIZE` readable bytes, which nobody but `precess_init`
/// has written to if they begin as a spacecraft.
pub(crate) unsafe fn craft<'a, const J: usize>(
    pointer: *const Craft,
) -> Result<&'a StoredSpacecraft<SetOf<J>>, Code>
where
    Versions: Interface<J>,
{
    // SAFETY: by contract.
    if unsafe { joints_of(pointer) }? != J {
        return Err(Code::NotInitialised);
    }
    // SAFETY: `precess_init` of this version has made it.
    Ok(unsafe { &*pointer.cast() })
}

/// The version that has made the spacecraft at a pointer, by its joints.
unsafe fn joints_of(pointer: *const Craft) -> Result<usize, Code> {
    check(pointer)?;
    // SAFETY: not null, aligned, readable; the first field is a number.
    let made = unsafe { (&raw const (*pointer).made).read() };
    let version = VERSIONS.into_iter().find(|joints| made == made_by(*joints));
    version.ok_or(Code::NotInitialised)
}

/// Does a call and returns its code, the fault written where there is a place for it. That place is
/// checked first: a call whose fault cannot be written is not made.
///
/// # Safety
///
/// `fault` is null, misaligned, or points to a writable [`Fault`].
pub(crate) unsafe fn reporting<'a, D: Devices<Scalar = f64> + 'a>(
    fault: *mut Fault,
    call: impl FnOnce() -> (Option<&'a StoredSpacecraft<D>>, Result<(), Rejection>),
) -> i32 {
    // SAFETY: as promised to this function.
    match unsafe { OutputPointer::optional(fault) } {
        Err(code) => code as i32,
        Ok(fault) => {
            let (craft, result) = call();
            report(craft, result, fault)
        }
    }
}

/// Writes the fault of a call and returns its code.
fn report<D: Devices<Scalar = f64>>(
    craft: Option<&StoredSpacecraft<D>>,
    result: Result<(), Rejection>,
    fault: Option<OutputPointer<Fault>>,
) -> i32 {
    let rejection = result.err().unwrap_or(Code::Ok.into());
    let small = |index: usize| i32::try_from(index).unwrap_or(i32::MAX);
    let joint = rejection.joint.and_then(|name| {
        let mut joints = craft?.spacecraft.joints();
        let named = |info: &dynamics::kind::JointInfo| {
            // Byte by byte: no call of the C library's `memcmp`.
            [info.body, info.coordinate, info.rate].iter().any(|own| own.bytes().eq(name.bytes()))
        };
        let (_, info) =
            joints.find(|(device, info)| Some(*device) == rejection.device && named(info))?;
        Some(info.index)
    });
    let joint = rejection.joint_index.or(joint);
    let of_device = |device| craft.map_or(device, |craft| craft.entry_map.entry(device));
    let entry = rejection.entry.or(rejection.device.map(of_device));
    if let Some(fault) = fault {
        fault.write(Fault {
            code: rejection.code as i32,
            device: entry.map_or(-1, small),
            joint: joint.map_or(-1, small),
            reserved: 0,
            value: rejection.value,
            bound: rejection.bound,
        });
    }
    rejection.code as i32
}

/// Makes a spacecraft of a hub and devices.
pub(crate) fn made<const J: usize>(
    hub: &Hub,
    entries: &[EntryOf<J>],
) -> Result<StoredSpacecraft<SetOf<J>>, Rejection>
where
    Versions: Interface<J>,
{
    if entries.len() > MAX_DEVICES {
        return Err(Code::TooMany.into());
    }
    let (set, entry_map) = Versions::set(entries)?;
    let hub = dynamics::Hub {
        m_b: hub.mass,
        r_bc_b: Vector3::from(hub.centre),
        i_b_bc: matrix(&hub.inertia),
    };
    let spacecraft = Spacecraft::new(&hub, &set).map_err(|error| {
        let rejection = Rejection::from(error);
        Rejection { entry: rejection.device.map(|device| entry_map.entry(device)), ..rejection }
    })?;
    Ok(StoredSpacecraft { craft: Craft { made: made_by(J) }, entry_map, spacecraft })
}

/// Makes a spacecraft in the caller's memory, which is as it was where there is an error.
///
/// # Errors
///
/// [`Code::Null`], [`Code::Misaligned`], [`Code::TooSmall`], and the errors of `make`.
///
/// # Safety
///
/// `memory` points to `size` writable bytes.
pub(crate) unsafe fn make_in<const J: usize>(
    memory: *mut c_void,
    size: usize,
    make: impl FnOnce() -> Result<StoredSpacecraft<SetOf<J>>, Rejection>,
) -> Result<(), Rejection>
where
    Versions: Interface<J>,
{
    let craft = memory.cast::<Craft>();
    check(craft)?;
    if size < Versions::SIZE {
        return Err(Code::TooSmall.into());
    }
    let contents = make()?;
    // SAFETY: not null, aligned, large enough.
    unsafe { craft.cast::<StoredSpacecraft<SetOf<J>>>().write(contents) };
    Ok(())
}

/// A matrix from its rows.
pub(crate) fn matrix(rows: &[f64; 9]) -> Matrix3<f64> {
    Matrix3::from_row_slice(rows)
}

/// See `precess.h`.
///
/// # Safety
///
/// `memory` points to `size` writable bytes, `hub` to a hub, `devices` to `count` devices, `fault`
/// is null or points to a fault.
pub(crate) unsafe fn init<const J: usize>(
    memory: *mut c_void,
    size: usize,
    hub: *const Hub,
    devices: *const EntryOf<J>,
    count: u32,
    fault: *mut Fault,
) -> i32
where
    Versions: Interface<J>,
{
    let make = || {
        if count as usize > MAX_DEVICES {
            return Err(Rejection::from(Code::TooMany));
        }
        // SAFETY: by contract.
        let (hub, devices) = unsafe { (memory::read(hub)?, slice(devices, count as usize)?) };
        made::<J>(&hub, devices)
    };
    // SAFETY: by contract.
    let call =
        || (None::<&StoredSpacecraft<SetOf<J>>>, unsafe { make_in::<J>(memory, size, make) });
    // SAFETY: by contract.
    unsafe { reporting(fault, call) }
}

/// The code of a result.
pub(crate) fn code_number(result: Result<(), Code>) -> i32 {
    result.err().unwrap_or(Code::Ok) as i32
}

/// A number of a spacecraft of any version.
pub(crate) trait Query<T> {
    fn value<D: Devices<Scalar = f64>>(&self, craft: &StoredSpacecraft<D>) -> T;
}

/// Writes one number of a spacecraft.
///
/// # Safety
///
/// As [`craft()`]; `to` points to a writable `T`.
pub(crate) unsafe fn query<T: Plain>(
    pointer: *const Craft,
    to: *mut T,
    query: &impl Query<T>,
) -> i32 {
    let found = || {
        // SAFETY: by contract.
        let to = unsafe { OutputPointer::new(to) }?;
        // SAFETY: by contract.
        let number = if unsafe { joints_of(pointer) }? == VERSIONS[0] {
            // SAFETY: by contract.
            query.value(unsafe { craft::<{ VERSIONS[0] }>(pointer) }?)
        } else {
            // SAFETY: by contract.
            query.value(unsafe { craft::<{ VERSIONS[1] }>(pointer) }?)
        };
        to.write(number);
        Ok(())
    };
    code_number(found())
}

struct Mass;

impl Query<f64> for Mass {
    fn value<D: Devices<Scalar = f64>>(&self, craft: &StoredSpacecraft<D>) -> f64 {
        craft.spacecraft.mass()
    }
}

/// Of an entry.
struct Joints(usize);

impl Query<u32> for Joints {
    fn value<D: Devices<Scalar = f64>>(&self, craft: &StoredSpacecraft<D>) -> u32 {
        u32::try_from(craft.entry_map.joints_of(self.0)).unwrap_or(u32::MAX)
    }
}

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, `mass` to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn precess_mass(craft: *const Craft, mass: *mut f64) -> i32 {
    // SAFETY: by contract.
    unsafe { query(craft, mass, &Mass) }
}

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, `joints` to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn precess_joints(craft: *const Craft, device: u32, joints: *mut u32) -> i32 {
    // SAFETY: by contract.
    unsafe { query(craft, joints, &Joints(device as usize)) }
}
