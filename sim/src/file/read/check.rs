//! [`check`]: what only the whole scenario tells, at its places in the text.

use super::super::diagnostic::{Diagnostic, Diagnostics, Severity};
use super::super::document::Node;
use super::places;
use crate::scenario::{Scenario, ScenarioError};

/// What only the whole tells: bounds and names, and what the solver rejects or warns of.
pub(super) fn check(root: &Node, scenario: &Scenario, reports: &mut Diagnostics) {
    let names = &scenario.names;
    let tables = places::Tables::of(scenario);
    for error in scenario.check() {
        let message = match &error {
            ScenarioError::Range { key, message } => format!("{key}: {message}"),
            ScenarioError::Parameters(error) => named(&error.to_string(), names),
            ScenarioError::Modes(error) => {
                format!("structure: {}", named(&error.to_string(), names))
            }
        };
        match places::of_error(root, &error, &tables) {
            Some(span) => reports.error(&span, message, "", ""),
            None => reports.error_anywhere(message, ""),
        }
    }
    if let Ok(spacecraft) = scenario.spacecraft() {
        for warning in spacecraft.warnings() {
            let span = places::of_warning(root, &warning, &tables);
            let help = "check moments and products of inertia and their units; it is run as given";
            reports.all.push(Diagnostic {
                severity: Severity::Warning,
                span,
                message: named(&warning.to_string(), names),
                label: String::new(),
                help: help.to_owned(),
            });
        }
    }
}

/// `device 0` by its name.
fn named(message: &str, names: &[String]) -> String {
    const DEVICE: &str = "device ";
    let mut text = String::new();
    let mut rest = message;
    while let Some(at) = rest.find(DEVICE) {
        let number = rest.get(at + DEVICE.len()..).unwrap_or_default();
        let end = number.find(|c: char| !c.is_ascii_digit()).unwrap_or(number.len());
        let (digits, after) = number.split_at(end);
        text.push_str(rest.get(..at).unwrap_or_default());
        match digits.parse::<usize>().ok().and_then(|index| names.get(index)) {
            Some(name) => text.push_str(name),
            None => text.extend([DEVICE, digits]),
        }
        rest = after;
    }
    text + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_device_is_named_by_its_whole_number() {
        let names = ["a", "b"].map(str::to_owned);
        let text = "device 1, device 12; device 0: device x, device ";
        assert_eq!(named(text, &names), "b, device 12; a: device x, device ");
    }
}
