//! `test`: every test of the workspace, documentation examples included.

use crate::run::cargo;

/// Runs all tests; nothing beyond Rust is needed for any of them.
pub(crate) fn test() -> Result<(), String> {
    cargo(&["test", "--workspace"])
}
