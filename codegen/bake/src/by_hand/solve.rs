//! The hub's six equations, `M [r_b_n_ddot; omega_dot] = h`: sums over the devices, then L D Lᵀ in
//! two blocks of three without a square root. Vectors along the axes of B; a symmetric tensor is
//! given by its entries 11, 12, 13, 22, 23, 33. Over any number: f64, or one that counts.

use super::kernels::hub::{BodyAcceleration, BodyRate, HubShare};
use super::kernels::real::Real;
use super::rigid::RigidBody;

/// The hub's equations so far.
pub(crate) struct Assembly<T> {
    body: RigidBody<T>,
    /// Moments of inertia before any device moves: what the moving share may cancel.
    constant: [T; 3],
    force: [T; 3],
    torque_b: [T; 3],
    m_vv: [T; 6],
    m_vw: [T; 9],
    m_ww: [T; 6],
    h_v: [T; 3],
    h_w: [T; 3],
}

/// Whether a pivot is above 64 epsilons of its scale; below, the acceleration is only rounding. NaN
/// is not.
pub(crate) fn is_sound<T: Real + PartialOrd>(pivot: T, scale: T) -> bool {
    pivot > pivot.like(64.0 * f64::EPSILON) * scale
}

fn add<T: Real, const N: usize>(to: &mut [T; N], share: [T; N]) {
    for (to, share) in to.iter_mut().zip(share) {
        *to = *to + share;
    }
}

impl<T: Real + PartialOrd> Assembly<T> {
    /// Starts an evaluation.
    pub(crate) fn new(body: &RigidBody<T>, force: [T; 3], torque_b: [T; 3]) -> Self {
        let (i, zero) = (body.inertia, body.mass.like(0.0));
        Self {
            body: *body,
            constant: [i[0], i[3], i[5]],
            force,
            torque_b,
            m_vv: [zero; 6],
            m_vw: [zero; 9],
            m_ww: [zero; 6],
            h_v: [zero; 3],
            h_w: [zero; 3],
        }
    }

    /// Adds a device whose joints are eliminated.
    #[inline]
    #[rustfmt::skip]
    pub(crate) fn add(&mut self, e: &HubShare<T>) {
        add(&mut self.body.first_moment, [e.mr_moving_bx, e.mr_moving_by, e.mr_moving_bz]);
        add(&mut self.body.inertia, [
            e.i_moving_11, e.i_moving_12, e.i_moving_13,
            e.i_moving_22, e.i_moving_23, e.i_moving_33,
        ]);
        add(&mut self.m_vv, [e.m_vv_11, e.m_vv_12, e.m_vv_13, e.m_vv_22, e.m_vv_23, e.m_vv_33]);
        add(&mut self.m_vw, [
            e.m_vw_11, e.m_vw_12, e.m_vw_13, e.m_vw_21, e.m_vw_22, e.m_vw_23, e.m_vw_31, e.m_vw_32,
            e.m_vw_33,
        ]);
        add(&mut self.m_ww, [e.m_ww_11, e.m_ww_12, e.m_ww_13, e.m_ww_22, e.m_ww_23, e.m_ww_33]);
        add(&mut self.h_v, [e.h_v_1, e.h_v_2, e.h_v_3]);
        add(&mut self.h_w, [e.h_w_1, e.h_w_2, e.h_w_3]);
    }

    /// Solves the equations where the hub turns at `omega`; none where a pivot is only rounding.
    pub(crate) fn solve(&self, omega: &BodyRate<T>) -> Option<BodyAcceleration<T>> {
        let system = self.system([omega.omega_bx, omega.omega_by, omega.omega_bz]);
        let vv = Factors::of(&system.m_vv);
        // Rows four to six of L times D, and of L: w = L_vv^-1 M_vw, z = D_vv^-1 w.
        let w = system.m_vw.map(|column| vv.forward(column));
        let z = w.map(|column| vv.divide(column));
        let ww = Factors::of(&[
            system.m_ww[0] - dot(w[0], z[0]),
            system.m_ww[1] - dot(w[0], z[1]),
            system.m_ww[2] - dot(w[0], z[2]),
            system.m_ww[3] - dot(w[1], z[1]),
            system.m_ww[4] - dot(w[1], z[2]),
            system.m_ww[5] - dot(w[2], z[2]),
        ]);
        let y_v = vv.forward(system.h_v);
        let y_w = ww.forward([0, 1, 2].map(|k| system.h_w[k] - dot(z[k], y_v)));
        let omega_dot = ww.backward(ww.divide(y_w));
        let divided = vv.divide(y_v);
        let coupled = [0, 1, 2].map(|k| {
            divided[k] - (z[0][k] * omega_dot[0] + z[1][k] * omega_dot[1] + z[2][k] * omega_dot[2])
        });
        let r_b_n_ddot = vv.backward(coupled);
        self.is_sound(&vv, &z, &ww).then_some(BodyAcceleration {
            r_b_n_ddot_bx: r_b_n_ddot[0],
            r_b_n_ddot_by: r_b_n_ddot[1],
            r_b_n_ddot_bz: r_b_n_ddot[2],
            omega_dot_bx: omega_dot[0],
            omega_dot_by: omega_dot[1],
            omega_dot_bz: omega_dot[2],
        })
    }

