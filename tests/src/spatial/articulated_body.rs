//! The articulated-body algorithm over one chain: Featherstone, chapter 7.
//!
//! `v` is a link's velocity, `c` the part of its acceleration that its joint's rate gives, `I^A`
//! and `p^A` inertia and bias force of the link with all that hangs on it, joints free:
//! the force that its parent must exert is `I^A a + p^A`.

use precess_dynamics::Scalar;

use super::algebra::{Matrix, Spatial, force_cross, motion_cross};
use super::links::Link;

/// A link with all that hangs on it.
#[derive(Clone, Debug)]
pub(super) struct Articulated<T> {
    /// Its articulated inertia at the parent, with its joint free.
    pub(super) seen: Articulation<T>,
    link: Link<T>,
    /// The acceleration `c` due to rates.
    c: Spatial<T>,
    /// `U = I^A S`, the force that a unit of the joint's acceleration takes.
    u: Spatial<T>,
    /// `1 / D`, with `D = S^T U`.
    d_inverse: T,
    /// The torque that is left for acceleration, `tau - S^T p^A`.
    free_torque: T,
    beyond: Option<Box<Self>>,
}

/// An articulated inertia and its bias force, in some coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Articulation<T> {
    pub(super) inertia: Matrix<T>,
    pub(super) bias: Spatial<T>,
}

impl<T: Scalar> Articulated<T> {
    /// A chain of three on a parent that moves at `parent_velocity`.
    pub(super) fn chain([outer, inner, wheel]: [Link<T>; 3], parent_velocity: Spatial<T>) -> Self {
        Self::new(outer, &[inner, wheel], parent_velocity)
    }

    fn new(link: Link<T>, beyond: &[Link<T>], parent_velocity: Spatial<T>) -> Self {
        // Outwards.
        let Link { from_parent, axis, rate, torque, inertia } = link;
        let joint_velocity = axis * rate;
        let v = from_parent * parent_velocity + joint_velocity;
        let c = motion_cross(v, joint_velocity);
        let own = Articulation { inertia, bias: force_cross(v, inertia * v) };

        let beyond = beyond.split_first().map(|(next, rest)| Box::new(Self::new(*next, rest, v)));

        // Inwards.
        let Articulation { inertia, bias } = beyond.as_ref().map_or(own, |next| Articulation {
            inertia: own.inertia + next.seen.inertia,
            bias: own.bias + next.seen.bias,
        });
        let u = inertia * axis;
        let d_inverse = axis.dot(u).recip();
        let free_torque = torque - axis.dot(bias);
        let freed = inertia - u.dyad(u * d_inverse);
        let freed_bias = bias + freed * c + u * (d_inverse * free_torque);
        let to_parent = from_parent.transpose();
        let seen =
            Articulation { inertia: to_parent * freed * from_parent, bias: to_parent * freed_bias };
        Self { seen, link, c, u, d_inverse, free_torque, beyond }
    }

    /// The accelerations of the three joints, the parent's being known.
    pub(super) fn accelerate(&self, parent_acceleration: Spatial<T>) -> [T; 3] {
        let mut found = [T::from_f64(0.0); 3];
        let (mut a, mut link) = (parent_acceleration, Some(self));
        for joint in &mut found {
            let Some(here) = link else { break };
            let carried = here.link.from_parent * a + here.c;
            *joint = here.d_inverse * (here.free_torque - here.u.dot(carried));
            a = carried + here.link.axis * *joint;
            link = here.beyond.as_deref();
        }
        found
    }
}
