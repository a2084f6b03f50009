//! [`run_side_by_side`]: runs of scenarios that differ in numbers, several at a time in lanes.
//!
//! Each has the numbers that it has by itself, to the bit. With the feature `lanes` those of
//! RK4 make their steps together, as long as these are of one length; the others, and what lanes do not
//! support, go one after another.

use std::ops::ControlFlow;

use super::Gpu;
#[cfg(feature = "lanes")]
use super::lanes::Lanes;
use super::recorded::Recorded;
use crate::engine::equations::run_quantities::RunQuantities;
use crate::record::{End, Outcome, Recorder, RunError};
use crate::scenario::Scenario;

/// How many runs fill the lanes of AVX2; twice as many take as long each.
pub const SIDE_BY_SIDE: usize = if cfg!(feature = "lanes") { 4 } else { 1 };

/// Runs scenarios into recorders, one for each.
///
/// `progress` is called after some steps of each; if it breaks, what has not ended is cancelled, its
/// result complete up to there.
///
/// # Errors
///
/// In each run those of [`run`](super::run).
pub fn run_side_by_side(
    runs: Vec<(&Scenario, &mut dyn Recorder)>,
    quantities: RunQuantities,
    progress: &mut dyn FnMut() -> ControlFlow<()>,
) -> Vec<Result<Outcome, RunError>> {
    run_side_by_side_on(None, runs, quantities, progress)
}

/// The same, with the steps of RK4 on a GPU.
///
/// # Errors
///
/// In each run those of [`run`](super::run).
pub fn run_side_by_side_on(
    gpu: Option<&Gpu>,
    runs: Vec<(&Scenario, &mut dyn Recorder)>,
    quantities: RunQuantities,
    progress: &mut dyn FnMut() -> ControlFlow<()>,
) -> Vec<Result<Outcome, RunError>> {
    #[cfg(not(feature = "lanes"))]
    let _ = gpu;
    let runs: Vec<RunState<'_, '_>> = runs
        .into_iter()
        .map(|(scenario, recorder)| match Recorded::begin(scenario, quantities, recorder) {
            Ok(run) => RunState::Running(Box::new(run)),
            Err(error) => RunState::Ended(Box::new(Err(error))),
        })
        .collect();
    #[cfg(feature = "lanes")]
    let runs = in_lanes(gpu, runs, progress);
    let alone = |mut run: RunState<'_, '_>| {
        while run.running().is_some() && progress().is_continue() {
            run = run.step(Recorded::advance);
        }
        run.ended()
    };
    runs.into_iter().map(alone).collect()
}

/// The steps that lanes support.
#[cfg(feature = "lanes")]
fn in_lanes<'a, 'r>(
    gpu: Option<&Gpu>,
    mut runs: Vec<RunState<'a, 'r>>,
    progress: &mut dyn FnMut() -> ControlFlow<()>,
) -> Vec<RunState<'a, 'r>> {
    let lanes = Lanes::from_runs(gpu, runs.iter().map(RunState::running));
    let Some(mut lanes) = lanes else { return runs };
    while runs.iter().any(|run| run.running().is_some()) {
        let advanced = lanes.advance(runs.iter_mut().map(RunState::running_mut));
        let each = runs.into_iter().zip(advanced);
        runs = each.map(|(run, advanced)| run.after(advanced)).collect();
        if progress().is_break() {
            break;
        }
    }
    runs
}

/// A run, or what became of it.
enum RunState<'a, 'r> {
    Running(Box<Recorded<'a, 'r>>),
    Ended(Box<Result<Outcome, RunError>>),
}

impl<'a, 'r> RunState<'a, 'r> {
    fn running(&self) -> Option<&Recorded<'a, 'r>> {
        match self {
            Self::Running(run) => Some(run),
            Self::Ended(_) => None,
        }
    }

    #[cfg(feature = "lanes")]
    fn running_mut(&mut self) -> Option<&mut Recorded<'a, 'r>> {
        match self {
            Self::Running(run) => Some(run),
            Self::Ended(_) => None,
        }
    }

    /// Records what lanes have advanced; makes the step of a run that they have not.
    #[cfg(feature = "lanes")]
    fn after(self, advanced: Option<Result<(), RunError>>) -> Self {
        self.step(|run| match advanced {
            Some(Ok(())) => run.record(),
            Some(Err(error)) => Ok(Some(End::Failed(error))),
            None => run.advance(),
        })
    }

    /// Makes a step of a run, which may end it.
    fn step(
        self,
        step: impl FnOnce(&mut Recorded<'a, 'r>) -> Result<Option<End>, RunError>,
    ) -> Self {
        let Self::Running(mut run) = self else { return self };
        match step(&mut run) {
            Ok(None) => Self::Running(run),
            Ok(Some(end)) => Self::Ended(Box::new(run.finish(end))),
            Err(error) => Self::Ended(Box::new(Err(error))),
        }
    }

    /// What became of the run; of one that has not ended, that it was cancelled.
    fn ended(self) -> Result<Outcome, RunError> {
        match self {
            Self::Running(run) => run.finish(End::Cancelled),
            Self::Ended(result) => *result,
        }
    }
}
