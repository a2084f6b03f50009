//! Progress and interrupts of what takes long.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use indicatif::{ProgressBar, ProgressStyle};

use super::error::CommandError;
use super::exit::INTERRUPTED;
#[cfg(unix)]
use super::exit::TERMINATED;
use super::terminal::visible;
use crate::engine::run;
use crate::record::{Outcome, Recorder};
use crate::scenario::Scenario;

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

/// Counts an interrupt; the second ends the program with a code.
fn interrupt(code: u8) {
    if INTERRUPTS.fetch_add(1, Ordering::Relaxed) > 0 {
        std::process::exit(code.into());
    }
}
