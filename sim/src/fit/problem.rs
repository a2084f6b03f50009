//! [`Problem`]: weighted least squares of powers by coefficients and modes, by Levenberg and Marquardt's steps.
//!
//! Parameters are the powers of the lines, which are linear, and of each mode the logarithms of frequency and
//! damping ratio, the inertia ratio and the share. Modes are differentiated by central differences. Own code:
//! `levenberg-marquardt` 0.15 needs nalgebra 0.34, a second one here, and gives no covariance.

use nalgebra::{DMatrix, DVector};

use super::modes::{Mode, ModeGuess, amplification};
use super::powers::Power;

/// Steps for given weights.
const STEPS: usize = 60;
/// Converged: the largest step by its standard deviation.
pub(super) const SETTLED: f64 = 1e-4;
/// Damping of Levenberg and Marquardt: first and largest.
const DAMPING: f64 = 1e-3;
const DAMPING_MAX: f64 = 1e12;
/// Steps for differences of the modes' parameters.
pub(super) const DIFFERENCE: f64 = 1e-6;
/// Bounds of a mode's damping ratio and of its inertia ratio.
pub(super) const DAMPING_RATIO: [f64; 2] = [1e-5, 0.7];
const INERTIA_RATIO: [f64; 2] = [0.0, 2.0];

/// Which parameters of a mode are free: names its place.
pub(super) fn free(guess: &ModeGuess) -> [bool; 4] {
    [true, true, guess.fit_ratio, guess.fit_share]
}

/// The free parameters of guesses: logarithms of frequency and damping, ratio, share.
pub(super) fn values(guesses: &[ModeGuess]) -> Vec<f64> {
    let of = |guess: &ModeGuess| {
        let Mode { frequency, damping, inertia_ratio, share } = guess.mode;
        let all = [frequency.ln(), damping.ln(), inertia_ratio, share];
        all.into_iter().zip(free(guess)).filter(|(_, free)| *free).map(|(value, _)| value)
    };
    guesses.iter().flat_map(of).collect()
}

/// The modes with free parameters of some values.
pub(super) fn modes(guesses: &[ModeGuess], values: &[f64]) -> Vec<Mode> {
    let mut values = values.iter();
    let mut next =
        |free: bool, or: f64| if free { values.next().copied().unwrap_or(or) } else { or };
    let of = |guess: &ModeGuess| {
        let [a, b, c, d] = free(guess);
        Mode {
            frequency: next(a, guess.mode.frequency.ln()).exp(),
            damping: next(b, guess.mode.damping.ln()).exp(),
            inertia_ratio: next(c, guess.mode.inertia_ratio),
            share: next(d, guess.mode.share),
        }
    };
    guesses.iter().map(of).collect()
}

/// One problem of least squares.
pub(super) struct Problem<'a> {
    pub(super) points: &'a [Power],
    pub(super) guesses: &'a [ModeGuess],
    /// Column of the power of each point, and how many there are.
    pub(super) columns: Vec<usize>,
    pub(super) count: usize,
}

