//! [`BatchRows`]: accelerations of flat states, and their derivatives, row by row: a batch without the
//! interpreter, which Python and XLA both call.

use std::sync::Arc;

use precess::evaluation::{CraftInputs, EvaluationError, Evaluator};
use precess_dynamics::{Each as _, JointStates as _, Mode, Outputs};
use precess_lanes::PART;

use super::engine::{Engine, Failure};
use super::work::{ProgressCheck, share};

/// Index of an element that failed, and why.
pub(crate) type Failed = Vec<(usize, Failure)>;

/// Many states of a spacecraft, or of one each.
pub(crate) struct BatchRows {
    pub(super) evaluator: Arc<Evaluator>,
    pub(super) engine: Engine,
    /// Elements; none of one spacecraft for any number.
    pub(super) count: Option<usize>,
}

/// The names of a linearised system.
pub(crate) struct Linearized {
    /// Accelerations, the rows of both matrices.
    pub(crate) outputs: Vec<String>,
    /// The columns of C.
    pub(crate) states: Vec<String>,
    /// The columns of D.
    pub(crate) inputs: Vec<String>,
}

/// How many of each.
#[derive(Clone, Copy)]
pub(crate) struct Sizes {
    pub(crate) rows: usize,
    pub(crate) states: usize,
    pub(crate) inputs: usize,
}

impl Linearized {
    pub(crate) fn sizes(&self) -> Sizes {
        let Self { outputs, states, inputs } = self;
        Sizes { rows: outputs.len(), states: states.len(), inputs: inputs.len() }
    }
}

/// Number of a part, its derivatives by states and by inputs, its states.
type LinearizedPart<'a> = (usize, ((&'a mut [f64], &'a mut [f64]), &'a [f64]));

const NONE: Outputs = Outputs { momentum: None, loads: None };

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

    /// The names of the linearised system, which depend on modes.
    ///
    /// # Errors
    ///
    /// Where there is none: an initial pose that has no accelerations.
    pub(crate) fn linearized(&self, inputs: &CraftInputs) -> Result<Linearized, EvaluationError> {
        let none: &[&str] = &[];
        // A locked joint does not move.
        let mut pose = self.evaluator.initial();
        pose.devices.states_mut().for_each(|[_, rate]| *rate = 0.0);
        let found = self.evaluator.linearize(&pose, inputs, &NONE, none)?;
        Ok(Linearized { outputs: found.outputs, states: found.states, inputs: found.inputs })
    }

    /// Derivatives of the accelerations of each state by states, C, and by inputs, D, rows first.
    pub(crate) fn linearize(
        &self,
        (y, acting): (&[f64], &InputRows),
        Sizes { rows, states, inputs }: Sizes,
        (c, d): (&mut [f64], &mut [f64]),
        threads: usize,
        look: ProgressCheck<'_>,
    ) -> Failed {
        let (size, none): (usize, &[&str]) = (self.state_size(), &[]);
        let (of_c, of_d) = ((rows * states).max(1), (rows * inputs).max(1));
        let parts = c.chunks_mut(PART * of_c).zip(d.chunks_mut(PART * of_d));
        let jobs = parts.zip(y.chunks(PART * size)).enumerate().collect();
        share(threads, look, jobs, |(part, ((c, d), y)): LinearizedPart<'_>, go| {
            let inputs = acting.of_part(part, y.len() / size);
            let mut failures = Vec::new();
            let places = c.chunks_mut(of_c).zip(d.chunks_mut(of_d));
            for (index, (y, (c, d))) in y.chunks(size).zip(places).enumerate() {
                let Some(inputs) = inputs.get(index).or(inputs.first()) else { continue };
                let found = self.evaluator.unpack(y).map_err(EvaluationError::from);
                let found = found.and_then(|y| self.evaluator.linearize(&y, inputs, &NONE, none));
                match found {
                    // Rows first.
                    Ok(of) => {
                        c.copy_from_slice(of.c.transpose().as_slice());
                        d.copy_from_slice(of.d.transpose().as_slice());
                    }
                    Err(error) => {
                        failures.push((part * PART + index, Failure::Evaluation(Arc::new(error))));
                    }
                }
                if !go() {
                    break;
                }
            }
            failures
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
