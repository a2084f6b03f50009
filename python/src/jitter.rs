//! A jitter budget: lines of rotors over the speed against the limits of lines of sight, as [`precess::jitter`] has it.

use std::path::PathBuf;

use precess::file::{budget_from_toml, budget_overrides, from_file};
use precess::jitter::budget::Budget;
use precess::jitter::prepared::Prepared;
use precess::jitter::sweep::{Sweep, sweep};
use precess::pointing::Metric;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors;

/// What a sweep found.
#[pyclass(frozen, module = "precess._native")]
pub(crate) struct NativeBudget {
    budget: Budget,
    sweep: Sweep,
    /// Sources that the frequency domain does not have.
    #[pyo3(get)]
    left_out: Vec<String>,
    assessed: Vec<precess::jitter::budget::Assessed>,
}

/// Name, line of sight, metric, limit, unit and its size; the metric at each speed, the number of the worst one; shares
/// of contributors there, the share of noise; speeds to keep out of; state, and why it is not evaluated.
type Facts = (
    (String, String, String, f64, String, f64),
    (Vec<f64>, usize),
    (Vec<(usize, f64)>, f64),
    Vec<[f64; 2]>,
    (&'static str, Option<String>),
);

#[pymethods]
impl NativeBudget {
    #[getter]
    fn title(&self) -> &str {
        &self.budget.title
    }

    /// rad/s.
    #[getter]
    fn speeds(&self) -> Vec<f64> {
        self.sweep.speeds.clone()
    }

    /// Rotor, cause and order of each line.
    #[getter]
    fn contributors(&self) -> Vec<(String, String, f64)> {
        let all = self.sweep.contributors.iter();
        all.map(|of| (of.rotor.clone(), of.cause.clone(), of.order)).collect()
    }

    #[getter]
    fn requirements(&self) -> Vec<Facts> {
        let sight = |of: usize| self.budget.sights.get(of).map_or("", |sight| sight.name.as_str());
        let facts = |of: &precess::jitter::budget::Assessed| {
            let (unit, size) = of.limit.unit.clone();
            (
                (
                    of.limit.name.clone(),
                    sight(of.sight).to_owned(),
                    words(&of.limit.metric),
                    of.limit.limit,
                    unit,
                    size,
                ),
                (of.values.clone(), of.worst),
                (of.shares.clone(), of.noise),
                of.keep_out.clone(),
                (of.state().word(), of.state().reason().map(ToString::to_string)),
            )
        };
        self.assessed.iter().map(facts).collect()
    }
}

/// What a metric is, in words.
fn words(metric: &Metric) -> String {
    match metric {
        Metric::Rms => "RMS".to_owned(),
        Metric::BandRms([from, to]) => format!("RMS, {from} to {to} Hz"),
        Metric::Displacement(time) => format!("displacement, exposure {time} s"),
        Metric::Smear(time) => format!("smear, exposure {time} s"),
        Metric::Jitter(time) => format!("jitter, exposure {time} s"),
        Metric::Index { index, .. } => index.name().to_owned(),
    }
}

/// Reads a budget and sweeps the speeds of its rotors.
#[pyfunction]
#[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
pub(crate) fn jitter_budget(
    py: Python<'_>,
    path: PathBuf,
    overrides: Vec<String>,
    threads: usize,
) -> PyResult<NativeBudget> {
    let split = budget_overrides(&overrides).map_err(PyValueError::new_err)?;
    let [of_budget, of_scenario] = split;
    py.detach(|| {
        let (budget, scenario) =
            budget_from_toml(&path, &of_budget).map_err(|found| errors::scenario(&found))?;
        let read = from_file(&scenario, &of_scenario);
        let (scenario, _) = read.map_err(|found| errors::scenario(&found))?;
        let prepared = Prepared::new(&scenario, &budget).map_err(fault)?;
        let Prepared { model, left_out, speeds, .. } = prepared;
        let sweep = sweep(&model, &speeds, threads, &|_| {}).map_err(fault)?;
        let assessed = budget.assess(&sweep).map_err(fault)?;
        Ok(NativeBudget { budget, sweep, left_out, assessed })
    })
}

fn fault(error: impl std::fmt::Display) -> PyErr {
    errors::class::RunError::new_err((error.to_string(), None::<f64>))
}
