//! The child body of a joint: its names, and the patterns of its centre of mass and its inertia.

use super::{Equations, Triple};
use crate::space::{Axis, ENTRIES};

/// A rigid body.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    /// What it is, in words.
    pub title: &'static str,
    /// Its frame: axes `gox goy goz`, angular velocity `omega_go_n`.
    pub frame: &'static str,
    /// Its origin, as a point: `r_goc_go`.
    pub origin: &'static str,
    /// The paper's names of its axes.
    pub triad: [&'static str; 3],
    /// Its centre of mass, as a point: `r_goc_b`.
    pub point: &'static str,
    /// Its mass; none of a link without a body.
    pub mass: Option<&'static str>,
    /// Where its centre of mass lies from its origin, in its own axes.
    pub centre: Centre,
    /// Its inertia about its own centre of mass, in its own axes.
    pub inertia: Inertia,
    /// The paper's letters for body and point, `Gᵒ` and `Gᵒ_c`.
    pub letters: [&'static str; 2],
    /// Where the paper states its quantities.
    pub equations: Equations,
}

/// The pattern of a centre of mass.
#[derive(Clone, Copy, Debug)]
pub enum Centre {
    /// Anywhere.
    Free(Triple),
    /// On one axis of the body, at this distance.
    On(Axis, &'static str),
    /// On the origin.
    At,
}

/// The pattern of an inertia, with the stem of its names: `i_go_11`.
#[derive(Clone, Copy, Debug)]
pub enum Inertia {
    /// Three moments and three products.
    Full(&'static str),
    /// Three moments.
    Diagonal(&'static str),
    /// The same from every angle about an axis: an axial and a transverse moment.
    Symmetric(Axis, &'static str),
    /// None: a point mass, or no body.
    Point,
}

impl Body {
    /// Whether it is the same from every angle about `axis` through its origin.
    #[must_use]
    pub fn is_symmetric_about(&self, axis: Axis) -> bool {
        let centred = match self.centre {
            Centre::Free(_) => false,
            Centre::On(along, _) => along == axis,
            Centre::At => true,
        };
        let shaped = match self.inertia {
            Inertia::Full(_) | Inertia::Diagonal(_) => false,
            Inertia::Symmetric(about, _) => about == axis,
            Inertia::Point => true,
        };
        centred && shaped
    }
}

impl Inertia {
    /// Names of the entries 11, 12, 13, 22, 23, 33, none where an entry is zero. Equal moments
    /// have one name, that of the first.
    #[must_use]
    pub fn names(self) -> [Option<String>; 6] {
        let moments = |stem: &str, rows: [usize; 3]| {
            let [first, second, third] = rows.map(|row| Some(format!("{stem}_{row}{row}")));
            [first, None, None, second, None, third]
        };
        match self {
            Self::Full(stem) => ENTRIES.map(|entry| Some(format!("{stem}_{entry}"))),
            Self::Diagonal(stem) => moments(stem, [1, 2, 3]),
            Self::Symmetric(Axis::X, stem) => moments(stem, [1, 2, 2]),
            Self::Symmetric(Axis::Y, stem) => moments(stem, [1, 2, 1]),
            Self::Symmetric(Axis::Z, stem) => moments(stem, [1, 1, 3]),
            Self::Point => Default::default(),
        }
    }
}
