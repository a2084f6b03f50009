//! `[source.harmonics]`: harmonics from a CSV file, a row for each, as data sheets and fits list them.
//!
//! Each row is read as `[[source.harmonic]]` is: what is wrong with one is said in the same words.

use std::path::Path;

use super::components::names;
use super::models::harmonic;
use crate::disturbance::Harmonic;
use crate::file::document::{Entry, Node, Table, Value};
use crate::file::keys::Keys;
use crate::file::read::values::table_file::columns;

/// The column of harmonic numbers.
const NUMBER: &str = "number";
/// What names of columns of phases begin with.
const PHASE: &str = "phase.";

/// The harmonics of a source with a name, a spin axis and a seed.
pub(super) fn harmonics_of_file(
    keys: &Keys<'_>,
    of: (&str, usize, Option<u32>),
    folder: &Path,
) -> Option<Vec<Harmonic>> {
    let named = keys.file("file", folder);
    if !keys.has("file") {
        keys.missing("file", "file = \"bearing.csv\"");
    }
    let unit = |key: &str, default: &'static str| keys.text(key).unwrap_or(default).to_owned();
    let [force, moment] =
        [("force_unit", "kg m"), ("moment_unit", "kg m^2")].map(|(k, u)| unit(k, u));
    let phase = unit("phase_unit", "deg");
    keys.finish();
    let (path, shown) = named?;
    let amplitudes: Vec<&str> = names(of.1).collect();
    let phases: Vec<String> = amplitudes.iter().map(|name| format!("{PHASE}{name}")).collect();
    let mut wanted = vec![(NUMBER, true)];
    wanted.extend(amplitudes.iter().map(|name| (*name, false)));
    wanted.extend(phases.iter().map(|name| (name.as_str(), false)));
    let found = match columns(&path, &wanted) {
        Ok(found) => found,
        Err(message) => {
            keys.error("file", format!("{shown}: {message}"), "");
            return None;
        }
    };
    let (numbers, rest) = found.split_first()?;
    let (of_amplitudes, of_phases) = rest.split_at_checked(amplitudes.len())?;
    if of_amplitudes.iter().all(Vec::is_empty) {
        let message = format!("{shown} has no column of a component");
        keys.error("file", message, &format!("there are {}", amplitudes.join(", ")));
        return None;
    }
    let span = keys.place("file");
    let entry = |key: &str, value: Value| {
        let node = Node { value, span: span.clone() };
        Entry { key: key.to_owned(), key_span: span.clone(), node }
    };
    let quantity = |number: &f64, unit: &str| Value::Text(format!("{number:?} {unit}"));
    let row = |(row, number): (usize, &f64)| {
        let mut entries = vec![entry(NUMBER, Value::Number(*number, false))];
        let mut own_phases = Table::default();
        for ((name, values), phases) in amplitudes.iter().zip(of_amplitudes).zip(of_phases) {
            // An amplitude of zero is no tone, and needs no phase.
            let Some(amplitude) = values.get(row).filter(|value| **value != 0.0) else { continue };
            let unit = if name.contains("force") { &force } else { &moment };
            entries.push(entry(name, quantity(amplitude, unit)));
            if let Some(value) = phases.get(row) {
                own_phases.entries.push(entry(name, quantity(value, &phase)));
            }
        }
        if !own_phases.entries.is_empty() {
            entries.push(entry("phase", Value::Table(own_phases)));
        }
        let node = Node { value: Value::Table(Table { entries }), span: span.clone() };
        let first = keys.reports().borrow().all.len();
        let found =
            Keys::new(&node, keys.path(), keys.reports()).and_then(|keys| harmonic(&keys, of));
        let place = format!("it is in row {} of {shown}", row + 1);
        keys.reports().borrow_mut().add_help(first, &place);
        found
    };
    let all: Vec<Option<Harmonic>> = numbers.iter().enumerate().map(row).collect();
    all.into_iter().collect()
}
