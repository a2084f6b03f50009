//! The first joint's origin, seen from B: which axes it is expressed in, and what it adds.
//!
//! The hub's rotation accelerates that origin by `omega x (omega x o_1)`, and each joint row requires
//! its force for it, `F_j . o_1''`; the moment of that force about B has the arm `o_1`. Expressed in the
//! first body's axes, the acceleration is that of the first parent body and is in every row from there
//! on, and forces with a zero component have shorter moments. Expressed in B, each row takes a product
//! of its own, but nothing has to be turned.

use super::base_parameters::Based;
use crate::derivation::chain::{Chain, Coordinate};
use crate::space::{BodyFrame, ParentFrame, Vector};

/// The axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum OriginAxes {
    /// The first body's.
    FirstBody,
    /// Those of B.
    Hub,
}

impl OriginAxes {
    /// The axes in which fewer operations are needed: the first body's where the first joint slides, and
    /// where there are two rows or more and the next origins, too, are at other places.
    pub(super) fn choose<'g>(chain: &Chain<'g>, based: &Based<'g>) -> Self {
        let first = chain.first_moving();
        let slides = matches!(chain.links[first].coordinate, Coordinate::Length(_));
        let rows = chain.links.iter().filter(|link| link.mode.is_some()).count();
        let mut arms = based.links[first + 1..].iter().flat_map(|link| link.origin.components());
        let several = rows > 1 && arms.any(|arm| !arm.is_zero());
        if slides || several { Self::FirstBody } else { Self::Hub }
    }
}

/// The vector from B to that origin, given along the device's axes, expressed in the first body's.
pub(super) fn in_first_body_axes<'g>(
    chain: &Chain<'g>,
    reach: Vector<'g, ParentFrame>,
) -> Vector<'g, BodyFrame> {
    let first = chain.first_moving();
    let inboard = chain.links[..first].iter();
    let parent =
        inboard.fold(reach, |v, link| v.turned::<BodyFrame>(link.turn).relabelled_outboard());
    parent.turned(chain.links[first].turn)
}
