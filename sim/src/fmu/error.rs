//! [`FmuError`]: what of a scenario is not in the solver in C, by name.

use std::fmt;

use crate::scenario::UndescribedError;
use crate::units::Plain;

/// What of a scenario is not in the solver in C.
#[derive(Clone, Debug, PartialEq)]
pub enum FmuError {
    /// The spacecraft is not a rigid hub with devices on it.
    Spacecraft(UndescribedError),
    /// There is no device.
    NoDevice,
    /// Steps are chosen by a tolerance.
    Tolerance,
    /// A controller that is another program, by its name.
    Program(String),
    /// A column that the scenario records and has not: why.
    Column(String),
    /// A controller, by its name.
    Controller(String),
    /// An empirical source of forces, by its name.
    Source(String),
    /// Friction that sticks, or quadratic drag, of a joint.
    Friction(String),
    /// A joint whose end stop locks it.
    LockingStop(String),
    /// A motor whose torque depends on the rate.
    MotorLimit(String),
    /// A change of a joint's drive at a time.
    Change {
        /// The joint.
        joint: String,
        /// When, s.
        time: f64,
    },
    /// A wrench on a device's body whose components are expressed in N, by its number from 1.
    InertialWrench(usize),
}

impl From<UndescribedError> for FmuError {
    fn from(error: UndescribedError) -> Self {
        Self::Spacecraft(error)
    }
}

impl fmt::Display for FmuError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("not as a functional mock-up unit: ")?;
        match self {
            Self::Spacecraft(UndescribedError::Hub) => f.write_str("the hub is not free"),
            Self::Spacecraft(UndescribedError::Structure) => {
                f.write_str("the hub of the solver in C is rigid; remove `[structure]`")
            }
            Self::Spacecraft(UndescribedError::Lumped(name)) => write!(
                f,
                "the imbalance of {name} is lumped, and the solver in C couples it; state `imbalance_model = \
                 \"coupled\"`"
            ),
            Self::Spacecraft(UndescribedError::Platform(name)) => write!(
                f,
                "{name} is an isolated platform, and the solver in C has devices on the hub; remove `[[platform]]`, and \
                 `on` of the devices on it"
            ),
            Self::Spacecraft(UndescribedError::Carried(name)) => write!(
                f,
                "{name} stands on another device, and the solver in C has devices on the hub; remove its `on`"
            ),
            Self::NoDevice => f.write_str("there is no device; add a `[[device]]`"),
            Self::Tolerance => f.write_str(
                "steps of Co-Simulation are of one length, and this scenario has a tolerance; state the length by `--step`, \
                 or `integrator = \"rk4\"` and `step` in `[run]`",
            ),
            Self::Program(name) => write!(
                f,
                "controller {name} is another program, which a unit does not start; choose another law"
            ),
            Self::Column(why) => f.write_str(why),
            Self::Controller(name) => write!(
                f,
                "controller {name} is not in the solver in C; remove `[[controller]]`: motor torques are inputs"
            ),
            Self::Source(name) => write!(
                f,
                "source {name} is not in the solver in C; remove `[[source]]`, and give forces by a `[[wrench]]`"
            ),
            Self::Friction(joint) => write!(
                f,
                "friction of {joint} that sticks, or its quadratic drag, is not in the solver in C; remove \
                 `static_friction`, `stribeck_rate` and `quadratic_drag`, and give `coulomb` with `coulomb_rate`"
            ),
            Self::LockingStop(joint) => write!(
                f,
                "a stop of {joint} locks it, and the solver in C has no impulsive stops; state `at_stop = \"end\"`, or \
                 remove the stops"
            ),
            Self::MotorLimit(joint) => write!(
                f,
                "the motor of {joint} is limited in power or rate, which is not in the solver in C; remove `power_limit` \
                 and `rate_limit`"
            ),
            Self::Change { joint, time } => write!(
                f,
                "the drive of {joint} changes at {} s, and a unit has no changes of drives; remove `[[at]]`",
                Plain(*time)
            ),
            Self::InertialWrench(number) => write!(
                f,
                "wrench {number} acts on a device's body along the axes of N, which the solver in C does not turn; state \
                 `axes = \"body\"`"
            ),
        }
    }
}

impl std::error::Error for FmuError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Spacecraft(source) => Some(source),
            _ => None,
        }
    }
}