    /// That of the rigid body, less what eliminated joints subtract; `m_vw` by its columns.
    fn system(&self, omega: [T; 3]) -> System<T> {
        let (m, s, taken) = (self.body.mass, self.body.first_moment, &self.m_vw);
        let centrifugal = cross(omega, cross(omega, s));
        let gyroscopic = cross(omega, times(&self.body.inertia, omega));
        let (vv, zero) = (&self.m_vv, m.like(0.0));
        System {
            m_vv: [m - vv[0], zero - vv[1], zero - vv[2], m - vv[3], zero - vv[4], m - vv[5]],
            // -tilde(m c).
            m_vw: [
                [zero - taken[0], -s[2] - taken[3], s[1] - taken[6]],
                [s[2] - taken[1], zero - taken[4], -s[0] - taken[7]],
                [-s[1] - taken[2], s[0] - taken[5], zero - taken[8]],
            ],
            m_ww: [0, 1, 2, 3, 4, 5].map(|k| self.body.inertia[k] - self.m_ww[k]),
            h_v: [0, 1, 2].map(|k| self.force[k] - centrifugal[k] - self.h_v[k]),
            h_w: [0, 1, 2].map(|k| self.torque_b[k] - gyroscopic[k] - self.h_w[k]),
        }
    }

    /// Each pivot against its scale, grown by the rounding of those before it: pivot k is `v . M v`
    /// with `L^T v = e_k`, and small pivots before it make v long.
    fn is_sound(&self, vv: &Factors<T>, z: &[[T; 3]; 3], ww: &Factors<T>) -> bool {
        let (mass, i) = (self.body.mass, &self.body.inertia);
        let moments = [self.constant[0] + i[0], self.constant[1] + i[3], self.constant[2] + i[5]];
        let weighed =
            |v: [T; 3]| mass * (v[0] * v[0]) + mass * (v[1] * v[1]) + mass * (v[2] * v[2]);
        [0, 1, 2].into_iter().all(|k| {
            let mut unit = [mass.like(0.0); 3];
            unit[k] = mass.like(1.0);
            let w = ww.backward(unit);
            let coupled = [0, 1, 2].map(|j| z[0][j] * w[0] + z[1][j] * w[1] + z[2][j] * w[2]);
            let own = moments[0] * (w[0] * w[0])
                + moments[1] * (w[1] * w[1])
                + moments[2] * (w[2] * w[2]);
            is_sound(vv.pivots[k], weighed(vv.backward(unit)))
                && is_sound(ww.pivots[k], weighed(vv.backward(coupled)) + own)
        })
    }
}

/// M and h.
struct System<T> {
    m_vv: [T; 6],
    m_vw: [[T; 3]; 3],
    m_ww: [T; 6],
    h_v: [T; 3],
    h_w: [T; 3],
}

/// L D Lᵀ of a symmetric block: L below its unit diagonal, D and its reciprocals.
struct Factors<T> {
    l_21: T,
    l_31: T,
    l_32: T,
    pivots: [T; 3],
    reciprocals: [T; 3],
}

impl<T: Real> Factors<T> {
    fn of(a: &[T; 6]) -> Self {
        let d_1 = a[0];
        let r_1 = d_1.recip();
        let (l_21, l_31) = (a[1] * r_1, a[2] * r_1);
        let d_2 = a[3] - l_21 * a[1];
        let r_2 = d_2.recip();
        let below = a[4] - l_31 * a[1];
        let l_32 = below * r_2;
        let d_3 = a[5] - l_31 * a[2] - l_32 * below;
        let reciprocals = [r_1, r_2, d_3.recip()];
        Self { l_21, l_31, l_32, pivots: [d_1, d_2, d_3], reciprocals }
    }

    /// L^-1 b.
    fn forward(&self, b: [T; 3]) -> [T; 3] {
        let second = b[1] - self.l_21 * b[0];
        [b[0], second, b[2] - self.l_31 * b[0] - self.l_32 * second]
    }

    /// D^-1 b.
    fn divide(&self, b: [T; 3]) -> [T; 3] {
        let r = self.reciprocals;
        [b[0] * r[0], b[1] * r[1], b[2] * r[2]]
    }

    /// L^-T b.
    fn backward(&self, b: [T; 3]) -> [T; 3] {
        let second = b[1] - self.l_32 * b[2];
        [b[0] - self.l_21 * second - self.l_31 * b[2], second, b[2]]
    }
}

fn dot<T: Real>(a: [T; 3], b: [T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross<T: Real>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn times<T: Real>(m: &[T; 6], v: [T; 3]) -> [T; 3] {
    [
        m[0] * v[0] + m[1] * v[1] + m[2] * v[2],
        m[1] * v[0] + m[3] * v[1] + m[4] * v[2],
        m[2] * v[0] + m[4] * v[1] + m[5] * v[2],
    ]
}
