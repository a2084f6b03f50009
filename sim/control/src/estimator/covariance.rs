//! [`Covariance`] of the errors of attitude and bias, propagated and updated.
//!
//! Crassidis, Junkins, *Optimal Estimation of Dynamic Systems*, second edition, (7.43) to (7.46) and (7.51b); the update is
//! Joseph's form. Blocks of three rows are written out, so that zeros and ones are not multiplied.

use nalgebra::{Matrix3, SMatrix, Vector3};
use precess_dynamics::Attitude as _;

use crate::checkpoint::Checkpoint;
use crate::model::jacobian::jacobian;
use crate::model::rotation::from_vector;

/// Covariance of the rotation vector from estimated to true attitude, about B axes, rad, and of true less estimated bias,
/// rad/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Covariance {
    /// Of the attitude, rad².
    pub attitude: Matrix3<f64>,
    /// Of attitude (rows) and bias (columns), rad²/s.
    pub cross: Matrix3<f64>,
    /// Of the bias, rad²/s².
    pub bias: Matrix3<f64>,
}

/// White noise of the gyro and of its bias over a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ProcessNoise {
    attitude: f64,
    cross: f64,
    bias: f64,
}

/// Gains of an update: of attitude and of bias.
pub(crate) struct Gains {
    pub(crate) attitude: Matrix3<f64>,
    pub(crate) bias: Matrix3<f64>,
    /// The inverse of the innovation's covariance.
    pub(crate) information: Matrix3<f64>,
}

impl ProcessNoise {
    /// (7.46), with the bias's error of the sign in [`Covariance`].
    pub(crate) fn new(period: f64, angle_random_walk: f64, rate_random_walk: f64) -> Self {
        let (white, walk) =
            (angle_random_walk * angle_random_walk, rate_random_walk * rate_random_walk);
        Self {
            attitude: white * period + walk * (period * period * period / 3.0),
            cross: -0.5 * walk * (period * period),
            bias: walk * period,
        }
    }
}

fn symmetric(matrix: &Matrix3<f64>) -> Matrix3<f64> {
    (matrix + matrix.transpose()) * 0.5
}

impl Covariance {
    /// Of independent errors, the same about each axis: standard deviations, rad and rad/s.
    #[must_use]
    pub fn new(attitude: f64, bias: f64) -> Self {
        Self {
            attitude: Matrix3::from_diagonal_element(attitude * attitude),
            cross: Matrix3::zeros(),
            bias: Matrix3::from_diagonal_element(bias * bias),
        }
    }

    /// The whole, attitude first.
    #[must_use]
    pub fn matrix(&self) -> SMatrix<f64, 6, 6> {
        let mut whole = SMatrix::<f64, 6, 6>::zeros();
        whole.fixed_view_mut::<3, 3>(0, 0).copy_from(&self.attitude);
        whole.fixed_view_mut::<3, 3>(0, 3).copy_from(&self.cross);
        whole.fixed_view_mut::<3, 3>(3, 0).copy_from(&self.cross.transpose());
        whole.fixed_view_mut::<3, 3>(3, 3).copy_from(&self.bias);
        whole
    }

    /// Visits its numbers.
    pub(crate) fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        let Self { attitude, cross, bias } = self;
        checkpoint.numbers(attitude.iter_mut().chain(cross.iter_mut()).chain(bias.iter_mut()));
    }

    /// After a turn by a rotation vector in a period, s.
    pub(crate) fn propagated(
        &self,
        turn: &Vector3<f64>,
        period: f64,
        noise: &ProcessNoise,
    ) -> Self {
        let of_attitude = from_vector(turn).dcm();
        let of_bias = jacobian(turn) * -period;
        let cross = of_attitude * self.cross + of_bias * self.bias;
        let both = of_attitude * self.cross * of_bias.transpose();
        let attitude = of_attitude * self.attitude * of_attitude.transpose()
            + both
            + both.transpose()
            + of_bias * self.bias * of_bias.transpose();
        Self {
            attitude: symmetric(&attitude) + Matrix3::from_diagonal_element(noise.attitude),
            cross: cross + Matrix3::from_diagonal_element(noise.cross),
            bias: self.bias + Matrix3::from_diagonal_element(noise.bias),
        }
    }

    /// Gains for a measured attitude with a covariance, rad²; none where the sum of both cannot be inverted.
    pub(crate) fn gains(&self, measured: &Matrix3<f64>) -> Option<Gains> {
        let information = symmetric(&(self.attitude + measured).try_inverse()?);
        Some(Gains {
            attitude: self.attitude * information,
            bias: self.cross.transpose() * information,
            information,
        })
    }

    /// After an update by gains: Joseph's form, for any gains.
    pub(crate) fn updated(&self, gains: &Gains, measured: &Matrix3<f64>) -> Self {
        let (k, l) = (&gains.attitude, &gains.bias);
        let rest = Matrix3::identity() - k;
        let attitude = rest * self.attitude * rest.transpose() + k * measured * k.transpose();
        let cross =
            rest * (self.cross - self.attitude * l.transpose()) + k * measured * l.transpose();
        let both = l * self.cross;
        let bias =
            self.bias - both - both.transpose() + l * (self.attitude + measured) * l.transpose();
        Self { attitude: symmetric(&attitude), cross, bias: symmetric(&bias) }
    }
}
