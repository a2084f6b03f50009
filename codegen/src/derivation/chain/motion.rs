//! Outwards along the chain: angular velocities and paths, by the transport theorem.

use super::Chain;
use crate::graph::Graph;
use crate::space::{BodyFrame, Frame, Hub, ParentFrame, Vector};

/// The observer: the motion of B in the observer's frame.
#[derive(Clone, Copy)]
pub struct Observer<'g> {
    /// Letter of the observer's frame.
    pub name: &'static str,
    /// Angular velocity of B.
    pub omega: Vector<'g, Hub>,
    /// Velocity of point B.
    pub velocity: Vector<'g, Hub>,
    /// Acceleration of point B, or zero where accelerations are wanted relative to that of B.
    pub acceleration: Vector<'g, Hub>,
}

impl<'g> Observer<'g> {
    /// Seen from B: derivatives are the paper's primes.
    #[must_use]
    pub fn on_hub(graph: &'g Graph) -> Self {
        let zero = Vector::zero(graph);
        Self { name: "B", omega: zero, velocity: zero, acceleration: zero }
    }

    /// Seen from N: derivatives are the paper's dots. Accelerations are relative to that of B.
    #[must_use]
    pub fn inertial(chain: &Chain<'g>) -> Self {
        let (omega, velocity) = (chain.hub.omega, chain.hub.r_b_n_dot);
        Self { name: "N", omega, velocity, acceleration: Vector::zero(chain.graph) }
    }

    /// Seen from N, with the acceleration of B in every other.
    #[must_use]
    pub fn accelerating(chain: &Chain<'g>) -> Self {
        Self { acceleration: chain.hub.r_b_n_ddot, ..Self::inertial(chain) }
    }
}

/// A point that moves: position from B, velocity and acceleration.
#[derive(Clone, Copy)]
pub struct Path<'g, F> {
    /// From B.
    pub position: Vector<'g, F>,
    /// Seen by the observer.
    pub velocity: Vector<'g, F>,
    /// Seen by the observer, to whom B accelerates as the observer says.
    pub acceleration: Vector<'g, F>,
}

/// How one body moves, seen by an observer.
#[derive(Clone, Copy)]
pub struct Motion<'g> {
    /// Angular velocity of the body, expressed in its own axes.
    pub omega: Vector<'g, BodyFrame>,
    /// Angular velocity of these axes: the same, but for axes that do not turn with the body.
    pub axes: Vector<'g, BodyFrame>,
    /// The joint's origin, expressed in the parent body's axes.
    pub origin: Path<'g, ParentFrame>,
    /// The body's centre of mass, expressed in the parent body's axes.
    pub centre: Path<'g, ParentFrame>,
}

impl<'g, F: Frame> Path<'g, F> {
    /// The end of an arm that starts here; the arm is expressed in axes that turn at `omega`.
    fn with_arm(self, arm: Vector<'g, F>, omega: Vector<'g, F>) -> Self {
        let arm_rate = arm.prime(omega);
        Self {
            position: self.position + arm,
            velocity: self.velocity + arm_rate,
            acceleration: self.acceleration + arm_rate.prime(omega),
        }
    }

    fn map<To>(self, f: impl Fn(Vector<'g, F>) -> Vector<'g, To>) -> Path<'g, To> {
        Path {
            position: f(self.position),
            velocity: f(self.velocity),
            acceleration: f(self.acceleration),
        }
    }
}

/// The motion of every body of the chain, from the hub outwards.
#[must_use]
pub fn motions<'g>(chain: &Chain<'g>, observer: &Observer<'g>) -> Vec<Motion<'g>> {
    let zero = Vector::zero(chain.graph);
    let mut omega = observer.omega.as_parent_frame();
    let velocity = observer.velocity.as_parent_frame();
    let acceleration = observer.acceleration.as_parent_frame();
    let mut path = Path { position: zero, velocity, acceleration };
    let mut made = Vec::new();
    for link in &chain.links {
        let origin = path.with_arm(link.origin, omega);
        // (12), (13), (14): the arm's second derivative, added to that of the joint's origin.
        let centre = origin.with_arm(link.centre.turned(link.turn.inverse()), omega);
        // (31), (44), (59): each turning joint adds its rate about its own axis.
        let carried = omega.turned(link.turn);
        let omega_own = carried + link.spin();
        let axes = if link.turn.is_none() { carried } else { omega_own };
        made.push(Motion { omega: omega_own, axes, origin, centre });
        path = origin.map(|v| v.turned(link.turn).relabelled_outboard());
        omega = axes.relabelled_outboard();
    }
    made
}
