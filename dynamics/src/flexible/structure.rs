//! [`Flexible`] as a [`Structure`]: modal coordinates, what acts on them, and their checks. Without modes
//! and mounts it is a rigid hub, with the same bits.

use crate::attitude::parameterisation::Attitude;
use crate::derivatives::structure::Structure;
use crate::equations::error::{Quantity, SolveError};
use crate::equations::stiffness::Stiffness;
use crate::flexible::equations::block::finite;
use crate::flexible::equations::spacecraft::FlexibleConstants;
use crate::flexible::modal::inputs::ModalInputs;
use crate::flexible::modal::state::{ModalAccelerations, ModalState};
use crate::flexible::modal::storage::{Flexible, ModalStorage};
use crate::flexible::results::ledger::ModalLedger;
use crate::flexible::results::loads::ModalLoads;
use crate::integrate::energy_lost::Jump;
use crate::integrate::structure::{Stage, StructureSteps};
use crate::model::wrench::Wrench;
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::{Vec3, components};
use crate::results::ledger::Ledger;
use crate::results::loads::{LoadAxes, Loads};
use crate::results::momentum::MotionSums;
use crate::results::structure::StructureResults;
use crate::sets::devices::Devices;
use crate::solve::elimination::Eliminate;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};
use crate::solve::structure::{Solved, StructureData, StructureEquations};

impl<M: ModalStorage> Structure for Flexible<M> {}

impl<M: ModalStorage> StructureData for Flexible<M> {
    type State<T: Scalar> = ModalState<M, T>;
    type Inputs<T: Scalar> = ModalInputs<M, T>;
    type Accelerations<T: Scalar> = ModalAccelerations<M, T>;
    type Loads<T: Scalar> = ModalLoads<M, T>;
    type Ledger<T: Scalar> = ModalLedger<T>;
    type Constants<D: Devices> = FlexibleConstants<D, M>;
}

impl<M: ModalStorage> StructureEquations for Flexible<M> {
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

    fn solve<D: Devices, A: Attitude<D::Scalar>>(
        craft: &Spacecraft<D, Self>,
        by: impl Eliminate<D::Scalar>,
        state: &State<D, A, Self>,
        inputs: &Inputs<D, Self>,
        found: &mut Accelerations<D, Self>,
        stiffness: Option<&mut Stiffness<D::Scalar>>,
    ) -> Solved<(), D> {
        if craft.is_rigid() {
            return craft.solve_rigid(by, state, inputs, found, stiffness);
        }
        craft.solve_flexible(by, state, inputs, found)
    }
}

impl<M: ModalStorage> StructureResults for Flexible<M> {
    fn sums<D: Devices, A: Attitude<D::Scalar>>(
        craft: &Spacecraft<D, Self>,
        state: &State<D, A, Self>,
    ) -> MotionSums<D::Scalar> {
        if craft.is_rigid() {
            return craft.sums_rigid(state);
        }
        craft.sums_flexible(state).motion
    }

    fn first_moment<D: Devices, A: Attitude<D::Scalar>>(
        craft: &Spacecraft<D, Self>,
        state: &State<D, A, Self>,
    ) -> [Vec3<D::Scalar>; 2] {
        if craft.is_rigid() {
            return craft.first_moment_rigid(state);
        }
        craft.sums_flexible(state).first_moment
    }

    fn ledger<D: Devices, A: Attitude<D::Scalar>>(
        craft: &Spacecraft<D, Self>,
        state: &State<D, A, Self>,
        inputs: &Inputs<D, Self>,
        accelerations: &Accelerations<D, Self>,
    ) -> Solved<Ledger<D::Scalar, Self>, D> {
        if craft.is_rigid() {
            let modal = ModalLedger { strain: zero(), stiffness: zero(), damping: zero() };
            return craft.ledger_rigid(state, inputs, accelerations, modal);
        }
        craft.ledger_flexible(state, inputs, accelerations)
    }

