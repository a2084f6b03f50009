//! Inertia tensors of one device and their derivatives seen from B, page 5: (35)-(36), (40), (42),
//! (48)-(52), (55), (57), (63)-(64), (71), (73).

use precess_dynamics::Scalar;

use super::known::Known;
use super::positions::Positions;
use crate::newton_euler::vector::{Tensor, Vector, tilde};

/// About the bodies' own centres of mass and about B, kg m^2; derivatives in kg m^2/s.
#[expect(clippy::struct_field_names, reason = "an inertia is called i on the pages")]
pub(super) struct Inertias<T> {
    pub(super) i_go_goc: Tensor<T>,
    pub(super) i_go_goc_prime: Tensor<T>,
    pub(super) i_go_b: Tensor<T>,
    pub(super) i_go_b_prime: Tensor<T>,
    pub(super) i_gi_gic: Tensor<T>,
    pub(super) i_gi_gic_prime: Tensor<T>,
    pub(super) i_gi_b: Tensor<T>,
    pub(super) i_gi_b_prime: Tensor<T>,
    pub(super) i_w_wc: Tensor<T>,
    pub(super) i_w_wc_prime: Tensor<T>,
    pub(super) i_w_b: Tensor<T>,
    pub(super) i_w_b_prime: Tensor<T>,
}

impl<T: Scalar> Inertias<T> {
    pub(super) fn new(known: &Known<T>, positions: &Positions<T>) -> Self {
        let Known { m_go, m_gi, m_w, i_go, i_gi, j, .. } = *known;
        let Known { g_x_hat, s_x_hat, s_y_hat, s_z_hat, g_z_hat, w_y_hat, w_z_hat, .. } = *known;
        let Positions { r_goc_b, r_goc_b_prime, r_gic_b, r_gic_b_prime, .. } = *positions;
        let Positions { r_wc_b, r_wc_b_prime, .. } = *positions;

        let i_go_goc = tensor([g_x_hat, s_y_hat, s_z_hat], i_go); // (35)
        let i_gi_gic = tensor([s_x_hat, s_y_hat, g_z_hat], i_gi); // (48)
        let i_w_wc = tensor([s_x_hat, w_y_hat, w_z_hat], j); // (63)

        let i_go_goc_prime = i_go_goc_prime(known);
        let i_gi_gic_prime = i_gi_gic_prime(known);
        let i_w_wc_prime = i_w_wc_prime(known);

        Self {
            i_go_goc,
            i_go_goc_prime,
            i_go_b: i_go_goc + parallel_axis(r_goc_b, r_goc_b) * m_go, // (40)
            i_go_b_prime: i_go_goc_prime
                + parallel_axis(r_goc_b_prime, r_goc_b) * m_go
                + parallel_axis(r_goc_b, r_goc_b_prime) * m_go, // (42)
            i_gi_gic,
            i_gi_gic_prime,
            i_gi_b: i_gi_gic + parallel_axis(r_gic_b, r_gic_b) * m_gi, // (55)
            i_gi_b_prime: i_gi_gic_prime
                + parallel_axis(r_gic_b_prime, r_gic_b) * m_gi
                + parallel_axis(r_gic_b, r_gic_b_prime) * m_gi, // (57)
            i_w_wc,
            i_w_wc_prime,
            i_w_b: i_w_wc + parallel_axis(r_wc_b, r_wc_b) * m_w, // (71)
            i_w_b_prime: i_w_wc_prime
                + parallel_axis(r_wc_b_prime, r_wc_b) * m_w
                + parallel_axis(r_wc_b, r_wc_b_prime) * m_w, // (73)
        }
    }
}

/// The tensor with these components along these unit vectors.
fn tensor<T: Scalar>(axes: [Vector<T>; 3], components: [[T; 3]; 3]) -> Tensor<T> {
    Tensor(components).resolved_from(Tensor::of_columns(axes))
}

