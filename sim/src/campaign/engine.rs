//! [`execute`]: the samples of a plan that its journal does not have, on any number of threads, and on each
//! as many at a time as fill the lanes.

use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;

use super::journal::kept;
use super::{CampaignError, Journal, Plan, Reducer, Selection};
use crate::engine::{Gpu, RunQuantities, SIDE_BY_SIDE, run_side_by_side_on};
use crate::file::{Override, Template};
use crate::record::columns::Quantity;
use crate::record::{Columns, End, Outcome, Recorder, RunError};
use crate::scenario::Scenario;

/// A finished sample.
#[derive(Clone, Debug, PartialEq)]
pub struct SampleResult {
    /// Its number in the plan.
    pub sample: usize,
    /// Its numbers, or why it has none.
    pub result: Result<Vec<f64>, String>,
}

/// What is run.
#[derive(Debug)]
pub struct Execution<'a> {
    /// The scenario.
    pub template: &'a Template,
    /// Overrides of every sample, before its own.
    pub overrides: &'a [Override],
    /// The samples.
    pub plan: &'a Plan,
    /// What is recorded.
    pub selection: &'a Selection,
    /// Numbers of a row.
    pub fields: usize,
    /// Threads; the rows do not depend on them.
    pub threads: usize,
    /// What makes the steps of RK4; the rows do not depend on it.
    pub gpu: Option<&'a Gpu>,
}

/// The rows of a campaign.
#[derive(Clone, Debug, PartialEq)]
pub struct Finished {
    /// One for each sample, in order; none of those that were not run.
    pub rows: Vec<Option<SampleResult>>,
    /// How many the journal had.
    pub resumed: usize,
}

impl Finished {
    /// Whether every sample was run.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.rows.iter().all(Option::is_some)
    }
}

