//! A scenario file with the files it is based on, as one tree.
//!
//! `base = "bus.toml"`, or a list of files: each is read first, in order, beside the file that
//! names it. Then a key of a later file replaces that of an earlier one; tables are merged key by
//! key; lists of tables with names are merged by name, other lists replaced whole.
//! [Overrides](super::overrides) come last.

use std::collections::HashMap;
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};

use super::diagnostic::{Diagnostics, Numbers, Span};
use super::document::{Node, TEXT_MAX, Table, Value, parse};
use super::integrator::give_way;
use crate::nearest::did_you_mean_file;
use crate::opened::open;

/// Files based on files based on files: no deeper than this.
const DEPTH_MAX: usize = 16;

/// An override of the command line: `hub.mass="900 kg"`.
pub type Override = String;
/// Overrides in their order.
pub type Overrides = Vec<Override>;

/// Reads a file and all that it is based on.
pub(super) fn load_file(path: &Path, reports: &mut Diagnostics) -> Node {
    load(path, None, &mut Files::default(), reports)
}

/// The tree of a text that names files relative to a folder.
pub(super) fn load_text(
    name: &str,
    (text, numbers): (&str, Numbers),
    folder: &Path,
    reports: &mut Diagnostics,
) -> Node {
    let node = parse(name, text, numbers, reports);
    with_bases(node, folder, &mut Files::default(), reports)
}

/// The files on the way to the one that is being read, and the trees of those that were read: each is read once,
/// however many are based on it.
#[derive(Default)]
struct Files {
    open: Vec<PathBuf>,
    read: HashMap<PathBuf, Node>,
}

fn load(
    path: &Path,
    named: Option<(&str, &Span)>,
    files: &mut Files,
    reports: &mut Diagnostics,
) -> Node {
    let nothing = Node { value: Value::Table(Table::default()), span: Span::default() };
    let shown = path.display().to_string();
    let mut refuse = |message: String, help: &str| match named {
        Some((_, span)) => reports.error(span, message, "", help),
        None => reports.error_anywhere(message, help),
    };
    let real = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    if files.open.contains(&real) {
        refuse(format!("{shown} is based on itself"), "remove this `base`");
        return nothing;
    }
    if let Some(node) = files.read.get(&real) {
        return node.clone();
    }
    if files.open.len() >= DEPTH_MAX {
        refuse(format!("more than {DEPTH_MAX} files based on each other"), "");
        return nothing;
    }
    let bytes = match bytes_of(path) {
        Ok(bytes) => bytes,
        Err(error) => {
            let missing = error.kind() == io::ErrorKind::NotFound;
            let written = named.map_or(shown.as_str(), |(written, _)| written);
            let help = if missing { did_you_mean_file(written, path, "") } else { String::new() };
            refuse(format!("cannot read {shown}: {error}"), &help);
            return nothing;
        }
    };
    if bytes.len() > TEXT_MAX {
        let help = "put tables of numbers into a CSV file";
        refuse(format!("{shown} has more than {TEXT_MAX} bytes"), help);
        return nothing;
    }
    let Ok(text) = String::from_utf8(bytes) else {
        refuse(format!("{shown} is not UTF-8 text"), "a scenario file is TOML text");
        return nothing;
    };
    files.open.push(real.clone());
    let node = parse(&shown, &text, Numbers::WithUnits, reports);
    let folder = path.parent().unwrap_or_else(|| Path::new("")).to_owned();
    if let Some(source) = reports.sources.last_mut() {
        source.folder = Some(folder.clone());
    }
    let node = with_bases(node, &folder, files, reports);
    files.open.pop();
    files.read.insert(real, node.clone());
    node
}

