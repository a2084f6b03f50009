//! [`RunError`]: why a run could not be started, or what ended it early.

use std::fmt;

use precess_dynamics::{ModesError, ParameterError, SolveError};

use super::error::RecordError;
use super::fault::Fault;
use crate::control::ControllerError;
use crate::scenario::ScenarioError;
use crate::units::Plain;

/// A run that could not be started or finished.
#[derive(Debug)]
pub enum RunError {
    /// The scenario is rejected: everything that is wrong with it.
    Scenario(Vec<ScenarioError>),
    /// The solver rejects the spacecraft.
    Parameters(ParameterError),
    /// The modes of the structure are not valid.
    Modes(ModesError),
    /// The solver cannot solve a state of the run.
    Solve {
        /// Simulated time, s.
        time: f64,
        /// The name of the device that it is about, where there is one.
        device: Option<String>,
        /// The solver's error.
        source: SolveError,
    },
    /// The y turn of a platform is at 90 degrees, where the x turn is about the axis of the z turn:
    /// the equations of its turns are singular there.
    TurnAtRightAngle {
        /// Simulated time, s.
        time: f64,
        /// The platform.
        platform: String,
        /// The angle of its y turn, rad.
        angle: f64,
        /// The inertia that is left to the x turn, and the bound that it is not above, kg m².
        pivot: [f64; 2],
    },
    /// A joint is to be locked while it moves.
    LockedJointMoves {
        /// Simulated time, s.
        time: f64,
        /// Its coordinate: `wheel1.theta`.
        joint: String,
        /// Its rate.
        rate: f64,
        /// The rate's unit: rad/s or m/s.
        unit: &'static str,
    },
    /// A joint is beyond the largest rate of its motor, which has no largest torque to slow it with.
    BeyondLargestRate {
        /// Simulated time, s.
        time: f64,
        /// Its coordinate: `wheel1.theta`.
        joint: String,
        /// Its rate.
        rate: f64,
        /// The largest rate of its motor.
        limit: f64,
        /// The unit of both: rad/s or m/s.
        unit: &'static str,
    },
    /// A joint that its kind keeps at its rate is to be driven, locked or stopped.
    NotDriven {
        /// Simulated time, s.
        time: f64,
        /// Its coordinate.
        joint: String,
    },
    /// A joint starts beyond an end stop.
    BeyondStop {
        /// Its coordinate.
        joint: String,
        /// The coordinate's value.
        value: f64,
        /// Lowest and highest.
        stops: [f64; 2],
        /// The unit of all three: rad or m.
        unit: &'static str,
    },
    /// A crossing is of a column that is none of the state.
    Crossing {
        /// The name of the crossing.
        name: String,
        /// The column.
        column: String,
        /// The nearest names of columns of the state.
        nearest: Vec<String>,
    },
    /// Friction of a joint changes between sticking and sliding, or its motor comes to a limit and leaves it, again and
    /// again at one time.
    Undecided {
        /// Simulated time, s.
        time: f64,
        /// Its coordinate.
        joint: String,
        /// Whether it is the motor.
        motor: bool,
        /// How often it has changed there.
        changes: usize,
    },
    /// More steps than a run of this length should need.
    TooManySteps {
        /// Simulated time reached, s.
        time: f64,
        /// What varies fastest, and in which time, where it is known.
        fastest: Option<String>,
    },
    /// The step fell below what the clock resolves.
    StepTooSmall {
        /// Simulated time reached, s.
        time: f64,
        /// What varies fastest, and in which time, where it is known.
        fastest: Option<String>,
    },
    /// The motion is too stiff for an explicit method.
    Stiff {
        /// Simulated time reached, s.
        time: f64,
        /// What varies fastest, and in which time, where it is known.
        fastest: Option<String>,
    },
    /// A number of the state changes so fast that no step is short enough.
    TooFast {
        /// Simulated time, s.
        time: f64,
        /// The number: `position_x`.
        quantity: String,
        /// Its rate of change.
        rate: f64,
        /// The rate's unit.
        unit: String,
    },
    /// The integrator reports what no run of this program should cause.
    Integrator {
        /// Simulated time, s.
        time: f64,
        /// What it reports.
        fault: Fault,
    },
    /// A controller does not answer a sample, or its commands cannot be computed.
    Controller {
        /// Simulated time, s.
        time: f64,
        /// Its name.
        name: String,
        /// Why.
        source: ControllerError,
    },
    /// A program gives a controller of a name that the scenario does not have.
    NoController {
        /// The name.
        name: String,
    },
    /// A program that is coupled to the run gives another number of inputs, or one that is not finite.
    Inputs {
        /// How many the run takes.
        expected: usize,
        /// How many are given.
        found: usize,
    },
    /// The samples could not be recorded.
    Record(RecordError),
    /// An error of another process, which has passed on only its time and message.
    Elsewhere {
        /// Simulated time, s; none of an error before the start.
        time: Option<f64>,
        /// What that process says.
        message: String,
    },
}

