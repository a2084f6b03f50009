//! The translational equation, pages 4 and 6: (7), (9), (16) and (17).

use precess_dynamics::Scalar;

use super::known::{Known, Motion};
use super::positions::sq;
use super::{Body, Device};
use crate::newton_euler::vector::{Vector, cross, tilde};

/// `m_sc` times (16): by (6) the force on the system.
pub(super) fn force<T: Scalar>(
    body: &Body<T>,
    motion: &Motion<T>,
    devices: &[Device<T>],
) -> Vector<T> {
    let Motion { omega, omega_dot, r_b_n_ddot } = *motion;
    let two = T::from_f64(2.0);
    let m_sc = m_sc(body, devices);
    let c = c(body, devices);
    let c_prime = c_prime(body, devices);
    let second_order = devices.iter().fold(Vector::zero(), |sum, device| {
        let Known { gamma_o_ddot, gamma_i_ddot, spin_dot, .. } = device.known;
        sum + f_o(&device.known) * gamma_o_ddot
            + f_i(&device.known) * gamma_i_ddot
            + f_w(&device.known) * spin_dot
    });
    let f_tilde = devices.iter().fold(Vector::zero(), |sum, device| sum + f_tilde(device));

    // (16)
    (r_b_n_ddot - tilde(c) * omega_dot
        + tilde(omega) * c_prime * two
        + tilde(omega) * (tilde(omega) * c))
        * m_sc
        + second_order
        + f_tilde
}

/// (7)
pub(super) fn m_sc<T: Scalar>(body: &Body<T>, devices: &[Device<T>]) -> T {
    devices.iter().fold(body.m_b, |sum, device| {
        let Known { m_go, m_gi, m_w, .. } = device.known;
        sum + m_go + m_gi + m_w
    })
}

/// (9)
pub(super) fn c<T: Scalar>(body: &Body<T>, devices: &[Device<T>]) -> Vector<T> {
    let sum = devices.iter().fold(body.r_bc_b * body.m_b, |sum, device| {
        let (Known { m_go, m_gi, m_w, .. }, at) = (device.known, &device.positions);
        sum + at.r_goc_b * m_go + at.r_gic_b * m_gi + at.r_wc_b * m_w
    });
    sum * m_sc(body, devices).recip()
}

/// (step)
fn c_prime<T: Scalar>(body: &Body<T>, devices: &[Device<T>]) -> Vector<T> {
    let sum = devices.iter().fold(Vector::zero(), |sum, device| {
        let (Known { m_go, m_gi, m_w, .. }, at) = (device.known, &device.positions);
        sum + at.r_goc_b_prime * m_go + at.r_gic_b_prime * m_gi + at.r_wc_b_prime * m_w
    });
    sum * m_sc(body, devices).recip()
}

/// `f_o` of (17)
fn f_o<T: Scalar>(known: &Known<T>) -> Vector<T> {
    let Known { m_go, m_gi, m_w, d, si, ci, st, ct, r_goc_go, r_gic_gi, .. } = *known;
    let Known { g_x_hat, s_x_hat, s_y_hat, s_z_hat, g_z_hat, .. } = *known;
    let ([l_o_x, l_o_y, _], [l_i_x, l_i_y, l_i_z]) = (known.l_o_xyz, known.l_i_xyz);
    cross(s_z_hat, r_goc_go) * m_go
        + (cross(s_z_hat, r_gic_gi) + s_y_hat * l_o_x - g_x_hat * l_o_y) * m_gi
        + (s_x_hat * (-d * ci * ct - l_i_y * ci - l_o_y * ci)
            + s_y_hat * (d * si * st + l_i_x * ci + l_i_z * si + l_o_x)
            + g_z_hat * (-d * si * ct - l_i_y * si - l_o_y * si))
            * m_w
}

/// `f_i` of (17)
fn f_i<T: Scalar>(known: &Known<T>) -> Vector<T> {
    let Known { m_gi, m_w, d, st, r_gic_gi, s_x_hat, s_y_hat, g_z_hat, .. } = *known;
    let [l_i_x, _, l_i_z] = known.l_i_xyz;
    cross(s_y_hat, r_gic_gi) * m_gi + (s_x_hat * (d * st + l_i_z) - g_z_hat * l_i_x) * m_w
}

/// `f_w` of (17)
fn f_w<T: Scalar>(known: &Known<T>) -> Vector<T> {
    let Known { m_w, d, st, ct, s_y_hat, g_z_hat, .. } = *known;
    (s_y_hat * (-d * st) + g_z_hat * (d * ct)) * m_w
}

/// `f_tilde` of (17)
fn f_tilde<T: Scalar>(device: &Device<T>) -> Vector<T> {
    let known = &device.known;
    let Known { m_go, m_gi, m_w, d, si, ci, st, ct, .. } = *known;
    let Known { gamma_o_dot, gamma_i_dot, spin, r_gic_gi, .. } = *known;
    let Known { g_x_hat, s_x_hat, s_y_hat, s_z_hat, g_z_hat, .. } = *known;
    let ([l_o_x, l_o_y, _], [l_i_x, l_i_y, l_i_z]) = (known.l_o_xyz, known.l_i_xyz);
    let two = T::from_f64(2.0);
    let r_gic_gi_prime = cross(s_z_hat * gamma_o_dot + s_y_hat * gamma_i_dot, r_gic_gi);

    let wheel_x = d
        * (two * spin * gamma_i_dot * ct + two * spin * gamma_o_dot * ci * st
            - sq(gamma_o_dot) * si * ci * st)
        - l_i_x * (sq(gamma_o_dot) * sq(ci) + sq(gamma_i_dot))
        - l_i_z * sq(gamma_o_dot) * si * ci
        - l_o_x * sq(gamma_o_dot) * ci;
    let wheel_y = d
        * (two * gamma_o_dot * gamma_i_dot * ci * st - sq(gamma_o_dot) * ct
            + two * spin * gamma_o_dot * si * ct
            - sq(spin) * ct)
        - two * l_i_x * gamma_o_dot * gamma_i_dot * si
        - l_i_y * sq(gamma_o_dot)
        + two * l_i_z * gamma_o_dot * gamma_i_dot * ci
        - l_o_y * sq(gamma_o_dot);
    let wheel_z = d
        * (-sq(gamma_o_dot) * sq(si) - sq(gamma_i_dot) + two * spin * gamma_o_dot * si - sq(spin))
        * st
        - l_i_x * sq(gamma_o_dot) * si * ci
        - l_i_z * (sq(gamma_i_dot) + sq(gamma_o_dot) * sq(si))
        - l_o_x * sq(gamma_o_dot) * si;

    cross(s_z_hat * gamma_o_dot, device.positions.r_goc_b_prime) * m_go
        + (cross(s_z_hat * gamma_o_dot + s_y_hat * gamma_i_dot, r_gic_gi_prime)
            - cross(g_x_hat * (gamma_i_dot * gamma_o_dot), r_gic_gi)
            - (s_y_hat * l_o_y + g_x_hat * l_o_x) * sq(gamma_o_dot))
            * m_gi
        + (s_x_hat * wheel_x + s_y_hat * wheel_y + g_z_hat * wheel_z) * m_w
}
