//! [`Assembly`]: the hub's six equations, added up device by device, expressed in B.
//!
//! What does not notice that the joints move belongs to the hub from the start, so that what the
//! hub's own motion requires is computed once, of one rigid body; a device adds the part of its
//! first moment and inertia that moves, and what its joints take out of the equations. Over any
//! number: lanes do the same.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use crate::equations::error::SolveError;
use crate::equations::hub::HubConstants;
use crate::equations::stiffness::Stiffness;
use crate::equations::system::{Scale, Solution, System};
use crate::generated::hub::{BodyAcceleration, BodyRate, ConstantShare, HubShare};
use crate::numbers::real::{Real, Scalar, filling};
use crate::numbers::symmetric::Symmetric;
use crate::numbers::vec3::{Vec3, add};

/// The hub's equations so far.
#[derive(Clone, Copy, Debug)]
pub struct Assembly<T> {
    /// Mass of hub and devices, kg.
    mass: T,
    /// What acts from outside: force, and moment about B.
    force: Vec3<T>,
    moment: Vec3<T>,
    /// The shares of the devices: what the joints take out of the equations. First moment and
    /// inertia that move are added to those of hub and devices as one rigid body.
    sum: HubShare<T>,
    /// Of springs and friction.
    pub(crate) stiffness: Stiffness<T>,
    /// Second moment about B of what was added, kg m²; only with a central field.
    pub(crate) second_moment: Symmetric<T>,
}

impl<T: Real> Assembly<T> {
    /// The hub, with the constant shares, and what acts on it.
    #[inline(always)]
    #[rustfmt::skip]
    pub(crate) fn new(body: &HubConstants<T>, force: Vec3<T>, moment: Vec3<T>) -> Self {
        let zero = filling(body.m_b.like(0.0));
        let ([x, y, z], i) = (body.first_moment, &body.i_b_b);
        let sum = HubShare {
            mr_moving_bx: x, mr_moving_by: y, mr_moving_bz: z,
            i_moving_11: i.xx, i_moving_12: i.xy, i_moving_13: i.xz,
            i_moving_22: i.yy, i_moving_23: i.yz, i_moving_33: i.zz,
            m_vv_11: zero, m_vv_12: zero, m_vv_13: zero, m_vv_22: zero, m_vv_23: zero, m_vv_33: zero,
            m_vw_11: zero, m_vw_12: zero, m_vw_13: zero,
            m_vw_21: zero, m_vw_22: zero, m_vw_23: zero,
            m_vw_31: zero, m_vw_32: zero, m_vw_33: zero,
            m_ww_11: zero, m_ww_12: zero, m_ww_13: zero, m_ww_22: zero, m_ww_23: zero, m_ww_33: zero,
            h_v_1: zero, h_v_2: zero, h_v_3: zero, h_w_1: zero, h_w_2: zero, h_w_3: zero,
        };
        let (second_moment, stiffness) = (Symmetric::filled(zero), Stiffness::none(zero));
        Self { mass: body.m_b, force, moment, sum, stiffness, second_moment }
    }

    /// Adds a force and a moment about B from outside.
    #[inline(always)]
    pub(crate) fn add_wrench(&mut self, force: Vec3<T>, moment: Vec3<T>) {
        self.force = add(self.force, force);
        self.moment = add(self.moment, moment);
    }

    /// Adds a device whose joints are eliminated.
    #[inline(always)]
    pub(crate) fn add(&mut self, share: &HubShare<T>) {
        self.add_by(
            share,
            #[inline(always)]
            |sum, number| sum + number,
        );
    }

    /// Writes, number by number, what a function makes of the sum so far and a share. Each sum in
    /// place: a new record of sums is held whole, and where registers are few that takes a store
    /// and a load a number.
    #[inline(always)]
    pub(crate) fn add_by<U: Copy>(&mut self, e: &HubShare<U>, mut add: impl FnMut(T, U) -> T) {
        let s = &mut self.sum;
        s.m_vv_11 = add(s.m_vv_11, e.m_vv_11);
        s.m_vv_12 = add(s.m_vv_12, e.m_vv_12);
        s.m_vv_13 = add(s.m_vv_13, e.m_vv_13);
        s.m_vv_22 = add(s.m_vv_22, e.m_vv_22);
        s.m_vv_23 = add(s.m_vv_23, e.m_vv_23);
        s.m_vv_33 = add(s.m_vv_33, e.m_vv_33);
        s.m_vw_11 = add(s.m_vw_11, e.m_vw_11);
        s.m_vw_12 = add(s.m_vw_12, e.m_vw_12);
        s.m_vw_13 = add(s.m_vw_13, e.m_vw_13);
        s.m_vw_21 = add(s.m_vw_21, e.m_vw_21);
        s.m_vw_22 = add(s.m_vw_22, e.m_vw_22);
        s.m_vw_23 = add(s.m_vw_23, e.m_vw_23);
        s.m_vw_31 = add(s.m_vw_31, e.m_vw_31);
        s.m_vw_32 = add(s.m_vw_32, e.m_vw_32);
        s.m_vw_33 = add(s.m_vw_33, e.m_vw_33);
        s.m_ww_11 = add(s.m_ww_11, e.m_ww_11);
        s.m_ww_12 = add(s.m_ww_12, e.m_ww_12);
        s.m_ww_13 = add(s.m_ww_13, e.m_ww_13);
        s.m_ww_22 = add(s.m_ww_22, e.m_ww_22);
        s.m_ww_23 = add(s.m_ww_23, e.m_ww_23);
        s.m_ww_33 = add(s.m_ww_33, e.m_ww_33);
        s.h_v_1 = add(s.h_v_1, e.h_v_1);
        s.h_v_2 = add(s.h_v_2, e.h_v_2);
        s.h_v_3 = add(s.h_v_3, e.h_v_3);
        s.h_w_1 = add(s.h_w_1, e.h_w_1);
        s.h_w_2 = add(s.h_w_2, e.h_w_2);
        s.h_w_3 = add(s.h_w_3, e.h_w_3);
        s.mr_moving_bx = add(s.mr_moving_bx, e.mr_moving_bx);
        s.mr_moving_by = add(s.mr_moving_by, e.mr_moving_by);
        s.mr_moving_bz = add(s.mr_moving_bz, e.mr_moving_bz);
        s.i_moving_11 = add(s.i_moving_11, e.i_moving_11);
        s.i_moving_12 = add(s.i_moving_12, e.i_moving_12);
        s.i_moving_13 = add(s.i_moving_13, e.i_moving_13);
        s.i_moving_22 = add(s.i_moving_22, e.i_moving_22);
        s.i_moving_23 = add(s.i_moving_23, e.i_moving_23);
        s.i_moving_33 = add(s.i_moving_33, e.i_moving_33);
    }

