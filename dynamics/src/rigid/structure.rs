//! [`Rigid`] as a [`Structure`]: no modal coordinates, so none that could be rejected.

use crate::attitude::parameterisation::Attitude;
#[cfg(feature = "alloc")]
use crate::derivatives::loads::kernel::{Moving, NotEmitted};
#[cfg(feature = "alloc")]
use crate::derivatives::structure::StructureColumns;
use crate::derivatives::structure::{Structure, StructureDerivatives};
#[cfg(feature = "alloc")]
use crate::derivatives::tree::base_motion::BaseMotion;
#[cfg(feature = "alloc")]
use crate::derivatives::tree::members::Members;
#[cfg(feature = "alloc")]
use crate::derivatives::tree::modal_columns::ModalColumns;
#[cfg(feature = "alloc")]
use crate::equations::hub::HubConstants;
#[cfg(feature = "alloc")]
use crate::equations::joint_inputs::Environment;
use crate::equations::stiffness::Stiffness;
use crate::integrate::energy_lost::Jump;
use crate::integrate::structure::{Stage, StructureSteps};
use crate::model::wrench::Wrench;
use crate::numbers::real::Scalar;
use crate::numbers::vec3::Vec3;
use crate::results::ledger::Ledger;
use crate::results::loads::{LoadAxes, Loads};
use crate::results::momentum::MotionSums;
use crate::results::structure::StructureResults;
#[cfg(feature = "alloc")]
use crate::sets::bundle::Bundle;
use crate::sets::devices::{DeviceSet, Devices};
use crate::sets::with_numbers::WithNumbers;
use crate::solve::elimination::Eliminate;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};
use crate::solve::structure::{Rigid, Solved, StructureData, StructureEquations};

impl Structure for Rigid {}

impl StructureData for Rigid {
    type State<T: Scalar> = ();
    type Inputs<T: Scalar> = ();
    type Accelerations<T: Scalar> = ();
    type Loads<T: Scalar> = ();
    type Ledger<T: Scalar> = ();
    type Constants<D: Devices> = ();
}

impl StructureEquations for Rigid {
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
    fn reject_state<D: Devices>(_: &Spacecraft<D>, (): &()) -> Solved<(), D> {
        Ok(())
    }

    #[inline]
    fn reject_inputs<D: Devices>(_: &Spacecraft<D>, (): &()) -> Solved<(), D> {
        Ok(())
    }

    #[inline]
    fn reject_accelerations<D: Devices>(_: &Spacecraft<D>, (): &()) -> Solved<(), D> {
        Ok(())
    }

    #[inline]
    fn solve<D: Devices, A: Attitude<D::Scalar>>(
        craft: &Spacecraft<D>,
        by: impl Eliminate<D::Scalar>,
        state: &State<D, A>,
        inputs: &Inputs<D>,
        found: &mut Accelerations<D>,
        stiffness: Option<&mut Stiffness<D::Scalar>>,
    ) -> Solved<(), D> {
        craft.solve_rigid(by, state, inputs, found, stiffness)
    }
}

impl StructureResults for Rigid {
    fn sums<D: Devices, A: Attitude<D::Scalar>>(
        craft: &Spacecraft<D>,
        state: &State<D, A>,
    ) -> MotionSums<D::Scalar> {
        craft.sums_rigid(state)
    }

    fn first_moment<D: Devices, A: Attitude<D::Scalar>>(
        craft: &Spacecraft<D>,
        state: &State<D, A>,
    ) -> [Vec3<D::Scalar>; 2] {
        craft.first_moment_rigid(state)
    }

    fn ledger<D: Devices, A: Attitude<D::Scalar>>(
        craft: &Spacecraft<D>,
        state: &State<D, A>,
        inputs: &Inputs<D>,
        accelerations: &Accelerations<D>,
    ) -> Solved<Ledger<D::Scalar>, D> {
        craft.ledger_rigid(state, inputs, accelerations, ())
    }

