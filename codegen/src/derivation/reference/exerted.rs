//! What each parent body exerts: sums of mass times acceleration and of rates of angular momentum.

use super::{bodies, share};
use crate::derivation::chain::Chain;
use crate::derivation::chain::wrench::Wrench;
use crate::graph::Expr;
use crate::space::{Hub, Vector};

/// At each joint on the bodies outboard of it, about the joint's origin, expressed in B.
#[must_use]
pub fn joints<'g>(chain: &Chain<'g>) -> Vec<Wrench<'g, Hub>> {
    let behind = |k: usize| {
        let origin = bodies(chain)[k].origin();
        needed(chain, k, origin)
    };
    (0..chain.links.len()).map(behind).collect()
}

/// On the whole device, about B.
#[must_use]
pub fn whole<'g>(chain: &Chain<'g>) -> Wrench<'g, Hub> {
    needed(chain, 0, Vector::zero(chain.graph))
}

/// The bodies from the k-th on: `F = sum m r_ddot`, and about `origin`
/// `sum (r - origin) x m r_ddot + d([I] omega_{k/N})/dt`.
fn needed<'g>(chain: &Chain<'g>, k: usize, origin: Vector<'g, Hub>) -> Wrench<'g, Hub> {
    let (omega, r_b_n_ddot) = (chain.hub.omega, chain.hub.r_b_n_ddot);
    bodies(chain).into_iter().skip(k).fold(Wrench::zero(chain.graph), |sum, body| {
        let force = body.mass * (body.r.prime(omega).prime(omega) + r_b_n_ddot);
        let spin_rate = body.inertia.times(omega + body.omega_b).prime(omega);
        sum.plus(Wrench { force, moment: spin_rate + (body.r - origin).cross(force) })
    })
}

/// The motor torque of each joint: its row of `M [r_ddot_B; omega_dot; q_ddot] + rest`.
#[must_use]
pub fn motors<'g>(chain: &Chain<'g>) -> Vec<Expr<'g>> {
    let (share, hub) = (share(chain), &chain.hub);
    let entry = |i: usize, j: usize| share.joint[i.min(j)][i.max(j) - i.min(j)];
    let row = |i: usize| {
        let by_hub = share.force[i].dot(hub.r_b_n_ddot) + share.moment[i].dot(hub.omega_dot);
        let joints = chain.links.iter().enumerate();
        joints.fold(share.bias_joint[i] + by_hub, |sum, (j, link)| {
            sum + entry(i, j) * link.acceleration
        })
    };
    (0..chain.links.len()).map(row).collect()
}
