//! The joints of a carrier eliminated into the equations of its base: the six of a platform, the hinge of a
//! panel.
//!
//! What carrier and carried devices exert on the joints is `f = M a + b` about P, with M of the
//! carrier as one rigid body with what it carries, less what the carried joints take out of it.
//! From the tip inwards each joint with direction s, (I4):
//!
//! ```text
//! U = M s,   d = s . U,   w = driven / d,   k = w (u - s . b) + given
//! q'' = k - w U . a,   M := M - w U Uᵀ,   b := b + k U
//! ```
//!
//! a is the acceleration without this joint and those outboard of it. The bodies between the joints
//! have no mass, so M and b stay those about P. At last, with p from B to P and C the carrier's
//! axes in the base,
//!
//! ```text
//! (I6)  force_B = C f_v,   moment_B = C f_w + p x C f_v
//! (I7)  first moment about B: m p + C s,   inertia about B: C I Cᵀ moved by p
//! ```

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use crate::equations::assembly::Assembly;
use crate::equations::hub::HubConstants;
use crate::equations::system::System;
use crate::generated::hub::{BodyAcceleration, HubShare};
use crate::isolation::motion::{Motion, Moving, Spatial, plus_scaled, product};
use crate::model::kind::JointInfo;
use crate::model::mode::Drive;
use crate::numbers::each::Value;
use crate::numbers::real::{Real, Scalar, zero};
use crate::numbers::symmetric::Symmetric;
use crate::numbers::vec3::{
    Columns, Vec3, add, cross, dot, map, rotate, rotate_transposed, scale, sub,
};

/// What is left of a carrier of N joints, with what it carries, once its joints are eliminated.
#[derive(Clone, Copy, Debug)]
pub struct Eliminated<T, const N: usize> {
    pub(crate) share: HubShare<T>,
    pub(crate) gains: Gains<T, N>,
    /// Pivot, and diagonal with every carried joint locked, of each joint.
    pub(crate) pivots: [[T; 2]; N],
}

/// How carrier and joints follow the base.
#[derive(Clone, Copy, Debug)]
pub struct Gains<T, const N: usize> {
    /// C, by columns.
    axes: Columns<T>,
    /// p, base axes.
    p: Vec3<T>,
    bias: Spatial<T>,
    directions: [Spatial<T>; N],
    /// `w U` of each joint.
    follow: [Spatial<T>; N],
    /// k of each joint.
    given: [T; N],
}

/// Moment of a force at p, for each unit force: the columns of `tilde(p)`.
#[inline(always)]
fn tilde<T: Real>([x, y, z]: Vec3<T>) -> Columns<T> {
    let zero = x.like(0.0);
    [[zero, z, -y], [-z, zero, x], [y, -x, zero]]
}

/// The first moment and inertia of a body about the origin of its base, (I7).
#[inline(always)]
pub(crate) fn moved<T: Real>(
    body: &HubConstants<T>,
    axes: &Columns<T>,
    p: Vec3<T>,
) -> (Vec3<T>, Symmetric<T>) {
    let s = rotate(axes, body.first_moment);
    let inertia = body.i_b_b.rotated(axes).plus(Symmetric::parallel_axis(body.m_b, p));
    let (two, d) = (body.m_b.like(2.0), dot(p, s));
    let coupled = Symmetric {
        xx: two * (d - p[0] * s[0]),
        xy: -(p[0] * s[1] + p[1] * s[0]),
        xz: -(p[0] * s[2] + p[2] * s[0]),
        yy: two * (d - p[1] * s[1]),
        yz: -(p[1] * s[2] + p[2] * s[1]),
        zz: two * (d - p[2] * s[2]),
    };
    (add(scale(body.m_b, p), s), inertia.plus(coupled))
}

/// `M a` of a rigid body about its origin.
#[inline(always)]
fn rigid<T: Real>(body: &HubConstants<T>, [v, w]: Spatial<T>) -> Spatial<T> {
    let s = body.first_moment;
    [add(scale(body.m_b, v), cross(w, s)), add(body.i_b_b.times(w), cross(s, v))]
}

/// The matrix of a system times a motion.
#[inline(always)]
fn times<T: Real>(m: &System<T>, [v, w]: Spatial<T>) -> Spatial<T> {
    [add(m.m_vv.times(v), rotate(&m.m_vw, w)), add(rotate_transposed(&m.m_vw, v), m.m_ww.times(w))]
}

/// Adds `f uᵀ` to the matrix of a system, where it is symmetric: f a multiple of u.
#[inline(always)]
fn add_dyad<T: Real>(m: &mut System<T>, f: &Spatial<T>, u: &Spatial<T>) {
    let symmetric = |m: Symmetric<T>, a: Vec3<T>, b: Vec3<T>| Symmetric {
        xx: m.xx + a[0] * b[0],
        xy: m.xy + a[0] * b[1],
        xz: m.xz + a[0] * b[2],
        yy: m.yy + a[1] * b[1],
        yz: m.yz + a[1] * b[2],
        zz: m.zz + a[2] * b[2],
    };
    m.m_vv = symmetric(m.m_vv, f[0], u[0]);
    m.m_ww = symmetric(m.m_ww, f[1], u[1]);
    let [x, y, z] = m.m_vw;
    let [a, b, c] = u[1];
    m.m_vw = [add(x, scale(a, f[0])), add(y, scale(b, f[0])), add(z, scale(c, f[0]))];
}

