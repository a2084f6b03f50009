//! [`Harmonic`]: tones at multiples of a wheel's angle, with amplitudes that grow with the square of its
//! rate; after Masterson, Miller, Grogan, "Development and validation of reaction wheel disturbance
//! models: empirical model", J. Sound Vib. 249(3), 575-598, 2002.
//!
//! ```text
//! F_j = sum_i C_ij Omega² sin(h_i theta + phi_ij)          j one of six components
//! ```
//!
//! The paper has `2 pi h_i f t` for the argument, at a constant speed `f = Omega / 2 pi`. Here it is `h_i`
//! times the wheel's angle theta, of which that is the value at a constant speed: while the speed changes,
//! the instantaneous frequency is `h_i Omega`, and no phase jumps. Omega is the present rate of the wheel
//! with respect to its parent body, theta its coordinate, whole turns counted: `h_i` is not an integer.

use std::f64::consts::TAU;

use precess_dynamics::Angle;

use super::{COMPONENT_COUNT, Six};

/// The tones at one multiple of the wheel's angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Harmonic {
    /// h, the multiple: 1 of an imbalance, other numbers of bearings and motor.
    pub number: f64,
    /// C, amplitude over the square of the rate, not negative: kg m of forces, kg m² of moments.
    pub amplitudes: Six<f64>,
    /// phi, rad.
    pub phases: Six<f64>,
}

/// Where a wheel is, and its rate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WheelAngle {
    /// theta less its whole turns, rad.
    pub theta: f64,
    /// The whole turns.
    pub turns: f64,
    /// Omega, rad/s.
    pub rate: f64,
}

impl WheelAngle {
    /// A multiple of the angle, rad, less whole turns of that of the whole turns.
    fn times(&self, number: f64) -> f64 {
        // h theta is not reduced by h turns, which are no whole turns; what is left of them is.
        let turns = number * self.turns;
        number * self.theta + TAU * (turns - turns.floor())
    }
}

impl Harmonic {
    /// Force, N, and moment, N m, of tones, along the data sheet's axes.
    #[must_use]
    pub fn sum(tones: &[Self], wheel: &WheelAngle) -> Six<f64> {
        let mut sum = [0.0; COMPONENT_COUNT];
        let square = wheel.rate * wheel.rate;
        for tone in tones {
            let angle = wheel.times(tone.number);
            let components = tone.amplitudes.iter().zip(&tone.phases);
            for (to, (amplitude, phase)) in sum.iter_mut().zip(components) {
                if *amplitude != 0.0 {
                    // The solver's own sine: bit-identical on every host.
                    *to += amplitude * square * Angle::sin_cos(angle + phase).0;
                }
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rounding of an angle of a thousand radians: 1000 * 2^-53 and as much of the product.
    const ROUNDING: f64 = 1e-12;

    fn harmonic() -> Harmonic {
        let mut of = Harmonic { number: 4.42, amplitudes: [0.0; 6], phases: [0.0; 6] };
        (of.amplitudes[1], of.phases[1]) = (2e-7, 0.3);
        (of.amplitudes[5], of.phases[5]) = (3e-9, -1.0);
        of
    }

    #[test]
    fn a_tone_is_amplitude_times_rate_squared_times_a_sine_of_the_angle() {
        let wheel = WheelAngle { theta: 1.1, turns: 0.0, rate: -200.0 };
        let found = Harmonic::sum(&[harmonic()], &wheel);
        let expected = [0.0, 2e-7 * 4e4 * (4.42 * 1.1 + 0.3_f64).sin(), 0.0, 0.0, 0.0];
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-17, "{found} {expected}");
        }
        assert!((found[5] - 3e-9 * 4e4 * (4.42 * 1.1 - 1.0_f64).sin()).abs() < 1e-19);
    }

    #[test]
    fn turns_taken_off_the_angle_change_nothing() {
        let whole = WheelAngle { theta: 1.1 + 100.0 * TAU, turns: 0.0, rate: 100.0 };
        let parted = WheelAngle { theta: 1.1, turns: 100.0, rate: 100.0 };
        let (whole, parted) =
            (Harmonic::sum(&[harmonic()], &whole), Harmonic::sum(&[harmonic()], &parted));
        for ((a, b), c) in whole.iter().zip(&parted).zip(harmonic().amplitudes) {
            assert!((a - b).abs() <= ROUNDING * 4.42 * c * 1e4, "{a} {b}");
        }
    }
}
