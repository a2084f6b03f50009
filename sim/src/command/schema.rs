//! `schema`: the JSON Schema of scenario files.

use std::process::ExitCode;

use super::error::CommandError;
use super::print;

/// The schema, as published.
pub(crate) const SCHEMA: &str = include_str!("../../schema/scenario-1.json");

pub(super) fn execute() -> Result<ExitCode, CommandError> {
    print(SCHEMA);
    Ok(ExitCode::SUCCESS)
}