/// Eliminates the joints of a carrier. `assembly` has carrier and carried devices about P,
/// expressed in carrier axes, the carried joints eliminated; `field` is (I5).
#[inline(always)]
pub(crate) fn eliminate<T: Real + Value, const N: usize>(
    Moving { motion, directions }: &Moving<T, N>,
    field: Vec3<T>,
    assembly: &Assembly<T>,
    drives: [Drive<T>; N],
) -> Eliminated<T, N> {
    let body = assembly.body();
    let System { h_v, h_w, .. } = assembly.system(motion.omega);
    let mut taken = assembly.taken();
    let mut bias: Spatial<T> = [map(h_v, |h| -h), map(h_w, |h| -h)];
    let zero = body.m_b.like(0.0);
    let mut follow = [[[zero; 3]; 2]; N];
    let mut given = [zero; N];
    let mut pivots = [[zero; 2]; N];
    // Each reversed by itself: a reversed `zip` compares lengths, and could panic.
    let results = follow.iter_mut().rev().zip(given.iter_mut().rev()).zip(pivots.iter_mut().rev());
    let joints = directions.iter().rev().zip(drives.into_iter().rev()).zip(results);
    for ((direction, drive), ((follow, given), pivot)) in joints {
        let of_body = rigid(&body, *direction);
        let u = plus_scaled(of_body, zero.like(-1.0), times(&taken, *direction));
        let d = product(direction, &u);
        let weight = drive.driven * (drive.driven * d + drive.held).recip();
        *pivot = [d, product(direction, &of_body)];
        *given = weight * (drive.torque - product(direction, &bias)) + drive.given;
        *follow = [scale(weight, u[0]), scale(weight, u[1])];
        bias = plus_scaled(bias, *given, u);
        add_dyad(&mut taken, follow, &u);
    }
    // (I2) and (I3) with the field: the acceleration seen from what falls with it.
    let of_motion = [sub(motion.bias[0], field), motion.bias[1]];
    let left = plus_scaled(rigid(&body, of_motion), zero.like(-1.0), times(&taken, of_motion));
    let exerted = [add(left[0], bias[0]), add(left[1], bias[1])];
    Eliminated {
        share: share(motion, &body, &taken, exerted),
        gains: Gains {
            axes: motion.axes,
            p: motion.p,
            bias: of_motion,
            directions: *directions,
            follow,
            given,
        },
        pivots,
    }
}

/// (I6) and (I7): what the joints take out, and what the motion of the base requires, about the
/// origin of the base.
#[inline(always)]
#[rustfmt::skip]
fn share<T: Real + Value>(
    motion: &Motion<T>,
    body: &HubConstants<T>,
    taken: &System<T>,
    exerted: Spatial<T>,
) -> HubShare<T> {
    let (axes, p, omega) = (&motion.axes, motion.p, motion.omega_base);
    let (mr, i) = moved(body, axes, p);
    let of_p = tilde(p);
    let vv = taken.m_vv.rotated(axes);
    // C T_vw Cᵀ, by columns.
    let turned = map(taken.m_vw, |column| rotate(axes, column));
    let ([tx, ty, tz], [ax, ay, az]) = (turned, *axes);
    let column = |a, b, c| add(scale(a, tx), add(scale(b, ty), scale(c, tz)));
    let at_p = [
        column(ax[0], ay[0], az[0]), column(ax[1], ay[1], az[1]), column(ax[2], ay[2], az[2]),
    ];
    let [px, py, pz] = of_p;
    let vw = [
        sub(at_p[0], vv.times(px)), sub(at_p[1], vv.times(py)), sub(at_p[2], vv.times(pz)),
    ];
    let ww = taken.m_ww.rotated(axes);
    // Column j of tilde(p) T_vw about B, less that of the transposed of T_vw times tilde(p).
    let moved = |vw: Vec3<T>, of_p: Vec3<T>| sub(cross(p, vw), rotate_transposed(&at_p, of_p));
    let (x, y, z) = (moved(vw[0], px), moved(vw[1], py), moved(vw[2], pz));
    let force = rotate(axes, exerted[0]);
    let moment = add(rotate(axes, exerted[1]), cross(p, force));
    // The hub computes these of itself with what it carries as one rigid body.
    let h_v = sub(force, cross(omega, cross(omega, mr)));
    let h_w = sub(moment, cross(omega, i.times(omega)));
    HubShare {
        m_vv_11: vv.xx, m_vv_12: vv.xy, m_vv_13: vv.xz, m_vv_22: vv.yy, m_vv_23: vv.yz, m_vv_33: vv.zz,
        m_vw_11: vw[0][0], m_vw_12: vw[1][0], m_vw_13: vw[2][0],
        m_vw_21: vw[0][1], m_vw_22: vw[1][1], m_vw_23: vw[2][1],
        m_vw_31: vw[0][2], m_vw_32: vw[1][2], m_vw_33: vw[2][2],
        m_ww_11: ww.xx + x[0], m_ww_12: ww.xy + y[0], m_ww_13: ww.xz + z[0],
        m_ww_22: ww.yy + y[1], m_ww_23: ww.yz + z[1], m_ww_33: ww.zz + z[2],
        h_v_1: h_v[0], h_v_2: h_v[1], h_v_3: h_v[2],
        h_w_1: h_w[0], h_w_2: h_w[1], h_w_3: h_w[2],
        mr_moving_bx: mr[0], mr_moving_by: mr[1], mr_moving_bz: mr[2],
        i_moving_11: i.xx, i_moving_12: i.xy, i_moving_13: i.xz,
        i_moving_22: i.yy, i_moving_23: i.yz, i_moving_33: i.zz,
    }
}

