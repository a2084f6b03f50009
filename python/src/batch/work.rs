//! [`share`]: parts of a batch on threads, of which the calling thread is one. Between parts, and within
//! long ones, that thread checks signals and calls `progress` ([`watched`]). One thread starts no other.

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

/// Whether work may go on.
type ContinueCheck<'a> = &'a (dyn Fn() -> bool + Sync);
/// Whether work may go on, by the thread that called, which passes the share that is done.
pub(crate) type ProgressCheck<'a> = &'a (dyn Fn(f64) -> bool + Sync);

/// Does work without the interpreter's lock. An exception of a signal or of `progress` ends it early.
pub(super) fn watched<R: Send>(
    py: Python<'_>,
    progress: Progress,
    work: impl FnOnce(ProgressCheck<'_>) -> R + Send,
) -> PyResult<R> {
    // Only the calling thread locks it, so it may hold it while Python is called.
    let watch = Mutex::new((Instant::now(), None));
    let look = |share: f64| {
        let mut watch = watch.lock().unwrap_or_else(PoisonError::into_inner);
        let (last, raised) = &mut *watch;
        if raised.is_none() && last.elapsed() >= PERIOD {
            *last = Instant::now();
            *raised = Python::attach(|py| progress.tell(py, share)).err();
        }
        raised.is_none()
    };
    let found = py.detach(|| work(&look));
    match watch.into_inner().unwrap_or_else(PoisonError::into_inner) {
        (_, Some(error)) => Err(error),
        (_, None) => Ok(found),
    }
}

/// Does the work of each job on so many threads, the calling one among them, all cores where that is
/// zero; what the jobs return, joined in no order.
pub(super) fn share<J: Send, R: Send>(
    threads: usize,
    look: ProgressCheck<'_>,
    jobs: Vec<J>,
    work: impl Fn(J, ContinueCheck<'_>) -> Vec<R> + Sync,
) -> Vec<R> {
    let total = jobs.len();
    // Reads files of the system: only where it matters.
    let all = || std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let threads = if threads == 0 && total > 1 { all() } else { threads }.min(total);
    let (stop, done) = (AtomicBool::new(false), AtomicUsize::new(0));
    let queue = Mutex::new(jobs.into_iter());
    let next = || queue.lock().unwrap_or_else(PoisonError::into_inner).next();
    let each_job = |go: ContinueCheck<'_>, found: &mut dyn FnMut(Vec<R>)| {
        while go() {
            let Some(job) = next() else { return };
            found(work(job, go));
            done.fetch_add(1, Ordering::Relaxed);
        }
    };
    let go = || !stop.load(Ordering::Relaxed);
    // Of the calling thread.
    let go_and_look = || {
        if go() && !look(share_of(done.load(Ordering::Relaxed), total.max(1))) {
            stop.store(true, Ordering::Relaxed);
        }
        go()
    };
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
}

/// The share of jobs that are done.
fn share_of(done: usize, total: usize) -> f64 {
    let count = |of| f64::from(u32::try_from(of).unwrap_or(u32::MAX));
    count(done) / count(total)
}
