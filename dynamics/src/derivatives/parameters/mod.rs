//! Derivatives by parameters of hub and devices.

pub(crate) mod change;
pub(crate) mod columns;
#[cfg(feature = "alloc")]
pub(crate) mod device_motion;
#[cfg(feature = "alloc")]
pub(crate) mod direction;
#[cfg(feature = "alloc")]
pub(crate) mod loads;
#[cfg(feature = "alloc")]
pub(crate) mod rigid_body;
