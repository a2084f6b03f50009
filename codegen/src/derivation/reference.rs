//! Mass matrix, bias and momenta as sums over the bodies, everything expressed in B.
//!
//! B's axes do not turn for an observer on B, so primes are plain time derivatives of components
//! here and no transport theorem is used: an independent derivation of what [`super::chain::motion`],
//! [`super::recursions::composite`] and [`super::inward_pass`] build in local frames. It expands to many terms and
//! is never emitted.
//!
//! Newton and Euler per body, as in (25), (34), (47), (62) of the paper; the joint rows are the
//! projections (80), (101), (119) of the same forces and moments on the bodies outboard of each
//! joint.

pub mod acting;
pub mod boltzmann_hamel;
pub mod exerted;
pub mod field;

use super::chain::Chain;
use super::share::{Momenta, Share};
use crate::graph::{Expr, Graph, Stage};
use crate::kinds::Motion;
use crate::space::{Frame, Hub, Symmetric, Vector};

/// One body and its motion, expressed in B.
pub struct BodyInHub<'g> {
    /// Mass.
    pub mass: Expr<'g>,
    /// Centre of mass from B.
    pub r: Vector<'g, Hub>,
    /// Its axes: the columns of its rotation.
    pub axes: [Vector<'g, Hub>; 3],
    /// Angular velocity with respect to B.
    pub omega_b: Vector<'g, Hub>,
    /// Inertia about the centre of mass.
    pub inertia: Symmetric<'g, Hub>,
    /// The joints up to this body.
    pub joints: Vec<JointInHub<'g>>,
}

/// A joint, expressed in B.
#[derive(Clone, Copy)]
pub struct JointInHub<'g> {
    /// Whether it turns or slides.
    pub motion: Motion,
    /// Its axis: `a_i`.
    pub axis: Vector<'g, Hub>,
    /// Its origin: `p_i`.
    pub origin: Vector<'g, Hub>,
}

impl<'g> JointInHub<'g> {
    /// Angular velocity of its child body, per rate: the axis, or zero.
    #[must_use]
    pub fn spin(&self) -> Vector<'g, Hub> {
        match self.motion {
            Motion::Turn(_) => self.axis,
            Motion::Slide(_) => Vector::zero(self.axis.components()[0].graph()),
        }
    }

    /// Velocity of a point of its child body at `r`, per rate: `a x (r - p)`, or the axis.
    #[must_use]
    pub fn arm(&self, r: Vector<'g, Hub>) -> Vector<'g, Hub> {
        match self.motion {
            Motion::Turn(_) => self.axis.cross(r - self.origin),
            Motion::Slide(_) => self.axis,
        }
    }
}

/// The hub, as a body without a joint.
#[must_use]
pub fn hub_body<'g>(chain: &Chain<'g>) -> BodyInHub<'g> {
    BodyInHub {
        mass: chain.hub.m_b,
        r: chain.hub.r_bc_b,
        axes: unit_axes(chain.graph),
        omega_b: Vector::zero(chain.graph),
        inertia: chain.hub.i_b_bc,
        joints: Vec::new(),
    }
}

/// Every body of the chain, from the hub outwards.
#[must_use]
pub fn bodies<'g>(chain: &Chain<'g>) -> Vec<BodyInHub<'g>> {
    let graph = chain.graph;
    // Columns of the rotation: the axes of the current frame, expressed in B.
    let mut axes = if chain.mount_is_turned() { chain.mount } else { unit_axes(graph) };
    let mut origin = Vector::zero(graph);
    let mut omega_b = Vector::zero(graph);
    let mut joints = Vec::new();
    let mut made = Vec::new();
    for (link, data) in chain.links.iter().zip(chain.kind.links) {
        origin = origin + link.origin.along(axes);
        // New axes: the old ones times the elementary rotation, column by column.
        let back = link.coordinate.turn(graph).inverse();
        let elementary = unit_axes(graph).map(|e| e.turned(back));
        axes = elementary.map(|column| column.along(axes));
        let joint = JointInHub { motion: data.joint.motion, axis: link.axis.along(axes), origin };
        omega_b = omega_b + link.rate * joint.spin();
        joints.push(joint);
        made.push(BodyInHub {
            mass: link.mass,
            r: origin + link.centre.along(axes),
            axes,
            omega_b,
            inertia: link.inertia.along(axes),
            joints: joints.clone(),
        });
    }
    made
}

