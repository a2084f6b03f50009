//! DOP853 driven step by step: errors of the solver come through, and the end of a segment is met
//! exactly.

use std::cell::RefCell;

use differential_equations::error::Error as Stop;
use differential_equations::methods::{DormandPrince, ExplicitRungeKutta, Ordinary};
use differential_equations::ode::{ODE, OrdinaryNumericalMethod};
use differential_equations::status::Status;
use precess_dynamics::SolveError;

use super::dense::Dense;
use crate::engine::equations::system::System;
use crate::record::{Fault, RunError};
use crate::scenario::steps_max;

/// The square of this is a number, and so is the sum of as many as a state has.
const FASTEST: f64 = 1e150;
/// A step that is shortened this often after the solver failed is 1e-20 of what it was: the state
/// itself fails.
const REJECTIONS_MAX: usize = 30;

type Method = ExplicitRungeKutta<Ordinary, DormandPrince, f64, Vec<f64>, 8, 12, 16>;

/// An integration in progress, from the start of a segment to its end.
pub(crate) struct Dop853 {
    method: Method,
    tolerance: f64,
    end: f64,
    dense: RefCell<Dense>,
    /// The step that was intended before it was shortened to meet the end of a segment, s.
    intended: f64,
    pub(crate) accepted: u64,
    pub(crate) rejected: u64,
}

/// The equations in the integrator's terms. Its interface has no errors: the first one is kept,
/// and the step is rejected.
struct Equations<'s, 'a> {
    system: &'s System<'a>,
    dense: &'s RefCell<Dense>,
    failure: RefCell<Option<(f64, SolveError)>>,
}

impl ODE<f64, Vec<f64>> for Equations<'_, '_> {
    fn diff(&self, t: f64, y: &Vec<f64>, dydt: &mut Vec<f64>) {
        if let Err(error) = self.system.rates(t, y, dydt) {
            // No step is accepted on NaN: it is shortened instead.
            dydt.fill(f64::NAN);
            self.failure.borrow_mut().get_or_insert((t, error));
        }
        self.dense.borrow_mut().keep(dydt);
    }
}

impl Dop853 {
    /// An integration that has not begun.
    pub(crate) fn new(system: &System<'_>, tolerance: f64) -> Self {
        let dense = RefCell::new(Dense::new(system.layout.length()));
        let method = method(system, tolerance, 0.0);
        Self { method, tolerance, end: 0.0, dense, intended: 0.0, accepted: 0, rejected: 0 }
    }

    /// Begins a segment with a flat state; its first step is the one that was intended before, or
    /// chosen by the method if there is none.
    pub(crate) fn begin(
        &mut self,
        system: &System<'_>,
        [start, end]: [f64; 2],
        y: &Vec<f64>,
    ) -> Result<(), RunError> {
        let step = if self.accepted == 0 { 0.0 } else { self.method.h().max(self.intended) };
        // The state is evaluated first: an error there is not one of too long a step.
        let mut dydt = y.clone();
        let evaluated = system.rates(start, y, &mut dydt);
        evaluated.map_err(|source| RunError::solve(system, start, source))?;
        // The first step is chosen by sums of squares, which must be numbers.
        if let Some(error) = self.too_fast(system, start, y, &dydt, FASTEST) {
            return Err(error);
        }
        self.method = method(system, self.tolerance, end - start);
        self.method.h0 = step.min(end - start);
        self.end = end;
        self.init(system, start, y)
    }

    /// Continues from the present time with the same state, differently expressed.
    pub(crate) fn restart(&mut self, system: &System<'_>, y: &Vec<f64>) -> Result<(), RunError> {
        let time = self.time();
        self.method.h0 = self.method.h().min(self.end - time);
        self.init(system, time, y)
    }

    fn init(&mut self, system: &System<'_>, time: f64, y: &Vec<f64>) -> Result<(), RunError> {
        self.dense.borrow_mut().start();
        self.dense.borrow_mut().forget();
        let equations = Equations { system, dense: &self.dense, failure: RefCell::new(None) };
        match self.method.init(&equations, time, self.end, y) {
            Ok(_) => Ok(()),
            // It finds no first step.
            Err(Stop::BadInput { .. }) if equations.failure.borrow().is_none() => {
                let mut dydt = vec![0.0; y.len()];
                let evaluated = system.rates(time, y, &mut dydt);
                evaluated.map_err(|source| RunError::solve(system, time, source))?;
                Err(self
                    .too_fast(system, time, y, &dydt, 0.0)
                    .unwrap_or(RunError::Stiff { time, fastest: system.fastest(y) }))
            }
            Err(stop) => Err(stopped(&equations, time, &stop)),
        }
    }

    /// The error of the number of a state that changes fastest, where it is by more tolerances per second than a bound.
    fn too_fast(
        &self,
        system: &System<'_>,
        time: f64,
        y: &[f64],
        dydt: &[f64],
        bound: f64,
    ) -> Option<RunError> {
        let tolerances = system.layout.absolute_tolerance(self.tolerance);
        let each = y.iter().zip(dydt).zip(tolerances).enumerate();
        let speeds = each.map(|(place, ((value, rate), tolerance))| {
            let speed = (rate / (tolerance + self.tolerance * value.abs())).abs();
            (place, *rate, speed)
        });
        let (place, rate, speed) = speeds.max_by(|a, b| a.2.total_cmp(&b.2))?;
        let (quantity, unit) = system.layout.named(place);
        (speed > bound).then_some(RunError::TooFast { time, quantity, rate, unit })
    }

