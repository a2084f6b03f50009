//! [`StructureSteps`]: what differs between structures in a step and a stop.

use crate::attitude::parameterisation::Attitude;
use crate::integrate::energy_lost::Jump;
use crate::numbers::real::Scalar;
use crate::results::structure::StructureResults;
use crate::sets::devices::Devices;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::State;
use crate::solve::structure::Solved;

/// The state at a stage, at the start of the step, and the sum of the slopes.
pub(crate) type Stage<'a, V> = (&'a mut V, &'a V, &'a mut V);

/// What step and stop need of a structure.
pub(crate) trait StructureSteps: StructureResults {
    /// The jump of the velocities in an impulsive stop.
    fn jump<D: Devices, A: Attitude<D::Scalar>>(
        craft: &Spacecraft<D, Self>,
        state: &State<D, A, Self>,
        inputs: &Inputs<D, Self>,
    ) -> Jump<State<D, A, Self>, D::Scalar>;

    /// Whether something vibrates that a step has to resolve.
    fn vibrates<D: Devices>(craft: &Spacecraft<D, Self>) -> bool;

    /// Whether a step needs no further check; `resolved` is whether it is far below the limits that an
    /// evaluation estimates for springs and friction.
    fn accepts<D: Devices>(
        craft: &Spacecraft<D, Self>,
        inputs: &Inputs<D, Self>,
        dt: D::Scalar,
        resolved: bool,
    ) -> bool;

    /// Rejects a step that is too long for the fastest vibration in this pose; the rates are those at
    /// which friction is evaluated.
    fn check_stability<D: Devices, A: Attitude<D::Scalar>>(
        craft: &Spacecraft<D, Self>,
        posed: &State<D, A, Self>,
        inputs: &Inputs<D, Self>,
        dt: D::Scalar,
    ) -> Solved<(), D>;

    /// Adds `weight` times the slope of the structure's state to the sum, and sets that of the next
    /// stage.
    fn follow<T: Scalar>(
        stage: Stage<'_, Self::State<T>>,
        accelerations: &Self::Accelerations<T>,
        weight_and_offset: [T; 2],
    );

    /// `to = start + sum`.
    fn add<T: Scalar>(to: &mut Self::State<T>, start: &Self::State<T>, sum: &Self::State<T>);

    /// Sets every rate.
    fn set_rates<T: Scalar>(state: &mut Self::State<T>, rate: T);

    /// The rates of the first state become `a x + b y`.
    fn add_rates<T: Scalar>(x: (T, &mut Self::State<T>), y: (T, &Self::State<T>));
}
