//! `demo`: derive, prove, solve the paper's scenario, draw the report.

use crate::regen;
use crate::run::cargo;

/// `regen --check`, then every variant of Table 1, into `target/demo`.
pub(crate) fn demo() -> Result<(), String> {
    regen::regen(&regen::Options::check_only())?;
    cargo(&["run", "--release", "-p", "precess", "--", "run", "table1", "--out", "target/demo"])
}
