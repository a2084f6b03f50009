//! Profiles: a constant, or a table that says how a quantity changes over time.
//!
//! ```toml
//! torque = "0.1 N m"
//! torque = { step = "0.1 N m", at = "1 s", before = "0 N m" }
//! torque = { ramp = ["0 N m", "0.1 N m"], from = "1 s", to = "2 s" }
//! torque = { sine = "0.1 N m", frequency = "2 Hz", phase = "0 deg", mean = "0 N m" }
//! torque = { chirp = "0.1 N m", frequency = ["1 Hz", "50 Hz"], from = "0 s", to = "10 s" }
//! torque = { table = "torque.csv", column = "u", unit = "N m", interpolation = "linear" }
//! ```
//!
//! A step, a sine and a table may be limited to `from` and `to`: they are zero outside.

use std::path::Path;

use super::table_file::columns;
use crate::file::document::{Node, Value};
use crate::file::keys::Keys;
use crate::file::load::PROFILE_KINDS;
use crate::scenario::profile::Interpolation;
use crate::scenario::{Profile, Table};
use crate::units::{Measure, parse_unit};

/// A profile; nothing where one is wrong, which has been reported.
pub(in crate::file::read) fn profile(
    keys: &Keys<'_>,
    key: &str,
    node: &Node,
    measure: Measure,
    folder: &Path,
) -> Option<Profile> {
    if !matches!(node.value, Value::Table(_)) {
        return keys.quantity(key, measure).map(Profile::Constant);
    }
    let table = keys.table(key)?;
    let profile = of_table(&table, measure, folder);
    table.finish();
    let profile = profile?;
    if let Some(fault) = profile.fault() {
        keys.error(key, fault, "");
        return None;
    }
    Some(profile)
}

fn of_table(keys: &Keys<'_>, measure: Measure, folder: &Path) -> Option<Profile> {
    let kinds: Vec<_> = PROFILE_KINDS.into_iter().filter(|kind| keys.has(kind)).collect();
    let &[kind] = kinds.as_slice() else {
        let message = format!("`{}` has {} of the keys of a profile", keys.path(), kinds.len());
        let help = format!("give one of {}", PROFILE_KINDS.join(", "));
        keys.reports().borrow_mut().error(keys.span(), message, "", &help);
        return None;
    };
    let profile = match kind {
        "constant" => keys.quantity("constant", measure).map(Profile::Constant),
        "step" => {
            let after = keys.quantity("step", measure);
            let at = keys.required("at", Measure::TIME);
            let before = keys.quantity("before", measure).unwrap_or(0.0);
            Some(Profile::Step { at: at?, before, after: after? })
        }
        "ramp" => {
            let values = keys.quantities::<2>("ramp", measure);
            let between = between(keys)?;
            return Some(Profile::Ramp { between, values: values? });
        }
        "sine" => {
            let amplitude = keys.quantity("sine", measure);
            let frequency = keys.required("frequency", Measure::FREQUENCY);
            let phase = keys.quantity("phase", Measure::ANGLE).unwrap_or(0.0);
            let mean = keys.quantity("mean", measure).unwrap_or(0.0);
            let (amplitude, frequency) = (amplitude?, frequency?);
            Some(Profile::Sine { mean, amplitude, frequency, phase })
        }
        "chirp" => {
            let amplitude = keys.quantity("chirp", measure);
            let frequencies = keys.quantities::<2>("frequency", Measure::FREQUENCY);
            if !keys.has("frequency") {
                keys.missing("frequency", "frequency = [\"1 Hz\", \"50 Hz\"]");
            }
            let between = between(keys)?;
            let (amplitude, frequencies) = (amplitude?, frequencies?);
            return Some(Profile::Chirp { amplitude, between, frequencies });
        }
        "times" => inline(keys, measure).map(Profile::Table),
        _ => file(keys, measure, folder).map(Profile::Table),
    };
    if keys.has("from") || keys.has("to") {
        let between = between(keys)?;
        return profile.map(|profile| Profile::During { between, profile: Box::new(profile) });
    }
    profile
}

fn between(keys: &Keys<'_>) -> Option<[f64; 2]> {
    let from = keys.required("from", Measure::TIME);
    let to = keys.required("to", Measure::TIME);
    Some([from?, to?])
}

/// A table in the file itself: `times = "0, 1, 2 s"`, `values = "0, 0.1, 0 N m"`.
fn inline(keys: &Keys<'_>, measure: Measure) -> Option<Table> {
    let list = |key: &str, measure: Measure| {
        if let Some(node) = keys.node(key) {
            keys.values_of(node, key, measure)
        } else {
            keys.missing(key, &format!("{key} = \"0, 1 {}\"", measure.usual));
            None
        }
    };
    let (times, values) = (list("times", Measure::TIME), list("values", measure));
    let interpolation = interpolation(keys)?;
    Some(Table { times: times?, values: values?, interpolation })
}

fn interpolation(keys: &Keys<'_>) -> Option<Interpolation> {
    if !keys.has("interpolation") {
        keys.missing("interpolation", "interpolation = \"linear\"");
    }
    let words = [("linear", Interpolation::Linear), ("hold", Interpolation::Hold)];
    keys.choice("interpolation", &words)
}

/// A table in a CSV file: the column `time_s`, and one of values in a unit.
fn file(keys: &Keys<'_>, measure: Measure, folder: &Path) -> Option<Table> {
    let named = keys.file("table", folder);
    let column = keys.text("column");
    let unit = keys.text("unit");
    let interpolation = interpolation(keys);
    for (key, example) in [("column", "column = \"torque\""), ("unit", "unit = \"N m\"")] {
        if !keys.has(key) {
            keys.missing(key, example);
        }
    }
    let ((path, name), column, unit, interpolation) = (named?, column?, unit?, interpolation?);
    let (size, dimension) = match parse_unit(unit) {
        Ok(unit) => unit,
        Err(error) => {
            keys.error("unit", format!("`{unit}`: {}", error.kind), "");
            return None;
        }
    };
    if dimension != measure.dimension {
        let Measure { name, usual, .. } = measure;
        keys.error("unit", format!("`{unit}` is no unit of {name}"), &format!("{usual} is one"));
        return None;
    }
    match columns(&path, &[("time_s", true), (column, true)]) {
        Ok(columns) => {
            let [times, values] = <[Vec<f64>; 2]>::try_from(columns).ok()?;
            let values = values.into_iter().map(|value| value * size).collect();
            Some(Table { times, values, interpolation })
        }
        Err(message) => {
            keys.error("table", format!("{name}: {message}"), "");
            None
        }
    }
}
