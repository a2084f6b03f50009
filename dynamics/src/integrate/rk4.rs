//! The classical fourth-order Runge-Kutta step, the integrator on board.
//!
//! Fixed cost, no error estimate: four evaluations and one normalisation of the attitude. The step
//! must resolve the fastest wheel; start with a tenth of a radian of `theta` per step.

use nalgebra::Vector3;

use crate::attitude::parameterisation::Attitude;
use crate::equations::error::{Quantity, SolveError};
use crate::equations::stiffness::Stiffness;
use crate::integrate::joint_stages::{NextStage, StageData, StepEnd, StepEndData};
use crate::integrate::stability::PassiveStep;
use crate::integrate::structure::StructureSteps;
use crate::numbers::real::{Real, Scalar, half, zero};
use crate::numbers::vec3::{add, columns, components, rotate_transposed, scale, vector, zeros};
use crate::results::ledger::Power;
use crate::sets::devices::Devices;
use crate::solve::diagnosis::overflow;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};
use crate::solve::structure::{Rigid, StructureData};

/// Result of [`Spacecraft::step_with_work`]: the state after the step, and the work during it.
#[derive(Clone, Debug, PartialEq)]
pub struct Stepped<D: Devices, A, S: StructureData = Rigid> {
    /// The state after the step.
    pub state: State<D, A, S>,
    /// Work of each source during the step, J.
    pub work: Power<D::Scalar>,
}

impl<D: Devices, S: StructureSteps> Spacecraft<D, S> {
    /// The state after `dt` seconds, with inputs constant in the axes in which they are expressed.
    ///
    /// The attitude is normalised at the end of the step: a quaternion gets unit length, MRPs
    /// beyond a half turn become their shadow set. Joint angles are not wrapped; see
    /// [`State::wrapped`].
    ///
    /// A step has to be short enough for springs, dampers and friction of the joints, and for the
    /// modes of a flexible structure: checked for the fastest vibration of structure and devices
    /// together, in the pose at the start of the step.
    ///
    /// # Errors
    ///
    /// As [`Spacecraft::accelerations`], [`Quantity::TimeStep`] for a `dt` that is not finite,
    /// [`SolveError::Unstable`] for one that is too long for a spring, damper or friction, which names
    /// the joint, and [`SolveError::UnstableModes`] where the energy of the fastest vibration is mostly
    /// that of the modes.
    pub fn step<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        dt: D::Scalar,
    ) -> Result<State<D, A, S>, SolveError<D::Scalar>> {
        self.stepped(state, inputs, dt, |_, stage, found, stiffness| {
            self.solve(stage, inputs, found, stiffness)
        })
    }

    /// [`Self::step`], with the work of each source during the step: what the ledger calls power,
    /// in J, integrated to the order of the step.
    ///
    /// # Errors
    ///
    /// As [`Self::step`].
    pub fn step_with_work<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        dt: D::Scalar,
    ) -> Result<Stepped<D, A, S>, SolveError<D::Scalar>> {
        let mut work = Power::none();
        let next = self.stepped(state, inputs, dt, |weight, stage, found, stiffness| {
            self.solve(stage, inputs, found, stiffness)?;
            let power = S::ledger(self, stage, inputs, found)?.power;
            work = work.plus_scaled(weight, &power);
            Ok(())
        })?;
        if work.is_finite() {
            Ok(Stepped { state: next, work })
        } else {
            Err(SolveError::Overflow { what: Quantity::Work })
        }
    }

    /// One step; `evaluate` gets the weight of a stage in the sum of slopes, s, and its state, and
    /// writes accelerations and, if there are springs or friction, stiffness.
    pub(crate) fn stepped<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        dt: D::Scalar,
        evaluate: impl FnMut(
            D::Scalar,
            &State<D, A, S>,
            &mut Accelerations<D, S>,
            Option<&mut Stiffness<D::Scalar>>,
        ) -> Result<(), SolveError<D::Scalar>>,
    ) -> Result<State<D, A, S>, SolveError<D::Scalar>> {
        if !dt.is_finite() {
            return Err(SolveError::NotFinite { what: Quantity::TimeStep, value: dt });
        }
        if !self.are_finite(state, inputs) {
            return Err(self.diagnosis(state, inputs, overflow()));
        }
        self.advance(state, inputs, dt, evaluate)
            .map_err(|failure| self.cause_of_step(state, inputs, dt, failure))
    }

    /// What to report for a failed step: a step that is too long may lead to states that have no
    /// solution, or overflow.
    #[cold]
    fn cause_of_step<A: Attitude<D::Scalar>>(
        &self,
        start: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        dt: D::Scalar,
        failure: SolveError<D::Scalar>,
    ) -> SolveError<D::Scalar> {
        let cause = self.diagnosis(start, inputs, failure);
        match cause {
            SolveError::Singular { .. }
            | SolveError::ModalMass { .. }
            | SolveError::Overflow { .. }
                if S::vibrates(self) =>
            {
                let begins = self.solve(start, inputs, &mut self.no_accelerations(), None).is_ok();
                let stable = begins.then(|| S::check_stability(self, start, inputs, dt));
                match stable {
                    Some(Err(
                        unstable @ (SolveError::Unstable { .. } | SolveError::UnstableModes { .. }),
                    )) => unstable,
                    _ => cause,
                }
            }
            cause => cause,
        }
    }

    fn advance<A: Attitude<D::Scalar>>(
        &self,
        start: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        dt: D::Scalar,
        mut evaluate: impl FnMut(
            D::Scalar,
            &State<D, A, S>,
            &mut Accelerations<D, S>,
            Option<&mut Stiffness<D::Scalar>>,
        ) -> Result<(), SolveError<D::Scalar>>,
    ) -> Result<State<D, A, S>, SolveError<D::Scalar>> {
        let middle = half::<D::Scalar>() * dt;
        let sixth = dt * D::Scalar::from_f64(6.0).recip();
        let third = dt * D::Scalar::from_f64(3.0).recip();

        // Results are written in place: moving a structure just written is slow.
        let mut found = self.no_accelerations();
        let mut stage = State { attitude: start.attitude.regular(), ..start.clone() };
        let attitude = stage.attitude;
        let mut sum = State::at_rest_for(self);
        let mut rates = [(zero(), attitude.rate(&start.omega)); 4];
        let mut passive = S::vibrates(self).then(|| PassiveStep::new(self, start));
        let stages = [(sixth, middle), (third, middle), (third, dt), (sixth, zero())];
        for ((weight, offset), rate) in stages.into_iter().zip(&mut rates) {
            let stiffness = passive.as_mut().map(|passive| passive.stage(&stage));
            evaluate(weight, &stage, &mut found, stiffness)
                .map_err(|failure| self.cause(&stage, inputs, failure))?;
            *rate = (weight, stage.attitude.rate(&stage.omega));
            stage.follow(self, start, &found, [weight, offset], &mut sum);
            stage.attitude = attitude.advanced(&[(offset, rate.1)]);
        }
        // In place: another state would take stack.
        stage.add(self, start, &sum);
        stage.attitude = attitude.advanced(&rates).normalised();
        self.check_reached(&stage)?;
        match passive {
            Some(passive) => passive.check(self, start, &stage, inputs, dt).map(|()| stage),
            None => Ok(stage),
        }
    }
}

