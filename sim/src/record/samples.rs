//! [`Samples`]: all samples of a run, in memory.

use super::{Header, Outcome, RecordError, Recorder};

/// Keeps every sample. Memory grows with the run: 8 bytes a number.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Samples {
    /// The columns and what else is known before the first sample; none before a run.
    pub header: Option<Header>,
    /// A number for each column, the time first, sample by sample.
    pub rows: Vec<Vec<f64>>,
    /// Whether the run has come to its outcome.
    pub finished: bool,
}

impl Samples {
    /// The history of a column; none of a name that no column has.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let index = self.header.as_ref()?.index(name)?;
        self.rows.iter().map(|row| row.get(index).copied()).collect()
    }
}

impl Recorder for Samples {
    fn begin(&mut self, header: &Header) -> Result<(), RecordError> {
        *self = Self { header: Some(header.clone()), ..Self::default() };
        Ok(())
    }

    fn sample(&mut self, row: &[f64]) -> Result<(), RecordError> {
        self.rows.push(row.to_vec());
        Ok(())
    }

    fn finish(&mut self, _: &Outcome) -> Result<(), RecordError> {
        self.finished = true;
        Ok(())
    }
}