/// `tilde(a) transpose(tilde(b))`
pub(super) fn parallel_axis<T: Scalar>(a: Vector<T>, b: Vector<T>) -> Tensor<T> {
    tilde(a) * tilde(b).transpose()
}

/// (36)
fn i_go_goc_prime<T: Scalar>(known: &Known<T>) -> Tensor<T> {
    let Known { gamma_o_dot, g_x_hat, s_y_hat, s_z_hat, .. } = *known;
    let [[i_go_11, i_go_12, i_go_13], [_, i_go_22, i_go_23], _] = known.i_go;
    let (zero, two) = (T::from_f64(0.0), T::from_f64(2.0));
    tensor(
        [g_x_hat, s_y_hat, s_z_hat],
        [
            [-two * i_go_12, i_go_11 - i_go_22, -i_go_23],
            [i_go_11 - i_go_22, two * i_go_12, i_go_13],
            [-i_go_23, i_go_13, zero],
        ],
    ) * gamma_o_dot
}

/// (49)-(52)
fn i_gi_gic_prime<T: Scalar>(known: &Known<T>) -> Tensor<T> {
    let Known { si, ci, gamma_o_dot, gamma_i_dot, s_x_hat, s_y_hat, g_z_hat, .. } = *known;
    let [[i_gi_11, i_gi_12, i_gi_13], [_, i_gi_22, i_gi_23], [_, _, i_gi_33]] = known.i_gi;
    let two = T::from_f64(2.0);
    let t_11 = i_gi_13 * gamma_i_dot - i_gi_12 * gamma_o_dot * ci;
    let t_22 = i_gi_12 * gamma_o_dot * ci + i_gi_23 * gamma_o_dot * si;
    let t_33 = -i_gi_23 * gamma_o_dot * si - i_gi_13 * gamma_i_dot;
    let t_12 = i_gi_11 * gamma_o_dot * ci + i_gi_13 * gamma_o_dot * si - i_gi_22 * gamma_o_dot * ci
        + i_gi_23 * gamma_i_dot;
    let t_13 = -i_gi_11 * gamma_i_dot - i_gi_12 * gamma_o_dot * si - i_gi_23 * gamma_o_dot * ci
        + i_gi_33 * gamma_i_dot;
    let t_23 = -i_gi_12 * gamma_i_dot + i_gi_13 * gamma_o_dot * ci - i_gi_22 * gamma_o_dot * si
        + i_gi_33 * gamma_o_dot * si;
    tensor(
        [s_x_hat, s_y_hat, g_z_hat],
        [[two * t_11, t_12, t_13], [t_12, two * t_22, t_23], [t_13, t_23, two * t_33]],
    )
}

/// (64)
fn i_w_wc_prime<T: Scalar>(known: &Known<T>) -> Tensor<T> {
    let Known { si, ci, st, ct, gamma_o_dot, gamma_i_dot, spin, .. } = *known;
    let Known { s_x_hat, w_y_hat, w_z_hat, .. } = *known;
    let [[j_11, j_12, j_13], [_, j_22, j_23], [_, _, j_33]] = known.j;
    let two = T::from_f64(2.0);
    let p = spin - gamma_o_dot * si;
    let q = gamma_o_dot * ci * st + gamma_i_dot * ct;
    let r = gamma_o_dot * ci * ct - gamma_i_dot * st;
    let t_11 = -j_12 * r + j_13 * q;
    let t_22 = j_12 * r - j_23 * p;
    let t_33 = -j_13 * q + j_23 * p;
    let t_12 = (j_11 - j_22) * r - j_13 * p + j_23 * q;
    let t_13 = (j_33 - j_11) * q - j_23 * r + j_12 * p;
    let t_23 = j_13 * r - j_12 * q + (j_22 - j_33) * p;
    tensor(
        [s_x_hat, w_y_hat, w_z_hat],
        [[two * t_11, t_12, t_13], [t_12, two * t_22, t_23], [t_13, t_23, two * t_33]],
    )
}
