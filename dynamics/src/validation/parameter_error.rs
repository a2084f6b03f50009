//! Why parameters are rejected ([`ParameterError`]), and warnings about others ([`Warning`]).

use core::error::Error;
use core::fmt::{self, Display, Formatter};

use crate::numbers::real::Scalar;

/// A rigid body of the spacecraft. Devices count from 0, as in the set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The hub.
    Hub,
    /// A body of a device.
    Body {
        /// Index of the device.
        device: usize,
        /// What it is called: `inner gimbal`.
        body: &'static str,
    },
}

/// A kind of parameter, for [`ParameterError::NotFinite`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// A mass: `m_b`, `m_go`, `m_w`.
    Mass,
    /// A centre of mass: `r_bc_b`, `r_goc_go`, or the wheel's `d`.
    CentreOfMass,
    /// An inertia tensor: `i_b_bc`, `i_go_goc`, `i_w_wc`.
    Inertia,
    /// The origin of a device's body: `r_go_b`, `l_o`.
    Origin,
    /// The matrix `mount` of a device's first body.
    Mount,
    /// A spring, damper or friction of a body's joint: `stiffness`, `coulomb`.
    Passive(&'static str),
}

/// Why [`Spacecraft::new`](crate::Spacecraft::new) rejects parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ParameterError<T = f64> {
    /// A parameter is infinite or NaN.
    NotFinite {
        /// The body.
        part: Part,
        /// Which of its parameters.
        parameter: Parameter,
        /// The first such component.
        value: T,
    },
    /// The mass of the hub or of a device's last body is not above zero, or that of another
    /// body is below zero.
    Mass {
        /// The body.
        part: Part,
        /// Whether it may be massless.
        massless: bool,
        /// Its mass, kg.
        value: T,
    },
    /// The masses of all bodies, each finite, have an infinite sum.
    TotalMass {
        /// The sum, kg.
        value: T,
    },
    /// A stiffness or a friction is below zero, or Coulomb friction has no rate above zero at which
    /// it fades.
    Passive {
        /// The child body of the joint.
        part: Part,
        /// Which one.
        name: &'static str,
        /// Its value.
        value: T,
    },
    /// An inertia tensor is not symmetric.
    Asymmetric {
        /// The body.
        part: Part,
        /// Row of the element, from 1 as in `J_13`.
        row: usize,
        /// Column of the element, from 1, above the row.
        column: usize,
        /// The element minus its mirror, kg m^2.
        difference: T,
        /// What rounding explains, kg m^2.
        bound: T,
    },
    /// An inertia tensor has a negative principal moment.
    NegativeInertia {
        /// The body.
        part: Part,
        /// The smallest principal moment, kg m^2.
        value: T,
        /// What rounding explains, kg m^2; negative.
        bound: T,
    },
    /// The elements of an inertia tensor are finite, but its largest principal moment is not.
    LargeInertia {
        /// The body.
        part: Part,
        /// The largest principal moment, kg m^2.
        value: T,
    },
    /// A matrix of a platform's suspension is not symmetric.
    AsymmetricSuspension {
        /// Index of the platform, which counts as a device.
        device: usize,
        /// Which one: `stiffness`, `damping`.
        name: &'static str,
        /// Row of the element, from 1.
        row: usize,
        /// Column of the element, from 1, above the row.
        column: usize,
        /// The difference of the element and its mirror.
        difference: T,
    },
    /// A matrix of a platform's suspension is not positive semidefinite: its springs would release
    /// energy without end, its dampers produce it.
    Suspension {
        /// Index of the platform, which counts as a device.
        device: usize,
        /// Which one: `stiffness`, `damping`.
        name: &'static str,
        /// A diagonal element, or a pivot of the matrix scaled to a diagonal of ones.
        value: T,
        /// What rounding explains; not above zero.
        bound: T,
    },
    /// A strut of a platform has no length, no unit vector as its direction, or a negative stiffness
    /// or damping.
    Strut {
        /// Index of the platform, which counts as a device.
        device: usize,
        /// Index of the strut, from 0.
        strut: usize,
        /// What is out of range.
        name: &'static str,
        /// Its value.
        value: T,
    },
    /// The columns of a mount are not orthonormal.
    SkewedMount {
        /// Index of the device.
        device: usize,
        /// Largest element of `mount^T mount - 1`.
        residual: T,
        /// What rounding explains.
        bound: T,
    },
    /// The columns of a mount are orthonormal but left-handed.
    LeftHandedMount {
        /// Index of the device.
        device: usize,
        /// Determinant, -1 to rounding.
        determinant: T,
    },
}

/// What [`Spacecraft::warnings`](crate::Spacecraft::warnings) reports about accepted parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Warning<T = f64> {
    /// No mass distribution has this inertia: its largest principal moment exceeds the sum of the
    /// other two. The equations of motion hold all the same.
    Triangle {
        /// The body.
        part: Part,
        /// By how much it exceeds it, kg m^2.
        excess: T,
    },
}

