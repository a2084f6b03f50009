//! [`share`]: parts of a batch on threads, while the calling one looks at signals and tells of progress.

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
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

/// Does the work of each job on so many threads, all cores where that is zero; what the jobs return,
/// joined in no order. An exception of a signal or of `progress` ends the work early.
pub(super) fn share<J: Send, R: Send>(
    py: Python<'_>,
    threads: usize,
    jobs: Vec<J>,
    work: impl Fn(J, &(dyn Fn() -> bool + Sync)) -> Vec<R> + Sync,
    progress: Progress,
) -> PyResult<Vec<R>> {
    let total = jobs.len();
    let all = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let threads = if threads == 0 { all } else { threads }.min(total);
    let queue = Mutex::new(jobs.into_iter());
    let stop = AtomicBool::new(false);
    let go = || !stop.load(Ordering::Relaxed);
    let joined = py.detach(|| {
        std::thread::scope(|scope| {
            let (sender, receiver) = channel();
            for _ in 0..threads {
                let (sender, queue, go, work) = (sender.clone(), &queue, &go, &work);
                scope.spawn(move || {
                    while go() {
                        let Ok(mut jobs) = queue.lock() else { return };
                        let Some(job) = jobs.next() else { return };
                        drop(jobs);
                        if sender.send(work(job, go)).is_err() {
                            return;
                        }
                    }
                });
            }
            drop(sender);
            let (mut found, mut done, mut last) = (Vec::new(), 0_u32, Instant::now());
            loop {
                match receiver.recv_timeout(PERIOD) {
                    Ok(more) => {
                        found.extend(more);
                        done += 1;
                    }
                    Err(RecvTimeoutError::Timeout) => {}
                    Err(RecvTimeoutError::Disconnected) => return Ok(found),
                }
                if last.elapsed() >= PERIOD {
                    last = Instant::now();
                    let share =
                        f64::from(done) / f64::from(u32::try_from(total).unwrap_or(u32::MAX));
                    if let Err(error) = Python::attach(|py| progress.tell(py, share)) {
                        stop.store(true, Ordering::Relaxed);
                        return Err(error);
                    }
                }
            }
        })
    })?;
    Ok(joined)
}
