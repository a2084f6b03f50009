//! Overrides of the command line over a tree: `hub.mass="900 kg"`, `device.cmg1.wheel.rate="100 rpm"`.
//!
//! | key | what it replaces |
//! |---|---|
//! | `hub.mass` | a key; a member of a list of tables goes by its name |
//! | `device.rw*.wheel.rate` | that of all names that match; `*` stands for any letters |
//! | `device.cmg3.wheel.rate` | that of one device of the layout `cmg` |
//! | `hub.mass+device.rw.wheel.mass` | each of them |
//! | `hub.inertia[2]` | the second number of a vector that the file has; also `[x]`, `[y]`, `[z]` |
//!
//! Keys with quotation marks are keys as they are.

mod one_key;

use self::one_key::{component, with_blanks_quoted};
use super::diagnostic::{Diagnostics, Numbers, Span};
use super::document::{Entry, Node, Table, Value, parse};
use super::integrator::override_steps;
use super::load::{Override, is_other_profile, named};

/// Whether a text can be the key of an override, with the signs that stand for several keys or a component.
#[must_use]
pub fn is_key(text: &str) -> bool {
    let letter = |c: char| c.is_alphanumeric() || "_-.+*[]".contains(c);
    !text.is_empty() && text.chars().all(letter)
}

/// Puts overrides over a tree; `numbers` is what a number without a unit is in them.
pub(super) fn apply(
    node: &mut Node,
    (overrides, numbers): (&[Override], Numbers),
    reports: &mut Diagnostics,
) {
    apply_with_prefix(node, (overrides, numbers), "", reports);
}

/// The same of overrides that were written with a prefix, `budget.`, which is taken off: messages have it.
pub(super) fn apply_with_prefix(
    node: &mut Node,
    (overrides, numbers): (&[Override], Numbers),
    prefix: &str,
    reports: &mut Diagnostics,
) {
    let files = reports.sources.len();
    for text in overrides {
        match plain(node, text) {
            Ok(texts) => {
                for text in &texts {
                    one(node, (text, numbers), prefix, reports);
                }
            }
            Err((message, help)) => {
                reports.error_anywhere(format!("--set {prefix}{text}: {message}"), &help);
            }
        }
    }
    override_steps(node, files);
}

/// What is wrong, and the remedy.
type MessageAndHelp = (String, String);

/// Puts an override of one key over a tree.
fn one(node: &mut Node, (text, numbers): (&str, Numbers), prefix: &str, reports: &mut Diagnostics) {
    let before = reports.all.len();
    let typed = format!("{prefix}{text}");
    let mut parsed = parse(&format!("--set {typed}"), &typed, numbers, reports);
    if reports.all.len() > before {
        return;
    }
    // The table that a prefix names.
    if let (Value::Table(outer), Some(key)) = (&mut parsed.value, prefix.strip_suffix('.'))
        && let Some(entry) = outer.get_mut(key)
    {
        parsed = entry.node.clone();
    }
    if let (Value::Table(tree), Value::Table(new)) = (&mut node.value, parsed.value) {
        over(tree, new, reports);
    }
}

/// Overrides of one key each, without signs that stand for several.
fn plain(tree: &Node, text: &str) -> Result<Vec<String>, MessageAndHelp> {
    let Some((key, value)) = text.split_once('=') else { return Ok(vec![text.to_owned()]) };
    if let Some(quoted) = with_blanks_quoted(key) {
        let message = "a name with a blank stands in quotation marks".to_owned();
        return Err((message, format!("write {quoted}={}", value.trim_start())));
    }
    if key.contains(['"', '\'']) || !key.contains(['*', '+', '[']) {
        return Ok(vec![text.to_owned()]);
    }
    let each = keys_of(tree, key)?.into_iter().map(|key| match key.split_once('[') {
        None => Ok(format!("{key} ={value}")),
        Some((vector, index)) => component(tree, vector, index, value.trim()),
    });
    each.collect()
}

/// The keys that a key with `+` and `*` stands for.
pub(super) fn keys_of(tree: &Node, key: &str) -> Result<Vec<String>, MessageAndHelp> {
    let mut found = Vec::new();
    for key in key.split('+').map(str::trim) {
        let (path, index) = key.split_at(key.find('[').unwrap_or(key.len()));
        let parts: Vec<&str> = path.split('.').collect();
        let mut matching = Vec::new();
        descend(Some(tree), &parts, "", &mut matching)?;
        for path in matching {
            let key = format!("{path}{index}");
            if !found.contains(&key) {
                found.push(key);
            }
        }
    }
    Ok(found)
}

