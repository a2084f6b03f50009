//! The right Jacobian J of SO(3), by which the rate of a rotation vector becomes an angular velocity about turned axes.
//!
//! ```text
//! J v    = v - A phi x v + B phi x (phi x v)        A = (1 - cos p) / p²   B = (p - sin p) / p³   p = |phi|
//! J^-1 v = v + phi x v / 2 + C phi x (phi x v)      C = 1 / p² - (1 + cos p) / (2 p sin p)
//! ```
//!
//! Chirikjian, *Stochastic Models, Information Theory, and Lie Groups*, volume 2, 10.86.

use nalgebra::{Matrix3, Vector3};

/// `sum (-x)^m / (2m + first)!`, and its derivative by x twice: A and B of `x = p²` and `A' / p`, `B' / p`.
///
/// For x up to 1: what is left out is below 1e-17.
fn series(x: f64, first: u32) -> (f64, f64) {
    let (mut sum, mut derivative) = (0.0, 0.0);
    let factorial: f64 = (1..=first).map(f64::from).product();
    let mut term = 1.0 / factorial;
    for m in 0..9_u32 {
        sum += term;
        let next = first + 2 * m;
        // The derivative of the next term by p, divided by p.
        let divisor = f64::from(next + 1) * f64::from(next + 2);
        derivative -= 2.0 * f64::from(m + 1) * (term / divisor);
        term *= -x / divisor;
    }
    (sum, derivative)
}

/// A and B, and their derivatives by p divided by p.
pub(crate) fn coefficients(p2: f64) -> [(f64, f64); 2] {
    if p2 <= 1.0 {
        return [series(p2, 2), series(p2, 3)];
    }
    let p = libm::sqrt(p2);
    let (sin, cos) = libm::sincos(p);
    let (a, b) = ((1.0 - cos) / p2, (p - sin) / (p2 * p));
    [(a, (sin / p - 2.0 * a) / p2), (b, (a - 3.0 * b) / p2)]
}

/// J of a rotation vector.
pub(crate) fn jacobian(phi: &Vector3<f64>) -> Matrix3<f64> {
    let [(a, _), (b, _)] = coefficients(phi.norm_squared());
    let cross = phi.cross_matrix();
    Matrix3::identity() - cross * a + cross * cross * b
}

/// `J^-1 v`, for `|phi|` up to half a turn.
pub(crate) fn inverse_jacobian(phi: &Vector3<f64>, v: &Vector3<f64>) -> Vector3<f64> {
    let p2 = phi.norm_squared();
    let [(a, _), (b, _)] = coefficients(p2);
    // sin p / p = 1 - p² B and (1 + cos p) / sin p = sin p / (1 - cos p).
    // What rounding the difference leaves in C is multiplied by p² again.
    let c = if p2 > 1e-8 { (1.0 - (1.0 - p2 * b) / (2.0 * a)) / p2 } else { 1.0 / 12.0 };
    let once = phi.cross(v);
    v + once * 0.5 + phi.cross(&once) * c
}