/// The bytes of a file, no more than it takes to see that there are too many: a device has no end.
fn bytes_of(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open(path)?.take(TEXT_MAX as u64 + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// The tree over those it is based on.
fn with_bases(mut node: Node, folder: &Path, files: &mut Files, reports: &mut Diagnostics) -> Node {
    let Value::Table(table) = &mut node.value else { return node };
    let Some(position) = table.entries.iter().position(|entry| entry.key == "base") else {
        return node;
    };
    let base = table.entries.remove(position);
    let names = match base.node.value {
        Value::Text(name) => vec![(name, base.node.span)],
        Value::List(names) => names
            .into_iter()
            .filter_map(|node| match node.value {
                Value::Text(name) => Some((name, node.span)),
                other => {
                    let what = other.what();
                    reports.error(&node.span, format!("`base` lists {what}"), "", "name a file");
                    None
                }
            })
            .collect(),
        other => {
            let message = format!("`base` is {}", other.what());
            reports.error(&base.node.span, message, "", "name a file, or a list of files");
            Vec::new()
        }
    };
    let mut below = Table::default();
    for (name, span) in names {
        let loaded = load(&folder.join(&name), Some((&name, &span)), files, reports);
        if let Value::Table(loaded) = loaded.value {
            merge(&mut below, loaded);
        }
    }
    if let Value::Table(table) = std::mem::replace(&mut node.value, Value::Boolean(false)) {
        merge(&mut below, table);
    }
    node.value = Value::Table(below);
    node
}

/// Puts the keys of a table over those of another.
fn merge(below: &mut Table, above: Table) {
    give_way(below, &above);
    let keys = below.entries.iter().map(|entry| entry.key.clone()).zip(0..);
    let places: HashMap<String, usize> = keys.collect();
    for entry in above.entries {
        let place = places.get(&entry.key);
        let Some(old) = place.and_then(|place| below.entries.get_mut(*place)) else {
            below.entries.push(entry);
            continue;
        };
        old.key_span = entry.key_span;
        match (&mut old.node.value, entry.node.value) {
            (Value::Table(old), Value::Table(new)) if !is_other_profile(old, &new) => {
                merge(old, new);
            }
            (Value::List(old), Value::List(new)) if named(old) && named(&new) => {
                merge_named(old, new);
            }
            (old_value, new) => {
                *old_value = new;
                old.node.span = entry.node.span;
            }
        }
    }
}

/// Keys of which each profile has one, which says its kind.
pub(super) const PROFILE_KINDS: [&str; 7] =
    ["constant", "step", "ramp", "sine", "chirp", "table", "times"];

/// Whether a table is a profile of another kind than one below it, which it replaces as a whole.
pub(super) fn is_other_profile(below: &Table, above: &Table) -> bool {
    let kind = |table: &Table| PROFILE_KINDS.into_iter().find(|kind| table.get(kind).is_some());
    matches!((kind(below), kind(above)), (Some(old), Some(new)) if old != new)
}

/// A tree with the keys of another over its own.
pub(super) fn merged(below: &Node, above: &Node) -> Node {
    let mut below = below.clone();
    if let (Value::Table(below), Value::Table(above)) = (&mut below.value, &above.value) {
        merge(below, above.clone());
    }
    below.span = above.span.clone();
    below
}

/// Whether every member is a table with a name.
pub(super) fn named(list: &[Node]) -> bool {
    !list.is_empty() && list.iter().all(|node| node.name().is_some())
}

fn merge_named(below: &mut Vec<Node>, above: Vec<Node>) {
    let mut places: HashMap<String, usize> = HashMap::new();
    for (name, place) in below.iter().map(Node::name).zip(0..) {
        places.entry(name.unwrap_or_default().to_owned()).or_insert(place);
    }
    for node in above {
        let place = node.name().and_then(|name| places.get(name));
        let same = place.and_then(|place| below.get_mut(*place));
        match (same, node) {
            (
                Some(Node { value: Value::Table(old), .. }),
                Node { value: Value::Table(new), .. },
            ) => {
                merge(old, new);
            }
            (_, node) => below.push(node),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_base_is_asked_for_by_the_names_beside_it() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = |name: &str| folder.path().join(name);
        std::fs::create_dir(path("parts")).expect("a folder");
        for name in ["parts/wheel.toml", "parts/wheel.csv"] {
            std::fs::write(path(name), "").expect("written");
        }
        std::fs::write(path("a.toml"), "base = \"parts/whele.toml\"\n").expect("written");
        let mut reports = Diagnostics::default();
        load_file(&path("a.toml"), &mut reports);
        let helps: Vec<_> = reports.all.iter().map(|found| found.help.as_str()).collect();
        assert_eq!(helps, ["did you mean `parts/wheel.toml`?"]);
    }
}
