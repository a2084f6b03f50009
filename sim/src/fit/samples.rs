//! Columns of samples from CSV and NPZ files, and steady steps of a sweep.

use std::fmt;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use super::error::FitError;
use super::measurement::{CHANNELS, Record, SAMPLES_MIN};
use crate::opened::open;
use crate::record::extent::check_rows;
use crate::structure::{Fault, MOST_BYTES, bytes_of, npz};

/// Steps between samples differ by less than this share.
const EVEN: f64 = 0.02;
/// Rows of a file at most, and the same as a number.
const ROWS_MAX: usize = 1 << 22;
const LONGEST: f64 = 4_194_304.0;
/// Speeds are averaged over this share of the shortest step before they are compared.
const BLOCK: f64 = 0.04;

/// A file of samples that cannot be used.
#[derive(Debug)]
pub struct SampleError {
    /// The file.
    pub file: PathBuf,
    /// What is wrong.
    pub fault: SampleFault,
}

/// What is wrong with a file of samples.
#[derive(Debug)]
pub enum SampleFault {
    /// The operating system's reason, or that of the format.
    Read(String),
    /// A column that is missing.
    Column {
        /// Its name.
        name: String,
        /// Those that there are.
        present: Vec<String>,
    },
    /// A cell that is no finite number.
    Cell {
        /// The line, from 1.
        line: u64,
        /// The column.
        name: String,
        /// The text.
        found: String,
    },
    /// Too many rows.
    Rows {
        /// The bound.
        bound: usize,
    },
    /// Columns of different lengths.
    Lengths {
        /// The shortest.
        least: usize,
        /// The longest.
        most: usize,
    },
    /// Times that are not evenly spaced.
    Uneven {
        /// The row, from 1, before which a step differs.
        row: usize,
        /// The step there and the mean, s.
        step: [f64; 2],
    },
}

/// Names of columns and what a number of each is in SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    /// Name and size of the time, s; none with a rate.
    pub time: Option<(String, f64)>,
    /// Sampling rate where there is no time, 1/s.
    pub rate: Option<f64>,
    /// Names of the six channels of the table.
    pub channels: [String; CHANNELS],
    /// Size of forces and of moments, N, N m.
    pub sizes: [f64; 2],
    /// Name and size of the speed, rad/s.
    pub speed: Option<(String, f64)>,
    /// Name of a column that rises through the middle of its range at each index pulse.
    pub index: Option<String>,
}

/// The samples of a file, SI, of the table.
#[derive(Clone, Debug, PartialEq)]
pub struct Samples {
    /// 1/s.
    pub rate: f64,
    /// Channels of the table.
    pub channels: [Vec<f64>; CHANNELS],
    /// rad/s; empty without a column.
    pub speed: Vec<f64>,
    /// s from the first sample.
    pub pulses: Vec<f64>,
}

impl fmt::Display for SampleError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.file.display())?;
        match &self.fault {
            SampleFault::Read(reason) => f.write_str(reason),
            SampleFault::Column { name, present } => {
                write!(f, "no column `{name}`; there are {}", present.join(", "))
            }
            SampleFault::Cell { line, name, found } => {
                write!(f, "line {line}: `{found}` of {name} is no finite number")
            }
            SampleFault::Rows { bound } => {
                write!(f, "more than {bound} samples; write one file for each speed")
            }
            SampleFault::Lengths { least, most } => {
                write!(f, "columns of {least} to {most} numbers; make them equal")
            }
            SampleFault::Uneven { row, step: [step, mean] } => write!(
                f,
                "the step before row {row} is {step:e} s, the mean {mean:e} s; samples are evenly \
                 spaced, so resample them or state `rate`"
            ),
        }
    }
}

impl std::error::Error for SampleError {}

/// Reads the columns of a file, CSV or NPZ.
///
/// # Errors
/// File, line and column, and the remedy.
pub fn read(path: &Path, layout: &Layout) -> Result<Samples, SampleError> {
    let failed = |fault| SampleError { file: path.to_owned(), fault };
    let mut names: Vec<&str> = layout.channels.iter().map(String::as_str).collect();
    let optional = [
        layout.time.as_ref().map(|(name, _)| name.as_str()),
        layout.speed.as_ref().map(|(name, _)| name.as_str()),
        layout.index.as_deref(),
    ];
    names.extend(optional.iter().flatten());
    let mut columns = columns(path, &names)?.into_iter();
    let mut next = |there: bool| if there { columns.next() } else { None };
    let mut channels: [Vec<f64>; CHANNELS] = Default::default();
    for (k, channel) in channels.iter_mut().enumerate() {
        *channel = next(true).unwrap_or_default();
        for value in channel.iter_mut() {
            *value *= layout.sizes[k / 3];
        }
    }
    let [time, speed, index] = optional.map(|name| next(name.is_some()));
    let rate = match (&time, layout.rate) {
        (Some(time), _) => {
            rate_of(time, layout.time.as_ref().map_or(1.0, |(_, size)| *size)).map_err(failed)?
        }
        (None, Some(rate)) => rate,
        (None, None) => f64::NAN,
    };
    let size = layout.speed.as_ref().map_or(1.0, |(_, size)| *size);
    let speed = speed.unwrap_or_default().into_iter().map(|value| value * size).collect();
    let pulses = index.map_or_else(Vec::new, |index| rises(&index, rate));
    Ok(Samples { rate, channels, speed, pulses })
}

