//! `test`: every test of the workspace, documentation examples included.

use xtask::run::cargo;

use crate::accuracy;
use crate::engines;
use crate::instructions;
use crate::members::{in_lanes, without_lanes};
use crate::program::DERIVE;

/// `regen --check`, `mutate --check`, all tests, `accuracy --check`, instruction counts, and the
/// engines of the stored values. The last two need more than Rust, and are skipped with a message
/// where that is missing.
pub(crate) fn test() -> Result<(), String> {
    DERIVE.run(&["regen", "--check", "--quiet"])?;
    DERIVE.run(&["mutate", "--check"])?;
    // Both, so that a failure of the first does not hide one of the second.
    let lanes = [&["--features", "precess-tests/lanes"], &in_lanes()[..]].concat();
    let apart = [without_lanes(), lanes].map(|members| cargo(&[&["test"], &members[..]].concat()));
    apart.into_iter().collect::<Result<(), _>>()?;
    accuracy::accuracy(&accuracy::Options::check_only())?;
    instructions::instructions(&instructions::Options::check_only())?;
    engines::stored()
}
