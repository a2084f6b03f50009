//! Sensors: what a seed draws, noise densities by Welch, Allan variances, quanta and latencies.

mod densities;
mod draws;
mod readings;
mod welch;
