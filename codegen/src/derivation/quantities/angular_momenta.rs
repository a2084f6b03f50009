//! Section 3.2: angular momenta about B and their inertial derivatives, expressed in B.
//!
//! H is relative to B: `H_{k,B} = [I_k] omega_{k/N} + m r x r_dot` with the inertial derivative of
//! the position *from B*. It is differentiated directly: its components in B, and the transport
//! theorem with omega; the paper's (25) to (74) rearrange what comes out.

use super::List;
use crate::derivation::chain::Chain;
use crate::derivation::reference::{BodyInHub, bodies, hub_body};
use crate::space::{Hub, Symmetric, Vector};

/// A body's position and momenta with their inertial derivatives.
pub(super) struct Momentum<'g> {
    r_dot: Vector<'g, Hub>,
    pub(super) r_ddot: Vector<'g, Hub>,
    /// About the body's own centre of mass.
    h_c: Vector<'g, Hub>,
    pub(super) h_c_dot: Vector<'g, Hub>,
    h_b: Vector<'g, Hub>,
    h_b_dot: Vector<'g, Hub>,
}

impl<'g> Momentum<'g> {
    /// Of a body, with B turning at `omega`.
    pub(super) fn of_body(body: &BodyInHub<'g>, omega: Vector<'g, Hub>) -> Self {
        let r_dot = body.r.prime(omega);
        let h_c = body.inertia.times(omega + body.omega_b);
        let h_b = h_c + body.mass * body.r.cross(r_dot);
        Self {
            r_dot,
            r_ddot: r_dot.prime(omega),
            h_c,
            h_c_dot: h_c.prime(omega),
            h_b,
            h_b_dot: h_b.prime(omega),
        }
    }
}

/// (20) to (76): hub, gimbals, wheel, and their sum.
pub(super) fn angular_momenta<'g>(chain: &Chain<'g>, list: &mut List<'g>) {
    let hub = &chain.hub;
    let of_hub = Momentum::of_body(&hub_body(chain), hub.omega);
    // (26); (23), (24); (25), (27), (28), (30).
    list.vector("r_bc_b_ddot", of_hub.r_ddot, 0);
    list.vector("h_b_bc", of_hub.h_c, 0);
    list.vector("h_b_b", of_hub.h_b, 0);
    list.vector("h_b_b_dot", of_hub.h_b_dot, 0);
    let mut h_sc_b = of_hub.h_b;
    let mut i_sc_b = hub.i_b_bc + hub.m_b * Symmetric::tilde_squared(hub.r_bc_b);
    for (body, link) in bodies(chain).iter().zip(chain.kind.links) {
        let (frame, point) = (link.body.frame, link.body.point);
        let of_body = Momentum::of_body(body, hub.omega);
        // (68) of the wheel; (38), (53), (69).
        list.vector(&format!("r_{point}_b_dot"), of_body.r_dot, 0);
        list.vector(&format!("r_{point}_b_ddot"), of_body.r_ddot, 0);
        // (32), (45), (60); (84), (85), (86), (104), (105), (120).
        list.vector(&format!("h_{frame}_{point}"), of_body.h_c, 0);
        list.vector(&format!("h_{frame}_{point}_dot"), of_body.h_c_dot, 0);
        // (33), (46), (61).
        list.vector(&format!("h_{frame}_b"), of_body.h_b, 0);
        // (34), (39), (41), (43); (47), (54), (56), (58); (62), (70), (72), (74).
        list.vector(&format!("h_{frame}_b_dot"), of_body.h_b_dot, 0);
        h_sc_b = h_sc_b + of_body.h_b;
        i_sc_b = i_sc_b + body.inertia + body.mass * Symmetric::tilde_squared(body.r);
    }
    // (20); (21), (22).
    list.vector("h_sc_b", h_sc_b, 0);
    let h_sc_b_dot = h_sc_b.prime(hub.omega);
    list.vector("h_sc_b_dot", h_sc_b_dot, 0);
    // (75): L_B from Euler's law for the whole, about the moving point B.
    let mc = hub.m_sc * list.hub_vector("c");
    list.vector("torque_b", h_sc_b_dot + mc.cross(list.hub_vector("r_b_n_ddot")), 0);
    // (76).
    list.tensor("i_sc_b", i_sc_b, 0);
}