/// Names under a node: keys of a table, names of a list of tables.
fn names(node: &Node) -> Vec<&str> {
    match &node.value {
        Value::Table(table) => table.entries.iter().map(|entry| entry.key.as_str()).collect(),
        Value::List(list) => list.iter().filter_map(Node::name).collect(),
        _ => Vec::new(),
    }
}

fn child<'a>(node: &'a Node, name: &str) -> Option<&'a Node> {
    match &node.value {
        Value::Table(table) => table.get(name).map(|entry| &entry.node),
        Value::List(list) => list
            .iter()
            .find(|member| member.name() == Some(name))
            .or_else(|| list.iter().find_map(|layout| own_keys(layout, name))),
        _ => None,
    }
}

/// The keys of one device of a layout by its name.
fn own_keys<'a>(layout: &'a Node, name: &str) -> Option<&'a Node> {
    let Value::Table(table) = &layout.value else { return None };
    let Value::List(members) = &table.get("member")?.node.value else { return None };
    members.iter().find(|member| member.name() == Some(name))
}

fn descend(
    node: Option<&Node>,
    parts: &[&str],
    path: &str,
    found: &mut Vec<String>,
) -> Result<(), MessageAndHelp> {
    let Some((part, rest)) = parts.split_first() else {
        found.push(path.to_owned());
        return Ok(());
    };
    let join = |name: &str| {
        if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") }
    };
    if !part.contains('*') {
        return descend(node.and_then(|node| child(node, part)), rest, &join(part), found);
    }
    let known = node.map(names).unwrap_or_default();
    let matching: Vec<&str> = known.iter().copied().filter(|name| matches(part, name)).collect();
    if matching.is_empty() {
        let help = if known.is_empty() {
            "write the names out".to_owned()
        } else {
            format!("there are {}", known.join(", "))
        };
        return Err((format!("nothing matches `{}`", join(part)), help));
    }
    for name in matching {
        descend(node.and_then(|node| child(node, name)), rest, &join(name), found)?;
    }
    Ok(())
}

/// Whether a name is that of a pattern, in which `*` stands for any letters.
fn matches(pattern: &str, name: &str) -> bool {
    match pattern.split_once('*') {
        None => pattern == name,
        Some((before, rest)) => name.strip_prefix(before).is_some_and(|name| {
            name.char_indices()
                .map(|(at, _)| at)
                .chain([name.len()])
                .any(|at| name.get(at..).is_some_and(|end| matches(rest, end)))
        }),
    }
}

/// As a merge of two files, but a table over a list of tables with names goes to the member of each name.
fn over(below: &mut Table, above: Table, reports: &mut Diagnostics) {
    for entry in above.entries {
        let Entry { key, key_span, node } = entry;
        let Some(old) = below.get_mut(&key) else {
            below.entries.push(Entry { key, key_span, node });
            continue;
        };
        match (&mut old.node.value, node.value) {
            (Value::Table(old), Value::Table(new)) if !is_other_profile(old, &new) => {
                over(old, new, reports);
            }
            (Value::List(old), Value::Table(new)) if named(old) => over_named(old, new, reports),
            (Value::Table(_), new)
                if !matches!(new, Value::Table(_)) && MOTIONS.contains(&key.as_str()) =>
            {
                let message = format!(
                    "`{key}` is a profile, which prescribes the motion, and not {}",
                    new.what()
                );
                let help = format!(
                    "write `{key} = {{ constant = .. }}`; a quantity is only where the joint starts"
                );
                reports.error(&key_span, message, "", &help);
            }
            (old_value, new) => {
                *old_value = new;
                old.node.span = node.span;
                old.key_span = key_span;
            }
        }
    }
}

/// Keys that a quantity and a profile give another meaning.
const MOTIONS: [&str; 4] = ["angle", "rate", "displacement", "speed"];

fn over_named(members: &mut [Node], above: Table, reports: &mut Diagnostics) {
    for Entry { key, key_span, node } in above.entries {
        let known: Vec<_> = members.iter().filter_map(Node::name).map(str::to_owned).collect();
        let member = members.iter_mut().find(|member| member.name() == Some(&key));
        match (member, node.value) {
            (Some(Node { value: Value::Table(old), .. }), Value::Table(new)) => {
                over(old, new, reports);
            }
            (Some(_), other) => {
                let message = format!("`{key}` is a table, and not {}", other.what());
                reports.error(&node.span, message, "", "name one of its keys");
            }
            (None, value) => {
                if let (Some(layout), Value::Table(new)) = (layout_of(members, &key), value) {
                    of_member(layout, &key, &key_span, new, reports);
                } else {
                    let help = format!("there are {}", known.join(", "));
                    reports.error(&key_span, format!("nothing is named `{key}`"), "", &help);
                }
            }
        }
    }
}

