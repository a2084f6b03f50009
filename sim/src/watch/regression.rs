//! [`Regression`]: least squares of one block: sums over its samples, the estimate with its covariance, and what the block does not
//! determine.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// Directions whose eigenvalue is below this share of the largest, each parameter in its own scale, are not determined.
const DETERMINED: f64 = 1e-9;

/// A parameter of which such a direction has more than this share is not determined.
const SHARE: f64 = 1e-6;

/// Sums over the samples of a block.
#[derive(Clone, Debug)]
pub(super) struct Regression {
    normal: DMatrix<f64>,
    moments: DVector<f64>,
    squares: f64,
    count: usize,
}

/// What a block says.
#[derive(Clone, Debug)]
pub(super) struct Estimated {
    pub(super) values: DVector<f64>,
    /// Of the errors; white noise of the deviation that the residuals have.
    pub(super) covariance: DMatrix<f64>,
    /// Variance of the residuals.
    pub(super) noise: f64,
    determined: Vec<bool>,
}

impl Regression {
    pub(super) fn new(parameters: usize) -> Self {
        Self {
            normal: DMatrix::zeros(parameters, parameters),
            moments: DVector::zeros(parameters),
            squares: 0.0,
            count: 0,
        }
    }

    pub(super) fn clear(&mut self) {
        self.normal.fill(0.0);
        self.moments.fill(0.0);
        (self.squares, self.count) = (0.0, 0);
    }

    /// Takes an observation with the row of its derivatives.
    pub(super) fn add(&mut self, row: &[f64], observed: f64) {
        // The lower triangle: columns from the diagonal down.
        for (column, by) in row.iter().enumerate().filter(|(_, by)| **by != 0.0) {
            let mut of = self.normal.column_mut(column);
            for (to, other) in of.iter_mut().zip(row).skip(column) {
                *to += by * other;
            }
        }
        for (to, by) in self.moments.iter_mut().zip(row) {
            *to += by * observed;
        }
        self.squares += observed * observed;
        self.count += 1;
    }

    /// The estimate; none of fewer observations than twice the parameters.
    pub(super) fn solve(&self) -> Option<Estimated> {
        let count = self.moments.len();
        if self.count < 2 * count {
            return None;
        }
        let normal = self.normal.lower_triangle();
        let normal = &normal + normal.transpose() - DMatrix::from_diagonal(&normal.diagonal());
        // Each parameter in its own scale.
        let scale = normal.diagonal().map(|of| if of > 0.0 { of.sqrt() } else { 1.0 });
        let scaled = DMatrix::from_fn(count, count, |i, j| normal[(i, j)] / (scale[i] * scale[j]));
        let SymmetricEigen { eigenvectors, eigenvalues } =
            SymmetricEigen::try_new(scaled, 1e-15, 1000)?;
        let least = DETERMINED * eigenvalues.max();
        let inverse = eigenvalues.map(|of| if of > least { 1.0 / of } else { 0.0 });
        let kept = inverse.iter().filter(|of| **of > 0.0).count();
        let unit = &eigenvectors * DMatrix::from_diagonal(&inverse) * eigenvectors.transpose();
        let unit = DMatrix::from_fn(count, count, |i, j| unit[(i, j)] / (scale[i] * scale[j]));
        let lost = |parameter: usize| -> f64 {
            let row = eigenvectors.row(parameter);
            let of = row.iter().zip(inverse.iter()).filter(|(_, inverse)| **inverse == 0.0);
            of.map(|(element, _)| element * element).sum()
        };
        let determined = (0..count).map(|parameter| lost(parameter) < SHARE).collect();
        let values = &unit * &self.moments;
        #[expect(clippy::cast_precision_loss, reason = "samples of a block")]
        let freedom = (self.count - kept) as f64;
        let noise = (self.squares - values.dot(&self.moments)).max(0.0) / freedom;
        Some(Estimated { values, covariance: unit * noise, noise, determined })
    }
}

impl Estimated {
    /// A parameter with its variance; none where the block does not determine it.
    pub(super) fn of(&self, parameter: usize) -> Option<[f64; 2]> {
        let determined = self.determined.get(parameter).copied().unwrap_or(false);
        determined.then(|| [self.values[parameter], self.covariance[(parameter, parameter)]])
    }

    /// Amplitude and phase of two parameters, real and imaginary part, with their variances; the phase where the amplitude is five
    /// deviations or more.
    pub(super) fn line(&self, real: usize) -> Option<([f64; 2], Option<[f64; 2]>)> {
        let ([re, a], [im, b]) = (self.of(real)?, self.of(real + 1)?);
        let c = self.covariance[(real + 1, real)];
        // The larger eigenvalue: of a line that noise hides, no direction is its own.
        let largest = f64::midpoint(a, b) + (0.25 * (a - b).powi(2) + c * c).sqrt();
        let square = re * re + im * im;
        if square < 25.0 * largest {
            return Some(([square.sqrt(), largest], None));
        }
        let along = (re * re * a + 2.0 * re * im * c + im * im * b) / square;
        let across = (im * im * a - 2.0 * re * im * c + re * re * b) / square;
        Some(([square.sqrt(), along], Some([libm::atan2(im, re), across / square])))
    }
}
