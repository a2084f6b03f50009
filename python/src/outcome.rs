//! [`NativeResult`]: what a run returned, apart from its samples.

use std::path::{Path, PathBuf};

use numpy::PyReadonlyArray1;
use precess::record::{
    Columns, Csv, Drift, End, Event, Header, Npz, Outcome, Recorder, RunError, Steps, Verdict,
    replay,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors;
use crate::scenario::{ColumnFacts, NativeScenario, facts};

/// Name, quantity, value, limit (SI), unit with its size in SI, whether the whole window was run, state, why it is not
/// evaluated.
type VerdictFacts =
    (String, String, Option<f64>, f64, (String, f64), bool, &'static str, Option<String>);

/// Why a run ended: what it was; the name of its joint or crossing, or the message of its error; the bound, or
/// the time of the error, s; whether the joint slides.
type EndFacts = (String, String, Option<f64>, bool);
/// Why a run ended and when, steps, samples, events with the number left out, largest rates, drift, energy lost.
type OutcomeFacts = (
    EndFacts,
    f64,
    (u64, u64, u64),
    u64,
    (Vec<(f64, String)>, u64),
    Vec<f64>,
    (Option<f64>, Option<f64>, Option<f64>),
    f64,
);

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

    /// What is known of the run beside columns and requirements, for [`Self::restored`].
    #[getter]
    fn outcome(&self) -> OutcomeFacts {
        let outcome = &self.outcome;
        (
            end_facts(&outcome.end),
            outcome.end_time,
            self.steps(),
            outcome.samples,
            (self.events(), outcome.events_omitted),
            outcome.peak_rates.clone(),
            self.drift(),
            outcome.energy_lost,
        )
    }

    /// The result of a run in another process, without what became of its requirements.
    #[staticmethod]
    fn restored(scenario: &NativeScenario, outcome: OutcomeFacts) -> PyResult<Self> {
        let scenario = &scenario.scenario;
        let columns = Columns::from_scenario(scenario).map_err(|error| errors::record(&error))?;
        let (end, end_time, steps, samples, events, peak_rates, drift, energy_lost) = outcome;
        let (accepted, rejected, evaluations) = steps;
        let (events, events_omitted) = events;
        let (energy, linear, angular) = drift;
        let event = |(time, text)| Event { time, text };
        let outcome = Outcome {
            end_time,
            end: end_of(end)?,
            steps: Steps { accepted, rejected, evaluations },
            samples,
            events: events.into_iter().map(event).collect(),
            events_omitted,
            peak_rates,
            drift: Drift { energy, linear, angular },
            energy_lost,
        };
        Ok(Self { header: Header::new(scenario, &columns), outcome, verdicts: Vec::new() })
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

fn end_facts(end: &End) -> EndFacts {
    let facts =
        |what: &str, text: &str, number, slides| (what.to_owned(), text.to_owned(), number, slides);
    match end {
        End::Finished => facts("finished", "", None, false),
        End::EndStop { joint, bound, unit } => facts("stop", joint, Some(*bound), *unit == "m"),
        End::Crossing { name } => facts("crossing", name, None, false),
        End::Cancelled => facts("cancelled", "", None, false),
        End::Failed(error) => facts("failed", &error.to_string(), error.time(), false),
    }
}

/// The end of some facts.
fn end_of((what, text, number, slides): EndFacts) -> PyResult<End> {
    Ok(match (what.as_str(), number) {
        ("finished", _) => End::Finished,
        ("stop", Some(bound)) => {
            End::EndStop { joint: text, bound, unit: if slides { "m" } else { "rad" } }
        }
        ("crossing", _) => End::Crossing { name: text },
        ("cancelled", _) => End::Cancelled,
        ("failed", time) => End::Failed(RunError::Elsewhere { time, message: text }),
        _ => return Err(PyValueError::new_err(format!("`{what}` is no end of a run"))),
    })
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
