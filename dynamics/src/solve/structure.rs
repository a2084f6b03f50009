//! [`Structure`]: what carries the devices, a [`Rigid`] hub or a
//! [`Flexible`](crate::Flexible) structure; what both have is written once for any.

use core::fmt::Debug;

use crate::equations::error::SolveError;
use crate::numbers::real::Scalar;
use crate::sets::devices::Devices;
use crate::solve::spacecraft::Spacecraft;

/// What a structure adds to state, inputs and results.
pub trait StructureData: Copy + Debug + PartialEq + Send + Sync + 'static {
    /// Modal coordinates and their rates; nothing of a rigid hub.
    type State<T: Scalar>: Clone + Debug + PartialEq;
    /// Modal forces, and wrenches on mounts; nothing of a rigid hub.
    type Inputs<T: Scalar>: Clone + Debug + PartialEq;
    /// Second derivatives of the modal coordinates; nothing of a rigid hub.
    type Accelerations<T: Scalar>: Clone + Debug + PartialEq;
    /// Loads of mounts and modes; nothing of a rigid hub.
    type Loads<T: Scalar>: Clone + Debug + PartialEq;
    /// Energy and powers of the modes; nothing of a rigid hub.
    type Ledger<T: Scalar>: Copy + Debug + PartialEq;
    /// What is computed of the structure once, beside what a rigid hub has.
    #[doc(hidden)]
    type Constants<D: Devices>: Clone + Debug;
}

/// What carries the devices of a [`Spacecraft`]: [`Rigid`] or [`Flexible`](crate::Flexible). A function
/// for spacecraft of any structure has this for a bound.
#[expect(private_bounds, reason = "only this crate has structures")]
pub trait Structure: StructureServices {}

/// A hub that does not deform.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rigid;

/// A result, or why there is none.
type Solved<R, D> = Result<R, SolveError<<D as crate::sets::devices::DeviceSet>::Scalar>>;

/// What the services of a spacecraft need of its structure.
pub(crate) trait StructureServices: StructureData {
    /// Mass of structure and devices, kg.
    fn mass<D: Devices>(craft: &Spacecraft<D, Self>) -> D::Scalar;

    /// Undeformed and at rest.
    fn at_rest<D: Devices>(craft: &Spacecraft<D, Self>) -> Self::State<D::Scalar>;

    /// Nothing acts.
    fn no_inputs<D: Devices>(craft: &Spacecraft<D, Self>) -> Self::Inputs<D::Scalar>;

    /// To be filled in.
    fn no_accelerations<D: Devices>(craft: &Spacecraft<D, Self>) -> Self::Accelerations<D::Scalar>;

    /// Whether state and inputs are finite, and of the right number of modes and mounts.
    fn are_finite<D: Devices>(
        craft: &Spacecraft<D, Self>,
        state: &Self::State<D::Scalar>,
        inputs: &Self::Inputs<D::Scalar>,
    ) -> bool;

    /// Rejects a state that is not finite, or of another number of modes.
    fn reject_state<D: Devices>(
        craft: &Spacecraft<D, Self>,
        state: &Self::State<D::Scalar>,
    ) -> Solved<(), D>;

    /// Rejects inputs that are not finite, or of another number of modes or mounts.
    fn reject_inputs<D: Devices>(
        craft: &Spacecraft<D, Self>,
        inputs: &Self::Inputs<D::Scalar>,
    ) -> Solved<(), D>;

    /// Rejects accelerations that are not finite, or of another number of modes.
    fn reject_accelerations<D: Devices>(
        craft: &Spacecraft<D, Self>,
        accelerations: &Self::Accelerations<D::Scalar>,
    ) -> Solved<(), D>;
}
