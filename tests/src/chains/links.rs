//! One chain outwards and inwards: how its bodies move, and what each joint transmits. All along B,
//! all velocities and accelerations inertial.

use precess_dynamics::Scalar;

use super::{Chain, Link, Load, With};
use crate::newton_euler::vector::{Tensor, Vector, cross};

/// A body in motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moving<T> {
    /// Its axes, as columns.
    axes: Tensor<T>,
    /// The axes of its loads: its own, or those of the parent body.
    pub(super) shown: Tensor<T>,
    /// The axis of its joint.
    pub(super) axis: Vector<T>,
    /// Its origin, from B.
    pub(super) origin: Vector<T>,
    omega: Vector<T>,
    omega_dot: Vector<T>,
    /// Acceleration of its origin.
    acceleration: Vector<T>,
}

impl<T: Scalar> Moving<T> {
    /// The hub.
    pub(super) fn hub(omega: Vector<T>, acceleration: Vector<T>, omega_dot: Vector<T>) -> Self {
        let (axes, origin) = (Tensor::identity(), Vector::zero());
        Self { axes, shown: axes, axis: origin, origin, omega, omega_dot, acceleration }
    }

    /// Acceleration of a point of the body at `arm` from its origin.
    fn at(&self, arm: Vector<T>) -> Vector<T> {
        self.acceleration + cross(self.omega_dot, arm) + cross(self.omega, cross(self.omega, arm))
    }

    /// Force that a body needs, and moment about its origin.
    pub(super) fn inertial(&self, mass: T, centre: Vector<T>, inertia: Tensor<T>) -> Load<T> {
        let (arm, inertia) = (self.axes * centre, inertia.resolved_from(self.axes));
        let force = self.at(arm) * mass;
        let spin = cross(self.omega, inertia * self.omega);
        Load { force, moment: inertia * self.omega_dot + spin }.moved(arm)
    }

    /// The child body of a joint of this one, at zero turned by `mount`.
    fn child(&self, mount: Tensor<T>, link: &Link<T>, rate: T, acceleration: T) -> Self {
        let zero = self.axes * mount;
        let axis = zero.column(link.axis);
        let arm = self.axes * link.origin;
        if link.slides {
            let arm = arm + axis * link.coordinate;
            let two = T::from_f64(2.0);
            let relative = axis * acceleration + cross(self.omega, axis * rate) * two;
            return Self {
                axes: zero,
                shown: zero,
                axis,
                origin: self.origin + arm,
                acceleration: self.at(arm) + relative,
                ..*self
            };
        }
        let axes = zero * turn(link.axis, link.coordinate);
        Self {
            axes,
            shown: if link.round { zero } else { axes },
            axis,
            origin: self.origin + arm,
            omega: self.omega + axis * rate,
            omega_dot: self.omega_dot + axis * acceleration + cross(self.omega, axis * rate),
            acceleration: self.at(arm),
        }
    }
}

/// The bodies of a chain in motion, with as many accelerations as there are joints.
pub(super) fn outwards<T: Scalar>(
    chain: &Chain<T>,
    base: &Moving<T>,
    accelerations: &mut impl Iterator<Item = T>,
    with: With,
) -> Vec<Moving<T>> {
    let zero = T::from_f64(0.0);
    let (mut parent, mut mount) = (*base, chain.mount);
    let links = chain.links.iter().map(|link| {
        let rate = if with == With::RatesAndForces { link.rate } else { zero };
        parent = parent.child(mount, link, rate, accelerations.next().unwrap_or(zero));
        mount = Tensor::identity();
        parent
    });
    links.collect()
}

/// What each parent body exerts on its child body, about the child body's origin.
pub(super) fn inwards<T: Scalar>(
    chain: &Chain<T>,
    moving: &[Moving<T>],
    with: With,
) -> Vec<Load<T>> {
    let mut loads = vec![Load::zero(); moving.len()];
    let mut outboard: Option<(Load<T>, Vector<T>)> = None;
    for ((load, link), moving) in loads.iter_mut().zip(&chain.links).zip(moving).rev() {
        let mut needed = moving.inertial(link.mass, link.centre, link.inertia);
        if with == With::RatesAndForces {
            needed = needed.minus(link.applied.turned(moving.shown));
        }
        if let Some((load, origin)) = outboard {
            needed = needed.plus(load.moved(origin - moving.origin));
        }
        *load = needed;
        outboard = Some((needed, moving.origin));
    }
    loads
}

/// The active rotation about a coordinate axis: its columns are the turned axes.
fn turn<T: Scalar>(axis: usize, angle: T) -> Tensor<T> {
    let (sine, cosine) = angle.sin_cos();
    let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut rotation = Tensor::identity();
    rotation.0[next][next] = cosine;
    rotation.0[next][last] = -sine;
    rotation.0[last][next] = sine;
    rotation.0[last][last] = cosine;
    rotation
}
