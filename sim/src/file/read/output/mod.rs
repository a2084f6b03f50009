//! What is recorded, and what is noted: `[output]`, `[[crossing]]`.

pub(super) mod columns;
mod margin_requirement;
pub(super) mod requirement;

use std::collections::HashSet;

use crate::file::document::Value;
use crate::file::keys::Keys;
use crate::names::numbered;
use crate::scenario::{Crossing, Format, Output, Settings};
use crate::units::Measure;

/// Samples in a run without a rate.
const SAMPLES: f64 = 5000.0;

pub(super) fn output(keys: &Keys<'_>, settings: Option<&Settings>) -> Option<Output> {
    let duration = settings.map_or(1.0, |settings| settings.duration);
    let default =
        Output { rate: SAMPLES / duration, columns: Vec::new(), formats: vec![Format::Csv] };
    if !keys.has("output") {
        return Some(default);
    }
    let output = keys.table("output")?;
    let rate = output.quantity("rate", Measure::FREQUENCY).unwrap_or(default.rate);
    let columns = words(&output, "columns");
    if columns.as_ref().is_some_and(Vec::is_empty) {
        let help = "name columns, or leave the key out for all but the loads";
        output.error("columns", "`columns` names no column", help);
    }
    let columns = columns.unwrap_or_default();
    let formats = words(&output, "formats").map_or(default.formats, |words| {
        let of = [
            ("csv", Format::Csv),
            ("npz", Format::Npz),
            ("parquet", Format::Parquet),
            ("mcap", Format::Mcap),
        ];
        let mut formats = Vec::new();
        for word in words {
            if let Some((_, format)) = of.iter().find(|(name, _)| *name == word) {
                formats.push(*format);
            } else {
                let message = format!("`{word}` is no format");
                output.error("formats", message, "there are csv, npz, parquet, mcap");
            }
        }
        formats.sort_unstable();
        formats.dedup();
        formats
    });
    output.finish();
    Some(Output { rate, columns, formats })
}

/// A list of words.
fn words(keys: &Keys<'_>, key: &str) -> Option<Vec<String>> {
    let node = keys.node(key)?;
    let list = match &node.value {
        Value::Text(word) => return Some(vec![word.clone()]),
        Value::List(list) => list,
        other => {
            keys.error(key, format!("`{key}` is {}", other.what()), "write a list of words");
            return None;
        }
    };
    let word = |value: &Value| match value {
        Value::Text(word) => Some(word.clone()),
        _ => None,
    };
    let found: Option<Vec<_>> = list.iter().map(|node| word(&node.value)).collect();
    if found.is_none() {
        keys.error(key, format!("`{key}` is no list of words"), "write each in quotation marks");
    }
    found
}

/// `[[crossing]]`: `name`, `column`, `value` in the column's unit, and `ends = true`.
pub(super) fn crossings(keys: &Keys<'_>) -> Vec<Crossing> {
    let tables = keys.tables("crossing");
    let mut taken = tables.iter().filter_map(|keys| keys.text("name")).map(str::to_owned).collect();
    tables.iter().filter_map(|keys| crossing(keys, &mut taken)).collect()
}

/// One without a name is `crossing`, from the second on with its number.
fn crossing(keys: &Keys<'_>, taken: &mut HashSet<String>) -> Option<Crossing> {
    let name = keys.text("name").map_or_else(|| numbered("crossing", taken), str::to_owned);
    let column = keys.text("column");
    if !keys.has("column") {
        keys.missing("column", "column = \"wheel1.spin\"");
    }
    let value = keys.any_quantity("value");
    if !keys.has("value") {
        keys.missing("value", "value = \"3000 rpm\"");
    }
    let ends = keys.boolean("ends").unwrap_or(false);
    keys.finish();
    let value = value?;
    let unit = value.dimension.to_string();
    let [value] = value.values.as_slice() else {
        keys.error("value", "it is one number with its unit", "");
        return None;
    };
    let unit = if unit == "1" { String::new() } else { unit };
    Some(Crossing { name, column: column?.to_owned(), value: *value, unit, ends })
}
