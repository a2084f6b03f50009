//! Why the modes of a structure are rejected: [`ModesError`].

use core::error::Error;
use core::fmt::{self, Display, Formatter};

use crate::numbers::real::Scalar;
use crate::validation::parameter_error::ParameterError;

/// A part of [`Modes`](crate::Modes). Modes and mounts count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ModalQuantity {
    /// `frequencies`.
    Frequency,
    /// `damping`.
    Damping,
    /// `linear`.
    LinearIntegral,
    /// `angular`.
    AngularIntegral,
    /// `translation` of a point.
    Translation {
        /// Its mount.
        mount: usize,
    },
    /// `rotation` of a point.
    Rotation {
        /// Its mount.
        mount: usize,
    },
    /// `position` of a point.
    Position {
        /// Its mount.
        mount: usize,
    },
}

/// What is wrong with a residual coordinate or compliance.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ResidualFault<T = f64> {
    /// More residual coordinates than modes.
    Count {
        /// The number of modes.
        modes: usize,
    },
    /// It has no stiffness.
    NoStiffness,
    /// It carries momentum: its integrals are not zero.
    Momentum,
    /// It moves a mount where the model of the structure contains a body.
    Contained {
        /// The mount.
        mount: usize,
    },
    /// No device has mass where it moves: twice its kinetic energy at unit rate.
    Massless {
        /// That number.
        mass: T,
    },
    /// The compliance has another number of entries.
    Entries {
        /// Six for each mount and point, times six for each mount.
        expected: usize,
        /// The number of entries.
        found: usize,
    },
    /// An entry of the compliance is infinite or NaN.
    NotFinite {
        /// The value.
        value: T,
    },
    /// Two entries of the compliance that have to be equal are not.
    Asymmetric {
        /// Their difference.
        difference: T,
    },
    /// The compliance has a negative pivot: strain energy below zero.
    Negative {
        /// The pivot, of the row's own compliance.
        pivot: T,
    },
}

/// Why [`Spacecraft::flexible`](crate::Spacecraft::flexible) rejects parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ModesError<T = f64> {
    /// A parameter of hub or devices.
    Rigid(ParameterError<T>),
    /// A parameter of the body that a mount's model contains.
    Contained {
        /// The mount.
        mount: usize,
        /// What is wrong; its part is called the hub, but not in the message.
        error: ParameterError<T>,
    },
    /// A number of the modes is infinite or NaN.
    NotFinite {
        /// Which one.
        what: ModalQuantity,
        /// Of which mode; of a position 0.
        mode: usize,
        /// The value.
        value: T,
    },
    /// A frequency or a damping ratio is below zero.
    Negative {
        /// Which one.
        what: ModalQuantity,
        /// Of which mode.
        mode: usize,
        /// The value.
        value: T,
    },
    /// A list does not have one entry for each mode.
    ModeCount {
        /// Which list.
        what: ModalQuantity,
        /// The number of frequencies.
        expected: usize,
        /// The length of the list.
        found: usize,
    },
    /// The list of mounts of the devices does not have one entry for each device.
    DeviceCount {
        /// The number of devices.
        expected: usize,
        /// The length of the list.
        found: usize,
    },
    /// A device stands on a mount that the structure does not have.
    NoMount {
        /// The device.
        device: usize,
        /// Its mount.
        mount: usize,
        /// The number of mounts.
        mounts: usize,
    },
    /// A residual coordinate that the model has no place for.
    Residual {
        /// The mode, or the row of the compliance.
        mode: usize,
        /// What is wrong with it.
        fault: ResidualFault<T>,
    },
    /// The modes carry more momentum than the structure has mass or inertia: what its rigid motion
    /// keeps for itself, `[m, -tilde(m c); tilde(m c), I] - Y_0 Y_0ᵀ`, has a negative pivot.
    MoreThanStructure {
        /// Row of the pivot: 0 to 2 the mass in x, y, z, 3 to 5 the moments of inertia.
        row: usize,
        /// The pivot, kg or kg m².
        pivot: T,
        /// What rounding explains, negative.
        bound: T,
    },
}

impl<T> From<ParameterError<T>> for ModesError<T> {
    fn from(error: ParameterError<T>) -> Self {
        Self::Rigid(error)
    }
}

