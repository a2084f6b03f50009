//! Why a description is none.

use std::fmt;

/// Why a description cannot be read or written.
#[derive(Debug)]
pub enum DescriptionError {
    /// It is not TOML, or has another form: with the place.
    Syntax(toml::de::Error),
    /// It cannot be written.
    Write(toml::ser::Error),
    /// Another version of the format.
    Format(u32),
    /// No identifier.
    Name(String),
    /// A title with a control character.
    Title,
    /// No device.
    NoDevice,
    /// Two devices of one name.
    Twice(String),
    /// Whose, which key, and the value, which is infinite or NaN.
    NotFinite(String, &'static str, f64),
    /// Whose, which key, and the value.
    NotPositive(String, &'static str, f64),
    /// Whose inertia.
    NotSymmetric(String),
    /// Whose mount is no rotation.
    Mount(String),
}

impl fmt::Display for DescriptionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Syntax(error) => write!(f, "the description cannot be read: {error}"),
            Self::Write(error) => write!(f, "the description cannot be written: {error}"),
            Self::Format(found) => {
                write!(f, "format {found} of a description; this version reads {}", super::FORMAT)
            }
            Self::Name(name) => write!(
                f,
                "`{name}` is no name in code: begin with a lower-case letter, go on with those, \
                 digits and `_`"
            ),
            Self::Title => {
                write!(f, "the title contains a control character; write it in one line")
            }
            Self::NoDevice => write!(f, "there is no device: a rigid hub needs no kernel"),
            Self::Twice(name) => write!(f, "two devices are called `{name}`: rename one"),
            Self::NotFinite(of, key, value) => {
                write!(f, "{of}: {key} contains {value}; state a finite number")
            }
            Self::NotPositive(of, key, value) => {
                write!(
                    f,
                    "{of}: {key} is {value}; a mass must be above zero, and no moment of inertia \
                     below it"
                )
            }
            Self::NotSymmetric(of) => write!(f, "{of}: inertia is not symmetric"),
            Self::Mount(of) => write!(
                f,
                "{of}: the columns of mount are not those of a rotation within 4096 epsilons; \
                 state more digits"
            ),
        }
    }
}

impl std::error::Error for DescriptionError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Syntax(error) => Some(error),
            Self::Write(error) => Some(error),
            _ => None,
        }
    }
}
