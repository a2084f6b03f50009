//! What can go wrong, with where, what, the bound and the remedy.

use std::fmt;
use std::io;
use std::path::PathBuf;

use precess_dynamics::{ParameterError, SolveError};

use crate::bound::BoundError;
use crate::output::report::ReportError;

/// A run that could not be started or finished.
#[derive(Debug)]
pub enum RunError {
    /// The length of the run, s.
    Duration {
        /// The value of the option.
        value: f64,
        /// Shortest.
        lowest: f64,
        /// Longest.
        highest: f64,
    },
    /// The relative tolerance of a step.
    Tolerance {
        /// The value of the option.
        value: f64,
        /// Smallest that can be met.
        lowest: f64,
        /// Largest that still resolves a turn of the wheel.
        highest: f64,
    },
    /// The sampling rate, 1/s.
    Rate {
        /// The value of the option.
        value: f64,
        /// Two samples in the run.
        lowest: f64,
        /// As many samples as are kept.
        highest: f64,
    },
    /// The solver does not accept the spacecraft.
    Parameters(ParameterError),
    /// The solver cannot solve a state of the run.
    Solve {
        /// Simulated time, s.
        time: f64,
        /// What the solver says.
        source: SolveError,
    },
    /// More steps than a run of this length should need.
    TooManySteps {
        /// Simulated time reached, s.
        time: f64,
    },
    /// The step fell below what the clock resolves.
    StepTooSmall {
        /// Simulated time reached, s.
        time: f64,
    },
    /// The motion is too stiff for an explicit method.
    Stiff {
        /// Simulated time reached, s.
        time: f64,
    },
    /// The integrator reports what no run of this program should cause.
    Integrator {
        /// Simulated time, s.
        time: f64,
        /// What it reports.
        fault: Fault,
    },
}

/// A report of the integrator that is a fault of this program.
#[derive(Clone, Debug, PartialEq)]
pub enum Fault {
    /// It rejects the span or the first step; the reason is known in its own words only.
    Input {
        /// Its words.
        reason: String,
    },
    /// The interpolant was evaluated outside the last step.
    Interpolation {
        /// The time of the state, s.
        time: f64,
        /// Start of the last step, s.
        from: f64,
        /// End of the last step, s.
        to: f64,
    },
    /// It takes the equations for ones with a delay.
    Delay,
    /// It solved linear equations and failed; the reason is known in its own words only.
    LinearAlgebra {
        /// Its words.
        reason: String,
    },
}

impl fmt::Display for RunError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Duration { value, lowest, highest } => write!(
                f,
                "duration {value} s is outside {lowest} s to {highest} s; the default is 10"
            ),
            Self::Tolerance { value, lowest, highest } => write!(
                f,
                "tolerance {value:e} is outside {lowest:e} to {highest:e}; the default is 1e-13"
            ),
            Self::Rate { value, lowest, highest } => write!(
                f,
                "rate {value} samples/s is outside {lowest} to {highest} for this duration; give \
                 one in between"
            ),
            Self::Parameters(error) => write!(f, "spacecraft rejected: {error}"),
            Self::Solve { time, source } => write!(f, "at t = {time} s: {source}"),
            Self::TooManySteps { time } => write!(
                f,
                "the integrator used up its steps at t = {time} s; loosen the tolerance or \
                 shorten the duration"
            ),
            Self::StepTooSmall { time } => write!(
                f,
                "the integrator's step fell below rounding at t = {time} s; loosen the tolerance"
            ),
            Self::Stiff { time } => write!(
                f,
                "the motion turns stiff at t = {time} s, too fast for an explicit method; check \
                 torques and inertias"
            ),
            Self::Integrator { time, fault } => write!(
                f,
                "the integrator stopped at t = {time} s: {fault}; this is a fault of the program"
            ),
        }
    }
}

