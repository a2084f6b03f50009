//! Results that `run` wrote, read again: [`Rows`] of a CSV file one by one, and [`Signals`], some columns of a CSV or NPZ
//! file with their sampling rate.

use std::io::{BufReader, Read as _};
use std::path::{Path, PathBuf};

use super::error::CommandError;
use super::terminal::note;
use crate::nearest::nearest;
use crate::opened::open;
use crate::record::extent::{Extent, comments};
use crate::spectra::float;
use crate::structure::npz::Members;
use crate::tables::{CsvReader, reader, remark};

/// A sample is at its time to this share of the distance of two.
const EVEN: f64 = 1e-3;
/// Columns that are taken where none is named.
const DEFAULT: &str = "omega";

/// A CSV result that is read row by row.
pub(super) struct Rows {
    reader: CsvReader,
    pub(super) names: Vec<String>,
    pub(super) units: Vec<String>,
    path: PathBuf,
    record: csv::StringRecord,
    extent: Extent,
    count: u64,
}

/// Columns of a result.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Signals {
    /// Samples per second, 1/s.
    pub(super) rate: f64,
    /// Time of the first and last sample, s.
    pub(super) span: [f64; 2],
    pub(super) columns: Vec<Signal>,
}

/// A column of a result.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Signal {
    pub(super) name: String,
    /// Its unit; empty where none is stated.
    pub(super) unit: String,
    pub(super) samples: Vec<f64>,
}

impl Rows {
    pub(super) fn open(path: &Path) -> Result<Self, CommandError> {
        let failure = |source| CommandError::Io { path: path.to_owned(), source };
        let wrong = |text: String| wrong(path, &text);
        let ending = path.extension();
        if ending.is_some_and(|ending| {
            ["npz", "parquet", "mcap"].iter().any(|of| ending.eq_ignore_ascii_case(of))
        }) {
            return Err(wrong("not a CSV file; name the CSV result of the run".to_owned()));
        }
        let comments = comments(&mut BufReader::new(open(path).map_err(failure)?));
        let comments = comments.map_err(failure)?;
        let extent = Extent::of_comments(comments.iter().map(String::as_str));
        if extent == Extent::NotEnded {
            let path = path.display();
            note(&format!("warning: {path}: the run that writes it has not ended, or was killed"));
        }
        let mut reader = reader(path, u64::MAX).map_err(|fault| wrong(fault.to_string()))?;
        let head = reader.headers().map_err(|error| wrong(error.to_string()))?;
        let names: Vec<_> = head.iter().map(str::to_owned).collect();
        check_names(path, &names)?;
        let units = units(&comments, names.len());
        let (path, record) = (path.to_owned(), csv::StringRecord::new());
        Ok(Self { reader, names, units, path, record, extent, count: 0 })
    }

    /// The next row, if there is one.
    pub(super) fn next(&mut self, row: &mut Vec<f64>) -> Result<bool, CommandError> {
        let wrong = |text: String| wrong(&self.path, &text);
        let more =
            self.reader.read_record(&mut self.record).map_err(|error| wrong(error.to_string()))?;
        row.clear();
        for text in &self.record {
            let number = text.parse::<f64>();
            row.push(number.map_err(|_| {
                let line = self.record.position().map_or(0, csv::Position::line);
                let remark = remark(text, &self.record, self.count == 0);
                wrong(format!("line {line}: `{text}` is no number{remark}"))
            })?);
        }
        if more {
            self.count += 1;
            return Ok(true);
        }
        let missing = self.extent.missing(&self.path, self.count);
        let missing = missing.map_err(|error| wrong(error.to_string()))?;
        missing.map_or(Ok(false), |text| Err(wrong(text)))
    }
}

impl Signals {
    /// The columns of a result with these names, or of vectors with them, in the order of the result: `omega` where none
    /// is named, or the first three where it has no such vector. Only samples from one time to another, s.
    pub(super) fn read(
        path: &Path,
        names: &[String],
        [from, to]: [f64; 2],
    ) -> Result<Self, CommandError> {
        let (places, [all, units], mut values) =
            if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("npz")) {
                of_npz(path, names)?
            } else {
                of_csv(path, names)?
            };
        let times = values.first().cloned().unwrap_or_default();
        let first = times.iter().position(|time| *time >= from).unwrap_or(times.len());
        let end = times.iter().position(|time| *time > to).unwrap_or(times.len()).max(first);
        let times = times.get(first..end).unwrap_or_default();
        let (rate, count) = even(path, times)?;
        let span = [times.first(), times.get(count - 1)].map(|t| t.copied().unwrap_or_default());
        let columns = places.iter().zip(values.drain(..).skip(1)).map(|(place, samples)| Signal {
            name: all.get(*place).cloned().unwrap_or_default(),
            unit: units.get(*place).filter(|unit| *unit != "1").cloned().unwrap_or_default(),
            samples: samples.get(first..first + count).unwrap_or_default().to_vec(),
        });
        Ok(Self { rate, span, columns: columns.collect() })
    }
}

/// Places of columns; names and units of all columns; values of the time and of those columns.
type ReadColumns = (Vec<usize>, [Vec<String>; 2], Vec<Vec<f64>>);

