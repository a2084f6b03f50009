//! `waterfall` of a measurement (docs/fit.md): densities in rows of speed, frequency and six columns.

use std::path::Path;

use super::keys::Keys;
use crate::fit::WaterfallRow;
use crate::fit::samples::columns;
use crate::units::{Measure, parse_unit};

/// Rows of one speed have speeds within this share.
const SAME_SPEED: f64 = 1e-9;
/// Frequencies are evenly spaced from zero to this share of a bin.
const EVEN: f64 = 1e-3;

/// The spectra of a file; none after an error.
pub(super) fn waterfall(keys: &Keys<'_>, file: &str, folder: &Path) -> Option<Vec<WaterfallRow>> {
    if keys.has("table") {
        let message = "densities cannot be referred to another point or other axes";
        keys.error("table", message, "refer the moments before, and remove `[table]`");
    }
    let segments = keys.number("segments");
    if segments.is_none() && !keys.has("segments") {
        keys.missing("segments", "segments = 12");
    }
    let Some(table) = keys.table("columns") else {
        if !keys.has("columns") {
            keys.missing("columns", "[columns]");
        }
        return None;
    };
    let name = |key: &str, example: &str| {
        if !table.has(key) {
            table.missing(key, &format!("{key} = \"{example}\""));
        }
        table.text(key)
    };
    let (speed, frequency) = (name("speed", "speed_rpm"), name("frequency", "f_hz"));
    let unit = |key: &str, measure: Measure| match table.text(key) {
        None => Some(1.0),
        Some(text) => match parse_unit(text) {
            Ok((size, dimension)) if dimension == measure.dimension => Some(size),
            _ => {
                let message = format!("`{text}` is no unit of {}", measure.name);
                table.error(key, message, &format!("{} is one", measure.usual));
                None
            }
        },
    };
    let sizes = [unit("force_unit", Measure::FORCE), unit("torque_unit", Measure::TORQUE)];
    let speed_size = unit("speed_unit", Measure::ANGULAR_RATE);
    let three = |key: &str, or: [&'static str; 3]| table.texts(key).unwrap_or_else(|| or.to_vec());
    let mut names: Vec<&str> = [speed?, frequency?].to_vec();
    names.extend(three("force", ["fx", "fy", "fz"]));
    names.extend(three("torque", ["tx", "ty", "tz"]));
    table.finish();
    if names.len() != 8 {
        table.error("force", "`force` and `torque` are three names each", "name x, y and z");
        return None;
    }
    // Densities are of the squares.
    let sizes = [sizes[0]?.powi(2), sizes[1]?.powi(2)];
    let (segments, speed_size) = (segments?, speed_size?);
    let read = match columns(&folder.join(file), &names) {
        Ok(read) => read,
        Err(error) => {
            keys.error("waterfall", error.to_string(), "");
            return None;
        }
    };
    let mut rows: Vec<WaterfallRow> = Vec::new();
    let mut frequencies: Vec<f64> = Vec::new();
    for index in 0..read[0].len() {
        let at = |column: usize| read[column].get(index).copied().unwrap_or(f64::NAN);
        let speed = at(0) * speed_size;
        let same = rows
            .last()
            .is_some_and(|row| (row.speed - speed).abs() <= SAME_SPEED * row.speed.abs());
        if !same {
            frequencies.clear();
            let densities = Default::default();
            rows.push(WaterfallRow { speed, bin: 0.0, segments, densities });
        }
        frequencies.push(at(1));
        let Some(row) = rows.last_mut() else { continue };
        if let [first, second, ..] = frequencies[..] {
            row.bin = second - first;
        }
        #[expect(clippy::cast_precision_loss, reason = "rows of a file")]
        let wanted = (frequencies.len() - 1) as f64 * row.bin;
        let even = (at(1) - wanted).abs() <= EVEN * row.bin;
        if !even {
            let message = format!("{file}: row {} has {} Hz, not {wanted} Hz", index + 1, at(1));
            keys.error("waterfall", message, "of each speed, start at 0 Hz in even steps");
            return None;
        }
        for (channel, densities) in row.densities.iter_mut().enumerate() {
            densities.push(at(2 + channel) * sizes[channel / 3]);
        }
    }
    Some(rows)
}
