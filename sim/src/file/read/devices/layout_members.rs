//! `[[device.member]]`: keys of one device of a layout, over those that all of its devices have.

use precess_dynamics::BuiltInKind;

use crate::file::document::{Node, Value};
use crate::file::keys::Keys;
use crate::nearest::did_you_mean;
use crate::scenario::body_key;

/// The tables of members, each with the name of a device of the layout; what is wrong has been reported.
pub(super) fn members(keys: &Keys<'_>, kind: BuiltInKind, names: &[String]) -> Vec<Node> {
    let tables = keys.tables("member");
    let Some(node) = keys.node("member") else { return Vec::new() };
    if !keys.has("layout") {
        let help = "remove it, and give the device the keys itself";
        keys.error("member", "only a layout has members", help);
        return Vec::new();
    }
    for member in &tables {
        if !member.has("name") {
            let example = names.first().map_or("cmg1", String::as_str);
            member.missing("name", &format!("name = \"{example}\""));
        }
        if let Some(name) = member.text("name").filter(|name| !names.iter().any(|n| n == name)) {
            let known = names.iter().map(String::as_str);
            let all = format!("there are {}", names.join(", "));
            let message = format!("no device of the layout is named `{name}`");
            member.error("name", message, &did_you_mean(name, known, &all));
        }
        // Read with the keys of the layout under them.
        for key in ["imbalance", "imbalance_model"] {
            member.has(key);
        }
        for joint in kind.joints() {
            member.has(&body_key(joint));
        }
        member.finish();
    }
    match &node.value {
        Value::List(list) => list.clone(),
        _ => Vec::new(),
    }
}