impl RunError {
    /// The simulated time at which it happened, s; none of an error before the start.
    #[must_use]
    pub fn time(&self) -> Option<f64> {
        match self {
            Self::Solve { time, .. }
            | Self::TurnAtRightAngle { time, .. }
            | Self::LockedJointMoves { time, .. }
            | Self::BeyondLargestRate { time, .. }
            | Self::NotDriven { time, .. }
            | Self::Undecided { time, .. }
            | Self::TooManySteps { time, .. }
            | Self::StepTooSmall { time, .. }
            | Self::Stiff { time, .. }
            | Self::TooFast { time, .. }
            | Self::Controller { time, .. }
            | Self::Integrator { time, .. } => Some(*time),
            Self::Elsewhere { time, .. } => *time,
            Self::Scenario(_)
            | Self::Parameters(_)
            | Self::Modes(_)
            | Self::BeyondStop { .. }
            | Self::Crossing { .. }
            | Self::NoController { .. }
            | Self::Inputs { .. }
            | Self::Record(_) => None,
        }
    }
}

/// What varies fastest, and that it is to be slowed down.
fn slower(fastest: Option<&str>) -> String {
    fastest.map_or_else(
        || "; check what moves fast".to_owned(),
        |what| format!("; fastest is {what}: slow it down"),
    )
}

/// What changes without end at one time, friction or a motor, and the remedy.
fn undecided(motor: bool) -> (&'static str, &'static str) {
    if motor {
        (
            "motor",
            "between its limits, and the run does not go on; raise its `power_limit`, its largest rate or its \
             `torque_limit`",
        )
    } else {
        (
            "friction",
            "between sticking and sliding, and the run does not go on; lock the joint, or give it smoothed \
             friction: `coulomb` with `coulomb_rate`",
        )
    }
}

/// Writes an error of the solver, and the device that it is about.
fn solve(
    f: &mut fmt::Formatter<'_>,
    time: f64,
    device: Option<&str>,
    source: &SolveError,
) -> fmt::Result {
    let time = Plain(time);
    match device {
        Some(device) => write!(f, "at t = {time} s, `{device}`: {source}"),
        None => write!(f, "at t = {time} s: {source}"),
    }
}

/// Writes an error of a controller.
fn controller(
    f: &mut fmt::Formatter<'_>,
    time: f64,
    name: &str,
    why: &ControllerError,
) -> fmt::Result {
    write!(f, "at t = {} s, controller `{name}`: {why}", Plain(time))
}

/// Writes items, what leads to the first before it and what separates them before the others.
fn separated(
    f: &mut fmt::Formatter<'_>,
    [lead, separator]: [&str; 2],
    items: impl Iterator<Item = impl fmt::Display>,
) -> fmt::Result {
    items.enumerate().try_for_each(|(index, item)| {
        write!(f, "{}{item}", if index == 0 { lead } else { separator })
    })
}

