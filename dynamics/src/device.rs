//! One device between the hub and its emitted kernel.
//!
//! The kernel knows one frame, the outer gimbal's axes at zero angle. Angular velocity and
//! acceleration are rotated into it by `mount^T`, its results out of it by `mount`.

use crate::error::{Joint, SolveError};
use crate::generated::dgvscmg::{
    self, Eliminated, Modes, Motors, Parameters, Prepared, Rates, Trig,
};
use crate::generated::hub::{BodyAcceleration, BodyRate, BodyVelocity, HubShare};
use crate::hub::BodySums;
use crate::parameters::Dgvscmg;
use crate::real::{Scalar, one, zero};
use crate::solve::{Solution, System, check_pivot};
use crate::state::{JointAccelerations, Joints, MotorTorques};
use crate::symmetric::Symmetric;
use crate::vec3::{
    Columns, Vec3, add, columns, components, rotate, rotate_tensor, rotate_transposed,
};

/// Constants of one device.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Device<T> {
    mount: Columns<T>,
    prepared: Prepared<T>,
    /// `m_D`, kg.
    pub(crate) mass: T,
}

impl<T: Scalar> Device<T> {
    pub(crate) fn new(p: &Dgvscmg<T>) -> Self {
        Self {
            mount: columns(&p.mount),
            prepared: dgvscmg::prepare(&parameters(p)),
            mass: p.m_go + p.m_gi + p.m_w,
        }
    }

    /// The device's equations with its three joints eliminated, in its own axes.
    ///
    /// Never inlined: one copy of the kernel, whatever the number of spacecraft kinds.
    #[inline(never)]
    pub(crate) fn eliminate(
        &self,
        joints: &Joints<T>,
        motors: &MotorTorques<T>,
        omega: Vec3<T>,
    ) -> Eliminated<T> {
        let [omega_bx, omega_by, omega_bz] = rotate_transposed(&self.mount, omega);
        dgvscmg::eliminate(
            &self.prepared,
            &trig(joints),
            &rates(joints),
            &BodyRate { omega_bx, omega_by, omega_bz },
            &Motors { u_o: motors.u_o, u_i: motors.u_i, u_w: motors.u_w },
            &all_driven(),
        )
    }

    /// Adds the device's share to the hub's system.
    #[rustfmt::skip]
    pub(crate) fn add_to(&self, system: &mut System<T>, e: &HubShare<T>) {
        let m_vv = Symmetric {
            xx: e.m_vv_11, xy: e.m_vv_12, xz: e.m_vv_13,
            yy: e.m_vv_22, yz: e.m_vv_23, zz: e.m_vv_33,
        };
        let m_vw = [
            [e.m_vw_11, e.m_vw_21, e.m_vw_31],
            [e.m_vw_12, e.m_vw_22, e.m_vw_32],
            [e.m_vw_13, e.m_vw_23, e.m_vw_33],
        ];
        let m_ww = Symmetric {
            xx: e.m_ww_11, xy: e.m_ww_12, xz: e.m_ww_13,
            yy: e.m_ww_22, yz: e.m_ww_23, zz: e.m_ww_33,
        };
        system.m_vv = system.m_vv.plus(m_vv.rotated(&self.mount));
        let [x, y, z] = rotate_tensor(&self.mount, &m_vw);
        let [sx, sy, sz] = system.m_vw;
        system.m_vw = [add(sx, x), add(sy, y), add(sz, z)];
        system.m_ww = system.m_ww.plus(m_ww.rotated(&self.mount));
        system.h_v = add(system.h_v, rotate(&self.mount, [e.h_v_1, e.h_v_2, e.h_v_3]));
        system.h_w = add(system.h_w, rotate(&self.mount, [e.h_w_1, e.h_w_2, e.h_w_3]));
    }

    /// The joints' accelerations once the hub's are known.
    pub(crate) fn back_substitute(
        &self,
        e: &Eliminated<T>,
        hub: &Solution<T>,
    ) -> JointAccelerations<T> {
        let [r_b_n_ddot_bx, r_b_n_ddot_by, r_b_n_ddot_bz] =
            rotate_transposed(&self.mount, hub.r_b_n_ddot);
        let [omega_dot_bx, omega_dot_by, omega_dot_bz] =
            rotate_transposed(&self.mount, hub.omega_dot);
        let found = dgvscmg::back_substitute(
            e,
            &BodyAcceleration {
                r_b_n_ddot_bx,
                r_b_n_ddot_by,
                r_b_n_ddot_bz,
                omega_dot_bx,
                omega_dot_by,
                omega_dot_bz,
            },
        );
        JointAccelerations {
            gamma_o_ddot: found.gamma_o_ddot,
            gamma_i_ddot: found.gamma_i_ddot,
            spin_dot: found.spin_dot,
        }
    }

