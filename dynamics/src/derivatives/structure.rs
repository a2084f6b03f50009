//! [`Structure`]: a rigid hub or a flexible structure, and what differs between the two in derivatives.

#[cfg(feature = "alloc")]
use crate::derivatives::loads::kernel::{Moving, NotEmitted};
#[cfg(feature = "alloc")]
use crate::derivatives::tree::base_motion::BaseMotion;
#[cfg(feature = "alloc")]
use crate::derivatives::tree::members::{Base, Members};
#[cfg(feature = "alloc")]
use crate::derivatives::tree::modal_columns::ModalColumns;
#[cfg(feature = "alloc")]
use crate::equations::hub::HubConstants;
#[cfg(feature = "alloc")]
use crate::equations::joint_inputs::Environment;
use crate::integrate::structure::StructureSteps;
use crate::model::wrench::Wrench;
use crate::numbers::real::Scalar;
#[cfg(feature = "alloc")]
use crate::sets::bundle::Bundle;
use crate::sets::devices::{DeviceSet, Devices};
use crate::sets::with_numbers::WithNumbers;
#[cfg(feature = "alloc")]
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
#[cfg(feature = "alloc")]
use crate::solve::state::{Accelerations, State};

/// What carries the devices of a [`Spacecraft`]: [`Rigid`](crate::Rigid) or
/// [`Flexible`](crate::Flexible). A function for spacecraft of any structure has this for a bound.
pub trait Structure: StructureDerivatives {}

/// The mounts of a structure as bases, and its modes.
#[cfg(feature = "alloc")]
pub(crate) type StructureColumns<T> = (alloc::vec::Vec<Base<T>>, ModalColumns<T>);

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

    /// The mounts as bases on the hub, which moves so, and what the structure has of modes.
    #[cfg(feature = "alloc")]
    fn bases<D: Devices, A>(
        craft: &Spacecraft<D, Self>,
        state: &State<D, A, Self>,
        inputs: &Inputs<D, Self>,
        accelerations: &Accelerations<D, Self>,
        hub: &BaseMotion<D::Scalar>,
        of_b: &Environment<D::Scalar>,
    ) -> StructureColumns<D::Scalar>;

    /// The hub as a body: of a flexible structure deformed.
    #[cfg(feature = "alloc")]
    fn body<D: Devices, A>(
        craft: &Spacecraft<D, Self>,
        state: &State<D, A, Self>,
    ) -> HubConstants<D::Scalar>;

    /// Shows each device on its base.
    #[cfg(feature = "alloc")]
    fn visit_members<D: Devices>(
        craft: &Spacecraft<D, Self>,
        data: <Moving as Bundle<D::Scalar>>::Of<'_, D>,
        members: &mut Members<D::Scalar>,
    ) -> Result<(), NotEmitted>;

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
