//! [`Effect`]: what a [`Slip`] does to a run of Table 1.

use std::fmt;

use precess_codegen::page::{Block, Note};

/// Drifts below this are the integrator's. A slip that does not change (16) and (75) cannot disturb the
/// momenta, and such runs drift by 8e-11; the smallest drift that a slip causes is 3e-9.
pub const RESOLUTION: f64 = 1e-9;

/// What a printed form does to a run of Table 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Effect {
    /// No path leads from it to the assembled equations.
    Unchanged,
    /// It enters them, but Table 1 sets every term to zero in which they differ.
    Vanishes,
    /// The run drifts.
    Drift(Drift),
    /// The run blows up.
    Diverges {
        /// Time, s.
        at: f64,
    },
    /// The equations do not determine the accelerations.
    Singular {
        /// Time, s.
        at: f64,
    },
}

/// The largest departures from the start, each in its own unit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Drift {
    /// Energy less work; unit: largest kinetic energy plus integral of sum |u rate|.
    pub energy: f64,
    /// Linear momentum; unit: sum over the bodies of magnitudes.
    pub linear: f64,
    /// Angular momentum about the centre of mass; unit likewise.
    pub angular: f64,
}

/// Some of the differences of a printed block.
#[derive(Clone, Debug)]
pub struct Slip<'a> {
    /// The block.
    pub block: &'a Block,
    /// Those of its notes whose change is made; the rest of the block is right.
    pub notes: Vec<&'a Note>,
}

impl fmt::Display for Effect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unchanged => write!(f, "does not enter the assembled equations"),
            Self::Vanishes => write!(f, "vanishes with Table 1's numbers"),
            Self::Drift(drift) => drift.fmt(f),
            Self::Diverges { at } => write!(f, "diverges after {at:.2} s"),
            Self::Singular { at } => write!(f, "singular after {at:.2} s"),
        }
    }
}

impl fmt::Display for Drift {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts = [("energy", self.energy), ("linear", self.linear), ("angular", self.angular)];
        let figure = |(name, drift): (&str, f64)| {
            if drift < RESOLUTION {
                format!("{name} below {RESOLUTION:.0e}")
            } else {
                format!("{name} {drift:.1e}")
            }
        };
        write!(f, "{}", parts.map(figure).join(", "))
    }
}
