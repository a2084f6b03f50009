//! Campaigns: sweeps against closed forms, over threads, killed and continued, with samples that fail; correlated keys.

mod backend;
mod correlated;
mod drawn;
#[cfg(unix)]
mod killed;
mod montecarlo;
mod shared;
mod side_by_side;
mod sweep;
