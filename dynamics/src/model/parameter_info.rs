//! [`ParameterInfo`]: the parameters of a kind by name, with symbol, unit, frame and meaning, and a
//! parameter read and written by its name ([`Kind::parameter`], [`Kind::set_parameter`]).
//!
//! Invariant: `Kind::PARAMETERS` lists the fields of the kind's structure in order, `passive` left
//! out: the parameters of a joint's spring, damper and friction are [`Passive::PARAMETERS`], and are
//! named `passive.inner_gimbal.stiffness`.

use core::error::Error;
use core::fmt::{self, Display, Formatter};

use nalgebra::{Matrix3, Vector3};

use crate::model::kind::{ImbalanceModel, JointInfo, Kind};
use crate::model::passive::Passive;
use crate::numbers::each::Each;

/// A parameter of a kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ParameterInfo {
    /// The field of the kind's structure: `r_goc_go`.
    pub name: &'static str,
    /// As the paper writes it.
    pub symbol: &'static str,
    /// Unit of each component; `1` of a pure number, empty where there is no number.
    pub unit: &'static str,
    /// How many components, and what they form.
    pub shape: Shape,
    /// The frame that the components are expressed in: `B`, or a body with its own axes; none of a
    /// scalar without axis.
    pub frame: Option<&'static str>,
    /// The body that it belongs to; none of what belongs to the device.
    pub body: Option<&'static str>,
    /// What it is.
    pub meaning: &'static str,
}

/// What the components of a parameter form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// One number.
    Scalar,
    /// Three components.
    Vector,
    /// A direction cosine matrix.
    Rotation,
    /// A symmetric tensor.
    Symmetric,
    /// An [`ImbalanceModel`].
    Model,
}

/// The value of a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ParameterValue<T = f64> {
    /// Of [`Shape::Scalar`].
    Scalar(T),
    /// Of [`Shape::Vector`].
    Vector(Vector3<T>),
    /// Of [`Shape::Rotation`] and [`Shape::Symmetric`].
    Matrix(Matrix3<T>),
    /// Of [`Shape::Model`].
    Model(ImbalanceModel),
}

/// A parameter in its structure.
#[derive(Debug, PartialEq)]
pub enum ParameterMut<'a, T> {
    /// Of [`Shape::Scalar`].
    Scalar(&'a mut T),
    /// Of [`Shape::Vector`].
    Vector(&'a mut Vector3<T>),
    /// Of [`Shape::Rotation`] and [`Shape::Symmetric`].
    Matrix(&'a mut Matrix3<T>),
    /// Of [`Shape::Model`].
    Model(&'a mut ImbalanceModel),
}

/// Why a parameter cannot be read or written by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NameError {
    /// The kind has no parameter of the name.
    Unknown {
        /// The kind.
        kind: &'static str,
    },
    /// The value has another shape than the parameter.
    Shape {
        /// The kind.
        kind: &'static str,
        /// What the parameter requires.
        required: Shape,
    },
}

impl Display for Shape {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Scalar => "one number",
            Self::Vector => "three components",
            Self::Rotation | Self::Symmetric => "a 3 by 3 matrix",
            Self::Model => "an imbalance model",
        })
    }
}

impl Display for NameError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown { kind } => write!(
                f,
                "{kind} has no parameter of this name; use one of its `Kind::PARAMETERS`, or \
                 `passive.BODY.NAME` with one of `Passive::PARAMETERS`"
            ),
            Self::Shape { kind, required } => {
                write!(f, "the parameter of {kind} requires {required}")
            }
        }
    }
}

impl Error for NameError {}

impl<T: Copy> ParameterMut<'_, T> {
    /// Its value.
    #[must_use]
    pub fn value(&self) -> ParameterValue<T> {
        match self {
            Self::Scalar(value) => ParameterValue::Scalar(**value),
            Self::Vector(value) => ParameterValue::Vector(**value),
            Self::Matrix(value) => ParameterValue::Matrix(**value),
            Self::Model(value) => ParameterValue::Model(**value),
        }
    }

    /// Writes a value of the same shape; returns whether it has that.
    fn write(self, value: ParameterValue<T>) -> bool {
        match (self, value) {
            (Self::Scalar(to), ParameterValue::Scalar(from)) => *to = from,
            (Self::Vector(to), ParameterValue::Vector(from)) => *to = from,
            (Self::Matrix(to), ParameterValue::Matrix(from)) => *to = from,
            (Self::Model(to), ParameterValue::Model(from)) => *to = from,
            (Self::Scalar(_) | Self::Vector(_) | Self::Matrix(_) | Self::Model(_), _) => {
                return false;
            }
        }
        true
    }
}

/// The value of a device's parameter.
pub(crate) fn value<K: Kind>(
    device: &K,
    name: &str,
) -> Result<ParameterValue<K::Scalar>, NameError> {
    let mut copy = *device;
    let found = find(&mut copy, name).map(|found| found.value());
    found.ok_or(NameError::Unknown { kind: K::NAME })
}

/// Writes a parameter of a device.
pub(crate) fn write<K: Kind>(
    device: &mut K,
    name: &str,
    value: ParameterValue<K::Scalar>,
) -> Result<(), NameError> {
    let found = find(device, name).ok_or(NameError::Unknown { kind: K::NAME })?;
    if found.write(value) {
        return Ok(());
    }
    let info = K::PARAMETERS.iter().find(|info| info.name == name);
    // What the table leaves out is of a joint: one number.
    let required = info.map_or(Shape::Scalar, |info| info.shape);
    Err(NameError::Shape { kind: K::NAME, required })
}

/// A parameter of the structure, or of the passive elements of one of its joints.
pub(crate) fn find<'a, K: Kind>(
    device: &'a mut K,
    name: &str,
) -> Option<ParameterMut<'a, K::Scalar>> {
    let Some(of_joint) = name.strip_prefix("passive.") else { return device.parameter_mut(name) };
    let (body, name) = of_joint.split_once('.')?;
    let mut joints = device.passive_mut().values_mut().zip(K::JOINTS);
    let (passive, _) = joints.find(|(_, info)| info.is_named(body))?;
    passive.parameter_mut(name).map(ParameterMut::Scalar)
}

impl JointInfo {
    /// Whether an identifier is the name of the child body: `inner_gimbal` of `inner gimbal`.
    #[must_use]
    pub fn is_named(&self, identifier: &str) -> bool {
        let letters = self.body.bytes().map(|byte| if byte == b' ' { b'_' } else { byte });
        letters.eq(identifier.bytes())
    }
}

impl<T> Passive<T> {
    /// The parameters of a joint: their names, and their units where it turns and where it slides.
    pub const PARAMETERS: &'static [(&'static str, [&'static str; 2])] = &[
        ("stiffness", ["N m/rad", "N/m"]),
        ("rest", ["rad", "m"]),
        ("viscous", ["N m s/rad", "N s/m"]),
        ("coulomb", ["N m", "N"]),
        ("coulomb_rate", ["rad/s", "m/s"]),
    ];

    /// The parameter of a name; none where there is no such.
    pub fn parameter_mut(&mut self, name: &str) -> Option<&mut T> {
        Some(match name {
            "stiffness" => &mut self.stiffness,
            "rest" => &mut self.rest,
            "viscous" => &mut self.viscous,
            "coulomb" => &mut self.coulomb,
            "coulomb_rate" => &mut self.coulomb_rate,
            _ => return None,
        })
    }
}
