//! [`Keys`]: the keys of one table, read by what each wants.
//!
//! Every key that is read is known; [`Keys::finish`] reports the others. A key that is missing
//! or wrong is reported, and reading goes on with a stand-in, so that all errors come at once. A key that
//! is missing because it is misspelt is reported once, as the unknown key.

mod quantities;

use std::cell::RefCell;
use std::collections::HashSet;
use std::path::{Path, PathBuf};

use super::diagnostic::{Diagnostics, Span};
use super::document::{Entry, Node, Table, Value};
use super::load::merged;
use crate::names::{NAME_MAX, name_fault};
use crate::nearest::{nearest, synonym};

/// Most unknown keys of a table that are reported one by one.
const UNKNOWN_MAX: usize = 20;

/// A name as messages show it: what is not shown is written out, and of a long one its begin.
pub(super) fn shown_name(name: &str) -> String {
    let letters = name.chars().take(NAME_MAX);
    let shown: String = letters.flat_map(char::escape_debug).collect();
    if name.chars().nth(NAME_MAX).is_some() { shown + ".." } else { shown }
}

/// Where errors go.
pub(super) type Reports = RefCell<Diagnostics>;

/// A table that is being read.
pub(super) struct Keys<'a> {
    table: &'a Table,
    /// The path of the table, for messages: `device.cmg1`.
    path: String,
    span: Span,
    reports: &'a Reports,
    asked: RefCell<Vec<String>>,
}

impl<'a> Keys<'a> {
    pub(super) fn new(node: &'a Node, path: &str, reports: &'a Reports) -> Option<Self> {
        let Value::Table(table) = &node.value else {
            let message = format!("`{path}` is {}", node.value.what());
            reports.borrow_mut().error(&node.span, message, "", "write it as a table of keys");
            return None;
        };
        let span = node.span.clone();
        let asked = RefCell::default();
        Some(Self { table, path: path.to_owned(), span, reports, asked })
    }

