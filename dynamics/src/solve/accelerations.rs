//! All accelerations from state and inputs.
//!
//! Devices meet only in the hub's six equations: each is eliminated into them, they are solved, and
//! each device's own accelerations follow. The number of devices is a loop bound and nothing else.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use crate::attitude::parameterisation::Attitude;
use crate::equations::assembly::Assembly;
use crate::equations::error::SolveError;
use crate::equations::gravity::{Gravity, at_b};
use crate::equations::joint_inputs::Environment;
#[cfg(feature = "lanes")]
use crate::equations::side_by_side::gains::GroupGains;
use crate::equations::stiffness::Stiffness;
use crate::equations::system::Solution;
use crate::model::mode::HubMode;
use crate::numbers::each::{Each, JointStates};
use crate::numbers::real::{Scalar, filling, zero};
use crate::numbers::vec3::{Vec3, add, columns, components, extreme, finite, sub, vector, zeros};
use crate::sets::devices::{Devices, SetInputs};
use crate::sets::per_device as data;
use crate::solve::diagnosis::overflow;
use crate::solve::elimination::{Eliminate, Eliminated, Elimination, back_substitute, substitute};
use crate::solve::finite::all_finite;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};
use crate::solve::structure::StructureEquations;

impl<D: Devices, S: StructureEquations> Spacecraft<D, S> {
    /// All second derivatives of the state: six numbers, one per joint, from (16), (75), (80), (101),
    /// (119), and one per mode of a flexible structure, (F9).
    ///
    /// A joint that is [prescribed or locked](crate::Mode), and a hub that is
    /// [fixed or prescribed](crate::HubMode), has its prescribed acceleration; [`Self::loads`]
    /// computes the torque or wrench that this needs.
    ///
    /// # Errors
    ///
    /// [`SolveError::Singular`] where a driven joint or the hub is left without inertia,
    /// [`SolveError::NotFinite`] naming the first input that is infinite or NaN (also one that the
    /// accelerations do not depend on, such as the position), [`SolveError::Overflow`] naming the
    /// acceleration that is not finite though every input is, [`SolveError::LockedJointMoves`] and
    /// [`SolveError::FixedHubMoves`] where what is locked moves, [`SolveError::NotDriven`] where a
    /// joint's kind does not have its mode, [`SolveError::Count`] for a list of another length. Of a
    /// flexible structure [`SolveError::ModalMass`] where what the model contains at the mounts leaves
    /// a mode without mass, and [`SolveError::ModalCount`].
    #[inline]
    pub fn accelerations<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
    ) -> Result<Accelerations<D, S>, SolveError<D::Scalar>> {
        self.accelerations_by(self.arithmetic, state, inputs)
    }

    /// [`Self::accelerations`], each device eliminated `by` this.
    #[inline]
    pub(crate) fn accelerations_by<A: Attitude<D::Scalar>>(
        &self,
        by: impl Eliminate<D::Scalar>,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
    ) -> Result<Accelerations<D, S>, SolveError<D::Scalar>> {
        if !self.are_finite(state, inputs) {
            return Err(self.diagnosis(state, inputs, overflow()));
        }
        let mut found = self.no_accelerations();
        match S::solve(self, by, state, inputs, &mut found, None) {
            Ok(()) => Ok(found),
            Err(failure) => Err(self.diagnosis(state, inputs, failure)),
        }
    }

    /// [`Self::accelerations`] without diagnosis, written to `found`: moving a structure just
    /// written takes time. The stiffness of springs and friction is written too, if requested.
    #[inline(always)]
    pub(crate) fn solve<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        found: &mut Accelerations<D, S>,
        stiffness: Option<&mut Stiffness<D::Scalar>>,
    ) -> Result<(), SolveError<D::Scalar>> {
        S::solve(self, self.arithmetic, state, inputs, found, stiffness)
    }

    /// Those of a hub that does not deform.
    pub(crate) fn solve_rigid<A: Attitude<D::Scalar>>(
        &self,
        by: impl Eliminate<D::Scalar>,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        found: &mut Accelerations<D, S>,
        stiffness: Option<&mut Stiffness<D::Scalar>>,
    ) -> Result<(), SolveError<D::Scalar>> {
        check_fixed(state, inputs)?;
        let start = evaluation_start(state, inputs);
        let EvaluationStart { environment, at_b } = &start;
        let mut assembly = self.assembly(inputs);
        let mut scratch = D::new_data(&self.devices, &data::Gains);
        let mut elimination = Elimination::new(environment, &mut assembly, 0, by);
        #[cfg(feature = "lanes")]
        let mut groups = GroupGains::none();
        #[cfg(feature = "lanes")]
        {
            elimination.groups = Some(&mut groups);
        }
        let data = (&state.devices, inputs.of_joints(), &mut scratch);
        D::visit::<Eliminated, _>(&self.devices, data, &mut elimination)?;
        let hub = self.hub_accelerations(inputs, environment, &mut assembly, *at_b)?;
        #[cfg(feature = "lanes")]
        let groups = Some(&mut groups);
        #[cfg(not(feature = "lanes"))]
        let groups = None;
        let finite = substitute::<D>(&self.devices, &scratch, &hub, &mut found.devices, groups);
        if let Some(stiffness) = stiffness {
            *stiffness = self.stiffness(inputs, &assembly);
        }
        found.finish(inputs, &hub, *at_b, finite)
    }

    /// Whether what the accelerations may not depend on is finite, and the structure's part of state
    /// and inputs.
    #[inline(always)]
    pub(crate) fn are_finite<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
    ) -> bool {
        inputs_are_finite(state, inputs) && S::are_finite(self, &state.modal, &inputs.modal)
    }

    /// Accelerations to be filled in.
    pub(crate) fn no_accelerations(&self) -> Accelerations<D, S> {
        let still = vector([filling(zero()); 3]);
        let devices = D::new_data(&self.devices, &data::Accelerations);
        let modal = S::no_accelerations(self);
        Accelerations { r_b_n_ddot: still, omega_dot: still, devices, modal }
    }

    /// The hub's system before any device is evaluated.
    #[inline]
    pub(crate) fn assembly(&self, inputs: &Inputs<D, S>) -> Assembly<D::Scalar> {
        Assembly::new(&self.body, components(&inputs.force), components(&inputs.torque_b))
    }

    /// The hub's accelerations once every device is eliminated, in the frame that falls with the
    /// field at B, where there is no uniform one.
    #[inline(always)]
    pub(crate) fn hub_accelerations(
        &self,
        inputs: &Inputs<D, S>,
        environment: &Environment<D::Scalar>,
        assembly: &mut Assembly<D::Scalar>,
        at_b: Vec3<D::Scalar>,
    ) -> Result<Solution<D::Scalar>, SolveError<D::Scalar>> {
        if let Some(central) = environment.central {
            let second = self.hub.second_moment();
            let (force, moment) = central.wrench(self.hub.first_moment, &second);
            let whole = central.third_order(&assembly.second_moment.plus(second));
            assembly.add_wrench(add(force, whole), moment);
        }
        let hub = match &inputs.hub {
            HubMode::Free => assembly.solve(environment.omega, &self.body)?,
            HubMode::Fixed => Solution { r_b_n_ddot: sub(zeros(), at_b), omega_dot: zeros() },
            HubMode::Prescribed { r_b_n_ddot, omega_dot } => Solution {
                r_b_n_ddot: sub(components(r_b_n_ddot), at_b),
                omega_dot: components(omega_dot),
            },
        };
        if hub.is_finite() { Ok(hub) } else { Err(overflow()) }
    }

    /// Stiffness of springs and friction, estimated once every device is eliminated. Factorises the
    /// hub's system once more, so that other evaluations need not keep its pivots.
    #[inline(never)]
    pub(crate) fn stiffness(
        &self,
        inputs: &Inputs<D, S>,
        assembly: &Assembly<D::Scalar>,
    ) -> Stiffness<D::Scalar> {
        match inputs.hub {
            HubMode::Free => {
                let (_, pivots) = assembly.system(zeros()).solved();
                assembly.stiffness.on_free_hub(pivots, assembly.scale(&self.body))
            }
            HubMode::Fixed | HubMode::Prescribed { .. } => assembly.stiffness,
        }
    }

    /// Eliminates every device, keeps what back substitution needs, adds to the hub.
    #[inline(always)]
    pub(crate) fn eliminate_devices<A>(
        &self,
        by: impl Eliminate<D::Scalar>,
        state: &State<D, A, S>,
        given: SetInputs<'_, D>,
        environment: &Environment<D::Scalar>,
        assembly: &mut Assembly<D::Scalar>,
        scratch: &mut D::Per<data::Gains>,
    ) -> Result<(), SolveError<D::Scalar>> {
        let mut elimination = Elimination::new(environment, assembly, 0, by);
        let data = (&state.devices, given, scratch);
        D::visit::<Eliminated, _>(&self.devices, data, &mut elimination)
    }

    /// The accelerations of every device's joints, checked finite.
    pub(crate) fn back_substitute(
        &self,
        scratch: &D::Per<data::Gains>,
        hub: &Solution<D::Scalar>,
    ) -> Result<D::Per<data::Accelerations>, SolveError<D::Scalar>> {
        let mut found = D::new_data(&self.devices, &data::Accelerations);
        let finite = back_substitute::<D>(&self.devices, scratch, hub, &mut found);
        if finite { Ok(found) } else { Err(overflow()) }
    }
}

