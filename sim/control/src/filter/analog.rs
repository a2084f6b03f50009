//! [`AnalogSection`]: a transfer function of s of second order at most, and its discrete form by the bilinear transform.
//!
//! With `s = c (1 - 1/z) / (1 + 1/z)`: `c = 2 / T` (Tustin), or `c = w / tan(w T / 2)`, by which the discrete filter has at
//! the frequency `w` exactly what the analog one has there (prewarped). Oppenheim, Schafer, *Discrete-Time Signal
//! Processing*, 7.2.

use core::f64::consts::PI;

use crate::filter::section::Section;
use crate::model::error::{self, ControlError};

/// `(b2 s² + b1 s + b0) / (a2 s² + a1 s + a0)`: coefficients from the highest power down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AnalogSection {
    numerator: [f64; 3],
    denominator: [f64; 3],
}

/// How a transfer function of s becomes one of z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Discretisation {
    /// The bilinear transform as it is: frequencies are compressed, `w` becomes `2 / T atan(w T / 2)`.
    Bilinear,
    /// The bilinear transform that keeps this frequency, rad/s: positive, below half of the sampling rate.
    Prewarped(f64),
}

impl AnalogSection {
    /// Of coefficients from the highest power of s down.
    ///
    /// # Errors
    ///
    /// A coefficient that is not finite, or a pole that is not in the left half plane: of a denominator of second order all
    /// three coefficients have the same sign, of first order the last two.
    pub fn new(numerator: [f64; 3], denominator: [f64; 3]) -> Result<Self, ControlError> {
        for value in numerator.into_iter().chain(denominator) {
            error::finite("coefficient", value)?;
        }
        let [a2, a1, a0] = denominator;
        let sign = if a0 < 0.0 { -1.0 } else { 1.0 };
        let second = sign * a2 > 0.0 && sign * a1 > 0.0;
        let first = a2 == 0.0 && sign * a1 >= 0.0;
        if a0 == 0.0 || !(second || first) {
            return Err(ControlError::Unstable { first: a1, second: a0 });
        }
        Ok(Self { numerator, denominator })
    }

    /// Low-pass of first order: `1 / (s / w + 1)`, w in rad/s.
    ///
    /// # Errors
    ///
    /// A frequency that is not positive.
    pub fn low_pass_of_first_order(cutoff: f64) -> Result<Self, ControlError> {
        error::positive("cutoff frequency", cutoff)?;
        Self::new([0.0, 0.0, cutoff], [0.0, 1.0, cutoff])
    }

    /// Low-pass of second order: `w² / (s² + 2 zeta w s + w²)`, w in rad/s.
    ///
    /// # Errors
    ///
    /// A frequency or a damping ratio that is not positive.
    pub fn low_pass(cutoff: f64, damping: f64) -> Result<Self, ControlError> {
        error::positive("cutoff frequency", cutoff)?;
        error::positive("damping ratio", damping)?;
        let square = cutoff * cutoff;
        Self::new([0.0, 0.0, square], [1.0, 2.0 * damping * cutoff, square])
    }

    /// Low-pass of second order by Butterworth: the damping ratio is `1 / sqrt(2)`, the gain at the cutoff, too.
    ///
    /// # Errors
    ///
    /// A frequency that is not positive.
    pub fn butterworth(cutoff: f64) -> Result<Self, ControlError> {
        Self::low_pass(cutoff, core::f64::consts::FRAC_1_SQRT_2)
    }

    /// Notch: `(s² + 2 zeta_z w s + w²) / (s² + 2 zeta_p w s + w²)`, w in rad/s. At w its gain is `zeta_z / zeta_p`, far
    /// from it one.
    ///
    /// # Errors
    ///
    /// A frequency or a damping of the poles that is not positive, or a damping of the zeros that is negative.
    pub fn notch(
        frequency: f64,
        damping_of_zeros: f64,
        damping_of_poles: f64,
    ) -> Result<Self, ControlError> {
        error::positive("notch frequency", frequency)?;
        error::not_negative("damping ratio of the zeros", damping_of_zeros)?;
        error::positive("damping ratio of the poles", damping_of_poles)?;
        let square = frequency * frequency;
        Self::new(
            [1.0, 2.0 * damping_of_zeros * frequency, square],
            [1.0, 2.0 * damping_of_poles * frequency, square],
        )
    }

    /// Lead or lag: `(s / w_z + 1) / (s / w_p + 1)`, in rad/s. A lead where the zero is below the pole; its gain at low
    /// frequencies is one, at high ones `w_p / w_z`.
    ///
    /// # Errors
    ///
    /// A frequency that is not positive.
    pub fn lead_lag(zero: f64, pole: f64) -> Result<Self, ControlError> {
        error::positive("frequency of the zero", zero)?;
        error::positive("frequency of the pole", pole)?;
        Self::new([0.0, 1.0 / zero, 1.0], [0.0, 1.0 / pole, 1.0])
    }

    /// At the sampling period T, s.
    ///
    /// # Errors
    ///
    /// A period that is not positive, or a prewarped frequency at half of the sampling rate or above.
    pub fn discrete(&self, period: f64, by: Discretisation) -> Result<Section, ControlError> {
        error::positive("sampling period", period)?;
        let c = match by {
            Discretisation::Bilinear => 2.0 / period,
            Discretisation::Prewarped(frequency) => {
                error::positive("prewarped frequency", frequency)?;
                if frequency * period >= PI {
                    let nyquist = PI / period;
                    return Err(ControlError::AboveNyquist { frequency, nyquist });
                }
                frequency / libm::tan(0.5 * frequency * period)
            }
        };
        // Polynomials of z: (c (z - 1))^k (z + 1)^(2 - k); of a section of first order one factor z + 1 less in both.
        let [b, a] = [self.numerator, self.denominator];
        let of_first_order = a[0] == 0.0 && b[0] == 0.0;
        let polynomial = |[second, first, constant]: [f64; 3]| {
            let (second, first) = (second * c * c, first * c);
            if of_first_order {
                [constant + first, constant - first, 0.0]
            } else {
                [second + first + constant, 2.0 * (constant - second), second - first + constant]
            }
        };
        let [a0, a1, a2] = polynomial(a);
        Section::new(polynomial(b).map(|b| b / a0), [a1 / a0, a2 / a0])
    }
}