impl<'g> BodyInHub<'g> {
    /// Origin of its joint; B for the hub.
    #[must_use]
    pub fn origin(&self) -> Vector<'g, Hub> {
        self.joints.last().map_or(Vector::zero(self.mass.graph()), |joint| joint.origin)
    }
}

fn unit_axes<F: Frame>(graph: &Graph) -> [Vector<'_, F>; 3] {
    use crate::space::Axis::{X, Y, Z};
    [X, Y, Z].map(|axis| Vector::unit(graph, axis))
}

/// The device's share of the mass matrix and of the bias.
#[must_use]
pub fn share<'g>(chain: &Chain<'g>) -> Share<'g> {
    let graph = chain.graph;
    let joints = chain.links.len();
    let omega = chain.hub.omega;
    let zero = Vector::zero(graph);
    let mut share = Share {
        mass: graph.zero(),
        first_moment: zero,
        inertia: Symmetric::zero(graph),
        force: vec![zero; joints],
        moment: vec![zero; joints],
        joint: (0..joints).map(|i| vec![graph.zero(); joints - i]).collect(),
        perpendicular: None,
        bias_force: zero,
        bias_moment: zero,
        bias_joint: vec![graph.zero(); joints],
    };
    for body in bodies(chain) {
        let (m, r, i) = (body.mass, body.r, body.inertia);
        let r_prime = r.component_rates();
        let at_rest = |v: Vector<'g, Hub>| v.without(Stage::Acceleration);
        // (38), (53), (69): r'' + 2 omega x r' + omega x (omega x r), joints not accelerating.
        let turning = omega.cross(r_prime);
        let acceleration =
            at_rest(r_prime.component_rates()) + turning + turning + omega.cross(omega.cross(r));
        let force = m * acceleration;
        // (34), (47), (62): [I] omega_{k/B}' + [I]' omega_{k/N} + omega x [I] omega_{k/N}.
        let omega_n = omega + body.omega_b;
        let moment = i.times(at_rest(body.omega_b.component_rates()))
            + i.component_rates().times(omega_n)
            + omega.cross(i.times(omega_n));

        share.mass = share.mass + m;
        share.first_moment = share.first_moment + m * r;
        share.inertia = share.inertia + i + m * Symmetric::tilde_squared(r);
        share.bias_force = share.bias_force + force;
        share.bias_moment = share.bias_moment + moment + r.cross(force);
        for (k, joint) in body.joints.iter().enumerate() {
            let (spin_k, arm_k) = (joint.spin(), joint.arm(r));
            share.force[k] = share.force[k] + m * arm_k;
            share.moment[k] = share.moment[k] + i.times(spin_k) + m * r.cross(arm_k);
            share.bias_joint[k] = share.bias_joint[k] + spin_k.dot(moment) + arm_k.dot(force);
            for (l, joint) in body.joints.iter().enumerate().skip(k) {
                let (spin_l, arm_l) = (joint.spin(), joint.arm(r));
                let entry = spin_k.dot(i.times(spin_l)) + m * arm_k.dot(arm_l);
                share.joint[k][l - k] = share.joint[k][l - k] + entry;
            }
        }
    }
    share
}

/// Angular momentum about B by velocities relative to B, where the hub turns at `omega`.
#[must_use]
pub fn relative_angular_momentum<'g>(chain: &Chain<'g>, omega: Vector<'g, Hub>) -> Vector<'g, Hub> {
    bodies(chain).into_iter().fold(Vector::zero(chain.graph), |sum, body| {
        let velocity = body.r.component_rates() + omega.cross(body.r);
        let spin = body.inertia.times(omega + body.omega_b);
        sum + spin + body.mass * body.r.cross(velocity)
    })
}

/// The device's share of energy and momenta.
#[must_use]
pub fn momenta<'g>(chain: &Chain<'g>) -> Momenta<'g> {
    let graph = chain.graph;
    let (omega, r_b_n_dot) = (chain.hub.omega, chain.hub.r_b_n_dot);
    let mut sum =
        Momenta { energy: graph.zero(), linear: Vector::zero(graph), angular: Vector::zero(graph) };
    let half = graph.constant(2).recip();
    for body in bodies(chain) {
        let velocity = r_b_n_dot + body.r.component_rates() + omega.cross(body.r);
        let omega_n = omega + body.omega_b;
        let linear = body.mass * velocity;
        let spin = body.inertia.times(omega_n);
        sum.energy = sum.energy + half * (velocity.dot(linear) + omega_n.dot(spin));
        sum.linear = sum.linear + linear;
        sum.angular = sum.angular + spin + body.r.cross(linear);
    }
    sum
}
