//! Centres of mass of one device from B, pages 2 and 3: (12)-(14), as expanded there.

use precess_dynamics::Scalar;

use super::known::Known;
use crate::newton_euler::vector::{Vector, cross};

/// Positions, m, with their derivatives seen from B, m/s and m/s^2.
#[expect(clippy::struct_field_names, reason = "a position is called r on the pages")]
pub(super) struct Positions<T> {
    pub(super) r_goc_b: Vector<T>,
    pub(super) r_goc_b_prime: Vector<T>,
    pub(super) r_goc_b_dprime: Vector<T>,
    pub(super) r_gic_b: Vector<T>,
    pub(super) r_gic_b_prime: Vector<T>,
    pub(super) r_gic_b_dprime: Vector<T>,
    pub(super) r_wc_b: Vector<T>,
    pub(super) r_wc_b_prime: Vector<T>,
    pub(super) r_wc_b_dprime: Vector<T>,
}

impl<T: Scalar> Positions<T> {
    pub(super) fn new(known: &Known<T>) -> Self {
        let Known { r_go_b, r_goc_go, l_o, r_gic_gi, l_i, r_wc_w, .. } = *known;
        let Known { s_z_hat, gamma_o_dot, gamma_o_ddot, .. } = *known;

        // (step)
        let r_goc_b_prime = cross(s_z_hat * gamma_o_dot, r_goc_go);
        // (12)
        let r_goc_b_dprime =
            cross(s_z_hat * gamma_o_ddot, r_goc_go) + cross(s_z_hat * gamma_o_dot, r_goc_b_prime);

        Self {
            // (step)
            r_goc_b: r_go_b + r_goc_go,
            r_goc_b_prime,
            r_goc_b_dprime,
            // (step)
            r_gic_b: r_go_b + l_o + r_gic_gi,
            r_gic_b_prime: r_gic_b_prime(known),
            r_gic_b_dprime: r_gic_b_dprime(known),
            // (67)
            r_wc_b: r_go_b + l_o + l_i + r_wc_w,
            r_wc_b_prime: r_wc_b_prime(known),
            r_wc_b_dprime: r_wc_b_dprime(known),
        }
    }
}

/// (step)
fn r_gic_b_prime<T: Scalar>(known: &Known<T>) -> Vector<T> {
    let Known { gamma_o_dot, gamma_i_dot, g_x_hat, s_y_hat, s_z_hat, r_gic_gi, .. } = *known;
    let [l_o_x, l_o_y, _] = known.l_o_xyz;
    let r_gic_gi_prime = cross(s_z_hat * gamma_o_dot + s_y_hat * gamma_i_dot, r_gic_gi);
    (s_y_hat * l_o_x - g_x_hat * l_o_y) * gamma_o_dot + r_gic_gi_prime
}

/// (13)
fn r_gic_b_dprime<T: Scalar>(known: &Known<T>) -> Vector<T> {
    let Known { gamma_o_dot, gamma_i_dot, gamma_o_ddot, gamma_i_ddot, .. } = *known;
    let Known { g_x_hat, s_y_hat, s_z_hat, r_gic_gi, .. } = *known;
    let [l_o_x, l_o_y, _] = known.l_o_xyz;
    let r_gic_gi_prime = cross(s_z_hat * gamma_o_dot + s_y_hat * gamma_i_dot, r_gic_gi);
    cross(
        s_z_hat * gamma_o_ddot + s_y_hat * gamma_i_ddot - g_x_hat * (gamma_i_dot * gamma_o_dot),
        r_gic_gi,
    ) + cross(s_z_hat * gamma_o_dot + s_y_hat * gamma_i_dot, r_gic_gi_prime)
        + s_y_hat * (l_o_x * gamma_o_ddot - l_o_y * sq(gamma_o_dot))
        - g_x_hat * (l_o_x * sq(gamma_o_dot) + l_o_y * gamma_o_ddot)
}

