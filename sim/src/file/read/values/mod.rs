//! Values that more than one table has: mounts and the turns that they are written as, and profiles over time.

pub(super) mod drive;
pub(in crate::file) mod mount;
pub(super) mod table_file;
pub(super) mod turns;
