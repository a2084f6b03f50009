//! Scenario files of a command line, read all at once.

use super::advice;
use super::error::CommandError;
use super::options::Files;
use super::terminal::note;
use crate::file::{Diagnostics, from_file};
use crate::scenario::Scenario;

/// Reads all files, or reports what is wrong with all of them.
pub(super) fn read_all(files: &Files) -> Result<Vec<(Scenario, Diagnostics)>, CommandError> {
    let overrides = files.overrides.overrides();
    let mut scenarios: Vec<(Scenario, Diagnostics)> = Vec::new();
    let mut failed = None;
    for path in &files.files {
        match from_file(path, &overrides) {
            Ok((scenario, mut reports)) => {
                if scenarios.iter().any(|(other, _)| other.name == scenario.name) {
                    let message = format!(
                        "two scenarios are named `{}`, and their results have one name; give one \
                         of them another `name`",
                        scenario.name
                    );
                    return Err(CommandError::Other(message));
                }
                reports.all.extend(advice::initial(&scenario).iter().map(Into::into));
                scenarios.push((scenario, reports));
            }
            Err(errors) => {
                if let Some(CommandError::Scenario(earlier)) =
                    failed.replace(CommandError::Scenario(errors))
                {
                    note(&earlier.to_string());
                }
            }
        }
    }
    failed.map_or(Ok(scenarios), Err)
}
