//! The longest step at which Runge-Kutta's method of fourth order is stable with a structure and
//! what stands on it: modes, springs, dampers and friction together, with the joints driven,
//! prescribed or locked as they are and the hub free or held, in the pose at the start of the step.
//!
//! A step is checked by whether the mass matrix of hub, modes and joints less shares of damping and
//! stiffness is positive definite ([`longest_step`](crate::integrate::longest_step)). Joints are
//! eliminated into the equations of their mounts, as in an evaluation. First every mode is taken to
//! be as fast as the fastest one: then the matrix is that of the modal directions, which a step
//! that resolves the modes passes. Otherwise every mode is a direction of its own.
//!
//! Where no joint has a spring or friction, devices make no vibration faster than it is without
//! them: their kinetic energy is not below zero. So a step that the structure allows without any
//! device, [`OwnLimit`], needs no further check.

use crate::attitude::parameterisation::Attitude;
use crate::attitude::quaternion::Quaternion;
use crate::equations::assembly::Assembly;
use crate::equations::error::SolveError;
use crate::equations::joint_inputs::Environment;
use crate::equations::mass_reduction::MassReduction;
use crate::equations::system::Solution;
use crate::flexible::equations::basis::Basis;
use crate::flexible::equations::block::Six;
use crate::flexible::equations::condense::Condensed;
use crate::flexible::equations::devices::MountStage;
use crate::flexible::equations::spacecraft::{negative, nothing};
use crate::flexible::modal::storage::{Flexible, ModalStorage};
use crate::integrate::longest_step::{StepLimit, irregular, is_stable, step_limit};
use crate::integrate::stability::{ITERATIONS, largest};
use crate::model::mode::HubMode;
use crate::numbers::each::Each;
use crate::numbers::real::{Real, Scalar, one, zero};
use crate::numbers::vec3::zeros;
use crate::sets::devices::Devices;
use crate::sets::per_device as data;
use crate::solve::diagnosis::overflow;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};

/// Share of [`OwnLimit`] up to which a step is accepted: the deformation moves mass, to first order.
const UNDEFORMED: f64 = 0.95;

/// First step tried for [`OwnLimit`], times the fastest rate of a mode, and the factor from one to
/// the next.
const FIRST: f64 = 2.8;
const NEXT: f64 = 0.92;

/// How many are tried: down to an eighth.
const TRIES: usize = 26;

/// Steps that are stable without devices, on a free hub and on one that is held, s; zero where none
/// was found.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OwnLimit<T> {
    pub(crate) free: T,
    pub(crate) held: T,
}

/// A state at rest whose vibrations are looked at: pose, modes of the joints and of the hub, and
/// the equations of the mounts with the joints eliminated.
struct Vibrations<'a, D: Devices, M: ModalStorage, A> {
    craft: &'a Spacecraft<D, Flexible<M>>,
    posed: State<D, A, Flexible<M>>,
    unforced: Inputs<D, Flexible<M>>,
}

/// Equations of the mounts, and the gains of the joints eliminated into them.
type Reduced<D, M> = (
    <M as ModalStorage>::Mounts<MountStage<<D as crate::sets::devices::DeviceSet>::Scalar>>,
    <D as crate::sets::devices::DeviceSet>::Per<data::Gains>,
);

impl<D: Devices, M: ModalStorage> Spacecraft<D, Flexible<M>> {
    /// Steps that are stable without devices.
    pub(crate) fn own_limit(&self) -> OwnLimit<D::Scalar> {
        OwnLimit { free: self.own_limit_on(true), held: self.own_limit_on(false) }
    }

    fn own_limit_on(&self, hub_is_free: bool) -> D::Scalar {
        let mut rate = zero::<D::Scalar>();
        for [stiffness, damping] in self.structure.passive.as_ref() {
            rate = rate.max(stiffness.sqrt()).max(*damping);
        }
        if rate == zero() {
            return rate.recip();
        }
        // Residual coordinates have no mass without devices.
        if self.massive() < self.modes() {
            return zero();
        }
        let state = State::<D, Quaternion<D::Scalar>, Flexible<M>>::at_rest_for(self);
        let still = Environment { omega: zeros(), central: None, impulse: true, reduction: None };
        let stages = M::per_mount(&self.structure.mounts, |mount| {
            let (motion, environment) = mount.surroundings(&state, &still);
            let body = mount.contained.as_ref().map_or_else(nothing, negative);
            MountStage { motion, environment, assembly: Assembly::new(&body, zeros(), zeros()) }
        });
        let inputs = Inputs::none_for(self);
        let mut dt = D::Scalar::from_f64(FIRST) * rate.recip();
        for _ in 0..TRIES {
            let stable = is_stable(dt, |reduction| {
                self.is_definite(&state, &inputs, stages.as_ref(), reduction, hub_is_free)
            });
            if stable {
                return dt;
            }
            dt = D::Scalar::from_f64(NEXT) * dt;
        }
        zero()
    }

