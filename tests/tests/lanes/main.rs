//! The services in lanes against single evaluations, to the bit: devices side by side, batches and their runs, loads,
//! threads, errors; and what is promised of every service, those in lanes among them.

mod batch;
mod derivatives;
mod loads;
mod locked;
#[path = "../dynamics/locked_gyros.rs"]
mod locked_gyros;
mod one_spacecraft_each;
#[path = "../isolated/kind.rs"]
mod platform;
mod promises;
mod runs;
