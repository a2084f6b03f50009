//! What is known of one device, pages 1 to 3: masses, axes, arms and angular velocities.
//!
//! Unit vectors and arms are expressed in B. The pages take B's axes along the outer
//! gimbal's at zero angle; those are the columns of the mount.

use precess_dynamics::dgvscmg::{JointAccelerations, Joints};
use precess_dynamics::{Dgvscmg, Scalar};

use crate::newton_euler::vector::{Tensor, Vector};

/// How the hub moves, along its own axes.
#[derive(Clone, Copy)]
pub(super) struct Motion<T> {
    pub(super) omega: Vector<T>,
    pub(super) omega_dot: Vector<T>,
    pub(super) r_b_n_ddot: Vector<T>,
}

/// One device in one state with known accelerations. Names are those of the pages.
#[derive(Clone, Copy)]
pub(super) struct Known<T> {
    pub(super) m_go: T,
    pub(super) m_gi: T,
    pub(super) m_w: T,
    pub(super) d: T,
    pub(super) i_go: [[T; 3]; 3],
    pub(super) i_gi: [[T; 3]; 3],
    pub(super) j: [[T; 3]; 3],
    /// Sine and cosine of `gamma_i`.
    pub(super) si: T,
    pub(super) ci: T,
    /// Sine and cosine of `theta`.
    pub(super) st: T,
    pub(super) ct: T,
    pub(super) gamma_o_dot: T,
    pub(super) gamma_i_dot: T,
    pub(super) spin: T,
    pub(super) gamma_o_ddot: T,
    pub(super) gamma_i_ddot: T,
    pub(super) spin_dot: T,
    pub(super) omega: Vector<T>,
    pub(super) omega_dot: Vector<T>,
    pub(super) r_b_n_ddot: Vector<T>,
    pub(super) g_x_hat: Vector<T>,
    pub(super) s_x_hat: Vector<T>,
    pub(super) s_y_hat: Vector<T>,
    pub(super) s_z_hat: Vector<T>,
    pub(super) g_z_hat: Vector<T>,
    pub(super) w_y_hat: Vector<T>,
    pub(super) w_z_hat: Vector<T>,
    pub(super) r_go_b: Vector<T>,
    pub(super) r_goc_go: Vector<T>,
    /// Components of `l_o` and `l_i` in their gimbals' axes.
    pub(super) l_o_xyz: [T; 3],
    pub(super) l_o: Vector<T>,
    pub(super) r_gic_gi: Vector<T>,
    pub(super) l_i_xyz: [T; 3],
    pub(super) l_i: Vector<T>,
    pub(super) r_wc_w: Vector<T>,
    pub(super) omega_gi_b: Vector<T>,
    pub(super) omega_w_b: Vector<T>,
    pub(super) omega_go_n: Vector<T>,
    pub(super) omega_gi_n: Vector<T>,
    pub(super) omega_w_n: Vector<T>,
}

impl<T: Scalar> Known<T> {
    pub(super) fn new(
        device: &Dgvscmg<T>,
        joints: &Joints<T>,
        ddot: &JointAccelerations<T>,
        motion: Motion<T>,
    ) -> Self {
        let Motion { omega, omega_dot, r_b_n_ddot } = motion;
        let Joints { gamma_o_dot, gamma_i_dot, spin, .. } = *joints;
        let (so, co) = joints.gamma_o.sin_cos();
        let (si, ci) = joints.gamma_i.sin_cos();
        let (st, ct) = joints.theta.sin_cos();

        // 1.2, from B outwards; the pages have the inverse in b_x_hat and b_y_hat.
        let mount = Tensor::from(&device.mount);
        let [b_x_hat, b_y_hat, b_z_hat] = [0, 1, 2].map(|axis| mount.column(axis));
        let g_x_hat = b_x_hat * co + b_y_hat * so;
        let s_y_hat = b_y_hat * co - b_x_hat * so;
        let s_z_hat = b_z_hat;
        let s_x_hat = g_x_hat * ci - s_z_hat * si;
        let g_z_hat = g_x_hat * si + s_z_hat * ci;
        let w_y_hat = s_y_hat * ct + g_z_hat * st;
        let w_z_hat = g_z_hat * ct - s_y_hat * st;

        // 2.1 and 3.1.
        let outer = Tensor::of_columns([g_x_hat, s_y_hat, s_z_hat]);
        let inner = Tensor::of_columns([s_x_hat, s_y_hat, g_z_hat]);
        let (l_o, l_i) = (Vector::from(&device.l_o), Vector::from(&device.l_i));

        // 1.4, and (31), (44), (59).
        let omega_go_b = s_z_hat * gamma_o_dot;
        let omega_gi_b = s_z_hat * gamma_o_dot + s_y_hat * gamma_i_dot;
        let omega_w_b = s_z_hat * gamma_o_dot + s_y_hat * gamma_i_dot + s_x_hat * spin;

        Self {
            m_go: device.m_go,
            m_gi: device.m_gi,
            m_w: device.m_w,
            d: device.d,
            i_go: Tensor::from(&device.i_go_goc).0,
            i_gi: Tensor::from(&device.i_gi_gic).0,
            j: Tensor::from(&device.i_w_wc).0,
            si,
            ci,
            st,
            ct,
            gamma_o_dot,
            gamma_i_dot,
            spin,
            gamma_o_ddot: ddot.gamma_o_ddot,
            gamma_i_ddot: ddot.gamma_i_ddot,
            spin_dot: ddot.spin_dot,
            omega,
            omega_dot,
            r_b_n_ddot,
            g_x_hat,
            s_x_hat,
            s_y_hat,
            s_z_hat,
            g_z_hat,
            w_y_hat,
            w_z_hat,
            r_go_b: Vector::from(&device.r_go_b),
            r_goc_go: outer * Vector::from(&device.r_goc_go),
            l_o_xyz: l_o.0,
            l_o: outer * l_o,
            r_gic_gi: inner * Vector::from(&device.r_gic_gi),
            l_i_xyz: l_i.0,
            l_i: inner * l_i,
            r_wc_w: w_y_hat * device.d,
            omega_gi_b,
            omega_w_b,
            omega_go_n: omega + omega_go_b,
            omega_gi_n: omega + omega_gi_b,
            omega_w_n: omega + omega_w_b,
        }
    }
}
