//! [`Turn`]: the rotation of a mount, the exponential of a rotation vector, and its right Jacobian.
//!
//! ```text
//! R = exp(tilde(t)) = 1 + s T + a T²                  s = sin x / x,   a = (1 - cos x) / x²
//! w = J t',   J = 1 - a T + b T²                      b = (x - sin x) / x³,   x = |t|,  T = tilde(t)
//! J' t' = -a1 (t . t') T t' + b1 (t . t') T² t' + b t' x (t x t')
//! a1 = (da/dx) / x = (s - 2 a) / x²,   b1 = (db/dx) / x = (a - 3 b) / x²
//! ```
//!
//! Near zero the five coefficients come from their series, with all digits of `f64`.

use crate::numbers::real::Scalar;
use crate::numbers::vec3::{Columns, Vec3, add, cross, dot, scale};

/// Square of the angle up to which the series are used, rad².
const SERIES: f64 = 0.5;

/// The rotation of a mount for the rotation vector `t`, rad, expressed in B.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turn<T> {
    t: Vec3<T>,
    s: T,
    a: T,
    b: T,
    a1: T,
    b1: T,
}

impl<T: Scalar> Turn<T> {
    /// The rotation by `t`.
    pub(crate) fn new(t: Vec3<T>) -> Self {
        let square = dot(t, t);
        if square <= T::from_f64(SERIES) {
            let [s, a, b, a1, b1] = series(square);
            return Self { t, s, a, b, a1, b1 };
        }
        let (x, over, one) = (square.sqrt(), square.recip(), T::from_f64(1.0));
        let (sin, cos) = x.sin_cos();
        let s = sin * x.recip();
        let (a, b) = ((one - cos) * over, (one - s) * over);
        let a1 = (s - (a + a)) * over;
        let b1 = (a - (b + b + b)) * over;
        Self { t, s, a, b, a1, b1 }
    }

    /// `(R - 1) v`.
    pub(crate) fn displaced(&self, v: Vec3<T>) -> Vec3<T> {
        let once = cross(self.t, v);
        add(scale(self.s, once), scale(self.a, cross(self.t, once)))
    }

    /// The axes of the mount, expressed in B: the columns of R.
    pub(crate) fn axes(&self) -> Columns<T> {
        self.columns(self.s, self.a)
    }

    /// The columns of `1 + p T + q T²`.
    fn columns(&self, p: T, q: T) -> Columns<T> {
        let ([x, y, z], one) = (self.t, T::from_f64(1.0));
        let (px, py, pz) = (p * x, p * y, p * z);
        let (qx, qy, qz) = (q * x, q * y, q * z);
        let (xx, yy, zz) = (qx * x, qy * y, qz * z);
        let (xy, xz, yz) = (qx * y, qx * z, qy * z);
        [
            [one - (yy + zz), xy + pz, xz - py],
            [xy - pz, one - (xx + zz), yz + px],
            [xz + py, yz - px, one - (xx + yy)],
        ]
    }

    /// `J v`, expressed in the mount's axes.
    pub(crate) fn rate(&self, v: Vec3<T>) -> Vec3<T> {
        let once = cross(self.t, v);
        add(v, add(scale(-self.a, once), scale(self.b, cross(self.t, once))))
    }

    /// The columns of J.
    pub(crate) fn jacobian(&self) -> Columns<T> {
        self.columns(-self.a, self.b)
    }

    /// `J' t'`, expressed in the mount's axes.
    pub(crate) fn bias(&self, t_dot: Vec3<T>) -> Vec3<T> {
        let along = dot(self.t, t_dot);
        let once = cross(self.t, t_dot);
        let turning =
            add(scale(-(self.a1 * along), once), scale(self.b1 * along, cross(self.t, once)));
        add(turning, scale(self.b, cross(t_dot, once)))
    }
}

