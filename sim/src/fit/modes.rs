//! [`Mode`]: an internal mode of a wheel, and how it amplifies what acts on the rotor.
//!
//! A rotor of mass m on a bearing of stiffness k and damping c turns the force f on it into the force on a
//! rigid table `(k + i w c) / (k - m w² + i w c) f`. In tilting, a rotor with moments of inertia `I_s` about
//! the axis and `I_r` across it has, in `theta = theta_y + i theta_z`,
//!
//! ```text
//! I_r theta'' - i I_s Omega theta' + c theta' + k theta = M_y + i M_z
//! H(w) = (w_0² + 2 i zeta w_0 w) / (w_0² - w² + g Omega w + 2 i zeta w_0 w)
//!
//! w_0² = k / I_r     2 zeta w_0 = c / I_r     g = I_s / I_r; 0 for modes that do not tilt
//! ```
//!
//! for what turns as `exp(i w t)`: w above zero turns about +x, below zero against it. Without damping it
//! peaks at `w = g Omega / 2 ± sqrt((g Omega / 2)² + w_0²)`, the two whirls. Several modes of one group, and
//! a mode that carries only a share `p` of what acts, give `H = 1 + sum_m p_m (H_m - 1)`.
//!
//! The filtered harmonics are those of Masterson, Miller and Grogan (J. Sound Vib. 249(3), 2002), whose
//! structural model and that of RWDMES have these gyroscopic terms.

use nalgebra::Complex;

use super::measurement::Group;

/// An internal mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode {
    /// `w_0`, natural angular frequency at rest, rad/s.
    pub frequency: f64,
    /// `zeta`, damping ratio.
    pub damping: f64,
    /// `g = I_s / I_r`; 0 for a mode that does not tilt.
    pub inertia_ratio: f64,
    /// `p`, the share of what acts that it carries.
    pub share: f64,
}

impl Mode {
    /// `H(w)` at a spin rate, both rad/s with sign.
    #[must_use]
    pub fn amplification(&self, w: f64, spin: f64) -> Complex<f64> {
        let square = self.frequency * self.frequency;
        let loss = 2.0 * self.damping * self.frequency * w;
        let over = Complex::new(square, loss);
        let under = Complex::new(square - w * w + self.inertia_ratio * spin * w, loss);
        let own = over / under;
        Complex::new(1.0, 0.0) + (own - 1.0) * self.share
    }

    /// Backward and forward whirl at a spin rate without damping, rad/s: `g Omega / 2 ∓ sqrt(..)`, the first
    /// below zero.
    #[must_use]
    pub fn whirls(&self, spin: f64) -> [f64; 2] {
        let half = 0.5 * self.inertia_ratio * spin;
        let root = half.hypot(self.frequency);
        [half - root, half + root]
    }
}

/// `H(w)` of all modes of a group.
#[must_use]
pub fn amplification(modes: &[Mode], w: f64, spin: f64) -> Complex<f64> {
    let one = Complex::new(1.0, 0.0);
    modes.iter().fold(one, |sum, mode| sum + mode.amplification(w, spin) - one)
}

/// A mode that is looked for: first guesses, and what is not fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModeGuess {
    /// Which forces or moments it amplifies.
    pub group: Group,
    /// First guess.
    pub mode: Mode,
    /// Whether `inertia_ratio` is fitted; it is known from the inertias of a rotor.
    pub fit_ratio: bool,
    /// Whether `share` is fitted; a rotor on its bearings has 1.
    pub fit_share: bool,
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix2, Vector2};

    use super::*;

    /// Rounding of a solution of two complex equations.
    const ROUNDING: f64 = 1e-12;

    #[test]
    fn a_tilting_rotor_follows_euler_in_two_real_coordinates() {
        // I_r, I_s, k, c in SI, written without complex coordinates: H_y = I_r y' + I_s Omega z.
        let (i_r, i_s, k, c) = (0.01, 0.017, 3000.0, 0.11);
        let w0 = f64::sqrt(k / i_r);
        let mode = Mode {
            frequency: w0,
            damping: c / (2.0 * i_r * w0),
            inertia_ratio: i_s / i_r,
            share: 1.0,
        };
        for (w, spin) in [(500.0, 300.0), (-260.0, 300.0), (900.0, -200.0), (40.0, 0.0)] {
            let number = |re: f64, im: f64| Complex::new(re, im);
            let own = number(k - i_r * w * w, w * c);
            let cross = number(0.0, i_s * spin * w);
            let matrix = Matrix2::new(own, cross, -cross, own);
            // A moment that turns about +x at w: M_y = 1, M_z = -i.
            let acting = Vector2::new(number(1.0, 0.0), number(0.0, -1.0));
            let tilt = matrix.try_inverse().expect("damped") * acting;
            let on_table = tilt * number(k, w * c);
            let error = on_table - acting * mode.amplification(w, spin);
            assert!(error.norm() < ROUNDING * on_table.norm(), "{w}, {spin}: {error}");
        }
    }

    #[test]
    fn the_peaks_are_the_whirls() {
        let mode = Mode { frequency: 440.0, damping: 0.0, inertia_ratio: 1.8, share: 1.0 };
        for spin in [0.0, 120.0, -310.0] {
            for w in mode.whirls(spin) {
                assert!(mode.amplification(w * (1.0 + 1e-9), spin).norm() > 1e6);
            }
        }
    }
}
