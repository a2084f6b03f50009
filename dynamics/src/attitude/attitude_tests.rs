//! Assertions that the tests of both attitude parameterisations share.

use nalgebra::{Matrix3, Vector3};

use crate::attitude::parameterisation::Attitude;

/// A dozen rounded operations on numbers of size one.
pub(crate) const ROUNDING: f64 = 4e-15;

/// Half the interval of a central difference; its square is the difference's relative error.
const INTERVAL: f64 = 1e-5;

/// Cube of the rates (below 8) times the square of the interval, and rounding over the interval.
const DIFFERENCE: f64 = 2e-9;

pub(crate) fn assert_rotation(dcm: Matrix3<f64>) {
    assert!((dcm * dcm.transpose() - Matrix3::identity()).amax() <= ROUNDING, "{dcm}");
    assert!((dcm.determinant() - 1.0).abs() <= ROUNDING, "{dcm}");
}

/// `d[BN]/dt = -tilde(omega) [BN]`.
pub(crate) fn assert_rate_moves_the_dcm<A: Attitude<f64>>(attitude: A) {
    let omega = Vector3::new(0.7, -1.1, 0.4);
    let rate = attitude.rate(&omega);
    let later = attitude.advanced(&[(INTERVAL, rate)]).dcm();
    let earlier = attitude.advanced(&[(-INTERVAL, rate)]).dcm();
    let difference = (later - earlier) / (2.0 * INTERVAL);
    let expected = -omega.cross_matrix() * attitude.dcm();
    assert!((difference - expected).amax() <= DIFFERENCE, "{difference} is not {expected}");
}
