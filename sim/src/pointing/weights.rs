//! [`ExposureWeights`]: shares of the variance of a line in displacement, smear and jitter of an exposure.
//!
//! In an exposure of length T, motion is split by least squares into its mean (displacement), the straight line
//! through it without the mean (smear) and the rest (jitter). The three are orthogonal, so of a line of frequency f
//! with random phase, with `u = pi f T`, they have the shares (Pittelkau and `McKinley` 2016; Lucke, Sirlin and San
//! Martin 1992, whose jitter is smear and jitter together)
//!
//! ```text
//! displacement  sinc^2 u                            = j_0^2
//! smear         3 (sinc u - cos u)^2 / u^2          = 3 j_1^2
//! jitter        1 - displacement - smear            = sum over n >= 2 of (2 n + 1) j_n^2
//! ```
//!
//! with spherical Bessel functions `j_n(u)`, whose sum over all n is one (Abramowitz and Stegun, 10.1.50): the
//! coefficients of the line in Legendre polynomials over the exposure.

use std::f64::consts::PI;

use precess_dynamics::Angle;

/// Below this, the series are used: above, differences lose no more than three digits.
const SERIES_BELOW: f64 = 1.5;
/// Terms of a series, and Bessel functions of the jitter, enough for doubles below `SERIES_BELOW`.
const TERMS: u32 = 14;

/// Shares of the variance of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExposureWeights {
    /// Of the mean over the exposure.
    pub displacement: f64,
    /// Of the straight line through the motion, its mean left out.
    pub smear: f64,
    /// Of the rest.
    pub jitter: f64,
}

impl ExposureWeights {
    /// Of a line of a frequency, Hz, in an exposure, s. A product that is not finite or negative is taken as
    /// infinite: all of it is jitter.
    #[must_use]
    pub fn new(frequency: f64, exposure: f64) -> Self {
        let u = PI * frequency * exposure;
        if !(0.0..=1e15).contains(&u) {
            return Self { displacement: 0.0, smear: 0.0, jitter: 1.0 };
        }
        if u < SERIES_BELOW {
            let share = |order: u32| f64::from(2 * order + 1) * bessel(order, u).powi(2);
            // From the smallest term.
            let jitter = (2..TERMS).rev().map(share).sum();
            return Self { displacement: share(0), smear: share(1), jitter };
        }
        let (sine, cosine) = Angle::sin_cos(u);
        let sinc = sine / u;
        let displacement = sinc * sinc;
        let smear = 3.0 * ((sinc - cosine) / u).powi(2);
        Self { displacement, smear, jitter: (1.0 - displacement - smear).max(0.0) }
    }

    /// The share of what departs from the mean: smear and jitter, `1 - sinc^2 u`.
    #[must_use]
    pub fn departure(&self) -> f64 {
        self.smear + self.jitter
    }
}

/// Spherical Bessel function `j_n(u) = u^n / (2n+1)!! sum_k (-u^2/2)^k / (k! (2n+3)(2n+5)...(2n+2k+1))` of a small u
/// (Abramowitz and Stegun, 10.1.2).
fn bessel(order: u32, u: f64) -> f64 {
    let lead: f64 = (1..=order).map(|k| u / f64::from(2 * k + 1)).product();
    let (mut sum, mut term) = (0.0, 1.0);
    for k in 1..=TERMS {
        sum += term;
        term *= -0.5 * u * u / (f64::from(k) * f64::from(2 * (order + k) + 1));
    }
    lead * sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of Simpson's rule with eight thousand parts, and of its sums, relative.
    const QUADRATURE: f64 = 1e-9;

    /// Simpson's rule over the exposure from -1/2 to 1/2.
    fn integral(of: impl Fn(f64) -> f64) -> f64 {
        let parts = 8000;
        let step = 1.0 / f64::from(parts);
        let weight = |k: i32| match k {
            0 => 1.0,
            k if k == parts => 1.0,
            k if k % 2 == 1 => 4.0,
            _ => 2.0,
        };
        (0..=parts).map(|k| weight(k) * of(f64::from(k) * step - 0.5)).sum::<f64>() * step / 3.0
    }

    #[test]
    fn each_share_is_that_of_the_least_squares_line_by_quadrature() {
        for u in [0.01, 0.1, 0.7, 1.4999, 1.5001, 2.0, PI, 4.5, 9.0, 20.0] {
            let weights = ExposureWeights::new(u, 1.0 / PI);
            let (mut displacement, mut smear, mut jitter) = (0.0, 0.0, 0.0);
            // The mean over all phases is that of two a quarter turn apart.
            for phase in [0.0, 0.5 * PI] {
                let line = |t: f64| 2.0_f64.sqrt() * (2.0 * u * t + phase).cos();
                let mean = integral(line);
                let slope = 12.0 * integral(|t| t * line(t));
                displacement += 0.5 * mean * mean;
                smear += 0.5 * integral(|t| (slope * t).powi(2));
                jitter += 0.5 * integral(|t| (line(t) - mean - slope * t).powi(2));
            }
            let near = |found: f64, expected: f64, of: &str| {
                // A share that passes zero is zero but for rounding.
                let off = (found - expected).abs() / expected.max(f64::EPSILON);
                assert!(off < QUADRATURE, "{of} at {u}: {found} for {expected}");
            };
            near(weights.displacement, displacement, "displacement");
            near(weights.smear, smear, "smear");
            near(weights.jitter, jitter, "jitter");
        }
    }

    #[test]
    fn shares_near_zero_are_their_leading_terms() {
        // 1, u^2/3, u^4/45, with relative corrections of the order u^2.
        for u in [1e-3, 1e-5, 1e-8, 1e-60] {
            let weights = ExposureWeights::new(u, 1.0 / PI);
            let near = |found: f64, expected: f64| {
                assert!((found / expected - 1.0).abs() < u * u + 1e-14, "{u}: {found}");
            };
            near(weights.displacement, 1.0);
            near(weights.smear, u * u / 3.0);
            near(weights.jitter, u.powi(4) / 45.0);
        }
        let still = ExposureWeights::new(0.0, 1.0);
        assert_eq!((still.displacement, still.smear, still.jitter), (1.0, 0.0, 0.0));
        assert_eq!(ExposureWeights::new(f64::NAN, 1.0).jitter, 1.0);
        assert_eq!(ExposureWeights::new(f64::INFINITY, 1.0).jitter, 1.0);
    }

    #[test]
    fn series_and_closed_form_meet() {
        let below = ExposureWeights::new(SERIES_BELOW * (1.0 - 1e-14), 1.0 / PI);
        let above = ExposureWeights::new(SERIES_BELOW * (1.0 + 1e-14), 1.0 / PI);
        // Three digits of the difference of numbers of size one are lost.
        for (a, b) in [
            (below.displacement, above.displacement),
            (below.smear, above.smear),
            (below.jitter, above.jitter),
        ] {
            assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
        }
    }
}
