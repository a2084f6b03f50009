//! [`Sampling`]: the samples of a run at an even rate, from its start, and one at its end.
//!
//! A sample within a step is the state on the solution of that step; at a time at which something
//! jumps it is the value after the jump, at the end of the run the one before.

use super::Run;
use crate::engine::integration::Moment;
use crate::engine::integration::dop853::same;
use crate::engine::quantities::sample_values::SampleValues;
use crate::record::columns::Columns;
use crate::record::{Header, Recorder, RunError};
use crate::scenario::Scenario;

/// The samples of a run.
pub(crate) struct Sampling {
    header: Header,
    row: SampleValues,
    rate: f64,
    /// Samples so far.
    count: u64,
    /// The time of the last one.
    last: Option<f64>,
    moment: Moment,
}

impl Sampling {
    pub(crate) fn new(scenario: &Scenario, run: &Run<'_>) -> Result<Self, RunError> {
        let columns = Columns::from_scenario(scenario)?;
        let header = Header::new(scenario, &columns);
        Ok(Self {
            header,
            row: SampleValues::new(scenario, columns),
            rate: scenario.output.rate,
            count: 0,
            last: None,
            moment: run.moment.clone(),
        })
    }

    pub(crate) fn header(&self) -> &Header {
        &self.header
    }

    pub(crate) fn count(&self) -> u64 {
        self.count
    }

    /// The time of the next sample, s.
    pub(crate) fn next(&self) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "fewer samples than 2^53")]
        let count = self.count as f64;
        count / self.rate
    }

    /// Records the samples from the start of the last step to before its end.
    pub(crate) fn step(
        &mut self,
        run: &mut Run<'_>,
        recorder: &mut dyn Recorder,
    ) -> Result<(), RunError> {
        loop {
            let time = self.next();
            // That of the end of a step belongs to the next one, whose inputs then act.
            if time >= run.time || same(time, run.time) {
                return Ok(());
            }
            run.stepper.at(&run.system, time, &mut self.moment)?;
            self.record(run, time, run.stepper.held_from(time), recorder)?;
        }
    }

    /// Records the sample at the end of the run.
    pub(crate) fn last(
        &mut self,
        run: &mut Run<'_>,
        recorder: &mut dyn Recorder,
    ) -> Result<(), RunError> {
        if self.last.is_some_and(|last| last >= run.time) {
            return Ok(());
        }
        self.moment.clone_from(&run.moment);
        self.record(run, run.time, run.time, recorder)
    }

    fn record(
        &mut self,
        run: &Run<'_>,
        time: f64,
        held_from: f64,
        recorder: &mut dyn Recorder,
    ) -> Result<(), RunError> {
        let turns = run.stepper.turns();
        let filled = self.row.fill(&run.system, [time, held_from], &self.moment, turns, run.lost);
        let row = filled.map_err(|source| RunError::solve(&run.system, time, source))?;
        recorder.sample(row)?;
        self.count += 1;
        self.last = Some(time);
        Ok(())
    }
}
