//! Fourier coefficients of matrices that are sampled at equal steps over a turn of a rotor.

use std::f64::consts::TAU;

use nalgebra::{Complex, DMatrix};

use super::accelerance::ComplexMatrix;

/// `part / of`.
#[expect(clippy::cast_precision_loss, reason = "small integers")]
pub(crate) fn share(part: usize, of: usize) -> f64 {
    part as f64 / of as f64
}

/// The discrete Fourier transform of samples of `N` matrices: the mean, then the harmonics, as factors of
/// `exp(i k angle)`.
pub(crate) fn fourier<const N: usize>(samples: &[[DMatrix<f64>; N]]) -> Vec<[ComplexMatrix; N]> {
    let count = samples.len();
    let part = |harmonic: usize, of: usize| {
        let mut sum: Option<ComplexMatrix> = None;
        for (index, sample) in samples.iter().enumerate() {
            let angle = -TAU * share(harmonic * index % count, count);
            let weight = Complex::from_polar(share(1, count), angle);
            let Some(matrix) = sample.get(of) else { continue };
            let term = matrix.map(|value| weight * value);
            sum = Some(match sum {
                Some(sum) => sum + term,
                None => term,
            });
        }
        sum.unwrap_or_else(|| ComplexMatrix::zeros(0, 0))
    };
    (0..count).map(|harmonic| std::array::from_fn(|of| part(harmonic, of))).collect()
}
