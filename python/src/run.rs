//! [`run`]: a scenario into arrays and files.

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::PoisonError;
use std::time::{Duration, Instant};

use numpy::{IntoPyArray as _, PyArray1};
use precess::control::Controller;
use precess::engine::run_with_controllers;
use precess::record::{Histories, Recorder, RecorderGroup, Statistics};
use pyo3::prelude::*;

use crate::controller::{PythonController, Raised};
use crate::errors;
use crate::outcome::{NativeResult, recorder};
use crate::scenario::NativeScenario;

/// Between looks at signals and calls of `progress`.
const PERIOD: Duration = Duration::from_millis(50);

/// Runs a scenario; files of these formats are written on the way.
///
/// `progress` is called with the simulated time, s; the run is cancelled where it returns False. Ctrl-C
/// raises `KeyboardInterrupt`, with the files complete up to there. `controllers` are functions that are called with each
/// sample, in the place of the laws of the scenario's controllers of these names; what one raises is raised.
#[pyfunction]
#[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
pub(crate) fn run<'py>(
    py: Python<'py>,
    scenario: &NativeScenario,
    progress: Option<Py<PyAny>>,
    files: Vec<(String, PathBuf)>,
    controllers: Vec<(String, Py<PyAny>)>,
) -> PyResult<(NativeResult, Vec<Bound<'py, PyArray1<f64>>>)> {
    let scenario = scenario.scenario.clone();
    let mut histories = Histories::default();
    let mut statistics = Statistics::new(&scenario.requirements);
    let files: PyResult<Vec<_>> =
        files.iter().map(|(format, path)| recorder(format, path)).collect();
    let mut files = files?;
    let mut raised = None;
    let mut last = Instant::now();
    let raised_by_controller = Raised::default();
    let controllers = controllers
        .into_iter()
        .map(|(name, function)| -> (String, Box<dyn Controller>) {
            let own = PythonController::new(name.clone(), function, &raised_by_controller);
            (name, Box::new(own))
        })
        .collect();
    let ran = py.detach(|| {
        let mut hear = |time: f64| {
            if last.elapsed() < PERIOD {
                return ControlFlow::Continue(());
            }
            last = Instant::now();
            Python::attach(|py| match heard(py, progress.as_ref(), time) {
                Ok(true) => ControlFlow::Continue(()),
                Ok(false) => ControlFlow::Break(()),
                Err(error) => {
                    raised = Some(error);
                    ControlFlow::Break(())
                }
            })
        };
        let mut all: Vec<&mut dyn Recorder> = vec![&mut histories, &mut statistics];
        all.extend(files.iter_mut().map(|file| &mut **file as &mut dyn Recorder));
        run_with_controllers(&scenario, controllers, &mut RecorderGroup::new(all), &mut hear)
    });
    let of_controller = raised_by_controller.lock().unwrap_or_else(PoisonError::into_inner).take();
    if let Some(error) = raised.or(of_controller) {
        return Err(error);
    }
    let outcome = ran.map_err(|error| errors::run(&error))?;
    // A run that cannot start has no header, and is an error above.
    let header = histories.header.ok_or_else(|| errors::class::RunError::new_err("no samples"))?;
    let verdicts = statistics.verdicts().to_vec();
    let arrays = histories.columns.into_iter().map(|column| column.into_pyarray(py)).collect();
    Ok((NativeResult { header, outcome, verdicts }, arrays))
}

/// Whether to go on, after signals and `progress`.
fn heard(py: Python<'_>, progress: Option<&Py<PyAny>>, time: f64) -> PyResult<bool> {
    py.check_signals()?;
    let Some(progress) = progress else { return Ok(true) };
    let answer = progress.call1(py, (time,))?;
    let answer = answer.bind(py);
    Ok(answer.is_none() || answer.is_truthy()?)
}
