//! How far an averaged spectrum is to be trusted: equivalent number of averages, and intervals by chi-square.

use statrs::distribution::{ChiSquared, ContinuousCDF as _};

use super::{SpectrumError, float};

/// Beyond, quantiles of few degrees of freedom are inexact: they are found to 1e-9 of one.
const LEVEL_MAX: f64 = 0.9999;

/// Number of independent segments whose mean has the variance of K overlapping ones of a white Gaussian signal:
/// `K / (1 + 2 sum_j (1 - j / K) rho_j)`, `rho_j = (sum_i w_i w_(i + j D) / sum_i w_i^2)^2` for segments D
/// samples apart (Welch 1967, eq. 9 and 11).
pub(super) fn equivalent_averages(weights: &[f64], hop: usize, segments: usize) -> f64 {
    let squares: f64 = weights.iter().map(|w| w * w).sum();
    let count = float(segments);
    let mut sum = 1.0;
    // Hops of one sample: the shared samples of later segments are many, but each is one product.
    for j in 1..segments {
        let Some(later) = j.checked_mul(hop).and_then(|shift| weights.get(shift..)) else { break };
        if later.is_empty() {
            break;
        }
        let product: f64 = later.iter().zip(weights).map(|(a, b)| a * b).sum();
        let rho = (product / squares).powi(2);
        sum += 2.0 * (1.0 - float(j) / count) * rho;
    }
    count / sum
}

/// `nu / chi2_nu(1/2 + level/2)` and `nu / chi2_nu(1/2 - level/2)`: the ends of the interval of a variance, by its
/// estimate with `nu` degrees of freedom.
pub(super) fn chi_square_factors(freedom: f64, level: f64) -> Result<[f64; 2], SpectrumError> {
    if !(level > 0.0 && level <= LEVEL_MAX) {
        return Err(SpectrumError::Level(level));
    }
    let Ok(distribution) = ChiSquared::new(freedom) else {
        return Err(SpectrumError::Averages(0.5 * freedom));
    };
    let quantile = |p: f64| freedom / distribution.inverse_cdf(p);
    let ends = [0.5 + 0.5 * level, 0.5 - 0.5 * level].map(quantile);
    if ends.iter().all(|end| end.is_finite()) { Ok(ends) } else { Err(SpectrumError::Level(level)) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectra::Window;

    /// Quantiles 0.0005 and 0.9995 of 38.9 degrees of freedom.
    const CHI2_38_9: [f64; 2] = [16.209_787_835_359_748, 74.588_102_660_556_02];
    /// Of the tables, which have three or four digits.
    const TABLE: f64 = 5e-4;

    #[test]
    fn segments_that_do_not_overlap_count_in_full() {
        let weights = Window::Hann.weights(64);
        assert_eq!(equivalent_averages(&weights, 64, 10), 10.0);
    }

    #[test]
    fn hann_at_half_overlap_has_the_correlation_one_sixth() {
        // sum w_i w_(i+N/2) / sum w^2 = (1/16) / (3/8): rho = 1/36, and K / (1 + (1 - 1/K) / 18).
        let averages = equivalent_averages(&Window::Hann.weights(1024), 512, 19);
        let closed = 19.0 / (1.0 + 2.0 / 36.0 * (1.0 - 1.0 / 19.0));
        assert!((averages / closed - 1.0).abs() < 1e-12, "{averages}");
    }

    #[test]
    fn intervals_are_those_of_the_tables_of_chi_square() {
        // chi2 of 10 degrees of freedom: 3.247 and 20.483 (Abramowitz and Stegun, table 26.8).
        let [low, high] = chi_square_factors(10.0, 0.95).expect("an interval");
        assert!((10.0 / low - 20.483).abs() < TABLE && (10.0 / high - 3.247).abs() < TABLE);
        // 38.9 degrees of freedom at 99.9 %, by `chi2.ppf` of SciPy.
        let [low, high] = chi_square_factors(38.9, 0.999).expect("an interval");
        assert!((38.9 / low / CHI2_38_9[1] - 1.0).abs() < 1e-9);
        assert!((38.9 / high / CHI2_38_9[0] - 1.0).abs() < 1e-9);
        assert!(chi_square_factors(10.0, 1.0).is_err());
        assert!(chi_square_factors(f64::NAN, 0.95).is_err());
    }
}
