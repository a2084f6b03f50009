//! `schema`: the JSON Schema of scenario files.

use std::process::ExitCode;

use super::print;

/// The schema, as published.
pub(crate) const SCHEMA: &str = include_str!("../../schema/scenario-1.json");

pub(super) fn execute() -> ExitCode {
    print(SCHEMA);
    ExitCode::SUCCESS
}