/// What is known before any device is evaluated.
pub(crate) struct EvaluationStart<T> {
    pub(crate) environment: Environment<T>,
    /// The field at B.
    pub(crate) at_b: Vec3<T>,
}

/// The start of an evaluation: motion of the hub and gravity for the devices. A fixed hub that moves
/// is for [`check_fixed`] to reject: within a [`Result`], the start is written twice.
#[inline(always)]
pub(crate) fn evaluation_start<D: Devices, A: Attitude<D::Scalar>, S: StructureEquations>(
    state: &State<D, A, S>,
    inputs: &Inputs<D, S>,
) -> EvaluationStart<D::Scalar> {
    let environment = Environment {
        omega: components(&state.omega),
        central: None,
        impulse: false,
        reduction: None,
    };
    let mut start = EvaluationStart { environment, at_b: zeros() };
    if !matches!(inputs.gravity, Gravity::None) {
        let field = inputs.gravity.field(&columns(&state.attitude.dcm()), &state.r_b_n);
        start.at_b = at_b(field.as_ref());
        start.environment.central = field.and_then(|field| field.central);
    }
    start
}

impl<D: Devices, S: StructureEquations> Accelerations<D, S> {
    /// Fills the hub's in, no longer relative to the frame that falls with it; all must be finite.
    #[inline]
    pub(crate) fn finish(
        &mut self,
        inputs: &Inputs<D, S>,
        hub: &Solution<D::Scalar>,
        at_b: Vec3<D::Scalar>,
        joints_are_finite: bool,
    ) -> Result<(), SolveError<D::Scalar>> {
        self.r_b_n_ddot = match &inputs.hub {
            HubMode::Free => vector(add(hub.r_b_n_ddot, at_b)),
            HubMode::Fixed => vector(zeros()),
            HubMode::Prescribed { r_b_n_ddot, .. } => *r_b_n_ddot,
        };
        self.omega_dot = vector(hub.omega_dot);
        if finite(components(&self.r_b_n_ddot)) && joints_are_finite {
            Ok(())
        } else {
            Err(overflow())
        }
    }
}

