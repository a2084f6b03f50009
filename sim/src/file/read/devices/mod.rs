//! `[[device]]` and `[[platform]]`: devices and platforms with their bodies and joints, and the initial state.

pub(in crate::file) mod body;
mod copies;
pub(super) mod device;
pub(super) mod initial;
pub(super) mod joints;
mod layout;
pub(super) mod platform;
mod suspension;
