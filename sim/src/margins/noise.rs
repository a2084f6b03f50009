//! [`NoiseGains`]: what white noise of the readings of attitude and rate does to the hub.
//!
//! Noise that is independent from sample to sample, of standard deviation sigma, moves the hub by the root of the sum of squares of
//! the impulse response times sigma: with `x_k+1 = A x_k + B n_k`, `y_k = C x_k + D n_k`
//!
//! ```text
//! sum over k of |response|² = D^T D + B^T Q B      Q = sum (A^T)^k C^T C A^k
//! Q <- Q + A^T Q A,  A <- A²                       twice as many samples each time (Smith 1968)
//! ```

use nalgebra::{DMatrix, SMatrix};

use super::analysis::ControlLoop;
use super::measurement::{READ, ReadingNoise};

/// Doublings, at most: 2^40 samples.
const DOUBLINGS: usize = 40;
/// What a doubling adds to a sum of squares, as a share of it, when it is over.
const OVER: f64 = 1e-14;

/// Sums of squares of the responses to a rotation and a rate, three axes each, that are read.
type Squares = SMatrix<f64, READ, READ>;

/// RMS of the closed loop at the samples by noise with a standard deviation of one.
#[derive(Clone, Debug, PartialEq)]
pub struct NoiseGains {
    /// Rotation of the hub, rad, about each axis (rows) by noise of the read rotation about each (columns), rad.
    pub attitude: [[f64; 3]; 3],
    /// The same by noise of the read angular velocity, rad/s: s.
    pub rate: [[f64; 3]; 3],
    /// The torque of the law, N m, by noise of the rotation and of the angular velocity.
    pub torque: [[[f64; 3]; 3]; 2],
    /// Of the rotation about each axis: for noise that is not independent from axis to axis.
    squares: [Squares; 3],
}

impl NoiseGains {
    /// RMS of the rotation about each axis, rad.
    #[must_use]
    pub fn attitude_rms(&self, noise: &ReadingNoise) -> [f64; 3] {
        let mut covariance = Squares::zeros();
        covariance.fixed_view_mut::<3, 3>(0, 0).copy_from(&noise.attitude);
        covariance.fixed_view_mut::<3, 3>(3, 3).fill_diagonal(noise.rate * noise.rate);
        self.squares.map(|of| (of * covariance).trace().max(0.0).sqrt())
    }
}

impl ControlLoop {
    /// Of a stable loop; none of one that is not, or whose response does not end.
    #[must_use]
    pub fn noise(&self) -> Option<NoiseGains> {
        if !self.closed.is_stable().ok()? {
            return None;
        }
        let feedback = self.closed.feedback();
        let [f, g, h] = self.closed.plant().with_waiting();
        let (n, own) = (f.nrows(), feedback.a.nrows());
        let at_once = self.samples.noise_at_once();
        let mut by_noise = DMatrix::zeros(n + own, READ);
        by_noise.rows_mut(0, n).copy_from(&(g * &feedback.d * at_once));
        let mut plant = by_noise.rows_mut(0, self.noise.nrows());
        plant += &self.noise;
        by_noise.rows_mut(n, own).copy_from(&(&feedback.b * at_once));
        // Of the rotation of the hub, the first three states; of the torque, to which noise of the present sample is added.
        let mut rows = DMatrix::zeros(6, n + own);
        rows.view_mut((0, 0), (3, 3)).fill_with_identity();
        rows.view_mut((3, 0), (3, n)).copy_from(&(&feedback.d * h));
        rows.view_mut((3, n), (3, own)).copy_from(&feedback.c);
        let mut directly = DMatrix::zeros(6, READ);
        directly.rows_mut(3, 3).copy_from(&(&feedback.d * at_once));
        let all = sums(self.closed.state_matrix(), &by_noise, (&rows, &directly))?;
        let of = |row: usize, column: usize| {
            let root = |i: usize, j: usize| {
                let square = all.get(row + i).map_or(0.0, |of| of[(column + j, column + j)]);
                square.max(0.0).sqrt()
            };
            [0, 1, 2].map(|i| [0, 1, 2].map(|j| root(i, j)))
        };
        let [x, y, z, ..] = all;
        let squares = [x, y, z];
        Some(NoiseGains {
            attitude: of(0, 0),
            rate: of(0, 3),
            torque: [of(3, 0), of(3, 3)],
            squares,
        })
    }
}

/// `D^T D + B^T Q B` of each output; none where it is not over after so many doublings.
fn sums(
    a: &DMatrix<f64>,
    b: &DMatrix<f64>,
    (c, d): (&DMatrix<f64>, &DMatrix<f64>),
) -> Option<[Squares; 6]> {
    let mut power = a.clone();
    let mut each: Vec<DMatrix<f64>> = c.row_iter().map(|row| row.transpose() * row).collect();
    let mut before = [Squares::zeros(); 6];
    for _ in 0..DOUBLINGS {
        let mut found = [Squares::zeros(); 6];
        for (index, (to, own)) in found.iter_mut().zip(&each).enumerate() {
            let direct = d.row(index);
            to.copy_from(&(direct.transpose() * direct + b.transpose() * own * b));
        }
        if !found.iter().flatten().all(|value| value.is_finite()) {
            return None;
        }
        let over = found.iter().zip(&before).all(|(now, then)| {
            (now - then).diagonal().max() <= OVER * now.diagonal().max().max(f64::MIN_POSITIVE)
        });
        if over {
            return Some(found);
        }
        before = found;
        for own in &mut each {
            *own += power.transpose() * &*own * &power;
        }
        power = &power * &power;
    }
    None
}
