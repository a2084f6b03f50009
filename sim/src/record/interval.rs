//! [`IntervalRecorder`]: only the samples of an interval.

use super::{Header, Outcome, RecordError, Recorder};

/// Passes the samples from one time to another, both included, to a recorder.
pub struct IntervalRecorder<'a> {
    interval: [f64; 2],
    recorder: &'a mut dyn Recorder,
}

impl<'a> IntervalRecorder<'a> {
    /// The samples of an interval, s.
    #[must_use]
    pub fn new(interval: [f64; 2], recorder: &'a mut dyn Recorder) -> Self {
        Self { interval, recorder }
    }
}

impl Recorder for IntervalRecorder<'_> {
    fn begin(&mut self, header: &Header) -> Result<(), RecordError> {
        self.recorder.begin(header)
    }

    fn sample(&mut self, row: &[f64]) -> Result<(), RecordError> {
        let [from, to] = self.interval;
        match row.first() {
            Some(time) if (from..=to).contains(time) => self.recorder.sample(row),
            _ => Ok(()),
        }
    }

    fn finish(&mut self, outcome: &Outcome) -> Result<(), RecordError> {
        self.recorder.finish(outcome)
    }
}