/// The layout whose devices a name is one of: `cmg3` of the layout `cmg`.
fn layout_of<'a>(members: &'a mut [Node], name: &str) -> Option<&'a mut Table> {
    members.iter_mut().find_map(|member| {
        let number = name.strip_prefix(member.name()?)?;
        let is_number = number.parse::<u32>().is_ok() && !number.starts_with(['0', '+']);
        match &mut member.value {
            Value::Table(table) if is_number && table.get("layout").is_some() => Some(table),
            _ => None,
        }
    })
}

/// Keys of one device of a layout, as `[[device.member]]` with its name has them.
fn of_member(layout: &mut Table, name: &str, span: &Span, new: Table, reports: &mut Diagnostics) {
    let node = |value: Value| Node { value, span: span.clone() };
    let entry = |key: &str, node: Node| {
        let (key, key_span) = (key.to_owned(), span.clone());
        Table { entries: vec![Entry { key, key_span, node }] }
    };
    let named = node(Value::Table(entry("name", node(Value::Text(name.to_owned())))));
    match layout.get_mut("member").map(|entry| &mut entry.node.value) {
        Some(Value::List(list)) if list.iter().all(|member| member.name() != Some(name)) => {
            list.push(named);
        }
        Some(_) => {}
        None => layout.entries.extend(entry("member", node(Value::List(vec![named]))).entries),
    }
    let of_name = entry(name, node(Value::Table(new)));
    over(layout, entry("member", node(Value::Table(of_name))), reports);
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "[hub]\ninertia = \"1, 2.5, 3 kg m^2\"\naxis = [0, 0, 1]\n[[device]]\n\
                        name = \"rw1\"\n[[device]]\nname = \"rw2\"\n[[device]]\nname = \"cmg\"\n";

    fn tree() -> Node {
        parse("bus.toml", TEXT, Numbers::WithUnits, &mut Diagnostics::default())
    }

    #[test]
    fn one_key_stands_for_several() {
        let both =
            |value: &str| ["rw1", "rw2"].map(|name| format!("device.{name}.wheel.rate ={value}"));
        let found = plain(&tree(), "device.rw*.wheel.rate= \"5 rpm\"").expect("two");
        assert_eq!(found, both(" \"5 rpm\""));
        let found = plain(&tree(), "device.rw1.wheel.rate + device.rw2.wheel.rate=1");
        assert_eq!(found.expect("two"), both("1"));
        let error = plain(&tree(), "device.panel*.mass=1").expect_err("none");
        assert!(
            error.0.contains("device.panel*") && error.1.contains("rw1, rw2, cmg"),
            "{error:?}"
        );
        assert!(matches("a*c*", "abcd") && matches("*", "") && !matches("a*c", "abd"));
    }

    #[test]
    fn a_component_of_a_vector_is_replaced_and_the_others_keep_their_digits() {
        for (text, expected) in [
            ("hub.inertia[2]=\"7 kg m^2\"", "hub.inertia = \"1, 7, 3 kg m^2\""),
            ("hub.inertia[z]=\"7000 g m^2\"", "hub.inertia = \"1, 2.5, 7.0 kg m^2\""),
            ("hub.axis[1]=0.5", "hub.axis = [0.5, 0.0, 1.0]"),
        ] {
            assert_eq!(plain(&tree(), text).expect(text), [expected]);
        }
        for (text, part) in [
            ("hub.inertia[4]=\"7 kg m^2\"", "has 3 numbers"),
            ("hub.inertia[0]=\"7 kg m^2\"", "no component"),
            ("hub.inertia[2=\"7 kg m^2\"", "does not end with `]`"),
            ("device[1].mass=\"7 kg\"", "not how an element of a list is named"),
            ("requirement.of the hub.limit=\"1 deg\"", "in quotation marks"),
            ("hub.inertia[1]=\"7 kg\"", "another dimension"),
            ("hub.position[1]=\"7 m\"", "not written in the file"),
            ("hub[1]=\"7 m\"", "is a table"),
        ] {
            assert!(plain(&tree(), text).expect_err(text).0.contains(part), "{text}");
        }
        let (_, help) = plain(&tree(), "device[1].origin[x]=\"1 m\"").expect_err("an element");
        assert_eq!(help, "write its name: device.NAME.origin[x]");
        let (_, help) =
            plain(&tree(), "requirement.of the hub.limit = \"1 deg\"").expect_err("a blank");
        assert_eq!(help, "write requirement.\"of the hub\".limit=\"1 deg\"");
    }
}