/// Columns of a file, CSV or NPZ, by their names.
///
/// # Errors
/// File, line and column, and the remedy.
pub fn columns(path: &Path, names: &[&str]) -> Result<Vec<Vec<f64>>, SampleError> {
    let is_npz = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("npz"));
    let read = if is_npz { of_npz(path, names) } else { of_csv(path, names) };
    let columns = read.and_then(|columns| {
        let lengths = || columns.iter().map(Vec::len);
        match (lengths().min(), lengths().max()) {
            (Some(least), Some(most)) if least < most => Err(SampleFault::Lengths { least, most }),
            _ => Ok(columns),
        }
    });
    columns.map_err(|fault| SampleError { file: path.to_owned(), fault })
}

fn of_npz(path: &Path, names: &[&str]) -> Result<Vec<Vec<f64>>, SampleFault> {
    let read = bytes_of(path).and_then(|bytes| npz::named_columns(&bytes, names));
    let columns = read.map_err(|error| match error.fault {
        Fault::Missing { what, present } => SampleFault::Column { name: what, present },
        fault => SampleFault::Read(format!("{}{fault}", error.place)),
    })?;
    if columns.iter().any(|column| column.len() > ROWS_MAX) {
        return Err(SampleFault::Rows { bound: ROWS_MAX });
    }
    Ok(columns)
}

fn of_csv(path: &Path, names: &[&str]) -> Result<Vec<Vec<f64>>, SampleFault> {
    let reason = |error: &dyn fmt::Display| SampleFault::Read(error.to_string());
    let file = open(path).map_err(|error| reason(&error))?;
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(file.take(MOST_BYTES as u64));
    let head = reader.headers().map_err(|error| reason(&error))?.clone();
    let present = || head.iter().map(str::to_owned).collect();
    let places: Result<Vec<usize>, SampleFault> = names
        .iter()
        .map(|name| {
            let place = head.iter().position(|column| column == *name);
            place
                .ok_or_else(|| SampleFault::Column { name: (*name).to_owned(), present: present() })
        })
        .collect();
    let places = places?;
    let mut columns = vec![Vec::new(); names.len()];
    let mut row = csv::StringRecord::new();
    while reader.read_record(&mut row).map_err(|error| reason(&error))? {
        for ((column, place), name) in columns.iter_mut().zip(&places).zip(names) {
            let text = row.get(*place).unwrap_or_default();
            let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
            column.push(number.ok_or_else(|| SampleFault::Cell {
                line: row.position().map_or(0, csv::Position::line),
                name: (*name).to_owned(),
                found: text.to_owned(),
            })?);
        }
        if columns.first().is_some_and(|column| column.len() > ROWS_MAX) {
            return Err(SampleFault::Rows { bound: ROWS_MAX });
        }
    }
    let rows = columns.first().map_or(0, Vec::len);
    check_rows(path, rows).map_err(SampleFault::Read)?;
    Ok(columns)
}

/// The rate of evenly spaced times.
fn rate_of(time: &[f64], size: f64) -> Result<f64, SampleFault> {
    let (Some(first), Some(last)) = (time.first(), time.last()) else { return Ok(f64::NAN) };
    #[expect(clippy::cast_precision_loss, reason = "at most ROWS_MAX")]
    let steps = (time.len() - 1) as f64;
    let mean = (last - first) / steps;
    let uneven = time.windows(2).position(|pair| {
        // Also not a number.
        let even = (pair[1] - pair[0] - mean).abs() <= EVEN * mean;
        !even
    });
    match uneven {
        Some(at) => {
            let step = [(time[at + 1] - time[at]) * size, mean * size];
            Err(SampleFault::Uneven { row: at + 2, step })
        }
        None => Ok(1.0 / (mean * size)),
    }
}

/// Times at which a column rises through the middle of its range, interpolated.
fn rises(column: &[f64], rate: f64) -> Vec<f64> {
    let low = column.iter().copied().fold(f64::INFINITY, f64::min);
    let high = column.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let middle = 0.5 * (low + high);
    let pairs = column.windows(2).enumerate();
    pairs
        .filter(|(_, pair)| pair[0] < middle && pair[1] >= middle)
        .map(|(at, pair)| {
            #[expect(clippy::cast_precision_loss, reason = "at most ROWS_MAX")]
            let at = at as f64;
            (at + (middle - pair[0]) / (pair[1] - pair[0])) / rate
        })
        .collect()
}

