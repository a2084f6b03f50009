//! DOP853 driven step by step: errors of the solver come through, and the end is met exactly.

use std::cell::{Cell, RefCell};

use differential_equations::error::Error as Stop;
use differential_equations::methods::{DormandPrince, ExplicitRungeKutta, Ordinary};
use differential_equations::ode::{ODE, OrdinaryNumericalMethod};
use differential_equations::status::Status;
use precess_dynamics::{Inputs, SolveError, Spacecraft};

use crate::error::{Fault, RunError};
use crate::packing::{Packed, absolute_tolerance};
use crate::scenario::Set;

/// Table 1 takes about 300 steps a second; a run that needs this many has gone astray.
const STEPS_PER_SECOND_MAX: f64 = 1e5;
/// A step this often shortened after the solver failed is 1e-20 of what it was: the state itself
/// fails.
const REJECTIONS_MAX: usize = 30;
/// Closer to the end than this share of it, the end is reached: rounding of the last sum.
const END: f64 = 4.0 * f64::EPSILON;

type Dop853 = ExplicitRungeKutta<Ordinary, DormandPrince, f64, Vec<f64>, 8, 12, 16>;

/// The equations of motion in the integrator's terms.
pub(crate) struct System<const N: usize> {
    spacecraft: Spacecraft<Set<N>>,
    inputs: Inputs<Set<N>>,
    /// The integrator's interface has no errors: the error is kept here, and the step is rejected.
    failure: RefCell<Option<(f64, SolveError)>>,
    evaluations: Cell<usize>,
}

impl<const N: usize> System<N> {
    pub(crate) fn new(spacecraft: Spacecraft<Set<N>>, inputs: Inputs<Set<N>>) -> Self {
        Self { spacecraft, inputs, failure: RefCell::new(None), evaluations: Cell::new(0) }
    }

    pub(crate) fn spacecraft(&self) -> &Spacecraft<Set<N>> {
        &self.spacecraft
    }

    pub(crate) fn evaluations(&self) -> usize {
        self.evaluations.get()
    }
}

impl<const N: usize> ODE<f64, Vec<f64>> for System<N> {
    fn diff(&self, t: f64, y: &Vec<f64>, dydt: &mut Vec<f64>) {
        self.evaluations.set(self.evaluations.get() + 1);
        match Packed::from_slice(y).rates(&self.spacecraft, &self.inputs) {
            Ok(rates) => dydt.copy_from_slice(rates.as_slice()),
            Err(error) => {
                // No step is accepted on NaN: it is shortened instead.
                dydt.fill(f64::NAN);
                self.failure.borrow_mut().get_or_insert((t, error));
            }
        }
    }
}

/// An integration in progress.
pub(crate) struct Integrator<'a, const N: usize> {
    system: &'a System<N>,
    method: Dop853,
    end: f64,
    pub(crate) accepted: usize,
    pub(crate) rejected: usize,
}

impl<'a, const N: usize> Integrator<'a, N> {
    /// An integration of a packed state over a span of time, its first step chosen by itself unless
    /// it is given.
    pub(crate) fn new(
        system: &'a System<N>,
        tolerance: f64,
        span: (f64, f64),
        y: &Vec<f64>,
        first_step: Option<f64>,
    ) -> Result<Self, RunError> {
        let (start, end) = span;
        // The state is evaluated first: an error there is not one of too long a step.
        Packed::from_slice(y)
            .rates(&system.spacecraft, &system.inputs)
            .map_err(|source| RunError::Solve { time: start, source })?;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "positive, and a cast from floating point saturates"
        )]
        let steps = (STEPS_PER_SECOND_MAX * (end - start).max(1.0)) as usize;
        let method = ExplicitRungeKutta::dop853()
            .rtol(tolerance)
            .atol(absolute_tolerance::<N>(tolerance))
            .max_steps(steps)
            .h0(first_step.unwrap_or(0.0));
        let mut integrator = Self { system, method, end, accepted: 0, rejected: 0 };
        integrator.start(start, y)?;
        Ok(integrator)
    }

    /// Goes on from the present time with the same state, differently expressed.
    pub(crate) fn restart(&mut self, y: &Vec<f64>) -> Result<(), RunError> {
        let time = self.time();
        self.method.h0 = self.method.h().min(self.end - time);
        self.start(time, y)
    }

    fn start(&mut self, time: f64, y: &Vec<f64>) -> Result<(), RunError> {
        match self.method.init(self.system, time, self.end, y) {
            Ok(_) => Ok(()),
            Err(stop) => Err(self.stopped(time, &stop)),
        }
    }

    /// One step, repeated until it is accepted.
    pub(crate) fn step(&mut self) -> Result<(), RunError> {
        let rest = self.end - self.method.t();
        if self.method.h() > rest {
            self.method.set_h(rest);
        }
        for rejections in 0.. {
            if let Err(stop) = self.method.step(self.system) {
                return Err(self.stopped(self.time(), &stop));
            }
            if !matches!(self.method.status(), Status::RejectedStep) {
                break;
            }
            self.rejected += 1;
            if rejections >= REJECTIONS_MAX && self.system.failure.borrow().is_some() {
                return Err(self.stopped(self.time(), &self.too_small()));
            }
        }
        // A step that failed and then went through, shorter, is no failure.
        self.system.failure.replace(None);
        self.accepted += 1;
        Ok(())
    }

    pub(crate) fn done(&self) -> bool {
        self.time() >= self.end
    }

    pub(crate) fn time(&self) -> f64 {
        let time = self.method.t();
        if (self.end - time).abs() <= END * self.end { self.end } else { time }
    }

    pub(crate) fn state(&self) -> &Vec<f64> {
        self.method.y()
    }

    /// Time and state before the last step.
    pub(crate) fn before(&self) -> (f64, &Vec<f64>) {
        (self.method.t_prev(), self.method.y_prev())
    }

    fn too_small(&self) -> Stop<f64, Vec<f64>> {
        Stop::StepSize { t: self.method.t(), y: Vec::new() }
    }

    fn stopped(&self, time: f64, stop: &Stop<f64, Vec<f64>>) -> RunError {
        if let Some((time, source)) = self.system.failure.take() {
            return RunError::Solve { time, source };
        }
        let fault = match stop {
            Stop::MaxSteps { t, .. } => return RunError::TooManySteps { time: *t },
            Stop::StepSize { t, .. } => return RunError::StepTooSmall { time: *t },
            Stop::Stiffness { t, .. } => return RunError::Stiff { time: *t },
            Stop::BadInput { msg } => Fault::Input { reason: msg.clone() },
            Stop::OutOfBounds { t_interp, t_prev, t_curr } => {
                Fault::Interpolation { time: *t_interp, from: *t_prev, to: *t_curr }
            }
            Stop::NoLags | Stop::InsufficientHistory { .. } => Fault::Delay,
            Stop::LinearAlgebra { msg, .. } => Fault::LinearAlgebra { reason: msg.clone() },
        };
        RunError::Integrator { time, fault }
    }
}
