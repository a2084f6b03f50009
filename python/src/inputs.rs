//! [`NativeInputs`]: forces, torques and modes, read and written by Python.

use std::sync::{Arc, Mutex, MutexGuard};

use numpy::{IntoPyArray as _, PyArray1, PyArray2, PyArrayMethods as _};
use precess::evaluation::{CraftInputs, Evaluator};
use precess_dynamics::{Each as _, Gravity, HubMode, Mode, Wrench};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;

use nalgebra::Vector3;

/// What acts on a spacecraft.
#[pyclass(frozen, module = "precess._native")]
pub(crate) struct NativeInputs {
    inputs: Mutex<CraftInputs>,
    evaluator: Arc<Evaluator>,
}

impl NativeInputs {
    pub(crate) fn new(inputs: CraftInputs, evaluator: Arc<Evaluator>) -> Self {
        Self { inputs: Mutex::new(inputs), evaluator }
    }

    /// The inputs, until the guard is dropped; never held across a call of Python.
    pub(crate) fn get(&self) -> PyResult<MutexGuard<'_, CraftInputs>> {
        self.inputs.lock().map_err(|_| PyRuntimeError::new_err("an earlier call panicked"))
    }
}

#[pymethods]
impl NativeInputs {
    /// A copy.
    fn copy(&self) -> PyResult<Self> {
        Ok(Self::new(self.get()?.clone(), self.evaluator.clone()))
    }

    /// External force through B, in B, N.
    #[getter]
    fn force(&self) -> PyResult<[f64; 3]> {
        Ok(self.get()?.force.into())
    }

    #[setter]
    fn set_force(&self, force: [f64; 3]) -> PyResult<()> {
        self.get()?.force = force.into();
        Ok(())
    }

    /// External torque about B, in B, N m.
    #[getter]
    fn torque(&self) -> PyResult<[f64; 3]> {
        Ok(self.get()?.torque_b.into())
    }

    #[setter]
    fn set_torque(&self, torque: [f64; 3]) -> PyResult<()> {
        self.get()?.torque_b = torque.into();
        Ok(())
    }

