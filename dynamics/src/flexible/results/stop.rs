//! The impulsive stop on a flexible structure: joints stopped impulsively, as by a rigid brake.
//!
//! As on a rigid hub, velocities jump, positions and the deformation do not, and `M Δ = impulses`
//! is the equations of motion at rest, with jumps for accelerations, (F9). The rates of the modes
//! jump too: an impulse at a mount starts them.

use crate::attitude::parameterisation::Attitude;
use crate::equations::gravity::Gravity;
use crate::equations::joint_inputs::Environment;
use crate::equations::system::Solution;
use crate::flexible::modal::storage::{Flexible, ModalStorage};
use crate::integrate::energy_lost::{Jump, Jumped, jumped};
use crate::model::mode::HubMode;
use crate::model::wrench::Wrench;
use crate::numbers::each::Each;
use crate::numbers::real::zero;
use crate::numbers::vec3::{columns, components, neg, rotate, vector, zeros};
use crate::sets::devices::Devices;
use crate::sets::per_device as data;
use crate::solve::diagnosis::overflow;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::State;

impl<D: Devices, M: ModalStorage> Spacecraft<D, Flexible<M>> {
    /// The same modes of the joints and of the hub, and nothing that acts.
    pub(crate) fn without_forces(&self, inputs: &Inputs<D, Flexible<M>>) -> Inputs<D, Flexible<M>> {
        let (still, mut unforced) = (zeros(), inputs.clone());
        unforced.gravity = Gravity::None;
        (unforced.force, unforced.torque_b) = (vector(still), vector(still));
        unforced.motors = D::new_data(&self.devices, &data::Motors);
        unforced.bodies = None;
        unforced.modal.forces.as_mut().fill(zero());
        unforced.modal.mounts.as_mut().fill(Wrench::none());
        unforced
    }

    /// The jump of the velocities.
    pub(crate) fn jump_flexible<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, Flexible<M>>,
        inputs: &Inputs<D, Flexible<M>>,
    ) -> Jump<State<D, A, Flexible<M>>, D::Scalar> {
        let (still, impulses) = (zeros(), self.without_forces(inputs));
        let mut posed = state.clone();
        posed.modal.eta_dot.as_mut().fill(zero());

        let environment =
            Environment { omega: still, central: None, impulse: true, reduction: None };
        let mut stages = self.stages(&posed, &impulses, &environment);
        let mut gains = D::new_data(&self.devices, &data::Gains);
        self.eliminate(self.arithmetic, &posed, &impulses, stages.as_mut(), &mut gains)?;
        let structure = self.structure(&posed, &impulses, still);
        let bn = columns(&state.attitude.dcm());
        let velocity = rotate(&bn, components(&state.r_b_n_dot));
        let omega = components(&state.omega);
        let given = match inputs.hub {
            HubMode::Free => None,
            HubMode::Fixed => Some(Solution { r_b_n_ddot: neg(velocity), omega_dot: neg(omega) }),
            HubMode::Prescribed { .. } => Some(Solution { r_b_n_ddot: still, omega_dot: still }),
        };
        let (mut jumps, forces) = (self.no_accelerations(), &impulses.modal.forces);
        let stages = stages.as_ref();
        let hub = self.substitute(stages, &structure, forces, given, &gains, &mut jumps)?;
        if !jumps.devices.values().all(crate::numbers::real::Scalar::is_finite) {
            return Err(overflow());
        }

        let Jumped { after: mut next, mut jump } = jumped(state, inputs, &bn, &hub, &jumps.devices);
        for (rate, jump) in
            next.modal.eta_dot.as_mut().iter_mut().zip(jumps.modal.eta_ddot.as_ref())
        {
            *rate = *rate + *jump;
        }
        jump.modal.eta_dot = jumps.modal.eta_ddot;
        Ok(Jumped { after: next, jump })
    }
}
