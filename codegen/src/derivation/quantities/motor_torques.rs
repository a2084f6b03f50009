//! Section 3.3: the torque across each joint, from Euler's law for the bodies outboard.
//!
//! For joint k and the assembly A of all bodies outboard, expressed in B: the torque about the
//! joint's origin p is `sum d([I] omega)/dt + (r - p) x m r_ddot_{/N}`. The paper takes it about
//! A's centre of mass first; those quantities are derived here as well, from their definitions.

use super::List;
use super::angular_momenta::Momentum;
use crate::derivation::chain::Chain;
use crate::derivation::reference::{BodyInHub, bodies};
use crate::graph::Expr;
use crate::kinds::Motion;
use crate::space::{Hub, Vector};

/// (77) to (121) for every joint.
pub(super) fn motor_torques<'g>(chain: &Chain<'g>, list: &mut List<'g>) {
    let r_b_n_ddot = list.hub_vector("r_b_n_ddot");
    let all = bodies(chain);
    for k in 0..chain.links.len() {
        let body = &chain.kind.links[k].body;
        let title = format!("Torque across the joint of the {}", body.title);
        list.chapter(&title, body.equations.torque);
        joint(chain, k, &all[k..], r_b_n_ddot, list);
    }
}

fn joint<'g>(
    chain: &Chain<'g>,
    k: usize,
    behind: &[BodyInHub<'g>],
    r_b_n_ddot: Vector<'g, Hub>,
    list: &mut List<'g>,
) {
    let omega = chain.hub.omega;
    let (link, data) = (&chain.links[k], &chain.kind.links[k]);
    let (assembly, origin) = (data.assembly, data.body.origin);
    let own = behind[0].joints[k];
    let p = own.origin;
    let m_a = link.assembly_mass;
    let zero = Vector::zero(chain.graph);
    let first_moment = behind.iter().fold(zero, |sum, b| sum + b.mass * (b.r - p));
    let tip = behind.len() == 1;
    let r_ac = if tip { behind[0].r - p } else { m_a.recip() * first_moment };
    let r_ac_b = r_ac + p;
    let r_ac_n_ddot = r_ac_b.prime(omega).prime(omega) + r_b_n_ddot;
    if !tip {
        // (89), (90), (91); (108), (109), (110).
        shares(chain, k, list);
        let stem = format!("r_{assembly}c_{origin}");
        primes(&stem, r_ac, list);
        // (96), (97); (114), (115).
        let stem = format!("r_{assembly}c_b");
        primes(&stem, r_ac_b, list);
        list.vector(&format!("{stem}_dot"), r_ac_b.prime(omega), 0);
        list.vector(&format!("{stem}_ddot"), r_ac_b.prime(omega).prime(omega), 0);
    }
    // (95), (113), (121).
    list.vector(&format!("r_{assembly}c_n_ddot"), r_ac_n_ddot, 0);

    let mut about_centre = zero;
    let mut about_origin = zero;
    let mut whole_force = zero;
    for (body, data) in behind.iter().zip(&chain.kind.links[k..]) {
        let (frame, point) = (data.body.frame, data.body.point);
        let of_body = Momentum::of_body(body, omega);
        let arm = body.r - r_ac_b;
        let arm_ddot = arm.prime(omega).prime(omega);
        let h_dot = of_body.h_c_dot + body.mass * arm.cross(arm_ddot);
        if !tip {
            // (87), (88), (106), (107); (81), (82), (83), (102), (103).
            list.vector(&format!("r_{point}_{assembly}c"), arm, 0);
            list.vector(&format!("r_{point}_{assembly}c_ddot"), arm_ddot, 0);
            list.vector(&format!("h_{frame}_{assembly}c_dot"), h_dot, 0);
        }
        about_centre = about_centre + h_dot;
        let force = body.mass * (of_body.r_ddot + r_b_n_ddot);
        about_origin = about_origin + of_body.h_c_dot + (body.r - p).cross(force);
        whole_force = whole_force + force;
    }
    // (79), (100), (118); (78), (99), (117); (80), (101), (119).
    let about = if tip { format!("l_{assembly}c") } else { format!("l_{assembly}") };
    list.vector(&about, about_centre, 0);
    list.vector(&format!("l_{origin}"), about_origin, 0);
    let along = match own.motion {
        Motion::Turn(_) => about_origin,
        Motion::Slide(_) => whole_force,
    };
    list.scalar(data.joint.torque, own.axis.dot(along));
}

/// (92) to (94), (111), (112): each body's share of the assembly's mass.
fn shares<'g>(chain: &Chain<'g>, k: usize, list: &mut List<'g>) {
    let per_a: Expr<'g> = chain.links[k].assembly_mass.recip();
    for (body, data) in chain.links[k..].iter().zip(&chain.kind.links[k..]) {
        let frame = data.body.frame;
        // The outer body belongs to one assembly only; the others need to say which.
        let name = if frame == chain.kind.links[0].body.frame {
            format!("rho_{frame}")
        } else {
            format!("rho_{frame}_{}", chain.kind.links[k].assembly)
        };
        list.scalar(&name, body.mass * per_a);
    }
}

/// A vector and its first two derivatives seen from B.
fn primes<'g>(stem: &str, v: Vector<'g, Hub>, list: &mut List<'g>) {
    let prime = v.component_rates();
    list.vector(stem, v, 0);
    list.vector(&format!("{stem}_prime"), prime, 0);
    list.vector(&format!("{stem}_dprime"), prime.component_rates(), 0);
}
