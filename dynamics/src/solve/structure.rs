//! What carries the devices, a [`Rigid`] hub or a [`Flexible`](crate::Flexible) structure: its data, and
//! what differs between the two in the equations. What both have is written once for any.

use core::fmt::Debug;

use crate::attitude::parameterisation::Attitude;
use crate::equations::error::SolveError;
use crate::equations::stiffness::Stiffness;
use crate::numbers::real::Scalar;
use crate::sets::devices::{DeviceSet, Devices};
use crate::solve::elimination::Eliminate;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};

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

/// A hub that does not deform.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rigid;

/// A result, or why there is none.
pub(crate) type Solved<R, D> = Result<R, SolveError<<D as DeviceSet>::Scalar>>;

/// What the equations of a spacecraft need of its structure.
pub(crate) trait StructureEquations: StructureData + Sized {
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

    /// Writes the accelerations, each device eliminated `by` this; and the stiffness of springs and
    /// friction on a hub that does not deform, if requested.
    fn solve<D: Devices, A: Attitude<D::Scalar>>(
        craft: &Spacecraft<D, Self>,
        by: impl Eliminate<D::Scalar>,
        state: &State<D, A, Self>,
        inputs: &Inputs<D, Self>,
        found: &mut Accelerations<D, Self>,
        stiffness: Option<&mut Stiffness<D::Scalar>>,
    ) -> Solved<(), D>;
}
