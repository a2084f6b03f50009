//! [`Recursion`]: least squares with exponential forgetting, a sample at a time, in the form of the information matrix.
//!
//! After k samples the N parameters x minimise `sum_i w^(k - i) (y_i - phi_i . x)^2` with the forgetting factor w. Kept are
//! `R = sum w^(k - i) phi phi^T` and `Q = sum w^(2 (k - i)) phi phi^T`: of white noise of variance s² the covariance of x is
//! `s² R^-1 Q R^-1`, whatever the regressors were. Where R is singular, x stays and what the samples say of it is kept until
//! others determine it; R decays and cannot grow, as the covariance of the usual form does without excitation (wind-up).
//!
//! Ljung and Söderström, *Theory and Practice of Recursive Identification*, MIT Press 1983, section 2.6.

use crate::error::{self, TrackerError};

/// A pivot is that of a parameter where it is above this share of the diagonal elements of its unit: of less than that,
/// rounding decides.
const DETERMINED: f64 = 1e-9;

/// The least and the largest memory, samples.
const MEMORY: (f64, f64) = (8.0, 1e9);

/// Sums over the samples so far, newest at full weight.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub(crate) struct Recursion<const N: usize> {
    /// The weight of a sample by that of the next one.
    forgetting: f64,
    /// Sum of the weights.
    weight: f64,
    /// Weighted sum of squares of the residuals of `parameters`.
    squares: f64,
    parameters: [f64; N],
    /// Weighted sum of `phi` times the residual: zero wherever the parameters are determined.
    pending: [f64; N],
    /// R; the lower triangle.
    information: [[f64; N]; N],
    /// Q; the lower triangle.
    squared: [[f64; N]; N],
}

/// Parameters, and how well they are known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Estimated<const N: usize> {
    pub(crate) parameters: [f64; N],
    /// Of their errors, where the noise is white.
    pub(crate) covariance: [[f64; N]; N],
    /// Variance of the noise, from the residuals.
    pub(crate) noise: f64,
}

/// L below the diagonal and D on it, of a symmetric matrix `L D L^T`.
struct Factors<const N: usize>([[f64; N]; N]);

impl<const N: usize> Recursion<N> {
    /// Before the first sample, with a memory of so many samples: `w = 1 - 1 / memory`.
    pub(crate) fn new(memory: f64) -> Result<Self, TrackerError> {
        error::within("memory in samples", memory, MEMORY)?;
        Ok(Self {
            forgetting: 1.0 - 1.0 / memory,
            weight: 0.0,
            squares: 0.0,
            parameters: [0.0; N],
            pending: [0.0; N],
            information: [[0.0; N]; N],
            squared: [[0.0; N]; N],
        })
    }

    /// Takes an observation `y = phi . x`.
    pub(crate) fn update(&mut self, phi: &[f64; N], y: f64) {
        let residual = y - dot(phi, &self.parameters);
        let forgetting = self.forgetting;
        self.weight = forgetting * self.weight + 1.0;
        self.squares = forgetting * self.squares + residual * residual;
        for (pending, phi) in self.pending.iter_mut().zip(phi) {
            *pending = forgetting * *pending + phi * residual;
        }
        add_product(&mut self.information, forgetting, phi);
        add_product(&mut self.squared, forgetting * forgetting, phi);
        let Some(factors) = self.factors() else { return };
        let change = factors.solve(&self.pending);
        self.squares = (self.squares - dot(&change, &self.pending)).max(0.0);
        self.pending = [0.0; N];
        for (parameter, change) in self.parameters.iter_mut().zip(change) {
            *parameter += change;
        }
    }

    /// Of R; none where it is singular. The parameters after the first are of one unit.
    fn factors(&self) -> Option<Factors<N>> {
        let diagonal = || self.information.iter().enumerate().filter_map(|(i, row)| row.get(i));
        let others: f64 = diagonal().skip(1).sum();
        let mut units = [others; N];
        if let (Some(unit), Some(element)) = (units.first_mut(), diagonal().next()) {
            *unit = *element;
        }
        Factors::of(&self.information, &units)
    }

