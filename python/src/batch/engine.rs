//! [`Engine`]: what evaluates a batch, in lanes or one state after another.

use std::sync::Arc;

use precess::evaluation::{CraftInputs, EvaluationError, Evaluator};
use precess::record::RunError;
use precess::scenario::Scenario;
use precess_dynamics::{BuiltIn, Hub, ParameterError, SolveError};
use precess_lanes::{BatchSupport, Lanes, PART, RunObserver, SEGMENT, StateInputs, Steps, lanes};
use pyo3::PyErr;

use super::reduce::PartHistory;
use crate::errors;
use crate::evaluator::flat;

/// Why an element has no result.
#[derive(Clone)]
pub(crate) enum Failure {
    /// Its state and inputs have no accelerations.
    Solve(SolveError),
    /// Its parameters are not those of a spacecraft.
    Parameters(ParameterError),
    /// Its scenario is rejected: the message.
    Scenario(Arc<RunError>),
    /// It cannot be linearised.
    Evaluation(Arc<EvaluationError>),
}

impl Failure {
    /// As Python raises it.
    pub(super) fn exception(&self) -> PyErr {
        match self {
            Self::Solve(error) => errors::solve(error),
            Self::Parameters(error) => errors::class::ParameterError::new_err(error.to_string()),
            Self::Scenario(error) => errors::run(error),
            Self::Evaluation(error) => errors::evaluation(error),
        }
    }
}

pub(super) type StateResults = Vec<Result<(), Failure>>;

/// What evaluates a batch.
pub(super) enum Engine {
    /// In lanes; what is wrong with each spacecraft, or with the only one.
    Lanes(Box<dyn Lanes>, Vec<Option<ParameterError>>),
    /// One after another: a spacecraft for each element, or the only one.
    Scalar(Vec<Result<Arc<Evaluator>, Arc<RunError>>>, bool),
}

impl Engine {
    /// Of one spacecraft.
    pub(super) fn same(evaluator: &Arc<Evaluator>, in_lanes: bool) -> Self {
        let made = of_kind(&[evaluator.scenario()], false, in_lanes);
        made.unwrap_or_else(|| Self::Scalar(vec![Ok(evaluator.clone())], false))
    }

    /// Of one spacecraft for each element.
    pub(super) fn each(scenarios: &[Arc<Scenario>], in_lanes: bool) -> Self {
        let all: Vec<&Scenario> = scenarios.iter().map(|of| &**of).collect();
        of_kind(&all, true, in_lanes).unwrap_or_else(|| {
            let one = |of: &Arc<Scenario>| Evaluator::new(of).map(Arc::new).map_err(Arc::new);
            Self::Scalar(scenarios.iter().map(one).collect(), true)
        })
    }

    pub(super) fn is_laned(&self) -> bool {
        matches!(self, Self::Lanes(..))
    }

    /// Accelerations of the states of a part.
    pub(super) fn accelerations(
        &self,
        part: usize,
        (y, count): (&[f64], usize),
        inputs: &[CraftInputs],
        out: &mut [f64],
    ) -> StateResults {
        match self {
            Self::Lanes(lanes, errors) => {
                let ends = lanes.accelerations(part, y, &state_inputs(inputs), out);
                joined(ends, errors, part, count)
            }
            Self::Scalar(all, each) => {
                let (size, width) = (y.len() / count.max(1), out.len() / count.max(1));
                let rows = y.chunks_exact(size.max(1)).zip(out.chunks_exact_mut(width.max(1)));
                let one = |(index, (y, out)): (usize, (&[f64], &mut [f64]))| {
                    let craft = craft(all, *each, part, index)?;
                    let inputs = inputs.get(index).or(inputs.first());
                    let state = craft.unpack(y).map_err(Failure::Solve)?;
                    let Some(inputs) = inputs else { return Ok(()) };
                    let found = craft.accelerations(&state, inputs).map_err(Failure::Solve)?;
                    out.copy_from_slice(&flat(&found));
                    Ok(())
                };
                rows.enumerate().map(one).collect()
            }
        }
    }

