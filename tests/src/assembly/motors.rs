//! The motor torques of one device, pages 9 to 11: (78)-(97), (99)-(115), (117)-(121).

use precess_dynamics::Scalar;

use super::Device;
use super::inertias::Inertias;
use super::known::Known;
use super::positions::{Positions, sq};
use super::rotation::alpha_w;
use crate::newton_euler::vector::{Vector, cross, dot, tilde};

/// (80): the moment of D about Go along the outer joint's axis.
pub(super) fn u_o<T: Scalar>(device: &Device<T>) -> T {
    let Known { m_go, m_gi, m_w, s_z_hat, r_b_n_ddot, .. } = device.known;
    let Known { r_go_b, r_goc_go, l_o, r_gic_gi, l_i, r_wc_w, .. } = device.known;
    let Positions { r_goc_b, r_goc_b_prime, r_goc_b_dprime, .. } = device.positions;
    let Positions { r_gic_b, r_gic_b_prime, r_gic_b_dprime, .. } = device.positions;
    let Positions { r_wc_b, r_wc_b_prime, r_wc_b_dprime, .. } = device.positions;

    let m_d = m_go + m_gi + m_w;
    let rho_go = m_go * m_d.recip(); // (92)
    let rho_gi_d = m_gi * m_d.recip(); // (93)
    let rho_w_d = m_w * m_d.recip(); // (94)

    // (89), (90), (91)
    let r_dc_go =
        (r_goc_go * m_go + (l_o + r_gic_gi) * m_gi + (l_o + l_i + r_wc_w) * m_w) * m_d.recip();
    let r_dc_go_prime = r_goc_b_prime * rho_go + r_gic_b_prime * rho_gi_d + r_wc_b_prime * rho_w_d;
    let r_dc_go_dprime =
        r_goc_b_dprime * rho_go + r_gic_b_dprime * rho_gi_d + r_wc_b_dprime * rho_w_d;
    let r_dc_b = r_go_b + r_dc_go;
    let (r_dc_b_prime, r_dc_b_dprime) = (r_dc_go_prime, r_dc_go_dprime);

    let r_dc_b_ddot = ddot(&device.known, r_dc_b, r_dc_b_prime, r_dc_b_dprime); // (97)
    let r_dc_n_ddot = r_dc_b_ddot + r_b_n_ddot; // (95)

    // (87), (88) and the wheel's, which is not printed
    let about_dc = |r, r_prime, r_dprime| {
        ddot(&device.known, r - r_dc_b, r_prime - r_dc_b_prime, r_dprime - r_dc_b_dprime)
    };
    let r_goc_dc_ddot = about_dc(r_goc_b, r_goc_b_prime, r_goc_b_dprime);
    let r_gic_dc_ddot = about_dc(r_gic_b, r_gic_b_prime, r_gic_b_dprime);
    let r_wc_dc_ddot = about_dc(r_wc_b, r_wc_b_prime, r_wc_b_dprime);

    // (81), (82), (83)
    let h_go_dc_dot = h_go_goc_dot(device) + cross(r_goc_b - r_dc_b, r_goc_dc_ddot) * m_go;
    let h_gi_dc_dot = h_gi_gic_dot(device) + cross(r_gic_b - r_dc_b, r_gic_dc_ddot) * m_gi;
    let h_w_dc_dot = h_w_wc_dot(device) + cross(r_wc_b - r_dc_b, r_wc_dc_ddot) * m_w;

    let l_d = h_go_dc_dot + h_gi_dc_dot + h_w_dc_dot; // (79)
    let l_go = l_d + cross(r_dc_go, r_dc_n_ddot * m_d); // (78)
    dot(s_z_hat, l_go) // (80)
}

