//! [`HeldPlant`]: steps of `x' = A x + B u` with u held, for any number of times, `A` balanced and its powers computed once.
//!
//! ```text
//! Phi = e^(A t) = 1 + E      Gamma = int_0^t e^(A s) ds B
//! h = t 2^-n, the norm of A h at most a quarter:
//! V = sum over k of (A h)^k / (k + 1)!      E = A h V      Gamma = h V B
//! n times:      Gamma <- 2 Gamma + E Gamma      E <- 2 E + E²
//! ```
//!
//! Higham, *Functions of Matrices*, 10.3 (scaling and squaring) and 10.4 (of `e^A - 1`). That of an oscillator has the norm w² as it is stated, and w
//! balanced: half of the squarings.

use nalgebra::linalg::balancing::balance_parlett_reinsch;
use nalgebra::{DMatrix, DVector};

/// Powers of `A` in one block of the series.
const BLOCK: usize = 4;
/// Coefficients of the series, `1 / (k + 1)!`: the next term is below `4^-16 / 17!`, 1e-24.
const TERMS: usize = 16;
/// The largest norm of `A h`.
const NORM_MAX: f64 = 0.25;
/// Squares of larger elements are not finite.
const BALANCED_MAX: f64 = 1e150;

/// A plant whose input is held.
#[derive(Clone, Debug, PartialEq)]
pub struct HeldPlant {
    /// `A` balanced, its square, its third and its fourth power.
    powers: [DMatrix<f64>; BLOCK],
    /// `B` of the balanced states.
    b: DMatrix<f64>,
    /// A state by a balanced one: powers of two.
    scale: DVector<f64>,
    /// The largest sum of magnitudes of a row.
    norm: f64,
}

impl HeldPlant {
    /// Of a square matrix `A` and of a `B` with as many rows.
    #[must_use]
    pub fn new(a: &DMatrix<f64>, b: &DMatrix<f64>) -> Self {
        let (first, scale) = balanced(a);
        let mut b = b.clone();
        for (mut row, factor) in b.row_iter_mut().zip(scale.iter()) {
            row /= *factor;
        }
        let norm = first.row_iter().map(|row| row.lp_norm(1)).fold(0.0, libm::fmax);
        let second = &first * &first;
        let (third, fourth) = (&second * &first, &second * &second);
        Self { powers: [first, second, third, fourth], b, scale, norm }
    }

    /// `Phi` and `Gamma` of a time, s.
    #[must_use]
    pub fn step(&self, time: f64) -> [DMatrix<f64>; 2] {
        let (n, mut h, mut squarings) = (self.b.nrows(), time, 0_u32);
        while self.norm * h > NORM_MAX && squarings < 1100 {
            h *= 0.5;
            squarings += 1;
        }
        let average = self.average(h);
        let [first, ..] = &self.powers;
        let mut gamma = &average * &self.b * h;
        let mut change = first * average * h;
        for _ in 0..squarings {
            let grown = &gamma + &change * &gamma;
            gamma += grown;
            change = &change * &change + &change * 2.0;
        }
        for k in 0..n {
            change[(k, k)] += 1.0;
        }
        for (k, factor) in self.scale.iter().enumerate() {
            gamma.row_mut(k).scale_mut(*factor);
            change.row_mut(k).scale_mut(*factor);
            change.column_mut(k).scale_mut(factor.recip());
        }
        [change, gamma]
    }

    /// `V`, in blocks of four terms (Paterson and Stockmeyer 1973).
    fn average(&self, h: f64) -> DMatrix<f64> {
        let n = self.b.nrows();
        let mut coefficients = [1.0; TERMS];
        let (mut factorial, mut power, mut number) = (1.0, 1.0, 1.0);
        for coefficient in &mut coefficients {
            factorial *= number;
            *coefficient = power / factorial;
            power *= h;
            number += 1.0;
        }
        let [first, second, third, fourth] = &self.powers;
        let mut sum = DMatrix::zeros(n, n);
        for block in coefficients.rchunks(BLOCK) {
            let &[zeroth, one, two, three] = block else { continue };
            sum = fourth * sum;
            sum.zip_zip_apply(first, second, |to, a, b| *to += one * a + two * b);
            sum.zip_apply(third, |to, c| *to += three * c);
            for k in 0..n {
                sum[(k, k)] += zeroth;
            }
        }
        sum
    }
}

