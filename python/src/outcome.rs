//! [`NativeResult`]: what a run returned, apart from its samples.

use std::path::{Path, PathBuf};

use numpy::PyReadonlyArray1;
use precess::engine::{End, Outcome};
use precess::record::{Csv, Header, Npz, Recorder, Verdict, replay};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors;
use crate::scenario::{ColumnFacts, facts};

/// Name, quantity, value, limit (SI), unit with its size in SI, whether the whole window was run, state, why it is not
/// evaluated.
type VerdictFacts =
    (String, String, Option<f64>, f64, (String, f64), bool, &'static str, Option<String>);

/// What a run returned.
#[pyclass(frozen, module = "precess._native")]
pub(crate) struct NativeResult {
    pub(crate) header: Header,
    pub(crate) outcome: Outcome,
    pub(crate) verdicts: Vec<Verdict>,
}

#[pymethods]
impl NativeResult {
    /// The columns in order, `time` first.
    #[getter]
    fn columns(&self) -> Vec<ColumnFacts> {
        self.header.columns.iter().map(facts).collect()
    }

    /// Why the run ended: `finished`.
    #[getter]
    fn end(&self) -> String {
        self.outcome.end.to_string()
    }

    /// Whether it reached its end as the scenario has it.
    #[getter]
    fn is_complete(&self) -> bool {
        self.outcome.end.is_complete()
    }

    /// Simulated time at which it ended, s.
    #[getter]
    fn end_time(&self) -> f64 {
        self.outcome.end_time
    }

    /// Steps accepted and rejected, and evaluations.
    #[getter]
    fn steps(&self) -> (u64, u64, u64) {
        let steps = self.outcome.steps;
        (steps.accepted, steps.rejected, steps.evaluations)
    }

    /// Time, s, and text of each event.
    #[getter]
    fn events(&self) -> Vec<(f64, String)> {
        self.outcome.events.iter().map(|event| (event.time, event.text.clone())).collect()
    }

    /// Drift of energy, linear and angular momentum, each in its unit; none of what is not conserved.
    #[getter]
    fn drift(&self) -> (Option<f64>, Option<f64>, Option<f64>) {
        let drift = self.outcome.drift;
        (drift.energy, drift.linear, drift.angular)
    }

    /// Energy lost in brakes and locking end stops, J.
    #[getter]
    fn energy_lost(&self) -> f64 {
        self.outcome.energy_lost
    }

    /// What became of each requirement.
    #[getter]
    fn verdicts(&self) -> Vec<VerdictFacts> {
        let facts = |of: &Verdict| {
            let Verdict { name, quantity, value, limit, unit, complete, state } = of.clone();
            let reason = state.reason().map(ToString::to_string);
            (name, quantity, value, limit, unit, complete, state.word(), reason)
        };
        self.verdicts.iter().map(facts).collect()
    }

    /// Writes the samples to a file, which gets its name when it is complete.
    #[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
    fn save(
        &self,
        py: Python<'_>,
        format: &str,
        path: PathBuf,
        columns: Vec<PyReadonlyArray1<'_, f64>>,
    ) -> PyResult<()> {
        let slices: Result<Vec<&[f64]>, _> =
            columns.iter().map(|column| column.as_slice()).collect();
        let slices = slices?;
        let mut to = recorder(format, &path)?;
        let (header, outcome) = (&self.header, &self.outcome);
        let written = py.detach(|| replay(header, &slices, outcome, &mut *to));
        written.map_err(|error| errors::record(&error))
    }

    /// Raises the error that ended the run.
    fn raise_error(&self) -> PyResult<()> {
        match &self.outcome.end {
            End::Failed(error) => Err(errors::run(error)),
            _ => Ok(()),
        }
    }
}

/// A recorder of the format.
pub(crate) fn recorder(format: &str, path: &Path) -> PyResult<Box<dyn Recorder + Send>> {
    match format {
        "csv" => Ok(Box::new(Csv::new(path))),
        "npz" => Ok(Box::new(Npz::new(path))),
        _ => {
            let message = format!("format `{format}` is not known; it is csv, npz or parquet");
            Err(PyValueError::new_err(message))
        }
    }
}
