//! [`Flexible`] as a [`Structure`]: modal coordinates, what acts on them, and their checks.

use crate::equations::error::{Quantity, SolveError};
use crate::flexible::block::finite;
use crate::flexible::inputs::ModalInputs;
use crate::flexible::ledger::ModalLedger;
use crate::flexible::loads::ModalLoads;
use crate::flexible::spacecraft::FlexibleConstants;
use crate::flexible::state::{ModalAccelerations, ModalState};
use crate::flexible::storage::{Flexible, ModalStorage};
use crate::model::wrench::Wrench;
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::components;
use crate::sets::devices::Devices;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::structure::{Structure, StructureData, StructureServices};

impl<M: ModalStorage> Structure for Flexible<M> {}

impl<M: ModalStorage> StructureData for Flexible<M> {
    type State<T: Scalar> = ModalState<M, T>;
    type Inputs<T: Scalar> = ModalInputs<M, T>;
    type Accelerations<T: Scalar> = ModalAccelerations<M, T>;
    type Loads<T: Scalar> = ModalLoads<M, T>;
    type Ledger<T: Scalar> = ModalLedger<T>;
    type Constants<D: Devices> = FlexibleConstants<D, M>;
}

impl<M: ModalStorage> StructureServices for Flexible<M> {
    fn mass<D: Devices>(craft: &Spacecraft<D, Self>) -> D::Scalar {
        craft.structure.mass
    }

    fn at_rest<D: Devices>(craft: &Spacecraft<D, Self>) -> ModalState<M, D::Scalar> {
        let still = M::modes(craft.modes(), &zero());
        ModalState { eta: still.clone(), eta_dot: still }
    }

    fn no_inputs<D: Devices>(craft: &Spacecraft<D, Self>) -> ModalInputs<M, D::Scalar> {
        ModalInputs {
            forces: M::modes(craft.modes(), &zero()),
            mounts: M::mounts(craft.mounts(), &Wrench::none()),
        }
    }

    fn no_accelerations<D: Devices>(
        craft: &Spacecraft<D, Self>,
    ) -> ModalAccelerations<M, D::Scalar> {
        ModalAccelerations { eta_ddot: M::modes(craft.modes(), &zero()) }
    }

    fn are_finite<D: Devices>(
        craft: &Spacecraft<D, Self>,
        state: &ModalState<M, D::Scalar>,
        inputs: &ModalInputs<M, D::Scalar>,
    ) -> bool {
        let of_modes = [&state.eta, &state.eta_dot, &inputs.forces].map(AsRef::<[_]>::as_ref);
        of_modes.into_iter().all(|numbers| numbers.len() == craft.modes() && finite(numbers))
            && inputs.mounts.as_ref().len() == craft.mounts()
            && inputs.mounts.as_ref().iter().all(Wrench::is_finite)
    }

    fn reject_state<D: Devices>(
        craft: &Spacecraft<D, Self>,
        state: &ModalState<M, D::Scalar>,
    ) -> Result<(), SolveError<D::Scalar>> {
        let expected = craft.modes();
        reject(expected, state.eta.as_ref(), |mode| Quantity::ModalCoordinate { mode })?;
        reject(expected, state.eta_dot.as_ref(), |mode| Quantity::ModalRate { mode })
    }

    fn reject_inputs<D: Devices>(
        craft: &Spacecraft<D, Self>,
        inputs: &ModalInputs<M, D::Scalar>,
    ) -> Result<(), SolveError<D::Scalar>> {
        reject(craft.modes(), inputs.forces.as_ref(), |mode| Quantity::ModalForce { mode })?;
        let (expected, found) = (craft.mounts(), inputs.mounts.as_ref().len());
        if expected != found {
            return Err(SolveError::ModalCount { expected, found });
        }
        for (mount, wrench) in inputs.mounts.as_ref().iter().enumerate() {
            let numbers = [components(&wrench.force), components(&wrench.moment)];
            if let Some(value) = numbers.into_iter().flatten().find(|value| !value.is_finite()) {
                return Err(SolveError::NotFinite { what: Quantity::MountWrench { mount }, value });
            }
        }
        Ok(())
    }

    fn reject_accelerations<D: Devices>(
        craft: &Spacecraft<D, Self>,
        accelerations: &ModalAccelerations<M, D::Scalar>,
    ) -> Result<(), SolveError<D::Scalar>> {
        let numbers = accelerations.eta_ddot.as_ref();
        reject(craft.modes(), numbers, |_| Quantity::ModalAcceleration)
    }
}

/// Rejects numbers that are not finite, or not one of each mode.
fn reject<T: Scalar>(
    expected: usize,
    numbers: &[T],
    what: impl Fn(usize) -> Quantity,
) -> Result<(), SolveError<T>> {
    let found = numbers.len();
    if expected != found {
        return Err(SolveError::ModalCount { expected, found });
    }
    match numbers.iter().copied().enumerate().find(|(_, value)| !value.is_finite()) {
        Some((mode, value)) => Err(SolveError::NotFinite { what: what(mode), value }),
        None => Ok(()),
    }
}