    /// Kinetic energy and momenta of the device for the inertial velocity of B, along B axes.
    pub(crate) fn sums(
        &self,
        joints: &Joints<T>,
        r_b_n_dot: Vec3<T>,
        omega: Vec3<T>,
    ) -> BodySums<T> {
        let [r_b_n_dot_bx, r_b_n_dot_by, r_b_n_dot_bz] = rotate_transposed(&self.mount, r_b_n_dot);
        let [omega_bx, omega_by, omega_bz] = rotate_transposed(&self.mount, omega);
        let found = dgvscmg::energy_momentum(
            &self.prepared,
            &trig(joints),
            &rates(joints),
            &BodyVelocity {
                r_b_n_dot_bx,
                r_b_n_dot_by,
                r_b_n_dot_bz,
                omega_bx,
                omega_by,
                omega_bz,
            },
        );
        let linear = [found.linear_bx, found.linear_by, found.linear_bz];
        let angular_b = [found.angular_b_bx, found.angular_b_by, found.angular_b_bz];
        BodySums {
            energy: found.energy,
            linear: rotate(&self.mount, linear),
            angular_b: rotate(&self.mount, angular_b),
        }
    }

    /// First moment of the device about B and its derivative seen from B, along B axes.
    pub(crate) fn first_moment(&self, joints: &Joints<T>) -> (Vec3<T>, Vec3<T>) {
        let found = dgvscmg::first_moment(&self.prepared, &trig(joints), &rates(joints));
        (
            rotate(&self.mount, [found.mc_bx, found.mc_by, found.mc_bz]),
            rotate(&self.mount, [found.mc_prime_bx, found.mc_prime_by, found.mc_prime_bz]),
        )
    }
}

/// Refuses pivots that are rounding of their diagonals, in the order of the elimination: the first
/// one refused is the cause, those after it may be its consequence.
pub(crate) fn check_pivots<T: Scalar>(
    device: usize,
    e: &Eliminated<T>,
) -> Result<(), SolveError<T>> {
    for (joint, pivot, diagonal) in [
        (Joint::Wheel, e.pivot_w, e.diagonal_w),
        (Joint::InnerGimbal, e.pivot_i, e.diagonal_i),
        (Joint::OuterGimbal, e.pivot_o, e.diagonal_o),
    ] {
        check_pivot(pivot, diagonal).map_err(|small| SolveError::Singular {
            device: Some(device),
            joint: Some(joint),
            pivot: small.pivot,
            bound: small.bound,
        })?;
    }
    Ok(())
}

/// The torque of every joint is given.
fn all_driven<T: Scalar>() -> Modes<T> {
    let (zero, one) = (zero(), one());
    Modes {
        driven_o: one,
        held_o: zero,
        given_o: zero,
        driven_i: one,
        held_i: zero,
        given_i: zero,
        driven_w: one,
        held_w: zero,
        given_w: zero,
    }
}

fn trig<T: Scalar>(joints: &Joints<T>) -> Trig<T> {
    let (sin_gamma_o, cos_gamma_o) = joints.gamma_o.sin_cos();
    let (sin_gamma_i, cos_gamma_i) = joints.gamma_i.sin_cos();
    let (sin_theta, cos_theta) = joints.theta.sin_cos();
    Trig { sin_gamma_o, cos_gamma_o, sin_gamma_i, cos_gamma_i, sin_theta, cos_theta }
}

fn rates<T: Scalar>(joints: &Joints<T>) -> Rates<T> {
    Rates { gamma_o_dot: joints.gamma_o_dot, gamma_i_dot: joints.gamma_i_dot, spin: joints.spin }
}

/// The kernel's parameters: scalars, with `r_{Go/B}` turned from B axes into the device's axes.
fn parameters<T: Scalar>(p: &Dgvscmg<T>) -> Parameters<T> {
    let [r_go_b_bx, r_go_b_by, r_go_b_bz] =
        rotate_transposed(&columns(&p.mount), components(&p.r_go_b));
    let [r_goc_go_gox, r_goc_go_goy, r_goc_go_goz] = components(&p.r_goc_go);
    let [r_gic_gi_gix, r_gic_gi_giy, r_gic_gi_giz] = components(&p.r_gic_gi);
    let [l_o_x, l_o_y, l_o_z] = components(&p.l_o);
    let [l_i_x, l_i_y, l_i_z] = components(&p.l_i);
    let i_go = Symmetric::part_of(&p.i_go_goc);
    let i_gi = Symmetric::part_of(&p.i_gi_gic);
    let j = Symmetric::part_of(&p.i_w_wc);
    Parameters {
        m_go: p.m_go,
        m_gi: p.m_gi,
        m_w: p.m_w,
        d: p.d,
        r_go_b_bx,
        r_go_b_by,
        r_go_b_bz,
        l_o_x,
        l_o_y,
        l_o_z,
        l_i_x,
        l_i_y,
        l_i_z,
        r_goc_go_gox,
        r_goc_go_goy,
        r_goc_go_goz,
        r_gic_gi_gix,
        r_gic_gi_giy,
        r_gic_gi_giz,
        i_go_11: i_go.xx,
        i_go_12: i_go.xy,
        i_go_13: i_go.xz,
        i_go_22: i_go.yy,
        i_go_23: i_go.yz,
        i_go_33: i_go.zz,
        i_gi_11: i_gi.xx,
        i_gi_12: i_gi.xy,
        i_gi_13: i_gi.xz,
        i_gi_22: i_gi.yy,
        i_gi_23: i_gi.yz,
        i_gi_33: i_gi.zz,
        j_11: j.xx,
        j_12: j.xy,
        j_13: j.xz,
        j_22: j.yy,
        j_23: j.yz,
        j_33: j.zz,
    }
}
