//! [`Stepper`]: either integrator, and [`Moment`], what both have at a time.
//!
//! Joint angles are those of the integrator: DOP853's are reduced by whole turns, which [`Stepper`]
//! counts, RK4's are not.

mod dense;
pub(super) mod dop853;
mod rk4;

use crate::engine::equations::system::System;
use crate::record::RunError;
use crate::scenario::IntegratorChoice;
use dop853::Dop853;
use precess_control::Checkpoint;
use precess_craft::CraftState;
use precess_dynamics::JointStates as _;
use rk4::Rk4;

/// A state and both integrals.
#[derive(Clone, Debug)]
pub(crate) struct Moment {
    pub(crate) state: CraftState,
    /// Work and throughput since the start, J.
    pub(crate) integrals: [f64; 2],
}

impl Moment {
    /// Visits its numbers.
    pub(crate) fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        let CraftState { r_b_n, r_b_n_dot, attitude, omega, devices, modal } = &mut self.state;
        checkpoint.numbers(r_b_n.iter_mut().chain(r_b_n_dot.iter_mut()).chain(omega.iter_mut()));
        checkpoint.attitude(attitude);
        checkpoint.numbers(devices.states_mut().flatten());
        checkpoint.numbers(modal.eta.iter_mut().chain(&mut modal.eta_dot));
        checkpoint.numbers(&mut self.integrals);
    }
}

/// An integration in progress.
pub(crate) struct Stepper {
    method: Method,
    /// Whole turns taken off each joint's angle.
    turns: Vec<f64>,
    before: f64,
    flat: Vec<f64>,
}

enum Method {
    Dop853(Box<Dop853>),
    Rk4(Box<Rk4>),
}

impl Stepper {
    pub(crate) fn new(system: &System<'_>, choice: IntegratorChoice, start: &Moment) -> Self {
        let method = match choice {
            IntegratorChoice::Dop853 { tolerance } => {
                Method::Dop853(Box::new(Dop853::new(system, tolerance)))
            }
            IntegratorChoice::Rk4 { step } => Method::Rk4(Box::new(Rk4::new(step, start.clone()))),
        };
        let turns = vec![0.0; system.layout.joints.len()];
        Self { method, turns, before: 0.0, flat: vec![0.0; system.layout.length()] }
    }

    /// Begins a segment, no shorter than a rounding of its times.
    pub(crate) fn begin(
        &mut self,
        system: &System<'_>,
        span: [f64; 2],
        moment: &Moment,
    ) -> Result<(), RunError> {
        self.before = span[0];
        match &mut self.method {
            Method::Dop853(method) => {
                let mut y = system.layout.pack(&moment.state, moment.integrals);
                system.layout.wrap(&mut y, &mut self.turns);
                system.acting.set_turns(&self.turns);
                method.begin(system, span, &y)
            }
            Method::Rk4(method) => {
                method.begin(span, moment.clone());
                Ok(())
            }
        }
    }

    /// Takes whole turns off the angles of joints that have completed one.
    pub(crate) fn reduce(&mut self, system: &System<'_>) -> Result<(), RunError> {
        let Method::Dop853(method) = &mut self.method else { return Ok(()) };
        if !system.layout.once_round(method.now()) {
            return Ok(());
        }
        let mut y = method.now().to_vec();
        system.layout.wrap(&mut y, &mut self.turns);
        system.acting.set_turns(&self.turns);
        method.restart(system, &y)
    }

    /// One accepted step.
    pub(crate) fn step(&mut self, system: &System<'_>) -> Result<(), RunError> {
        self.before = self.time();
        match &mut self.method {
            Method::Dop853(method) => method.step(system),
            Method::Rk4(method) => method.step(system),
        }
    }

    /// The steps that RK4 makes next ([`Rk4::coming`]); none of DOP853, whose steps depend on the state.
    #[cfg(feature = "lanes")]
    pub(crate) fn coming(&self, until: f64, most: usize) -> Option<(f64, usize)> {
        match &self.method {
            Method::Dop853(_) => None,
            Method::Rk4(method) => Some(method.coming(until, most)),
        }
    }

    /// Takes over the state after these steps.
    #[cfg(feature = "lanes")]
    pub(crate) fn take(&mut self, system: &System<'_>, state: CraftState, steps: usize) {
        self.before = self.time();
        if let Method::Rk4(method) = &mut self.method {
            method.take(system, state, steps);
        }
    }

    /// The present time, s.
    pub(crate) fn time(&self) -> f64 {
        match &self.method {
            Method::Dop853(method) => method.time(),
            Method::Rk4(method) => method.time(),
        }
    }

    /// The start of the last step, s.
    pub(crate) fn time_before(&self) -> f64 {
        self.before
    }

    /// Whole turns taken off each joint's angle during the last step.
    pub(crate) fn turns(&self) -> &[f64] {
        &self.turns
    }

    /// Reads the present moment.
    pub(crate) fn now(&self, system: &System<'_>, moment: &mut Moment) {
        match &self.method {
            Method::Dop853(method) => read(system, method.now(), moment),
            Method::Rk4(method) => moment.clone_from(method.now()),
        }
    }

    /// Reads a moment within the last step: of DOP853 by its polynomial, of RK4 by a shorter step.
    pub(crate) fn at(
        &mut self,
        system: &System<'_>,
        time: f64,
        moment: &mut Moment,
    ) -> Result<(), RunError> {
        match &self.method {
            Method::Dop853(method) => {
                method.at(time, &mut self.flat);
                read(system, &self.flat, moment);
            }
            Method::Rk4(method) => *moment = method.at(system, time)?,
        }
        Ok(())
    }

    /// Reads a moment within the last step by a step of its own from the start of that step.
    pub(crate) fn restep(
        &self,
        system: &System<'_>,
        time: f64,
        moment: &mut Moment,
    ) -> Result<(), RunError> {
        match &self.method {
            Method::Dop853(method) => read(system, &method.restep(system, time)?, moment),
            Method::Rk4(method) => *moment = method.at(system, time)?,
        }
        Ok(())
    }

    /// The time from which inputs are held at a time within the last step: that time itself of
    /// DOP853, whose inputs vary within a step.
    pub(crate) fn held_from(&self, time: f64) -> f64 {
        match &self.method {
            Method::Rk4(method) if time < method.time() => method.time_before(),
            Method::Dop853(_) | Method::Rk4(_) => time,
        }
    }

    /// Whether a state within a step costs next to nothing.
    pub(crate) fn is_dense(&self) -> bool {
        matches!(self.method, Method::Dop853(_))
    }

    /// Visits what changes from step to step; an integration with a tolerance refuses.
    pub(crate) fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        checkpoint.number(&mut self.before);
        match &mut self.method {
            Method::Dop853(_) => checkpoint.refuse(),
            Method::Rk4(method) => method.visit(checkpoint),
        }
    }

    /// Steps accepted and rejected.
    pub(crate) fn steps(&self) -> [u64; 2] {
        match &self.method {
            Method::Dop853(method) => [method.accepted, method.rejected],
            Method::Rk4(method) => [method.accepted, 0],
        }
    }
}

fn read(system: &System<'_>, y: &[f64], moment: &mut Moment) {
    system.layout.unpack(y, &mut moment.state);
    moment.integrals = system.layout.integrals(y);
}
