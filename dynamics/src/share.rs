//! What a device and the hub exchange: from B axes into the device's own, and back.
//!
//! The kernels know one frame, the axes of the device's first joint at zero. What comes from the hub
//! is rotated into it by `mount^T`, results out of it by `mount`. Over any number: lanes do the same.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use crate::generated::hub::{BodyAcceleration, BodyRate, HubShare};
use crate::real::Real;
use crate::solve::System;
use crate::symmetric::Symmetric;
use crate::vec3::{Columns, Vec3, add, rotate, rotate_tensor, rotate_transposed};

/// The angular velocity of B along a device's axes.
#[inline(always)]
pub(crate) fn rate_in_device<T: Real>(mount: &Columns<T>, omega: Vec3<T>) -> BodyRate<T> {
    let [omega_bx, omega_by, omega_bz] = rotate_transposed(mount, omega);
    BodyRate { omega_bx, omega_by, omega_bz }
}

/// The hub's accelerations along a device's axes.
#[inline(always)]
pub(crate) fn in_device<T: Real>(
    mount: &Columns<T>,
    r_b_n_ddot: Vec3<T>,
    omega_dot: Vec3<T>,
) -> BodyAcceleration<T> {
    let [r_b_n_ddot_bx, r_b_n_ddot_by, r_b_n_ddot_bz] = rotate_transposed(mount, r_b_n_ddot);
    let [omega_dot_bx, omega_dot_by, omega_dot_bz] = rotate_transposed(mount, omega_dot);
    BodyAcceleration {
        r_b_n_ddot_bx,
        r_b_n_ddot_by,
        r_b_n_ddot_bz,
        omega_dot_bx,
        omega_dot_by,
        omega_dot_bz,
    }
}

/// A device's share as a system along B axes.
#[inline(always)]
#[rustfmt::skip]
pub(crate) fn along_b<T: Real>(mount: &Columns<T>, e: &HubShare<T>) -> System<T> {
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
    System {
        m_vv: m_vv.rotated(mount),
        m_vw: rotate_tensor(mount, &m_vw),
        m_ww: m_ww.rotated(mount),
        h_v: rotate(mount, [e.h_v_1, e.h_v_2, e.h_v_3]),
        h_w: rotate(mount, [e.h_w_1, e.h_w_2, e.h_w_3]),
    }
}

/// The sum of two systems, number by number.
#[inline(always)]
pub(crate) fn sum<T: Real>(a: &System<T>, b: &System<T>) -> System<T> {
    let ([ax, ay, az], [bx, by, bz]) = (a.m_vw, b.m_vw);
    System {
        m_vv: a.m_vv.plus(b.m_vv),
        m_vw: [add(ax, bx), add(ay, by), add(az, bz)],
        m_ww: a.m_ww.plus(b.m_ww),
        h_v: add(a.h_v, b.h_v),
        h_w: add(a.h_w, b.h_w),
    }
}
