//! Sensors: what they report of the truth at a sample, with errors drawn by a seed.

pub(crate) mod accelerometer;
pub(crate) mod delay;
pub(crate) mod gyro;
pub(crate) mod noise;
pub(crate) mod quantum;
pub(crate) mod star_tracker;
