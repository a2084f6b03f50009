//! Quaternions as four numbers, scalar first, of the attitude of axes relative to others; and rotation vectors.

/// Hamilton's product: the turn `b` after `a`, `b` expressed in the turned axes.
pub(crate) fn product(a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
    [
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    ]
}

pub(crate) fn inverse([q0, q1, q2, q3]: [f64; 4]) -> [f64; 4] {
    [q0, -q1, -q2, -q3]
}

/// The quaternion of a rotation vector, rad.
#[cfg(any(feature = "tool", test))]
pub(crate) fn from_vector(v: [f64; 3]) -> [f64; 4] {
    let angle = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let (sin, cos) = libm::sincos(0.5 * angle);
    let share = if angle > 1e-8 { sin / angle } else { 0.5 };
    [cos, share * v[0], share * v[1], share * v[2]]
}

/// The rotation vector of a quaternion, rad; not longer than half a turn.
pub(crate) fn to_vector([q0, q1, q2, q3]: [f64; 4]) -> [f64; 3] {
    let sign = if q0 < 0.0 { -1.0 } else { 1.0 };
    let sine = (q1 * q1 + q2 * q2 + q3 * q3).sqrt();
    let share = if sine > 1e-12 { 2.0 * libm::atan2(sine, sign * q0) / sine } else { 2.0 };
    [q1, q2, q3].map(|q| sign * share * q)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rotation_vector_is_the_turn_from_one_attitude_to_another() {
        for v in [[0.0; 3], [3e-9, -1e-9, 2e-9], [0.3, -1.2, 0.7], [0.0, 3.1, 0.0]] {
            let start = from_vector([0.4, 0.2, -0.9]);
            let end = product(start, from_vector(v));
            // Either of the two quaternions of the attitude.
            for end in [end, end.map(|q| -q)] {
                let found = to_vector(product(inverse(start), end));
                for (found, wanted) in found.iter().zip(v) {
                    assert!((found - wanted).abs() < 1e-15, "{found:e} {wanted:e}");
                }
            }
        }
    }
}
