//! What a call of a batch checks, and its parts: whole groups of lanes, one part after another or on
//! several threads.
//!
//! A state has the same result in every part: which states share lanes changes no number.

use std::vec::Vec;

use super::batch::{Batch, BatchAccelerations};
use super::batch_inputs::BatchInputs;
use super::laned_set::LanedSet;
use super::observers::Observers;
use super::part::{Part, Parts, See, Steps};
use crate::equations::error::{Quantity, SolveError};
use crate::numbers::laned::WIDEST;
use crate::solve::state::State;

/// The most states of a part: their accelerations fit into the cache.
const PART: usize = 1024;

/// What became of each run.
pub(super) type Ends = Vec<Result<(), SolveError<f64>>>;

/// All accelerations of each state, once the numbers of spacecraft, states and inputs agree.
pub(super) fn accelerations<D: LanedSet>(
    batch: &Batch<D>,
    states: &[State<D>],
    inputs: &BatchInputs<'_, D>,
    out: &mut BatchAccelerations<D>,
) -> Result<(), SolveError<f64>> {
    let crafts = &*batch.crafts;
    fit(crafts, states, inputs)?;
    out.clear();
    let Some(craft) = crafts.spacecraft().first() else { return Ok(()) };
    // Filled in place: what was just put together number by number is slow to move.
    let still = Ok(craft.no_accelerations());
    let evaluate = |start, states, out: &mut [Result<_, _>]| {
        crafts.accelerations(Part { start, states, out }, inputs.starting(start));
    };
    // Shorter parts would take longer to hand over than to evaluate.
    #[cfg(feature = "threads")]
    if batch.on_threads && states.len() > PART {
        use rayon::prelude::*;
        out.par_extend(rayon::iter::repeat_n(still, states.len()));
        let parts = states.par_chunks(PART).zip(out.par_chunks_mut(PART)).enumerate();
        parts.for_each(|(k, (states, out))| evaluate(k * PART, states, out));
        return Ok(());
    }
    out.reserve(states.len());
    for states in states.chunks(PART) {
        let start = out.len();
        out.resize(start + states.len(), still.clone());
        if let Some(out) = out.get_mut(start..) {
            evaluate(start, states, out);
        }
    }
    Ok(())
}

/// Each state advanced by so many steps and observed on the way, once the numbers of spacecraft,
/// states, inputs and records agree.
pub(super) fn run<D: LanedSet, R: Send, F: Fn(&mut R, usize, &State<D>) + Sync>(
    batch: &Batch<D>,
    states: &mut [State<D>],
    inputs: &BatchInputs<'_, D>,
    (dt, steps): (f64, usize),
    observers: Option<Observers<'_, R, F>>,
    out: &mut Ends,
) -> Result<(), SolveError<f64>> {
    let crafts = &*batch.crafts;
    fit(crafts, states, inputs)?;
    let count = states.len();
    if let Some(Observers { records, .. }) = &observers
        && records.len() != count
    {
        return Err(SolveError::Count { expected: count, found: records.len() });
    }
    if !dt.is_finite() {
        return Err(SolveError::NotFinite { what: Quantity::TimeStep, value: dt });
    }
    out.clear();
    out.resize(count, Ok(()));
    #[cfg(feature = "threads")]
    let size = if batch.on_threads { part(count) } else { PART };
    #[cfg(not(feature = "threads"))]
    let size = PART;
    let (records, observe) = match observers {
        Some(Observers { every, records, observe }) => (Some(records), Some((every, observe))),
        None => (None, None),
    };
    let mut records = records.map(|records| records.chunks_mut(size));
    let states = states.chunks_mut(size).zip(out.chunks_mut(size)).enumerate();
    let parts = states.map(|(k, (states, out))| {
        let records = records.as_mut().and_then(Iterator::next);
        (Part { start: k * size, states, out }, records.unwrap_or_default())
    });
    let parts: Vec<_> = parts.collect();
    let run = |(part, records): (Part<'_, &mut [State<D>], ()>, &mut [R])| {
        let mut see = |state: usize, steps: usize, now: &State<D>| {
            if let (Some(record), Some((_, observe))) = (records.get_mut(state), &observe) {
                observe(record, steps, now);
            }
        };
        let inputs = inputs.starting(part.start);
        let every = observe.as_ref().map(|(every, _)| *every);
        let see: &mut See<'_, D> = &mut see;
        crafts.run(part, inputs, Steps { dt, count: steps, every }, see);
    };
    #[cfg(feature = "threads")]
    if batch.on_threads {
        use rayon::prelude::*;
        parts.into_par_iter().for_each(run);
        return Ok(());
    }
    parts.into_iter().for_each(run);
    Ok(())
}

/// How many states a part of runs has: several parts for each thread, since one may take longer than
/// another.
#[cfg(feature = "threads")]
fn part(states: usize) -> usize {
    let parts = 4 * rayon::current_num_threads();
    states.div_ceil(parts).next_multiple_of(WIDEST).clamp(WIDEST, PART)
}

/// Whether there are as many states as spacecraft, and as many inputs as states.
fn fit<D: LanedSet>(
    crafts: &dyn Parts<D>,
    states: &[State<D>],
    inputs: &BatchInputs<'_, D>,
) -> Result<(), SolveError<f64>> {
    let found = states.len();
    match crafts.count() {
        Some(expected) if expected != found => Err(SolveError::Count { expected, found }),
        _ => inputs.fit(found),
    }
}

// Parts begin where groups of lanes do, however wide these are.
const _: () = assert!(PART.is_multiple_of(WIDEST));