/// (step)
fn r_wc_b_prime<T: Scalar>(known: &Known<T>) -> Vector<T> {
    let Known { d, si, ci, st, ct, gamma_o_dot, gamma_i_dot, spin, .. } = *known;
    let Known { s_x_hat, s_y_hat, g_z_hat, .. } = *known;
    let ([l_o_x, l_o_y, _], [l_i_x, l_i_y, l_i_z]) = (known.l_o_xyz, known.l_i_xyz);
    s_x_hat
        * (d * (gamma_i_dot * st - gamma_o_dot * ci * ct) - l_i_y * gamma_o_dot * ci
            + l_i_z * gamma_i_dot
            - l_o_y * gamma_o_dot * ci)
        + s_y_hat
            * (-d * (spin - gamma_o_dot * si) * st
                + l_i_x * gamma_o_dot * ci
                + l_i_z * gamma_o_dot * si
                + l_o_x * gamma_o_dot)
        + g_z_hat
            * (d * (spin - gamma_o_dot * si) * ct
                - l_i_x * gamma_i_dot
                - l_i_y * gamma_o_dot * si
                - l_o_y * gamma_o_dot * si)
}

/// (14)
fn r_wc_b_dprime<T: Scalar>(known: &Known<T>) -> Vector<T> {
    let Known { d, si, ci, st, ct, gamma_o_dot, gamma_i_dot, spin, .. } = *known;
    let Known { gamma_o_ddot, gamma_i_ddot, spin_dot, s_x_hat, s_y_hat, g_z_hat, .. } = *known;
    let ([l_o_x, l_o_y, _], [l_i_x, l_i_y, l_i_z]) = (known.l_o_xyz, known.l_i_xyz);
    let two = T::from_f64(2.0);

    let along_s_x = d
        * (gamma_i_ddot * st - gamma_o_ddot * ci * ct
            + two * spin * gamma_i_dot * ct
            + two * spin * gamma_o_dot * ci * st
            - sq(gamma_o_dot) * si * ci * st)
        - l_i_x * (sq(gamma_o_dot) * sq(ci) + sq(gamma_i_dot))
        - l_i_y * gamma_o_ddot * ci
        + l_i_z * (gamma_i_ddot - sq(gamma_o_dot) * si * ci)
        - l_o_x * sq(gamma_o_dot) * ci
        - l_o_y * gamma_o_ddot * ci;

    let along_s_y = d
        * (gamma_o_ddot * si * st - spin_dot * st + two * gamma_o_dot * gamma_i_dot * ci * st
            - sq(gamma_o_dot) * ct
            + two * spin * gamma_o_dot * si * ct
            - sq(spin) * ct)
        + l_i_x * (gamma_o_ddot * ci - two * gamma_o_dot * gamma_i_dot * si)
        - l_i_y * sq(gamma_o_dot)
        + l_i_z * (gamma_o_ddot * si + two * gamma_o_dot * gamma_i_dot * ci)
        + l_o_x * gamma_o_ddot
        - l_o_y * sq(gamma_o_dot);

    let along_g_z = d
        * (spin_dot * ct
            - gamma_o_ddot * si * ct
            - sq(gamma_o_dot) * sq(si) * st
            - sq(gamma_i_dot) * st
            + two * spin * gamma_o_dot * si * st
            - sq(spin) * st)
        - l_i_x * (gamma_i_ddot + sq(gamma_o_dot) * si * ci)
        - l_i_y * gamma_o_ddot * si
        - l_i_z * (sq(gamma_i_dot) + sq(gamma_o_dot) * sq(si))
        - l_o_x * sq(gamma_o_dot) * si
        - l_o_y * gamma_o_ddot * si;

    s_x_hat * along_s_x + s_y_hat * along_s_y + g_z_hat * along_g_z
}

/// The square, as the pages write it.
pub(super) fn sq<T: Scalar>(x: T) -> T {
    x * x
}