    fn loads<D: Devices, A: Attitude<D::Scalar>>(
        craft: &Spacecraft<D, Self>,
        state: &State<D, A, Self>,
        inputs: &Inputs<D, Self>,
        accelerations: &Accelerations<D, Self>,
        axes: LoadAxes,
    ) -> Solved<Loads<D, Self>, D> {
        if craft.is_rigid() {
            let none = (M::modes(0, &zero()), M::mounts(0, &Wrench::none()));
            let modal = ModalLoads { forces: none.0, mounts: none.1 };
            return craft.loads_rigid(state, inputs, accelerations, axes, modal);
        }
        craft.loads_flexible(state, inputs, accelerations, axes)
    }
}

impl<M: ModalStorage> StructureSteps for Flexible<M> {
    fn jump<D: Devices, A: Attitude<D::Scalar>>(
        craft: &Spacecraft<D, Self>,
        state: &State<D, A, Self>,
        inputs: &Inputs<D, Self>,
    ) -> Jump<State<D, A, Self>, D::Scalar> {
        if craft.is_rigid() {
            return craft.jump_rigid(state, inputs);
        }
        craft.jump_flexible(state, inputs)
    }

    fn vibrates<D: Devices>(craft: &Spacecraft<D, Self>) -> bool {
        craft.passive || !craft.is_rigid()
    }

    fn accepts<D: Devices>(
        craft: &Spacecraft<D, Self>,
        inputs: &Inputs<D, Self>,
        dt: D::Scalar,
        resolved: bool,
    ) -> bool {
        if craft.is_rigid() { resolved } else { craft.is_within_own_limit(inputs, dt) }
    }

    fn check_stability<D: Devices, A: Attitude<D::Scalar>>(
        craft: &Spacecraft<D, Self>,
        posed: &State<D, A, Self>,
        inputs: &Inputs<D, Self>,
        dt: D::Scalar,
    ) -> Solved<(), D> {
        if craft.is_rigid() {
            return craft.check_stability_rigid(posed, inputs, dt);
        }
        craft.check_vibrations(posed, inputs, dt)
    }

    fn follow<T: Scalar>(
        (stage, start, sum): Stage<'_, ModalState<M, T>>,
        accelerations: &ModalAccelerations<M, T>,
        [weight, offset]: [T; 2],
    ) {
        let now = stage.eta.as_mut().iter_mut().zip(stage.eta_dot.as_mut());
        let from = start.eta.as_ref().iter().zip(start.eta_dot.as_ref());
        let sums = sum.eta.as_mut().iter_mut().zip(sum.eta_dot.as_mut());
        for ((((eta, rate), (from, rate_from)), (sum, sum_of_rate)), acceleration) in
            now.zip(from).zip(sums).zip(accelerations.eta_ddot.as_ref())
        {
            *sum = *sum + weight * *rate;
            *sum_of_rate = *sum_of_rate + weight * *acceleration;
            *eta = *from + offset * *rate;
            *rate = *rate_from + offset * *acceleration;
        }
    }

    fn add<T: Scalar>(to: &mut ModalState<M, T>, start: &ModalState<M, T>, sum: &ModalState<M, T>) {
        add(to.eta.as_mut(), start.eta.as_ref(), sum.eta.as_ref());
        add(to.eta_dot.as_mut(), start.eta_dot.as_ref(), sum.eta_dot.as_ref());
    }

    fn set_rates<T: Scalar>(state: &mut ModalState<M, T>, rate: T) {
        state.eta_dot.as_mut().fill(rate);
    }

    fn add_rates<T: Scalar>((a, x): (T, &mut ModalState<M, T>), (b, y): (T, &ModalState<M, T>)) {
        for (rate, other) in x.eta_dot.as_mut().iter_mut().zip(y.eta_dot.as_ref()) {
            *rate = a * *rate + b * *other;
        }
    }
}

/// `to = start + sum`.
fn add<T: Scalar>(to: &mut [T], start: &[T], sum: &[T]) {
    for (to, (start, sum)) in to.iter_mut().zip(start.iter().zip(sum)) {
        *to = *start + *sum;
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
