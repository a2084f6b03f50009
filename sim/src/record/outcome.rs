//! [`Outcome`]: what a run returns beside its samples.

use super::run_error::RunError;

/// The end of a run, complete or not.
#[derive(Debug)]
pub struct Outcome {
    /// Simulated time at which it ended, s.
    pub end_time: f64,
    /// Why it ended.
    pub end: End,
    /// Its cost.
    pub steps: Steps,
    /// Samples recorded.
    pub samples: u64,
    /// Changes, stops and crossings in the order of time; the first ten thousand.
    pub events: Vec<Event>,
    /// How many more there were.
    pub events_omitted: u64,
    /// Largest magnitude of each joint's rate at the ends of steps, in the order of the set, rad/s
    /// or m/s.
    pub peak_rates: Vec<f64>,
    /// How far conserved quantities drifted.
    pub drift: Drift,
    /// Energy lost in brakes and locking end stops, J.
    pub energy_lost: f64,
}

/// How far conserved quantities are from the start, each in its own unit at the end of the run; none of what is not
/// conserved.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Drift {
    /// |energy + loss in brakes - work - initial energy|, unit: largest sum of the magnitudes of the
    /// terms of kinetic energy + integral of sum |u * rate|.
    pub energy: Option<f64>,
    /// |linear momentum - initial|, unit: largest sum of the magnitudes of its terms. None where
    /// gravity, a wrench or what holds the hub acts from outside.
    pub linear: Option<f64>,
    /// |angular momentum - initial| about the inertial origin, unit and condition as for the linear
    /// one.
    pub angular: Option<f64>,
}

/// Why a run ended.
#[derive(Debug)]
pub enum End {
    /// At its duration.
    Finished,
    /// At an end stop that ends the run.
    EndStop {
        /// The joint's coordinate: `panel.phi`.
        joint: String,
        /// The bound it reached.
        bound: f64,
        /// The bound's unit: rad or m.
        unit: &'static str,
    },
    /// At a crossing that ends the run.
    Crossing {
        /// Its name.
        name: String,
    },
    /// Cancelled: everything up to the end time is valid.
    Cancelled,
    /// At an error: everything up to the end time is valid.
    Failed(RunError),
}

/// What happened at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// Simulated time, s.
    pub time: f64,
    /// What: `panel.phi reaches its end stop at 1.5 rad; locked, 0.2 J lost`.
    pub text: String,
}

/// Counts of steps and evaluations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Steps {
    /// Steps accepted.
    pub accepted: u64,
    /// Steps rejected.
    pub rejected: u64,
    /// Evaluations of the equations of motion, those of samples included.
    pub evaluations: u64,
}

impl End {
    /// Whether the run reached its end as the scenario has it: its duration, or a stop or crossing
    /// that ends it.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        !matches!(self, Self::Cancelled | Self::Failed(_))
    }
}

impl std::fmt::Display for End {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Finished => f.write_str("finished"),
            Self::EndStop { joint, bound, unit } => {
                write!(f, "ended by the end stop of {joint} at {bound} {unit}")
            }
            Self::Crossing { name } => write!(f, "ended by the crossing `{name}`"),
            Self::Cancelled => f.write_str("cancelled"),
            Self::Failed(error) => write!(f, "failed: {error}"),
        }
    }
}