    /// Hub and devices as one rigid body.
    #[inline(always)]
    #[rustfmt::skip]
    pub(crate) fn body(&self) -> HubConstants<T> {
        let e = &self.sum;
        HubConstants {
            m_b: self.mass,
            first_moment: [e.mr_moving_bx, e.mr_moving_by, e.mr_moving_bz],
            i_b_b: Symmetric {
                xx: e.i_moving_11, xy: e.i_moving_12, xz: e.i_moving_13,
                yy: e.i_moving_22, yz: e.i_moving_23, zz: e.i_moving_33,
            },
        }
    }

    /// What the joints take out of the equations.
    #[inline(always)]
    #[rustfmt::skip]
    pub(crate) fn taken(&self) -> System<T> {
        let e = &self.sum;
        System {
            m_vv: Symmetric {
                xx: e.m_vv_11, xy: e.m_vv_12, xz: e.m_vv_13,
                yy: e.m_vv_22, yz: e.m_vv_23, zz: e.m_vv_33,
            },
            m_vw: [
                [e.m_vw_11, e.m_vw_21, e.m_vw_31],
                [e.m_vw_12, e.m_vw_22, e.m_vw_32],
                [e.m_vw_13, e.m_vw_23, e.m_vw_33],
            ],
            m_ww: Symmetric {
                xx: e.m_ww_11, xy: e.m_ww_12, xz: e.m_ww_13,
                yy: e.m_ww_22, yz: e.m_ww_23, zz: e.m_ww_33,
            },
            h_v: [e.h_v_1, e.h_v_2, e.h_v_3],
            h_w: [e.h_w_1, e.h_w_2, e.h_w_3],
        }
    }

    /// The hub's system, joints eliminated, where the hub turns at `omega`.
    #[inline(always)]
    pub(crate) fn system(&self, omega: Vec3<T>) -> System<T> {
        self.body().system(omega, self.force, self.moment).less(&self.taken())
    }

    /// Mass and moments of inertia of the spacecraft with every joint locked. The moving share of
    /// inertia may cancel nearly all of the constant one, whose rounding stays: both count.
    #[inline(always)]
    pub(crate) fn scale(&self, body: &HubConstants<T>) -> Scale<T> {
        (self.mass, add(body.i_b_b.diagonal(), self.body().i_b_b.diagonal()))
    }
}

impl<T: Scalar> Assembly<T> {
    /// Accelerations of a free hub that turns at `omega`, of the constants that the assembly began
    /// with.
    #[inline(always)]
    pub(crate) fn solve(
        &self,
        omega: Vec3<T>,
        body: &HubConstants<T>,
    ) -> Result<Solution<T>, SolveError<T>> {
        let solution = self.system(omega).solve(&self.scale(body));
        solution.map_err(|small| small.of(None, None))
    }
}

impl<T: Real> HubConstants<T> {
    /// The hub with the constant shares of its devices.
    pub(crate) fn with_constant_shares(
        self,
        devices: impl Iterator<Item = ConstantShare<T>>,
    ) -> Self {
        devices.fold(self, |hub, e| Self {
            m_b: hub.m_b + e.constant_m,
            first_moment: add(
                hub.first_moment,
                [e.constant_mr_bx, e.constant_mr_by, e.constant_mr_bz],
            ),
            i_b_b: hub.i_b_b.plus(Symmetric {
                xx: e.constant_i_11,
                xy: e.constant_i_12,
                xz: e.constant_i_13,
                yy: e.constant_i_22,
                yz: e.constant_i_23,
                zz: e.constant_i_33,
            }),
        })
    }
}

impl<T: Copy> Solution<T> {
    /// The hub's accelerations as the kernels take them.
    #[inline(always)]
    pub(crate) fn expressed_in_b(&self) -> BodyAcceleration<T> {
        let [r_b_n_ddot_bx, r_b_n_ddot_by, r_b_n_ddot_bz] = self.r_b_n_ddot;
        let [omega_dot_bx, omega_dot_by, omega_dot_bz] = self.omega_dot;
        BodyAcceleration {
            r_b_n_ddot_bx,
            r_b_n_ddot_by,
            r_b_n_ddot_bz,
            omega_dot_bx,
            omega_dot_by,
            omega_dot_bz,
        }
    }
}

/// The hub's angular velocity as the kernels take it.
#[inline(always)]
pub(crate) fn expressed_in_b<T>([omega_bx, omega_by, omega_bz]: Vec3<T>) -> BodyRate<T> {
    BodyRate { omega_bx, omega_by, omega_bz }
}
