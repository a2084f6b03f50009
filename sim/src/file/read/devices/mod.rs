//! `[[device]]` and `[[platform]]`: devices and platforms with their bodies and joints, and the initial state.

pub(super) mod arrangement;
pub(in crate::file) mod body;
mod copies;
mod corner;
pub(super) mod device;
pub(super) mod device_bodies;
mod friction;
pub(in crate::file) mod inertia;
pub(super) mod initial;
pub(super) mod joint_measures;
pub(super) mod joints;
pub(super) mod kept_rate;
mod layout;
mod layout_members;
mod motion;
mod motor_limits;
pub(super) mod platform;
pub(super) mod rows;
mod springs;
mod suspension;