impl fmt::Display for RunError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scenario(errors) => {
                f.write_str("scenario rejected")?;
                separated(f, [": ", "; "], errors.iter())
            }
            Self::Parameters(error) => write!(f, "spacecraft rejected: {error}"),
            Self::Modes(error) => write!(f, "structure rejected: {error}"),
            Self::Solve { time, device, source } => solve(f, *time, device.as_deref(), source),
            Self::TurnAtRightAngle { time, platform, angle, pivot: [pivot, bound] } => write!(
                f,
                "at t = {time} s, `{platform}`: its y turn is at {} deg, where the x turn is about the \
                 axis of the z turn and has no inertia of its own: {pivot:e} kg m^2, not above \
                 {bound:e}; choose a `mount` in which the y turn stays away from 90 deg, or lock the x \
                 turn",
                angle.to_degrees(),
                time = Plain(*time)
            ),
            Self::LockedJointMoves { time, joint, rate, unit } => write!(
                f,
                "at t = {time} s: {joint} is to be locked but moves at {rate} {unit}, not 0; stop \
                 it with a brake instead",
                time = Plain(*time),
                rate = Plain(*rate)
            ),
            Self::BeyondLargestRate { time, joint, rate, limit, unit } => write!(
                f,
                "at t = {time} s: {joint} has the rate {rate} {unit}, beyond the largest one of its motor, \
                 {limit} {unit}; raise that, start slower, or during a run give the motor a largest torque, \
                 with which it brakes",
                time = Plain(*time),
                rate = Plain(*rate),
                limit = Plain(*limit)
            ),
            Self::NotDriven { time, joint } => write!(
                f,
                "at t = {time} s: the kind of {joint} keeps its rate constant; remove its drive, \
                 or use a kind that drives it",
                time = Plain(*time)
            ),
            Self::BeyondStop { joint, value, stops: [lower, upper], unit } => write!(
                f,
                "{joint} starts at {value} {unit}, beyond its end stops {lower} {unit} and {upper} \
                 {unit}; start it in between",
                value = Plain(*value),
                lower = Plain(*lower),
                upper = Plain(*upper)
            ),
            Self::Inputs { expected, found } => write!(
                f,
                "{found} inputs are given, and the run takes {expected} finite ones; give all of them"
            ),
            Self::Crossing { name, column, nearest } => {
                write!(f, "crossing `{name}`: `{column}` is no column of the state")?;
                let near = nearest.iter().map(|near| format!("`{near}`"));
                separated(f, ["; nearest: ", ", "], near)
            }
            Self::Undecided { time, joint, motor, changes } => {
                let (what, remedy) = undecided(*motor);
                let time = Plain(*time);
                write!(f, "at t = {time} s the {what} of {joint} has changed {changes} times ")?;
                f.write_str(remedy)
            }
            Self::TooManySteps { time, fastest } => write!(
                f,
                "the integrator used up its steps at t = {time} s{}, loosen the tolerance or \
                 shorten the duration",
                slower(fastest.as_deref()),
                time = Plain(*time)
            ),
            Self::StepTooSmall { time, fastest } => write!(
                f,
                "the integrator's step fell below rounding at t = {time} s{} or loosen the \
                 tolerance",
                slower(fastest.as_deref()),
                time = Plain(*time)
            ),
            Self::Stiff { time, fastest } => write!(
                f,
                "the motion turns stiff at t = {time} s, too fast for an explicit method{}, check \
                 torques and inertias",
                slower(fastest.as_deref()),
                time = Plain(*time)
            ),
            Self::TooFast { time, quantity, rate, unit } => write!(
                f,
                "at t = {time} s {quantity} changes by {rate} {unit}, too fast for any step; check the \
                 initial state, torques, springs and inertias with their units",
                time = Plain(*time),
                rate = Plain(*rate)
            ),
            Self::Integrator { time, fault } => write!(
                f,
                "the integrator stopped at t = {time} s: {fault}; this is a fault of the program",
                time = Plain(*time)
            ),
            Self::Controller { time, name, source } => controller(f, *time, name, source),
            Self::NoController { name } => write!(f, "no controller is named `{name}`"),
            Self::Record(error) => error.fmt(f),
            Self::Elsewhere { message, .. } => f.write_str(message),
        }
    }
}

impl std::error::Error for RunError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Parameters(source) => Some(source),
            Self::Modes(source) => Some(source),
            Self::Solve { source, .. } => Some(source),
            Self::Controller { source, .. } => Some(source),
            Self::Record(source) => Some(source),
            _ => None,
        }
    }
}

impl From<RecordError> for RunError {
    fn from(error: RecordError) -> Self {
        Self::Record(error)
    }
}
