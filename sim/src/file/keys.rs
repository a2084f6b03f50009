//! [`Keys`]: the keys of one table, read by what each wants.
//!
//! Every key that is asked for is known; [`Keys::finish`] reports the others. A key that is missing
//! or wrong is reported, and reading goes on with a stand-in, so that all errors come at once.

use std::cell::RefCell;
use std::path::{Path, PathBuf};

use nalgebra::Vector3;

use super::diagnostic::{Diagnostics, Numbers, Span};
use super::document::{Entry, Node, Table, Value};
use crate::nearest::nearest;
use crate::units::{Measure, Quantity, parse_quantity};

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
        let message = format!("`{}` is missing", self.path_of(key));
        let help = format!("add `{example}`");
        self.reports.borrow_mut().error(&self.span, message, "", &help);
    }

    /// Reports the keys that nobody asked for.
    pub(super) fn finish(&self) {
        let asked = self.asked.borrow();
        for entry in &self.table.entries {
            if asked.contains(&entry.key) {
                continue;
            }
            let mut known: Vec<_> = asked.iter().map(String::as_str).collect();
            known.sort_unstable();
            let help = match nearest(&entry.key, known.iter().copied()).first() {
                Some(name) => format!("did you mean `{name}`?"),
                None => format!("known here: {}", known.join(", ")),
            };
            let message = format!("unknown key `{}`", self.path_of(&entry.key));
            self.reports.borrow_mut().error(&entry.key_span, message, "", &help);
        }
    }

    /// The table of a key.
    pub(super) fn table(&self, key: &str) -> Option<Keys<'a>> {
        Keys::new(self.node(key)?, &self.path_of(key), self.reports)
    }

    /// The tables of a list, each with its name or number in its path.
    pub(super) fn tables(&self, key: &str) -> Vec<Keys<'a>> {
        let Some(node) = self.node(key) else { return Vec::new() };
        let Value::List(list) = &node.value else {
            let help = format!("write `[[{key}]]`, once for each");
            self.other_type::<()>(key, node, &help);
            return Vec::new();
        };
        let path = |index: usize, node: &Node| {
            let name = node.name().map_or_else(|| index.to_string(), str::to_owned);
            format!("{}.{name}", self.path_of(key))
        };
        let members = list.iter().enumerate();
        members.filter_map(|(k, node)| Keys::new(node, &path(k, node), self.reports)).collect()
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

    /// A pure number.
    pub(super) fn number(&self, key: &str) -> Option<f64> {
        self.quantity(key, Measure::NUMBER)
    }

    /// Pure numbers, a known count of them.
    pub(super) fn numbers<const N: usize>(&self, key: &str) -> Option<[f64; N]> {
        let node = self.node(key)?;
        let Value::List(list) = &node.value else {
            return self.other_type(key, node, &format!("write a list of {N} numbers"));
        };
        let numbers: Vec<_> = list
            .iter()
            .filter_map(|node| match node.value {
                Value::Number(value, _) if value.is_finite() => Some(value),
                _ => None,
            })
            .collect();
        let found = <[f64; N]>::try_from(numbers).ok().filter(|_| list.len() == N);
        if found.is_none() {
            let message = format!("`{}` is no list of {N} finite numbers", self.path_of(key));
            self.error(key, message, "");
        }
        found
    }

    /// One quantity of a measure.
    pub(super) fn quantity(&self, key: &str, measure: Measure) -> Option<f64> {
        let node = self.node(key)?;
        let values = self.values_of(node, &self.path_of(key), measure)?;
        if let [value] = values.as_slice() {
            Some(*value)
        } else {
            let message = format!("`{}` has {} numbers", self.path_of(key), values.len());
            self.error(key, message, "write one number and its unit");
            None
        }
    }

    /// One quantity of a measure that must be there; reports where it is not.
    pub(super) fn required(&self, key: &str, measure: Measure) -> Option<f64> {
        if !self.has(key) {
            self.missing(key, &example(key, measure));
            return None;
        }
        self.quantity(key, measure)
    }

    /// Some quantities of one measure: `"1, 2, 3 cm"`, or `["1 cm", "2 cm", "3 cm"]`.
    pub(super) fn quantities<const N: usize>(
        &self,
        key: &str,
        measure: Measure,
    ) -> Option<[f64; N]> {
        let node = self.node(key)?;
        let path = self.path_of(key);
        let values = match &node.value {
            Value::List(list) => {
                let each = list.iter().map(|node| self.values_of(node, &path, measure));
                each.collect::<Option<Vec<_>>>()?.concat()
            }
            _ => self.values_of(node, &path, measure)?,
        };
        let count = values.len();
        let found = <[f64; N]>::try_from(values).ok();
        if found.is_none() {
            let unit = measure.usual;
            let numbers = ["1", "2", "3", "4", "5", "6"];
            let numbers = numbers.get(..N).unwrap_or(&numbers).join(", ");
            let message = format!("`{path}` has {count} numbers where {N} are wanted");
            self.error(key, message, &format!("write for example `{key} = \"{numbers} {unit}\"`"));
        }
        found
    }

    pub(super) fn vector(&self, key: &str, measure: Measure) -> Option<Vector3<f64>> {
        self.quantities::<3>(key, measure).map(Vector3::from)
    }

    /// A quantity of any measure, with its unit; a bare number is a pure number.
    pub(super) fn any_quantity(&self, key: &str) -> Option<Quantity> {
        let node = self.node(key)?;
        if let Value::Number(value, _) = node.value
            && value.is_finite()
        {
            let (values, dimension) = (vec![value], Measure::NUMBER.dimension);
            return Some(Quantity { values, dimension, unit: String::new() });
        }
        let Value::Text(text) = &node.value else {
            let help = "write a number and its unit in quotation marks";
            return self.other_type(key, node, help);
        };
        self.parsed(node, text, &self.path_of(key), "a number and its unit are wanted")
    }

    /// The quantities of a node, of a measure.
    pub(super) fn values_of(&self, node: &Node, path: &str, measure: Measure) -> Option<Vec<f64>> {
        let Measure { name, usual, .. } = measure;
        let wanted = if usual.is_empty() {
            format!("{name} is wanted")
        } else {
            format!("{name} is wanted, in {usual} for example")
        };
        let text = match &node.value {
            Value::Text(text) => text,
            Value::Number(value, _) if measure == Measure::NUMBER => return Some(vec![*value]),
            Value::Number(value, _)
                if self.reports.borrow().numbers_at(&node.span) == Numbers::Si =>
            {
                return Some(vec![*value]);
            }
            Value::Number(value, _) => {
                let message = format!("`{path}` has no unit");
                let help = if measure.unit == usual {
                    format!("write `\"{value} {usual}\"`, or another unit")
                } else {
                    format!("write `\"{value} {}\"` or `\"{value} {usual}\"`", measure.unit)
                };
                self.report(node, message, &wanted, &help);
                return None;
            }
            other => {
                let message = format!("`{path}` is {}", other.what());
                self.report(node, message, "", &format!("{wanted}, in quotation marks"));
                return None;
            }
        };
        let quantity = self.parsed(node, text, path, &wanted)?;
        if quantity.is(measure) {
            return Some(quantity.values);
        }
        let found = quantity.name();
        let message = if quantity.unit.is_empty() {
            format!("`{path}` has no unit")
        } else {
            format!("`{path}` is {found}, where {name} is wanted")
        };
        let units = if measure.unit == usual {
            usual.to_owned()
        } else {
            format!("{usual}, {}", measure.unit)
        };
        let help = format!("write it in {units}, or another unit of it");
        self.report(node, message, "", &help);
        None
    }

    fn parsed(&self, node: &Node, text: &str, path: &str, wanted: &str) -> Option<Quantity> {
        match parse_quantity(text) {
            Ok(quantity) => Some(quantity),
            Err(error) => {
                // Within the quotation marks, where the text stands there letter by letter.
                let mut span = node.span.clone();
                if span.range.len() == text.len() + 2 {
                    let start = span.range.start + 1;
                    span.range = start + error.at.start..start + error.at.end.max(error.at.start);
                }
                let message = format!("`{path}`: {}", error.kind);
                self.reports.borrow_mut().error(&span, message, "", wanted);
                None
            }
        }
    }

    fn report(&self, node: &Node, message: String, label: &str, help: &str) {
        self.reports.borrow_mut().error(&node.span, message, label, help);
    }
}

/// A line that would do.
fn example(key: &str, measure: Measure) -> String {
    format!("{key} = \"1 {}\"", measure.usual)
}
