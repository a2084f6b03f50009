//! [`RigidBody`]: the wrench that a motion requires of a body, and how it changes with the body and the motion.
//!
//! Newton's and Euler's equations of one body, expressed in its own axes, about its origin. Its angular velocity is
//! `omega + spin`, its angular acceleration `omega' + omega x spin`: of a fast rotor the terms by `spin` cancel, and are
//! left out where they do.
//!
//! ```text
//! f = m a_c,   n = c x f + I omega' + omega x (I omega + tr(I) spin) + spin x (2 I omega + I spin)
//! a_c = a + omega' x c + omega x (omega x c + 2 spin x c) + spin x (spin x c)
//! ```

use crate::model::kind::BodyParameters;
use crate::model::parameters::Hub;
use crate::numbers::real::Scalar;
use crate::numbers::symmetric::Symmetric;
use crate::numbers::vec3::{
    Columns, Vec3, add, components, cross, rotate, rotate_transposed, scale, zeros,
};

/// Force, N, and moment about a point, N m.
pub(crate) type ForceAndMoment<T> = (Vec3<T>, Vec3<T>);

/// Mass, centre of mass and inertia about it, or what they change by.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RigidBody<T> {
    /// Mass, kg.
    pub(crate) mass: T,
    /// Centre of mass from the origin, own axes, m.
    pub(crate) centre: Vec3<T>,
    /// Inertia about the centre of mass, own axes, kg m².
    pub(crate) inertia: Symmetric<T>,
}

/// How a frame moves. As a change, `spin` stays and is zero.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion<T> {
    /// Angular velocity without `spin`, rad/s.
    pub(crate) omega: Vec3<T>,
    /// The rest of it, rad/s: the rate of the joint about its axis.
    pub(crate) spin: Vec3<T>,
    /// Angular acceleration without `omega x spin`, rad/s².
    pub(crate) omega_dot: Vec3<T>,
    /// Acceleration of the origin seen from a frame that falls with gravity, m/s².
    pub(crate) acceleration: Vec3<T>,
}

impl<T: Scalar> Motion<T> {
    /// The acceleration of a point that is fixed in the frame, less that of the origin.
    pub(crate) fn relative(&self, r: Vec3<T>) -> Vec3<T> {
        let (of_omega, of_spin) = (cross(self.omega, r), cross(self.spin, r));
        let coriolis = cross(self.omega, add(of_omega, add(of_spin, of_spin)));
        add(cross(self.omega_dot, r), add(coriolis, cross(self.spin, of_spin)))
    }

    /// What [`Self::relative`] changes by where the motion does.
    pub(crate) fn relative_change(&self, change: &Self, r: Vec3<T>) -> Vec3<T> {
        let (of_omega, of_spin) = (cross(self.omega, r), cross(self.spin, r));
        let by_omega = cross(change.omega, add(of_omega, add(of_spin, of_spin)));
        let of_change = cross(self.omega, cross(change.omega, r));
        add(cross(change.omega_dot, r), add(by_omega, of_change))
    }

    /// The same without a `spin` of its own: what moves relative to the frame starts from that.
    pub(crate) fn base(&self) -> Self {
        Self {
            omega: add(self.omega, self.spin),
            spin: zeros(),
            omega_dot: add(self.omega_dot, cross(self.omega, self.spin)),
            acceleration: self.acceleration,
        }
    }

    /// Expressed in the axes that are the columns.
    pub(crate) fn within(&self, axes: &Columns<T>) -> Self {
        Self {
            omega: rotate_transposed(axes, self.omega),
            spin: rotate_transposed(axes, self.spin),
            omega_dot: rotate_transposed(axes, self.omega_dot),
            acceleration: rotate_transposed(axes, self.acceleration),
        }
    }
}

impl<T: Scalar> RigidBody<T> {
    /// A body of a device.
    pub(crate) fn of(body: &BodyParameters<T>) -> Self {
        let inertia = Symmetric::part_of(&body.inertia);
        Self { mass: body.mass, centre: body.centre, inertia }
    }

    /// The hub; its origin is B.
    pub(crate) fn of_hub(hub: &Hub<T>) -> Self {
        let inertia = Symmetric::part_of(&hub.i_b_bc);
        Self { mass: hub.m_b, centre: components(&hub.r_bc_b), inertia }
    }

    /// Whether nothing changes.
    pub(crate) fn vanishes(&self) -> bool {
        let Self { mass, centre, inertia } = self;
        mass.vanishes()
            && centre.iter().all(|number| number.vanishes())
            && inertia.columns().as_flattened().iter().all(|number| number.vanishes())
    }

    /// The wrench about the origin that a motion, expressed in the body's axes, requires.
    pub(crate) fn wrench(&self, motion: &Motion<T>) -> ForceAndMoment<T> {
        let force = scale(self.mass, add(motion.acceleration, motion.relative(self.centre)));
        (force, add(cross(self.centre, force), turning(&self.inertia, motion)))
    }

    /// What that wrench changes by where the body does.
    pub(crate) fn wrench_by_body(&self, motion: &Motion<T>, change: &Self) -> ForceAndMoment<T> {
        let of_centre = add(motion.acceleration, motion.relative(self.centre));
        let by_centre = scale(self.mass, motion.relative(change.centre));
        let force = add(scale(change.mass, of_centre), by_centre);
        let own = cross(change.centre, scale(self.mass, of_centre));
        let lever = add(own, cross(self.centre, force));
        (force, add(lever, turning(&change.inertia, motion)))
    }

    /// What that wrench changes by where the motion does.
    pub(crate) fn wrench_by_motion(
        &self,
        motion: &Motion<T>,
        change: &Motion<T>,
    ) -> ForceAndMoment<T> {
        let of_centre = motion.relative_change(change, self.centre);
        let force = scale(self.mass, add(change.acceleration, of_centre));
        let (by_omega, by_trace) =
            (self.inertia.times(change.omega), scale(self.inertia.trace(), motion.spin));
        let by_change = cross(change.omega, add(self.inertia.times(motion.omega), by_trace));
        let of_change = cross(add(motion.omega, add(motion.spin, motion.spin)), by_omega);
        let turning = add(self.inertia.times(change.omega_dot), add(by_change, of_change));
        (force, add(cross(self.centre, force), turning))
    }
}

/// The moment about the centre of mass.
fn turning<T: Scalar>(inertia: &Symmetric<T>, motion: &Motion<T>) -> Vec3<T> {
    let Motion { omega, spin, omega_dot, .. } = *motion;
    let (of_omega, of_spin) = (inertia.times(omega), inertia.times(spin));
    let by_omega = cross(omega, add(of_omega, scale(inertia.trace(), spin)));
    let by_spin = cross(spin, add(add(of_omega, of_omega), of_spin));
    add(inertia.times(omega_dot), add(by_omega, by_spin))
}

/// Both expressed in the old frame, of what is expressed in the columns.
pub(crate) fn turned<T: Scalar>(
    axes: &Columns<T>,
    (force, moment): ForceAndMoment<T>,
) -> ForceAndMoment<T> {
    (rotate(axes, force), rotate(axes, moment))
}