    /// One step, repeated until it is accepted.
    pub(crate) fn step(&mut self, system: &System<'_>) -> Result<(), RunError> {
        let rest = self.end - self.method.t();
        self.intended = 0.0;
        if self.method.h() > rest {
            self.intended = self.method.h();
            self.method.set_h(rest);
        }
        let longest = system.longest_step(self.method.y());
        if self.method.h() > longest {
            self.method.set_h(longest);
        }
        let time = self.time();
        {
            let mut dense = self.dense.borrow_mut();
            if self.method.t() != self.method.t_prev() {
                dense.advance();
            }
            dense.forget();
        }
        let equations = Equations { system, dense: &self.dense, failure: RefCell::new(None) };
        for rejections in 0.. {
            self.dense.borrow_mut().attempt();
            equations.failure.replace(None);
            if let Err(stop) = self.method.step(&equations) {
                return Err(stopped(&equations, time, &stop));
            }
            if !matches!(self.method.status(), Status::RejectedStep) {
                break;
            }
            self.rejected += 1;
            self.intended = 0.0;
            if rejections >= REJECTIONS_MAX && equations.failure.borrow().is_some() {
                let too_small = Stop::StepSize { t: time, y: Vec::new() };
                return Err(stopped(&equations, time, &too_small));
            }
        }
        self.accepted += 1;
        // The method accepts a step and then evaluates its end, from where the next one starts.
        let failed = equations.failure.take();
        failed.map_or(Ok(()), |(time, source)| Err(RunError::solve(system, time, source)))
    }

    /// The present time; the end of the segment once it is reached to within rounding.
    pub(crate) fn time(&self) -> f64 {
        let time = self.method.t();
        if same(time, self.end) { self.end } else { time }
    }

    /// The present flat state.
    pub(crate) fn now(&self) -> &[f64] {
        self.method.y()
    }

    /// The flat state at the start of the last step.
    pub(crate) fn before(&self) -> &[f64] {
        self.method.y_prev()
    }

    /// Writes the flat state within the last step, by its polynomial.
    pub(crate) fn at(&self, time: f64, y: &mut [f64]) {
        let (from, to) = (self.method.t_prev(), self.method.t());
        if time >= self.time() || to <= from {
            y.copy_from_slice(self.now());
        } else if time <= from {
            y.copy_from_slice(self.before());
        } else {
            let h = to - from;
            let share = (time - from) / h;
            self.dense.borrow_mut().state(self.before(), self.now(), h, share, y);
        }
    }

    /// The flat state within the last step, by a step of its own from the start of that step.
    pub(crate) fn restep(&self, system: &System<'_>, time: f64) -> Result<Vec<f64>, RunError> {
        let from = self.method.t_prev();
        if time <= from {
            return Ok(self.before().to_vec());
        }
        let dense = RefCell::new(Dense::new(0));
        let equations = Equations { system, dense: &dense, failure: RefCell::new(None) };
        let mut method = method(system, self.tolerance, time - from);
        method.h0 = time - from;
        let started = method.init(&equations, from, time, self.method.y_prev());
        started.map_err(|stop| stopped(&equations, from, &stop))?;
        while method.t() < time && !same(method.t(), time) {
            let rest = time - method.t();
            if method.h() > rest {
                method.set_h(rest);
            }
            method.step(&equations).map_err(|stop| stopped(&equations, from, &stop))?;
        }
        Ok(method.y().clone())
    }
}

/// Whether two times are the same but for the rounding of the last sum.
pub(crate) fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= 4.0 * f64::EPSILON * b.abs().max(a.abs())
}

/// The method for a segment of a length, s.
fn method(system: &System<'_>, tolerance: f64, length: f64) -> Method {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "positive, and a cast from floating point saturates"
    )]
    let steps = steps_max(length) as usize;
    ExplicitRungeKutta::dop853()
        .rtol(tolerance)
        .atol(system.layout.absolute_tolerance(tolerance))
        .max_steps(steps)
}

fn stopped(equations: &Equations<'_, '_>, time: f64, stop: &Stop<f64, Vec<f64>>) -> RunError {
    if let Some((time, source)) = equations.failure.take() {
        return RunError::solve(equations.system, time, source);
    }
    let system = equations.system;
    let fault = match stop {
        Stop::MaxSteps { t, y } => {
            return RunError::TooManySteps { time: *t, fastest: system.fastest(y) };
        }
        Stop::StepSize { t, y } => {
            return RunError::StepTooSmall { time: *t, fastest: system.fastest(y) };
        }
        Stop::Stiffness { t, y } => {
            return RunError::Stiff { time: *t, fastest: system.fastest(y) };
        }
        Stop::BadInput { msg } => Fault::Input { reason: msg.clone() },
        Stop::OutOfBounds { t_interp, t_prev, t_curr } => {
            Fault::Interpolation { time: *t_interp, from: *t_prev, to: *t_curr }
        }
        Stop::NoLags | Stop::InsufficientHistory { .. } => Fault::Delay,
        Stop::LinearAlgebra { msg, .. } => Fault::LinearAlgebra { reason: msg.clone() },
    };
    RunError::Integrator { time, fault }
}
