//! [`BaseMotion`]: how a base moves, the hub or a carrier, and what changes of it a carrier on it takes over: [`Link`].
//!
//! With `w` the angular velocity inboard of a turn about `a`, `alpha` its derivative, all expressed in the axes of the
//! carrier, the carrier's motion (I1) to (I3) changes with the angle by
//!
//! ```text
//! omega_P by w x a,   omega_P' by alpha x a + (w x a) x (omega_P - w),   r_P'' by r_P'' x a
//! ```
//!
//! and with its rate by `a`, `w x a + a x (omega_P - w - q' a)` and nothing.

use alloc::vec::Vec;

use crate::equations::gravity::Central;
use crate::equations::hub::HubConstants;
use crate::isolation::carrier::Carrier;
use crate::isolation::carrier_elimination::CarrierConstants;
use crate::isolation::motion::{Motion, Spatial};
use crate::model::wrench::Wrench;
use crate::numbers::each::{Each, JointStates};
use crate::numbers::real::{Scalar, two, zero};
use crate::numbers::symmetric::Symmetric;
use crate::numbers::vec3::{
    Columns, Vec3, add, components, cross, rotate, rotate_transposed, scale, sub, zeros,
};

/// How a base moves and where it is, expressed in its axes; or a change of that.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BaseMotion<T> {
    pub(crate) omega: Vec3<T>,
    /// Of its origin, seen from what falls with the field there.
    pub(crate) acceleration: Vec3<T>,
    pub(crate) omega_dot: Vec3<T>,
    /// Position of B from the centre of the field.
    pub(crate) rho: Vec3<T>,
}

/// A carrier on its base.
#[derive(Clone, Debug)]
pub(crate) struct Link<T> {
    /// The number of the base.
    pub(crate) base: usize,
    /// The carrier's axes, expressed in the base.
    pub(crate) axes: Columns<T>,
    /// Its origin from that of the base, and the derivative seen from the base, base axes.
    pub(crate) p: Vec3<T>,
    pub(crate) p_prime: Vec3<T>,
    /// Its angular velocity relative to the base, carrier axes.
    pub(crate) relative: Vec3<T>,
    pub(crate) omega_base: Vec3<T>,
    pub(crate) coordinates: Vec<CoordinateSlopes<T>>,
}

/// What a coordinate of a carrier moves, carrier axes.
#[derive(Clone, Debug)]
pub(crate) struct CoordinateSlopes<T> {
    /// The acceleration of the carrier by that of the coordinate.
    pub(crate) direction: Spatial<T>,
    /// The motion of the carrier by the coordinate, and by its rate.
    pub(crate) by: [BaseMotion<T>; 2],
    /// The directions of all coordinates by this one.
    pub(crate) directions_by: Vec<Spatial<T>>,
}

impl<T: Scalar> BaseMotion<T> {
    pub(crate) fn none() -> Self {
        Self { omega: zeros(), acceleration: zeros(), omega_dot: zeros(), rho: zeros() }
    }

    /// Each number changed.
    pub(crate) fn map<U>(&self, change: impl Fn(T) -> U + Copy) -> BaseMotion<U> {
        let Self { omega, acceleration, omega_dot, rho } = self;
        BaseMotion {
            omega: omega.map(change),
            acceleration: acceleration.map(change),
            omega_dot: omega_dot.map(change),
            rho: rho.map(change),
        }
    }

    /// A multiple.
    pub(crate) fn scaled(&self, by: T) -> Self {
        self.map(|number| by * number)
    }

    /// Accelerations.
    pub(crate) fn accelerating([acceleration, omega_dot]: Spatial<T>) -> Self {
        Self { acceleration, omega_dot, ..Self::none() }
    }

    pub(crate) fn plus(&self, other: &Self) -> Self {
        Self {
            omega: add(self.omega, other.omega),
            acceleration: add(self.acceleration, other.acceleration),
            omega_dot: add(self.omega_dot, other.omega_dot),
            rho: add(self.rho, other.rho),
        }
    }

    /// What a body fixed in the base needs, less what the gradient exerts on it.
    pub(crate) fn load(&self, body: &HubConstants<T>, field: Option<&Central<T>>) -> Spatial<T> {
        let needed = body.needs(self.omega, self.acceleration, self.omega_dot);
        let mut load = [components(&needed.force), components(&needed.moment)];
        if let Some(field) = field {
            let (force, moment) = field.wrench(body.first_moment, &body.second_moment());
            load = [sub(load[0], force), sub(load[1], moment)];
        }
        load
    }