    /// Whether the parameters are those of the samples.
    fn is_determined(&self) -> bool {
        self.pending.iter().all(|pending| *pending == 0.0)
    }

    /// The parameters; none where the samples do not determine them, or leave nothing to know the noise by.
    pub(crate) fn estimate(&self) -> Option<Estimated<N>> {
        let factors = self.factors().filter(|_| self.is_determined())?;
        let squared = symmetric(&self.squared);
        // R^-1 Q, then R^-1 (R^-1 Q)^T.
        let half = transposed(&squared.map(|column| factors.solve(&column)));
        let spent: f64 = half.iter().zip(0..N).filter_map(|(row, of)| row.get(of)).sum();
        let unit = half.map(|row| factors.solve(&row));
        let freedom = self.weight - spent;
        if freedom <= DETERMINED * self.weight {
            return None;
        }
        let noise = self.squares / freedom;
        let covariance = unit.map(|row| row.map(|element| element * noise));
        Some(Estimated { parameters: self.parameters, covariance, noise })
    }
}

impl Recursion<2> {
    /// The first parameter becomes `x0 + by - slope x1`, as the state of a system does from one sample to the next.
    pub(crate) fn advance(&mut self, by: f64, slope: f64) {
        let [first, second] = &mut self.parameters;
        *first += by - slope * *second;
        let [start, end] = &mut self.pending;
        *end += slope * *start;
        for [[m11, _], [m21, m22]] in [&mut self.information, &mut self.squared] {
            *m22 += slope * (2.0 * *m21 + slope * *m11);
            *m21 += slope * *m11;
        }
    }
}

impl<const N: usize> Factors<N> {
    /// Of a lower triangle; none where a pivot is only rounding.
    #[expect(clippy::needless_range_loop, reason = "elements of a triangle")]
    fn of(of: &[[f64; N]; N], units: &[f64; N]) -> Option<Self> {
        let mut l = [[0.0; N]; N];
        for j in 0..N {
            let mut pivot = of[j][j];
            for k in 0..j {
                pivot -= l[j][k] * l[j][k] * l[k][k];
            }
            let determined = pivot > DETERMINED * units[j];
            if !determined {
                return None;
            }
            l[j][j] = pivot;
            for i in j + 1..N {
                let mut element = of[i][j];
                for k in 0..j {
                    element -= l[i][k] * l[j][k] * l[k][k];
                }
                l[i][j] = element / pivot;
            }
        }
        Some(Self(l))
    }

    /// The solution of `L D L^T x = b`.
    fn solve(&self, b: &[f64; N]) -> [f64; N] {
        let Self(l) = self;
        let mut x = *b;
        for i in 0..N {
            for k in 0..i {
                x[i] -= l[i][k] * x[k];
            }
        }
        for i in (0..N).rev() {
            x[i] /= l[i][i];
            for k in i + 1..N {
                x[i] -= l[k][i] * x[k];
            }
        }
        x
    }
}

fn dot<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The lower triangle of `by matrix + phi phi^T`.
fn add_product<const N: usize>(matrix: &mut [[f64; N]; N], by: f64, phi: &[f64; N]) {
    for (index, (row, of_row)) in matrix.iter_mut().zip(phi).enumerate() {
        for (element, of_column) in row.iter_mut().zip(phi).take(index + 1) {
            *element = by * *element + of_row * of_column;
        }
    }
}

/// The whole of a lower triangle.
fn symmetric<const N: usize>(lower: &[[f64; N]; N]) -> [[f64; N]; N] {
    let mut whole = *lower;
    for i in 0..N {
        for j in 0..i {
            whole[j][i] = lower[i][j];
        }
    }
    whole
}

fn transposed<const N: usize>(of: &[[f64; N]; N]) -> [[f64; N]; N] {
    let mut to = *of;
    for i in 0..N {
        for j in 0..N {
            to[j][i] = of[i][j];
        }
    }
    to
}
