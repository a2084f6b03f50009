//! `test`: every test of the workspace, documentation examples included.

use crate::engines;
use crate::mutate;
use crate::regen;
use crate::run::cargo;

/// `regen --check`, `mutate --check`, all tests, and the engines behind the stored values. Only the
/// last needs more than Rust, and is skipped with a message where that is missing.
pub(crate) fn test() -> Result<(), String> {
    regen::regen(&regen::Options::check_only())?;
    mutate::mutate(&mutate::Options::check_only())?;
    cargo(&["test", "--workspace"])?;
    engines::engines()
}