impl Problem<'_> {
    /// `Omega⁴ |H|²` of each point.
    pub(super) fn gains(&self, modes: &[Mode]) -> Vec<f64> {
        let of = |point: &Power| {
            let square = point.spin * point.spin;
            square * square * amplification(modes, point.frequency, point.spin).norm_sqr()
        };
        self.points.iter().map(of).collect()
    }

    pub(super) fn model(&self, parameters: &DVector<f64>, gains: &[f64]) -> Vec<f64> {
        self.columns.iter().zip(gains).map(|(column, gain)| parameters[*column] * gain).collect()
    }

    pub(super) fn modes(&self, parameters: &DVector<f64>) -> Vec<Mode> {
        let values: Vec<f64> = parameters.iter().skip(self.count).copied().collect();
        modes(self.guesses, &values)
    }

    /// Powers for given modes and weights: linear.
    pub(super) fn powers(&self, parameters: &mut DVector<f64>, weights: &[f64]) {
        let gains = self.gains(&self.modes(parameters));
        let mut sums = vec![[0.0; 2]; self.count];
        for (((point, column), gain), weight) in
            self.points.iter().zip(&self.columns).zip(&gains).zip(weights)
        {
            sums[*column][0] += weight * gain * gain;
            sums[*column][1] += weight * gain * point.power;
        }
        for (column, [normal, right]) in sums.into_iter().enumerate() {
            if normal > 0.0 {
                parameters[column] = right / normal;
            }
        }
    }

    pub(super) fn squares(&self, parameters: &DVector<f64>, weights: &[f64]) -> f64 {
        let gains = self.gains(&self.modes(parameters));
        let model = self.model(parameters, &gains);
        let each = self.points.iter().zip(&model).zip(weights);
        each.map(|((point, m), w)| w * (point.power - m) * (point.power - m)).sum()
    }

    /// Normal matrix and gradient.
    pub(super) fn normal(
        &self,
        parameters: &DVector<f64>,
        weights: &[f64],
    ) -> (DMatrix<f64>, DVector<f64>) {
        let size = parameters.len();
        let gains = self.gains(&self.modes(parameters));
        let slopes: Vec<Vec<f64>> = (self.count..size)
            .map(|k| {
                let at = |step: f64| {
                    let mut moved = parameters.clone();
                    moved[k] += step;
                    self.gains(&self.modes(&moved))
                };
                let (above, below) = (at(DIFFERENCE), at(-DIFFERENCE));
                above.iter().zip(&below).map(|(a, b)| (a - b) / (2.0 * DIFFERENCE)).collect()
            })
            .collect();
        let mut normal = DMatrix::zeros(size, size);
        let mut right = DVector::zeros(size);
        for (index, (point, column)) in self.points.iter().zip(&self.columns).enumerate() {
            let power = parameters[*column];
            let (gain, weight) = (gains[index], weights[index]);
            let residual = point.power - power * gain;
            let mut row = Vec::with_capacity(1 + slopes.len());
            row.push((*column, gain));
            row.extend(slopes.iter().enumerate().map(|(k, s)| (self.count + k, power * s[index])));
            for (i, a) in &row {
                right[*i] += weight * a * residual;
                for (j, b) in &row {
                    normal[(*i, *j)] += weight * a * b;
                }
            }
        }
        (normal, right)
    }

    /// `1 / var` by a model.
    pub(super) fn weights(&self, model: &[f64]) -> Vec<f64> {
        self.points.iter().zip(model).map(|(point, m)| 1.0 / point.variance(*m)).collect()
    }

    /// Keeps modes physical.
    fn confine(&self, parameters: &mut DVector<f64>) {
        let mut k = self.count;
        for guess in self.guesses {
            for (place, is_free) in free(guess).into_iter().enumerate() {
                if !is_free {
                    continue;
                }
                let [low, high] = match place {
                    0 => [f64::NEG_INFINITY, f64::INFINITY],
                    1 => DAMPING_RATIO.map(f64::ln),
                    2 => INERTIA_RATIO,
                    _ => [-10.0, 10.0],
                };
                parameters[k] = parameters[k].clamp(low, high);
                k += 1;
            }
        }
    }

    /// Levenberg and Marquardt's steps for given weights; the parameters at the least sum of squares.
    pub(super) fn minimise(&self, start: DVector<f64>, weights: &[f64]) -> DVector<f64> {
        let mut parameters = start;
        let mut squares = self.squares(&parameters, weights);
        let mut damping = DAMPING;
        for _ in 0..STEPS {
            let (normal, right) = self.normal(&parameters, weights);
            let mut settled = true;
            loop {
                let mut damped = normal.clone();
                for k in 0..damped.nrows() {
                    damped[(k, k)] *= 1.0 + damping;
                }
                let step = equilibrated(&damped).map(|inverse| inverse * &right);
                if let Some(step) = step {
                    let mut next = &parameters + &step;
                    self.confine(&mut next);
                    let found = self.squares(&next, weights);
                    if found <= squares {
                        let size = (0..next.len())
                            .map(|k| (next[k] - parameters[k]).abs() * normal[(k, k)].sqrt());
                        settled = size.fold(0.0, f64::max) < SETTLED;
                        (parameters, squares) = (next, found);
                        damping = (damping * 0.1).max(1e-12);
                        break;
                    }
                }
                damping *= 10.0;
                if damping > DAMPING_MAX {
                    break;
                }
            }
            if settled {
                break;
            }
        }
        parameters
    }
}

/// The inverse of a positive matrix whose rows are of different sizes; none of a singular one.
pub(super) fn equilibrated(matrix: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let scale: Vec<f64> = (0..matrix.nrows()).map(|k| 1.0 / matrix[(k, k)].sqrt()).collect();
    if scale.iter().any(|s| !s.is_finite()) {
        return None;
    }
    let scaled = |m: &DMatrix<f64>| {
        DMatrix::from_fn(m.nrows(), m.ncols(), |i, j| m[(i, j)] * scale[i] * scale[j])
    };
    let inverse = scaled(matrix).cholesky()?.inverse();
    Some(scaled(&inverse))
}
