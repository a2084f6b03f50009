//! The impulsive stop on a structure that bends: joints stopped impulsively, as by a rigid brake.
//!
//! As on a rigid hub, velocities jump, positions and the deformation do not, and `M Δ = impulses`
//! is the equations of motion at rest, with jumps for accelerations, (F9). The rates of the modes
//! jump too: an impulse at a mount starts them.

use crate::attitude::parameterisation::Attitude;
use crate::equations::error::SolveError;
use crate::equations::gravity::Gravity;
use crate::equations::joint_inputs::Environment;
use crate::equations::system::Solution;
use crate::flexible::inputs::FlexibleInputs;
use crate::flexible::spacecraft::FlexibleSpacecraft;
use crate::flexible::state::FlexibleState;
use crate::flexible::storage::ModalStorage;
use crate::integrate::energy_lost::{Jump, Jumped, energy_lost, jumped, prescribed, sum};
use crate::model::mode::HubMode;
use crate::model::wrench::Wrench;
use crate::numbers::each::Each;
use crate::numbers::real::zero;
use crate::numbers::vec3::{columns, components, neg, rotate, vector, zeros};
use crate::sets::devices::Devices;
use crate::sets::per_device as data;
use crate::solve::accelerations::overflow;

/// The state of a [`FlexibleSpacecraft`] after an impulsive stop, and the energy lost.
#[derive(Clone, Debug)]
pub struct FlexibleStopped<D: Devices, S: ModalStorage, A> {
    /// The state with its new velocities; every locked joint is at rest.
    pub state: FlexibleState<D, S, A>,
    /// Kinetic energy before less kinetic energy after, J: heat in the brakes. Not below zero unless
    /// a joint or the hub is prescribed. Of the velocities' jump and not the difference of two
    /// energies, so no digit is lost to what keeps moving.
    pub energy_lost: D::Scalar,
}

impl<D: Devices, S: ModalStorage> FlexibleSpacecraft<D, S> {
    /// Stops every joint that `inputs` has locked, and the frame B if it is fixed, impulsively.
    ///
    /// Driven joints and modes take what impulse reaches them through the structure, prescribed
    /// joints keep their rates. Linear and angular momentum stay, unless the hub is fixed or
    /// prescribed; energy is lost.
    ///
    /// # Errors
    ///
    /// As [`Self::accelerations`], but a moving joint may be locked.
    pub fn stop<A: Attitude<D::Scalar>>(
        &self,
        state: &FlexibleState<D, S, A>,
        inputs: &FlexibleInputs<D, S>,
    ) -> Result<FlexibleStopped<D, S, A>, SolveError<D::Scalar>> {
        self.reject(state, inputs)?;
        let Jumped { after: next, jump } =
            self.jump(state, inputs).map_err(|failure| self.diagnosis(state, inputs, failure))?;
        let mut given = next.clone();
        given.rigid = prescribed(&next.rigid, &inputs.rigid);
        given.eta_dot.as_mut().fill(zero());
        let energy_lost = energy_lost((&jump, &given), |state| self.energy(state), both)?;
        self.rigid.check_reached(&next.rigid)?;
        Ok(FlexibleStopped { state: next, energy_lost })
    }

    /// The same modes of the joints and of the hub, and nothing that acts.
    pub(crate) fn without_forces(&self, inputs: &FlexibleInputs<D, S>) -> FlexibleInputs<D, S> {
        let (still, mut unforced) = (zeros(), inputs.clone());
        unforced.rigid.gravity = Gravity::None;
        (unforced.rigid.force, unforced.rigid.torque_b) = (vector(still), vector(still));
        unforced.rigid.motors = D::new_data(&self.rigid.devices, &data::Motors);
        unforced.rigid.bodies = None;
        unforced.modal.as_mut().fill(zero());
        unforced.mounts.as_mut().fill(Wrench::none());
        unforced
    }

    fn jump<A: Attitude<D::Scalar>>(
        &self,
        state: &FlexibleState<D, S, A>,
        inputs: &FlexibleInputs<D, S>,
    ) -> Jump<FlexibleState<D, S, A>, D::Scalar> {
        let (still, impulses) = (zeros(), self.without_forces(inputs));
        let mut posed = state.clone();
        posed.eta_dot.as_mut().fill(zero());

        let environment =
            Environment { omega: still, central: None, impulse: true, reduction: None };
        let mut stages = self.stages(&posed, &impulses, &environment);
        let mut gains = D::new_data(&self.rigid.devices, &data::Gains);
        self.eliminate(&posed, &impulses, stages.as_mut(), &mut gains)?;
        let structure = self.structure(&posed, &impulses, still);
        let bn = columns(&state.rigid.attitude.dcm());
        let velocity = rotate(&bn, components(&state.rigid.r_b_n_dot));
        let omega = components(&state.rigid.omega);
        let given = match inputs.rigid.hub {
            HubMode::Free => None,
            HubMode::Fixed => Some(Solution { r_b_n_ddot: neg(velocity), omega_dot: neg(omega) }),
            HubMode::Prescribed { .. } => Some(Solution { r_b_n_ddot: still, omega_dot: still }),
        };
        let (mut jumps, forces) = (self.no_accelerations(), &impulses.modal);
        let stages = stages.as_ref();
        let hub = self.substitute(stages, &structure, forces, given, &gains, &mut jumps)?;
        if !jumps.rigid.devices.values().all(crate::numbers::real::Scalar::is_finite) {
            return Err(overflow());
        }

        let (mut next, mut jump) = (state.clone(), state.clone());
        let rigid = jumped(&state.rigid, &inputs.rigid, &bn, &hub, &jumps.rigid.devices);
        (next.rigid, jump.rigid) = (rigid.after, rigid.jump);
        for (rate, jump) in next.eta_dot.as_mut().iter_mut().zip(jumps.eta_ddot.as_ref()) {
            *rate = *rate + *jump;
        }
        jump.eta_dot = jumps.eta_ddot;
        Ok(Jumped { after: next, jump })
    }
}

/// The first state with the velocities `a x + b y`.
fn both<D: Devices, S: ModalStorage, A: Attitude<D::Scalar>>(
    (a, x): (D::Scalar, &FlexibleState<D, S, A>),
    (b, y): (D::Scalar, &FlexibleState<D, S, A>),
) -> FlexibleState<D, S, A> {
    let mut found = x.clone();
    found.rigid = sum((a, &x.rigid), (b, &y.rigid));
    for (rate, other) in found.eta_dot.as_mut().iter_mut().zip(y.eta_dot.as_ref()) {
        *rate = a * *rate + b * *other;
    }
    found
}