impl Display for Part {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Hub => f.write_str("hub"),
            Self::Body { device, body } => write!(f, "{body} of device {device}"),
        }
    }
}

impl Display for Parameter {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match *self {
            Self::Mass => "mass",
            Self::CentreOfMass => "centre of mass",
            Self::Inertia => "inertia",
            Self::Origin => "origin",
            Self::Mount => "mount",
            Self::Passive(name) => name,
        })
    }
}

impl<T: Scalar> Display for ParameterError<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.write(f, &Part::Hub)
    }
}

/// The name of a part, where another body stands for the hub.
struct PartName<'a> {
    part: Part,
    hub: &'a dyn Display,
}

impl Display for PartName<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if self.part == Part::Hub { self.hub.fmt(f) } else { self.part.fmt(f) }
    }
}

impl<T: Scalar> ParameterError<T> {
    /// Writes the message, with the name of the body that was checked as a hub is.
    pub(crate) fn write(&self, f: &mut Formatter<'_>, hub: &dyn Display) -> fmt::Result {
        let name = |part| PartName { part, hub };
        match *self {
            Self::NotFinite { part, parameter, value } => write!(
                f,
                "{parameter} of the {} contains {:?}, which is not finite; give a number",
                name(part),
                value.to_f64(),
            ),
            Self::Mass { part, massless: false, value } => write!(
                f,
                "mass {:?} kg of the {} is not above 0; only a body with a child body in its \
                 device may be massless",
                value.to_f64(),
                name(part),
            ),
            Self::Mass { part, massless: true, value } => write!(
                f,
                "mass {:?} kg of the {} is below 0; use 0 for a massless one",
                value.to_f64(),
                name(part),
            ),
            Self::Passive { part, name, value } => write!(
                f,
                "{name} {:?} of the joint of the {part} is out of range; stiffness and friction are \
                 not below 0, and coulomb friction needs a coulomb_rate above 0",
                value.to_f64(),
            ),
            Self::TotalMass { value } => write!(
                f,
                "total mass {:?} kg is not finite; check the units of the masses",
                value.to_f64(),
            ),
            Self::Asymmetric { part, row, column, difference, bound } => write!(
                f,
                "inertia of the {}: element {row}{column} differs from element {column}{row} by {:?} \
                 kg m^2, more than {:?}; make the tensor symmetric",
                name(part),
                difference.to_f64(),
                bound.to_f64(),
            ),
            Self::NegativeInertia { part, value, bound } => write!(
                f,
                "smallest principal moment {:?} kg m^2 of the {} is below {:?}; check the signs and \
                 units of its inertia",
                value.to_f64(),
                name(part),
                bound.to_f64(),
            ),
            Self::LargeInertia { part, value } => write!(
                f,
                "largest principal moment {:?} kg m^2 of the {} is not finite; check the units of \
                 its inertia",
                value.to_f64(),
                name(part),
            ),
            Self::AsymmetricSuspension { device, name, row, column, difference } => write!(
                f,
                "{name} of the suspension of device {device}: elements {row}{column} and \
                 {column}{row} differ by {:?}; make the matrix symmetric",
                difference.to_f64(),
            ),
            Self::Suspension { device, name, value, bound } => write!(
                f,
                "{name} of the suspension of device {device} is not positive semidefinite: {:?} is \
                 below {:?}; check the signs of its elements off the diagonal",
                value.to_f64(),
                bound.to_f64(),
            ),
            Self::Strut { device, strut, name, value } => write!(
                f,
                "{name} {:?} of strut {strut} of device {device} is out of range; a strut has a \
                 length above 0, a unit vector as direction, stiffness and damping not below 0",
                value.to_f64(),
            ),
            Self::SkewedMount { device, residual, bound } => write!(
                f,
                "mount of device {device} is off orthonormal by {:?}, more than {:?}; its columns \
                 must be orthogonal unit vectors to full precision",
                residual.to_f64(),
                bound.to_f64(),
            ),
            Self::LeftHandedMount { device, determinant } => write!(
                f,
                "mount of device {device} has determinant {:?}, not 1; reverse one column to make \
                 it right-handed",
                determinant.to_f64(),
            ),
        }
    }
}

impl<T: Scalar> Error for ParameterError<T> {}

impl<T: Scalar> Display for Warning<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Triangle { part, excess } => write!(
                f,
                "largest principal moment of the {part} exceeds the sum of the other two by {:?} \
                 kg m^2; no mass distribution has this inertia, check its moments and products",
                excess.to_f64(),
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::string::ToString;

    use super::*;

    #[test]
    fn warning_shows_value_bound_and_remedy() {
        let warning =
            Warning::Triangle { part: Part::Body { device: 0, body: "wheel" }, excess: 0.25 };
        assert_eq!(
            warning.to_string(),
            "largest principal moment of the wheel of device 0 exceeds the sum of the other two by \
             0.25 kg m^2; no mass distribution has this inertia, check its moments and products"
        );
    }
}
