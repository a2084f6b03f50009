//! Steering: from a torque that the hub is to feel to the rates of gimbals and the accelerations of wheels, and from
//! those to motor torques.
//!
//! - [`terms`]: what rates and accelerations of all joints require about B, by the emitted `steer`;
//! - [`matrix`]: the steering matrix of those joints that are commanded, the drift of the others, singularity;
//! - [`law`]: its inverses, weights, null motion; [`limits`]: within bounds; [`wheels`]: the least largest command;
//! - [`servo`]: motor torques for commands.
//!
//! Nothing is kept between calls: what depends on time takes it as an argument. No heap but that of a list of devices,
//! and every loop is bounded by the number of joints.

pub(crate) mod error;
pub(crate) mod law;
pub(crate) mod limits;
pub(crate) mod matrix;
pub(crate) mod servo;
pub(crate) mod terms;
pub(crate) mod wheels;
