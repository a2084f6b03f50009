//! Estimators of attitude and rate from what sensors read.

pub(crate) mod covariance;
pub(crate) mod mekf;
mod steady;
