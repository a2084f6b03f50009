//! Derivatives of the accelerations of many states: matrices, products with directions and with weights.

use std::sync::{Arc, PoisonError};

use nalgebra::DMatrix;
use precess::evaluation::{
    CraftAccelerations, CraftInputs, CraftLinearization, CraftState, EvaluationError, Evaluator,
};
use precess_dynamics::Variable;
use precess_lanes::PART;

use super::engine::Failure;
use super::rows::{BatchRows, Failed, InputRows};
use super::work::{ProgressCheck, share};

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

/// States, one after the other, and what acts on each.
type Given<'a> = (&'a [f64], &'a InputRows);

/// Numbers of all elements, and how many are of each.
type Numbers<'a> = (&'a [f64], usize);
type NumbersMut<'a> = (&'a mut [f64], usize);

/// A part of a batch: its number, states, what is read and what is written.
struct Part<'a, const R: usize, const W: usize> {
    number: usize,
    y: &'a [f64],
    read: [Numbers<'a>; R],
    write: [NumbersMut<'a>; W],
}

impl BatchRows {
    /// The names of the linearised system, which depend on modes: made once for the same ones.
    ///
    /// # Errors
    ///
    /// Where there is none: friction that sticks.
    pub(crate) fn linearized(
        &self,
        inputs: &CraftInputs,
    ) -> Result<Arc<Linearized>, EvaluationError> {
        let variables = self.evaluator.linearized_variables(inputs)?;
        let mut last = self.names.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((known, names)) = &*last
            && *known == variables
        {
            return Ok(names.clone());
        }
        let named = |of: &Vec<Variable>| {
            of.iter().map(|variable| self.evaluator.variable_name(*variable)).collect()
        };
        let [states, inputs] = variables.each_ref().map(named);
        let outputs = self.evaluator.acceleration_names();
        let names = Arc::new(Linearized { outputs, states, inputs });
        *last = Some((variables, names.clone()));
        Ok(names)
    }

    /// Derivatives of the accelerations of each state by states, C, and by inputs, D, rows first.
    pub(crate) fn linearize(
        &self,
        given: Given<'_>,
        Sizes { rows, states, inputs }: Sizes,
        (c, d): (&mut [f64], &mut [f64]),
        threads: usize,
        look: ProgressCheck<'_>,
    ) -> Failed {
        let write = [(c, rows * states), (d, rows * inputs)];
        let work = |craft: &Evaluator,
                    (state, inputs): (&CraftState, &CraftInputs),
                    []: [&[f64]; 0],
                    [c, d]: [&mut [f64]; 2],
                    kept: &mut Option<CraftLinearization>| {
            let found = craft.linearize_into(state, inputs, kept)?;
            write_rows(&found.c, c);
            write_rows(&found.d, d);
            Ok(())
        };
        self.by_state(given, ([], write), (threads, look), work)
    }

    /// What the accelerations change by along a direction of states and of inputs, for each state.
    pub(crate) fn jvp(
        &self,
        given: Given<'_>,
        Sizes { rows, states, inputs }: Sizes,
        (dx, du): (&[f64], &[f64]),
        out: &mut [f64],
        threads: usize,
        look: ProgressCheck<'_>,
    ) -> Failed {
        let work = |craft: &Evaluator,
                    (state, inputs): (&CraftState, &CraftInputs),
                    [dx, du]: [&[f64]; 2],
                    [out]: [&mut [f64]; 1],
                    (): &mut ()| craft.jvp(state, inputs, (dx, du), out);
        let read = [(dx, states), (du, inputs)];
        self.by_state(given, (read, [(out, rows)]), (threads, look), work)
    }

    /// The gradient of the sum of the accelerations times weights by states and by inputs, for each state.
    pub(crate) fn vjp(
        &self,
        given: Given<'_>,
        Sizes { rows, states, inputs }: Sizes,
        weights: &[f64],
        (by_states, by_inputs): (&mut [f64], &mut [f64]),
        threads: usize,
        look: ProgressCheck<'_>,
    ) -> Failed {
        let work = |craft: &Evaluator,
                    (state, inputs): (&CraftState, &CraftInputs),
                    [weights]: [&[f64]; 1],
                    [by_states, by_inputs]: [&mut [f64]; 2],
                    kept: &mut Option<CraftAccelerations>| {
            craft.vjp(state, inputs, weights, (by_states, by_inputs), kept)
        };
        let write = [(by_states, states), (by_inputs, inputs)];
        self.by_state(given, ([(weights, rows)], write), (threads, look), work)
    }

    /// Does work with each state; where it fails, what it writes becomes NaN. What it keeps is that of the state before it.
    fn by_state<const R: usize, const W: usize, K: Default>(
        &self,
        (y, acting): Given<'_>,
        (read, write): ([Numbers<'_>; R], [NumbersMut<'_>; W]),
        (threads, look): (usize, ProgressCheck<'_>),
        work: impl Fn(
            &Evaluator,
            (&CraftState, &CraftInputs),
            [&[f64]; R],
            [&mut [f64]; W],
            &mut K,
        ) -> Result<(), EvaluationError>
        + Sync,
    ) -> Failed {
        let size = self.state_size();
        let jobs = parts((y, size), read, write);
        share(threads, look, jobs, |part: Part<'_, R, W>, go| {
            let Part { number, y, read, mut write } = part;
            let inputs = acting.of_part(number, y.len() / size);
            let (mut kept, mut failures) = (K::default(), Vec::new());
            for (index, y) in y.chunks_exact(size).enumerate() {
                let Some(inputs) = inputs.get(index).or(inputs.first()) else { continue };
                let of = read.map(|(numbers, width)| {
                    numbers.get(index * width..(index + 1) * width).unwrap_or_default()
                });
                let to = rows_of(&mut write, index);
                let found = self.craft(number * PART + index).and_then(|craft| {
                    let state = craft.unpack(y).map_err(EvaluationError::from);
                    let found = state.and_then(|y| work(craft, (&y, inputs), of, to, &mut kept));
                    found.map_err(|error| Failure::Evaluation(Arc::new(error)))
                });
                if let Err(failure) = found {
                    for row in rows_of(&mut write, index) {
                        row.fill(f64::NAN);
                    }
                    failures.push((number * PART + index, failure));
                }
                if !go() {
                    break;
                }
            }
            failures
        })
    }
}

/// The rows of an element.
fn rows_of<'a, const W: usize>(
    write: &'a mut [NumbersMut<'_>; W],
    index: usize,
) -> [&'a mut [f64]; W] {
    write.each_mut().map(|(numbers, width)| {
        numbers.get_mut(index * *width..(index + 1) * *width).unwrap_or_default()
    })
}

/// Parts of a batch.
fn parts<'a, const R: usize, const W: usize>(
    (y, size): Numbers<'a>,
    mut read: [Numbers<'a>; R],
    mut write: [NumbersMut<'a>; W],
) -> Vec<Part<'a, R, W>> {
    let mut parts = Vec::new();
    for (number, y) in y.chunks(PART * size).enumerate() {
        let read = read.each_mut().map(|(numbers, width)| {
            let (part, rest) = numbers.split_at(numbers.len().min(PART * *width));
            *numbers = rest;
            (part, *width)
        });
        let write = write.each_mut().map(|(numbers, width)| {
            let all = std::mem::take(numbers);
            let (part, rest) = all.split_at_mut(all.len().min(PART * *width));
            *numbers = rest;
            (part, *width)
        });
        parts.push(Part { number, y, read, write });
    }
    parts
}

/// Writes a matrix, rows first.
fn write_rows(from: &DMatrix<f64>, to: &mut [f64]) {
    for (to, row) in to.chunks_exact_mut(from.ncols().max(1)).zip(from.row_iter()) {
        to.iter_mut().zip(row.iter()).for_each(|(to, from)| *to = *from);
    }
}
