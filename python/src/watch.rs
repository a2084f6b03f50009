//! [`watch`]: what has changed in telemetry, in arrays or in a file.

use std::path::PathBuf;
use std::sync::Arc;

use numpy::{PyArray1, PyReadonlyArray1};
use precess::telemetry::{TelemetryLayout, TelemetryRows};
use precess::watch::{Alarm, WatchSettings, WatchedRecord, watch as watched};
use pyo3::prelude::*;

use crate::errors;
use crate::scenario::NativeScenario;

/// Name, unit; time, onset, before, change, half width; test; what looks the same.
type AlarmFacts = (String, &'static str, [f64; 5], &'static str, Vec<String>);
/// Name, unit; mean and scatter of the reference.
type QuantityFacts = (String, &'static str, Option<[f64; 2]>);

/// What a record says.
#[pyclass(frozen, module = "precess._native")]
pub(crate) struct NativeWatched(WatchedRecord);

#[pymethods]
impl NativeWatched {
    /// Alarms, in the order of time.
    #[getter]
    fn alarms(&self) -> Vec<AlarmFacts> {
        let facts = |of: &Alarm| {
            let shift = &of.shift;
            let numbers = [of.time, shift.onset, shift.before, shift.change, shift.half_width];
            (of.name.clone(), of.watched.unit(), numbers, shift.test.name(), of.alike.clone())
        };
        self.0.blocks.iter().flat_map(|block| &block.alarms).map(facts).collect()
    }

    /// The quantities.
    #[getter]
    fn quantities(&self) -> Vec<QuantityFacts> {
        let quantities = self.0.quantities.iter();
        quantities.map(|of| (of.name.clone(), of.watched.unit(), of.reference)).collect()
    }

    /// Start and end of each block, s.
    fn times<'py>(&self, py: Python<'py>) -> [Bound<'py, PyArray1<f64>>; 2] {
        [0, 1]
            .map(|end| PyArray1::from_iter(py, self.0.blocks.iter().map(|block| block.times[end])))
    }

    /// Value and standard deviation of a quantity in each block; NaN where a block does not determine it.
    fn series<'py>(&self, py: Python<'py>, quantity: usize) -> [Bound<'py, PyArray1<f64>>; 2] {
        let of = |pick: fn([f64; 2]) -> f64| {
            let values = self.0.blocks.iter().map(move |block| {
                block.values.get(quantity).copied().flatten().map_or(f64::NAN, pick)
            });
            PyArray1::from_iter(py, values)
        };
        [of(|[value, _]| value), of(|[_, variance]| variance.sqrt())]
    }

    /// What was left out of the telemetry, in sentences.
    #[getter]
    fn exclusions(&self) -> Vec<String> {
        self.0.exclusions.iter().map(ToString::to_string).collect()
    }

    /// What is not watched, with the reason.
    #[getter]
    fn remarks(&self) -> Vec<String> {
        self.0.remarks.clone()
    }
}

/// Watches columns, or a file where there are none. Ctrl-C raises `KeyboardInterrupt`.
#[pyfunction]
pub(crate) fn watch(
    py: Python<'_>,
    scenario: &NativeScenario,
    columns: Vec<(String, PyReadonlyArray1<'_, f64>)>,
    data: Option<PathBuf>,
    controller: Option<String>,
    lengths: [f64; 2],
    false_alarms: f64,
) -> PyResult<NativeWatched> {
    let scenario = Arc::clone(&scenario.scenario);
    let columns: Vec<(String, Vec<f64>)> = columns
        .into_iter()
        .map(|(name, of)| (name, of.as_array().iter().copied().collect()))
        .collect();
    let [block, learn] = lengths;
    let settings = WatchSettings { block, learn, false_alarms };
    let mut raised = None;
    let found = py.detach(|| {
        let layout = TelemetryLayout::of_scenario(&scenario, controller.as_deref());
        let layout = layout.map_err(|error| errors::signal(&error))?;
        let rows = match &data {
            Some(path) => TelemetryRows::open(path, &layout),
            None => TelemetryRows::of_columns("data", columns, &layout),
        };
        let mut rows = rows.map_err(|error| errors::signal(&error))?;
        let mut hear = |_: f64| match Python::attach(|py| py.check_signals()) {
            Ok(()) => true,
            Err(error) => {
                raised = Some(error);
                false
            }
        };
        watched(&scenario, &mut rows, &settings, &mut hear).map_err(|error| errors::signal(&error))
    });
    match raised {
        Some(error) => Err(error),
        None => found.map(NativeWatched),
    }
}
