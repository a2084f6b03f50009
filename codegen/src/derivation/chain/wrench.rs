//! A force with its moment, expressed in the current axes, about the current origin.

use super::framed_value::FramedValue;
use super::{Chain, Coordinate, Link};
use crate::derivation::script::{pairs, triple};
use crate::graph::{Expr, Graph};
use crate::space::{BodyFrame, Frame, Hub, Vector};

/// A force and its moment about the current origin.
#[derive(Clone, Copy)]
pub struct Wrench<'g, F> {
    /// The force.
    pub force: Vector<'g, F>,
    /// Its moment, with whatever acts without a force.
    pub moment: Vector<'g, F>,
}

impl<'g, F: Frame> Wrench<'g, F> {
    /// Nothing acts.
    #[must_use]
    pub fn zero(graph: &'g Graph) -> Self {
        Self { force: Vector::zero(graph), moment: Vector::zero(graph) }
    }

    /// Both act.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self { force: self.force + other.force, moment: self.moment + other.moment }
    }

    /// Force and moment by name: `f_rest_gox`, `n_rest_gox` for `rest` expressed in the axes of
    /// `go`.
    #[must_use]
    pub fn named(self, what: &str, frame: &str) -> Vec<(String, Expr<'g>)> {
        let part = |letter: char, v: Vector<'g, F>| {
            pairs(triple(&format!("{letter}_{what}"), frame), v.components())
        };
        part('f', self.force).chain(part('n', self.moment)).collect()
    }
}

impl<'g> Wrench<'g, BodyFrame> {
    /// Expressed in the parent body's axes, about its origin.
    #[must_use]
    pub fn in_parent_frame(self, link: &Link<'g>) -> Self {
        let force = self.force.turned(link.turn.inverse());
        let moment = self.moment.turned(link.turn.inverse()) + link.origin.cross(force);
        Self { force: force.relabelled_inboard(), moment: moment.relabelled_inboard() }
    }

    /// Its component along the joint: the moment about its axis, or the force along it.
    #[must_use]
    pub fn along(self, link: &Link<'g>) -> Expr<'g> {
        link.axis.dot(match link.coordinate {
            Coordinate::Angle(_) => self.moment,
            Coordinate::Length(_) => self.force,
        })
    }

    /// Of the body outboard of joint k: expressed in B, about the same origin.
    #[must_use]
    pub fn along_b(self, chain: &Chain<'g>, k: usize) -> Wrench<'g, Hub> {
        let along = |v: Vector<'g, BodyFrame>| resolved(v.components(), k + 1, chain, 0);
        Wrench { force: along(self.force), moment: along(self.moment) }
    }
}

impl<'g> Wrench<'g, Hub> {
    /// Expressed in frame `target`, zero for the hub, k for that outboard of joint k; about the
    /// same origin.
    #[must_use]
    pub fn resolved(self, chain: &Chain<'g>, target: usize) -> Wrench<'g, BodyFrame> {
        let along = |v: Vector<'g, Hub>| resolved(v.components(), 0, chain, target);
        Wrench { force: along(self.force), moment: along(self.moment) }
    }
}

/// A vector expressed in one frame, from its components in another.
fn resolved<'g, F: Frame>(
    v: [Expr<'g>; 3],
    from: usize,
    chain: &Chain<'g>,
    to: usize,
) -> Vector<'g, F> {
    match FramedValue::Vector(v, from).along(chain, to) {
        FramedValue::Vector(v, _) => Vector::new(v),
        _ => unreachable!("a vector stays a vector"),
    }
}
