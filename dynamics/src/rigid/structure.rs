//! [`Rigid`] as a [`Structure`]: no modal coordinates, so none that could be rejected.

use crate::equations::error::SolveError;
use crate::numbers::real::Scalar;
use crate::sets::devices::Devices;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::structure::{Rigid, Structure, StructureData, StructureServices};

impl Structure for Rigid {}

impl StructureData for Rigid {
    type State<T: Scalar> = ();
    type Inputs<T: Scalar> = ();
    type Accelerations<T: Scalar> = ();
    type Loads<T: Scalar> = ();
    type Ledger<T: Scalar> = ();
    type Constants<D: Devices> = ();
}

impl StructureServices for Rigid {
    fn mass<D: Devices>(craft: &Spacecraft<D>) -> D::Scalar {
        craft.body.m_b
    }

    fn at_rest<D: Devices>(_: &Spacecraft<D>) {}

    fn no_inputs<D: Devices>(_: &Spacecraft<D>) {}

    fn no_accelerations<D: Devices>(_: &Spacecraft<D>) {}

    #[inline]
    fn are_finite<D: Devices>(_: &Spacecraft<D>, (): &(), (): &()) -> bool {
        true
    }

    #[inline]
    fn reject_state<D: Devices>(_: &Spacecraft<D>, (): &()) -> Result<(), SolveError<D::Scalar>> {
        Ok(())
    }

    #[inline]
    fn reject_inputs<D: Devices>(_: &Spacecraft<D>, (): &()) -> Result<(), SolveError<D::Scalar>> {
        Ok(())
    }

    #[inline]
    fn reject_accelerations<D: Devices>(
        _: &Spacecraft<D>,
        (): &(),
    ) -> Result<(), SolveError<D::Scalar>> {
        Ok(())
    }
}
