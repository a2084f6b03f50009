//! `test`: every test of the workspace, documentation examples included.

use crate::mutate;
use crate::regen;
use crate::run::cargo;

/// `regen --check`, `mutate --check`, then all tests; nothing beyond Rust is needed for any of them.
pub(crate) fn test() -> Result<(), String> {
    regen::regen(&regen::Options::check_only())?;
    mutate::mutate(&mutate::Options::check_only())?;
    cargo(&["test", "--workspace"])
}