    pub(super) fn reports(&self) -> &'a Reports {
        self.reports
    }

    /// Where the table begins.
    pub(super) fn span(&self) -> &Span {
        &self.span
    }

    pub(super) fn path(&self) -> &str {
        &self.path
    }

    fn path_of(&self, key: &str) -> String {
        if self.path.is_empty() { key.to_owned() } else { format!("{}.{key}", self.path) }
    }

    fn entry(&self, key: &str) -> Option<&'a Entry> {
        let mut asked = self.asked.borrow_mut();
        if !asked.iter().any(|name| name == key) {
            asked.push(key.to_owned());
        }
        self.table.get(key)
    }

    pub(super) fn has(&self, key: &str) -> bool {
        self.entry(key).is_some()
    }

    /// The value of a key with its place.
    pub(super) fn node(&self, key: &str) -> Option<&'a Node> {
        self.entry(key).map(|entry| &entry.node)
    }

    /// The place of a key, or of the table where it is missing.
    pub(super) fn place(&self, key: &str) -> Span {
        self.entry(key).map_or_else(|| self.span.clone(), |entry| entry.node.span.clone())
    }

    pub(super) fn error(&self, key: &str, message: impl Into<String>, help: &str) {
        let span = self.place(key);
        self.reports.borrow_mut().error(&span, message, "", help);
    }

    /// Reports what is unusual, and may be meant.
    pub(super) fn warn(&self, key: &str, message: impl Into<String>, help: &str) {
        let span = self.place(key);
        self.reports.borrow_mut().warn(&span, message, "", help);
    }

    /// Reports a value of another type than the key takes.
    fn other_type<T>(&self, key: &str, node: &Node, help: &str) -> Option<T> {
        self.error(key, format!("`{}` is {}", self.path_of(key), node.value.what()), help);
        None
    }

    pub(super) fn missing(&self, key: &str, example: &str) {
        let message = self.is_missing(key);
        let help = format!("add `{example}`");
        self.reports.borrow_mut().error(&self.span, message, "", &help);
    }

    fn is_missing(&self, key: &str) -> String {
        format!("`{}` is missing", self.path_of(key))
    }

    /// How many errors there are so far, of this table and all others.
    pub(super) fn errors(&self) -> usize {
        self.reports.borrow().errors()
    }

    /// Reports the keys that were not read; whether there are any.
    pub(super) fn finish(&self) -> bool {
        let asked = self.asked.borrow();
        let mut known: Vec<_> = asked.iter().map(String::as_str).collect();
        known.sort_unstable();
        let is_unknown = |entry: &&Entry| known.binary_search(&entry.key.as_str()).is_err();
        let unknown: Vec<_> = self.table.entries.iter().filter(is_unknown).collect();
        for entry in unknown.iter().take(UNKNOWN_MAX) {
            let near = match synonym(&entry.key, &known) {
                Some(name) => vec![name.to_owned()],
                None => nearest(&entry.key, known.iter().copied()),
            };
            let help = match near.first() {
                Some(name) => format!("did you mean `{name}`?"),
                None => format!("known here: {}", known.join(", ")),
            };
            let message = format!("unknown key `{}`", self.path_of(&shown_name(&entry.key)));
            let mut reports = self.reports.borrow_mut();
            if let Some(name) = near.first() {
                reports.retract(&self.span, &self.is_missing(name));
            }
            reports.error(&entry.key_span, message, "", &help);
        }
        if let Some(entry) = unknown.get(UNKNOWN_MAX) {
            let more = unknown.len() - UNKNOWN_MAX;
            let table = if self.path.is_empty() { "the file" } else { &self.path };
            let message = format!("{more} more unknown keys in `{table}`");
            self.reports.borrow_mut().error(&entry.key_span, message, "", "");
        }
        !unknown.is_empty()
    }

    /// The table of a key.
    pub(super) fn table(&self, key: &str) -> Option<Keys<'a>> {
        Keys::new(self.node(key)?, &self.path_of(key), self.reports)
    }

    /// This table with another one's keys over its own.
    pub(super) fn with(&self, above: &Node) -> Node {
        let own = Node { value: Value::Table(self.table.clone()), span: self.span.clone() };
        merged(&own, above)
    }

    /// A table without keys, in the place of this one.
    pub(super) fn empty(&self) -> Node {
        Node { value: Value::Table(Table::default()), span: self.span.clone() }
    }

    /// The table of a key; an empty one where it is missing.
    pub(super) fn table_or<'b>(&'b self, key: &str, empty: &'b Node) -> Option<Keys<'b>> {
        Keys::new(self.node(key).unwrap_or(empty), &self.path_of(key), self.reports)
    }

    /// The tables of a list, each with its name or number in its path.
    pub(super) fn tables(&self, key: &str) -> Vec<Keys<'a>> {
        let Some(node) = self.node(key) else { return Vec::new() };
        let Value::List(list) = &node.value else {
            let help = format!("write `[[{key}]]`, once for each");
            self.other_type::<()>(key, node, &help);
            return Vec::new();
        };
        self.check_names(key, list);
        let path = |index: usize, node: &Node| {
            let name = node.name().map_or_else(|| index.to_string(), shown_name);
            format!("{}.{name}", self.path_of(key))
        };
        let members = list.iter().enumerate();
        members.filter_map(|(k, node)| Keys::new(node, &path(k, node), self.reports)).collect()
    }

    /// Reports names of a list of tables that are none, and names that two of them have.
    pub(super) fn check_names(&self, key: &str, list: &[Node]) {
        let mut known = HashSet::new();
        for node in list {
            let Value::Table(table) = &node.value else { continue };
            let (Some(entry), Some(name)) = (table.get("name"), table.text("name")) else {
                continue;
            };
            let twice = !known.insert(name);
            let message = match name_fault(name) {
                Some(fault) => fault.to_string(),
                None if twice => {
                    format!("two of `{}` are named `{name}`; rename one", self.path_of(key))
                }
                None => continue,
            };
            self.reports.borrow_mut().error(&entry.node.span, message, "", "");
        }
    }

    /// The path of the file that a key names, and its name from `folder`. It is beside the file in which the key is
    /// written; `folder` is that of a key of the command line.
    pub(super) fn file(&self, key: &str, folder: &Path) -> Option<(PathBuf, String)> {
        let name = self.text(key)?;
        let source = self.place(key).source;
        let reports = self.reports.borrow();
        let own = reports.sources.get(source).and_then(|source| source.folder.as_deref());
        let path = own.unwrap_or(folder).join(name);
        let shown = path.strip_prefix(folder).unwrap_or(&path).display().to_string();
        Some((path, shown))
    }

    pub(super) fn text(&self, key: &str) -> Option<&'a str> {
        let node = self.node(key)?;
        match &node.value {
            Value::Text(text) => Some(text),
            _ => self.other_type(key, node, "write it in quotation marks"),
        }
    }

    /// A text where it is one; none where it is something else, for another reading.
    pub(super) fn text_or_list(&self, key: &str) -> Option<&'a str> {
        match &self.node(key)?.value {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    /// A text, or a list of texts.
    pub(super) fn texts(&self, key: &str) -> Option<Vec<&'a str>> {
        let node = self.node(key)?;
        let help = "write it in quotation marks, or a list of such";
        let text = |node: &'a Node| match &node.value {
            Value::Text(text) => Some(text.as_str()),
            _ => None,
        };
        let texts = match &node.value {
            Value::List(list) => list.iter().map(text).collect(),
            _ => text(node).map(|text| vec![text]),
        };
        texts.or_else(|| self.other_type(key, node, help))
    }

    pub(super) fn boolean(&self, key: &str) -> Option<bool> {
        let node = self.node(key)?;
        match &node.value {
            Value::Boolean(value) => Some(*value),
            _ => self.other_type(key, node, "write true or false"),
        }
    }

    /// One of some words.
    pub(super) fn choice<T: Copy>(&self, key: &str, of: &[(&str, T)]) -> Option<T> {
        let text = self.text(key)?;
        let found = of.iter().find(|(word, _)| *word == text).map(|(_, value)| *value);
        if found.is_none() {
            let words: Vec<_> = of.iter().map(|(word, _)| format!("\"{word}\"")).collect();
            let message = format!("`{}` is \"{text}\"", self.path_of(key));
            self.error(key, message, &format!("it is one of {}", words.join(", ")));
        }
        found
    }

    /// A whole number within bounds.
    pub(super) fn count(&self, key: &str, lowest: u32, highest: u32) -> Option<u32> {
        let node = self.node(key)?;
        if let Value::Number(value, true) = node.value
            && (f64::from(lowest)..=f64::from(highest)).contains(&value)
        {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "an integer within bounds"
            )]
            return Some(value as u32);
        }
        let help = format!("it is a whole number from {lowest} to {highest}");
        self.error(key, format!("`{}` is out of range", self.path_of(key)), &help);
        None
    }
}
