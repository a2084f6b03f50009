//! Sets of devices: one device, arrays, tuples, options, vectors, and devices whose kind is known
//! only at run time.
//!
//! [`DeviceSet`](devices::DeviceSet) offers the members in order; what is done with them is
//! written where it is used, as a [`Visit`](devices::Visit).

pub(crate) mod array;
pub(crate) mod built_in;
mod built_in_names;
#[cfg(test)]
mod built_in_tests;
pub(crate) mod bundle;
pub(crate) mod carrying;
pub(crate) mod carrying_numbers;
pub(crate) mod counts;
pub(crate) mod device_parameters;
pub(crate) mod devices;
pub(crate) mod enumeration;
pub(crate) mod groups;
pub(crate) mod kind_data;
pub(crate) mod optional;
pub(crate) mod per_device;
pub(crate) mod single_device;
pub(crate) mod tuples;
pub(crate) mod with_numbers;
