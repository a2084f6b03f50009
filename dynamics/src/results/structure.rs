//! [`StructureResults`]: what differs between structures in momentum, ledger and loads.

use crate::attitude::parameterisation::Attitude;
use crate::numbers::vec3::Vec3;
use crate::results::ledger::Ledger;
use crate::results::loads::{LoadAxes, Loads};
use crate::results::momentum::MotionSums;
use crate::sets::devices::Devices;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};
use crate::solve::structure::{Solved, StructureEquations};

/// What momentum, ledger and loads need of a structure.
pub(crate) trait StructureResults: StructureEquations {
    /// Sums over all bodies.
    fn sums<D: Devices, A: Attitude<D::Scalar>>(
        craft: &Spacecraft<D, Self>,
        state: &State<D, A, Self>,
    ) -> MotionSums<D::Scalar>;

    /// First moment of all bodies about B, and its derivative seen from B, expressed in B.
    fn first_moment<D: Devices, A: Attitude<D::Scalar>>(
        craft: &Spacecraft<D, Self>,
        state: &State<D, A, Self>,
    ) -> [Vec3<D::Scalar>; 2];

    /// The energy ledger of what is finite, or whose overflow shows in the result.
    fn ledger<D: Devices, A: Attitude<D::Scalar>>(
        craft: &Spacecraft<D, Self>,
        state: &State<D, A, Self>,
        inputs: &Inputs<D, Self>,
        accelerations: &Accelerations<D, Self>,
    ) -> Solved<Ledger<D::Scalar, Self>, D>;

    /// The loads that these accelerations need.
    fn loads<D: Devices, A: Attitude<D::Scalar>>(
        craft: &Spacecraft<D, Self>,
        state: &State<D, A, Self>,
        inputs: &Inputs<D, Self>,
        accelerations: &Accelerations<D, Self>,
        axes: LoadAxes,
    ) -> Solved<Loads<D, Self>, D>;
}
