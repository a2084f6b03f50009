//! The impulsive stop: joints stopped impulsively, as by a rigid brake.
//!
//! Velocities jump, positions do not. Over the jump finite forces do nothing; what acts are the
//! impulses of the brakes, inside the spacecraft, so momentum is conserved and energy is lost. With
//! M the mass matrix of the pose, `M Δ = impulses`, which is the equations of motion at rest with
//! jumps for accelerations: the same kernels compute them.

use crate::attitude::parameterisation::Attitude;
use crate::equations::arithmetic::Arithmetic;
use crate::equations::assembly::Assembly;
use crate::equations::error::{Quantity, SolveError};
use crate::equations::joint_inputs::{Environment, JointInputs};
use crate::equations::mass_reduction::MassReduction;
use crate::equations::system::Solution;
use crate::integrate::energy_lost::{Jump, Jumped, energy_lost, jumped, prescribed, sum};
use crate::integrate::structure::StructureSteps;
use crate::model::mode::HubMode;
use crate::numbers::vec3::{columns, components, neg, rotate, zeros};
use crate::sets::counts::check_counts;
use crate::sets::devices::Devices;
use crate::sets::per_device as data;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::State;
use crate::solve::structure::{Rigid, StructureData};

/// The state after an impulsive stop, and the energy lost.
#[derive(Clone, Debug, PartialEq)]
pub struct Stopped<D: Devices, A, S: StructureData = Rigid> {
    /// The state with its new velocities; every locked joint is at rest.
    pub state: State<D, A, S>,
    /// Kinetic energy before less kinetic energy after, J: heat in the brakes. Not below zero unless
    /// a joint or the hub is prescribed. Of the velocities' jump and not the difference of two
    /// energies, so no digit is lost to what keeps moving.
    pub energy_lost: D::Scalar,
}

impl<D: Devices, S: StructureSteps> Spacecraft<D, S> {
    /// Stops every joint that `inputs` has locked, and the hub if it is fixed, impulsively.
    ///
    /// Driven joints and the modes of a flexible structure take what impulse reaches them through the
    /// structure, prescribed joints keep their rates. Linear and angular momentum stay, unless the hub is fixed or prescribed; energy
    /// is lost.
    ///
    /// ```
    /// # use nalgebra::{Matrix3, Vector3};
    /// use precess_dynamics::{About, Hub, Inputs, Mode, ReactionWheel, Spacecraft, State};
    ///
    /// let disc = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
    /// let hub = Hub { m_b: 50.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() };
    /// let craft = Spacecraft::new(&hub, &[ReactionWheel::bare_wheel(4.0, disc)])?;
    /// let mut state: State<[ReactionWheel; 1]> = State::at_rest();
    /// state.devices[0].spin = 100.0;
    /// let before = craft.momentum(&state, About::CentreOfMass)?;
    ///
    /// let mut brake: Inputs<[ReactionWheel; 1]> = Inputs::none();
    /// brake.modes[0].wheel = Mode::Locked;
    /// assert!(craft.accelerations(&state, &brake).is_err()); // it still turns
    /// let stopped = craft.stop(&state, &brake)?;
    /// assert_eq!(stopped.state.devices[0].spin, 0.0);
    /// assert!(stopped.energy_lost > 800.0); // of 1000 J
    /// let after = craft.momentum(&stopped.state, About::CentreOfMass)?;
    /// assert!((after.angular - before.angular).norm() < 1e-14 * before.angular.norm());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Self::accelerations`], but a moving joint may be locked.
    pub fn stop<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
    ) -> Result<Stopped<D, A, S>, SolveError<D::Scalar>> {
        self.reject(state, inputs)?;
        let Jumped { after: next, jump } = S::jump(self, state, inputs)
            .map_err(|failure| self.diagnosis(state, inputs, failure))?;
        let velocities = (&jump, &prescribed(&next, inputs));
        let energy_lost = energy_lost(velocities, |state| self.energy(state), sum)?;
        self.check_reached(&next)?;
        Ok(Stopped { state: next, energy_lost })
    }

    /// The jump of the velocities on a hub that does not deform.
    pub(crate) fn jump_rigid<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
    ) -> Jump<State<D, A, S>, D::Scalar> {
        let (still, motors) = (zeros(), D::new_data(&self.devices, &data::Motors));
        check_counts::<D>(&self.devices, &state.devices, Some(inputs.of_joints()), None)?;
        let mut scratch = D::new_data(&self.devices, &data::Gains);
        let assembly = self.eliminate_for_impulses(state, &motors, inputs, None, &mut scratch)?;
        let bn = columns(&state.attitude.dcm());
        let velocity = rotate(&bn, components(&state.r_b_n_dot));
        let hub = match inputs.hub {
            HubMode::Free => assembly.solve(still, &self.body)?,
            HubMode::Fixed => {
                Solution { r_b_n_ddot: neg(velocity), omega_dot: neg(components(&state.omega)) }
            }
            HubMode::Prescribed { .. } => Solution { r_b_n_ddot: still, omega_dot: still },
        };
        if !hub.is_finite() {
            return Err(SolveError::Overflow { what: Quantity::HubAcceleration });
        }
        let jumps = self.back_substitute(&scratch, &hub)?;
        Ok(jumped(state, inputs, &bn, &hub, &jumps))
    }

    /// Eliminates every joint where velocities jump and nothing acts but impulses at the motors;
    /// with shares of damping and stiffness subtracted from the mass matrix, if any.
    pub(super) fn eliminate_for_impulses<A>(
        &self,
        state: &State<D, A, S>,
        motors: &D::Per<data::Motors>,
        inputs: &Inputs<D, S>,
        reduction: Option<MassReduction<D::Scalar>>,
        scratch: &mut D::Per<data::Gains>,
    ) -> Result<Assembly<D::Scalar>, SolveError<D::Scalar>> {
        let environment = Environment { omega: zeros(), central: None, impulse: true, reduction };
        let given = JointInputs { motors, modes: &inputs.modes, bodies: None };
        let mut assembly = Assembly::new(&self.body, zeros(), zeros());
        let by = Arithmetic::detected();
        self.eliminate_devices(by, state, given, &environment, &mut assembly, scratch)?;
        Ok(assembly)
    }
}
