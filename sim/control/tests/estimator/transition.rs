//! The covariance after one sample with a large turn against differences of the filter's own propagation.

use nalgebra::{Matrix3, SMatrix, SVector, Vector3};
use precess_control::rotation::{from_vector, inverse, product, to_vector};
use precess_control::{Covariance, Estimate, Mekf, MekfParameters};
use precess_dynamics::Quaternion;

use crate::truth::isotropic;

/// Steps of 1e-5: their squares in central differences, and rounding of 1e-16 / 1e-5.
const STEP: f64 = 1e-5;
const DIFFERENCES: f64 = 1e-9;

const PERIOD: f64 = 0.7;

/// After one sample, without noise.
fn after(attitude: Quaternion, bias: Vector3<f64>, covariance: Covariance) -> Estimate {
    let parameters = MekfParameters {
        period: PERIOD,
        angle_random_walk: 0.0,
        rate_random_walk: 0.0,
        measured: isotropic(1e-3),
        longest_latency: 0,
    };
    let initial = Estimate { attitude, bias, covariance };
    let mut filter = Mekf::new(&parameters, &initial).unwrap();
    filter.propagate(&Vector3::new(1.1, -0.8, 2.0));
    *filter.estimate()
}

/// `P = Phi P0 Phi^T`, each column of Phi by an error of attitude or bias.
#[test]
fn a_covariance_follows_the_errors_that_it_is_of() {
    let (attitude, bias) =
        (from_vector(&Vector3::new(0.3, 0.6, -1.0)), Vector3::new(0.1, 0.2, 0.05));
    let first = Covariance {
        attitude: Matrix3::new(2.0, 0.3, -0.4, 0.3, 1.5, 0.2, -0.4, 0.2, 1.0),
        cross: Matrix3::new(0.2, -0.1, 0.3, 0.1, 0.25, -0.2, -0.15, 0.05, 0.1),
        bias: Matrix3::new(0.9, -0.2, 0.1, -0.2, 0.8, 0.15, 0.1, 0.15, 0.7),
    };
    let estimate = after(attitude, bias, first);
    let error = |step: SVector<f64, 6>| {
        let turn: Vector3<f64> = step.fixed_rows::<3>(0).into_owned();
        let more: Vector3<f64> = step.fixed_rows::<3>(3).into_owned();
        let moved = after(product(&attitude, &from_vector(&turn)), bias + more, first);
        let turned = to_vector(&product(&inverse(&estimate.attitude), &moved.attitude));
        let biased = moved.bias - estimate.bias;
        SVector::<f64, 6>::from_fn(|row, _| if row < 3 { turned[row] } else { biased[row - 3] })
    };
    let columns = [0, 1, 2, 3, 4, 5].map(|column| {
        let mut step = SVector::<f64, 6>::zeros();
        step[column] = STEP;
        (error(step) - error(-step)) / (2.0 * STEP)
    });
    let transition = SMatrix::<f64, 6, 6>::from_columns(&columns);
    let expected = transition * first.matrix() * transition.transpose();
    assert!((estimate.covariance.matrix() - expected).amax() < DIFFERENCES);
    // The turn is large: without it the blocks would be others.
    assert!((transition.fixed_view::<3, 3>(0, 3) + Matrix3::identity() * PERIOD).amax() > 0.2);
}
