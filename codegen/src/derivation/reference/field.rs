//! A field of acceleration `G r` on every body, by its centre of mass and its second moment.

use super::{BodyInHub, bodies};
use crate::derivation::chain::Chain;
use crate::derivation::chain::wrench::Wrench;
use crate::derivation::recursions::gravity::gradient;
use crate::graph::Expr;
use crate::space::{Axis, Hub, Symmetric, Vector};

/// On each body, about its joint's origin, expressed in B: `m G r` at the centre of mass, and what
/// the field does to the mass around it.
#[must_use]
pub fn wrenches<'g>(chain: &Chain<'g>) -> Vec<Wrench<'g, Hub>> {
    let gradient = gradient(chain.graph);
    let on = |body: BodyInHub<'g>| {
        let force = body.mass * gradient.times(body.r);
        let couple = turning(body.inertia.second_moment(), gradient);
        Wrench { force, moment: couple + (body.r - body.origin()).cross(force) }
    };
    bodies(chain).into_iter().map(on).collect()
}

/// `integral of r r^T dm` of all bodies, about B.
#[must_use]
pub fn second_moment<'g>(chain: &Chain<'g>) -> Symmetric<'g, Hub> {
    let half = chain.graph.constant(2).recip();
    bodies(chain).into_iter().fold(Symmetric::zero(chain.graph), |sum, body| {
        let spread = (half * body.mass) * Symmetric::outer_pair(body.r, body.r);
        sum + body.inertia.second_moment() + spread
    })
}

/// The potential `-1/2 G : S` with its sign turned, for the second moment S about B.
#[must_use]
pub fn work_of<'g>(second_moment: Symmetric<'g, Hub>, gradient: Symmetric<'g, Hub>) -> Expr<'g> {
    let graph = gradient.trace().graph();
    let products = PLACES.map(|(i, j)| gradient.at(i, j) * second_moment.at(i, j));
    graph.constant(2).recip() * products.into_iter().fold(graph.zero(), |sum, term| sum + term)
}

/// `eps_ijk (S G)_jk`, entry by entry: the integral of `r x G r dm`.
#[must_use]
pub fn turning<'g>(s: Symmetric<'g, Hub>, g: Symmetric<'g, Hub>) -> Vector<'g, Hub> {
    let product = |j: usize, k: usize| {
        (0..3).fold(s.trace().graph().zero(), |sum, l| sum + s.at(j, l) * g.at(l, k))
    };
    Vector::new([Axis::X, Axis::Y, Axis::Z].map(|axis| {
        let [_, j, k] = axis.cycle();
        product(j, k) - product(k, j)
    }))
}

/// Every place of a tensor of second order.
const PLACES: [(usize, usize); 9] =
    [(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2), (2, 0), (2, 1), (2, 2)];
