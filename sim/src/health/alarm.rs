//! [`MethodAlarm`]: an alarm of a [`Method`].

use std::fmt;

/// A method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// `precess watch`.
    Watch,
    /// A threshold on amplitudes near rotation frequencies, steps of means and slopes.
    Spectrum,
    /// An observer whose model has balanced wheels.
    Observer,
}

impl Method {
    /// All.
    pub const ALL: [Self; 3] = [Self::Watch, Self::Spectrum, Self::Observer];
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Watch => "watch",
            Self::Spectrum => "FFT threshold",
            Self::Observer => "balanced observer",
        })
    }
}

/// An alarm of a method.
#[derive(Clone, Debug, PartialEq)]
pub struct MethodAlarm {
    /// Which method.
    pub method: Method,
    /// When it was raised, s.
    pub time: f64,
    /// What has changed.
    pub name: String,
    /// The device, joint or axis.
    pub place: String,
    /// By how much, and half the width of its interval of 95 %, SI units; none of a method that has none.
    pub change: Option<[f64; 2]>,
}