    /// Whether a step is stable without devices and no joint has a spring or friction.
    pub(crate) fn is_within_own_limit(
        &self,
        inputs: &Inputs<D, Flexible<M>>,
        dt: D::Scalar,
    ) -> bool {
        let own = match inputs.hub {
            HubMode::Free => self.structure.own_limit.free,
            HubMode::Fixed | HubMode::Prescribed { .. } => self.structure.own_limit.held,
        };
        !self.passive && dt.abs() <= D::Scalar::from_f64(UNDEFORMED) * own
    }

    /// Rejects a step that is too long for the fastest vibration, in this pose.
    #[cold]
    pub(crate) fn check_vibrations<A: Attitude<D::Scalar>>(
        &self,
        posed: &State<D, A, Flexible<M>>,
        inputs: &Inputs<D, Flexible<M>>,
        dt: D::Scalar,
    ) -> Result<(), SolveError<D::Scalar>> {
        let mut posed = posed.clone();
        posed.modal.eta_dot.as_mut().fill(zero());
        let unforced = self.without_forces(inputs);
        let vibrations = Vibrations { craft: self, posed, unforced };
        let limit = step_limit(dt, |reduction| vibrations.are_slower(reduction));
        let Some(limit) = limit else { return Ok(()) };
        let longest = limit.longest;
        if longest == zero() {
            return Err(overflow());
        }
        Err(match vibrations.limiting_joint(&limit) {
            Some((device, joint)) => SolveError::Unstable { device, joint, dt, longest },
            None => SolveError::UnstableModes { dt, longest },
        })
    }

    /// Whether the mass matrix less shares of damping and stiffness is positive definite, for the
    /// equations of the mounts.
    fn is_definite<A: Attitude<D::Scalar>>(
        &self,
        posed: &State<D, A, Flexible<M>>,
        unforced: &Inputs<D, Flexible<M>>,
        stages: &[MountStage<D::Scalar>],
        reduction: &MassReduction<D::Scalar>,
        hub_is_free: bool,
    ) -> bool {
        let structure = self.structure(posed, unforced, zeros());
        let definite = |basis: &Basis<M, D::Scalar>, largest: Option<D::Scalar>| {
            let projected = M::modes(basis.count, &zero());
            let mut condensed = Condensed::new(&structure, basis, &projected);
            let massive = basis.count.saturating_sub(basis.residual);
            let residual = self.reductions(reduction).skip(self.massive());
            match largest {
                Some(largest) => {
                    let same = core::iter::repeat_n(largest, massive);
                    condensed.reduce(same.chain(residual));
                }
                None => condensed.reduce(self.reductions(reduction)),
            }
            self.add_mounts_to(&mut condensed, stages, basis);
            condensed.is_definite(hub_is_free)
        };
        if self.structure.basis.is_of_modes() {
            return definite(&self.structure.basis, None);
        }
        let massive = self.reductions(reduction).take(self.massive());
        let largest = massive.reduce(Scalar::max).unwrap_or_else(zero);
        if largest < one() && definite(&self.structure.basis, Some(largest)) {
            return true;
        }
        definite(&self.basis_of_modes(), None)
    }

    /// What is subtracted from the mass of each mode.
    fn reductions(&self, reduction: &MassReduction<D::Scalar>) -> impl Iterator<Item = D::Scalar> {
        let reduction = *reduction;
        let passive = self.structure.passive.as_ref().iter();
        passive.map(move |[stiffness, damping]| reduction.subtracted(*damping, *stiffness))
    }

    /// Every mode as a direction.
    fn basis_of_modes(&self) -> Basis<M, D::Scalar> {
        let shapes = M::per_mount(&self.structure.mounts, |mount| -> M::Modes<Six<D::Scalar>> {
            mount.shapes.clone()
        });
        Basis::of_modes(
            &shapes,
            &self.structure.momenta,
            self.modes().saturating_sub(self.massive()),
        )
    }
}

