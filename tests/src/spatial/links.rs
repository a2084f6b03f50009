//! One device as a chain of three links: coordinate transforms, joint axes, spatial inertias.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::dgvscmg::{Joints, MotorTorques};
use precess_dynamics::{Dgvscmg, Scalar};

use super::algebra::{Block, Matrix, Spatial, cross_matrix};
use super::components;

/// A rigid body on a turning joint, in one state.
#[derive(Clone, Copy, Debug)]
pub(super) struct Link<T> {
    /// Motion vectors from the parent's coordinates to this link's.
    pub(super) from_parent: Matrix<T>,
    /// The joint's axis, a motion vector in this link's coordinates.
    pub(super) axis: Spatial<T>,
    /// The joint's rate, rad/s.
    pub(super) rate: T,
    /// The motor's torque, N m.
    pub(super) torque: T,
    /// Spatial inertia about this link's origin.
    pub(super) inertia: Matrix<T>,
}

/// Outer gimbal, inner gimbal, wheel.
pub(super) fn chain<T: Scalar>(
    device: &Dgvscmg<T>,
    joints: &Joints<T>,
    motors: &MotorTorques<T>,
) -> [Link<T>; 3] {
    let zero = T::from_f64(0.0);
    let outer = Link {
        from_parent: turned_by(2, joints.gamma_o) * placed(&device.mount, &device.r_go_b),
        axis: Spatial::turning_about(2),
        rate: joints.gamma_o_dot,
        torque: motors.u_o,
        inertia: rigid_inertia(device.m_go, &device.r_goc_go, &device.i_go_goc),
    };
    let inner = Link {
        from_parent: turned_by(1, joints.gamma_i) * placed(&upright(), &device.l_o),
        axis: Spatial::turning_about(1),
        rate: joints.gamma_i_dot,
        torque: motors.u_i,
        inertia: rigid_inertia(device.m_gi, &device.r_gic_gi, &device.i_gi_gic),
    };
    let wheel = Link {
        from_parent: turned_by(0, joints.theta) * placed(&upright(), &device.l_i),
        axis: Spatial::turning_about(0),
        rate: joints.spin,
        torque: motors.u_w,
        inertia: rigid_inertia(device.m_w, &Vector3::new(zero, device.d, zero), &device.i_w_wc),
    };
    [outer, inner, wheel]
}

/// Spatial inertia about the origin of a body with its centre of mass at `c`:
/// `[I + m c~ c~^T, m c~; m c~^T, m 1]`.
pub(super) fn rigid_inertia<T: Scalar>(mass: T, c: &Vector3<T>, about_c: &Matrix3<T>) -> Matrix<T> {
    let c = cross_matrix(components(c));
    let moment = scaled(c, mass);
    let angular = sum(rows(about_c), product(moment, transpose(c)));
    Matrix::blocks([[angular, moment], [transpose(moment), scaled(rows(&upright()), mass)]])
}

/// To coordinates whose axes are the columns of `axes` and whose origin is at `origin`:
/// `[E, 0; -E r~, E]`, where `E` is the transpose of `axes`.
fn placed<T: Scalar>(axes: &Matrix3<T>, origin: &Vector3<T>) -> Matrix<T> {
    let (e, o) = (transpose(rows(axes)), [[T::from_f64(0.0); 3]; 3]);
    let lever = product(e, cross_matrix(components(origin)));
    Matrix::blocks([[e, o], [scaled(lever, -T::from_f64(1.0)), e]])
}

/// To coordinates turned by an angle about a coordinate axis.
fn turned_by<T: Scalar>(axis: usize, angle: T) -> Matrix<T> {
    let (o, l) = (T::from_f64(0.0), T::from_f64(1.0));
    let (s, c) = angle.sin_cos();
    let e = match axis {
        0 => [[l, o, o], [o, c, s], [o, -s, c]],
        1 => [[c, o, -s], [o, l, o], [s, o, c]],
        _ => [[c, s, o], [-s, c, o], [o, o, l]],
    };
    let o = [[o; 3]; 3];
    Matrix::blocks([[e, o], [o, e]])
}

fn upright<T: Scalar>() -> Matrix3<T> {
    let (o, l) = (T::from_f64(0.0), T::from_f64(1.0));
    Matrix3::new(l, o, o, o, l, o, o, o, l)
}

fn rows<T: Scalar>(m: &Matrix3<T>) -> Block<T> {
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| m[(row, column)]))
}

fn transpose<T: Scalar>(m: Block<T>) -> Block<T> {
    [0, 1, 2].map(|i| m.map(|row| row[i]))
}

fn scaled<T: Scalar>(m: Block<T>, factor: T) -> Block<T> {
    m.map(|row| row.map(|x| x * factor))
}

fn sum<T: Scalar>(a: Block<T>, b: Block<T>) -> Block<T> {
    core::array::from_fn(|i| core::array::from_fn(|k| a[i][k] + b[i][k]))
}

fn product<T: Scalar>(a: Block<T>, b: Block<T>) -> Block<T> {
    let columns = transpose(b);
    a.map(|[x, y, z]| columns.map(|[u, v, w]| x * u + y * v + z * w))
}

#[cfg(test)]
mod tests {
    use super::super::algebra::Spatial;
    use super::{placed, turned_by, upright};
    use nalgebra::Vector3;

    /// Rounding of a sine and some sums of about one.
    const ROUNDING: f64 = 1e-15;

    /// Turning about z at one rad/s, a point at x moves along y; so its coordinates say after a
    /// quarter turn about z, in which the old y is the new x.
    #[test]
    fn a_turning_body_moves_its_points() {
        let there = placed(&upright(), &Vector3::new(2.0, 0.0, 0.0));
        let seen = turned_by(2, core::f64::consts::FRAC_PI_2) * there * Spatial::turning_about(2);
        let expected = Spatial([0.0, 0.0, 1.0, 2.0, 0.0, 0.0]);
        assert!((seen - expected).0.iter().all(|x: &f64| x.abs() <= ROUNDING), "{seen:?}");
    }
}
