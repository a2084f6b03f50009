//! A flexible structure: devices on mounts that its modes move. The derivation, its order and the
//! error of the model: `docs/flexible.md`, equations (F1) to (F18).
//!
//! [`spacecraft`] checks and precomputes, [`accelerations`] is the entry of an evaluation: the
//! motion of each mount ([`mount`]), the devices eliminated into the six equations of their own
//! mount, these condensed onto hub and modal coordinates ([`condense`]), one factorisation.

pub(crate) mod accelerations;
pub(crate) mod basis;
pub(crate) mod block;
pub(crate) mod check;
pub(crate) mod condense;
pub(crate) mod derivatives;
pub(crate) mod devices;
pub(crate) mod factor;
pub(crate) mod gravity;
pub(crate) mod inputs;
pub(crate) mod ledger;
pub(crate) mod loads;
pub(crate) mod modes;
pub(crate) mod modes_error;
pub(crate) mod momentum;
pub(crate) mod mount;
pub(crate) mod point;
pub(crate) mod residual;
pub(crate) mod spacecraft;
pub(crate) mod stability;
pub(crate) mod state;
pub(crate) mod stop;
pub(crate) mod storage;
pub(crate) mod structure;
pub(crate) mod turn;
