//! [`Waveform`]: a periodic function made of lines at multiples of one frequency, evaluated in constant time.
//!
//! ```text
//! f(t) = sum_k a_k cos(2 pi k t / T + phi_k)
//! ```
//!
//! Value and first three derivatives are synthesised at M even times of a period T, M a power of two and at
//! least [`SAMPLES_PER_CYCLE`] times the highest k. Between two times the polynomial of degree 7 holds
//! that has all four at both (Hermite). It is three times continuously differentiable, so no step of an
//! integrator needs to end at one of these times, and differs from the sum of a line by at most
//! `(2 pi k / M)^8 / (2^8 8!)` of its amplitude: 1.4e-8 at the highest line, 2^8 times less an octave below.

use std::f64::consts::TAU;

use precess_dynamics::Angle;
use realfft::num_complex::Complex;

use super::fourier::Roots;

/// Times of a period per cycle of the highest line, at least.
pub(super) const SAMPLES_PER_CYCLE: usize = 8;
/// Numbers at each time.
const DERIVATIVES: usize = 4;

/// A line of a spectrum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Cycles in a period, at least 1.
    pub cycles: usize,
    /// Amplitude, in the unit of the function.
    pub amplitude: f64,
    /// rad.
    pub phase: f64,
}

/// A periodic function.
#[derive(Clone, Debug, PartialEq)]
pub struct Waveform {
    /// T, s.
    period: f64,
    /// At each time of a period `f`, `f' s`, `f'' s²/2`, `f''' s³/6`, with s the time between two.
    knots: Vec<[f64; DERIVATIVES]>,
}

/// How many times of a period lines up to some cycles take; none where that does not fit.
pub(super) fn knot_count(cycles: usize) -> Option<usize> {
    cycles.max(1).checked_mul(SAMPLES_PER_CYCLE)?.checked_next_power_of_two()
}

impl Waveform {
    /// From its period, s, and its lines. Lines of one frequency are added.
    ///
    /// Memory: 32 bytes for each of `M` times, and as much while it is made.
    #[must_use]
    pub fn new(period: f64, lines: &[Line]) -> Self {
        let highest = lines.iter().map(|line| line.cycles).max().unwrap_or(1);
        let count = knot_count(highest).unwrap_or(0);
        let roots = Roots::new(count);
        let mut knots = vec![[0.0; DERIVATIVES]; count];
        let mut values = Vec::with_capacity(count);
        for derivative in 0..DERIVATIVES {
            values.clear();
            values.resize(count, Complex::new(0.0, 0.0));
            for line in lines {
                let (sin, cos) = Angle::sin_cos(line.phase);
                let mut coefficient = Complex::new(line.amplitude * cos, line.amplitude * sin);
                // (2 pi i k / M)^n / n! : the time derivative times s^n / n!.
                #[expect(clippy::cast_precision_loss, reason = "fewer cycles than 2^53")]
                let step = TAU * (line.cycles as f64 / count as f64);
                for n in 1..=derivative {
                    #[expect(clippy::cast_precision_loss, reason = "at most 3")]
                    let factor = step / n as f64;
                    coefficient = Complex::new(-coefficient.im * factor, coefficient.re * factor);
                }
                if let Some(to) = values.get_mut(line.cycles) {
                    *to += coefficient;
                }
            }
            roots.synthesise(&mut values);
            for (knot, value) in knots.iter_mut().zip(&values) {
                knot[derivative] = value.re;
            }
        }
        Self { period, knots }
    }

    /// Its value at a time, s.
    #[must_use]
    pub fn at(&self, time: f64) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "fewer samples than 2^53")]
        let count = self.knots.len() as f64;
        let cycles = time / self.period;
        let place = (cycles - cycles.floor()) * count;
        // Rounding may give a whole period: the first time again.
        let floor = place.floor();
        let s = place - floor;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "from 0 to the number of samples, and a cast from floating point saturates"
        )]
        let index = floor as usize;
        let knot = |index: usize| {
            let index = if index >= self.knots.len() { index - self.knots.len() } else { index };
            self.knots.get(index).copied().unwrap_or([0.0; DERIVATIVES])
        };
        hermite(&knot(index), &knot(index + 1), s)
    }

    /// Its period, s.
    #[must_use]
    pub fn period(&self) -> f64 {
        self.period
    }
}

/// The polynomial of degree 7 by Taylor coefficients at both ends of the unit interval:
///
/// ```text
/// sum_n a_n s^n u^4 W_n(s) + sum_n b_n (-u)^n s^4 W_n(u),   u = 1 - s,
/// W_n(s) = sum_(j=0)^(3-n) binomial(3 + j, j) s^j
/// ```
fn hermite(a: &[f64; DERIVATIVES], b: &[f64; DERIVATIVES], s: f64) -> f64 {
    let u = 1.0 - s;
    let side = |of: &[f64; DERIVATIVES], x: f64, signed: f64| {
        let w_2 = 1.0 + 4.0 * x;
        let w_1 = w_2 + 10.0 * x * x;
        let w_0 = w_1 + 20.0 * x * x * x;
        of[0] * w_0 + signed * (of[1] * w_1 + signed * (of[2] * w_2 + signed * of[3]))
    };
    let (s_2, u_2) = (s * s, u * u);
    u_2 * u_2 * side(a, s, s) + s_2 * s_2 * side(b, u, -u)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The bound of the module for the highest line, of amplitude one, and rounding.
    const INTERPOLATION: f64 = 1.5e-8;
    /// The slope, below 90 a second, times a rounding of the time at both sides, 3e-15 s, and rounding.
    const SEAM: f64 = 1e-12;

    fn lines() -> Vec<Line> {
        vec![
            Line { cycles: 1, amplitude: 2.0, phase: 0.4 },
            Line { cycles: 7, amplitude: 0.5, phase: -2.0 },
            // The highest: eight samples a cycle exactly.
            Line { cycles: 32, amplitude: 1.0, phase: 1.0 },
        ]
    }

    fn direct(time: f64) -> f64 {
        let of = |line: &Line| {
            #[expect(clippy::cast_precision_loss, reason = "small")]
            let cycles = line.cycles as f64;
            line.amplitude * (TAU * cycles * time / 2.5 + line.phase).cos()
        };
        lines().iter().map(of).sum()
    }

    #[test]
    fn it_is_the_sum_of_its_lines_to_the_stated_bound() {
        let waveform = Waveform::new(2.5, &lines());
        let mut worst: f64 = 0.0;
        for i in -3000..3000 {
            let time = f64::from(i) * 1.7e-3;
            worst = worst.max((waveform.at(time) - direct(time)).abs());
        }
        println!("worst {worst:e}");
        // And the bound is reached: it says no more than it has to.
        assert!(worst < INTERPOLATION && worst > 0.1 * INTERPOLATION, "{worst:e}");
    }

    #[test]
    fn pieces_join() {
        let waveform = Waveform::new(2.5, &lines());
        let step = 2.5 / 256.0;
        for k in 0..256 {
            let time = step * f64::from(k);
            let (before, after) = (waveform.at(time * (1.0 - 1e-15)), waveform.at(time));
            assert!((before - after).abs() < SEAM, "{time}: {before} {after}");
        }
        assert_eq!(waveform.at(0.0).to_bits(), waveform.at(2.5).to_bits());
        assert_eq!(waveform.at(0.0).to_bits(), waveform.at(-2.5).to_bits());
    }
}
