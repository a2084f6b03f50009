//! [`Dimension`] and [`Measure`]: what a key of a scenario file wants.

use std::fmt;

/// Exponents of length, mass, time and plane angle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Dimension {
    /// Of the metre.
    pub length: i8,
    /// Of the kilogram.
    pub mass: i8,
    /// Of the second.
    pub time: i8,
    /// Of the radian.
    pub angle: i8,
}

/// What a quantity is, and the unit in which it is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Measure {
    /// What it is, with its article: `a mass`.
    pub name: &'static str,
    /// The SI unit: `kg`.
    pub unit: &'static str,
    /// Another usual one, for messages and templates: `rpm`.
    pub usual: &'static str,
    /// Its dimension.
    pub dimension: Dimension,
    /// Another in which it is stated, too: what is over the square of a rate may be so of an angle.
    pub also: Option<Dimension>,
}

const fn dimension(length: i8, mass: i8, time: i8, angle: i8) -> Dimension {
    Dimension { length, mass, time, angle }
}

macro_rules! measures {
    ($($(#[$doc:meta])* $constant:ident = $name:literal, $unit:literal, $usual:literal,
        [$length:literal $mass:literal $time:literal $angle:literal];)*) => {
        impl Measure {
            $(
                $(#[$doc])*
                pub const $constant: Self = Self {
                    name: $name,
                    unit: $unit,
                    usual: $usual,
                    dimension: dimension($length, $mass, $time, $angle),
                    also: None,
                };
            )*

            /// All of them; the first with a dimension names it.
            pub const ALL: &'static [Self] = &[$(Self::$constant),*];
        }
    };
}

measures! {
    /// A pure number.
    NUMBER = "a number", "", "", [0 0 0 0];
    /// Length.
    LENGTH = "a length", "m", "cm", [1 0 0 0];
    /// Mass.
    MASS = "a mass", "kg", "kg", [0 1 0 0];
    /// Time.
    TIME = "a time", "s", "ms", [0 0 1 0];
    /// Plane angle.
    ANGLE = "an angle", "rad", "deg", [0 0 0 1];
    /// Cycles per second.
    FREQUENCY = "a frequency", "Hz", "kHz", [0 0 -1 0];
    /// Velocity.
    VELOCITY = "a velocity", "m/s", "mm/s", [1 0 -1 0];
    /// Acceleration.
    ACCELERATION = "an acceleration", "m/s^2", "mm/s^2", [1 0 -2 0];
    /// Angular rate.
    ANGULAR_RATE = "an angular rate", "rad/s", "rpm", [0 0 -1 1];
    /// Angular acceleration.
    ANGULAR_ACCELERATION = "an angular acceleration", "rad/s^2", "deg/s^2", [0 0 -2 1];
    /// Angular jerk.
    ANGULAR_JERK = "an angular jerk", "rad/s^3", "deg/s^3", [0 0 -3 1];
    /// Force.
    FORCE = "a force", "N", "mN", [1 1 -2 0];
    /// Torque.
    TORQUE = "a torque", "N m", "mN m", [2 1 -2 0];
    /// Energy or work.
    ENERGY = "an energy", "J", "mJ", [2 1 -2 0];
    /// Power.
    POWER = "a power", "W", "mW", [2 1 -3 0];
    /// Inertia; dynamic imbalance has the same dimension.
    INERTIA = "an inertia", "kg m^2", "g cm^2", [2 1 0 0];
    /// Dynamic imbalance.
    DYNAMIC_IMBALANCE = "a dynamic imbalance", "kg m^2", "g cm^2", [2 1 0 0];
    /// Static imbalance; a first moment.
    STATIC_IMBALANCE = "a static imbalance", "kg m", "g cm", [1 1 0 0];
    /// Reciprocal of an inertia.
    INVERSE_INERTIA = "a reciprocal of an inertia", "1/(kg m^2)", "1/(kg m^2)", [-2 -1 0 0];
    /// Linear momentum.
    MOMENTUM = "a linear momentum", "kg m/s", "N s", [1 1 -1 0];
    /// Angular momentum.
    ANGULAR_MOMENTUM = "an angular momentum", "N m s", "N m s", [2 1 -1 0];
    /// Stiffness of a turning joint.
    ANGULAR_STIFFNESS = "a stiffness of a turning joint", "N m/rad", "N m/deg", [2 1 -2 -1];
    /// Stiffness of a sliding joint.
    STIFFNESS = "a stiffness of a sliding joint", "N/m", "N/mm", [0 1 -2 0];
    /// Viscous friction of a turning joint.
    ANGULAR_DAMPING = "a viscous friction of a turning joint", "N m s/rad", "mN m s/rad", [2 1 -1 -1];
    /// Viscous friction of a sliding joint.
    DAMPING = "a viscous friction of a sliding joint", "N s/m", "N s/m", [0 1 -1 0];
    /// Quadratic drag of a turning joint.
    ANGULAR_DRAG = "a quadratic drag of a turning joint", "N m s^2/rad^2", "mN m s^2/rad^2", [2 1 0 -2];
    /// Quadratic drag of a sliding joint.
    DRAG = "a quadratic drag of a sliding joint", "N s^2/m^2", "N s^2/m^2", [-1 1 0 0];
    /// Stiffness between slides and turns of a platform.
    COUPLING_STIFFNESS = "a stiffness between slides and turns", "N/rad", "N/mrad", [1 1 -2 -1];
    /// Viscous friction between slides and turns of a platform.
    COUPLING_DAMPING = "a viscous friction between slides and turns", "N s/rad", "N s/rad", [1 1 -1 -1];
    /// One-sided power spectral density of a force.
    FORCE_DENSITY = "a spectral density of a force", "N^2/Hz", "mN^2/Hz", [2 2 -3 0];
    /// One-sided power spectral density of a moment.
    MOMENT_DENSITY = "a spectral density of a moment", "N^2 m^2/Hz", "mN^2 m^2/Hz", [4 2 -3 0];
    /// Gravitational parameter of a central body.
    GRAVITATIONAL_PARAMETER = "a gravitational parameter", "m^3/s^2", "km^3/s^2", [3 0 -2 0];
}

/// The first measure with a dimension, which names it.
#[must_use]
pub fn measure_of(dimension: Dimension) -> Option<Measure> {
    Measure::ALL.iter().find(|measure| measure.dimension == dimension).copied()
}

impl Dimension {
    /// This with another to a power; none where an exponent is beyond what a unit needs.
    #[must_use]
    pub(super) fn times(self, other: Self, power: i8) -> Option<Self> {
        let sum = |a: i8, b: i8| b.checked_mul(power).and_then(|b| a.checked_add(b));
        Some(Self {
            length: sum(self.length, other.length)?,
            mass: sum(self.mass, other.mass)?,
            time: sum(self.time, other.time)?,
            angle: sum(self.angle, other.angle)?,
        })
    }
}

impl fmt::Display for Dimension {
    /// As a unit in SI: `kg m^2 s^-2`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts = [("kg", self.mass), ("m", self.length), ("rad", self.angle), ("s", self.time)];
        let mut first = true;
        for (symbol, power) in parts.into_iter().filter(|(_, power)| *power != 0) {
            if !first {
                f.write_str(" ")?;
            }
            first = false;
            f.write_str(symbol)?;
            if power != 1 {
                write!(f, "^{power}")?;
            }
        }
        if first { f.write_str("1") } else { Ok(()) }
    }
}