/// Mean and slope of a speed about its middle, rad/s and rad/s².
#[must_use]
pub fn mean_and_slope(speed: &[f64], rate: f64) -> [f64; 2] {
    #[expect(clippy::cast_precision_loss, reason = "at most ROWS_MAX")]
    let count = speed.len() as f64;
    let mean = speed.iter().sum::<f64>() / count;
    let (mut over, mut under) = (0.0, 0.0);
    let mut t = -0.5 * (count - 1.0) / rate;
    for value in speed {
        over += t * (value - mean);
        under += t * t;
        t += 1.0 / rate;
    }
    [mean, if under > 0.0 { over / under } else { 0.0 }]
}

/// The steady steps of a sweep: stretches of at least `shortest` s whose speed stays within `tolerance` of
/// its mean.
///
/// # Errors
/// [`FitError::NoSteps`].
pub fn steps(samples: &Samples, tolerance: f64, shortest: f64) -> Result<Vec<Record>, FitError> {
    let none = FitError::NoSteps { tolerance, shortest };
    let length = samples.channels[0].len().min(samples.speed.len());
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within a record")]
    let [least, block] = [shortest, BLOCK * shortest]
        .map(|seconds| (seconds * samples.rate).clamp(1.0, LONGEST) as usize);
    let least = least.max(SAMPLES_MIN);
    let means: Vec<f64> = samples.speed[..length]
        .chunks_exact(block)
        .map(|chunk| mean_and_slope(chunk, samples.rate)[0])
        .collect();
    let mut records = Vec::new();
    let mut start = 0;
    while start < means.len() {
        let mut end = start + 1;
        let mut sum = means[start];
        while end < means.len() {
            #[expect(clippy::cast_precision_loss, reason = "at most ROWS_MAX")]
            let mean = sum / (end - start) as f64;
            let steady = (means[end] - mean).abs() <= tolerance * mean.abs();
            if !steady {
                break;
            }
            sum += means[end];
            end += 1;
        }
        // The blocks at the ends may have a part of a ramp.
        let range = (start + 1) * block..end.saturating_sub(1) * block;
        if range.len() >= least {
            records.push(cut(samples, range, records.len() + 1));
        }
        start = end;
    }
    if records.is_empty() { Err(none) } else { Ok(records) }
}

/// A stretch of a sweep as a record; its channels are still the table's.
fn cut(samples: &Samples, range: std::ops::Range<usize>, number: usize) -> Record {
    let [speed, drift] = mean_and_slope(&samples.speed[range.clone()], samples.rate);
    #[expect(clippy::cast_precision_loss, reason = "at most ROWS_MAX")]
    let (from, to) = (range.start as f64 / samples.rate, (range.end - 1) as f64 / samples.rate);
    let within = samples.pulses.iter().filter(|t| (from..=to).contains(*t));
    Record {
        name: format!("step {number}"),
        rate: samples.rate,
        speed,
        drift,
        pulses: within.map(|t| t - from).collect(),
        channels: samples.channels.each_ref().map(|channel| channel[range.clone()].to_vec()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_staircase_is_cut_into_its_steps() {
        // Two steady seconds and one of ramp, three times.
        let rate = 1000.0;
        let speed: Vec<f64> = (0..9000_u32)
            .map(|k| {
                let (step, t) = (f64::from(k / 3000), f64::from(k % 3000) / rate);
                100.0 + 50.0 * (step + (t - 2.0).max(0.0))
            })
            .collect();
        let samples = Samples {
            rate,
            channels: std::array::from_fn(|_| vec![0.0; speed.len()]),
            speed,
            pulses: vec![0.5, 3.5, 3.6],
        };
        let records = steps(&samples, 2e-3, 1.0).expect("three steps");
        let speeds: Vec<f64> = records.iter().map(|record| record.speed.round()).collect();
        assert_eq!(speeds, [100.0, 150.0, 200.0]);
        assert!(records.iter().all(|record| (1.7..2.1).contains(&record.duration())));
        assert_eq!(records[1].pulses.len(), 2);
        assert!(matches!(steps(&samples, 2e-3, 5.0), Err(FitError::NoSteps { .. })));
    }

    #[test]
    fn an_index_is_where_its_column_rises() {
        let found = rises(&[0.0, 0.0, 5.0, 5.0, 0.0, 2.0, 3.0], 10.0);
        assert!((found[0] - 0.15).abs() < 1e-15 && (found[1] - 0.55).abs() < 1e-15, "{found:?}");
        assert!(rises(&[1.0; 5], 10.0).is_empty());
    }
}
