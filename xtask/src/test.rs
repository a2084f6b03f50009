//! `test`: every test of the workspace, documentation examples included.

use crate::accuracy;
use crate::engines;
use crate::instructions;
use crate::members::{in_lanes, without_lanes};
use crate::mutate;
use crate::regen;
use crate::run::cargo;

/// `regen --check`, `mutate --check`, all tests, `accuracy --check`, instruction counts, and the
/// engines of the stored values. The last two need more than Rust, and are skipped with a message
/// where that is missing.
pub(crate) fn test() -> Result<(), String> {
    regen::regen(&regen::Options::check_only())?;
    mutate::mutate(&mutate::Options::check_only())?;
    // Both, so that a failure of the first does not hide one of the second.
    let apart =
        [without_lanes(), in_lanes()].map(|members| cargo(&[&["test"], &members[..]].concat()));
    apart.into_iter().collect::<Result<(), _>>()?;
    accuracy::accuracy(&accuracy::Options::check_only())?;
    instructions::instructions(&instructions::Options::check_only())?;
    engines::stored()
}
