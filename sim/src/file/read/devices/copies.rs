//! Copies: `copy_of`, the name of a device whose keys another one has where it has none of its own.

use crate::file::document::{Node, Value};
use crate::file::keys::Keys;
use crate::file::load::merged;

/// The name of the original of a copy.
pub(in crate::file::read) fn original(node: &Node) -> Option<&str> {
    match &node.value {
        Value::Table(table) => table.text("copy_of"),
        _ => None,
    }
}

/// What an error of a copy adds to its remedy: the cause may be a key of the original.
pub(in crate::file::read) fn help_of_copy(original: &str) -> String {
    format!("by `copy_of` it has the keys of `{original}`, too, where it does not write its own")
}

/// A copy with the keys of its original under its own.
pub(in crate::file::read) fn with_original(node: &Node, list: &[Node], keys: &Keys<'_>) -> Node {
    let Value::Table(table) = &node.value else { return node.clone() };
    let Some(original) = original(node) else { return node.clone() };
    let found = list.iter().find(|other| other.name() == Some(original));
    let own =
        |node: &Node| matches!(&node.value, Value::Table(table) if table.get("copy_of").is_none());
    match found {
        Some(found) if own(found) => merged(found, node),
        _ => {
            let message = match found {
                Some(_) => format!("`{original}` is a copy itself"),
                None => format!("no device is named `{original}`"),
            };
            let span = table.get("copy_of").map_or(&node.span, |entry| &entry.node.span);
            let help = "name a device that is no copy";
            keys.reports().borrow_mut().error(span, message, "", help);
            node.clone()
        }
    }
}
