//! One key of an override: a component of a vector that the file has, and names with blanks.

use super::{MessageAndHelp, child};
use crate::file::document::{Node, Value};
use crate::units::parse_quantity;

/// The override of a whole vector, with another value of one component.
pub(super) fn component(
    tree: &Node,
    vector: &str,
    index: &str,
    value: &str,
) -> Result<String, MessageAndHelp> {
    let wrong = |message: String, help: &str| (message, help.to_owned());
    let index = index.trim_end();
    if let Some((inner, rest)) = index.split_once("].") {
        let message = format!("`{vector}[{inner}]` is not how an element of a list is named");
        return Err((message, format!("write its name: {vector}.NAME.{rest}")));
    }
    let Some(index) = index.strip_suffix(']').map(str::trim) else {
        return Err(wrong(format!("`{vector}[{index}` does not end with `]`"), "add it"));
    };
    let number = match index {
        "x" => Some(1),
        "y" => Some(2),
        "z" => Some(3),
        _ => index.parse::<usize>().ok().filter(|number| *number > 0),
    };
    let Some(number) = number else {
        return Err(wrong(
            format!("`[{index}]` is no component"),
            "write [1], [2].. or [x], [y], [z]",
        ));
    };
    let node = vector.split('.').try_fold(tree, child);
    let Some(node) = node else {
        let help = "write the whole vector into the file";
        return Err(wrong(format!("`{vector}` is not written in the file"), help));
    };
    let few = |found: usize| {
        wrong(format!("`{vector}` has {found} numbers"), "name one of them, counted from 1")
    };
    match &node.value {
        Value::List(list) => {
            let number_of = |node: &Node| match node.value {
                Value::Number(number, _) => Some(format!("{number:?}")),
                _ => None,
            };
            let texts: Option<Vec<String>> = list.iter().map(number_of).collect();
            let mut texts = texts.ok_or_else(|| {
                wrong(format!("`{vector}` is no list of numbers"), "name another key")
            })?;
            let found = texts.len();
            value.clone_into(texts.get_mut(number - 1).ok_or_else(|| few(found))?);
            Ok(format!("{vector} = [{}]", texts.join(", ")))
        }
        Value::Text(text) => {
            let value = value.trim_matches(['"', '\'']);
            let parsed = |text: &str| {
                parse_quantity(text).map_err(|error| wrong(format!("`{text}`: {}", error.kind), ""))
            };
            let (old, new) = (parsed(text)?, parsed(value)?);
            let [new_si] = new.values[..] else {
                return Err(wrong(format!("`{value}` is not one number"), "write one number"));
            };
            if old.dimension != new.dimension {
                let message = format!("`{value}` is of another dimension than `{text}`");
                return Err(wrong(message, "write it in a unit of the vector"));
            }
            let size = parsed(&format!("1 {}", old.unit))?.values.first().copied().unwrap_or(1.0);
            let numbers = text.trim().strip_suffix(old.unit.as_str()).unwrap_or(text);
            let mut parts: Vec<String> =
                numbers.split(',').map(|part| part.trim().to_owned()).collect();
            let found = parts.len();
            let place = parts.get_mut(number - 1).ok_or_else(|| few(found))?;
            *place = if old.unit == new.unit {
                value.strip_suffix(new.unit.as_str()).unwrap_or(value).trim().to_owned()
            } else {
                format!("{:?}", new_si / size)
            };
            Ok(format!("{vector} = \"{} {}\"", parts.join(", "), old.unit))
        }
        other => Err(wrong(format!("`{vector}` is {}", other.what()), "name a vector")),
    }
}

/// A key whose names with blanks are in quotation marks; none where it needs none.
pub(super) fn with_blanks_quoted(key: &str) -> Option<String> {
    let names = || key.trim().split('.').map(str::trim);
    if key.contains(['"', '\'', '+', '['])
        || !names().any(|name| name.contains(char::is_whitespace))
    {
        return None;
    }
    let quoted = names().map(|name| {
        if name.contains(char::is_whitespace) { format!("\"{name}\"") } else { name.to_owned() }
    });
    Some(quoted.collect::<Vec<_>>().join("."))
}