impl Display for ModalQuantity {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Frequency => f.write_str("frequency"),
            Self::Damping => f.write_str("damping ratio"),
            Self::LinearIntegral => f.write_str("linear momentum integral"),
            Self::AngularIntegral => f.write_str("angular momentum integral"),
            Self::Translation { mount } => write!(f, "translation at mount {mount}"),
            Self::Rotation { mount } => write!(f, "rotation at mount {mount}"),
            Self::Position { mount } => write!(f, "position of mount {mount}"),
        }
    }
}

impl<T: Scalar> ResidualFault<T> {
    fn write(&self, f: &mut Formatter<'_>, mode: usize) -> fmt::Result {
        match *self {
            Self::Count { modes } => write!(
                f,
                "{mode} residual coordinates of {modes} modes; they are the last ones of the modes"
            ),
            Self::NoStiffness => write!(
                f,
                "frequency of residual coordinate {mode} is 0; give a number above 0, and shapes \
                 times that number"
            ),
            Self::Momentum => write!(
                f,
                "momentum integrals of residual coordinate {mode} are not 0, but it has no mass"
            ),
            Self::Contained { mount } => write!(
                f,
                "residual coordinate {mode} moves mount {mount}, of which the structure's model \
                 contains a body; give modes and compliance of the structure without it"
            ),
            Self::Massless { mass } => write!(
                f,
                "residual coordinate {mode} moves a mass of {:?}, not above 0; leave out the \
                 compliance of mounts without devices, and of rotations of a point mass",
                mass.to_f64()
            ),
            Self::Entries { expected, found } => write!(
                f,
                "the compliance has {found} entries, not {expected}; give six rows for each mount \
                 and point, with six columns for each mount"
            ),
            Self::NotFinite { value } => write!(
                f,
                "{:?} in row {mode} of the compliance is not finite; give finite numbers in SI units",
                value.to_f64()
            ),
            Self::Asymmetric { difference } => write!(
                f,
                "row {mode} of the compliance differs from its column by {:?}; give a symmetric \
                 matrix of the mounts",
                difference.to_f64()
            ),
            Self::Negative { pivot } => write!(
                f,
                "row {mode} of the compliance has a pivot of {:?} of its diagonal, below 0; subtract \
                 the modes' own compliance from that of the same structure",
                pivot.to_f64()
            ),
        }
    }
}

impl<T: Scalar> Display for ModesError<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Rigid(error) => error.fmt(f),
            Self::Contained { mount, error } => error.write(
                f,
                &format_args!("body that the structure's model contains at mount {mount}"),
            ),
            Self::NotFinite { what: what @ ModalQuantity::Position { .. }, value, .. } => write!(
                f,
                "{:?} in the {what} is not finite; give finite numbers in SI units",
                value.to_f64()
            ),
            Self::NotFinite { what, mode, value } => write!(
                f,
                "{:?} in the {what} of mode {mode} is not finite; give finite numbers in SI units",
                value.to_f64()
            ),
            Self::Negative { what, mode, value } => write!(
                f,
                "{what} {:?} of mode {mode} is below 0; give rad/s, and a ratio of critical damping",
                value.to_f64()
            ),
            Self::ModeCount { what, expected, found } => write!(
                f,
                "the list of the {what} has {found} entries, not {expected}; give one for each mode"
            ),
            Self::DeviceCount { expected, found } => write!(
                f,
                "the list of mounts has {found} entries, not {expected}; give one for each device"
            ),
            Self::NoMount { device, mount, mounts } => write!(
                f,
                "device {device} stands on mount {mount} of {mounts}; mounts count from 0"
            ),
            Self::Residual { mode, fault } => fault.write(f, mode),
            Self::MoreThanStructure { row, pivot, bound } => write!(
                f,
                "pivot {:?} of row {row} of the hub's mass less that of the modes is below {:?}; \
                 check that the shapes are mass-normalised, and that the hub's mass and inertia \
                 are those of the whole structure",
                pivot.to_f64(),
                bound.to_f64(),
            ),
        }
    }
}

impl<T: Scalar> Error for ModesError<T> {}
