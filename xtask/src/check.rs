//! `check`: what every commit passes.

use crate::regen;
use crate::run::cargo;

/// Format, clippy with warnings denied, `regen --check`, unit tests.
pub(crate) fn check() -> Result<(), String> {
    cargo(&["fmt", "--all", "--check"])?;
    cargo(&["clippy", "--workspace", "--all-targets", "--quiet", "--", "--deny", "warnings"])?;
    regen::regen(&regen::Options::check_only())?;
    cargo(&["test", "--workspace", "--lib", "--bins", "--quiet"])
}
