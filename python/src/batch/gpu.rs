//! [`GpuRows`]: accelerations and runs of a batch on a GPU (feature `cuda`), rows as those of the processor have them.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use precess::evaluation::Evaluator;
use precess::scenario::Scenario;
use precess_gpu::{
    ActingInputs, Batch, BatchInputs, BatchResult, Device, GpuError, Reduction, SampleSettings,
    Sources, StateError, Steps, generator, open,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use super::engine::Failure;
use super::rows::{Failed, InputRows};
use super::work::ProgressCheck;
use crate::errors;

/// A batch on a GPU, and why the processor computes it where it does.
pub(super) struct GpuRows {
    batch: Mutex<Batch>,
    fallback: Mutex<Option<GpuError>>,
}

/// The GPU of this machine, looked for once.
fn device() -> Result<&'static dyn Device, GpuError> {
    static DEVICE: OnceLock<Result<Box<dyn Device>, GpuError>> = OnceLock::new();
    match DEVICE.get_or_init(open) {
        Ok(device) => Ok(&**device),
        Err(error) => Err(error.clone()),
    }
}

/// What no kernel of a GPU has.
fn unsupported(what: &str) -> PyErr {
    let text = format!("backend \"cuda\" has no {what}; use backend=\"cpu\"");
    errors::class::UnsupportedError::new_err(text)
}

impl GpuRows {
    /// Of one spacecraft for every state, or of one for each element.
    ///
    /// # Errors
    /// A flexible structure, a platform or a panel that carries devices; what [`Batch::new`] refuses.
    pub(super) fn new(evaluator: &Evaluator, elements: &[Arc<Scenario>]) -> PyResult<Self> {
        let one = [evaluator.scenario()];
        let each = !elements.is_empty();
        let mut crafts = Vec::new();
        for scenario in elements.iter().map(|of| &**of).chain(one.into_iter().filter(|_| !each)) {
            if scenario.structure.is_some() {
                return Err(unsupported("flexible structures"));
            }
            let devices = scenario.devices_on_hub();
            let devices =
                devices.ok_or_else(|| unsupported("platforms and panels that carry devices"))?;
            crafts.push((scenario.hub, devices.to_vec()));
        }
        let derive = |kinds: &[_]| Sources::derive(&generator(), kinds);
        let batch = Batch::new(crafts, each, device(), derive);
        let batch =
            batch.map_err(|error| errors::class::UnsupportedError::new_err(error.to_string()))?;
        let fallback = Mutex::new(batch.fallback().cloned());
        Ok(Self { batch: Mutex::new(batch), fallback })
    }

    /// Why the processor computes, or computed the last call or a part of it.
    pub(super) fn fallback(&self) -> Option<String> {
        let reason = self.fallback.lock().unwrap_or_else(PoisonError::into_inner);
        reason.as_ref().map(ToString::to_string)
    }

    /// Whether a GPU computes.
    pub(super) fn is_there(&self) -> bool {
        self.batch.lock().unwrap_or_else(PoisonError::into_inner).fallback().is_none()
    }

    /// Accelerations of the states, one row each.
    pub(super) fn accelerations(
        &self,
        (y, acting): (&[f64], &InputRows),
        out: &mut [f64],
        look: ProgressCheck<'_>,
    ) -> Failed {
        let base = ActingInputs::new(&acting.base);
        let inputs = BatchInputs { base: &base, rows: &acting.rows };
        let mut batch = self.batch.lock().unwrap_or_else(PoisonError::into_inner);
        let width = batch.acceleration_size();
        // Lengths were checked.
        let Ok(result) = batch.accelerations(y, inputs, out, look) else { return Vec::new() };
        self.failed(result, &mut [(out, width)])
    }

    /// Steps of the states, inputs held: final states in `y`, samples, reductions in order.
    #[expect(clippy::type_complexity, reason = "samples where they are kept, reductions, failures")]
    pub(super) fn run(
        &self,
        (y, acting): (&mut [f64], &InputRows),
        (length, count): (f64, usize),
        settings: &SampleSettings,
        look: ProgressCheck<'_>,
    ) -> (Option<Vec<f64>>, Vec<Vec<f64>>, Failed) {
        let base = ActingInputs::new(&acting.base);
        let inputs = BatchInputs { base: &base, rows: &acting.rows };
        let mut batch = self.batch.lock().unwrap_or_else(PoisonError::into_inner);
        let size = batch.state_size();
        let steps = Steps { length, count, normalises: true };
        let found = batch.run(y, inputs, steps, settings, look);
        // Lengths were checked.
        let Ok((mut samples, result)) = found else { return (None, Vec::new(), Vec::new()) };
        let row = (count / settings.every.max(1) + 1) * size;
        let mut rows = vec![(y, size), (samples.history.as_mut_slice(), row)];
        rows.extend(samples.reduced.iter_mut().map(|of| (of.as_mut_slice(), size)));
        let failed = self.failed(result, &mut rows);
        let history = settings.history.then_some(samples.history);
        (history, samples.reduced, failed)
    }

    /// The failures, whose rows become NaN.
    fn failed(&self, result: BatchResult, rows: &mut [(&mut [f64], usize)]) -> Failed {
        *self.fallback.lock().unwrap_or_else(PoisonError::into_inner) = result.fallback;
        let mut failed = Vec::new();
        for (index, end) in result.states.into_iter().enumerate() {
            let Err(error) = end else { continue };
            for (all, width) in &mut *rows {
                if let Some(row) = all.get_mut(index * *width..(index + 1) * *width) {
                    row.fill(f64::NAN);
                }
            }
            let failure = match error {
                StateError::Parameters(error) => Failure::Parameters(error),
                StateError::Solve(error) => Failure::Solve(error),
            };
            failed.push((index, failure));
        }
        failed
    }
}

/// What a run keeps, by the names of reductions.
pub(super) fn settings(
    every: usize,
    history: bool,
    reductions: &[String],
) -> PyResult<SampleSettings> {
    let one = |name: &String| match name.as_str() {
        "min" => Ok(Reduction::Min),
        "max" => Ok(Reduction::Max),
        "mean" => Ok(Reduction::Mean),
        "rms" => Ok(Reduction::Rms),
        _ => Err(PyValueError::new_err(format!(
            "reduction `{name}` is not known; it is min, max, mean or rms"
        ))),
    };
    let reductions = reductions.iter().map(one).collect::<PyResult<_>>()?;
    Ok(SampleSettings { every, history, reductions })
}
