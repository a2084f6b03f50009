//! [`OrbitalFrame`]: the local vertical and local horizontal of an orbit about the origin of N.
//!
//! ```text
//! z_O = -r / |r|     y_O = -(r x v) / |r x v|     x_O = y_O x z_O     omega_ON = (r x v) / |r|^2
//! ```
//!
//! z to the central body, y against the orbital momentum, x along the velocity of a circular orbit. The rate is exact
//! where the plane of the orbit stays.

use nalgebra::{Matrix3, Vector3};

/// Axes and rate of the orbital frame O.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrbitalFrame {
    /// Its axes expressed in N: rows.
    pub axes: Matrix3<f64>,
    /// Its angular velocity with respect to N, in N, rad/s.
    pub omega: Vector3<f64>,
}

impl OrbitalFrame {
    /// Of a position and velocity in N; none where they are parallel or one of them is zero.
    #[must_use]
    pub fn new(r: &Vector3<f64>, v: &Vector3<f64>) -> Option<Self> {
        let momentum = r.cross(v);
        let z = -r.try_normalize(0.0)?;
        let y = -momentum.try_normalize(1e-12 * r.norm() * v.norm())?;
        let axes = Matrix3::from_rows(&[y.cross(&z).transpose(), y.transpose(), z.transpose()]);
        Some(Self { axes, omega: momentum / r.norm_squared() })
    }

    /// Roll, pitch and yaw from O of B, whose axes in N are the rows of `bn`, rad.
    #[must_use]
    pub fn roll_pitch_yaw(&self, bn: &Matrix3<f64>) -> [f64; 3] {
        roll_pitch_yaw(&(bn * self.axes.transpose()))
    }

    /// The angular velocity of B with respect to O, in B, of one with respect to N in B.
    #[must_use]
    pub fn relative(&self, bn: &Matrix3<f64>, omega: &Vector3<f64>) -> Vector3<f64> {
        omega - bn * self.omega
    }
}

/// Roll, pitch and yaw of B, whose axes in others are the rows of `axes`: turns from these by yaw about z, then pitch about
/// y, then roll about x, rad. At a pitch of 90 degrees only yaw less roll is known.
#[must_use]
pub fn roll_pitch_yaw(axes: &Matrix3<f64>) -> [f64; 3] {
    let roll = libm::atan2(axes[(1, 2)], axes[(2, 2)]);
    let pitch = -libm::asin(axes[(0, 2)].clamp(-1.0, 1.0));
    let yaw = libm::atan2(axes[(0, 1)], axes[(0, 0)]);
    [roll, pitch, yaw]
}

#[cfg(test)]
mod tests {
    use nalgebra::Rotation3;

    use super::*;

    #[test]
    fn the_axes_are_those_of_the_local_vertical_and_horizontal() {
        let (r, v) = (Vector3::new(0.0, 7e6, 0.0), Vector3::new(-7.5e3, 0.0, 100.0));
        let frame = OrbitalFrame::new(&r, &v).expect("an orbit");
        assert!((frame.axes * frame.axes.transpose() - Matrix3::identity()).amax() < 1e-15);
        assert!((frame.axes.determinant() - 1.0).abs() < 1e-15);
        // Down, and forward.
        assert_eq!(frame.axes.row(2).transpose(), Vector3::new(0.0, -1.0, 0.0));
        assert!((frame.axes.row(0).transpose() - v.normalize()).amax() < 1e-15);
        // z moves with the rate: its derivative is -v / r for a velocity across r.
        let derivative = frame.omega.cross(&frame.axes.row(2).transpose());
        assert!((derivative + v / 7e6).amax() < 1e-18);
        for degenerate in [Vector3::zeros(), r] {
            assert_eq!(OrbitalFrame::new(&r, &degenerate), None);
        }
    }

    #[test]
    fn roll_pitch_and_yaw_are_three_turns_from_the_orbital_frame() {
        let frame = OrbitalFrame::new(&Vector3::new(7e6, 1e6, 2e6), &Vector3::new(0.0, 7e3, 1e3));
        let frame = frame.expect("an orbit");
        let (roll, pitch, yaw) = (0.1, -0.4, 2.0);
        // Columns are axes of B in O: yaw, then pitch, then roll.
        let turned = Rotation3::from_euler_angles(roll, pitch, yaw).into_inner();
        let bn = turned.transpose() * frame.axes;
        for (found, wanted) in frame.roll_pitch_yaw(&bn).iter().zip([roll, pitch, yaw]) {
            assert!((found - wanted).abs() < 1e-14, "{found} {wanted}");
        }
    }
}