/// `s, a, b, a1, b1` by their series in the square of the angle: coefficient k of x²ᵏ is
/// `(-1)ᵏ / (2k+1)!`, `/ (2k+2)!`, `/ (2k+3)!`, and `(-1)ᵏ⁺¹ (2k+2) / (2k+4)!`, `/ (2k+5)!`.
fn series<T: Scalar>(square: T) -> [T; 5] {
    let mut sums = [T::from_f64(0.0); 5];
    for coefficients in COEFFICIENTS.iter().rev() {
        for (sum, coefficient) in sums.iter_mut().zip(coefficients) {
            *sum = *sum * square + T::from_f64(*coefficient);
        }
    }
    sums
}

/// The first term left out is below `0.5⁹ / 19!`, 2e-20.
const COEFFICIENTS: [[f64; 5]; 9] = coefficients();

#[expect(clippy::indexing_slicing, reason = "evaluated by the compiler")]
#[expect(clippy::cast_precision_loss, reason = "integers below 2^53")]
const fn coefficients() -> [[f64; 5]; 9] {
    let mut rows = [[0.0; 5]; 9];
    let (mut k, mut sign) = (0, 1.0);
    while k < 9 {
        let n = 2 * k as u64;
        let (first, second) = (factorial(n + 1), factorial(n + 2));
        let third = factorial(n + 3);
        let twice = -sign * (n + 2) as f64;
        let fourth = third * (n + 4) as f64;
        rows[k] = [
            sign / first,
            sign / second,
            sign / third,
            twice / fourth,
            twice / (fourth * (n + 5) as f64),
        ];
        sign = -sign;
        k += 1;
    }
    rows
}

#[expect(clippy::cast_precision_loss, reason = "integers below 2^53")]
const fn factorial(n: u64) -> f64 {
    let (mut product, mut k) = (1.0, 2);
    while k <= n {
        product *= k as f64;
        k += 1;
    }
    product
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::vec3::{rotate, rotate_transposed, sub};

    const AT: Vec3<f64> = [0.31, -0.44, 0.27];
    const RATE: Vec3<f64> = [0.7, 0.2, -1.1];

    #[test]
    fn series_and_closed_forms_agree_where_they_meet() {
        let direction = scale(dot(AT, AT).sqrt().recip(), AT);
        let below = Turn::new(scale(0.5_f64.sqrt() * (1.0 - 1e-15), direction));
        let above = Turn::new(scale(0.5_f64.sqrt() * (1.0 + 1e-15), direction));
        for (x, y) in [(below.s, above.s), (below.a, above.a), (below.b, above.b)] {
            assert!((x - y).abs() < 1e-15, "{x} {y}");
        }
        // Differences of nearly equal numbers, over a square of 0.5.
        assert!((below.a1 - above.a1).abs() < 2e-15 && (below.b1 - above.b1).abs() < 4e-15);
    }

    #[test]
    fn axes_are_orthonormal_and_right_handed_at_any_angle() {
        for size in [0.0, 1e-9, 0.3, 1.0, 3.0, 7.0] {
            let [x, y, z] = Turn::new(scale(size, AT)).axes();
            for (found, expected) in [(dot(x, x), 1.0), (dot(y, y), 1.0), (dot(x, y), 0.0)] {
                assert!((found - expected).abs() < 1e-15 * 8.0);
            }
            assert!(sub(cross(x, y), z).iter().all(|c| c.abs() < 1e-15 * 8.0));
        }
    }

    #[test]
    fn rate_and_bias_are_derivatives_of_the_rotation() {
        // Along t + RATE h: R' = R tilde(w), and w' is the bias since t'' is zero.
        for size in [0.02, 1.0, 4.0] {
            let at = |h: f64| Turn::new(add(scale(size, AT), scale(h, RATE)));
            let h = 1e-5;
            let w = at(0.0).rate(RATE);
            let v = [0.3, 0.5, -0.9];
            let slope = sub(rotate(&at(h).axes(), v), rotate(&at(-h).axes(), v));
            let found = rotate_transposed(&at(0.0).axes(), scale(0.5 / h, slope));
            // Central differences: h² and rounding over h, 1e-10 each.
            assert!(sub(found, cross(w, v)).iter().all(|c| c.abs() < 1e-9));
            let slope = scale(0.5 / h, sub(at(h).rate(RATE), at(-h).rate(RATE)));
            assert!(sub(slope, at(0.0).bias(RATE)).iter().all(|c| c.abs() < 1e-9));
        }
    }
}
