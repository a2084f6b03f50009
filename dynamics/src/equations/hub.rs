//! The rigid hub's own share of the equations, of energy and of momentum.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use crate::equations::gravity::second_moment;
use crate::equations::system::System;
use crate::model::parameters::Hub;
use crate::model::wrench::Wrench;
use crate::numbers::real::{Real, Scalar, half, zero};
use crate::numbers::symmetric::Symmetric;
use crate::numbers::vec3::{Columns, Vec3, add, components, cross, dot, scale, sub, zeros};

/// Constants of the hub, all expressed in B. In this order two copies bring them into the sums of an
/// evaluation, which have the first moment before the inertia: one of both would be a call.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HubConstants<T> {
    /// `[I_{B,B}]`, inertia about B, kg m^2.
    pub(crate) i_b_b: Symmetric<T>,
    /// `m_B`, kg.
    pub(crate) m_b: T,
    /// `m_B r_{Bc/B}`, kg m.
    pub(crate) first_moment: Vec3<T>,
}

/// Energy, linear momentum and angular momentum about B, expressed in B.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BodySums<T> {
    pub(crate) energy: T,
    pub(crate) linear: Vec3<T>,
    pub(crate) angular_b: Vec3<T>,
}

impl<T: Copy> HubConstants<T> {
    /// The constants with each of their numbers changed.
    #[inline(always)]
    pub(crate) fn map<U>(&self, mut change: impl FnMut(T) -> U) -> HubConstants<U> {
        self.zip(self, |number, _| change(number))
    }

    /// The constants of two joined number by number.
    #[inline(always)]
    pub(crate) fn zip<U: Copy, W>(
        &self,
        other: &HubConstants<U>,
        mut join: impl FnMut(T, U) -> W,
    ) -> HubConstants<W> {
        let ([x, y, z], [p, q, r]) = (self.first_moment, other.first_moment);
        HubConstants {
            m_b: join(self.m_b, other.m_b),
            first_moment: [join(x, p), join(y, q), join(z, r)],
            i_b_b: self.i_b_b.zip(other.i_b_b, join),
        }
    }
}

impl<T: Real> HubConstants<T> {
    /// Of its mass matrix, the force by angular accelerations: `-tilde(m c)`, column by column.
    #[inline(always)]
    pub(crate) fn coupling(&self) -> Columns<T> {
        let ([x, y, z], zero) = (self.first_moment, self.m_b.like(0.0));
        [[zero, -z, y], [z, zero, -x], [-y, x, zero]]
    }

    /// Second moment of the hub about B, kg m^2.
    #[inline(always)]
    pub(crate) fn second_moment(&self) -> Symmetric<T> {
        second_moment(&self.i_b_b)
    }

    /// The hub's own `M` and `h`: `m (r'' + omega' x c + omega x (omega x c)) = F` and
    /// `I omega' + m c x r'' + omega x (I omega) = L_B`.
    #[inline(always)]
    pub(crate) fn system(&self, omega: Vec3<T>, force: Vec3<T>, torque_b: Vec3<T>) -> System<T> {
        let zero = self.m_b.like(0.0);
        let centrifugal = cross(omega, cross(omega, self.first_moment));
        let gyroscopic = cross(omega, self.i_b_b.times(omega));
        let m = self.m_b;
        System {
            m_vv: Symmetric { xx: m, xy: zero, xz: zero, yy: m, yz: zero, zz: m },
            m_vw: self.coupling(),
            m_ww: self.i_b_b,
            h_v: sub(force, centrifugal),
            h_w: sub(torque_b, gyroscopic),
        }
    }
}

impl<T: Scalar> HubConstants<T> {
    /// Of no hub.
    pub(crate) fn nothing() -> Self {
        Self { m_b: zero(), first_moment: zeros(), i_b_b: Symmetric::zero() }
    }

    pub(crate) fn new(hub: &Hub<T>) -> Self {
        let r_bc_b = components(&hub.r_bc_b);
        Self {
            m_b: hub.m_b,
            first_moment: scale(hub.m_b, r_bc_b),
            i_b_b: Symmetric::part_of(&hub.i_b_bc).plus(Symmetric::parallel_axis(hub.m_b, r_bc_b)),
        }
    }

    /// The wrench about B that these accelerations need.
    pub(crate) fn needs(
        &self,
        omega: Vec3<T>,
        r_b_n_ddot: Vec3<T>,
        omega_dot: Vec3<T>,
    ) -> Wrench<T> {
        let s = self.first_moment;
        let turning = add(cross(omega_dot, s), cross(omega, cross(omega, s)));
        let force = add(scale(self.m_b, r_b_n_ddot), turning);
        let gyroscopic = cross(omega, self.i_b_b.times(omega));
        let moment = add(self.i_b_b.times(omega_dot), add(cross(s, r_b_n_ddot), gyroscopic));
        Wrench::of(force, moment)
    }

    /// What force and moment about B these accelerations need more along a direction of the angular velocity.
    pub(crate) fn loads_by_omega(&self, omega: Vec3<T>, by: Vec3<T>) -> [Vec3<T>; 2] {
        let (s, i) = (self.first_moment, &self.i_b_b);
        let force = add(cross(by, cross(omega, s)), cross(omega, cross(by, s)));
        let moment = add(cross(by, i.times(omega)), cross(omega, i.times(by)));
        [force, moment]
    }

    /// The gradient by the angular velocity of what they need, weighed, less it: the transpose of
    /// [`Self::loads_by_omega`].
    pub(crate) fn gradient_by_omega(
        &self,
        omega: Vec3<T>,
        [force, moment]: [Vec3<T>; 2],
    ) -> Vec3<T> {
        let (s, i) = (self.first_moment, &self.i_b_b);
        let of_force = add(cross(force, cross(omega, s)), cross(cross(force, omega), s));
        let of_moment = sub(cross(moment, i.times(omega)), i.times(cross(moment, omega)));
        add(of_force, of_moment)
    }

    /// Kinetic energy and momenta for the inertial velocity of B and the angular velocity.
    pub(crate) fn sums(&self, r_b_n_dot: Vec3<T>, omega: Vec3<T>) -> BodySums<T> {
        let relative = cross(omega, self.first_moment);
        let linear = add(scale(self.m_b, r_b_n_dot), relative);
        let angular_b = add(self.i_b_b.times(omega), cross(self.first_moment, r_b_n_dot));
        // Twice the energy is v . p + omega . H_B.
        let energy = half::<T>() * (dot(r_b_n_dot, linear) + dot(omega, angular_b));
        BodySums { energy, linear, angular_b }
    }
}
