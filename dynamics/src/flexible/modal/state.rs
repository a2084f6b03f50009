//! [`ModalState`] and [`ModalAccelerations`]: what a flexible structure adds to state and
//! accelerations.

use core::fmt::Debug;

use crate::flexible::modal::storage::ModalStorage;

/// Modal coordinates and their rates: [`State::modal`](crate::State::modal) of a flexible structure.
#[derive(Clone, Copy, Debug)]
pub struct ModalState<M: ModalStorage, T: Clone + Debug = f64> {
    /// `eta`, modal coordinates, m sqrt(kg).
    pub eta: M::Modes<T>,
    /// `eta'`, their rates, m sqrt(kg)/s.
    pub eta_dot: M::Modes<T>,
}

/// Second derivatives of the modal coordinates:
/// [`Accelerations::modal`](crate::Accelerations::modal) of a flexible structure.
#[derive(Clone, Copy, Debug)]
pub struct ModalAccelerations<M: ModalStorage, T: Clone + Debug = f64> {
    /// `eta''`, m sqrt(kg)/s².
    pub eta_ddot: M::Modes<T>,
}

impl<M: ModalStorage, T: Clone + Debug + PartialEq> PartialEq for ModalState<M, T> {
    fn eq(&self, other: &Self) -> bool {
        self.eta.as_ref() == other.eta.as_ref() && self.eta_dot.as_ref() == other.eta_dot.as_ref()
    }
}

impl<M: ModalStorage, T: Clone + Debug + PartialEq> PartialEq for ModalAccelerations<M, T> {
    fn eq(&self, other: &Self) -> bool {
        self.eta_ddot.as_ref() == other.eta_ddot.as_ref()
    }
}
