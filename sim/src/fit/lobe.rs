//! A line in a spectrum that is the mean of segments: power and frequency by its lobe, with their variances.
//!
//! Of the line `a cos(w t + p)` in white noise of the one-sided density `S_0`, Hann's window w of N samples
//! turns each segment into `X_k = a V_k / 2 + N_k` at bin k, with the noise of bins k and l correlated by
//! `c_kl = sum w² exp(-2 pi i (k - l) t / N) / sum w²` (1, 2/3, 1/6, 0, ..). The estimate is
//!
//! ```text
//! P = 2 df sum (S_k - S_0')        over the bins k of the lobe, S_0' from the bins beside it
//! ```
//!
//! By Parseval its mean is `a²`. With n independent segments, and `q = 35/9 df S_0`, its variance is
//!
//! ```text
//! var P = (2 q a² + q² (1 + v)) / n
//! 35/9 = 2 sum V_k* c_kl V_l / (N sum w²)            the line times the noise
//! 1 + v = 4 sum |c_kl|² / (35/9)²                    the noise in the lobe
//!         + 4 (2 L + 1)² m / ((35/9)² bins)          S_0', over the 2 L + 1 bins of the lobe
//! ```
//!
//! A least-squares amplitude would have 3 instead of 35/9. The line is the same in all segments: no part of
//! the variance is `a⁴`, as it would be if the line itself were noise. Segments that overlap by half are
//! correlated by 3/70 in the product of line and noise and by 0.04 in the noise, so n of them count as 0.92 n.
//! `S_0'` is a median, which the skirts of other lines do not raise; lobe and bins beside are 3 bins apart, so
//! they are independent.

use super::lines::{NOISE_BINS, NOISE_BINS_MIN, float};

/// Bins on either side of a line that have its power: a main lobe of Hann's window and a bin.
pub(super) const LOBE: usize = 3;
/// Bins from a line that show its noise.
pub(super) const CLEAR: usize = 5;
/// `q` by the noise's density and the width of a bin; what stands for `E|dA|²` of an amplitude.
pub(super) const LINE_NOISE: f64 = 35.0 / 9.0;
/// `v`: of the noise in the lobe, `4 (7 + 12 * 4/9 + 10 / 36) / (35/9)² - 1`, and of the noise beside it, by
/// the number of its bins: `4 * 49 m / (35/9)²`.
const LOBE_NOISE: f64 = 2.336;
const BESIDE_NOISE: f64 = 4.0 * 49.0 * MEDIAN / (LINE_NOISE * LINE_NOISE);
/// `m`: variance of the median of bins by that of one bin, times their number: `pi / 2` of a median, and
/// neighbouring bins are correlated.
const MEDIAN: f64 = 2.52;
/// Variance of the centroid of a lobe in bins, times the segments, by the share of the noise in it: of the
/// product of line and noise, and of noise by itself, `sum of k l |c_kl|²` over the lobe.
const BY_LINE: f64 = 0.56;
const BY_NOISE: f64 = 42.5;

/// The noise beside a line.
#[derive(Clone, Copy, Debug)]
pub(super) struct Noise {
    /// Its density, units²/Hz.
    pub(super) density: f64,
    /// Bins that it is the median of.
    pub(super) bins: f64,
}

/// Sum of densities above the noise in a lobe, and their centroid in bins from its middle.
pub(super) fn lobe(densities: &[f64], bin: usize, noise: f64) -> [f64; 2] {
    let (mut sum, mut moment) = (0.0, 0.0);
    let mut offset = -float(LOBE);
    for k in bin.saturating_sub(LOBE)..=bin + LOBE {
        let above = densities.get(k).copied().unwrap_or(noise) - noise;
        sum += above;
        moment += offset * above;
        offset += 1.0;
    }
    [sum, moment / sum]
}

/// The median of the bins on either side of a lobe, as a mean of noise; bins of other lines would raise it.
/// None where too few bins are away from lines.
pub(super) fn beside(
    densities: &[f64],
    bin: usize,
    segments: f64,
    clear: &[bool],
) -> Option<Noise> {
    let low = bin.saturating_sub(NOISE_BINS)..bin.saturating_sub(CLEAR);
    let high = bin + CLEAR + 1..(bin + NOISE_BINS).min(densities.len());
    let own = low.chain(high).filter(|k| clear.get(*k).copied().unwrap_or(true));
    let mut near: Vec<f64> = own.filter_map(|k| densities.get(k).copied()).collect();
    if near.len() < NOISE_BINS_MIN {
        return None;
    }
    near.sort_by(f64::total_cmp);
    // Of an even number the upper of the two in the middle would be high by 1 / (2 bins) of the range.
    let median = 0.5 * (near[near.len() / 2] + near[(near.len() - 1) / 2]);
    // The median of a mean of n exponential numbers, by Wilson and Hilferty.
    let density = median / (1.0 - 1.0 / (9.0 * segments)).powi(3);
    Some(Noise { density, bins: float(near.len()) })
}

/// `v`: variance of a power by noise without the line, by `q²`, less the 1 of every power; `bins` beside it.
pub(super) fn noise_variance(bins: f64) -> f64 {
    LOBE_NOISE + BESIDE_NOISE / bins
}