impl<D: Devices, A: Attitude<D::Scalar>, S: StructureSteps> State<D, A, S> {
    /// Adds `weight` times the slope to `sum` and sets the next stage, `start` plus `offset` times
    /// the slope, s both; the attitude is left out.
    pub(crate) fn follow(
        &mut self,
        craft: &Spacecraft<D, S>,
        start: &Self,
        found: &Accelerations<D, S>,
        [weight, offset]: [D::Scalar; 2],
        sum: &mut Self,
    ) {
        let bn = columns(&self.attitude.dcm());
        let acceleration = rotate_transposed(&bn, components(&found.r_b_n_ddot));
        let step = |sum: &mut Vector3<_>, stage: &mut Vector3<_>, start: &Vector3<_>, slope| {
            *sum = vector(add(components(sum), scale(weight, slope)));
            *stage = vector(add(components(start), add(zeros(), scale(offset, slope))));
        };
        step(&mut sum.r_b_n, &mut self.r_b_n, &start.r_b_n, components(&self.r_b_n_dot));
        step(&mut sum.r_b_n_dot, &mut self.r_b_n_dot, &start.r_b_n_dot, acceleration);
        step(&mut sum.omega, &mut self.omega, &start.omega, components(&found.omega_dot));
        let modal = (&mut self.modal, &start.modal, &mut sum.modal);
        S::follow(modal, &found.modal, [weight, offset]);
        let data = (&mut self.devices, &start.devices, &mut sum.devices, &found.devices);
        let Ok(()) =
            D::visit::<StageData, _>(&craft.devices, data, &mut NextStage { weight, offset });
    }

