//! [`MekfParameters::steady_gains`]: the gains that the estimator comes to.
//!
//! The covariance before a measurement, `P = F P (1 + G P)^-1 F^T + Q` with `G = H^T R^-1 H`, is the limit of a sequence that
//! doubles the number of samples each time (Chu, Fan, Lin, Wang, Int. J. Control 77(8), 2004):
//!
//! ```text
//! W = 1 + G P      A <- A W^-1 A      G <- G + A W^-1 G A^T      P <- P + A^T P W^-1 A      A = F^T and P = Q at first
//! ```
//!
//! Of a single axis it is what Farrenkopf found in closed form (J. Guid. Control 1(4), 1978).

use nalgebra::{Matrix3, SMatrix};

use crate::estimator::covariance::{Covariance, ProcessNoise};
use crate::estimator::mekf::MekfParameters;
use crate::model::error::{self, ControlError};

type Matrix6 = SMatrix<f64, 6, 6>;

/// Doublings, at most: 2^60 samples.
const DOUBLINGS: usize = 60;
/// What a doubling adds to the covariance, as a share of it, when it is over.
const OVER: f64 = 1e-15;

impl MekfParameters {
    /// The gains after many measurements, one at each sample, without a turn in between: of the attitude, and of the bias in
    /// 1/s. An innovation, rad, times these is what is added to attitude, rad, and bias, rad/s.
    ///
    /// # Errors
    ///
    /// A parameter that is not in its range; [`ControlError::NotConverged`].
    pub fn steady_gains(&self) -> Result<[Matrix3<f64>; 2], ControlError> {
        let failed = || ControlError::NotConverged { what: "covariance of the estimator" };
        error::positive("sampling period", self.period)?;
        error::not_negative("angle random walk", self.angle_random_walk)?;
        error::not_negative("rate random walk", self.rate_random_walk)?;
        error::definite("covariance of the measured attitude", &self.measured)?;
        let noise = ProcessNoise::new(self.period, self.angle_random_walk, self.rate_random_walk);
        let start = Covariance::new(0.0, 0.0);
        let still = nalgebra::Vector3::zeros();
        let mut p = start.propagated(&still, self.period, &noise).matrix();
        let mut a = Matrix6::identity();
        a.fixed_view_mut::<3, 3>(3, 0).fill_diagonal(-self.period);
        let mut g = Matrix6::zeros();
        let information = self.measured.try_inverse().ok_or_else(failed)?;
        g.fixed_view_mut::<3, 3>(0, 0).copy_from(&information);
        for _ in 0..DOUBLINGS {
            let inverse = (Matrix6::identity() + g * p).try_inverse().ok_or_else(failed)?;
            let step = a * inverse;
            let added = a.transpose() * p * inverse * a;
            g += step * g * a.transpose();
            a = step * a;
            p += added;
            (g, p) = (symmetric(&g), symmetric(&p));
            if !p.iter().all(|value| value.is_finite()) {
                return Err(failed());
            }
            let over = |at: usize| {
                let of = |matrix: &Matrix6| matrix.get((at, at)).copied().unwrap_or_default();
                of(&added).abs() <= OVER * of(&p)
            };
            if (0..6).all(over) {
                break;
            }
        }
        let before = Covariance {
            attitude: p.fixed_view::<3, 3>(0, 0).into_owned(),
            cross: p.fixed_view::<3, 3>(0, 3).into_owned(),
            bias: p.fixed_view::<3, 3>(3, 3).into_owned(),
        };
        let gains = before.gains(&self.measured).ok_or_else(failed)?;
        Ok([gains.attitude, gains.bias])
    }
}

fn symmetric(matrix: &Matrix6) -> Matrix6 {
    (matrix + matrix.transpose()) * 0.5
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;
    use precess_dynamics::{Attitude as _, Quaternion};

    use super::*;
    use crate::{Estimate, Mekf};

    fn parameters(angle: f64, rate: f64, deviations: [f64; 3]) -> MekfParameters {
        MekfParameters {
            period: 0.1,
            angle_random_walk: angle,
            rate_random_walk: rate,
            measured: Matrix3::from_diagonal(&Vector3::from(deviations).map(|of| of * of)),
            longest_latency: 0,
        }
    }

    /// Farrenkopf's, as in Crassidis, Junkins, *Optimal Estimation of Dynamic Systems*, second edition, 7.2.4.
    #[test]
    fn gain_of_each_axis_is_farrenkopfs() {
        let of = parameters(1e-4, 1e-5, [1e-4, 3e-4, 2e-5]);
        let [attitude, bias] = of.steady_gains().expect("a limit");
        for axis in 0..3 {
            let deviation = libm::sqrt(of.measured[(axis, axis)]);
            let s_u = of.rate_random_walk * libm::pow(of.period, 1.5) / deviation;
            let s_v = of.angle_random_walk * libm::sqrt(of.period) / deviation;
            let gamma = libm::sqrt(1.0 + s_v * s_v / 4.0 + s_u * s_u / 48.0);
            let inner = 2.0 * gamma * s_u + s_v * s_v + s_u * s_u / 3.0;
            let zeta = gamma + s_u / 4.0 + libm::sqrt(inner) / 2.0;
            let expected = 1.0 - 1.0 / (zeta * zeta);
            let apart = attitude[(axis, axis)] / expected - 1.0;
            assert!(apart.abs() < 1e-10, "{axis}: {apart:e}");
            assert!(bias[(axis, axis)] < 0.0);
        }
        assert_eq!(attitude[(0, 1)], 0.0);
    }

    /// With a covariance of the star tracker that is not diagonal.
    #[test]
    fn gains_are_those_that_the_filter_comes_to() {
        let mut of = parameters(1e-4, 1e-4, [1e-4, 3e-4, 2e-4]);
        let turn = crate::rotation::from_vector(&Vector3::new(0.3, -0.5, 0.2)).dcm();
        of.measured = turn.transpose() * of.measured * turn;
        of.measured = (of.measured + of.measured.transpose()) * 0.5;
        let gains = of.steady_gains().expect("a limit");
        let identity = Quaternion::identity();
        let covariance = Covariance::new(1e-3, 1e-4);
        let start = Estimate { attitude: identity, bias: Vector3::zeros(), covariance };
        let mut mekf = Mekf::new(&of, &start).expect("a filter");
        for _ in 0..3000 {
            mekf.propagate(&Vector3::zeros());
            mekf.update(&identity, 0).expect("an update");
        }
        mekf.propagate(&Vector3::zeros());
        let found = mekf.estimate().covariance.gains(&of.measured).expect("gains");
        for (own, expected) in gains.iter().zip([found.attitude, found.bias]) {
            let apart = (own - expected).norm() / expected.norm();
            assert!(apart < 1e-8, "{apart:e}");
        }
    }

    #[test]
    fn a_bias_that_does_not_walk_has_no_gain() {
        let [attitude, bias] = parameters(1e-5, 0.0, [1e-4; 3]).steady_gains().expect("a limit");
        assert!(attitude[(0, 0)] > 0.0 && bias[(0, 0)] == 0.0);
        let [attitude, _] = parameters(0.0, 0.0, [1e-4; 3]).steady_gains().expect("a limit");
        assert_eq!(attitude[(0, 0)], 0.0);
    }
}