/// Runs the samples that are missing. `progress` is called with the number of samples that are done; once `cancelled`
/// returns true, samples in progress are given up, and those that are complete stay in the journal.
///
/// # Errors
/// A journal that cannot be written, a table that is too large. An error of a sample is in its row.
pub fn execute(
    execution: &Execution<'_>,
    opened: (Journal, Vec<SampleResult>),
    progress: &(dyn Fn(usize) + Sync),
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Result<Finished, CampaignError> {
    execution.plan.check_size(execution.fields)?;
    let (journal, known) = opened;
    let mut rows: Vec<Option<SampleResult>> = vec![None; execution.plan.samples.len()];
    for row in known {
        if let Some(place) = rows.get_mut(row.sample) {
            place.get_or_insert(row);
        }
    }
    let missing: Vec<usize> =
        rows.iter().enumerate().filter(|(_, row)| row.is_none()).map(|(index, _)| index).collect();
    let resumed = rows.len() - missing.len();
    progress(resumed);
    let shared = Mutex::new((journal, rows, None));
    let (next, done, failed) =
        (AtomicUsize::new(0), AtomicUsize::new(resumed), AtomicBool::new(false));
    let stopped = || failed.load(Ordering::Relaxed) || cancelled();
    // Fewer at a time where threads would have nothing to do.
    let threads = execution.threads.clamp(1, missing.len().max(1));
    #[cfg(feature = "cuda")]
    let most = if execution.gpu.is_some() { Gpu::SIDE_BY_SIDE } else { SIDE_BY_SIDE };
    #[cfg(not(feature = "cuda"))]
    let most = SIDE_BY_SIDE;
    let size = missing.len().div_ceil(threads).clamp(1, most);
    let groups: Vec<&[usize]> = missing.chunks(size).collect();
    let work = || {
        while let Some(&group) = groups.get(next.fetch_add(1, Ordering::Relaxed)) {
            if stopped() {
                return;
            }
            for (&sample, result) in group.iter().zip(run_samples(execution, group, &stopped)) {
                let Some(result) = result else { return };
                let row = SampleResult { sample, result };
                let Ok(mut shared) = shared.lock() else { return };
                let (journal, rows, error) = &mut *shared;
                if let Err(found) = journal.append(&row) {
                    error.get_or_insert(found);
                    failed.store(true, Ordering::Relaxed);
                    return;
                }
                if let Some(place) = rows.get_mut(sample) {
                    *place = Some(row);
                }
                progress(done.fetch_add(1, Ordering::Relaxed) + 1);
            }
        }
    };
    thread::scope(|scope| {
        for _ in 1..threads {
            scope.spawn(work);
        }
        work();
    });
    let (journal, rows, error) =
        shared.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    error.map_or(Ok(()), Err)?;
    journal.sync()?;
    Ok(Finished { rows, resumed })
}

/// Numbers of a run, or why there are none; none of both where it was cancelled.
type Reduced = Option<Result<Vec<f64>, String>>;

/// What became of each sample. A fault of the program in one sample is an error of that sample.
fn run_samples(
    execution: &Execution<'_>,
    samples: &[usize],
    cancelled: &dyn Fn() -> bool,
) -> Vec<Reduced> {
    let run = |samples: &[usize]| {
        catch_unwind(AssertUnwindSafe(|| reduced(execution, samples, cancelled))).ok()
    };
    let of_one = |sample: &usize| {
        let found = run(&[*sample]).and_then(|found| found.into_iter().next());
        found.unwrap_or_else(|| Some(Err("a fault of the program ended the run".to_owned())))
    };
    run(samples).unwrap_or_else(|| samples.iter().map(of_one).collect())
}

fn reduced(
    execution: &Execution<'_>,
    samples: &[usize],
    cancelled: &dyn Fn() -> bool,
) -> Vec<Reduced> {
    let mut sound = Vec::new();
    let mut errors = Vec::new();
    for sample in samples {
        let own = execution.plan.samples.get(*sample).map_or(&[][..], |of| &of.overrides);
        let overrides: Vec<Override> = execution.overrides.iter().chain(own).cloned().collect();
        match execution.template.scenario(&overrides) {
            Ok((scenario, _)) => {
                sound.push(scenario);
                errors.push(None);
            }
            // The rest of a diagnostic shows where in the text.
            Err(found) => errors.push(Some(first_message(&found))),
        }
    }
    let rows = run_reduced_on(execution.gpu, sound, execution.selection, cancelled);
    let mut rows = rows.into_iter();
    let of_sample = |error: Option<String>| match error {
        None => rows.next().flatten(),
        Some(message) => Some(Err(message)),
    };
    let found: Vec<Reduced> = errors.into_iter().map(of_sample).collect();
    found.into_iter().map(|of| of.map(|of| checked(of, execution.fields))).collect()
}

/// A row of as many numbers as those of other samples; an error in the length that is kept.
fn checked(result: Result<Vec<f64>, String>, fields: usize) -> Result<Vec<f64>, String> {
    let row = result.map_err(|text| kept(text.trim()).to_owned())?;
    if row.len() == fields {
        return Ok(row);
    }
    Err(format!(
        "{} numbers, where other samples have {fields}; vary no key that adds columns",
        row.len()
    ))
}

/// The numbers of each run, those of [`Selection::fields`], or why there are none. Only what is selected is recorded and
/// computed. As many as [`SIDE_BY_SIDE`] in one call take the least time.
#[must_use]
pub fn run_reduced(
    scenarios: Vec<Scenario>,
    selection: &Selection,
    cancelled: &dyn Fn() -> bool,
) -> Vec<Reduced> {
    run_reduced_on(None, scenarios, selection, cancelled)
}

/// The same, with the steps of RK4 on a GPU: as many as it takes at a time.
#[must_use]
pub fn run_reduced_on(
    gpu: Option<&Gpu>,
    mut scenarios: Vec<Scenario>,
    selection: &Selection,
    cancelled: &dyn Fn() -> bool,
) -> Vec<Reduced> {
    for scenario in &mut scenarios {
        scenario.output.columns.clone_from(&selection.columns);
    }
    let mut reducers: Vec<Reducer<'_>> =
        scenarios.iter().map(|scenario| Reducer::new(scenario, selection)).collect();
    let recorders = reducers.iter_mut().map(|reducer| reducer as &mut dyn Recorder);
    let runs = scenarios.iter().zip(recorders).collect();
    let keep =
        if scenarios.iter().any(shows_work) { RunQuantities::All } else { RunQuantities::Motion };
    let outcomes = run_side_by_side_on(gpu, runs, keep, &mut || {
        if cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    let row_of = |(outcome, reducer): (Result<Outcome, RunError>, Reducer<'_>)| match outcome {
        Err(error) => Some(Err(error.to_string())),
        Ok(Outcome { end: End::Cancelled, .. }) => None,
        Ok(Outcome { end: End::Failed(error), end_time, .. }) => {
            Some(Err(format!("failed at {end_time} s: {error}")))
        }
        Ok(_) => Some(Ok(reducer.row().unwrap_or_default())),
    };
    outcomes.into_iter().zip(reducers).map(row_of).collect()
}

/// Whether a column is the work, which is not computed otherwise.
pub(crate) fn shows_work(scenario: &Scenario) -> bool {
    Columns::from_scenario(scenario).is_ok_and(|columns| {
        columns.as_slice().iter().any(|column| column.quantity == Quantity::Work)
    })
}

fn first_message(errors: &crate::file::Diagnostics) -> String {
    let first = errors.all.iter().find(|of| of.severity == crate::file::Severity::Error);
    first.map_or_else(|| errors.to_string(), |of| of.message.clone())
}
