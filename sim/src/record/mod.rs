//! What a run records: its columns, where the samples go, and its [`Outcome`] or [`RunError`].
//!
//! A [`Recorder`] receives the columns, then every sample, then the result. Files are written as
//! they come and renamed when the run has ended ([`partial`]); [`Samples`] and [`Histories`] keep them in
//! memory; [`RecorderGroup`] passes them to several recorders, [`IntervalRecorder`] those of an interval.

pub mod columns;
pub mod csv;
pub mod decimate;
mod error;
pub(crate) mod extent;
mod fault;
mod file_lock;
mod histories;
mod interval;
mod load_columns;
pub mod no_data;
pub mod npz;
mod outcome;
#[cfg(feature = "parquet")]
pub mod parquet;
pub mod partial;
mod recorder_group;
mod run_error;
mod samples;
pub mod statistics;
#[cfg(test)]
mod tests;
pub(crate) mod welch;

pub use columns::{Column, Columns};
pub use csv::Csv;
pub use decimate::{Bucket, Decimate};
pub use error::RecordError;
pub use fault::Fault;
pub use histories::{Histories, replay};
pub use interval::IntervalRecorder;
pub use npz::Npz;
pub use outcome::{Drift, End, Event, Outcome, Steps};
#[cfg(feature = "parquet")]
pub use parquet::Parquet;
pub use recorder_group::RecorderGroup;
pub use run_error::RunError;
pub use samples::Samples;
pub use statistics::{Statistics, Verdict};

use sha2::{Digest, Sha256};

use crate::scenario::Scenario;

/// Receives the samples of one run.
pub trait Recorder {
    /// Called once, before the first sample.
    ///
    /// # Errors
    ///
    /// Of the recorder: a file that cannot be made. The run then does not start.
    fn begin(&mut self, header: &Header) -> Result<(), RecordError>;

    /// One sample, a number for each column, the time first.
    ///
    /// # Errors
    ///
    /// Of the recorder: a disk that is full. The run then ends, and the recorder is not finished.
    fn sample(&mut self, row: &[f64]) -> Result<(), RecordError>;

    /// Called once, after the last sample.
    ///
    /// # Errors
    ///
    /// Of the recorder.
    fn finish(&mut self, outcome: &Outcome) -> Result<(), RecordError>;
}

/// What a recorder receives before the first sample.
#[derive(Clone, Debug, PartialEq)]
pub struct Header {
    /// The scenario's name.
    pub name: String,
    /// Its title.
    pub title: String,
    /// Version of the program.
    pub version: &'static str,
    /// The columns in order, `time` first.
    pub columns: Vec<Column>,
    /// The text of the scenario with every default; empty for one that a program built.
    pub scenario: String,
    /// SHA-256 of the text that it was read from, hexadecimal; none where there is no text.
    pub sha256: Option<String>,
    /// Samples per second, 1/s.
    pub rate: f64,
    /// Length of the run, s, if it goes to its end.
    pub duration: f64,
}

impl Header {
    /// The header of a scenario's run with these columns.
    #[must_use]
    pub fn new(scenario: &Scenario, columns: &Columns) -> Self {
        let source = &scenario.source;
        Self {
            name: scenario.name.clone(),
            title: scenario.title.clone(),
            version: env!("CARGO_PKG_VERSION"),
            columns: columns.as_slice().to_vec(),
            scenario: if source.filled.is_empty() { &source.text } else { &source.filled }.clone(),
            sha256: (!source.text.is_empty()).then(|| sha256(&source.text)),
            rate: scenario.output.rate,
            duration: scenario.settings.duration,
        }
    }

    /// The index of a column by its name.
    #[must_use]
    pub fn index(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|column| column.name == name)
    }

    /// The indices of a quantity's columns: one by its name, or the three of a vector.
    ///
    /// # Errors
    ///
    /// [`RecordError::UnknownColumn`] with the nearest names.
    pub fn quantity(&self, name: &str) -> Result<Vec<usize>, RecordError> {
        columns::quantity(&self.columns, name)
    }
}

/// The digest of a text, hexadecimal.
pub(crate) fn sha256(text: &str) -> String {
    Sha256::digest(text.as_bytes()).iter().fold(String::new(), |mut digits, byte| {
        digits.extend(
            [byte >> 4, byte & 15]
                .map(|digit| char::from_digit(u32::from(digit), 16).unwrap_or('0')),
        );
        digits
    })
}
