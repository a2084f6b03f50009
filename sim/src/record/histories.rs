//! [`Histories`]: all samples of a run in memory, column by column.

use super::{Header, Outcome, RecordError, Recorder};

/// Keeps every sample, the history of a column in one piece. Memory grows with the run: 8 bytes a
/// number.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Histories {
    /// The columns and what else is known before the first sample; none before a run.
    pub header: Option<Header>,
    /// A history for each column, the time first.
    pub columns: Vec<Vec<f64>>,
}

/// Passes samples that are in memory, a history for each column, to a recorder, as the run that they
/// are of did.
///
/// # Errors
///
/// Of the recorder.
pub fn replay(
    header: &Header,
    columns: &[&[f64]],
    outcome: &Outcome,
    to: &mut dyn Recorder,
) -> Result<(), RecordError> {
    to.begin(header)?;
    let mut row = vec![0.0; columns.len()];
    let count = columns.iter().map(|column| column.len()).min().unwrap_or_default();
    for index in 0..count {
        for (number, column) in row.iter_mut().zip(columns) {
            *number = column.get(index).copied().unwrap_or(f64::NAN);
        }
        to.sample(&row)?;
    }
    to.finish(outcome)
}

impl Recorder for Histories {
    fn begin(&mut self, header: &Header) -> Result<(), RecordError> {
        let columns = vec![Vec::new(); header.columns.len()];
        *self = Self { header: Some(header.clone()), columns };
        Ok(())
    }

    fn sample(&mut self, row: &[f64]) -> Result<(), RecordError> {
        self.columns.iter_mut().zip(row).for_each(|(column, number)| column.push(*number));
        Ok(())
    }

    fn finish(&mut self, _: &Outcome) -> Result<(), RecordError> {
        Ok(())
    }
}
