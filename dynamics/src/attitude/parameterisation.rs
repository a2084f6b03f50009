//! What the solver requires of an attitude parameterisation; [`Mrp`](crate::Mrp) and
//! [`Quaternion`](crate::Quaternion) provide it.

use core::fmt::Debug;

use nalgebra::{Matrix3, Vector3};

use crate::numbers::real::Scalar;

/// Attitude of the hub's frame B with respect to the inertial frame N.
pub trait Attitude<T: Scalar>: Copy + Debug + PartialEq {
    /// Time derivatives of the parameters, 1/s.
    type Rate: Copy + Debug + PartialEq;

    /// The attitude in which B's axes are N's.
    #[must_use]
    fn identity() -> Self;

    /// `[BN]`: maps components expressed in N to components expressed in B.
    #[must_use]
    fn dcm(&self) -> Matrix3<T>;

    /// Rate of the parameters for `omega`, the angular velocity of B in N, B axes, rad/s.
    #[must_use]
    fn rate(&self, omega: &Vector3<T>) -> Self::Rate;

    /// The parameters plus the sum of `offset * rate` over the terms, without normalising.
    ///
    /// The terms are summed before the sum is added to the parameters, which rounds less than
    /// adding them one by one.
    #[must_use]
    fn advanced(&self, terms: &[(T, Self::Rate)]) -> Self;

    /// The same attitude by parameters that a step may start from: unchanged, unless they are so
    /// large or small that their rates lose digits. MRPs beyond a half turn become their shadow
    /// set, a quaternion that is very short or long is divided by its largest component.
    #[must_use]
    fn regular(&self) -> Self;

    /// The same attitude by the preferred parameters: unit length, or the inner of two sets.
    #[must_use]
    fn normalised(&self) -> Self;

    /// Whether the parameters are an attitude that [`Self::dcm`] can compute: all finite, a
    /// quaternion not zero, MRPs not so large that their squares overflow.
    #[must_use]
    fn is_valid(&self) -> bool;

    /// The parameter that an error shows: the first one that is not finite, otherwise the one of
    /// largest magnitude.
    #[must_use]
    fn extreme(&self) -> T;
}
