//! The rows of a campaign as CSV and NPZ.

use std::io;

use super::{Field, Finished, Plan, digits};
use crate::structure::npz::{archived, numbers, texts};

/// The state of a sample that was run to its end.
const OK: &str = "ok";
/// Bytes of an error in an archive, where every state is as wide as the widest.
const STATE_MAX: usize = 120;

/// A row for each sample in order: its number, the values of its keys in their units, its state (`ok`, or the error), its
/// numbers in SI. A number that does not exist is empty.
#[must_use]
pub fn csv(head: &str, plan: &Plan, fields: &[Field], finished: &Finished) -> Vec<u8> {
    let mut text = String::new();
    for line in head.lines() {
        text.push_str("# ");
        text.push_str(line);
        text.push('\n');
    }
    let name = |field: &Field| format!("{} [{}]", field.name, field.unit);
    let names = ["sample".to_owned()].into_iter().chain(plan.labels.iter().cloned());
    let names = names.chain(["state".to_owned()]).chain(fields.iter().map(name));
    line(&mut text, names);
    for (index, (sample, row)) in plan.samples.iter().zip(&finished.rows).enumerate() {
        let Some(row) = row else { continue };
        let values = sample.values.iter().map(|value| digits(*value));
        let cells = [index.to_string()].into_iter().chain(values);
        match &row.result {
            Ok(found) => {
                let number = |v: &f64| if v.is_nan() { String::new() } else { digits(*v) };
                line(&mut text, cells.chain([OK.to_owned()]).chain(found.iter().map(number)));
            }
            Err(error) => {
                let empty = fields.iter().map(|_| String::new());
                line(&mut text, cells.chain([error.replace(['\n', '\r'], " ")]).chain(empty));
            }
        }
    }
    text.into_bytes()
}

/// Cells with commas between them, in quotation marks where they have commas or quotation marks (RFC 4180).
fn line(text: &mut String, cells: impl Iterator<Item = String>) {
    for (index, cell) in cells.enumerate() {
        if index > 0 {
            text.push(',');
        }
        if cell.contains([',', '"']) {
            text.push('"');
            text.push_str(&cell.replace('"', "\"\""));
            text.push('"');
        } else {
            text.push_str(&cell);
        }
    }
    text.push('\n');
}

/// The same as an archive for `numpy.load`: `keys`, `values` (samples by keys), `fields`, `units`, `results` (samples by
/// fields, NaN where there is none), `states`, `head`.
///
/// # Errors
/// Of the archive.
pub fn npz(head: &str, plan: &Plan, fields: &[Field], finished: &Finished) -> io::Result<Vec<u8>> {
    let keys: Vec<&str> = plan.labels.iter().map(String::as_str).collect();
    let names: Vec<&str> = fields.iter().map(|field| field.name.as_str()).collect();
    let units: Vec<&str> = fields.iter().map(|field| field.unit.as_str()).collect();
    let (mut values, mut results, mut states) = (Vec::new(), Vec::new(), Vec::new());
    for (sample, row) in plan.samples.iter().zip(&finished.rows) {
        let Some(row) = row else { continue };
        values.extend(&sample.values);
        match &row.result {
            Ok(found) => {
                results.extend(found);
                states.push(OK);
            }
            Err(error) => {
                results.extend(std::iter::repeat_n(f64::NAN, fields.len()));
                states.push(
                    error.split_at_checked(STATE_MAX).map_or(error.as_str(), |(start, _)| start),
                );
            }
        }
    }
    let count = states.len();
    archived(&[
        ("keys", texts(&keys, &[keys.len()])),
        ("values", numbers(&values, &[count, keys.len()])),
        ("fields", texts(&names, &[names.len()])),
        ("units", texts(&units, &[units.len()])),
        ("results", numbers(&results, &[count, fields.len()])),
        ("states", texts(&states, &[count])),
        ("head", texts(&[head], &[])),
    ])
}
