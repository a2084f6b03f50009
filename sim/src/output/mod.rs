//! What a run is turned into: data files, pictures, one report; and how they reach the disk.

pub mod csv;
pub mod figure;
pub mod files;
pub mod plates;
pub mod report;
pub mod summary;
mod ticks;
