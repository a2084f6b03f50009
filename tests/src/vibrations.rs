//! The longest stable step of a linear system from all of its eigenvalues, for what the solver
//! states without them.

use nalgebra::{Complex, DMatrix};

/// Largest magnitude of `λ dt` at which Runge-Kutta's method of fourth order is stable in any
/// direction of the left half plane is 2.961.
const BEYOND: f64 = 3.0;

/// The longest step, s, at which Runge-Kutta's method of fourth order is stable with
/// `q'' + M⁻¹ (C q' + K q) = 0`, for the rows of `M⁻¹` of the coordinates and the diagonals of C
/// and K.
///
/// # Panics
/// If the eigenvalues do not converge.
#[must_use]
pub fn longest_step(responses: &DMatrix<f64>, damping: &[f64], stiffness: &[f64]) -> f64 {
    let count = damping.len();
    // In units of the fastest rate that a bound allows, so that both halves are of one size.
    let rate = (0..count).fold(0.0_f64, |most, k| {
        let own = responses[(k, k)];
        most.max((own * stiffness[k]).sqrt()).max(own * damping[k])
    });
    let matrix = DMatrix::from_fn(2 * count, 2 * count, |row, column| {
        let (half, k) = (column / count, column % count);
        match row.checked_sub(count) {
            None => f64::from(u8::from(half == 1 && row == k)),
            Some(row) if half == 0 => -responses[(row, k)] * stiffness[k] / (rate * rate),
            Some(row) => -responses[(row, k)] * damping[k] / rate,
        }
    });
    let values = matrix.complex_eigenvalues();
    // Those of motions without a spring are zero to the root of rounding.
    let sized = values.iter().map(|value| (*value, magnitude(*value)));
    let least = sized
        .filter(|(_, size)| *size > 1e-5)
        .fold(f64::INFINITY, |least, (value, size)| least.min(limit(value.unscale(size)) / size));
    least / rate
}

/// The magnitude of `λ dt` up to which the method is stable in a direction.
fn limit(direction: Complex<f64>) -> f64 {
    let (mut stable, mut unstable) = (0.0, BEYOND);
    for _ in 0..60 {
        let middle = 0.5 * (stable + unstable);
        // The roots of undamped vibrations are on the axis but for rounding.
        if amplification(direction * middle) <= 1.0 + 1e-9 * middle {
            stable = middle;
        } else {
            unstable = middle;
        }
    }
    stable
}

/// `|R(z)|`.
fn amplification(z: Complex<f64>) -> f64 {
    let one = Complex::new(1.0, 0.0);
    magnitude([4.0, 3.0, 2.0, 1.0].into_iter().fold(one, |sum, divisor| sum * z / divisor + 1.0))
}

fn magnitude(z: Complex<f64>) -> f64 {
    libm::hypot(z.re, z.im)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn single_spring_and_damper_have_the_limits_of_the_method() {
        let single = |c: f64, k: f64| longest_step(&DMatrix::from_element(1, 1, 2.0), &[c], &[k]);
        assert!((single(0.0, 50.0) - 0.282_842_712_474_619).abs() < 1e-6);
        assert!((single(5.0, 0.0) - 0.278_529_356_340_528).abs() < 1e-6);
    }
}
