//! A spacecraft in the caller's memory: made of the caller's structures, checked, queried.

use core::ffi::c_void;

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{self as dynamics, Spacecraft};

use crate::device::device_of;
use crate::error::{Code, Fault, Rejection};
use crate::memory::{self, Plain, check, slice};
use crate::types::{Device, Hub};
use crate::{List, MAX_DEVICES};

/// `PRECESS_SPACECRAFT_SIZE`: a little more than any target needs.
pub const SIZE: usize = 16_384;
/// `PRECESS_SPACECRAFT_ALIGN`.
pub const ALIGN: usize = 8;

/// The first field of a valid spacecraft; with the version, so that other builds reject it, and with the
/// joints that a device has at most, so that structures of another version of the interface are rejected.
const fn made_by(joints: usize) -> u64 {
    0x5052_4543_0000_0000 | (joints as u64) << 24 | crate::VERSION as u64
}

/// The contents of the caller's memory.
#[repr(C)]
pub struct Craft {
    made: u64,
    pub(crate) spacecraft: Spacecraft<List>,
}

const _: () = assert!(size_of::<Craft>() <= SIZE && align_of::<Craft>() <= ALIGN);

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
pub(crate) unsafe fn craft<'a, const J: usize>(pointer: *const Craft) -> Result<&'a Craft, Code> {
    // SAFETY: by contract.
    unsafe { craft_of(pointer, &[J]) }
}

/// The spacecraft at a pointer, made by one of these versions of the interface.
unsafe fn craft_of<'a>(pointer: *const Craft, versions: &[usize]) -> Result<&'a Craft, Code> {
    check(pointer)?;
    // SAFETY: not null, aligned, readable; the first field is a number.
    let made = unsafe { (&raw const (*pointer).made).read() };
    if !versions.iter().any(|joints| made == made_by(*joints)) {
        return Err(Code::NotInitialised);
    }
    // SAFETY: `precess_init` has made it.
    Ok(unsafe { &*pointer })
}

/// Writes the fault of a call and returns its code.
///
/// # Safety
///
/// `fault` is null or points to a writable [`Fault`].
pub(crate) unsafe fn report(
    spacecraft: Option<&Spacecraft<List>>,
    result: Result<(), Rejection>,
    fault: *mut Fault,
) -> i32 {
    let rejection = result.err().unwrap_or(Code::Ok.into());
    let small = |index: usize| i32::try_from(index).unwrap_or(i32::MAX);
    let joint = rejection.joint.and_then(|name| {
        let mut joints = spacecraft?.joints();
        let named = |info: &dynamics::kind::JointInfo| {
            // Byte by byte: no call of the C library's `memcmp`.
            [info.body, info.coordinate, info.rate].iter().any(|own| own.bytes().eq(name.bytes()))
        };
        let (_, info) =
            joints.find(|(device, info)| Some(*device) == rejection.device && named(info))?;
        Some(info.index)
    });
    let cause = Fault {
        code: rejection.code as i32,
        device: rejection.device.map_or(-1, small),
        joint: joint.map_or(-1, small),
        reserved: 0,
        value: rejection.value,
        bound: rejection.bound,
    };
    // SAFETY: as promised to this function.
    match unsafe { memory::offer(fault, cause) } {
        Err(code) if rejection.code == Code::Ok => code as i32,
        _ => rejection.code as i32,
    }
}

/// Makes a spacecraft of a hub and devices.
pub(crate) fn made<const J: usize>(
    hub: &Hub,
    devices: &[Device<J>],
) -> Result<Spacecraft<List>, Rejection> {
    if devices.len() > MAX_DEVICES {
        return Err(Code::TooMany.into());
    }
    let mut list: List = [None; MAX_DEVICES];
    for (index, (entry, device)) in list.iter_mut().zip(devices).enumerate() {
        *entry = Some(device_of(index, device)?);
    }
    let hub = dynamics::Hub {
        m_b: hub.mass,
        r_bc_b: Vector3::from(hub.centre),
        i_b_bc: matrix(&hub.inertia),
    };
    Ok(Spacecraft::new(&hub, &list)?)
}

/// Makes a spacecraft in the caller's memory.
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
    make: impl FnOnce() -> Result<Spacecraft<List>, Rejection>,
) -> Result<(), Rejection> {
    let craft = memory.cast::<Craft>();
    check(craft)?;
    if size < SIZE {
        return Err(Code::TooSmall.into());
    }
    // SAFETY: not null, aligned, large enough; a spacecraft that was here is no longer valid.
    unsafe { (&raw mut (*craft).made).write(0) };
    let spacecraft = make()?;
    // SAFETY: as before.
    unsafe { craft.write(Craft { made: made_by(J), spacecraft }) };
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
    devices: *const Device<J>,
    count: u32,
    fault: *mut Fault,
) -> i32 {
    let make = || {
        if count as usize > MAX_DEVICES {
            return Err(Rejection::from(Code::TooMany));
        }
        // SAFETY: by contract.
        let (hub, devices) = unsafe { (memory::read(hub)?, slice(devices, count as usize)?) };
        made(&hub, devices)
    };
    // SAFETY: by contract.
    let result = unsafe { make_in::<J>(memory, size, make) };
    // SAFETY: by contract.
    unsafe { report(None, result, fault) }
}

/// Writes one number of a spacecraft.
///
/// # Safety
///
/// As [`craft()`]; `to` points to a writable `T`.
pub(crate) unsafe fn query<T: Plain>(
    pointer: *const Craft,
    to: *mut T,
    of: impl FnOnce(&Spacecraft<List>) -> T,
) -> i32 {
    // SAFETY: by contract.
    let done = unsafe { craft_of(pointer, &crate::VERSIONS) }.and_then(|craft| {
        // SAFETY: by contract.
        unsafe { memory::write(to, of(&craft.spacecraft)) }
    });
    done.err().unwrap_or(Code::Ok) as i32
}

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, `mass` to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn precess_mass(craft: *const Craft, mass: *mut f64) -> i32 {
    // SAFETY: by contract.
    unsafe { query(craft, mass, Spacecraft::mass) }
}

/// See `precess.h`.
///
/// # Safety
///
/// `craft` points to a spacecraft, `joints` to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn precess_joints(craft: *const Craft, device: u32, joints: *mut u32) -> i32 {
    let count = |craft: &Spacecraft<List>| {
        let of_device = craft.joints().filter(|(index, _)| *index == device as usize);
        u32::try_from(of_device.count()).unwrap_or(u32::MAX)
    };
    // SAFETY: by contract.
    unsafe { query(craft, joints, count) }
}