fn of_csv(path: &Path, names: &[String]) -> Result<ReadColumns, CommandError> {
    let mut rows = Rows::open(path)?;
    let places = chosen(path, names, &rows.names)?;
    let mut values = vec![Vec::new(); 1 + places.len()];
    let mut row = Vec::new();
    while rows.next(&mut row)? {
        let wanted = std::iter::once(&0).chain(&places);
        for (values, place) in values.iter_mut().zip(wanted) {
            values.push(row.get(*place).copied().unwrap_or(f64::NAN));
        }
    }
    Ok((places, [rows.names, rows.units], values))
}

fn of_npz(path: &Path, names: &[String]) -> Result<ReadColumns, CommandError> {
    let failure = |source| CommandError::Io { path: path.to_owned(), source };
    let mut bytes = Vec::new();
    open(path).and_then(|mut file| file.read_to_end(&mut bytes)).map_err(failure)?;
    let wrong = |text: &dyn std::fmt::Display| wrong(path, &text.to_string());
    let members = Members::from_bytes(&bytes)
        .map_err(|error| wrong(&format!("it was cut, or is no NPZ file: {error}")))?;
    let texts = |name: &str| {
        let array = members.needed(name).map_err(|error| wrong(&error))?;
        array.texts().map_err(|fault| wrong(&format!("{name}: {fault}")))
    };
    let (all, units) = (texts("columns")?, texts("units")?);
    check_names(path, &all)?;
    let places = chosen(path, names, &all)?;
    let samples = members.needed("samples").map_err(|error| wrong(&error))?;
    let shape = [samples.shape().first().copied().unwrap_or(0), all.len()];
    let samples =
        samples.numbers(Some(&shape)).map_err(|fault| wrong(&format!("samples: {fault}")))?;
    let wanted = std::iter::once(&0).chain(&places);
    let column = |place: &usize| samples.iter().skip(*place).step_by(all.len().max(1)).copied();
    let values = wanted.map(|place| column(place).collect()).collect();
    Ok((places, [all, units], values))
}

/// The places of the columns with these names, each once.
fn chosen(path: &Path, names: &[String], all: &[String]) -> Result<Vec<usize>, CommandError> {
    let of = |name: &str| -> Vec<usize> {
        let is = |known: &String| {
            known == name || ["_x", "_y", "_z"].iter().any(|axis| *known == format!("{name}{axis}"))
        };
        (1..all.len()).filter(|place| all.get(*place).is_some_and(is)).collect()
    };
    let mut places = Vec::new();
    for name in names {
        let found = of(name);
        if found.is_empty() {
            let near = nearest(name, all.iter().skip(1).map(String::as_str));
            let near = match near.as_slice() {
                [] => "name a column of the result, or a vector such as `omega`".to_owned(),
                near => format!("nearest: `{}`", near.join("`, `")),
            };
            return Err(wrong(path, &format!("it has no column `{name}`; {near}")));
        }
        places.extend(found);
    }
    if names.is_empty() {
        places = of(DEFAULT);
    }
    if places.is_empty() {
        places = (1..all.len().min(4)).collect();
    }
    places.sort_unstable();
    places.dedup();
    if places.is_empty() {
        return Err(wrong(path, "it has no column beside `time`"));
    }
    Ok(places)
}

/// The rate of samples at even times, 1/s, and how many there are: a last one that is not even is left out.
fn even(path: &Path, times: &[f64]) -> Result<(f64, usize), CommandError> {
    let short = || wrong(path, "fewer than three samples in the interval; choose a longer one");
    let count = times.len();
    let [Some(first), Some(before)] = [times.first(), times.get(count.saturating_sub(2))] else {
        return Err(short());
    };
    if count < 3 {
        return Err(short());
    }
    let step = (before - first) / (float(count) - 2.0);
    let is_even =
        |(index, time): (usize, &f64)| (time - (first + float(index) * step)).abs() <= EVEN * step;
    // A NaN is at no time.
    match times.iter().enumerate().position(|pair| !is_even(pair)) {
        None if step > 0.0 => Ok((1.0 / step, count)),
        Some(index) if step > 0.0 && index + 1 == count => Ok((1.0 / step, count - 1)),
        found => {
            let index = found.unwrap_or(0);
            let time = times.get(index).copied().unwrap_or(f64::NAN);
            let text = format!(
                "sample {index} of the interval, at {time} s, is not evenly spaced from the others; \
                 choose an interval with even samples (--from, --to)"
            );
            Err(wrong(path, &text))
        }
    }
}

/// Rejects columns of which the first is not the time.
fn check_names(path: &Path, names: &[String]) -> Result<(), CommandError> {
    if names.first().map(String::as_str) == Some("time") {
        return Ok(());
    }
    Err(wrong(path, "no result: its first column is not `time`"))
}

/// What is wrong with a result.
fn wrong(path: &Path, text: &str) -> CommandError {
    CommandError::Other(format!("{}: {text}", path.display()))
}

/// The units of a result's columns, from its metadata; empty where there are none.
fn units(comments: &[String], count: usize) -> Vec<String> {
    let columns = comments
        .iter()
        .skip_while(|line| !line.starts_with("# columns:"))
        .skip(1)
        .take_while(|line| line.starts_with("#   "));
    let unit = |line: &String| {
        let (_, rest) = line.split_once(" [")?;
        rest.split_once(']').map(|(unit, _)| unit.to_owned())
    };
    let units: Vec<_> = columns.map(|line| unit(line).unwrap_or_default()).collect();
    if units.len() == count { units } else { vec![String::new(); count] }
}
