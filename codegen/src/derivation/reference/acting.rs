//! What acts on the bodies, as sums over them and as virtual work.

use super::bodies;
use crate::derivation::chain::Chain;
use crate::derivation::chain::wrench::Wrench;
use crate::graph::Expr;
use crate::space::{Hub, Vector};

/// The sum of what acts on the bodies from the k-th on, each about its own joint's origin, moved to
/// that of joint k. Along B.
#[must_use]
pub fn at_joint<'g>(chain: &Chain<'g>, acting: &[Wrench<'g, Hub>], k: usize) -> Wrench<'g, Hub> {
    sum(chain, acting, k, bodies(chain)[k].origin())
}

/// The sum of all, moved to B.
#[must_use]
pub fn on_hub<'g>(chain: &Chain<'g>, acting: &[Wrench<'g, Hub>]) -> Wrench<'g, Hub> {
    sum(chain, acting, 0, Vector::zero(chain.graph))
}

fn sum<'g>(
    chain: &Chain<'g>,
    acting: &[Wrench<'g, Hub>],
    k: usize,
    about: Vector<'g, Hub>,
) -> Wrench<'g, Hub> {
    let moved = |(body, own): (super::BodyInHub<'g>, &Wrench<'g, Hub>)| Wrench {
        moment: own.moment + (body.origin() - about).cross(own.force),
        ..*own
    };
    let behind = bodies(chain).into_iter().zip(acting).skip(k).map(moved);
    behind.fold(Wrench::zero(chain.graph), Wrench::plus)
}

/// Virtual work per change of each joint's coordinate q: `sum F . dp'/dq' + N . d omega/dq'`, where
/// p is the origin about which the body's moment is given.
#[must_use]
pub fn virtual_work<'g>(chain: &Chain<'g>, acting: &[Wrench<'g, Hub>]) -> Vec<Expr<'g>> {
    let work = |rate: Expr<'g>| {
        let each = bodies(chain).into_iter().zip(acting).map(|(body, own)| {
            let velocity = body.origin().component_rates();
            own.force.dot(velocity.partial(rate)) + own.moment.dot(body.omega_b.partial(rate))
        });
        each.fold(chain.graph.zero(), |sum, work| sum + work)
    };
    chain.links.iter().map(|link| work(link.rate)).collect()
}
