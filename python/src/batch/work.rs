//! [`share`]: parts of a batch on threads. The calling one is one of them, and looks at signals and
//! tells of progress on its way: work on one thread starts none.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use pyo3::prelude::*;

/// Between looks at signals and calls of `progress`.
const PERIOD: Duration = Duration::from_millis(50);

/// Who hears of progress.
pub(super) struct Progress {
    callback: Option<Py<PyAny>>,
}

impl Progress {
    pub(super) fn new(callback: Option<Py<PyAny>>) -> Self {
        Self { callback }
    }

    /// Signals, and the share that is done, 0 to 1.
    fn tell(&self, py: Python<'_>, share: f64) -> PyResult<()> {
        py.check_signals()?;
        if let Some(callback) = &self.callback {
            callback.call1(py, (share,))?;
        }
        Ok(())
    }
}

/// Work may go on.
type Go<'a> = &'a (dyn Fn() -> bool + Sync);

/// Does the work of each job on so many threads, all cores where that is zero; what the jobs return,
/// joined in no order. An exception of a signal or of `progress` ends the work early.
pub(super) fn share<J: Send, R: Send>(
    py: Python<'_>,
    threads: usize,
    jobs: Vec<J>,
    work: impl Fn(J, Go<'_>) -> Vec<R> + Sync,
    progress: Progress,
) -> PyResult<Vec<R>> {
    let total = jobs.len();
    // Reads files of the system: not where the number is given.
    let all = || std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let threads = if threads == 0 { all() } else { threads }.min(total);
    let (stop, done) = (AtomicBool::new(false), AtomicUsize::new(0));
    let queue = Mutex::new(jobs.into_iter());
    let next = || queue.lock().unwrap_or_else(PoisonError::into_inner).next();
    let each_job = |go: Go<'_>, found: &mut dyn FnMut(Vec<R>)| {
        while go() {
            let Some(job) = next() else { return };
            found(work(job, go));
            done.fetch_add(1, Ordering::Relaxed);
        }
    };
    let go = || !stop.load(Ordering::Relaxed);
    let raised = Mutex::new(None);
    let last = Mutex::new(Instant::now());
    // Of the calling thread.
    let go_and_look = || {
        let mut last = last.lock().unwrap_or_else(PoisonError::into_inner);
        if go() && last.elapsed() >= PERIOD {
            *last = Instant::now();
            let share = share_of(done.load(Ordering::Relaxed), total);
            if let Err(error) = Python::attach(|py| progress.tell(py, share)) {
                stop.store(true, Ordering::Relaxed);
                *raised.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
            }
        }
        go()
    };
    let found = py.detach(|| {
        std::thread::scope(|scope| {
            let (sender, receiver) = channel();
            for _ in 1..threads {
                let (sender, go, each_job) = (sender.clone(), &go, &each_job);
                scope.spawn(move || {
                    // The receiver outlives the threads of the scope.
                    each_job(go, &mut |found| drop(sender.send(found)));
                });
            }
            drop(sender);
            let mut found = Vec::new();
            each_job(&go_and_look, &mut |more| found.extend(more));
            loop {
                match receiver.recv_timeout(PERIOD) {
                    Ok(more) => found.extend(more),
                    Err(RecvTimeoutError::Timeout) => {}
                    Err(RecvTimeoutError::Disconnected) => return found,
                }
                go_and_look();
            }
        })
    });
    match raised.into_inner().unwrap_or_else(PoisonError::into_inner) {
        Some(error) => Err(error),
        None => Ok(found),
    }
}

/// The share of jobs that are done.
fn share_of(done: usize, total: usize) -> f64 {
    let count = |of| f64::from(u32::try_from(of).unwrap_or(u32::MAX));
    count(done) / count(total)
}
