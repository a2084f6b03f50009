//! State and accelerations of a structure that bends: those of B and of the joints, and the modal
//! coordinates.

use crate::attitude::parameterisation::Attitude;
use crate::attitude::quaternion::Quaternion;
use crate::flexible::spacecraft::FlexibleSpacecraft;
use crate::flexible::storage::ModalStorage;
use crate::numbers::real::zero;
use crate::sets::devices::{DeviceSet, Devices, FixedSet};
use crate::solve::state::{Accelerations, State};

/// State of a [`FlexibleSpacecraft`].
#[derive(Clone, Debug, PartialEq)]
pub struct FlexibleState<D: Devices, S: ModalStorage, A = Quaternion<<D as DeviceSet>::Scalar>> {
    /// Motion of the floating frame B, and coordinates and rates of the joints, as on a rigid hub.
    pub rigid: State<D, A>,
    /// `eta`, modal coordinates, m sqrt(kg).
    pub eta: S::Modes<D::Scalar>,
    /// `eta'`, their rates, m sqrt(kg)/s.
    pub eta_dot: S::Modes<D::Scalar>,
}

/// All second derivatives of a [`FlexibleState`].
#[derive(Clone, Debug, PartialEq)]
pub struct FlexibleAccelerations<D: Devices, S: ModalStorage> {
    /// Those of B and of the joints; mind the axes that [`Accelerations`] names.
    pub rigid: Accelerations<D>,
    /// `eta''`, m sqrt(kg)/s².
    pub eta_ddot: S::Modes<D::Scalar>,
}

impl<D: Devices, S: ModalStorage, A: Clone> Copy for FlexibleState<D, S, A>
where
    State<D, A>: Copy,
    S::Modes<D::Scalar>: Copy,
{
}

impl<D: Devices, S: ModalStorage> Copy for FlexibleAccelerations<D, S>
where
    Accelerations<D>: Copy,
    S::Modes<D::Scalar>: Copy,
{
}

impl<D: FixedSet, S: ModalStorage, A: Attitude<D::Scalar>> FlexibleState<D, S, A> {
    /// Everything at zero: undeformed, at the inertial origin, nothing moving.
    #[must_use]
    pub fn at_rest(spacecraft: &FlexibleSpacecraft<D, S>) -> Self {
        Self::with(State::at_rest(), spacecraft)
    }
}

impl<D: Devices, S: ModalStorage, A: Attitude<D::Scalar>> FlexibleState<D, S, A> {
    /// As [`FlexibleState::at_rest`], for a set whose devices are known only at run time.
    #[must_use]
    pub fn at_rest_for(spacecraft: &FlexibleSpacecraft<D, S>) -> Self {
        Self::with(State::at_rest_for(&spacecraft.rigid), spacecraft)
    }

    fn with(rigid: State<D, A>, spacecraft: &FlexibleSpacecraft<D, S>) -> Self {
        let still = S::modes(spacecraft.modes(), &zero());
        Self { rigid, eta: still.clone(), eta_dot: still }
    }
}