impl std::error::Error for RunError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Parameters(source) => Some(source),
            Self::Solve { source, .. } => Some(source),
            _ => None,
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Input { reason } => write!(f, "its input is rejected ({reason})"),
            Self::Interpolation { time, from, to } => {
                write!(f, "a state at {time} s, outside its last step, {from} s to {to} s")
            }
            Self::Delay => f.write_str("equations without a delay are taken for ones with one"),
            Self::LinearAlgebra { reason } => write!(f, "linear equations failed ({reason})"),
        }
    }
}

/// Results that could not be written.
#[derive(Debug)]
pub enum WriteError {
    /// A file of that name is there and no earlier run wrote it.
    Foreign {
        /// The file.
        path: PathBuf,
    },
    /// The operating system returned an error.
    Io {
        /// The file or folder.
        path: PathBuf,
        /// Its reason.
        source: io::Error,
    },
}

impl fmt::Display for WriteError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Foreign { path } => write!(
                f,
                "{} exists and no earlier run wrote it; move it away or choose another folder \
                 with --out",
                path.display()
            ),
            Self::Io { path, source } => write!(
                f,
                "cannot write {}: {source}; choose a folder you may write to with --out",
                path.display()
            ),
        }
    }
}

impl std::error::Error for WriteError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Foreign { .. } => None,
            Self::Io { source, .. } => Some(source),
        }
    }
}

/// What ended a command early, or made its results unfit for use.
#[derive(Debug)]
pub enum CliError {
    /// A setting is out of bounds.
    Settings(RunError),
    /// A variant could not be run.
    Run {
        /// The variant's name.
        scenario: String,
        /// Why.
        source: RunError,
    },
    /// Results could not be laid out.
    Report(ReportError),
    /// Results could not be written.
    Write(WriteError),
    /// Results were written, but what must not drift did.
    Bound(BoundError),
}

impl fmt::Display for CliError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Settings(error) => error.fmt(f),
            Self::Run { scenario, source } => write!(f, "{scenario}: {source}"),
            Self::Report(error) => error.fmt(f),
            Self::Write(error) => error.fmt(f),
            Self::Bound(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for CliError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Settings(source) | Self::Run { source, .. } => Some(source),
            Self::Report(source) => Some(source),
            Self::Write(source) => Some(source),
            Self::Bound(source) => Some(source),
        }
    }
}

impl From<ReportError> for CliError {
    fn from(error: ReportError) -> Self {
        Self::Report(error)
    }
}

impl From<WriteError> for CliError {
    fn from(error: WriteError) -> Self {
        Self::Write(error)
    }
}

impl From<BoundError> for CliError {
    fn from(error: BoundError) -> Self {
        Self::Bound(error)
    }
}

#[cfg(test)]
mod tests {
    use std::error::Error;

    use precess_dynamics::Spacecraft;

    use super::*;
    use crate::scenario::Set;

    #[test]
    fn a_cause_can_be_followed_to_the_solver() {
        let mut hub = crate::scenario::table1::variants(None, None)[0].scenario().hub;
        hub.m_b = -1.0;
        let rejected = Spacecraft::<Set<0>>::new(&hub, &[]).expect_err("a negative mass");
        let error =
            CliError::Run { scenario: "table1".into(), source: RunError::Parameters(rejected) };
        let run = error.source().expect("the run's error");
        let solver = run.source().expect("the solver's error");
        assert_eq!(error.to_string(), format!("table1: {run}"));
        assert_eq!(solver.downcast_ref(), Some(&rejected));
    }

    #[test]
    fn a_fault_of_the_integrator_tells_when_and_what() {
        let fault = Fault::Interpolation { time: 3.0, from: 1.0, to: 2.0 };
        assert_eq!(
            RunError::Integrator { time: 2.0, fault }.to_string(),
            "the integrator stopped at t = 2 s: a state at 3 s, outside its last step, 1 s to 2 s; \
             this is a fault of the program"
        );
    }
}