    /// Becomes `start + sum`, attitude left out.
    pub(crate) fn add(&mut self, craft: &Spacecraft<D, S>, start: &Self, sum: &Self) {
        let plus = |a, b| vector(add(components(a), components(b)));
        self.r_b_n = plus(&start.r_b_n, &sum.r_b_n);
        self.r_b_n_dot = plus(&start.r_b_n_dot, &sum.r_b_n_dot);
        self.omega = plus(&start.omega, &sum.omega);
        S::add(&mut self.modal, &start.modal, &sum.modal);
        let data = (&mut self.devices, &start.devices, &sum.devices);
        let Ok(()) = D::visit::<StepEndData, _>(&craft.devices, data, &mut StepEnd);
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Matrix3;

    use super::*;
    use crate::Dgvscmg;
    use crate::attitude::mrp::Mrp;
    use crate::attitude::quaternion::Quaternion;
    use crate::model::parameters::Hub;
    use crate::results::momentum::{About, Momentum};

    /// A whole turn of the body takes about 4 s; the run covers two.
    const DURATION: f64 = 8.0;

    fn hub() -> Spacecraft<[Dgvscmg; 0]> {
        let hub = Hub {
            m_b: 20.0,
            r_bc_b: Vector3::new(0.1, -0.2, 0.3),
            i_b_bc: Matrix3::new(4.0, 0.3, -0.2, 0.3, 5.0, 0.6, -0.2, 0.6, 7.0),
        };
        Spacecraft::new(&hub, &[]).unwrap()
    }

    fn tumbling<A: Attitude<f64>>() -> State<[Dgvscmg; 0], A> {
        State {
            r_b_n_dot: Vector3::new(0.5, 0.1, -0.2),
            omega: Vector3::new(1.2, -0.7, 0.9),
            ..State::at_rest()
        }
    }

    fn run<A: Attitude<f64>>(steps: u32) -> State<[Dgvscmg; 0], A> {
        let dt = DURATION / f64::from(steps);
        let torques = Inputs::none();
        (0..steps).fold(tumbling(), |state, _| hub().step(&state, &torques, dt).unwrap())
    }

    /// Drifts of energy and of angular momentum about the inertial origin, J and kg m^2/s.
    fn drifts(steps: u32) -> (f64, f64) {
        let (before, after) = (tumbling::<Quaternion>(), run::<Quaternion>(steps));
        let momentum = |s| -> Momentum { hub().momentum(s, About::InertialOrigin).unwrap() };
        let energy = |s| hub().energy(s).unwrap();
        (
            (energy(&after) - energy(&before)).abs(),
            (momentum(&after).angular - momentum(&before).angular).norm(),
        )
    }

    #[test]
    fn free_rigid_hub_keeps_energy_and_momentum_to_fourth_order() {
        let (energy, momentum) = drifts(200);
        let (energy_half, momentum_half) = drifts(400);
        for (whole, halved) in [(energy, energy_half), (momentum, momentum_half)] {
            assert!((14.0..18.0).contains(&(whole / halved)), "{whole} to {halved}");
        }
        // Of 25 J and 20 kg m^2/s: small, so that the ratios are those of converged runs.
        assert!(energy_half < 1e-6 && momentum_half < 1e-6, "{energy_half} {momentum_half}");
    }

    #[test]
    fn error_of_the_state_falls_sixteenfold_per_halved_step() {
        let reference = run::<Quaternion>(3200);
        let error = |steps| {
            let state = run::<Quaternion>(steps);
            (state.omega - reference.omega).norm() + (state.r_b_n - reference.r_b_n).norm()
        };
        let ratio = error(100) / error(200);
        assert!((14.0..18.0).contains(&ratio), "{ratio}");
    }

    #[test]
    fn mrps_and_quaternions_run_alike_through_shadow_switches() {
        let (mrp, quaternion) = (run::<Mrp>(1600), run::<Quaternion>(1600));
        assert!(mrp.attitude.0.norm() <= 1.0);
        assert!((quaternion.attitude.norm() - 1.0).abs() < 4.0 * f64::EPSILON);
        // Both carry a fourth-order error of about the step's fourth power.
        assert!((mrp.attitude.dcm() - quaternion.attitude.dcm()).amax() < 1e-8);
        assert_eq!(mrp.omega, quaternion.omega);
    }

    #[test]
    fn negative_step_leads_back() {
        let start = tumbling::<Quaternion>();
        let there = hub().step(&start, &Inputs::none(), 0.01).unwrap();
        let back = hub().step(&there, &Inputs::none(), -0.01).unwrap();
        // One step's error is of the fifth power of 0.01 s times rates of order 1.
        assert!((back.omega - start.omega).norm() < 1e-11);
        assert!((back.r_b_n - start.r_b_n).norm() < 1e-11);
    }

    #[test]
    fn step_that_is_not_finite_is_rejected() {
        let step = |dt| hub().step(&tumbling::<Mrp>(), &Inputs::none(), dt);
        let what = Quantity::TimeStep;
        for value in [f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(step(value), Err(SolveError::NotFinite { what, value }));
        }
        let rejected = step(f64::NAN).unwrap_err();
        assert!(matches!(rejected, SolveError::NotFinite { value, .. } if value.is_nan()));
        let what = Quantity::HubAcceleration;
        assert_eq!(step(1e200), Err(SolveError::Overflow { what }));
    }

    #[test]
    fn step_names_the_input_that_is_not_finite() {
        let mut state = tumbling::<Mrp>();
        state.r_b_n.x = f64::INFINITY;
        let (what, value) = (Quantity::Position, f64::INFINITY);
        let rejected = Err(SolveError::NotFinite { what, value });
        assert_eq!(hub().step(&state, &Inputs::none(), 0.1), rejected);
    }
}
