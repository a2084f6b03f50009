//! Derivatives by differences in double-double: central ones, extrapolated twice.

use precess_dynamics::{Axis, Quaternion, Real, Scalar};

use crate::double_double::DoubleDouble as Wide;

/// Numbers of one evaluation, with the name of the block that each belongs to.
pub type Named<T> = Vec<(String, T)>;

/// The step of the differences relative to the variable's size: the error of the extrapolated
/// difference is of its sixth power, rounding of `1e-31` over it.
const STEP: f64 = 1.0 / 1_048_576.0;

/// The derivative of a list of numbers, of a variable changed by some amount from where it is.
/// `size` is the scale on which they change.
pub fn difference(size: f64, of: impl Fn(Wide) -> Named<Wide>) -> Named<Wide> {
    let central = |step: Wide| {
        let (up, down) = (of(step), of(-step));
        let share = (step + step).recip();
        up.into_iter().zip(down).map(move |((name, up), (_, down))| (name, (up - down) * share))
    };
    let wide = Wide::from_f64;
    let h = wide(STEP) * wide(size);
    let [full, half, quarter] =
        [1.0, 0.5, 0.25].map(|part| central(h * wide(part)).collect::<Vec<_>>());
    // Errors of second and fourth order cancel.
    let extrapolated = full.into_iter().zip(half).zip(quarter);
    extrapolated
        .map(|(((name, full), (_, half)), (_, quarter))| {
            let first = half + (half - full) * wide(3.0).recip();
            let second = quarter + (quarter - half) * wide(3.0).recip();
            (name, second + (second - first) * wide(15.0).recip())
        })
        .collect()
}

/// The number of an axis.
#[must_use]
pub fn index(axis: Axis) -> usize {
    match axis {
        Axis::X => 0,
        Axis::Y => 1,
        Axis::Z => 2,
    }
}

/// The attitude after a rotation about an axis of B: `[BN]` becomes `exp(-angle tilde(e)) [BN]`.
#[must_use]
pub fn turned<T: Scalar>(attitude: &Quaternion<T>, axis: Axis, angle: T) -> Quaternion<T> {
    let (sine, d0) = (angle * T::from_f64(0.5)).sin_cos();
    let mut d = [T::from_f64(0.0); 3];
    d[index(axis)] = sine;
    let Quaternion { q0, q1, q2, q3 } = *attitude;
    let q = [q1, q2, q3];
    let cross = [d[1] * q[2] - d[2] * q[1], d[2] * q[0] - d[0] * q[2], d[0] * q[1] - d[1] * q[0]];
    let along = d[0] * q[0] + d[1] * q[1] + d[2] * q[2];
    let [q1, q2, q3] = std::array::from_fn(|k| q0 * d[k] + d0 * q[k] - cross[k]);
    Quaternion { q0: d0 * q0 - along, q1, q2, q3 }
}
