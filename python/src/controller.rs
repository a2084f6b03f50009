//! [`PythonController`]: a function of Python as a controller of a run.

use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::Vector3;
use precess::control::{Command, Controller, ControllerError, ControllerSample};
use precess_dynamics::Quaternion;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Where a run leaves the exception of a function.
pub(crate) type Raised = Arc<Mutex<Option<PyErr>>>;

/// A function that is called with each sample.
pub(crate) struct PythonController {
    name: String,
    function: Py<PyAny>,
    raised: Raised,
}

impl PythonController {
    pub(crate) fn new(name: String, function: Py<PyAny>, raised: &Raised) -> Self {
        Self { name, function, raised: Arc::clone(raised) }
    }

    /// What the function answers.
    fn answer(&self, py: Python<'_>, sample: &ControllerSample<'_>) -> PyResult<Command> {
        let of = &sample.of;
        let attitude = |q: &Quaternion| (q.q0, q.q1, q.q2, q.q3);
        let vector = |v: &Vector3<f64>| (v.x, v.y, v.z);
        let joints: Vec<_> = sample.joints.iter().map(|[q, rate]| (*q, *rate)).collect();
        let reference = (
            attitude(&of.reference.attitude),
            vector(&of.reference.omega),
            vector(&of.reference.omega_dot),
        );
        let fields = (
            sample.time,
            attitude(&of.motion.attitude),
            vector(&of.motion.omega),
            reference,
            vector(&of.momentum),
            vector(&of.external),
            of.elapsed,
            of.limited,
            joints,
            sample.specific_force.as_ref().map(vector),
        );
        let answer = self.function.call1(py, fields)?;
        let answer = answer.bind(py);
        Self::command(answer).ok_or_else(|| {
            let shown: String = answer.repr().map_or_else(|_| String::new(), |text| text.to_string());
            let shown: String = shown.chars().take(60).collect();
            PyTypeError::new_err(format!(
                "the controller of {} returns {shown}; it needs three numbers, {{\"torque\": [x, y, z]}} or \
                 {{\"motors\": [..]}}",
                self.name
            ))
        })
    }

    /// Three numbers, or one of two keys.
    fn command(answer: &Bound<'_, PyAny>) -> Option<Command> {
        let torque = |of: &Bound<'_, PyAny>| {
            of.extract::<[f64; 3]>().ok().map(|of| Command::Torque(Vector3::from(of)))
        };
        let Ok(table) = answer.cast::<PyDict>() else { return torque(answer) };
        if table.len() != 1 {
            return None;
        }
        let of = |key: &str| table.get_item(key).ok().flatten();
        match (of("torque"), of("motors")) {
            (Some(value), None) => torque(&value),
            (None, Some(value)) => value.extract().ok().map(Command::Motors),
            _ => None,
        }
    }
}

impl Controller for PythonController {
    fn sample(&mut self, sample: &ControllerSample<'_>) -> Result<Command, ControllerError> {
        Python::attach(|py| {
            self.answer(py, sample).map_err(|error| {
                let reason = error.to_string();
                let mut raised = self.raised.lock().unwrap_or_else(PoisonError::into_inner);
                raised.get_or_insert(error);
                ControllerError::Program { reason }
            })
        })
    }
}
