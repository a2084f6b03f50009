//! What is not on this machine: skipped with the command that installs it, or an error.

/// Set to 1, it makes a skip a failure: for machines on which everything is to be run.
pub const REQUIRE_ALL: &str = "PRECESS_REQUIRE_ALL";

/// Whether nothing may be skipped.
#[must_use]
pub fn all_required() -> bool {
    std::env::var_os(REQUIRE_ALL).is_some_and(|value| value == "1")
}

/// Says what is skipped, or fails where nothing may be.
///
/// # Errors
/// The same line, where nothing may be skipped.
pub fn skip(what: &str, install: &str) -> Result<(), String> {
    let skipped = format!("skipped: {what}; install with `{install}`");
    if all_required() {
        return Err(format!("{skipped}; {REQUIRE_ALL}=1 allows no skip"));
    }
    eprintln!("{skipped}");
    Ok(())
}
