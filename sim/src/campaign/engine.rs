//! [`execute`]: the samples of a plan that its journal does not have, on any number of threads.

use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;

use super::journal::kept;
use super::{CampaignError, Journal, Plan, Reducer, Selection};
use crate::engine::{End, run};
use crate::file::{Override, Template};
use crate::scenario::Scenario;

/// A finished sample.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
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
}

/// The rows of a campaign.
#[derive(Clone, Debug, PartialEq)]
pub struct Finished {
    /// One for each sample, in order; none of those that were not run.
    pub rows: Vec<Option<Row>>,
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
    opened: (Journal, Vec<Row>),
    progress: &(dyn Fn(usize) + Sync),
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Result<Finished, CampaignError> {
    execution.plan.check_size(execution.fields)?;
    let (journal, known) = opened;
    let mut rows: Vec<Option<Row>> = vec![None; execution.plan.samples.len()];
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
    let work = || {
        while let Some(&sample) = missing.get(next.fetch_add(1, Ordering::Relaxed)) {
            if stopped() {
                return;
            }
            let Some(result) = run_sample(execution, sample, &stopped) else { return };
            let row = Row { sample, result };
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
    };
    let threads = execution.threads.clamp(1, missing.len().max(1));
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

/// A sample's numbers, or its error; none where it was cancelled. A fault of the program in one sample is an error of that
/// sample.
fn run_sample(
    execution: &Execution<'_>,
    sample: usize,
    cancelled: &dyn Fn() -> bool,
) -> Option<Result<Vec<f64>, String>> {
    let found = catch_unwind(AssertUnwindSafe(|| reduced(execution, sample, cancelled)));
    match found {
        Ok(result) => result.map(|result| result.map_err(|text| kept(text.trim()).to_owned())),
        Err(_) => Some(Err("a fault of the program ended the run".to_owned())),
    }
}

fn reduced(
    execution: &Execution<'_>,
    sample: usize,
    cancelled: &dyn Fn() -> bool,
) -> Option<Result<Vec<f64>, String>> {
    let own = execution.plan.samples.get(sample).map_or(&[][..], |sample| &sample.overrides);
    let overrides: Vec<Override> = execution.overrides.iter().chain(own).cloned().collect();
    let scenario = match execution.template.scenario(&overrides) {
        Ok((scenario, _)) => scenario,
        // The rest of a diagnostic shows where in the text.
        Err(errors) => return Some(Err(first_message(&errors))),
    };
    let row = match run_reduced(scenario, execution.selection, cancelled)? {
        Ok(row) => row,
        Err(message) => return Some(Err(message)),
    };
    if row.len() != execution.fields {
        return Some(Err(format!(
            "{} numbers, where other samples have {}; vary no key that adds columns",
            row.len(),
            execution.fields
        )));
    }
    Some(Ok(row))
}

/// The numbers of one run, those of [`Selection::fields`], or why there are none; none of both where it was cancelled. Only what
/// is selected is recorded.
#[must_use]
pub fn run_reduced(
    mut scenario: Scenario,
    selection: &Selection,
    cancelled: &dyn Fn() -> bool,
) -> Option<Result<Vec<f64>, String>> {
    scenario.output.columns.clone_from(&selection.columns);
    let mut reducer = Reducer::new(&scenario, selection);
    let outcome = run(&scenario, &mut reducer, &mut |_| {
        if cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    let outcome = match outcome {
        Ok(outcome) => outcome,
        Err(error) => return Some(Err(error.to_string())),
    };
    match outcome.end {
        End::Cancelled => return None,
        End::Failed(error) => {
            return Some(Err(format!("failed at {} s: {error}", outcome.end_time)));
        }
        End::Finished | End::EndStop { .. } | End::Crossing { .. } => {}
    }
    Some(Ok(reducer.row().unwrap_or_default()))
}

fn first_message(errors: &crate::file::Diagnostics) -> String {
    let first = errors.all.iter().find(|of| of.severity == crate::file::Severity::Error);
    first.map_or_else(|| errors.to_string(), |of| of.message.clone())
}
