//! [`Differences`] of two results (CSV), column by column over all samples.
//!
//! Both files are read side by side, so memory does not grow with them.

use std::fs::File;
use std::path::{Path, PathBuf};

use super::error::CommandError;

/// The differences of all columns that both results have.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Differences {
    pub(super) columns: Vec<Difference>,
    pub(super) samples: u64,
}

/// The difference of one column over all samples.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Difference {
    pub(super) name: String,
    pub(super) unit: String,
    /// Its index in either.
    places: [usize; 2],
    /// Largest magnitude of the difference, and the time of it.
    pub(super) peak: f64,
    pub(super) time: f64,
    /// Sum of squares of the difference.
    square: f64,
    /// Largest magnitude of the column in each.
    pub(super) largest: [f64; 2],
}

/// A result that is read row by row.
struct Rows {
    reader: csv::Reader<File>,
    names: Vec<String>,
    units: Vec<String>,
    path: PathBuf,
    record: csv::StringRecord,
}

impl Difference {
    /// Root mean square over so many samples.
    #[expect(clippy::cast_precision_loss, reason = "fewer samples than 2^53")]
    pub(super) fn rms(&self, samples: u64) -> f64 {
        (self.square / samples.max(1) as f64).sqrt()
    }
}

impl Rows {
    fn open(path: &Path) -> Result<Self, CommandError> {
        let wrong = |text: String| wrong(path, &text);
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .from_path(path)
            .map_err(|error| wrong(error.to_string()))?;
        let head = reader.headers().map_err(|error| wrong(error.to_string()))?;
        let names: Vec<_> = head.iter().map(str::to_owned).collect();
        if names.first().map(String::as_str) != Some("time") {
            return Err(wrong("no result: its first column is not `time`".to_owned()));
        }
        let units = units(path, names.len());
        Ok(Self { reader, names, units, path: path.to_owned(), record: csv::StringRecord::new() })
    }

    /// The next row, if there is one.
    fn next(&mut self, row: &mut Vec<f64>) -> Result<bool, CommandError> {
        let wrong = |text: String| wrong(&self.path, &text);
        let more =
            self.reader.read_record(&mut self.record).map_err(|error| wrong(error.to_string()))?;
        row.clear();
        for text in &self.record {
            let number = text.parse::<f64>();
            row.push(number.map_err(|_| wrong(format!("`{text}` is no number")))?);
        }
        Ok(more)
    }
}

/// What is wrong with a result.
fn wrong(path: &Path, text: &str) -> CommandError {
    CommandError::Other(format!("{}: {text}", path.display()))
}

/// The units of a result's columns, from its metadata; empty where there are none.
fn units(path: &Path, count: usize) -> Vec<String> {
    use std::io::{BufRead as _, BufReader};
    let Ok(file) = File::open(path) else { return vec![String::new(); count] };
    let lines = BufReader::new(file).lines().map_while(Result::ok);
    let comments = lines.take_while(|line| line.starts_with('#'));
    let columns = comments
        .skip_while(|line| !line.starts_with("# columns:"))
        .skip(1)
        .take_while(|line| line.starts_with("#   "));
    let unit = |line: String| {
        let (_, rest) = line.split_once(" [")?;
        rest.split_once(']').map(|(unit, _)| unit.to_owned())
    };
    let units: Vec<_> = columns.map(|line| unit(line).unwrap_or_default()).collect();
    if units.len() == count { units } else { vec![String::new(); count] }
}

/// Reads two results.
pub(super) fn differences(a: &Path, b: &Path) -> Result<Differences, CommandError> {
    let (mut a, mut b) = (Rows::open(a)?, Rows::open(b)?);
    let mut columns = Vec::new();
    for (place, (name, unit)) in a.names.iter().zip(&a.units).enumerate().skip(1) {
        if let Some(other) = b.names.iter().position(|known| known == name) {
            columns.push(Difference {
                name: name.clone(),
                unit: unit.clone(),
                places: [place, other],
                ..Difference::default()
            });
        }
    }
    let (mut row_a, mut row_b) = (Vec::new(), Vec::new());
    let mut samples = 0;
    loop {
        let more = [a.next(&mut row_a)?, b.next(&mut row_b)?];
        match more {
            [false, false] => break,
            [true, true] => {}
            _ => {
                let message = "one result has more samples than the other; compare runs of one \
                               duration and rate";
                return Err(CommandError::Other(message.to_owned()));
            }
        }
        let value = |row: &[f64], place: usize| row.get(place).copied().unwrap_or(f64::NAN);
        let [time_a, time_b] = [value(&row_a, 0), value(&row_b, 0)];
        if time_a != time_b {
            let message = format!(
                "sample {samples} is at {time_a} s in one and at {time_b} s in the other; compare \
                 runs of one rate"
            );
            return Err(CommandError::Other(message));
        }
        for d in &mut columns {
            let [of_a, of_b] = [value(&row_a, d.places[0]), value(&row_b, d.places[1])];
            let off = (of_a - of_b).abs();
            if off > d.peak || off.is_nan() {
                (d.peak, d.time) = (off, time_a);
            }
            d.square += off * off;
            let [a, b] = d.largest;
            d.largest = [a.max(of_a.abs()), b.max(of_b.abs())];
        }
        samples += 1;
    }
    Ok(Differences { columns, samples })
}