impl<T: Real + Value, const N: usize> Gains<T, N> {
    /// Accelerations of the joints and of the carrier, about P in carrier axes, from those of
    /// the base. With a central field that of the carrier is the one seen from what falls with
    /// the field at P.
    #[inline(always)]
    pub(crate) fn outward(&self, base: &BodyAcceleration<T>) -> ([T; N], Spatial<T>) {
        let linear = [base.r_b_n_ddot_bx, base.r_b_n_ddot_by, base.r_b_n_ddot_bz];
        let angular = [base.omega_dot_bx, base.omega_dot_by, base.omega_dot_bz];
        let at_p = add(linear, cross(angular, self.p));
        let turned = [rotate_transposed(&self.axes, at_p), rotate_transposed(&self.axes, angular)];
        let mut carrier = [add(turned[0], self.bias[0]), add(turned[1], self.bias[1])];
        let mut found = self.given;
        let joints = self.directions.iter().zip(&self.follow);
        for (found, (direction, follow)) in found.iter_mut().zip(joints) {
            *found = *found - product(follow, &carrier);
            carrier = plus_scaled(carrier, *found, *direction);
        }
        (found, carrier)
    }

    /// By how much each joint follows while one accelerates by one, those inboard of it are locked and
    /// those outboard of it are driven by no torque: row by row. What a pivot is the inertia of.
    fn responses(&self) -> [[T; N]; N] {
        let (zero, one) = (self.p[0].like(0.0), self.p[0].like(1.0));
        let mut responses = [[zero; N]; N];
        for (index, (row, direction)) in responses.iter_mut().zip(self.directions).enumerate() {
            let mut motion = direction;
            let joints = row.iter_mut().zip(self.directions.iter().zip(&self.follow)).enumerate();
            for (joint, (response, (direction, follow))) in joints {
                if joint == index {
                    *response = one;
                } else if joint > index {
                    *response = -product(follow, &motion);
                    motion = plus_scaled(motion, *response, *direction);
                }
            }
        }
        responses
    }
}

impl<T: Scalar, const N: usize> Gains<T, N> {
    /// What a pivot is beside: mass and inertia that its joint moves with those that follow it.
    pub(crate) fn scales(&self, joints: &[JointInfo], mass: T, inertia: T) -> [T; N] {
        self.responses().map(|responses| {
            let moved = responses.into_iter().zip(joints);
            moved.fold(zero(), |scale: T, (response, info)| {
                scale + (if info.slides { mass } else { inertia }) * (response * response)
            })
        })
    }
}

impl<T: Value, const N: usize> Gains<T, N> {
    /// Gains joined number by number.
    #[inline(always)]
    pub(crate) fn zip<U: Copy, W: Copy>(
        &self,
        other: &Gains<U, N>,
        mut join: impl FnMut(T, U) -> W,
    ) -> Gains<W, N> {
        let mut vector =
            |a: Vec3<T>, b: Vec3<U>| [join(a[0], b[0]), join(a[1], b[1]), join(a[2], b[2])];
        let axes = [
            vector(self.axes[0], other.axes[0]),
            vector(self.axes[1], other.axes[1]),
            vector(self.axes[2], other.axes[2]),
        ];
        let p = vector(self.p, other.p);
        let mut pair = |a: Spatial<T>, b: Spatial<U>| [vector(a[0], b[0]), vector(a[1], b[1])];
        let bias = pair(self.bias, other.bias);
        let directions = zip_each(self.directions, other.directions, &mut pair);
        let follow = zip_each(self.follow, other.follow, &mut pair);
        let given = zip_each(self.given, other.given, join);
        Gains { axes, p, bias, directions, follow, given }
    }
}

/// Values joined one by one.
#[inline(always)]
pub(crate) fn zip_each<V: Copy, U: Copy, W: Copy, const N: usize>(
    a: [V; N],
    b: [U; N],
    mut join: impl FnMut(V, U) -> W,
) -> [W; N] {
    core::array::from_fn(
        #[inline(always)]
        |k| join(a[k], b[k]),
    )
}
