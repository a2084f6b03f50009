//! Carriers: devices whose last body carries a set of devices. A platform is a rigid body on three slides
//! and three turns, with springs and dampers between it and its base; a carrying panel is a hinged panel.
//!
//! A carrier is a hub on joints. What it carries is eliminated into the carrier's six
//! equations as devices are into the hub's, with the carrier's motion as that of the base; then
//! its joints are eliminated into the equations of the base. The equations (I1) to (I9) are in
//! [`motion`], [`elimination`] and [`suspension`]; they are written by hand, not emitted.

pub(crate) mod carrier;
pub(crate) mod carrier_elimination;
pub(crate) mod checks;
pub(crate) mod elimination;
pub(crate) mod kernels;
pub(crate) mod kind;
pub(crate) mod motion;
pub(crate) mod panel;
pub(crate) mod parameters;
pub(crate) mod records;
pub(crate) mod suspension;
mod suspension_slopes;
