//! A TOML document as a tree of keys and values, each with its place.
//!
//! Keys keep the order of the file. The tree owns its text, so files and overrides merge.

use toml::de::{DeTable, DeValue};

use super::diagnostic::{Diagnostics, Numbers, SourceText, Span};

/// Longer files are refused before they are parsed, bytes.
pub(super) const TEXT_MAX: usize = 4_000_000;

/// A value with its place.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Node {
    pub(super) value: Value,
    pub(super) span: Span,
}

/// A value of TOML.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Value {
    Text(String),
    /// An integer or a floating-point number, and whether it was written as an integer.
    Number(f64, bool),
    Boolean(bool),
    /// A date or time, which no key wants.
    Datetime,
    List(Vec<Node>),
    Table(Table),
}

/// Keys in the order of their places.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Table {
    pub(super) entries: Vec<Entry>,
}

/// A key, its place, its value.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Entry {
    pub(super) key: String,
    pub(super) key_span: Span,
    pub(super) node: Node,
}

impl Value {
    /// What it is, in words.
    pub(super) fn what(&self) -> &'static str {
        match self {
            Self::Text(_) => "a text",
            Self::Number(..) => "a number without a unit",
            Self::Boolean(_) => "true or false",
            Self::Datetime => "a date",
            Self::List(_) => "a list",
            Self::Table(_) => "a table",
        }
    }
}

impl Node {
    /// The `name` of a table that has one.
    pub(super) fn name(&self) -> Option<&str> {
        match &self.value {
            Value::Table(table) => table.text("name"),
            _ => None,
        }
    }
}

impl Table {
    pub(super) fn get(&self, key: &str) -> Option<&Entry> {
        self.entries.iter().find(|entry| entry.key == key)
    }

    pub(super) fn get_mut(&mut self, key: &str) -> Option<&mut Entry> {
        self.entries.iter_mut().find(|entry| entry.key == key)
    }

    /// A text by its key.
    pub(super) fn text(&self, key: &str) -> Option<&str> {
        match &self.get(key)?.node.value {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }
}

/// Most errors of syntax that are shown: a file of another format has one in every line.
const SYNTAX_ERRORS_MAX: usize = 5;

/// Parses a text; adds it to the sources, and what is wrong with it to the errors.
pub(super) fn parse(name: &str, text: &str, numbers: Numbers, reports: &mut Diagnostics) -> Node {
    let source = reports.sources.len();
    let kept = if text.len() > TEXT_MAX { "" } else { text };
    let (name_of, text_of) = (name.to_owned(), kept.to_owned());
    reports.sources.push(SourceText { name: name_of, text: text_of, folder: None, numbers });
    let whole = Span { source, range: 0..kept.len() };
    if text.len() > TEXT_MAX {
        let message = format!("{name} has more than {TEXT_MAX} bytes");
        reports.error_anywhere(message, "put tables of numbers into a CSV file");
        return Node { value: Value::Table(Table::default()), span: whole };
    }
    let (table, errors) = DeTable::parse_recoverable(text);
    for error in errors.iter().take(SYNTAX_ERRORS_MAX) {
        let span = Span { source, range: error.span().unwrap_or(0..0) };
        reports.error(&span, format!("not TOML: {}", error.message()), "", "");
    }
    if let Some(more) = errors.len().checked_sub(SYNTAX_ERRORS_MAX).filter(|more| *more > 0) {
        let help = "a scenario file is TOML: `precess new reaction_wheel` prints one";
        reports.error_anywhere(format!("{name}: {more} more places are not TOML"), help);
    }
    Node { value: Value::Table(owned_table(table.into_inner(), source)), span: whole }
}

fn owned_table(table: DeTable<'_>, source: usize) -> Table {
    let mut entries: Vec<_> = table
        .into_iter()
        .map(|(key, value)| Entry {
            key_span: Span { source, range: key.span() },
            key: key.into_inner().into_owned(),
            node: Node {
                span: Span { source, range: value.span() },
                value: owned(value.into_inner(), source),
            },
        })
        .collect();
    entries.sort_by_key(|entry| entry.key_span.range.start);
    Table { entries }
}

fn owned(value: DeValue<'_>, source: usize) -> Value {
    match value {
        DeValue::String(text) => Value::Text(text.into_owned()),
        DeValue::Integer(number) => {
            let digits = number.as_str().replace('_', "");
            let parsed = match number.radix() {
                10 => digits.parse::<f64>().ok(),
                radix => i64::from_str_radix(&digits, radix).ok().map(to_f64),
            };
            Value::Number(parsed.unwrap_or(f64::NAN), true)
        }
        DeValue::Float(number) => {
            let digits = number.as_str().replace('_', "");
            Value::Number(digits.parse::<f64>().unwrap_or(f64::NAN), false)
        }
        DeValue::Boolean(value) => Value::Boolean(value),
        DeValue::Datetime(_) => Value::Datetime,
        DeValue::Array(list) => Value::List(
            list.into_iter()
                .map(|node| Node {
                    span: Span { source, range: node.span() },
                    value: owned(node.into_inner(), source),
                })
                .collect(),
        ),
        DeValue::Table(table) => Value::Table(owned_table(table, source)),
    }
}

#[expect(clippy::cast_precision_loss, reason = "a key that wants an integer wants a small one")]
fn to_f64(integer: i64) -> f64 {
    integer as f64
}
