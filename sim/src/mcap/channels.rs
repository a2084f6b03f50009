//! [`Group`]: the columns of a group as one message, a JSON object with a number for each.

use std::fmt::Write as _;

use serde_json::{Map, Value, json};

use super::messages::Schema;
use crate::record::Column;

/// Columns that are one message.
pub(super) struct Group {
    /// `/omega`, `/cmg1/loads`.
    pub(super) topic: String,
    name: String,
    /// Of each column: where in a sample it is, its key, what the schema says about it.
    columns: Vec<(usize, String, Value)>,
}

impl Group {
    /// The groups in the order of their first columns.
    pub(super) fn all(columns: &[Column]) -> Vec<Self> {
        let mut groups: Vec<Self> = Vec::new();
        for (index, column) in columns.iter().enumerate() {
            let mut about = json!({
                "type": "number", "title": column.name, "description": column.meaning, "unit": column.unit
            });
            if let (Some(frame), Some(about)) = (&column.frame, about.as_object_mut()) {
                about.insert("frame".to_owned(), json!(frame));
            }
            let entry = (index, key(column), about);
            match groups.iter_mut().find(|group| group.name == column.group) {
                Some(group) => group.columns.push(entry),
                None => groups.push(Self {
                    topic: format!("/{}", column.group.replace('.', "/")),
                    name: column.group.clone(),
                    columns: vec![entry],
                }),
            }
        }
        groups
    }

    /// Names, units, frames and meanings of the columns.
    pub(super) fn schema(&self) -> Schema {
        let properties: Map<_, _> =
            self.columns.iter().map(|(_, key, about)| (key.clone(), about.clone())).collect();
        let name = format!("precess.{}", self.name);
        let text = json!({ "type": "object", "title": name, "properties": properties }).to_string();
        Schema { name, text }
    }

    /// The message of a sample, in place of what is there.
    pub(super) fn write(&self, row: &[f64], to: &mut Vec<u8>) {
        to.clear();
        let mut digits = zmij::Buffer::new();
        let mut text = String::new();
        for (index, key, _) in &self.columns {
            let lead = if text.is_empty() { '{' } else { ',' };
            let value = row.get(*index).copied().unwrap_or(f64::NAN);
            // Keys have lower-case letters, digits and underscores.
            let value = if value.is_finite() { digits.format(value) } else { "null" };
            let _ = write!(text, "{lead}\"{key}\":{value}");
        }
        to.extend_from_slice(text.as_bytes());
        to.push(b'}');
    }
}

/// The name of a column without that of its device, with underscores: of `cmg1.mount.force_x` `mount_force_x`.
fn key(column: &Column) -> String {
    let owner = column.group.split('.').next().unwrap_or_default();
    let own = column.name.strip_prefix(owner).and_then(|rest| rest.strip_prefix('.'));
    own.unwrap_or(&column.name).replace('.', "_")
}