impl<D: Devices, M: ModalStorage, A: Attitude<D::Scalar>> Vibrations<'_, D, M, A> {
    /// Whether every vibration is below the limits of a reduction: the reduced mass matrix is
    /// positive definite.
    fn are_slower(&self, reduction: &MassReduction<D::Scalar>) -> bool {
        let Self { craft, posed, unforced } = self;
        let Ok((stages, _)) = self.reduced(unforced, reduction) else { return false };
        let free = unforced.hub == HubMode::Free;
        craft.is_definite(posed, unforced, stages.as_ref(), reduction, free)
    }

    /// The joints eliminated into the equations of their mounts, for torques.
    fn reduced(
        &self,
        forces: &Inputs<D, Flexible<M>>,
        reduction: &MassReduction<D::Scalar>,
    ) -> Result<Reduced<D, M>, SolveError<D::Scalar>> {
        let Self { craft, posed, .. } = self;
        let reduction = Some(*reduction);
        let still = Environment { omega: zeros(), central: None, impulse: true, reduction };
        let mut stages = craft.stages(posed, forces, &still);
        let mut gains = D::new_data(&craft.devices, &data::Gains);
        craft.eliminate(craft.arithmetic, posed, forces, stages.as_mut(), &mut gains)?;
        Ok((stages, gains))
    }

    /// Accelerations for torques and modal forces, with the mass matrix reduced.
    fn response_to(
        &self,
        forces: &Inputs<D, Flexible<M>>,
        reduction: &MassReduction<D::Scalar>,
    ) -> Result<Accelerations<D, Flexible<M>>, SolveError<D::Scalar>> {
        let Self { craft, posed, .. } = self;
        let (stages, gains) = self.reduced(forces, reduction)?;
        let structure = craft.structure(posed, forces, zeros());
        let basis = craft.basis_of_modes();
        let mut condensed = Condensed::new(&structure, &basis, &forces.modal.forces);
        condensed.reduce(craft.reductions(reduction));
        craft.add_mounts_to(&mut condensed, stages.as_ref(), &basis);
        let given = match forces.hub {
            HubMode::Free => None,
            HubMode::Fixed | HubMode::Prescribed { .. } => {
                Some(Solution { r_b_n_ddot: zeros(), omega_dot: zeros() })
            }
        };
        let mut found = craft.no_accelerations();
        let (hub, eta_ddot) = condensed.unchecked(given);
        found.modal.eta_ddot = eta_ddot;
        craft.substitute_joints(stages.as_ref(), &hub, &gains, &mut found);
        Ok(found)
    }

    /// The joint that has most of the energy of the vibration that limits a step; none where the
    /// modes have more than all joints.
    fn limiting_joint(&self, limit: &StepLimit<D::Scalar>) -> Option<(usize, &'static str)> {
        let (craft, reduction) = (self.craft, &limit.reduction);
        let mut forces = self.unforced.clone();
        let of_joints = || craft.weights(&self.posed, reduction);
        let stiffness = reduction.stiffness.max(zero());
        let taken = MassReduction { stiffness, ..*reduction };
        let of_modes = || craft.reductions(&taken);
        let mut irregular = irregular::<D::Scalar>();
        let motors = forces.motors.values_mut().zip(of_joints());
        let modal = forces.modal.forces.as_mut().iter_mut().zip(of_modes());
        for ((force, weight), number) in motors.chain(modal).zip(&mut irregular) {
            *force = weight.sqrt() * number;
        }
        for _ in 0..ITERATIONS {
            let Ok(found) = self.response_to(&forces, reduction) else { break };
            let mut energy = zero::<D::Scalar>();
            let joints = found.devices.values().zip(of_joints());
            let motors = forces.motors.values_mut().zip(joints);
            let modes = found.modal.eta_ddot.as_ref().iter().copied().zip(of_modes());
            let modal = forces.modal.forces.as_mut().iter_mut().zip(modes);
            for (force, (acceleration, weight)) in motors.chain(modal) {
                *force = weight * acceleration;
                energy = energy + *force * acceleration;
            }
            let over = energy.sqrt().recip();
            let motors = forces.motors.values_mut();
            motors.chain(forces.modal.forces.as_mut()).for_each(|force| *force = *force * over);
        }
        let energy = |(force, weight): (D::Scalar, D::Scalar)| {
            if weight > zero() { force * force * weight.recip() } else { zero() }
        };
        let sum = |sum: D::Scalar, energy| sum + energy;
        let joints = || forces.motors.values().zip(of_joints()).map(energy);
        let modes = forces.modal.forces.as_ref().iter().copied().zip(of_modes()).map(energy);
        if modes.fold(zero(), sum) > joints().fold(zero(), sum) {
            return None;
        }
        let most = largest(joints().zip(craft.joints()));
        most.map(|(_, (device, info))| (device, info.body))
    }
}
