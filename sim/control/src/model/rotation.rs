//! Turns as quaternions of unit length, scalar first: one after another, and as rotation vectors.

use nalgebra::Vector3;
use precess_dynamics::Quaternion;

/// Hamilton's product: the turn `b` after `a`, `b` about axes that `a` has turned.
#[must_use]
pub fn product(a: &Quaternion, b: &Quaternion) -> Quaternion {
    Quaternion {
        q0: a.q0 * b.q0 - a.q1 * b.q1 - a.q2 * b.q2 - a.q3 * b.q3,
        q1: a.q0 * b.q1 + a.q1 * b.q0 + a.q2 * b.q3 - a.q3 * b.q2,
        q2: a.q0 * b.q2 - a.q1 * b.q3 + a.q2 * b.q0 + a.q3 * b.q1,
        q3: a.q0 * b.q3 + a.q1 * b.q2 - a.q2 * b.q1 + a.q3 * b.q0,
    }
}

/// The turn back.
#[must_use]
pub fn inverse(turn: &Quaternion) -> Quaternion {
    Quaternion { q0: turn.q0, q1: -turn.q1, q2: -turn.q2, q3: -turn.q3 }
}

/// The turn of a rotation vector, rad.
#[must_use]
pub fn from_vector(vector: &Vector3<f64>) -> Quaternion {
    let angle = libm::sqrt(vector.norm_squared());
    let (sin, cos) = libm::sincos(0.5 * angle);
    let part = vector * if angle > 1e-8 { sin / angle } else { 0.5 };
    Quaternion { q0: cos, q1: part.x, q2: part.y, q3: part.z }
}

/// The rotation vector of a turn, rad; not longer than half a turn.
#[must_use]
pub fn to_vector(turn: &Quaternion) -> Vector3<f64> {
    let part = Vector3::new(turn.q1, turn.q2, turn.q3);
    let sign = if turn.q0 < 0.0 { -1.0 } else { 1.0 };
    let sine = libm::sqrt(part.norm_squared());
    let share = if sine > 1e-12 { 2.0 * libm::atan2(sine, sign * turn.q0) / sine } else { 2.0 };
    part * (sign * share)
}

#[cfg(test)]
mod tests {
    use super::*;
    use precess_dynamics::Attitude as _;

    /// A few roundings of numbers about one.
    const ROUNDING: f64 = 4e-15;

    #[test]
    fn the_rotation_vector_of_a_turn_comes_back() {
        for v in [[0.0; 3], [3e-9, -1e-9, 2e-9], [0.3, -1.2, 0.7], [0.0, 3.1, 0.0]] {
            let wanted = Vector3::from(v);
            let start = from_vector(&Vector3::new(0.4, 0.2, -0.9));
            let found =
                to_vector(&product(&inverse(&start), &product(&start, &from_vector(&wanted))));
            assert!((found - wanted).amax() < ROUNDING, "{found} {wanted}");
        }
    }

    #[test]
    fn the_matrix_of_a_product_is_that_of_the_second_turn_times_that_of_the_first() {
        let a = from_vector(&Vector3::new(0.4, 0.2, -0.9));
        let b = from_vector(&Vector3::new(-1.1, 2.0, 0.3));
        assert!((product(&a, &b).dcm() - b.dcm() * a.dcm()).amax() < ROUNDING);
    }
}