    /// By how much [`Self::load`] changes with a motion.
    pub(crate) fn load_by(
        &self,
        body: &HubConstants<T>,
        field: Option<&Central<T>>,
        change: &Self,
    ) -> Spatial<T> {
        let (s, i) = (body.first_moment, &body.i_b_b);
        let [turning, gyroscopic] = body.loads_by_omega(self.omega, change.omega);
        let force = add(scale(body.m_b, change.acceleration), cross(change.omega_dot, s));
        let moment = add(i.times(change.omega_dot), cross(s, change.acceleration));
        let mut load = [add(force, turning), add(moment, gyroscopic)];
        if let Some(field) = field {
            let (force, moment) = field.changed(change.rho).wrench(s, &body.second_moment());
            load = [sub(load[0], force), sub(load[1], moment)];
        }
        load
    }
}

impl<T: Scalar> Link<T> {
    /// Of a carrier on the base of that number; and its motion.
    pub(crate) fn of_carrier<C: Carrier<Scalar = T>>(
        carrier: &CarrierConstants<C>,
        joints: &C::Joints<T>,
        accelerations: &C::Accelerations<T>,
        base: usize,
        (of_base, field): (&BaseMotion<T>, Option<&Central<T>>),
    ) -> (Self, BaseMotion<T>) {
        let moving = carrier.moving(joints, of_base.omega);
        let Motion { axes, p, p_prime, omega_base, relative, omega, .. } = *moving;
        let into = |v| rotate_transposed(&axes, v);
        let field_by = |v| field.map_or_else(zeros, |field| field.gradient.times(v));
        let base_accelerations = [of_base.acceleration, of_base.omega_dot];
        let [v, omega_dot] = C::acceleration(&moving, base_accelerations, accelerations);
        let acceleration = sub(v, into(field_by(p)));
        let own = BaseMotion { omega, acceleration, omega_dot, rho: into(of_base.rho) };
        let of_base = [into(omega_base), into(of_base.omega_dot)];
        let [mut w, mut alpha] = of_base;
        let directions = C::directions(&moving);
        let joints = joints.states().zip(accelerations.values()).zip(C::JOINTS);
        let mut coordinates = Vec::with_capacity(C::JOINTS.len());
        for ((([_, rate], ddot), info), direction) in joints.zip(directions) {
            let [s, a] = direction;
            let mut by = [BaseMotion::none(); 2];
            let mut directions_by = alloc::vec![[zeros(); 2]; C::JOINTS.len()];
            if info.slides {
                let [w, alpha] = of_base;
                let carried = add(cross(alpha, s), cross(w, cross(w, s)));
                by[0].acceleration = sub(carried, into(field_by(rotate(&axes, s))));
                by[1].acceleration = scale(two(), cross(w, s));
            } else {
                let (turned, outboard) = (cross(w, a), sub(omega, w));
                let own_rate = scale(rate, a);
                by[0] = BaseMotion {
                    omega: turned,
                    acceleration: cross(own.acceleration, a),
                    omega_dot: add(cross(alpha, a), cross(turned, outboard)),
                    rho: cross(own.rho, a),
                };
                by[1].omega = a;
                by[1].omega_dot = add(turned, cross(a, sub(outboard, own_rate)));
                alpha = add(alpha, add(scale(ddot, a), cross(w, own_rate)));
                w = add(w, own_rate);
                let inboard = directions_by.iter_mut().zip(directions).take(info.index);
                inboard.for_each(|(to, [s, b])| *to = [cross(s, a), cross(b, a)]);
            }
            coordinates.push(CoordinateSlopes { direction, by, directions_by });
        }
        (Self { base, axes, p, p_prime, relative, omega_base, coordinates }, own)
    }

    /// The direction of some of each coordinate.
    pub(crate) fn direction(&self, numbers: &[T; 6]) -> Spatial<T> {
        let each = self.coordinates.iter().zip(numbers);
        each.fold([zeros(); 2], |[v, w], (of, by)| {
            let [moved, turned] = of.direction;
            [add(v, scale(*by, moved)), add(w, scale(*by, turned))]
        })
    }

    /// The acceleration of the carrier for that of its base.
    pub(crate) fn outward(&self, [linear, angular]: Spatial<T>) -> Spatial<T> {
        let moved = add(linear, cross(angular, self.p));
        [rotate_transposed(&self.axes, moved), rotate_transposed(&self.axes, angular)]
    }

    /// By how much the carrier's motion changes with that of its base, in a field about B.
    pub(crate) fn carried(
        &self,
        change: &BaseMotion<T>,
        field: Option<&Central<T>>,
    ) -> BaseMotion<T> {
        let (by, w, p) = (change.omega, self.omega_base, self.p);
        let turning = add(cross(by, cross(w, p)), cross(w, cross(by, p)));
        let coriolis = scale(two(), cross(by, self.p_prime));
        let mut moved = add(change.acceleration, add(turning, coriolis));
        if let Some(field) = field {
            moved = sub(moved, field.changed(change.rho).gradient.times(p));
        }
        let [acceleration, omega_dot] = self.outward([moved, change.omega_dot]);
        let omega = rotate_transposed(&self.axes, by);
        BaseMotion {
            omega,
            acceleration,
            omega_dot: add(omega_dot, cross(omega, self.relative)),
            rho: rotate_transposed(&self.axes, change.rho),
        }
    }

