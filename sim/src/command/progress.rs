//! Progress and interrupts of what takes long. An interrupt is Ctrl-C or SIGTERM.
//!
//! | command | the first interrupt | the second |
//! |---|---|---|
//! | that runs a scenario, after [`watch_interrupts`] | ends the run, whose results say so | ends the program |
//! | that has its answer only at the end, after [`end_by_interrupts`] | ends the program, with a message; nothing is written | |

use std::io::{self, IsTerminal as _};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU8, AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use indicatif::{ProgressBar, ProgressStyle};

use super::error::CommandError;
use super::exit::INTERRUPTED;
#[cfg(unix)]
use super::exit::TERMINATED;
use super::terminal::{note, visible};
use crate::engine::run;
use crate::record::{Outcome, Recorder};
use crate::scenario::Scenario;

/// What an interrupt does.
struct Interrupts {
    /// Whether the first one ends the program.
    ends: bool,
    /// Whether something is written as a whole, which it does not end.
    writes: bool,
}

static STATE: Mutex<Interrupts> = Mutex::new(Interrupts { ends: false, writes: false });

/// The exit code of the last interrupt.
static CODE: AtomicU8 = AtomicU8::new(INTERRUPTED);
/// How often Ctrl-C was pressed, or SIGTERM was received.
static INTERRUPTS: AtomicUsize = AtomicUsize::new(0);

/// Runs a scenario up to a time, s, or an interrupt, with a progress bar, which a pipe does not get.
pub(super) fn with_progress(
    scenario: &Scenario,
    until: f64,
    recorder: &mut dyn Recorder,
) -> Result<Outcome, CommandError> {
    const PARTS: u16 = 1000;
    let bar = progress_bar(usize::from(PARTS), &scenario.name);
    let outcome = run(scenario, recorder, &mut |time| {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a share of a thousand"
        )]
        bar.set_position((time / until * f64::from(PARTS)) as u64);
        if interrupted() || time > until {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    bar.finish_and_clear();
    let name = scenario.name.clone();
    outcome.map_err(|source| CommandError::Run { name, source })
}

/// A bar of so many parts, silent where the output is no terminal.
pub(super) fn progress_bar(parts: usize, what: &str) -> ProgressBar {
    let bar = ProgressBar::new(u64::try_from(parts).unwrap_or(u64::MAX));
    if let Ok(style) =
        ProgressStyle::with_template("{msg:24} {wide_bar} {percent:>3} %, {eta} left")
    {
        bar.set_style(style);
    }
    bar.set_message(visible(what).into_owned());
    bar
}

/// Whether Ctrl-C was pressed, or SIGTERM was received.
pub(super) fn interrupted() -> bool {
    INTERRUPTS.load(Ordering::Relaxed) > 0
}

/// The first Ctrl-C or SIGTERM ends the run, the second the program.
pub(super) fn watch_interrupts() {
    // Where no handler can be set, either ends the program, and leaves `.partial` files.
    let _ = ctrlc::set_handler(|| interrupt(INTERRUPTED));
    #[cfg(unix)]
    if let Ok(mut signals) = signal_hook::iterator::Signals::new([signal_hook::consts::SIGTERM]) {
        std::thread::spawn(move || signals.forever().for_each(|_| interrupt(TERMINATED)));
    }
}

/// The first Ctrl-C or SIGTERM ends the program, with a message, but not while it [writes](uninterrupted): of a command without
/// runs, which has nothing to show before its end.
pub(super) fn end_by_interrupts() {
    state().ends = true;
    watch_interrupts();
}

/// Ends the program as [`end_by_interrupts`] has it where there was an interrupt while it [wrote](uninterrupted) what it did not keep.
pub(super) fn end_if_interrupted() {
    if interrupted() {
        end(CODE.load(Ordering::Relaxed));
    }
}

/// Does what is done as a whole, such as writing files: an interrupt meanwhile ends the program only if it is the second.
pub(super) fn uninterrupted<T>(work: impl FnOnce() -> T) -> T {
    writing(true, work)
}

/// Asks in the midst of what is [done as a whole](uninterrupted): an interrupt meanwhile is an answer.
pub(super) fn interruptible<T>(ask: impl FnOnce() -> T) -> T {
    writing(false, ask)
}

fn writing<T>(writes: bool, work: impl FnOnce() -> T) -> T {
    let before = std::mem::replace(&mut state().writes, writes);
    let done = work();
    state().writes = before;
    done
}

fn state() -> MutexGuard<'static, Interrupts> {
    STATE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Counts an interrupt; the second ends the program with a code, or the first, where nothing is written.
fn interrupt(code: u8) {
    // Kept until the program has ended: nothing begins to be written meanwhile.
    let state = state();
    CODE.store(code, Ordering::Relaxed);
    if state.ends && !state.writes {
        end(code);
    }
    if INTERRUPTS.fetch_add(1, Ordering::Relaxed) > 0 {
        std::process::exit(code.into());
    }
}

/// Ends the program with a code and a message.
fn end(code: u8) -> ! {
    // A progress bar is on the line.
    let line = if io::stderr().is_terminal() { "\n" } else { "" };
    note(&format!("{line}interrupted: nothing is written"));
    std::process::exit(code.into());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_as_a_whole_is_not_ended_but_for_a_question() {
        let writes = || state().writes;
        assert!(uninterrupted(|| writes()
            && !interruptible(writes)
            && uninterrupted(writes)
            && writes()));
        assert!(!writes());
    }
}
