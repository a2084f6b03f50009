//! The states that the processor computes, on every core: [`Solvers`] has the spacecraft of each, [`on_every_core`] shares the work.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

use precess_dynamics::{BuiltIn, Hub};

use crate::solver::Solver;
use crate::{Progress, StateError};

/// The solver of each state.
#[derive(Clone, Copy)]
pub(crate) struct Solvers<'a> {
    pub(crate) crafts: &'a [(Hub, Vec<BuiltIn>)],
    pub(crate) shared: Option<&'a Result<Solver, StateError>>,
}

impl Solvers<'_> {
    /// Does it with that of a state.
    pub(crate) fn with(
        self,
        index: usize,
        work: impl FnOnce(&Solver) -> Result<(), StateError>,
    ) -> Result<(), StateError> {
        match (self.shared, self.crafts.get(index)) {
            (Some(shared), _) => shared.as_ref().map_err(|error| *error).and_then(work),
            (None, Some((hub, devices))) => {
                work(&Solver::new(hub, devices).map_err(StateError::Parameters)?)
            }
            // As many states as spacecraft were checked.
            (None, None) => Ok(()),
        }
    }
}

/// The share of so many.
#[expect(clippy::cast_precision_loss, reason = "a share of states or steps, for people")]
pub(crate) fn share(done: usize, of: usize) -> f64 {
    if of == 0 { 1.0 } else { done as f64 / of as f64 }
}

/// Does jobs on all cores, the calling thread among them, which hears of progress; what they return, in no order.
pub(crate) fn on_every_core<J: Send, R: Send>(
    jobs: Vec<J>,
    progress: Progress<'_>,
    work: impl Fn(J, &(dyn Fn() -> bool + Sync)) -> R + Sync,
) -> Vec<R> {
    let total = jobs.len();
    let cores = if total > 1 { thread::available_parallelism().map_or(1, usize::from) } else { 1 };
    let stopped = AtomicBool::new(false);
    let go = || !stopped.load(Ordering::Relaxed);
    let (queue, found) = (Mutex::new(jobs.into_iter()), Mutex::new(Vec::with_capacity(total)));
    let next = || queue.lock().unwrap_or_else(PoisonError::into_inner).next();
    let one = |job: J| {
        let result = work(job, &go);
        let mut found = found.lock().unwrap_or_else(PoisonError::into_inner);
        found.push(result);
        found.len()
    };
    thread::scope(|scope| {
        for _ in 1..cores.min(total) {
            scope.spawn(|| {
                while let Some(job) = next().filter(|_| go()) {
                    one(job);
                }
            });
        }
        while let Some(job) = next().filter(|_| go()) {
            let done = one(job);
            if !progress(share(done, total)) {
                stopped.store(true, Ordering::Relaxed);
            }
        }
    });
    found.into_inner().unwrap_or_else(PoisonError::into_inner)
}
