//! The sum `x_j = sum_k c_k exp(2 pi i j k / M)` for all j, of a power of two of samples: radix 2, in place.
//!
//! Written here for its bits: `rustfft` takes its sines from the host's library, and so would what a
//! seed realises. These are the solver's own, the same on every host. (Cooley and Tukey, Math. Comp.
//! 19, 297-301, 1965; bit reversal first, then stages of growing span.)

use std::f64::consts::TAU;

use precess_dynamics::Angle;
use realfft::num_complex::Complex;

/// `exp(2 pi i k / M)` for the first half of a circle.
pub(crate) struct Roots(Vec<Complex<f64>>);

impl Roots {
    /// Of `M`, a power of two.
    pub(crate) fn new(length: usize) -> Self {
        #[expect(clippy::cast_precision_loss, reason = "fewer samples than 2^53")]
        let root = |k: usize| {
            let (sin, cos) = Angle::sin_cos(TAU * (k as f64 / length as f64));
            Complex::new(cos, sin)
        };
        Self((0..length / 2).map(root).collect())
    }

    /// Replaces coefficients by samples; as many as the roots are of.
    pub(crate) fn synthesise(&self, values: &mut [Complex<f64>]) {
        let length = values.len();
        if length != 2 * self.0.len() {
            return;
        }
        let shift = usize::BITS - length.trailing_zeros();
        for index in 0..length {
            let reversed = index.reverse_bits() >> shift;
            if index < reversed {
                values.swap(index, reversed);
            }
        }
        let mut half = 1;
        while half < length {
            let stride = length / (2 * half);
            for block in values.chunks_exact_mut(2 * half) {
                let (low, high) = block.split_at_mut(half);
                let roots = self.0.iter().step_by(stride);
                for ((a, b), root) in low.iter_mut().zip(high).zip(roots) {
                    let turned = *b * root;
                    (*a, *b) = (*a + turned, *a - turned);
                }
            }
            half *= 2;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sixteen numbers of order one, each added with a rounding of a sum below sixteen, 2e-15.
    const ROUNDING: f64 = 2e-14;

    #[test]
    fn it_is_the_sum_that_it_states() {
        let length = 16_u32;
        let coefficient = |k: u32| {
            let k = f64::from(k);
            Complex::new((1.3 * k).sin(), (0.7 * k * k).cos())
        };
        let mut values: Vec<_> = (0..length).map(coefficient).collect();
        Roots::new(16).synthesise(&mut values);
        for (j, found) in (0..length).zip(&values) {
            let term = |k: u32| {
                let angle = TAU * f64::from(j * k % length) / f64::from(length);
                coefficient(k) * Complex::new(angle.cos(), angle.sin())
            };
            let expected: Complex<f64> = (0..length).map(term).sum();
            assert!((found - expected).norm() < ROUNDING, "{j}: {found} {expected}");
        }
    }
}
