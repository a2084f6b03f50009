//! The rotational equation, pages 6 to 8: (29), (30), (43), (58), (74) and (75).

use precess_dynamics::Scalar;

use super::inertias::{Inertias, parallel_axis};
use super::known::{Known, Motion};
use super::positions::Positions;
use super::translation::{c, m_sc};
use super::{Body, Device};
use crate::newton_euler::vector::{Vector, cross, tilde};

/// (75)
pub(super) fn torque_b<T: Scalar>(
    body: &Body<T>,
    motion: &Motion<T>,
    devices: &[Device<T>],
) -> Vector<T> {
    let hub =
        tilde(c(body, devices)) * motion.r_b_n_ddot * m_sc(body, devices) + h_b_b_dot(body, motion);
    devices
        .iter()
        .fold(hub, |sum, device| sum + h_go_b_dot(device) + h_gi_b_dot(device) + h_w_b_dot(device))
}

/// (30)
fn h_b_b_dot<T: Scalar>(body: &Body<T>, motion: &Motion<T>) -> Vector<T> {
    let Motion { omega, omega_dot, .. } = *motion;
    let Body { m_b, r_bc_b, i_b_bc } = *body;
    let i_b_b = i_b_bc + parallel_axis(r_bc_b, r_bc_b) * m_b; // (29)
    i_b_b * omega_dot + tilde(omega) * (i_b_b * omega)
}

/// (43)
fn h_go_b_dot<T: Scalar>(device: &Device<T>) -> Vector<T> {
    let Known { m_go, omega, omega_dot, s_z_hat, gamma_o_dot, gamma_o_ddot, .. } = device.known;
    let Known { r_goc_go, .. } = device.known;
    let Positions { r_goc_b, r_goc_b_prime, .. } = device.positions;
    let Inertias { i_go_goc, i_go_goc_prime, i_go_b, i_go_b_prime, .. } = device.inertias;
    i_go_b * omega_dot
        + i_go_b_prime * omega
        + tilde(omega) * (i_go_b * omega)
        + i_go_goc * s_z_hat * gamma_o_ddot
        + i_go_goc_prime * s_z_hat * gamma_o_dot
        + tilde(omega) * (i_go_goc * s_z_hat) * gamma_o_dot
        + tilde(r_goc_b)
            * (tilde(s_z_hat) * r_goc_go * gamma_o_ddot
                + tilde(s_z_hat) * r_goc_b_prime * gamma_o_dot)
            * m_go
        + tilde(omega) * (tilde(r_goc_b) * r_goc_b_prime) * m_go
}

/// (58)
fn h_gi_b_dot<T: Scalar>(device: &Device<T>) -> Vector<T> {
    let Known { m_gi, si, ci, omega, omega_dot, omega_gi_b, .. } = device.known;
    let Known { gamma_o_dot, gamma_i_dot, gamma_o_ddot, gamma_i_ddot, .. } = device.known;
    let Known { s_x_hat, s_y_hat, s_z_hat, g_z_hat, .. } = device.known;
    let Positions { r_gic_b, r_gic_b_prime, r_gic_b_dprime, .. } = device.positions;
    let Inertias { i_gi_gic, i_gi_gic_prime, i_gi_b, i_gi_b_prime, .. } = device.inertias;
    i_gi_b * omega_dot
        + i_gi_b_prime * omega
        + tilde(omega) * (i_gi_b * omega)
        + i_gi_gic
            * (s_z_hat * gamma_o_ddot + s_y_hat * gamma_i_ddot
                - s_x_hat * (gamma_i_dot * gamma_o_dot * ci)
                - g_z_hat * (gamma_i_dot * gamma_o_dot * si))
        + i_gi_gic_prime * omega_gi_b
        + tilde(omega) * (i_gi_gic * omega_gi_b)
        + tilde(r_gic_b) * r_gic_b_dprime * m_gi
        + tilde(omega) * (tilde(r_gic_b) * r_gic_b_prime) * m_gi
}

/// (74)
fn h_w_b_dot<T: Scalar>(device: &Device<T>) -> Vector<T> {
    let Known { m_w, omega, omega_dot, omega_w_b, .. } = device.known;
    let Positions { r_wc_b, r_wc_b_prime, r_wc_b_dprime, .. } = device.positions;
    let Inertias { i_w_wc, i_w_wc_prime, i_w_b, i_w_b_prime, .. } = device.inertias;
    i_w_b * omega_dot
        + i_w_b_prime * omega
        + tilde(omega) * (i_w_b * omega)
        + i_w_wc * alpha_w(&device.known)
        + i_w_wc_prime * omega_w_b
        + tilde(omega) * (i_w_wc * omega_w_b)
        + tilde(r_wc_b) * r_wc_b_dprime * m_w
        + tilde(omega) * (tilde(r_wc_b) * r_wc_b_prime) * m_w
}

/// The bracket of (74), (86), (105) and (120), less `omega_dot`: (C) of page 1 with the cross
/// products of the axes kept.
pub(super) fn alpha_w<T: Scalar>(known: &Known<T>) -> Vector<T> {
    let Known { gamma_o_dot, gamma_i_dot, spin, .. } = *known;
    let Known { gamma_o_ddot, gamma_i_ddot, spin_dot, s_x_hat, s_y_hat, s_z_hat, .. } = *known;
    s_z_hat * gamma_o_ddot
        + s_y_hat * gamma_i_ddot
        + s_x_hat * spin_dot
        + cross(s_z_hat, s_y_hat) * (gamma_o_dot * gamma_i_dot)
        + cross(s_z_hat, s_x_hat) * (gamma_o_dot * spin)
        + cross(s_y_hat, s_x_hat) * (gamma_i_dot * spin)
}
