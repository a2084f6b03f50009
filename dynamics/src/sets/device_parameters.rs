//! [`DeviceParameters`]: a device of any kind as bodies and joints, and [`UnsupportedParameter`]:
//! one that a kind does not have.

use core::error::Error;
use core::fmt::{self, Display, Formatter};

use nalgebra::Matrix3;

use crate::model::joint_array::MAX_JOINTS;
use crate::model::kind::{BodyParameters, ImbalanceModel};
use crate::model::passive::Passive;
use crate::validation::parameter_error::Parameter;

/// Parameters of a device of any kind, by body and joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeviceParameters<T = f64> {
    /// Columns: the device's axes expressed in B, which are those of its first body at zero.
    pub mount: Matrix3<T>,
    /// The bodies from the hub to the tip, as many as the kind has joints; entries after them are
    /// not read. The first origin is expressed in B, the others in the axes of the parent body.
    pub bodies: [BodyParameters<T>; MAX_JOINTS],
    /// Spring, damper and friction of the joint of each body.
    pub passive: [Passive<T>; MAX_JOINTS],
    /// The model of the wheel's imbalance.
    pub model: ImbalanceModel,
}

/// A parameter is not zero, or not symmetric, though the kind requires it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnsupportedParameter {
    /// The body.
    pub body: &'static str,
    /// Its parameter; `None` for the model of the imbalance.
    pub parameter: Option<Parameter>,
}

impl Display for UnsupportedParameter {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { body, parameter } = self;
        match parameter {
            Some(parameter) => write!(
                f,
                "{parameter} of the {body} is not zero, or not symmetric, where the kind requires it; \
                 change it, or use an imbalanced kind"
            ),
            None => {
                write!(f, "the kind has no imbalance of the {body} to lump; use the coupled model")
            }
        }
    }
}

impl Error for UnsupportedParameter {}
