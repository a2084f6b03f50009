//! A derived vector or tensor with the link whose axes it is expressed in, to be expressed in any
//! other's.
//!
//! While the chain is processed, the frame is in the type. Where results of all links are listed
//! together, as the proof does, it becomes a number: zero for the hub, k for the body outboard of
//! joint k.

use super::Chain;
use crate::graph::Expr;
use crate::space::{BodyFrame, ParentFrame, Symmetric, Vector};

/// Components and the number of their frame.
#[derive(Clone, Copy)]
pub enum FramedValue<'g> {
    /// A number: the same in every frame.
    Scalar(Expr<'g>),
    /// A vector.
    Vector([Expr<'g>; 3], usize),
    /// A symmetric tensor: entries 11, 12, 13, 22, 23, 33.
    Tensor([Expr<'g>; 6], usize),
}

impl<'g> FramedValue<'g> {
    /// The same expressed in frame `target`.
    #[must_use]
    pub fn along(self, chain: &Chain<'g>, target: usize) -> Self {
        let mut now = self;
        loop {
            let Some(frame) = now.frame() else { return now };
            now = match frame.cmp(&target) {
                std::cmp::Ordering::Equal => return now,
                std::cmp::Ordering::Less => now.outwards(chain, frame),
                std::cmp::Ordering::Greater => now.inwards(chain, frame - 1),
            };
        }
    }

    /// Every stored number.
    #[must_use]
    pub fn components(self) -> Vec<Expr<'g>> {
        match self {
            Self::Scalar(e) => vec![e],
            Self::Vector(v, _) => v.to_vec(),
            Self::Tensor(t, _) => t.to_vec(),
        }
    }

    /// The frame whose axes it is expressed in.
    #[must_use]
    pub fn frame(self) -> Option<usize> {
        match self {
            Self::Scalar(_) => None,
            Self::Vector(_, frame) | Self::Tensor(_, frame) => Some(frame),
        }
    }

    /// Across joint `joint`, away from the hub.
    fn outwards(self, chain: &Chain<'g>, joint: usize) -> Self {
        let turn = chain.links[joint].turn;
        match self {
            Self::Scalar(_) => self,
            Self::Vector(v, _) => {
                let turned = Vector::<ParentFrame>::new(v).turned(turn);
                Self::Vector(turned.components(), joint + 1)
            }
            Self::Tensor(t, _) => {
                let turned = Symmetric::<ParentFrame>::new(t).turned(turn);
                Self::Tensor(turned.entries(), joint + 1)
            }
        }
    }

    /// Across joint `joint`, towards the hub.
    fn inwards(self, chain: &Chain<'g>, joint: usize) -> Self {
        let turn = chain.links[joint].turn.inverse();
        match self {
            Self::Scalar(_) => self,
            Self::Vector(v, _) => {
                let turned = Vector::<BodyFrame>::new(v).turned(turn);
                Self::Vector(turned.components(), joint)
            }
            Self::Tensor(t, _) => {
                let turned = Symmetric::<BodyFrame>::new(t).turned(turn);
                Self::Tensor(turned.entries(), joint)
            }
        }
    }

    /// Labelled components: `axes` names those of a vector; a tensor has nine entries.
    #[must_use]
    pub fn labelled(self, axes: &[String; 3]) -> Vec<(String, Expr<'g>)> {
        match self {
            Self::Scalar(e) => vec![(String::new(), e)],
            Self::Vector(v, _) => axes.iter().cloned().zip(v).collect(),
            Self::Tensor(t, _) => {
                let t = Symmetric::<BodyFrame>::new(t);
                let places = (0..3).flat_map(|i| (0..3).map(move |j| (i, j)));
                places.map(|(i, j)| (format!("{}{}", i + 1, j + 1), t.at(i, j))).collect()
            }
        }
    }
}