/// Rejects a fixed hub that moves.
pub(crate) fn check_fixed<D: Devices, A, S: StructureEquations>(
    state: &State<D, A, S>,
    inputs: &Inputs<D, S>,
) -> Result<(), SolveError<D::Scalar>> {
    if inputs.hub != HubMode::Fixed {
        return Ok(());
    }
    let [x, y, z] = components(&state.r_b_n_dot);
    let [p, q, r] = components(&state.omega);
    let value = extreme([x, y, z, p, q, r]);
    if value == zero() { Ok(()) } else { Err(SolveError::FixedHubMoves { value }) }
}

/// Whether the rates are finite: on a free hub they show in its accelerations, on a held one they
/// may show nowhere.
fn rates_are_finite<D: Devices, A, S: StructureEquations>(state: &State<D, A, S>) -> bool {
    finite(components(&state.omega)) && state.devices.states().all(|[_, rate]| rate.is_finite())
}

/// Whether what the accelerations may not depend on is finite: the position, forces and rates on a
/// hub that is held, motors of joints that are. All else shows in the result.
fn inputs_are_finite<D: Devices, A: Attitude<D::Scalar>, S: StructureEquations>(
    state: &State<D, A, S>,
    inputs: &Inputs<D, S>,
) -> bool {
    all_finite([&state.r_b_n, &state.r_b_n_dot, &inputs.force, &inputs.torque_b])
        && state.attitude.is_valid()
        && inputs.motors.values().all(Scalar::is_finite)
        && inputs.bodies.iter().flat_map(Each::values).all(|wrench| wrench.is_finite())
        && (matches!(inputs.hub, HubMode::Free) || rates_are_finite(state))
}