/// (101): the moment of V about Gi along the inner joint's axis.
pub(super) fn u_i<T: Scalar>(device: &Device<T>) -> T {
    let Known { m_gi, m_w, s_y_hat, s_z_hat, g_x_hat, r_b_n_ddot, .. } = device.known;
    let Known { r_go_b, l_o, r_gic_gi, l_i, r_wc_w, omega_gi_b, omega_w_b, .. } = device.known;
    let Known { gamma_o_dot, gamma_i_dot, gamma_o_ddot, gamma_i_ddot, .. } = device.known;
    let Positions { r_gic_b, r_gic_b_prime, r_gic_b_dprime, .. } = device.positions;
    let Positions { r_wc_b, r_wc_b_prime, r_wc_b_dprime, .. } = device.positions;
    let [l_o_x, l_o_y, _] = device.known.l_o_xyz;

    let m_v = m_gi + m_w;
    let rho_gi_v = m_gi * m_v.recip(); // (111)
    let rho_w_v = m_w * m_v.recip(); // (112)

    // (108)
    let r_vc_gi = (r_gic_gi * m_gi + (l_i + r_wc_w) * m_w) * m_v.recip();

    // (109)
    let r_gic_gi_prime = cross(omega_gi_b, r_gic_gi);
    let r_wc_gi_prime = cross(omega_gi_b, l_i) + cross(omega_w_b, r_wc_w);
    let r_vc_gi_prime = r_gic_gi_prime * rho_gi_v + r_wc_gi_prime * rho_w_v;

    // (110)
    let alpha_gi = s_z_hat * gamma_o_ddot
        + s_y_hat * gamma_i_ddot
        + cross(s_z_hat, s_y_hat) * (gamma_o_dot * gamma_i_dot);
    let alpha_w = alpha_w(&device.known);
    let r_gic_gi_dprime =
        cross(alpha_gi, r_gic_gi) + cross(omega_gi_b, cross(omega_gi_b, r_gic_gi));
    let r_wc_gi_dprime = cross(alpha_gi, l_i)
        + cross(omega_gi_b, cross(omega_gi_b, l_i))
        + cross(alpha_w, r_wc_w)
        + cross(omega_w_b, cross(omega_w_b, r_wc_w));
    let r_vc_gi_dprime = r_gic_gi_dprime * rho_gi_v + r_wc_gi_dprime * rho_w_v;

    let r_vc_b = r_go_b + l_o + r_vc_gi;
    let r_vc_b_prime = r_vc_gi_prime + (s_y_hat * l_o_x - g_x_hat * l_o_y) * gamma_o_dot;
    let r_vc_b_dprime = r_vc_gi_dprime + s_y_hat * (l_o_x * gamma_o_ddot - l_o_y * sq(gamma_o_dot))
        - g_x_hat * (l_o_x * sq(gamma_o_dot) + l_o_y * gamma_o_ddot);

    let r_vc_b_ddot = ddot(&device.known, r_vc_b, r_vc_b_prime, r_vc_b_dprime); // (115)
    let r_vc_n_ddot = r_vc_b_ddot + r_b_n_ddot; // (113)

    // (106), (107)
    let about_vc = |r, r_prime, r_dprime| {
        ddot(&device.known, r - r_vc_b, r_prime - r_vc_b_prime, r_dprime - r_vc_b_dprime)
    };
    let r_gic_vc_ddot = about_vc(r_gic_b, r_gic_b_prime, r_gic_b_dprime);
    let r_wc_vc_ddot = about_vc(r_wc_b, r_wc_b_prime, r_wc_b_dprime);

    // (102), (103)
    let h_gi_vc_dot = h_gi_gic_dot(device) + cross(r_gic_b - r_vc_b, r_gic_vc_ddot) * m_gi;
    let h_w_vc_dot = h_w_wc_dot(device) + cross(r_wc_b - r_vc_b, r_wc_vc_ddot) * m_w;

    let l_v = h_gi_vc_dot + h_w_vc_dot; // (100)
    let l_gi = l_v + cross(r_vc_gi, r_vc_n_ddot * m_v); // (99)
    dot(s_y_hat, l_gi) // (101)
}

/// (119): the moment of the wheel about W along its axis.
pub(super) fn u_w<T: Scalar>(device: &Device<T>) -> T {
    let Known { m_w, s_x_hat, omega, omega_dot, r_wc_w, r_b_n_ddot, .. } = device.known;
    let Positions { r_wc_b, r_wc_b_prime, r_wc_b_dprime, .. } = device.positions;
    let two = T::from_f64(2.0);

    // (121)
    let r_wc_n_ddot = r_wc_b_dprime
        + tilde(r_wc_b).transpose() * omega_dot
        + tilde(r_wc_b_prime).transpose() * omega * two
        + tilde(omega) * (tilde(omega) * r_wc_b)
        + r_b_n_ddot;
    let l_wc = h_w_wc_dot(device); // (118)
    let l_w = l_wc + cross(r_wc_w, r_wc_n_ddot * m_w); // (117)
    dot(s_x_hat, l_w) // (119)
}

/// (84)
fn h_go_goc_dot<T: Scalar>(device: &Device<T>) -> Vector<T> {
    let Known { omega, omega_dot, omega_go_n, s_z_hat, gamma_o_ddot, .. } = device.known;
    let Inertias { i_go_goc, i_go_goc_prime, .. } = device.inertias;
    i_go_goc * (omega_dot + s_z_hat * gamma_o_ddot)
        + i_go_goc_prime * omega_go_n
        + tilde(omega) * (i_go_goc * omega_go_n)
}

/// (85), (104)
fn h_gi_gic_dot<T: Scalar>(device: &Device<T>) -> Vector<T> {
    let Known { omega, omega_dot, omega_gi_n, s_y_hat, s_z_hat, .. } = device.known;
    let Known { gamma_o_dot, gamma_i_dot, gamma_o_ddot, gamma_i_ddot, .. } = device.known;
    let Inertias { i_gi_gic, i_gi_gic_prime, .. } = device.inertias;
    i_gi_gic
        * (omega_dot
            + s_z_hat * gamma_o_ddot
            + s_y_hat * gamma_i_ddot
            + cross(s_z_hat, s_y_hat) * (gamma_o_dot * gamma_i_dot))
        + i_gi_gic_prime * omega_gi_n
        + tilde(omega) * (i_gi_gic * omega_gi_n)
}

/// (86), (105), (120)
fn h_w_wc_dot<T: Scalar>(device: &Device<T>) -> Vector<T> {
    let Known { omega, omega_dot, omega_w_n, .. } = device.known;
    let Inertias { i_w_wc, i_w_wc_prime, .. } = device.inertias;
    i_w_wc * (omega_dot + alpha_w(&device.known))
        + i_w_wc_prime * omega_w_n
        + tilde(omega) * (i_w_wc * omega_w_n)
}

/// (97), (115); (87), (88), (106), (107) for a difference of two positions.
fn ddot<T: Scalar>(
    known: &Known<T>,
    r: Vector<T>,
    r_prime: Vector<T>,
    r_dprime: Vector<T>,
) -> Vector<T> {
    let Known { omega, omega_dot, .. } = *known;
    let two = T::from_f64(2.0);
    r_dprime + cross(omega_dot, r) + cross(omega, r_prime) * two + cross(omega, cross(omega, r))
}
