//! [`run`]: a run to its end into a recorder, and [`Recorded`], such a run step by step.

use std::ops::ControlFlow;

use super::sampling::Sampling;
use super::{Advance, HardwareChange, Run};
use crate::control::Controller;
use crate::engine::equations::run_quantities::RunQuantities;
use crate::record::{End, Outcome, Recorder, RunError};
use crate::scenario::Scenario;

/// A run whose samples go to a recorder.
pub(crate) struct Recorded<'a, 'r> {
    pub(crate) run: Run<'a>,
    sampling: Sampling,
    recorder: &'r mut dyn Recorder,
}

impl<'a, 'r> Recorded<'a, 'r> {
    /// Begins a run; no step is made.
    ///
    /// # Errors
    ///
    /// As [`Run::new`], and [`RunError::Record`] of the recorder.
    pub(crate) fn begin(
        scenario: &'a Scenario,
        quantities: RunQuantities,
        recorder: &'r mut dyn Recorder,
    ) -> Result<Self, RunError> {
        Self::begin_with(Run::with_quantities(scenario, quantities)?, recorder)
    }

    /// The same of a run that has made no step.
    ///
    /// # Errors
    ///
    /// [`RunError::Record`] of the recorder.
    fn begin_with(run: Run<'a>, recorder: &'r mut dyn Recorder) -> Result<Self, RunError> {
        let scenario = run.scenario;
        let sampling = Sampling::new(scenario, &run)?;
        recorder.begin(sampling.header())?;
        Ok(Self { run, sampling, recorder })
    }

    /// The time of the next sample, s.
    #[cfg(feature = "lanes")]
    pub(crate) fn next_sample(&self) -> f64 {
        self.sampling.next()
    }

    /// Makes a step and records the samples in it. Returns why the run ended, once it has.
    ///
    /// # Errors
    ///
    /// [`RunError::Record`] of the recorder; of the run itself in its end, [`End::Failed`].
    pub(crate) fn advance(&mut self) -> Result<Option<End>, RunError> {
        match self.run.advance() {
            Ok(Advance::Ended) => Ok(Some(self.run.end.take().unwrap_or(End::Finished))),
            Ok(Advance::Stepped) => self.record(),
            Err(error) => Ok(Some(End::Failed(error))),
        }
    }

    /// Records the samples in the last step.
    ///
    /// # Errors
    ///
    /// As [`Self::advance`].
    pub(crate) fn record(&mut self) -> Result<Option<End>, RunError> {
        match self.sampling.step(&mut self.run, self.recorder) {
            Ok(()) => Ok(None),
            Err(RunError::Record(error)) => Err(RunError::Record(error)),
            Err(error) => Ok(Some(End::Failed(error))),
        }
    }

    /// Records the last sample and completes the result.
    ///
    /// # Errors
    ///
    /// [`RunError::Record`] of the recorder, which then is not finished.
    pub(crate) fn finish(mut self, end: End) -> Result<Outcome, RunError> {
        let end = match self.sampling.last(&mut self.run, self.recorder) {
            Err(RunError::Record(error)) => return Err(RunError::Record(error)),
            Err(error) if end.is_complete() => End::Failed(error),
            Ok(()) | Err(_) => end,
        };
        let outcome = self.run.outcome(end, self.sampling.count());
        self.recorder.finish(&outcome)?;
        Ok(outcome)
    }
}

/// Runs a scenario into a recorder.
///
/// `progress` hears the simulated time after each step, s; if it breaks, the run is cancelled, and
/// its result is complete up to there. An error during the run ends it likewise:
/// [`End::Failed`].
///
/// # Errors
///
/// As [`Run::new`], and [`RunError::Record`] of the recorder, which then is not finished.
pub fn run(
    scenario: &Scenario,
    recorder: &mut dyn Recorder,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Outcome, RunError> {
    run_with_controllers(scenario, Vec::new(), recorder, progress)
}

/// As [`run`], with controllers in the place of the laws of the scenario's controllers of these names, as
/// [`Run::with_controllers`] has them.
///
/// # Errors
///
/// As [`run`]; [`RunError::NoController`] of a name that no controller has.
pub fn run_with_controllers(
    scenario: &Scenario,
    controllers: Vec<(String, Box<dyn Controller>)>,
    recorder: &mut dyn Recorder,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Outcome, RunError> {
    let run = Run::with_controllers(scenario, RunQuantities::All, controllers)?;
    let mut recorded = Recorded::begin_with(run, recorder)?;
    loop {
        if let Some(end) = recorded.advance()? {
            return recorded.finish(end);
        }
        if progress(recorded.run.time()).is_break() && recorded.run.end.is_none() {
            return recorded.finish(End::Cancelled);
        }
    }
}

/// As [`run_with_controllers`], of the motion only, with hardware that changes.
///
/// # Errors
///
/// As [`run_with_controllers`]; the scenario of the change, where its spacecraft cannot be built.
pub(crate) fn run_with_change(
    scenario: &Scenario,
    controllers: Vec<(String, Box<dyn Controller>)>,
    change: Option<&HardwareChange<'_>>,
    recorder: &mut dyn Recorder,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Outcome, RunError> {
    let run = Run::with_controllers(scenario, RunQuantities::Motion, controllers)?;
    let mut recorded = Recorded::begin_with(run, recorder)?;
    let mut waiting = change;
    loop {
        if let Some(change) = waiting.filter(|of| of.is_due(recorded.run.time())) {
            recorded.run.change_hardware(change)?;
            waiting = None;
        }
        if let Some(end) = recorded.advance()? {
            return recorded.finish(end);
        }
        if progress(recorded.run.time()).is_break() && recorded.run.end.is_none() {
            return recorded.finish(End::Cancelled);
        }
    }
}
