//! [`MountMotion`]: where a mount is and how it moves, (F5) to (F8).
//!
//! The mount's frame K is the place in which B, carried rigidly by the mount, would be: at rest and
//! undeformed it is B. Devices on the mount have in K the constants that they have in B on a rigid
//! hub.

use crate::flexible::equations::block::{BlockTriangular, Six, joined, parted};
use crate::flexible::equations::turn::Turn;
use crate::numbers::real::Scalar;
use crate::numbers::vec3::{Columns, Vec3, add, cross, map, rotate, rotate_transposed, scale, sub};

/// Place and motion of the frame K of a mount.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MountMotion<T> {
    /// The axes of K, expressed in B.
    pub(crate) axes: Columns<T>,
    /// The origin of K from B, expressed in B, m.
    pub(crate) origin: Vec3<T>,
    /// Velocity of the origin seen from B, expressed in B, m/s.
    pub(crate) origin_prime: Vec3<T>,
    /// Angular velocity relative to B, expressed in K, rad/s.
    pub(crate) relative: Vec3<T>,
    /// Inertial angular velocity, expressed in K, rad/s.
    pub(crate) omega: Vec3<T>,
    /// `X`: acceleration of K, expressed in K, for that of B.
    pub(crate) of_hub: BlockTriangular<T>,
    /// `E`: acceleration of K, expressed in K, for displacement and rotation of the mount.
    pub(crate) of_shape: BlockTriangular<T>,
    /// Acceleration of K, expressed in K, that velocities require.
    pub(crate) bias: Six<T>,
}

impl<T: Scalar> MountMotion<T> {
    /// The motion of a mount at `r_0` of the undeformed structure, for displacement and rotation
    /// vector `q` and their derivatives, on a frame B that turns at `omega`.
    pub(crate) fn new(r_0: Vec3<T>, q: &Six<T>, q_dot: &Six<T>, omega: Vec3<T>) -> Self {
        let ((shift, angle), (shift_dot, angle_dot)) = (parted(q), parted(q_dot));
        let turn = Turn::new(angle);
        let (axes, jacobian) = (turn.axes(), turn.jacobian());
        let into = |v| rotate_transposed(&axes, v);

        let origin = sub(shift, turn.displaced(r_0));
        let relative = turn.rate(angle_dot);
        let arm_rate = cross(relative, r_0);
        let origin_prime = sub(shift_dot, rotate(&axes, arm_rate));
        let omega_k = into(omega);
        let turning = turn.bias(angle_dot);

        let coriolis = scale(T::from_f64(2.0), cross(omega, origin_prime));
        let centrifugal = cross(omega, cross(omega, origin));
        let of_arm = add(cross(turning, r_0), cross(relative, arm_rate));
        let bias = joined(
            sub(into(add(centrifugal, coriolis)), of_arm),
            add(cross(omega_k, relative), turning),
        );
        Self {
            origin,
            origin_prime,
            relative,
            omega: add(omega_k, relative),
            of_hub: of_hub(&axes, origin),
            of_shape: of_shape(&axes, &jacobian, r_0),
            bias,
            axes,
        }
    }

    /// Inertial velocity of the origin of K, expressed in K, for that of B, expressed in B.
    pub(crate) fn velocity(&self, r_b_n_dot: Vec3<T>, omega: Vec3<T>) -> Vec3<T> {
        let velocity = add(r_b_n_dot, add(cross(omega, self.origin), self.origin_prime));
        rotate_transposed(&self.axes, velocity)
    }
}

/// `[Rᵀ, -Rᵀ tilde(origin); 0, Rᵀ]`.
fn of_hub<T: Scalar>(axes: &Columns<T>, origin: Vec3<T>) -> BlockTriangular<T> {
    // Row i: the axis e_i, and e_i . (omega' x origin) = omega' . (origin x e_i).
    BlockTriangular { upper: axes.map(|e| joined(e, cross(origin, e))), lower: *axes }
}

/// `[Rᵀ, tilde(r_0) J; 0, J]`.
fn of_shape<T: Scalar>(
    axes: &Columns<T>,
    jacobian: &Columns<T>,
    r_0: Vec3<T>,
) -> BlockTriangular<T> {
    let [x, y, z] = *axes;
    let [i, j, k] = transposed(&map(*jacobian, |column| cross(r_0, column)));
    BlockTriangular {
        upper: [joined(x, i), joined(y, j), joined(z, k)],
        lower: transposed(jacobian),
    }
}

fn transposed<T: Copy>([a, b, c]: &Columns<T>) -> Columns<T> {
    let [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] = [*a, *b, *c];
    [[ax, bx, cx], [ay, by, cy], [az, bz, cz]]
}
