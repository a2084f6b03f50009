//! [`BuiltInParameters`]: a device of whatever kind as bodies and joints, and [`Misfit`], what a
//! kind has no parameter for.

use core::error::Error;
use core::fmt::{self, Display, Formatter};

use nalgebra::Matrix3;

use crate::model::few::MAX_JOINTS;
use crate::model::kind::{BodyParameters, ImbalanceModel};
use crate::model::passive::Passive;
use crate::validation::parameter_error::Parameter;

/// A device as bodies and joints, which every kind can be stated in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BuiltInParameters<T = f64> {
    /// Columns: the device's axes expressed in B, which are those of its first body at zero.
    pub mount: Matrix3<T>,
    /// The bodies from the hub to the tip, as many as the kind has joints; the first origin is
    /// along *B axes*, the others along those of the body before. What stands behind them is not
    /// read.
    pub bodies: [BodyParameters<T>; MAX_JOINTS],
    /// Spring, damper and friction of the joint before each body.
    pub passive: [Passive<T>; MAX_JOINTS],
    /// Which model the imbalance of its wheel has.
    pub model: ImbalanceModel,
}

/// A parameter that is not zero, or not symmetric, where the kind has it so.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Misfit {
    /// The body.
    pub body: &'static str,
    /// Its parameter; none for the model of the imbalance.
    pub parameter: Option<Parameter>,
}

impl Display for Misfit {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { body, parameter } = self;
        match parameter {
            Some(parameter) => write!(
                f,
                "{parameter} of the {body} is none that the kind can have; set to 0 what the kind \
                 has no parameter for, or use an imbalanced kind"
            ),
            None => write!(
                f,
                "the kind has no imbalance of the {body} that could be lumped; use the coupled model"
            ),
        }
    }
}

impl Error for Misfit {}
