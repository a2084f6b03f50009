//! [`BatchRows`]: accelerations of flat states, row by row: a batch without the interpreter, which Python and XLA
//! both call. Their derivatives are in `derivatives`.

use std::sync::{Arc, Mutex, OnceLock};

use precess::evaluation::{CraftInputs, Evaluator};
use precess::scenario::Scenario;
use precess_dynamics::{Each as _, Mode, Variable};
use precess_lanes::PART;

use super::derivatives::Linearized;
use super::engine::{Engine, Failure};
use super::work::{ProgressCheck, share};

/// Index of an element that failed, and why.
pub(crate) type Failed = Vec<(usize, Failure)>;

/// Outputs and inputs of a linearised system, and its names.
type Named = ([Vec<Variable>; 2], Arc<Linearized>);

/// Many states of a spacecraft, or of one each.
pub(crate) struct BatchRows {
    pub(super) evaluator: Arc<Evaluator>,
    pub(super) engine: Engine,
    /// Elements; none of one spacecraft for any number.
    pub(super) count: Option<usize>,
    /// Of each element, where they differ.
    pub(super) scenarios: Vec<Arc<Scenario>>,
    /// What differentiates each, made where it is first wanted: lanes have no derivatives.
    pub(super) each: OnceLock<Vec<Result<Arc<Evaluator>, Failure>>>,
    /// The names of the last linearised system, by what it is of.
    pub(super) names: Mutex<Option<Named>>,
}

impl BatchRows {
    /// Numbers of a flat state.
    pub(crate) fn state_size(&self) -> usize {
        self.evaluator.state_size()
    }

    /// Numbers of a row of inputs: force, torque, joints.
    pub(crate) fn input_size(&self) -> usize {
        6 + self.evaluator.joints().len()
    }

    pub(crate) fn acceleration_size(&self) -> usize {
        self.evaluator.acceleration_names().len()
    }

    /// The spacecraft of an element.
    pub(super) fn craft(&self, element: usize) -> Result<&Evaluator, Failure> {
        if self.count.is_none() {
            return Ok(&self.evaluator);
        }
        let made = |of: &Arc<Scenario>| {
            let made = Evaluator::new(of).map(Arc::new);
            made.map_err(|error| Failure::Scenario(Arc::new(error)))
        };
        let all = self.each.get_or_init(|| self.scenarios.iter().map(made).collect());
        match all.get(element) {
            Some(Ok(craft)) => Ok(craft),
            Some(Err(failure)) => Err(failure.clone()),
            // As many states as spacecraft were checked.
            None => Ok(&self.evaluator),
        }
    }

    /// Accelerations of the states, one row each.
    pub(crate) fn accelerations(
        &self,
        (y, acting): (&[f64], &InputRows),
        out: &mut [f64],
        threads: usize,
        look: ProgressCheck<'_>,
    ) -> Failed {
        let (size, width) = (self.state_size(), self.acceleration_size());
        let jobs = out.chunks_mut((PART * width).max(1)).zip(y.chunks(PART * size)).enumerate();
        let jobs = jobs.map(|(part, (out, y))| (part, out, y)).collect();
        share(threads, look, jobs, |(part, out, y): (usize, &mut [f64], &[f64]), _| {
            let inputs = acting.of_part(part, y.len() / size);
            let ends = self.engine.accelerations(part, (y, y.len() / size), &inputs, out);
            failed_rows(part, &ends, out, width)
        })
    }
}

/// Inputs, row by row; no rows where they are the same for all.
pub(crate) struct InputRows {
    pub(crate) base: CraftInputs,
    pub(crate) rows: Vec<f64>,
    pub(crate) width: usize,
}

impl InputRows {
    /// Those of a part of so many states: one for all, or one for each.
    pub(super) fn of_part(&self, part: usize, count: usize) -> Vec<CraftInputs> {
        if self.width == 0 {
            return vec![self.base.clone()];
        }
        let rows = self.rows.chunks_exact(self.width).skip(part * PART).take(count);
        rows.map(|row| with_row(&self.base, row)).collect()
    }
}

/// Inputs with the numbers of a row: of a joint that is prescribed, its acceleration.
fn with_row(base: &CraftInputs, row: &[f64]) -> CraftInputs {
    let mut inputs = base.clone();
    let mut numbers = row.iter().copied();
    for (to, from) in inputs.force.iter_mut().chain(inputs.torque_b.iter_mut()).zip(&mut numbers) {
        *to = from;
    }
    let joints = inputs.motors.values_mut().zip(inputs.modes.values_mut());
    for ((motor, mode), number) in joints.zip(numbers) {
        match mode {
            Mode::Prescribed(acceleration) => *acceleration = number,
            _ => *motor = number,
        }
    }
    inputs
}

/// The failures of a part, whose rows become NaN.
pub(super) fn failed_rows(
    part: usize,
    ends: &[Result<(), Failure>],
    rows: &mut [f64],
    width: usize,
) -> Failed {
    let mut failures = Vec::new();
    for (index, (end, row)) in ends.iter().zip(rows.chunks_mut(width.max(1))).enumerate() {
        if let Err(failure) = end {
            row.fill(f64::NAN);
            failures.push((part * PART + index, failure.clone()));
        }
    }
    failures
}
