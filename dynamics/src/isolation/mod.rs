//! Isolated platforms: a rigid body on three slides and three turns, with springs and dampers
//! between it and its base, that carries a set of devices.
//!
//! A platform is a hub on six joints. What it carries is eliminated into the platform's six
//! equations as devices are into the hub's, with the platform's motion as that of the base; then
//! the six joints are eliminated into the equations of the base. The equations (I1) to (I9) are in
//! [`motion`], [`elimination`] and [`suspension`]; they are written by hand, not emitted.

pub(crate) mod checks;
pub(crate) mod elimination;
pub(crate) mod kernels;
pub(crate) mod kind;
pub(crate) mod motion;
pub(crate) mod parameters;
pub(crate) mod platform_elimination;
pub(crate) mod records;
pub(crate) mod suspension;
