//! [`DerivativeError`]: why there is no derivative.

use core::error::Error;
use core::fmt::{self, Display, Formatter};

use crate::derivatives::variable::Variable;
use crate::equations::error::SolveError;
use crate::model::parameter_info::NameError;
use crate::numbers::real::Scalar;
use crate::validation::imbalance_error::ImbalanceError;
use crate::validation::parameter_error::ParameterError;

/// Why there is no derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum DerivativeError<T = f64> {
    /// There are no accelerations, momenta or loads to differentiate.
    Solve(SolveError<T>),
    /// The parameters are not those of a spacecraft.
    Parameter(ParameterError<T>),
    /// The variable is not an input: the acceleration of a joint or hub that is not prescribed (or
    /// of a joint that its kind does not drive), gravity of another model.
    NotAnInput {
        /// The variable.
        variable: Variable,
    },
    /// There is no joint of that number.
    NoSuchJoint {
        /// The number.
        joint: usize,
        /// How many joints there are.
        joints: usize,
    },
    /// There is no mode of that number: a rigid hub has none.
    NoSuchMode {
        /// The number.
        mode: usize,
        /// How many modes there are.
        modes: usize,
    },
    /// There is no mount of that number: a rigid hub has none.
    NoSuchMount {
        /// The number.
        mount: usize,
        /// How many mounts there are.
        mounts: usize,
    },
    /// There is no device of that number.
    NoSuchDevice {
        /// The number.
        device: usize,
        /// How many devices there are.
        devices: usize,
    },
    /// The device's kind has no parameter of that name, or it is of another shape.
    NoSuchParameter {
        /// The device.
        device: usize,
        /// What is wrong with the name.
        name: NameError,
    },
    /// The device has no wheel that can be imbalanced.
    NoImbalance {
        /// The device.
        device: usize,
    },
    /// The wheel's parameters are no imbalance.
    Imbalance {
        /// The device.
        device: usize,
        /// Why.
        error: ImbalanceError<T>,
    },
    /// Every input is finite and so are the accelerations, but a derivative is not.
    NotFinite {
        /// The position of the variable in the list, from 0.
        variable: usize,
    },
    /// A direction, the weights of accelerations or a gradient are of another number of variables.
    Length {
        /// How many numbers there must be: one of each variable, or of each acceleration.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// A matrix has another number of elements, or a workspace is of fewer joints.
    Size {
        /// How many there must be: of elements rows times columns, of joints those of the spacecraft.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// What acts, or a device, has no emitted derivatives: a flexible structure, a carrier, lumped imbalance, wrenches on
    /// bodies, a central field, a kind of more joints than [`MAX_JOINTS`](crate::MAX_JOINTS); any device without the
    /// feature `derivatives`.
    NotEmitted,
    /// Every input is finite and so are the accelerations, but a direction, weights or their product with the derivatives
    /// is not.
    NotFiniteProduct,
}

impl<T> From<SolveError<T>> for DerivativeError<T> {
    fn from(error: SolveError<T>) -> Self {
        Self::Solve(error)
    }
}

impl<T> From<ParameterError<T>> for DerivativeError<T> {
    fn from(error: ParameterError<T>) -> Self {
        Self::Parameter(error)
    }
}

impl<T: Scalar> Display for DerivativeError<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Solve(error) => error.fmt(f),
            Self::Parameter(error) => error.fmt(f),
            Self::NotAnInput { variable } => write!(
                f,
                "{variable} is not an input; prescribe it in `Inputs`, or take another variable"
            ),
            Self::NoSuchJoint { joint, joints } => {
                write!(f, "no joint {joint}; joints count from 0, and there are {joints}")
            }
            Self::NoSuchMode { mode, modes } => {
                write!(f, "no mode {mode}; modes count from 0, and there are {modes}")
            }
            Self::NoSuchMount { mount, mounts } => {
                write!(f, "no mount {mount}; mounts count from 0, and there are {mounts}")
            }
            Self::NoSuchDevice { device, devices } => {
                write!(f, "no device {device}; devices count from 0, and there are {devices}")
            }
            Self::NoSuchParameter { device, name } => write!(f, "device {device}: {name}"),
            Self::NoImbalance { device } => write!(
                f,
                "device {device} has no wheel that can be imbalanced; use an imbalanced kind"
            ),
            Self::Imbalance { device, error } => write!(f, "device {device}: {error}"),
            Self::NotFinite { variable } => write!(
                f,
                "the derivative by variable {variable} of the list is not finite although the \
                 accelerations are; check the units of large or tiny inputs"
            ),
            Self::Length { expected, found } => write!(
                f,
                "{found} numbers where there are {expected} variables or accelerations; list \
                 `state_variables` and `input_variables` for the inputs at hand"
            ),
            Self::Size { expected, found } => write!(
                f,
                "{found} elements of a matrix, or joints of a workspace, where there are {expected}; a matrix has a row of \
                 each of the `state_variables`, and a column of each of these or of the `input_variables`"
            ),
            Self::NotEmitted => f.write_str(
                "no emitted derivatives of what acts, or of a device; take the columns of `derivatives`, and check the \
                 feature `derivatives`",
            ),
            Self::NotFiniteProduct => f.write_str(
                "a product of derivatives is not finite although the accelerations are; check the direction or \
                 the weights, and the units of large or tiny inputs",
            ),
        }
    }
}

impl<T: Scalar> Error for DerivativeError<T> {}
