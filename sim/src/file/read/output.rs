//! What is recorded, and the limits on it: `[output]`, `[[requirement]]`, `[[crossing]]`.

use super::super::document::Value;
use super::super::keys::Keys;
use crate::scenario::{Crossing, Format, Output, Requirement, Settings, Statistic};
use crate::units::{Measure, parse_unit};

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
    let columns = words(&output, "columns").unwrap_or_default();
    let formats = words(&output, "formats").map_or(default.formats, |words| {
        let of = [("csv", Format::Csv), ("npz", Format::Npz), ("parquet", Format::Parquet)];
        let mut formats = Vec::new();
        for word in words {
            if let Some((_, format)) = of.iter().find(|(name, _)| *name == word) {
                formats.push(*format);
            } else {
                let message = format!("`{word}` is no format");
                output.error("formats", message, "there are csv, npz, parquet");
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

pub(super) fn requirements(keys: &Keys<'_>, settings: Option<&Settings>) -> Vec<Requirement> {
    let duration = settings.map_or(f64::INFINITY, |settings| settings.duration);
    let tables = keys.tables("requirement");
    tables.iter().filter_map(|keys| requirement(keys, duration)).collect()
}

fn requirement(keys: &Keys<'_>, duration: f64) -> Option<Requirement> {
    let name = keys.text("name");
    let quantity = keys.text("quantity");
    for (key, example) in [("name", "name = \"pointing\""), ("quantity", "quantity = \"omega\"")] {
        if !keys.has(key) {
            keys.missing(key, example);
        }
    }
    let words = [("peak", 0), ("rms", 1), ("band_rms", 2), ("final", 3), ("drift", 4)];
    if !keys.has("statistic") {
        keys.missing("statistic", "statistic = \"peak\"");
    }
    let statistic = keys.choice("statistic", &words);
    let band = keys.quantities::<2>("band", Measure::FREQUENCY);
    let statistic = match statistic? {
        0 => Statistic::Peak,
        1 => Statistic::Rms,
        2 => {
            if !keys.has("band") {
                keys.missing("band", "band = \"1, 100 Hz\"");
            }
            Statistic::BandRms(band?)
        }
        3 => Statistic::Final,
        _ => Statistic::Drift,
    };
    if keys.has("band") && !matches!(statistic, Statistic::BandRms(_)) {
        keys.error("band", "only a `band_rms` has a band", "remove it");
    }
    let from = keys.quantity("from", Measure::TIME).unwrap_or(0.0);
    let to = keys.quantity("to", Measure::TIME).unwrap_or(duration);
    if !keys.has("limit") {
        keys.missing("limit", "limit = \"0.1 deg/s\"");
    }
    let limit = keys.any_quantity("limit");
    keys.finish();
    let limit = limit?;
    let (&[value], Ok((size, _))) = (limit.values.as_slice(), unit_of(&limit.unit)) else {
        keys.error("limit", "a limit is one number with its unit", "");
        return None;
    };
    Some(Requirement {
        name: name?.to_owned(),
        quantity: quantity?.to_owned(),
        statistic,
        window: [from, to],
        limit: value,
        written: keys.text_or_list("limit").map_or_else(|| format!("{value:?}"), str::to_owned),
        unit: (limit.unit, size),
    })
}

fn unit_of(unit: &str) -> Result<(f64, crate::units::Dimension), crate::units::UnitError> {
    if unit.is_empty() { Ok((1.0, crate::units::Dimension::default())) } else { parse_unit(unit) }
}

/// `[[crossing]]`: `name`, `column`, `value` in the column's unit, and `ends = true`.
pub(super) fn crossings(keys: &Keys<'_>) -> Vec<Crossing> {
    let tables = keys.tables("crossing");
    tables.iter().filter_map(crossing).collect()
}

fn crossing(keys: &Keys<'_>) -> Option<Crossing> {
    let name = keys.text("name").unwrap_or("crossing").to_owned();
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
