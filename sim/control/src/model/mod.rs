//! What laws, references, sensors and estimators share: motion of the hub, turns, errors of parameters.

pub(crate) mod error;
pub(crate) mod jacobian;
pub(crate) mod motion;
pub mod rotation;
