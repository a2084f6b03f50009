//! Whether a step is short enough for the springs, dampers and dry friction of the joints.
//!
//! Two checks. [`Stiffness`] costs some operations per joint and bounds the responses from the
//! pivots of an evaluation; a step that is far below the limit by it is accepted. Otherwise the
//! limit is that of the whole system in the pose at the start of the step, with its joints driven,
//! prescribed or locked as they are and the hub free or held: [`step_limit`].

use crate::attitude::parameterisation::Attitude;
use crate::equations::error::SolveError;
use crate::equations::mass_reduction::MassReduction;
use crate::equations::stiffness::Stiffness;
use crate::equations::system::Solution;
use crate::integrate::longest_step::{StepLimit, irregular, step_limit};
use crate::integrate::structure::StructureSteps;
use crate::model::kind::JointInfo;
use crate::model::mode::HubMode;
use crate::model::passive::Passive;
use crate::numbers::each::{Each, JointStates};
use crate::numbers::real::{Real, Scalar, zero};
use crate::numbers::vec3::zeros;
use crate::sets::devices::{Devices, Passives};
use crate::sets::per_device as data;
use crate::solve::diagnosis::overflow;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::State;

/// Inverse iterations for the vibration that limits a step: the first leaves of others some 1e-7 of
/// what an irregular direction has of them.
pub(crate) const ITERATIONS: usize = 3;

/// How a joint's rate has gone during a step: where it began, and its smallest magnitude, zero once
/// it has changed its sign.
type Slowest<T> = [T; 2];

/// The same after another stage.
fn pass<T: Scalar>([first, smallest]: Slowest<T>, rate: T) -> Slowest<T> {
    let size = if rate * first < zero() { zero() } else { rate.abs() };
    [first, if size < smallest { size } else { smallest }]
}

/// Whether friction has to be resolved near rest: the joint has come to rest, or reversed.
fn rests<T: Scalar>([first, smallest]: Slowest<T>, passive: &Passive<T>) -> bool {
    first != zero() && smallest == zero() && passive.coulomb > zero()
}

/// Rates of the joints during a step.
struct SlowestRates<D: Devices>(D::Per<data::PerJoint<Slowest<D::Scalar>>>);

impl<D: Devices> SlowestRates<D> {
    /// At the start.
    pub(crate) fn new<A, S: StructureSteps>(
        craft: &Spacecraft<D, S>,
        start: &State<D, A, S>,
    ) -> Self {
        let mut slowest = D::new_data(&craft.devices, &data::PerJoint([zero(); 2]));
        for (slowest, [_, rate]) in slowest.values_mut().zip(start.devices.states()) {
            *slowest = [rate, rate.abs()];
        }
        Self(slowest)
    }

    /// At another stage, or at the end.
    pub(crate) fn pass<A, S: StructureSteps>(&mut self, stage: &State<D, A, S>) {
        for (slowest, [_, rate]) in self.0.values_mut().zip(stage.devices.states()) {
            *slowest = pass(*slowest, rate);
        }
    }

    /// Whether friction of a joint has to be resolved near rest.
    fn rests<S: StructureSteps>(&self, craft: &Spacecraft<D, S>) -> bool {
        let mut joints = self.0.values().zip(D::list::<Passives>(&craft.devices));
        joints.any(|(slowest, passive)| rests(slowest, &passive))
    }

    /// The state with these rates: those at which friction is stiffest.
    pub(crate) fn at_slowest<A: Clone, S: StructureSteps>(
        &self,
        start: &State<D, A, S>,
    ) -> State<D, A, S> {
        let mut posed = start.clone();
        for ([_, rate], [_, slowest]) in posed.devices.states_mut().zip(self.0.values()) {
            *rate = slowest;
        }
        posed
    }
}

/// Stiffness of springs and friction during a step.
pub(crate) struct PassiveStep<D: Devices> {
    /// Of the present stage.
    stiffness: Stiffness<D::Scalar>,
    /// Of those before it.
    largest: Stiffness<D::Scalar>,
    slowest: SlowestRates<D>,
}

impl<D: Devices> PassiveStep<D> {
    /// At the start.
    pub(crate) fn new<A, S: StructureSteps>(
        craft: &Spacecraft<D, S>,
        start: &State<D, A, S>,
    ) -> Self {
        let none = Stiffness::none(zero());
        Self { stiffness: none, largest: none, slowest: SlowestRates::new(craft, start) }
    }

    /// Before an evaluation: where it leaves its stiffness.
    pub(crate) fn stage<A, S: StructureSteps>(
        &mut self,
        stage: &State<D, A, S>,
    ) -> &mut Stiffness<D::Scalar> {
        self.largest = self.largest.max(self.stiffness);
        self.slowest.pass(stage);
        &mut self.stiffness
    }

    /// Rejects a step that was unstable.
    pub(crate) fn check<A: Attitude<D::Scalar>, S: StructureSteps>(
        mut self,
        craft: &Spacecraft<D, S>,
        start: &State<D, A, S>,
        next: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        dt: D::Scalar,
    ) -> Result<(), SolveError<D::Scalar>> {
        self.stage(next);
        let resolved = self.largest.accepts(dt) && !self.slowest.rests(craft);
        if S::accepts(craft, inputs, dt, resolved) {
            return Ok(());
        }
        S::check_stability(craft, &self.slowest.at_slowest(start), inputs, dt)
    }
}

