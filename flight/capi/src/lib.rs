//! Precess behind a C interface: the functions of `include/precess.h`.
//!
//! A spacecraft lives in memory that the caller owns, states and inputs are structures of numbers,
//! every function returns an [error code](error::Code). No allocation, no global state, nothing
//! kept between calls but the caller's memory: any number of tasks may call, each on its own data,
//! and may share a spacecraft, which no call but `precess_init` changes.
//!
//! `unsafe` is where a pointer becomes a value, in [`memory`], and at the functions that C calls.
//! Every pointer is checked before the first result is written, so a rejected call changes nothing
//! but its fault. Numbers are copied in and out, so pointers to structures may overlap.

#![cfg_attr(not(test), no_std)]

mod contributions;
pub mod craft;
mod device;
mod entry_map;
pub mod error;
pub mod evaluate;
mod exports;
pub mod inputs;
#[cfg(test)]
mod layout;
pub mod loads;
pub mod memory;
mod platform;
#[cfg(test)]
mod pointers;
mod rows;
pub mod state;
mod steering;
pub mod table;
pub mod tracking;
pub mod types;
mod version;

/// The entries that a spacecraft has at most: `PRECESS_MAX_DEVICES`.
pub const MAX_DEVICES: usize = 8;

/// The joints that a device has at most, by version of the interface: `PRECESS_MAX_JOINTS`.
pub const VERSIONS: [usize; 2] = [3, precess_dynamics::MAX_JOINTS];

/// Platforms on the hub that carry devices only, at most: `PRECESS_MAX_PLATFORMS`.
pub const MAX_PLATFORMS: usize = 4;

/// Platforms on the hub that carry platforms, at most: `PRECESS_MAX_LOWER`.
pub const MAX_LOWER: usize = 1;

/// Platforms on each of these at most: `PRECESS_MAX_UPPER`.
pub const MAX_UPPER: usize = 1;

/// Devices on a platform at most: `PRECESS_MAX_ON_PLATFORM`.
pub const MAX_ON_PLATFORM: usize = 4;

/// Rows of panels at most: `PRECESS_MAX_ROWS`.
pub const MAX_ROWS: usize = 2;

/// Panels in a row at most: `PRECESS_MAX_IN_ROW`.
pub const MAX_IN_ROW: usize = 4;

/// Version of the library, `0x00MMmmpp`: `PRECESS_VERSION` of the header it was built with.
pub const VERSION: u32 = 0x0000_0100;

/// Version of the library that is linked, to be compared with `PRECESS_VERSION` of the header.
#[unsafe(no_mangle)]
pub extern "C" fn precess_version() -> u32 {
    VERSION
}

/// Never reached: no function of this library panics, and a gate looks for paths that could. A
/// panic handler must exist in a library without the standard one.
#[cfg(not(test))]
#[panic_handler]
fn halt(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}
