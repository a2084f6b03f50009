//! [`Regression`]: least squares of one block: sums over its samples, the estimate with its covariance, and what the block does not
//! determine.

use nalgebra::{Complex, DMatrix, DVector, SymmetricEigen};

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

/// What one sensor says of parameters that others depend on, too.
#[derive(Clone, Debug)]
pub(super) struct Reduced {
    /// The first of them in the larger regression.
    from: usize,
    /// Inverse of their covariance, and that times their values.
    information: DMatrix<f64>,
    vector: DVector<f64>,
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
        if self.count < 2 * self.moments.len() {
            return None;
        }
        let Inverse { unit, determined, kept } = inverse(&self.whole())?;
        let values = &unit * &self.moments;
        #[expect(clippy::cast_precision_loss, reason = "samples of a block")]
        let freedom = (self.count - kept) as f64;
        let noise = (self.squares - values.dot(&self.moments)).max(0.0) / freedom;
        Some(Estimated { values, covariance: unit * noise, noise, determined })
    }

    /// The same with what other sensors say of its last parameters, some of its parameters being zero; the noise is that of its own residuals.
    pub(super) fn solve_with(&self, others: &[Reduced], zero: &[usize]) -> Option<Estimated> {
        let without = |(mut normal, mut moments): (DMatrix<f64>, DVector<f64>)| {
            for parameter in zero {
                normal.row_mut(*parameter).fill(0.0);
                normal.column_mut(*parameter).fill(0.0);
                moments[*parameter] = 0.0;
            }
            (normal, moments)
        };
        let (normal, moments) = without((self.normal.clone(), self.moments.clone()));
        let own = Self { normal, moments, ..*self }.solve()?;
        if others.is_empty() || own.noise <= 0.0 {
            return Some(own);
        }
        let (normal, moments) = without(self.with(others, own.noise));
        let Inverse { unit, determined, .. } = inverse(&normal)?;
        let values = &unit * moments;
        Some(Estimated { values, covariance: unit * own.noise, noise: own.noise, determined })
    }

    /// Square of the correlation of two lines, each of a real and an imaginary part, the second after the first, with what other sensors say of
    /// them: one where no sensor sees a difference. None where one is not seen at all.
    pub(super) fn common(&self, first: usize, others: &[Reduced]) -> Option<f64> {
        let noise = self.solve()?.noise;
        let (normal, _) = self.with(others, noise);
        let square = |row: usize, column: usize| normal.view((row, column), (2, 2)).norm_squared();
        let own = square(first, first) * square(first + 2, first + 2);
        (own > 0.0).then(|| square(first + 2, first) / own.sqrt())
    }

    /// Normal equations with what other sensors say of the last parameters, where this one's residuals have this noise.
    fn with(&self, others: &[Reduced], noise: f64) -> (DMatrix<f64>, DVector<f64>) {
        let (mut normal, mut moments) = (self.whole(), self.moments.clone());
        for Reduced { from, information, vector } in others {
            let count = vector.len();
            let mut of = normal.view_mut((*from, *from), (count, count));
            of += information * noise;
            let mut of = moments.rows_mut(*from, count);
            of += vector * noise;
        }
        (normal, moments)
    }

    /// Of the first parameters only, as if the others were zero.
    pub(super) fn leading(&self, count: usize) -> Self {
        Self {
            normal: self.normal.view((0, 0), (count, count)).into_owned(),
            moments: self.moments.rows(0, count).into_owned(),
            ..*self
        }
    }

    /// What it says of its parameters from `own` on, by the noise of its residuals, the first ones eliminated: they are those of a larger
    /// regression from `from` on.
    pub(super) fn reduced(&self, own: usize, from: usize) -> Option<Reduced> {
        let noise = self.solve()?.noise;
        let rest = self.moments.len().checked_sub(own)?;
        if noise <= 0.0 || rest == 0 {
            return None;
        }
        let whole = self.whole();
        let first = inverse(&whole.view((0, 0), (own, own)).into_owned())?.unit;
        let cross = whole.view((own, 0), (rest, own));
        let information = whole.view((own, own), (rest, rest)) - cross * &first * cross.transpose();
        let vector = self.moments.rows(own, rest) - cross * first * self.moments.rows(0, own);
        Some(Reduced { from, information: information / noise, vector: vector / noise })
    }

    /// Both triangles.
    fn whole(&self) -> DMatrix<f64> {
        let normal = self.normal.lower_triangle();
        &normal + normal.transpose() - DMatrix::from_diagonal(&normal.diagonal())
    }
}

/// The inverse of normal equations where they determine something.
struct Inverse {
    unit: DMatrix<f64>,
    determined: Vec<bool>,
    /// How many directions are determined.
    kept: usize,
}

fn inverse(normal: &DMatrix<f64>) -> Option<Inverse> {
    let count = normal.nrows();
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
    Some(Inverse { unit, determined, kept })
}

impl Estimated {
    /// A parameter with its variance; none where the block does not determine it.
    pub(super) fn of(&self, parameter: usize) -> Option<[f64; 2]> {
        let determined = self.determined.get(parameter).copied().unwrap_or(false);
        determined.then(|| [self.values[parameter], self.covariance[(parameter, parameter)]])
    }

    /// A line by two parameters, its real and its imaginary part.
    pub(super) fn line(&self, real: usize) -> Option<LineEstimate> {
        let ([re, a], [im, b]) = (self.of(real)?, self.of(real + 1)?);
        let c = self.covariance[(real + 1, real)];
        Some(LineEstimate { value: Complex::new(re, im), covariance: [a, b, c] })
    }
}

