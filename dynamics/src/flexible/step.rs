//! The classical fourth-order Runge-Kutta step of a flexible structure.
//!
//! The step must resolve the fastest wheel and the fastest mode.

use crate::attitude::parameterisation::Attitude;
use crate::equations::error::{Quantity, SolveError};
use crate::flexible::storage::{Flexible, ModalStorage};
use crate::integrate::rk4::Stepped;
use crate::integrate::stability::SlowestRates;
use crate::numbers::real::{Real, Scalar, half, zero};
use crate::results::ledger::Power;
use crate::sets::devices::Devices;
use crate::solve::accelerations::overflow;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};
use crate::solve::structure::StructureServices as _;

impl<D: Devices, M: ModalStorage> Spacecraft<D, Flexible<M>> {
    /// The state after `dt` seconds, with inputs constant in the axes in which they are expressed.
    ///
    /// The attitude is normalised at the end of the step; joint angles are not wrapped.
    ///
    /// Stability is checked for the fastest vibration of structure and devices together, in the
    /// pose at the start of the step: [`SolveError::UnstableModes`] where its energy is mostly that
    /// of the modes, [`SolveError::Unstable`], which names the joint, where it is that of springs,
    /// dampers and friction of the joints.
    ///
    /// # Errors
    ///
    /// As [`Self::accelerations`], [`Quantity::TimeStep`] for a `dt` that is not finite, and the
    /// two above.
    pub fn step<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, Flexible<M>>,
        inputs: &Inputs<D, Flexible<M>>,
        dt: D::Scalar,
    ) -> Result<State<D, A, Flexible<M>>, SolveError<D::Scalar>> {
        self.stepped(state, inputs, dt, |_, stage, found| self.solve(stage, inputs, found))
    }

    /// [`Self::step`], with the work of each source during the step: what the ledger calls power,
    /// in J, integrated to the order of the step.
    ///
    /// # Errors
    ///
    /// As [`Self::step`].
    pub fn step_with_work<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, Flexible<M>>,
        inputs: &Inputs<D, Flexible<M>>,
        dt: D::Scalar,
    ) -> Result<Stepped<D, A, Flexible<M>>, SolveError<D::Scalar>> {
        let mut work = Power::none();
        let next = self.stepped(state, inputs, dt, |weight, stage, found| {
            self.solve(stage, inputs, found)?;
            work = work.plus_scaled(weight, &self.ledger_of(stage, inputs, found)?.power);
            Ok(())
        })?;
        if work.is_finite() {
            Ok(Stepped { state: next, work })
        } else {
            Err(SolveError::Overflow { what: Quantity::Work })
        }
    }

    /// One step; `evaluate` gets the weight of a stage in the sum of slopes, s, and its state, and
    /// writes accelerations.
    fn stepped<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A, Flexible<M>>,
        inputs: &Inputs<D, Flexible<M>>,
        dt: D::Scalar,
        evaluate: impl FnMut(
            D::Scalar,
            &State<D, A, Flexible<M>>,
            &mut Accelerations<D, Flexible<M>>,
        ) -> Result<(), SolveError<D::Scalar>>,
    ) -> Result<State<D, A, Flexible<M>>, SolveError<D::Scalar>> {
        if !dt.is_finite() {
            return Err(SolveError::NotFinite { what: Quantity::TimeStep, value: dt });
        }
        if !self.are_finite(state, inputs) {
            return Err(self.diagnosis(state, inputs, overflow()));
        }
        let mut slowest = SlowestRates::new(self, state);
        let next = self.advance(state, inputs, dt, &mut slowest, evaluate);
        next.and_then(|next| self.check_stability(state, inputs, dt, &slowest).map(|()| next))
            .map_err(|failure| self.cause_of_step(state, inputs, dt, failure))
    }

    /// What to report for a failed step: a step that is too long may lead to states that have no
    /// solution, or overflow.
    #[cold]
    fn cause_of_step<A: Attitude<D::Scalar>>(
        &self,
        start: &State<D, A, Flexible<M>>,
        inputs: &Inputs<D, Flexible<M>>,
        dt: D::Scalar,
        failure: SolveError<D::Scalar>,
    ) -> SolveError<D::Scalar> {
        let cause = self.diagnosis(start, inputs, failure);
        match cause {
            SolveError::Singular { .. }
            | SolveError::ModalMass { .. }
            | SolveError::Overflow { .. } => {
                let begins = self.solve(start, inputs, &mut self.no_accelerations()).is_ok();
                let slowest = SlowestRates::new(self, start);
                let stable = begins.then(|| self.check_stability(start, inputs, dt, &slowest));
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
        start: &State<D, A, Flexible<M>>,
        inputs: &Inputs<D, Flexible<M>>,
        dt: D::Scalar,
        slowest: &mut SlowestRates<D>,
        mut evaluate: impl FnMut(
            D::Scalar,
            &State<D, A, Flexible<M>>,
            &mut Accelerations<D, Flexible<M>>,
        ) -> Result<(), SolveError<D::Scalar>>,
    ) -> Result<State<D, A, Flexible<M>>, SolveError<D::Scalar>> {
        let middle = half::<D::Scalar>() * dt;
        let sixth = dt * D::Scalar::from_f64(6.0).recip();
        let third = dt * D::Scalar::from_f64(3.0).recip();

        let mut found = self.no_accelerations();
        let mut stage = start.clone();
        stage.attitude = start.attitude.regular();
        let attitude = stage.attitude;
        let mut sum = State::<D, A, Flexible<M>>::at_rest_for(self);
        let mut rates = [(zero(), attitude.rate(&start.omega)); 4];
        let stages = [(sixth, middle), (third, middle), (third, dt), (sixth, zero())];
        for ((weight, offset), rate) in stages.into_iter().zip(&mut rates) {
            if self.passive {
                slowest.pass(&stage);
            }
            evaluate(weight, &stage, &mut found)
                .map_err(|failure| self.cause(&stage, inputs, failure))?;
            *rate = (weight, stage.attitude.rate(&stage.omega));
            stage.follow(self, start, &found, [weight, offset], &mut sum);
            stage.attitude = attitude.advanced(&[(offset, rate.1)]);
            follow(&mut stage, start, found.modal.eta_ddot.as_ref(), [weight, offset], &mut sum);
        }
        let mut next = stage;
        next.add(self, start, &sum);
        next.attitude = attitude.advanced(&rates).normalised();
        add(next.modal.eta.as_mut(), start.modal.eta.as_ref(), sum.modal.eta.as_ref());
        add(next.modal.eta_dot.as_mut(), start.modal.eta_dot.as_ref(), sum.modal.eta_dot.as_ref());
        self.check_reached(&next)?;
        if Flexible::reject_state(self, &next.modal).is_err() {
            return Err(SolveError::Overflow { what: Quantity::ModalAcceleration });
        }
        slowest.pass(&next);
        Ok(next)
    }
}

/// Adds `weight` times the slope of the modal coordinates to `sum`, and sets those of the next
/// stage.
fn follow<D: Devices, M: ModalStorage, A>(
    stage: &mut State<D, A, Flexible<M>>,
    start: &State<D, A, Flexible<M>>,
    eta_ddot: &[D::Scalar],
    [weight, offset]: [D::Scalar; 2],
    sum: &mut State<D, A, Flexible<M>>,
) {
    let now = stage.modal.eta.as_mut().iter_mut().zip(stage.modal.eta_dot.as_mut());
    let from = start.modal.eta.as_ref().iter().zip(start.modal.eta_dot.as_ref());
    let sums = sum.modal.eta.as_mut().iter_mut().zip(sum.modal.eta_dot.as_mut());
    for ((((eta, rate), (from, rate_from)), (sum, sum_of_rate)), acceleration) in
        now.zip(from).zip(sums).zip(eta_ddot)
    {
        *sum = *sum + weight * *rate;
        *sum_of_rate = *sum_of_rate + weight * *acceleration;
        *eta = *from + offset * *rate;
        *rate = *rate_from + offset * *acceleration;
    }
}

/// `to = start + sum`.
fn add<T: Scalar>(to: &mut [T], start: &[T], sum: &[T]) {
    for (to, (start, sum)) in to.iter_mut().zip(start.iter().zip(sum)) {
        *to = *start + *sum;
    }
}
