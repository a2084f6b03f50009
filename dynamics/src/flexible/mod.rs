//! A flexible structure: devices on mounts that its modes move. The derivation, its order and the
//! error of the model: `docs/flexible.md`, equations (F1) to (F18).
//!
//! [`equations::spacecraft`] checks and precomputes, [`equations::accelerations`] is the entry of an
//! evaluation: the motion of each mount ([`equations::mount`]), the devices eliminated into the six
//! equations of their own mount, these condensed onto hub and modal coordinates
//! ([`equations::condense`]), one factorisation. [`structure`] is what a spacecraft calls.

pub(crate) mod derivatives;
pub(crate) mod equations;
pub(crate) mod modal;
#[cfg(feature = "alloc")]
mod mount_slopes;
pub(crate) mod results;
pub(crate) mod structure;