/// Variance of a centroid in bins², times the segments; `share` is that of the noise's density in the sum.
pub(super) fn centroid_variance(share: f64) -> f64 {
    let share = share + 1e-9;
    share * (BY_LINE + BY_NOISE * share)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use nalgebra::Complex;

    use super::*;

    /// Samples of a segment.
    const SEGMENT: usize = 128;
    /// The lobe has all but this share of the power, and of its variance, wherever in a bin the line is.
    const OUTSIDE: f64 = 2e-3;
    /// Digits of the constants.
    const DIGITS: f64 = 5e-3;
    /// Of a variance of 4000 draws, three standard deviations of sqrt(2 / 4000).
    const DRAWN: f64 = 0.067;

    fn window() -> Vec<f64> {
        (0..SEGMENT).map(|t| 0.5 - 0.5 * (TAU * float(t) / float(SEGMENT)).cos()).collect()
    }

    /// `sum weight exp(-2 pi i bins t / N)`.
    fn transform(weights: &[f64], bins: f64) -> Complex<f64> {
        let each = weights.iter().enumerate();
        each.map(|(t, w)| Complex::from_polar(*w, -TAU * bins * float(t) / float(SEGMENT))).sum()
    }

    /// Correlation of the noise of bins that are `apart`.
    fn correlation(apart: f64) -> Complex<f64> {
        let squares: Vec<f64> = window().iter().map(|w| w * w).collect();
        transform(&squares, apart) / squares.iter().sum::<f64>()
    }

    fn bins() -> Vec<f64> {
        (0..=2 * LOBE).map(|k| float(k) - float(LOBE)).collect()
    }

    #[test]
    fn variances_of_power_and_centroid_are_those_of_the_window() {
        let window = window();
        let squares: f64 = window.iter().map(|w| w * w).sum();
        let bins = bins();
        let mut by_line = 0.0;
        for place in [-0.5, -0.25, 0.0, 0.25, 0.5] {
            let line: Vec<_> = bins.iter().map(|k| transform(&window, k - place)).collect();
            let power: f64 = line.iter().map(Complex::norm_sqr).sum();
            let share = power / (float(SEGMENT) * squares);
            assert!((share - 1.0).abs() < OUTSIDE, "{place}: {share}");
            let moment: f64 = bins.iter().zip(&line).map(|(k, v)| k * v.norm_sqr()).sum();
            let centre = moment / power;
            assert!((centre - place).abs() < OUTSIDE, "{place}: {centre}");
            let (mut product, mut moments) = (0.0, 0.0);
            for (k, v) in bins.iter().zip(&line) {
                for (l, u) in bins.iter().zip(&line) {
                    let term = (v.conj() * correlation(k - l) * u).re;
                    product += term;
                    moments += (k - centre) * (l - centre) * term;
                }
            }
            let found = 2.0 * product / (float(SEGMENT) * squares);
            assert!((found / LINE_NOISE - 1.0).abs() < OUTSIDE, "{place}: {found}");
            by_line += 2.0 * moments / power / 5.0;
        }
        assert!((by_line / BY_LINE - 1.0).abs() < 0.02, "{by_line}");
        let (mut noise, mut moments) = (0.0, 0.0);
        for k in &bins {
            for l in &bins {
                noise += correlation(k - l).norm_sqr();
                moments += k * l * correlation(k - l).norm_sqr();
            }
        }
        let found = 4.0 * noise / (LINE_NOISE * LINE_NOISE) - 1.0;
        assert!((found / LOBE_NOISE - 1.0).abs() < DIGITS, "{found}");
        assert!((moments / BY_NOISE - 1.0).abs() < DIGITS, "{moments}");
    }

    #[test]
    fn the_noise_beside_a_line_is_a_mean_with_the_variance_stated() {
        // Independent normal transforms, correlated by Hann's window: X_k - (X_(k-1) + X_(k+1)) / 2.
        const DRAWS: u32 = 4000;
        const SEGMENTS: u32 = 12;
        let mut state = 1_u64;
        let mut uniform = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            f64::from(u32::try_from(state >> 32).unwrap_or(0)) / 4_294_967_296.0
        };
        let clear = vec![true; 80];
        let (mut sum, mut squares) = (0.0, 0.0);
        for _ in 0..DRAWS {
            let mut densities = vec![0.0; 80];
            for _ in 0..SEGMENTS {
                let plain: Vec<Complex<f64>> = (0..82)
                    .map(|_| {
                        let radius = (-(1.0 - uniform()).ln()).sqrt();
                        Complex::from_polar(radius, TAU * uniform())
                    })
                    .collect();
                for (density, x) in densities.iter_mut().zip(plain.windows(3)) {
                    let value = x[1] - (x[0] + x[2]) * 0.5;
                    *density += value.norm_sqr() / (1.5 * f64::from(SEGMENTS));
                }
            }
            let noise = beside(&densities, 40, f64::from(SEGMENTS), &clear).expect("54 bins");
            assert_eq!(noise.bins, 53.0);
            sum += noise.density;
            squares += noise.density * noise.density;
        }
        let mean = sum / f64::from(DRAWS);
        let variance = squares / f64::from(DRAWS) - mean * mean;
        assert!((mean - 1.0).abs() < DIGITS, "{mean}");
        let found = variance * f64::from(SEGMENTS) * 53.0;
        assert!((found / MEDIAN - 1.0).abs() < DRAWN, "{found}");
    }
}