    /// (I6), a wrench about the carrier's origin, carrier axes, as one about that of its base, base axes.
    pub(crate) fn inward(&self, [force, moment]: Spatial<T>) -> Spatial<T> {
        let force = rotate(&self.axes, force);
        [force, add(rotate(&self.axes, moment), cross(self.p, force))]
    }

    /// By how much [`Self::inward`] changes with a coordinate of this direction.
    pub(crate) fn inward_by(&self, load: Spatial<T>, [moved, turned]: Spatial<T>) -> Spatial<T> {
        let [force, moment] = load;
        let by_turn = self.inward([cross(turned, force), cross(turned, moment)]);
        let by_move = rotate(&self.axes, cross(moved, force));
        [by_turn[0], add(by_turn[1], by_move)]
    }

    /// Mass, first and second moment about the carrier's origin, as about that of its base, (I7).
    pub(crate) fn moments_inward(&self, of: &Moments<T>) -> Moments<T> {
        let s = rotate(&self.axes, of.first);
        Moments {
            mass: of.mass,
            first: add(scale(of.mass, self.p), s),
            second: of.second.rotated(&self.axes).plus(Moments::moved(of.mass, self.p, s)),
        }
    }

    /// By how much these change where those about the carrier's origin change by `change`, without mass, and the carrier by
    /// a direction.
    pub(crate) fn moments_by(
        &self,
        of: &Moments<T>,
        change: &Moments<T>,
        [moved, turned]: Spatial<T>,
    ) -> Moments<T> {
        let s = rotate(&self.axes, of.first);
        let first = rotate(&self.axes, add(change.first, cross(turned, of.first)));
        let moved = rotate(&self.axes, moved);
        // tilde(turned) S - S tilde(turned).
        let second = change.second.plus(Moments::turned(&of.second, turned));
        // (p + moved) and (s + first), to first order: what `moved` is linear in each.
        let by_first = Moments::moved(zero(), self.p, first);
        let by_move = Moments::moved(zero(), moved, add(s, scale(of.mass, self.p)));
        Moments {
            mass: zero(),
            first: add(scale(of.mass, moved), first),
            second: second.rotated(&self.axes).plus(by_first).plus(by_move),
        }
    }
}

/// Mass, first and second moment about a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moments<T> {
    pub(crate) mass: T,
    pub(crate) first: Vec3<T>,
    pub(crate) second: Symmetric<T>,
}

impl<T: Scalar> Moments<T> {
    pub(crate) fn none() -> Self {
        let second = Symmetric::zero();
        Self { mass: zero(), first: zeros(), second }
    }

    pub(crate) fn of_body(body: &HubConstants<T>) -> Self {
        Self { mass: body.m_b, first: body.first_moment, second: body.second_moment() }
    }

    pub(crate) fn plus(&self, other: &Self) -> Self {
        Self {
            mass: self.mass + other.mass,
            first: add(self.first, other.first),
            second: self.second.plus(other.second),
        }
    }

    /// `p sᵀ + s pᵀ + m p pᵀ`.
    fn moved(mass: T, p: Vec3<T>, s: Vec3<T>) -> Symmetric<T> {
        let entry = |i: usize, k: usize| p[i] * s[k] + s[i] * p[k] + mass * (p[i] * p[k]);
        Symmetric {
            xx: entry(0, 0),
            xy: entry(0, 1),
            xz: entry(0, 2),
            yy: entry(1, 1),
            yz: entry(1, 2),
            zz: entry(2, 2),
        }
    }

    /// `tilde(e) S - S tilde(e)`.
    fn turned(of: &Symmetric<T>, e: Vec3<T>) -> Symmetric<T> {
        let [x, y, z] = of.columns();
        let [x, y, z] = [cross(e, x), cross(e, y), cross(e, z)];
        Symmetric {
            xx: x[0] + x[0],
            xy: y[0] + x[1],
            xz: z[0] + x[2],
            yy: y[1] + y[1],
            yz: z[1] + y[2],
            zz: z[2] + z[2],
        }
    }
}

/// Force and moment of a wrench.
pub(crate) fn spatial<T: Scalar>(wrench: &Wrench<T>) -> Spatial<T> {
    [components(&wrench.force), components(&wrench.moment)]
}
