//! [`FmiVersion`]: the version of the standard that a unit follows.

use std::fmt;

/// A version of FMI.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FmiVersion {
    /// FMI 2.0.
    #[default]
    Two,
    /// FMI 3.0.
    Three,
}

impl FmiVersion {
    /// Both, in order.
    pub const ALL: [Self; 2] = [Self::Two, Self::Three];

    /// The version of its first number, 2 or 3.
    #[must_use]
    pub const fn of_number(number: u8) -> Option<Self> {
        match number {
            2 => Some(Self::Two),
            3 => Some(Self::Three),
            _ => None,
        }
    }

    /// As documents of the standard state it.
    #[must_use]
    pub const fn text(self) -> &'static str {
        match self {
            Self::Two => "2.0",
            Self::Three => "3.0",
        }
    }
}

impl fmt::Display for FmiVersion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "FMI {}", self.text())
    }
}
