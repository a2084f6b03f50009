//! [`Window`]: what a segment is multiplied by before its transform.
//!
//! A window of N samples is one period of a sum of cosines, `w_i = sum_k (-1)^k a_k cos(2 pi k i / N)`: the
//! periodic form, in which Hann's at half overlap adds up to one (Heinzel, Rüdiger, Schilling, 2002).

use std::f64::consts::TAU;

use precess_dynamics::Angle;

use super::float;

/// Coefficients of the flat-top window (G. D'Antona, A. Ferrero, Digital Signal Processing for Measurement
/// Systems, 2006, p. 70-72): those of `flattop` in `SciPy`, unity at the middle.
const FLAT_TOP: [f64; 5] =
    [0.215_578_95, 0.416_631_58, 0.277_263_158, 0.083_578_947, 0.006_947_368];

/// What a segment is multiplied by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Window {
    /// One throughout: highest resolution, for records of whole periods. Sidelobes from -13 dB.
    Rectangular,
    /// Hann's, for densities. Sidelobes from -31 dB; lines between bins lose up to 1.42 dB.
    #[default]
    Hann,
    /// Five cosine terms, for amplitudes of lines: between bins they lose up to 0.01 dB.
    FlatTop,
}

impl Window {
    /// Its weights, one for each of N samples.
    #[must_use]
    pub fn weights(self, length: usize) -> Vec<f64> {
        let angle = |i: usize| TAU * float(i) / float(length);
        let weight = |i: usize| match self {
            Self::Rectangular => 1.0,
            Self::Hann => 0.5 - 0.5 * Angle::sin_cos(angle(i)).1,
            Self::FlatTop => {
                let mut sign = -1.0;
                let terms = FLAT_TOP.iter().enumerate().map(|(k, a)| {
                    sign = -sign;
                    sign * a * Angle::sin_cos(float(k) * angle(i)).1
                });
                terms.sum()
            }
        };
        (0..length).map(weight).collect()
    }

    /// The name in files and options.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Rectangular => "rectangular",
            Self::Hann => "hann",
            Self::FlatTop => "flat-top",
        }
    }

    /// Half the width of its main lobe, bins.
    #[must_use]
    pub const fn half_width(self) -> usize {
        match self {
            Self::Rectangular => 1,
            Self::Hann => 2,
            Self::FlatTop => 5,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sums of a few hundred terms of size one, rounded.
    const ROUNDING: f64 = 1e-12;

    /// Equivalent noise bandwidth in bins, N sum w^2 / (sum w)^2.
    fn bandwidth(window: Window) -> f64 {
        let weights = window.weights(240);
        let sum: f64 = weights.iter().sum();
        240.0 * weights.iter().map(|w| w * w).sum::<f64>() / (sum * sum)
    }

    #[test]
    fn noise_bandwidths_are_those_of_the_coefficients() {
        assert!((bandwidth(Window::Rectangular) - 1.0).abs() < ROUNDING);
        assert!((bandwidth(Window::Hann) - 1.5).abs() < ROUNDING);
        // 1 + half the sum of squares of a_k / a_0: 3.7702 (table of Heinzel and others, and SciPy's).
        let closed =
            1.0 + 0.5 * FLAT_TOP.iter().skip(1).map(|a| (a / FLAT_TOP[0]).powi(2)).sum::<f64>();
        assert!((bandwidth(Window::FlatTop) - closed).abs() < ROUNDING);
        assert!((closed - 3.7702).abs() < 5e-4, "{closed}");
    }

    #[test]
    fn the_flat_top_is_one_at_the_middle() {
        let middle = Window::FlatTop.weights(64)[32];
        assert!((middle - 1.0).abs() < 1e-7, "{middle}");
    }
}
