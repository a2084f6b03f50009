//! [`MarginsError`]: why a loop has no linear form.

use std::fmt;

use precess_control::ControlError;

use crate::control::ControllerError;
use crate::structure::Fault;
use crate::units::Plain;

/// Why a loop has no linear form.
#[derive(Debug)]
pub enum MarginsError {
    /// The scenario has no controller.
    NoController,
    /// No controller has this name, or there are several and none is chosen.
    Choice {
        /// The name; none where none is chosen.
        name: Option<String>,
        /// Names of the controllers.
        known: Vec<String>,
    },
    /// A law that is a program has no equation here.
    Program {
        /// The controller.
        name: String,
    },
    /// The hub does not turn freely.
    FixedHub,
    /// The servo's rate is no whole multiple of that of the samples.
    ServoRate {
        /// Of samples, Hz.
        rate: f64,
        /// Of the servo, Hz.
        servo: f64,
    },
    /// A commanded joint is no coordinate of the equations.
    Joint {
        /// Its number.
        joint: usize,
    },
    /// The equations of motion.
    Model(Fault),
    /// The linear loop.
    Control(ControlError),
    /// Law or division among joints.
    Controller(ControllerError),
}

impl fmt::Display for MarginsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoController => f.write_str("the scenario has no `[[controller]]`; add one"),
            Self::Choice { name: None, known } => write!(
                f,
                "there are {} controllers; choose one of {} by --controller",
                known.len(),
                known.join(", ")
            ),
            Self::Choice { name: Some(name), known } => {
                write!(f, "no controller is named `{name}`; write one of {}", known.join(", "))
            }
            Self::Program { name } => write!(
                f,
                "the law of `{name}` is a program, whose equation is not known; use a law that is built in"
            ),
            Self::FixedHub => f.write_str(
                "the hub is held or its motion is prescribed; margins are of a free hub",
            ),
            Self::ServoRate { rate, servo } => write!(
                f,
                "`servo.rate` is {} Hz, no whole multiple of the {} Hz of the samples: the loop does not repeat with a sample",
                Plain(*servo),
                Plain(*rate)
            ),
            Self::Joint { joint } => {
                write!(f, "the commanded joint {joint} is held; a commanded joint is free")
            }
            Self::Model(fault) => fault.fmt(f),
            Self::Control(error) => error.fmt(f),
            Self::Controller(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for MarginsError {}

impl From<Fault> for MarginsError {
    fn from(fault: Fault) -> Self {
        Self::Model(fault)
    }
}

impl From<ControlError> for MarginsError {
    fn from(error: ControlError) -> Self {
        Self::Control(error)
    }
}

impl From<ControllerError> for MarginsError {
    fn from(error: ControllerError) -> Self {
        Self::Controller(error)
    }
}
