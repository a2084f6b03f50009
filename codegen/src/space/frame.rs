//! The frames of a chain and the elementary rotation between two of them.
//!
//! A device is a chain of any length, so its frames have no fixed names here. One link at a time,
//! there are three: the hub's, the parent body's ([`ParentFrame`]), and the child body's ([`BodyFrame`]).
//! [`super::Vector::relabelled_outboard`] is the one place where a frame changes its role.

use std::marker::PhantomData;

use crate::graph::{Expr, Graph};

/// A frame of reference, as a type.
pub trait Frame: Copy {}

/// B, with axes along those of the first joint, next to the hub, at zero angle; the mount is
/// applied outside.
#[derive(Clone, Copy, Debug)]
pub struct Hub;

/// The frame of a joint's parent body, which may be the hub.
#[derive(Clone, Copy, Debug)]
pub struct ParentFrame;

/// The frame of the joint's child body.
#[derive(Clone, Copy, Debug)]
pub struct BodyFrame;

impl Frame for Hub {}
impl Frame for ParentFrame {}
impl Frame for BodyFrame {}

/// A coordinate axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// First.
    X,
    /// Second.
    Y,
    /// Third.
    Z,
}

impl Axis {
    /// Zero-based index of the axis itself and of the two that follow it cyclically.
    #[must_use]
    pub fn cycle(self) -> [usize; 3] {
        match self {
            Self::X => [0, 1, 2],
            Self::Y => [1, 2, 0],
            Self::Z => [2, 0, 1],
        }
    }
}

/// The rotation by a joint angle about a coordinate axis: `From` axes turned into `To` axes.
///
/// Columns of its matrix are the new axes in the old frame: `W = Gi * Rx(theta)`.
#[derive(Clone, Copy)]
pub struct Turn<'g, From, To> {
    pub(super) axis: Axis,
    pub(super) sin: Expr<'g>,
    pub(super) cos: Expr<'g>,
    frames: PhantomData<(From, To)>,
}

impl<'g, From: Frame, To: Frame> Turn<'g, From, To> {
    /// The turn about `axis` by the angle with this sine and cosine.
    #[must_use]
    pub fn about(axis: Axis, sin: Expr<'g>, cos: Expr<'g>) -> Self {
        Self { axis, sin, cos, frames: PhantomData }
    }

    /// No turn at all: `To` axes are parallel to those of `From`.
    #[must_use]
    pub fn none(graph: &'g Graph) -> Self {
        Self::about(Axis::X, graph.zero(), graph.constant(1))
    }

    /// Whether the axes stay parallel.
    #[must_use]
    pub fn is_none(self) -> bool {
        self.sin.is_zero()
    }

    /// Its axis and the two after it, cyclically; sine and cosine.
    #[must_use]
    pub(crate) fn plane(self) -> ([usize; 3], [Expr<'g>; 2]) {
        (self.axis.cycle(), [self.sin, self.cos])
    }

    /// `d e / d angle`: through the sine and the cosine.
    #[must_use]
    pub fn partial(self, e: Expr<'g>) -> Expr<'g> {
        self.cos * e.partial(self.sin) - self.sin * e.partial(self.cos)
    }

    /// The turn back.
    #[must_use]
    pub fn inverse(self) -> Turn<'g, To, From> {
        Turn::about(self.axis, -self.sin, self.cos)
    }
}
