//! [`RecorderGroup`]: several recorders of one run.

use super::{Header, Outcome, RecordError, Recorder};

/// Passes everything to each recorder in order; the first error ends it.
#[derive(Default)]
pub struct RecorderGroup<'a> {
    recorders: Vec<&'a mut dyn Recorder>,
}

impl<'a> RecorderGroup<'a> {
    /// Recorders in order.
    #[must_use]
    pub fn new(recorders: Vec<&'a mut dyn Recorder>) -> Self {
        Self { recorders }
    }

    /// Adds a recorder.
    pub fn push(&mut self, recorder: &'a mut dyn Recorder) {
        self.recorders.push(recorder);
    }
}

impl Recorder for RecorderGroup<'_> {
    fn begin(&mut self, header: &Header) -> Result<(), RecordError> {
        self.recorders.iter_mut().try_for_each(|recorder| recorder.begin(header))
    }

    fn sample(&mut self, row: &[f64]) -> Result<(), RecordError> {
        self.recorders.iter_mut().try_for_each(|recorder| recorder.sample(row))
    }

    fn finish(&mut self, outcome: &Outcome) -> Result<(), RecordError> {
        self.recorders.iter_mut().try_for_each(|recorder| recorder.finish(outcome))
    }
}
