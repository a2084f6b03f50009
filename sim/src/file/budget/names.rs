//! [`check_budget_names`]: names of a budget that its scenario must have, with their places in the budget.

use std::path::Path;

use super::super::diagnostic::Diagnostics;
use super::super::document::{Node, Value};
use super::super::keys::Keys;
use super::super::load::Override;
use super::super::read_file::read_file;
use super::PREFIX;
use crate::jitter::model::HUB;
use crate::nearest::did_you_mean;
use crate::scenario::Scenario;

/// Names that an error lists.
const LISTED_MAX: usize = 12;

/// Checks that a scenario has the nodes and rotors that its budget names.
///
/// # Errors
/// Every name that the scenario does not have, with its place in the budget; a file that cannot be read.
pub fn check_budget_names(
    path: &Path,
    overrides: &[Override],
    scenario: &Scenario,
) -> Result<(), Diagnostics> {
    let nodes: Vec<&str> = match &scenario.structure {
        Some(structure) => structure.nodes.iter().map(|node| node.name.as_str()).collect(),
        None => vec![HUB],
    };
    let bodies: Vec<String> =
        scenario.joints().map(|(_, name, info)| format!("{name}.{}", info.body)).collect();
    let bodies: Vec<&str> = bodies.iter().map(String::as_str).collect();
    read_file(path, "budget", (PREFIX, overrides), |keys| {
        let named = |keys: &Keys<'_>| check(keys, "node", ("node", &nodes), scenario);
        for sight in keys.tables("line_of_sight") {
            named(&sight);
            sight.tables("sensitivity").iter().for_each(named);
        }
        if let Some(speed) = keys.table("speed") {
            check(&speed, "rotors", ("body", &bodies), scenario);
        }
        Some(())
    })
}

/// Reports names of a key, a text or a list of texts, that are not among those of the scenario.
fn check(keys: &Keys<'_>, key: &str, (what, known): (&str, &[&str]), scenario: &Scenario) {
    let Some(node) = keys.node(key) else { return };
    let written: &[Node] = match &node.value {
        Value::List(list) => list,
        _ => std::slice::from_ref(node),
    };
    for node in written {
        let Value::Text(name) = &node.value else { continue };
        if known.contains(&name.as_str()) {
            continue;
        }
        let message = format!("no {what} of the scenario {} is named `{name}`", scenario.name);
        let listed = &known[..known.len().min(LISTED_MAX)];
        let dots = if listed.len() < known.len() { ", .." } else { "" };
        let otherwise = format!("there are {}{dots}", listed.join(", "));
        let help = did_you_mean(name, known.iter(), &otherwise);
        keys.reports().borrow_mut().error(&node.span, message, "", &help);
    }
}