    /// Steps of the states of a part.
    pub(super) fn run(
        &self,
        part: usize,
        y: &mut [f64],
        inputs: &[CraftInputs],
        steps: Steps,
        kept: &mut PartHistory<'_>,
        go: &(dyn Fn() -> bool + Sync),
    ) -> StateResults {
        match self {
            Self::Lanes(lanes, errors) => {
                let size = kept.size();
                let count = y.len() / size;
                let mut see = |index: usize, steps: usize, row: &[f64]| kept.see(index, steps, row);
                let watch = RunObserver { see: &mut see, go };
                let ends = lanes.run(part, y, &state_inputs(inputs), steps, watch);
                joined(ends, errors, part, count)
            }
            Self::Scalar(all, each) => {
                let size = kept.size();
                let rows = y.chunks_exact_mut(size).enumerate();
                let one = |(index, y): (usize, &mut [f64])| {
                    let craft = craft(all, *each, part, index)?;
                    let Some(inputs) = inputs.get(index).or(inputs.first()) else { return Ok(()) };
                    let mut state = craft.unpack(y).map_err(Failure::Solve)?;
                    for step in 1..=steps.count {
                        if step % SEGMENT == 0 && !go() {
                            break;
                        }
                        let stepped = craft.step(&state, inputs, steps.length);
                        state = stepped.map_err(Failure::Solve)?;
                        if step % steps.every == 0 {
                            kept.see(index, step, &craft.pack(&state));
                        }
                    }
                    y.copy_from_slice(&craft.pack(&state));
                    Ok(())
                };
                rows.map(one).collect()
            }
        }
    }
}

/// The spacecraft of an element.
fn craft(
    all: &[Result<Arc<Evaluator>, Arc<RunError>>],
    each: bool,
    part: usize,
    index: usize,
) -> Result<&Arc<Evaluator>, Failure> {
    let place = if each { part * PART + index } else { 0 };
    match all.get(place) {
        Some(Ok(craft)) => Ok(craft),
        Some(Err(error)) => Err(Failure::Scenario(error.clone())),
        // As many states as spacecraft were checked.
        None => Err(Failure::Solve(SolveError::Count { expected: all.len(), found: place + 1 })),
    }
}

/// Ends of lanes, or what is wrong with the spacecraft.
fn joined(
    ends: precess_lanes::StateResults,
    errors: &[Option<ParameterError>],
    part: usize,
    count: usize,
) -> StateResults {
    let wrong = |index: usize| {
        let place = if errors.len() == 1 { 0 } else { part * PART + index };
        errors.get(place).copied().flatten()
    };
    let mut ends = ends.into_iter();
    let one = |index| match (wrong(index), ends.next()) {
        (Some(error), _) => Err(Failure::Parameters(error)),
        (None, Some(end)) => end.map_err(Failure::Solve),
        (None, None) => Ok(()),
    };
    (0..count).map(one).collect()
}

/// The engine in lanes; none where they do not support the spacecraft.
fn of_kind(scenarios: &[&Scenario], each: bool, in_lanes: bool) -> Option<Engine> {
    let simple = |of: &&Scenario| of.structure.is_none() && of.devices_on_hub().is_some();
    if !in_lanes || !scenarios.iter().all(simple) {
        return None;
    }
    let crafts: Vec<(Hub, Vec<BuiltIn>)> =
        scenarios.iter().map(|of| (of.hub, of.devices.0.clone())).collect();
    match lanes(&crafts, each) {
        BatchSupport::Lanes(lanes, errors) => Some(Engine::Lanes(lanes, errors)),
        BatchSupport::Unsupported => None,
    }
}

fn state_inputs(inputs: &[CraftInputs]) -> Vec<StateInputs> {
    inputs.iter().map(StateInputs::new).collect()
}