/// `e^(A t)` and `int_0^t e^(A s) ds B`: what a state and an input that is held give after the time t. As many rows of `B` as of
/// the square matrix `A`.
#[must_use]
pub fn held_step(a: &DMatrix<f64>, b: &DMatrix<f64>, t: f64) -> (DMatrix<f64>, DMatrix<f64>) {
    let [phi, gamma] = HeldPlant::new(a, b).step(t);
    (phi, gamma)
}

/// A balanced matrix, and its states by those of the balanced one: `A = D A_b D^-1`, powers of two.
pub(super) fn balanced(a: &DMatrix<f64>) -> (DMatrix<f64>, DVector<f64>) {
    let mut balanced = a.clone();
    let scale = if !a.is_empty() && a.amax() < BALANCED_MAX {
        balance_parlett_reinsch(&mut balanced)
    } else {
        DVector::from_element(a.nrows(), 1.0)
    };
    (balanced, scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A few operations beside ten squarings.
    const ROUNDING: f64 = 1e-13;

    /// Oscillators of 1 to 1000 rad/s, damped, with an input each, beside a double integrator: closed forms.
    #[test]
    fn steps_of_oscillators_have_their_closed_forms() {
        const ZETA: f64 = 0.01;
        let speeds = [1.0, 20.0, 300.0, 1000.0];
        let (mut a, mut b) = (DMatrix::zeros(10, 10), DMatrix::zeros(10, 5));
        for (k, w) in speeds.iter().enumerate() {
            (a[(k, 5 + k)], a[(5 + k, k)], a[(5 + k, 5 + k)]) = (1.0, -w * w, -2.0 * ZETA * w);
            b[(5 + k, k)] = 1e-3;
        }
        (a[(4, 9)], b[(9, 4)]) = (1.0, 1e6);
        let held = HeldPlant::new(&a, &b);
        for t in [0.0, 1e-3, 0.1, 0.7] {
            let [phi, gamma] = held.step(t);
            for (k, w) in speeds.iter().enumerate() {
                let (damped, decay) = (w * libm::sqrt(1.0 - ZETA * ZETA), libm::exp(-ZETA * w * t));
                let (sin, cos) = libm::sincos(damped * t);
                let place = decay * (cos + ZETA * w / damped * sin);
                let by_rate = decay * sin / damped;
                let rate = decay * (cos - ZETA * w / damped * sin);
                let by_force = 1e-3 * (1.0 - place) / (w * w);
                // The phase w t is known to w t times the rounding of t.
                let bound = ROUNDING * (1.0 + w * t);
                for (found, expected, size) in [
                    (phi[(k, k)], place, 1.0),
                    (phi[(k, 5 + k)], by_rate, 1.0 / w),
                    (phi[(5 + k, k)], -w * w * by_rate, *w),
                    (phi[(5 + k, 5 + k)], rate, 1.0),
                    (gamma[(k, k)], by_force, 1e-3 / (w * w)),
                    (gamma[(5 + k, k)], 1e-3 * by_rate, 1e-3 / w),
                ] {
                    let apart = libm::fabs(found - expected) / size;
                    assert!(apart < bound, "{w} {t}: {found} {expected}: {apart:e}");
                }
            }
            assert!(libm::fabs(phi[(4, 9)] - t) <= ROUNDING * t);
            assert!(libm::fabs(gamma[(4, 4)] - 0.5e6 * t * t) <= 0.5e6 * t * t * ROUNDING);
            assert!(libm::fabs(gamma[(9, 4)] - 1e6 * t) <= 1e6 * t * ROUNDING);
        }
    }

    /// The norm of balancing would not be finite.
    #[test]
    fn elements_that_have_no_square_are_not_balanced() {
        let mut a = DMatrix::zeros(2, 2);
        (a[(0, 1)], a[(1, 0)]) = (1e200, 1.0);
        assert_eq!(balanced(&a), (a, DVector::from_element(2, 1.0)));
    }
}
