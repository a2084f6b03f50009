//! [`Structure`]: a rigid hub or a flexible structure, and what differs between the two in derivatives.

use crate::integrate::structure::StructureSteps;
use crate::model::wrench::Wrench;
use crate::numbers::real::Scalar;
use crate::sets::devices::{DeviceSet, Devices};
use crate::sets::with_numbers::WithNumbers;
use crate::solve::spacecraft::Spacecraft;

/// What carries the devices of a [`Spacecraft`]: [`Rigid`](crate::Rigid) or
/// [`Flexible`](crate::Flexible). A function for spacecraft of any structure has this for a bound.
pub trait Structure: StructureDerivatives {}

/// What derivatives need of a structure: its data over other numbers, and its variables.
pub(crate) trait StructureDerivatives: StructureSteps {
    /// What is computed of the structure once, with each number converted; `devices` are the converted
    /// ones.
    fn constants<D: WithNumbers, U: Scalar>(
        craft: &Spacecraft<D, Self>,
        devices: &<D::With<U> as DeviceSet>::Prepared,
        number: impl Fn(D::Scalar) -> U + Copy,
    ) -> Self::Constants<D::With<U>>;

    /// State with each number converted.
    fn state<T: Scalar, U: Scalar>(
        state: &Self::State<T>,
        number: impl Fn(T) -> U + Copy,
    ) -> Self::State<U>;

    /// Inputs with each number converted.
    fn inputs<T: Scalar, U: Scalar>(
        inputs: &Self::Inputs<T>,
        number: impl Fn(T) -> U + Copy,
    ) -> Self::Inputs<U>;

    /// Accelerations with each number converted.
    fn accelerations<T: Scalar, U: Scalar>(
        accelerations: &Self::Accelerations<T>,
        number: impl Fn(T) -> U + Copy,
    ) -> Self::Accelerations<U>;

    /// The number of modal coordinates.
    fn modes<D: Devices>(craft: &Spacecraft<D, Self>) -> usize;

    /// The number of mounts.
    fn mounts<D: Devices>(craft: &Spacecraft<D, Self>) -> usize;

    /// The modal coordinates, and their rates.
    fn coordinates<T: Scalar>(state: &mut Self::State<T>) -> [&mut [T]; 2];

    /// The forces on the modes.
    fn forces<T: Scalar>(inputs: &mut Self::Inputs<T>) -> &mut [T];

    /// The wrenches on the mounts.
    fn wrenches<T: Scalar>(inputs: &mut Self::Inputs<T>) -> &mut [Wrench<T>];

    /// The second derivatives of the modal coordinates.
    fn modal_accelerations<T: Scalar>(of: &Self::Accelerations<T>) -> &[T];
}