    fn loads<D: Devices, A: Attitude<D::Scalar>>(
        craft: &Spacecraft<D>,
        state: &State<D, A>,
        inputs: &Inputs<D>,
        accelerations: &Accelerations<D>,
        axes: LoadAxes,
    ) -> Solved<Loads<D>, D> {
        craft.loads_rigid(state, inputs, accelerations, axes, ())
    }
}

impl StructureSteps for Rigid {
    fn jump<D: Devices, A: Attitude<D::Scalar>>(
        craft: &Spacecraft<D>,
        state: &State<D, A>,
        inputs: &Inputs<D>,
    ) -> Jump<State<D, A>, D::Scalar> {
        craft.jump_rigid(state, inputs)
    }

    #[inline]
    fn vibrates<D: Devices>(craft: &Spacecraft<D>) -> bool {
        craft.passive
    }

    #[inline]
    fn accepts<D: Devices>(_: &Spacecraft<D>, _: &Inputs<D>, _: D::Scalar, resolved: bool) -> bool {
        resolved
    }

    #[inline]
    fn check_stability<D: Devices, A: Attitude<D::Scalar>>(
        craft: &Spacecraft<D>,
        posed: &State<D, A>,
        inputs: &Inputs<D>,
        dt: D::Scalar,
    ) -> Solved<(), D> {
        craft.check_stability_rigid(posed, inputs, dt)
    }

    #[inline]
    fn follow<T: Scalar>(_: Stage<'_, ()>, (): &(), _: [T; 2]) {}

    #[inline]
    fn add<T: Scalar>((): &mut (), (): &(), (): &()) {}

    fn set_rates<T: Scalar>((): &mut (), _: T) {}

    fn add_rates<T: Scalar>(_: (T, &mut ()), _: (T, &())) {}
}

impl StructureDerivatives for Rigid {
    fn constants<D: WithNumbers, U: Scalar>(
        _: &Spacecraft<D>,
        _: &<D::With<U> as DeviceSet>::Prepared,
        _: impl Fn(D::Scalar) -> U + Copy,
    ) {
    }

    fn state<T: Scalar, U: Scalar>((): &(), _: impl Fn(T) -> U + Copy) {}

    fn inputs<T: Scalar, U: Scalar>((): &(), _: impl Fn(T) -> U + Copy) {}

    fn accelerations<T: Scalar, U: Scalar>((): &(), _: impl Fn(T) -> U + Copy) {}

    fn modes<D: Devices>(_: &Spacecraft<D>) -> usize {
        0
    }

    fn mounts<D: Devices>(_: &Spacecraft<D>) -> usize {
        0
    }

    #[cfg(feature = "alloc")]
    fn bases<D: Devices, A>(
        _: &Spacecraft<D>,
        _: &State<D, A>,
        _: &Inputs<D>,
        _: &Accelerations<D>,
        _: &BaseMotion<D::Scalar>,
        _: &Environment<D::Scalar>,
    ) -> StructureColumns<D::Scalar> {
        (alloc::vec::Vec::new(), ModalColumns::none())
    }

    #[cfg(feature = "alloc")]
    fn body<D: Devices, A>(craft: &Spacecraft<D>, _: &State<D, A>) -> HubConstants<D::Scalar> {
        craft.hub
    }

    #[cfg(feature = "alloc")]
    fn visit_members<D: Devices>(
        craft: &Spacecraft<D>,
        data: <Moving as Bundle<D::Scalar>>::Of<'_, D>,
        members: &mut Members<D::Scalar>,
    ) -> Result<(), NotEmitted> {
        D::visit::<Moving, _>(&craft.devices, data, members)
    }

    fn coordinates<T: Scalar>((): &mut ()) -> [&mut [T]; 2] {
        [&mut [], &mut []]
    }

    fn forces<T: Scalar>((): &mut ()) -> &mut [T] {
        &mut []
    }

    fn wrenches<T: Scalar>((): &mut ()) -> &mut [Wrench<T>] {
        &mut []
    }

    fn modal_accelerations<T: Scalar>((): &()) -> &[T] {
        &[]
    }
}