/// A line, with the variances of its real and its imaginary part and their covariance.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct LineEstimate {
    pub(super) value: Complex<f64>,
    pub(super) covariance: [f64; 3],
}

impl LineEstimate {
    /// The larger eigenvalue of its covariance.
    pub(super) fn largest(&self) -> f64 {
        let [a, b, c] = self.covariance;
        f64::midpoint(a, b) + (0.25 * (a - b).powi(2) + c * c).sqrt()
    }

    /// Variance across a direction.
    pub(super) fn across(&self, direction: Complex<f64>) -> f64 {
        let (re, im) = (direction.re, direction.im);
        let [a, b, c] = self.covariance;
        (im * im * a - 2.0 * re * im * c + re * re * b) / direction.norm_sqr()
    }

    /// Amplitude with its variance, that along the line. Of a line that noise hides no direction is its own.
    pub(super) fn amplitude(&self) -> [f64; 2] {
        let (square, largest) = (self.value.norm_sqr(), self.largest());
        let along = || self.across(self.value * Complex::i());
        [square.sqrt(), if square < 25.0 * largest { largest } else { along() }]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of two sensors of different noise, each with a start of its own and one slope in common, the estimate is that of weighted least squares.
    #[test]
    fn what_another_sensor_says_counts_by_its_noise() {
        let (mut first, mut second) = (Regression::new(2), Regression::new(2));
        for k in 0..20_u32 {
            let (time, sign) = (f64::from(k), if k % 2 == 0 { 1.0 } else { -1.0 });
            first.add(&[1.0, time], 3.0 + 0.5 * time + 0.1 * sign);
            second.add(&[1.0, time], -7.0 + 0.51 * time + 0.001 * sign);
        }
        let [alone, other] = [&first, &second].map(|of| of.solve().expect("estimates"));
        let reduced = second.reduced(1, 1).expect("a slope");
        let both = first.solve_with(&[reduced], &[]).expect("estimates");
        let [(a, b), (_, d), (_, f)] = [&alone, &other, &both].map(|of| {
            let [value, variance] = of.of(1).expect("a slope");
            (value, variance)
        });
        let slope = other.of(1).expect("a slope")[0];
        let expected = (a / b + slope / d) / (1.0 / b + 1.0 / d);
        let found = both.of(1).expect("a slope")[0];
        assert!((found - expected).abs() < 1e-9, "{found} {expected}");
        assert!((f * (1.0 / b + 1.0 / d) - 1.0).abs() < 1e-9, "{f}");
        // The first one's start is that of its readings with this slope: 3 and half a tenth's mean, less 9.5 times what the slope differs by.
        let start = both.of(0).expect("a start")[0];
        let own = alone.of(0).expect("a start")[0];
        assert!((start - (own - 9.5 * (found - a))).abs() < 1e-9, "{start}");
    }

    /// Two lines that are one in a sensor are told apart by another that has only the second; of the first sensor by itself only that is
    /// estimated which is not zero.
    #[test]
    fn lines_that_one_sensor_confuses_are_told_apart_by_another() {
        let (mut hub, mut gimbal) = (Regression::new(5), Regression::new(5));
        for k in 0..40_u32 {
            let (sine, cosine) = (libm::sin(f64::from(k)), libm::cos(f64::from(k)));
            let sign = if k % 2 == 0 { 1e-3 } else { -1e-3 };
            let [a, b, c, d] = [cosine, -sine, 0.5 * cosine, -0.5 * sine];
            hub.add(&[1.0, a, b, c, d], 7.0 + 2.0 * a + 4.0 * c + sign);
            gimbal.add(&[1.0, 0.0, 0.0, cosine, -sine], 4.0 * cosine + sign);
        }
        let reduced = [gimbal.reduced(1, 1).expect("a line")];
        let [own, both] =
            [hub.common(1, &[]), hub.common(1, &reduced)].map(|of| of.expect("lines"));
        assert!((own - 1.0).abs() < 1e-12 && both < 0.5, "{own} {both}");
        let found = hub.solve_with(&reduced, &[]).expect("estimates");
        let [first, second] = [1, 3].map(|of| found.of(of).expect("told")[0]);
        assert!((first - 2.0).abs() < 1e-3 && (second - 4.0).abs() < 1e-3, "{first} {second}");
        let alone = hub.solve_with(&[], &[1, 2]).expect("estimates");
        assert_eq!(alone.of(1), None);
        let [second, _] = alone.of(3).expect("told");
        assert!((second - 8.0).abs() < 1e-3, "{second}");
    }

    /// Of few observations the first parameters are estimated, and the others are not.
    #[test]
    fn the_leading_parameters_are_those_of_a_smaller_regression() {
        let (mut all, mut few) = (Regression::new(3), Regression::new(1));
        for k in 0..4_u32 {
            all.add(&[1.0, f64::from(k), f64::from(k * k)], 2.0 + f64::from(k % 2));
            few.add(&[1.0], 2.0 + f64::from(k % 2));
        }
        assert!(all.solve().is_none());
        let [leading, few] = [all.leading(1).solve(), few.solve()].map(|of| of.expect("a mean"));
        assert_eq!(leading.of(0), few.of(0));
        assert_eq!(few.of(0).map(|[mean, _]| mean), Some(2.5));
    }
}
