//! An evaluation by fused numbers, in the one function that may use the CPU's instruction.

use pulp::{Simd, WithSimd};

use crate::attitude::parameterisation::Attitude;
use crate::equations::arithmetic::FusedMultiplyAdd;
use crate::equations::error::SolveError;
use crate::equations::stiffness::Stiffness;
use crate::sets::devices::Devices;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};

/// An evaluation by fused numbers.
pub(crate) struct FusedEvaluation<'a, D: Devices, A> {
    pub(crate) craft: &'a Spacecraft<D>,
    pub(crate) state: &'a State<D, A>,
    pub(crate) inputs: &'a Inputs<D>,
    pub(crate) found: &'a mut Accelerations<D>,
    pub(crate) stiffness: Option<&'a mut Stiffness<D::Scalar>>,
}

impl<D: Devices, A: Attitude<D::Scalar>> WithSimd for FusedEvaluation<'_, D, A> {
    type Output = Result<(), SolveError<D::Scalar>>;

    #[inline(always)]
    #[expect(clippy::inline_always, reason = "fused numbers reach their instruction only inlined")]
    fn with_simd<S: Simd>(self, _: S) -> Self::Output {
        let Self { craft, state, inputs, found, stiffness } = self;
        craft.solve_by::<_, FusedMultiplyAdd>(state, inputs, found, stiffness)
    }
}