    /// Motor torque or force of each joint, N m or N.
    #[getter]
    fn motors<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let motors: Vec<f64> = self.get()?.motors.values().collect();
        Ok(motors.into_pyarray(py))
    }

    #[setter]
    #[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
    fn set_motors(&self, motors: Vec<f64>) -> PyResult<()> {
        let mut inputs = self.get()?;
        count(inputs.motors.values().count(), motors.len())?;
        inputs.motors.values_mut().zip(&motors).for_each(|(to, from)| *to = *from);
        Ok(())
    }

    /// Mode of each joint, and its acceleration where that is prescribed.
    #[getter]
    fn modes(&self) -> PyResult<Vec<(&'static str, f64)>> {
        let facts = |mode| match mode {
            Mode::Driven => ("driven", 0.0),
            Mode::Prescribed(acceleration) => ("prescribed", acceleration),
            Mode::Locked => ("locked", 0.0),
        };
        Ok(self.get()?.modes.values().map(facts).collect())
    }

    #[setter]
    #[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
    fn set_modes(&self, modes: Vec<(String, f64)>) -> PyResult<()> {
        let mut inputs = self.get()?;
        count(inputs.modes.values().count(), modes.len())?;
        let modes: PyResult<Vec<Mode>> = modes.iter().map(mode).collect();
        inputs.modes.values_mut().zip(modes?).for_each(|(to, from)| *to = from);
        Ok(())
    }

    /// Mode of the hub; its acceleration and angular acceleration, in B, where they are prescribed.
    #[getter]
    fn hub(&self) -> PyResult<(&'static str, [f64; 3], [f64; 3])> {
        Ok(match self.get()?.hub {
            HubMode::Free => ("free", [0.0; 3], [0.0; 3]),
            HubMode::Fixed => ("fixed", [0.0; 3], [0.0; 3]),
            HubMode::Prescribed { r_b_n_ddot, omega_dot } => {
                ("prescribed", r_b_n_ddot.into(), omega_dot.into())
            }
        })
    }

    #[setter]
    fn set_hub(&self, hub: (String, [f64; 3], [f64; 3])) -> PyResult<()> {
        let (mode, acceleration, omega_dot) = hub;
        self.get()?.hub = match mode.as_str() {
            "free" => HubMode::Free,
            "fixed" => HubMode::Fixed,
            "prescribed" => {
                HubMode::Prescribed { r_b_n_ddot: acceleration.into(), omega_dot: omega_dot.into() }
            }
            _ => return Err(unknown("the hub's mode", &mode, "free, fixed or prescribed")),
        };
        Ok(())
    }

    /// Uniform field, in N, m/s², or gravitational parameter of a central body, m³/s².
    #[getter]
    fn gravity(&self) -> PyResult<(Option<[f64; 3]>, Option<f64>)> {
        Ok(match self.get()?.gravity {
            Gravity::None => (None, None),
            Gravity::Uniform(field) => (Some(field.into()), None),
            Gravity::Central { mu } => (None, Some(mu)),
        })
    }

    #[setter]
    fn set_gravity(&self, gravity: (Option<[f64; 3]>, Option<f64>)) -> PyResult<()> {
        self.get()?.gravity = match gravity {
            (None, None) => Gravity::None,
            (Some(field), None) => Gravity::Uniform(field.into()),
            (None, Some(mu)) => Gravity::Central { mu },
            (Some(_), Some(_)) => {
                let message = "gravity is uniform and central; keep one of them";
                return Err(PyValueError::new_err(message));
            }
        };
        Ok(())
    }

    /// Force, N, and moment, N m, on the child body of each joint, about the joint's origin, in the
    /// body's axes, shape (joints, 6); none where there is none.
    #[getter]
    fn wrenches<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray2<f64>>>> {
        let inputs = self.get()?;
        let Some(bodies) = &inputs.bodies else { return Ok(None) };
        let rows: Vec<f64> = bodies
            .values()
            .flat_map(|of| of.force.iter().chain(of.moment.iter()).copied().collect::<Vec<_>>())
            .collect();
        let joints = rows.len() / 6;
        drop(inputs);
        Ok(Some(rows.into_pyarray(py).reshape([joints, 6])?))
    }

    #[setter]
    fn set_wrenches(&self, wrenches: Option<Vec<[f64; 6]>>) -> PyResult<()> {
        let mut bodies = self.evaluator.no_wrenches();
        let mut inputs = self.get()?;
        let Some(wrenches) = wrenches else {
            inputs.bodies = None;
            return Ok(());
        };
        count(bodies.values().count(), wrenches.len())?;
        for (to, [fx, fy, fz, mx, my, mz]) in bodies.values_mut().zip(wrenches) {
            *to = Wrench { force: Vector3::new(fx, fy, fz), moment: Vector3::new(mx, my, mz) };
        }
        inputs.bodies = Some(bodies);
        Ok(())
    }

    /// Modal forces of a structure, N/sqrt(kg).
    #[getter]
    fn modal<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let modal = self.get()?.modal.forces.clone();
        Ok(modal.into_pyarray(py))
    }

    #[setter]
    #[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
    fn set_modal(&self, modal: Vec<f64>) -> PyResult<()> {
        let mut inputs = self.get()?;
        count(inputs.modal.forces.len(), modal.len())?;
        inputs.modal.forces.copy_from_slice(&modal);
        Ok(())
    }
}

/// A mode by its name.
fn mode((name, acceleration): &(String, f64)) -> PyResult<Mode> {
    match name.as_str() {
        "driven" => Ok(Mode::Driven),
        "prescribed" => Ok(Mode::Prescribed(*acceleration)),
        "locked" => Ok(Mode::Locked),
        _ => Err(unknown("a joint's mode", name, "driven, prescribed or locked")),
    }
}

fn unknown(what: &str, name: &str, known: &str) -> PyErr {
    PyValueError::new_err(format!("{what} is `{name}`; it is {known}"))
}

fn count(expected: usize, found: usize) -> PyResult<()> {
    if expected == found {
        return Ok(());
    }
    Err(PyValueError::new_err(format!("{found} numbers where {expected} are wanted")))
}
