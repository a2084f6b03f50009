//! Sets of devices: one device, arrays, tuples, options, vectors, and devices whose kind is known
//! only at run time.
//!
//! [`Devices`](devices::Devices) is what the solver calls; a set passes each call on to its members
//! in order.

#[cfg(feature = "alloc")]
pub(crate) mod any_device;
pub(crate) mod array;
pub(crate) mod built_in;
pub(crate) mod built_in_calls;
#[cfg(test)]
mod built_in_checks;
pub(crate) mod device_parameters;
pub(crate) mod devices;
#[cfg(feature = "alloc")]
pub(crate) mod erased;
pub(crate) mod one;
pub(crate) mod optional;
pub(crate) mod tuples;
