//! Campaigns: sweeps against closed forms, over threads, killed and continued, with samples that fail.

#[cfg(unix)]
mod killed;
mod montecarlo;
mod shared;
mod sweep;