impl<D: Devices, S: StructureSteps> Spacecraft<D, S> {
    /// Rejects a step that spring, damper or friction of a joint makes unstable on a hub that does not
    /// deform, in this pose; the rates are those at which friction is evaluated.
    #[cold]
    pub(crate) fn check_stability_rigid<A: Attitude<D::Scalar>>(
        &self,
        posed: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        dt: D::Scalar,
    ) -> Result<(), SolveError<D::Scalar>> {
        let mut scratch = D::new_data(&self.devices, &data::Gains);
        let motors = D::new_data(&self.devices, &data::Motors);
        let definite = |reduction: &MassReduction<D::Scalar>| {
            let reduction = Some(*reduction);
            let found =
                self.eliminate_for_impulses(posed, &motors, inputs, reduction, &mut scratch);
            found.is_ok_and(|assembly| match inputs.hub {
                HubMode::Free => {
                    let (_, pivots) = assembly.system(zeros()).solved();
                    pivots.into_iter().all(|pivot| pivot > zero())
                }
                HubMode::Fixed | HubMode::Prescribed { .. } => true,
            })
        };
        let Some(limit) = step_limit(dt, definite) else { return Ok(()) };
        if limit.longest == zero() {
            return Err(overflow());
        }
        let (device, info) = self.limiting_joint(posed, inputs, &limit).ok_or_else(overflow)?;
        Err(SolveError::Unstable { device, joint: info.body, dt, longest: limit.longest })
    }

    /// The joint that has most of the energy of the vibration that limits a step.
    fn limiting_joint<A: Attitude<D::Scalar>>(
        &self,
        posed: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        limit: &StepLimit<D::Scalar>,
    ) -> Option<(usize, &'static JointInfo)> {
        let mut motors = D::new_data(&self.devices, &data::Motors);
        let weights = || self.weights(posed, &limit.reduction);
        for ((motor, weight), number) in motors.values_mut().zip(weights()).zip(irregular()) {
            *motor = weight.sqrt() * number;
        }
        for _ in 0..ITERATIONS {
            let Ok(found) = self.response_to(posed, inputs, &motors, &limit.reduction) else {
                break;
            };
            next_torques::<D>(&mut motors, weights(), &found);
        }
        let energies = motors.values().zip(weights()).map(|(torque, weight)| {
            if weight > zero() { torque * torque * weight.recip() } else { zero() }
        });
        largest(energies.zip(self.joints())).map(|(_, joint)| joint)
    }

    /// Accelerations of all joints for torques, with the mass matrix reduced.
    fn response_to<A: Attitude<D::Scalar>>(
        &self,
        posed: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        motors: &D::Per<data::Motors>,
        reduction: &MassReduction<D::Scalar>,
    ) -> Result<D::Per<data::Accelerations>, SolveError<D::Scalar>> {
        let (still, reduction) = (zeros(), Some(*reduction));
        let mut scratch = D::new_data(&self.devices, &data::Gains);
        let assembly =
            self.eliminate_for_impulses(posed, motors, inputs, reduction, &mut scratch)?;
        let hub = match inputs.hub {
            HubMode::Free => assembly.system(still).solved().0,
            HubMode::Fixed | HubMode::Prescribed { .. } => {
                Solution { r_b_n_ddot: still, omega_dot: still }
            }
        };
        self.back_substitute(&scratch, &hub)
    }

    /// Of each joint, what a reduction takes from its inertia; of a share that it adds, nothing.
    pub(crate) fn weights<A>(
        &self,
        posed: &State<D, A, S>,
        reduction: &MassReduction<D::Scalar>,
    ) -> impl Iterator<Item = D::Scalar> {
        let stiffness = reduction.stiffness.max(zero());
        let taken = MassReduction { stiffness, ..*reduction };
        let joints = D::list::<Passives>(&self.devices).zip(posed.devices.states());
        joints.map(move |(passive, [_, rate])| {
            taken.subtracted(passive.damping(rate), passive.stiffness)
        })
    }
}

/// Torques of an inverse iteration after one with these accelerations: weight times acceleration,
/// over the root of the energy.
fn next_torques<D: Devices>(
    motors: &mut D::Per<data::Motors>,
    weights: impl Iterator<Item = D::Scalar>,
    found: &D::Per<data::Accelerations>,
) {
    let mut energy = zero::<D::Scalar>();
    for ((motor, weight), acceleration) in motors.values_mut().zip(weights).zip(found.values()) {
        *motor = weight * acceleration;
        energy = energy + *motor * acceleration;
    }
    let size = energy.sqrt().recip();
    motors.values_mut().for_each(|motor| *motor = *motor * size);
}

/// The entry of the largest number.
pub(crate) fn largest<T: Scalar, V>(entries: impl Iterator<Item = (T, V)>) -> Option<(T, V)> {
    entries.reduce(|most, entry| if entry.0 > most.0 { entry } else { most })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smallest_rate_is_zero_where_the_joint_reversed() {
        let slower = pass([2.0, 2.0], 1.0);
        assert_eq!(slower, [2.0, 1.0]);
        assert!(!rests(slower, &Passive::friction(0.0, 1.0, 1.0)));
        let reversed = pass(slower, -3.0);
        assert_eq!(reversed, [2.0, 0.0]);
        assert!(rests(reversed, &Passive::friction(0.0, 1.0, 1.0)));
        assert!(!rests(reversed, &Passive::friction(1.0, 0.0, 0.0)));
    }
}
