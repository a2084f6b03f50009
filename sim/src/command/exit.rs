//! [`Exit`]: what a command ends with, and its exit code. One table for all commands.

use std::process::ExitCode;

use crate::pointing::RequirementState;

/// The code of a program that Ctrl-C ended.
pub(super) const INTERRUPTED: u8 = 130;
/// The code of a program that SIGTERM ended.
#[cfg(unix)]
pub(super) const TERMINATED: u8 = 143;

/// The codes of every command, as its help and `docs/commands.md` have them.
pub(super) const TABLE: &str = "\
Exit codes:
  0    complete; every requirement that there is was evaluated and is met
  1    an error: nothing was computed, or what was could not be written
  2    a requirement is violated, results differ, a fitted model does not hold, an alarm was raised, or a run ended
       before its time
  3    a requirement could not be evaluated, and none is violated
  64   the command line is wrong
  130  ended by Ctrl-C, 143 by SIGTERM: of a run by the second, where the first ends it early, with results that say so;
       of jitter, fit and identify by the first, and nothing is written";

/// How a command ended. The order is that of weight: of several files the heaviest counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Exit {
    /// Complete; every requirement that there is was evaluated and is met.
    Success,
    /// A requirement could not be evaluated: nothing was measured. None is violated.
    NotEvaluated,
    /// A requirement is violated, results differ, a fitted model does not hold, an alarm was raised, or a run ended before
    /// its time.
    Violated,
    /// An error: nothing was computed, or what was could not be written.
    Error,
    /// The command line is wrong.
    Usage,
}

impl Exit {
    /// Of requirements: the heaviest counts.
    pub(super) fn of_states<'a>(states: impl IntoIterator<Item = &'a RequirementState>) -> Self {
        let of = |state: &RequirementState| match state {
            RequirementState::Met => Self::Success,
            RequirementState::Violated => Self::Violated,
            RequirementState::NotEvaluated(_) => Self::NotEvaluated,
        };
        states.into_iter().map(of).max().unwrap_or(Self::Success)
    }

    /// The code: that of `sysexits.h` for usage.
    pub(super) const fn code(self) -> u8 {
        match self {
            Self::Success => 0,
            Self::Error => 1,
            Self::Violated => 2,
            Self::NotEvaluated => 3,
            Self::Usage => 64,
        }
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit.code())
    }
}
