//! [`NativeEvaluator`]: a scenario's spacecraft at any state. States are flat arrays, of which Python has
//! the names; results are arrays in a stated order.

use std::sync::Arc;

use numpy::{IntoPyArray as _, PyArray1, PyArray2, PyArrayMethods as _, PyReadonlyArray1};
use precess::evaluation::{CraftAccelerations, CraftState, Evaluator, MassMatrix, Parameter};
use precess_dynamics::{About, Each as _, LoadAxes, Outputs, Power};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors;
use crate::inputs::NativeInputs;
use crate::scenario::{ColumnFacts, NativeScenario, facts};

type Vector<'py> = Bound<'py, PyArray1<f64>>;
type Matrix<'py> = Bound<'py, PyArray2<f64>>;

/// Units of coordinate, rate, acceleration and motor.
type Units = (&'static str, &'static str, &'static str, &'static str);
/// Body, coordinate, rate, acceleration, motor, units of the four, whether it slides, whether it has a motor.
type JointFacts = (String, String, String, String, String, Units, bool, bool);

/// The state after steps, names of states, inputs and parameters, then the matrices.
type StepFacts<'py> = (Vector<'py>, Vec<String>, Vec<String>, Vec<String>, [Matrix<'py>; 3]);
/// The names of the matrices' rows and columns, then the matrices.
type LinearizedFacts<'py> = (Vec<String>, Vec<String>, Vec<String>, Vec<String>, [Matrix<'py>; 6]);

/// A scenario's spacecraft, prepared for evaluation.
#[pyclass(frozen, module = "precess._native")]
pub(crate) struct NativeEvaluator {
    pub(crate) evaluator: Arc<Evaluator>,
}

#[pymethods]
impl NativeEvaluator {
    #[new]
    fn new(scenario: &NativeScenario) -> PyResult<Self> {
        let evaluator = Evaluator::new(&scenario.scenario).map_err(|error| errors::run(&error))?;
        Ok(Self { evaluator: Arc::new(evaluator) })
    }

    /// The columns that the numbers of a flat state are.
    #[getter]
    fn state_columns(&self) -> Vec<ColumnFacts> {
        self.evaluator.state_columns().iter().map(facts).collect()
    }

    /// The joints in the order of the set.
    #[getter]
    fn joints(&self) -> Vec<JointFacts> {
        let facts = |of: &precess::evaluation::JointNames| {
            (
                of.body.clone(),
                of.coordinate.clone(),
                of.rate.clone(),
                of.acceleration.clone(),
                of.motor.clone(),
                of.units.into(),
                of.slides,
                of.driven,
            )
        };
        self.evaluator.joints().iter().map(facts).collect()
    }

    /// The names of all accelerations.
    #[getter]
    fn acceleration_names(&self) -> Vec<String> {
        self.evaluator.acceleration_names()
    }

    /// The columns that loads are.
    #[getter]
    fn load_columns(&self) -> Vec<ColumnFacts> {
        self.evaluator.load_columns().iter().map(facts).collect()
    }

    /// Name, unit, meaning and value of each parameter.
    #[getter]
    fn parameters(&self) -> Vec<(String, &'static str, String, Option<f64>)> {
        let scenario = self.evaluator.scenario();
        let facts = |of: Parameter| {
            let value = of.value(&scenario.hub, &scenario.devices);
            (of.name, of.unit, of.meaning, value)
        };
        Parameter::all(scenario).into_iter().map(facts).collect()
    }

    /// Whether it is a flexible structure.
    #[getter]
    fn is_flexible(&self) -> bool {
        self.evaluator.is_flexible()
    }

    /// Mass of the whole spacecraft, kg.
    #[getter]
    fn mass(&self) -> f64 {
        self.evaluator.structure().mass()
    }

    /// The initial state of the scenario.
    fn initial<'py>(&self, py: Python<'py>) -> Vector<'py> {
        self.evaluator.pack(&self.evaluator.initial()).into_pyarray(py)
    }

    /// Everything at zero.
    fn at_rest<'py>(&self, py: Python<'py>) -> Vector<'py> {
        self.evaluator.pack(&self.evaluator.at_rest()).into_pyarray(py)
    }

    /// No force, torque or gravity, motors off.
    fn no_inputs(&self) -> NativeInputs {
        NativeInputs::new(self.evaluator.no_inputs(), self.evaluator.clone())
    }

    /// What acts by the scenario at a time, s, and state.
    fn inputs(&self, time: f64, y: PyReadonlyArray1<'_, f64>) -> PyResult<NativeInputs> {
        let state = self.state(&y)?;
        let inputs = self.evaluator.inputs(time, &state);
        let inputs = inputs.map_err(|error| errors::evaluation(&error))?;
        Ok(NativeInputs::new(inputs, self.evaluator.clone()))
    }

    /// All accelerations.
    fn accelerations<'py>(
        &self,
        py: Python<'py>,
        y: PyReadonlyArray1<'py, f64>,
        inputs: &NativeInputs,
    ) -> PyResult<Vector<'py>> {
        let found = self.found(&self.state(&y)?, inputs)?;
        Ok(flat(&found).into_pyarray(py))
    }

    /// Time derivative of a flat state; with what acts by the scenario where there are no inputs.
    #[pyo3(signature = (time, y, inputs=None))]
    fn derivative<'py>(
        &self,
        py: Python<'py>,
        time: f64,
        y: PyReadonlyArray1<'py, f64>,
        inputs: Option<&NativeInputs>,
    ) -> PyResult<Vector<'py>> {
        let flat = numbers(&y);
        let state = self.state(&y)?;
        let found = if let Some(inputs) = inputs {
            self.evaluator.accelerations(&state, &*inputs.get()?)
        } else {
            let inputs = self.evaluator.inputs(time, &state);
            let inputs = inputs.map_err(|error| errors::evaluation(&error))?;
            self.evaluator.accelerations(&state, &inputs)
        };
        let found = found.map_err(|error| errors::solve(&error))?;
        Ok(self.evaluator.derivative(&flat, &state, &found).into_pyarray(py))
    }

    /// Kinetic energy, J; linear and angular momentum, expressed in N.
    fn energy_and_momentum<'py>(
        &self,
        py: Python<'py>,
        y: PyReadonlyArray1<'py, f64>,
        about: &str,
    ) -> PyResult<(f64, Vector<'py>, Vector<'py>)> {
        let found = self.evaluator.energy_and_momentum(&self.state(&y)?, point(about)?);
        let found = found.map_err(|error| errors::solve(&error))?;
        let array = |of: &nalgebra::Vector3<f64>| of.as_slice().to_vec().into_pyarray(py);
        let momentum = found.momentum;
        Ok((found.energy, array(&momentum.linear), array(&momentum.angular)))
    }

    /// The energy ledger: names and numbers.
    fn ledger(
        &self,
        y: PyReadonlyArray1<'_, f64>,
        inputs: &NativeInputs,
    ) -> PyResult<Vec<(&'static str, f64)>> {
        let state = self.state(&y)?;
        let found = self.found(&state, inputs)?;
        let ledger = self.evaluator.ledger(&state, &*inputs.get()?, &found);
        let ledger = ledger.map_err(|error| errors::solve(&error))?;
        let mut all = vec![
            ("kinetic", ledger.kinetic),
            ("gravity", ledger.gravity),
            ("springs", ledger.springs),
            ("energy", ledger.energy()),
            ("kinetic_rate", ledger.kinetic_rate),
            ("residual", ledger.residual),
        ];
        all.extend(powers(&ledger.power));
        Ok(all)
    }

    /// Loads, and motor torques or forces.
    fn loads<'py>(
        &self,
        py: Python<'py>,
        y: PyReadonlyArray1<'py, f64>,
        inputs: &NativeInputs,
    ) -> PyResult<(Vector<'py>, Vector<'py>)> {
        let state = self.state(&y)?;
        let found = self.found(&state, inputs)?;
        let acting = inputs.get()?;
        let loads = self.evaluator.loads(&state, &acting, &found);
        let motors = self.evaluator.motors(&state, &acting, &found);
        let loads = loads.map_err(|error| errors::solve(&error))?;
        let motors = motors.map_err(|error| errors::solve(&error))?;
        Ok((loads.into_pyarray(py), motors.into_pyarray(py)))
    }

    /// Names of the coordinates, mass matrix, bias.
    fn mass_matrix<'py>(
        &self,
        py: Python<'py>,
        y: PyReadonlyArray1<'py, f64>,
        inputs: &NativeInputs,
    ) -> PyResult<(Vec<String>, Matrix<'py>, Vector<'py>)> {
        let found = self.evaluator.mass_matrix(&self.state(&y)?, &*inputs.get()?);
        let MassMatrix { coordinates, matrix, bias } =
            found.map_err(|error| errors::evaluation(&error))?;
        let bias = bias.as_slice().to_vec().into_pyarray(py);
        Ok((coordinates, array(py, &matrix)?, bias))
    }

    /// The linearised system: names of states, inputs, outputs, parameters; A, B, C, D, P, Q.
    fn linearize<'py>(
        &self,
        py: Python<'py>,
        y: PyReadonlyArray1<'py, f64>,
        inputs: &NativeInputs,
        momentum: Option<&str>,
        loads: bool,
        parameters: Vec<String>,
    ) -> PyResult<LinearizedFacts<'py>> {
        let outputs = Outputs {
            momentum: momentum.map(point).transpose()?,
            loads: loads.then_some(LoadAxes::Body),
        };
        let state = self.state(&y)?;
        let found = self.evaluator.linearize(&state, &*inputs.get()?, &outputs, &parameters);
        let of = found.map_err(|error| errors::evaluation(&error))?;
        let [a, b, c] = [array(py, &of.a)?, array(py, &of.b)?, array(py, &of.c)?];
        let [d, p, q] = [array(py, &of.d)?, array(py, &of.p)?, array(py, &of.q)?];
        Ok((of.states, of.inputs, of.outputs, of.parameters, [a, b, c, d, p, q]))
    }

    /// Steps of RK4 linearised, inputs held: A, B, P.
    fn linearize_steps<'py>(
        &self,
        py: Python<'py>,
        y: PyReadonlyArray1<'py, f64>,
        inputs: &NativeInputs,
        length: f64,
        steps: usize,
        parameters: Vec<String>,
    ) -> PyResult<StepFacts<'py>> {
        let state = self.state(&y)?;
        let acting = inputs.get()?.clone();
        let found = py.detach(|| {
            self.evaluator.linearize_steps(&state, &acting, (length, steps), &parameters)
        });
        let of = found.map_err(|error| errors::evaluation(&error))?;
        let state = self.evaluator.pack(&of.state).into_pyarray(py);
        let matrices = [array(py, &of.a)?, array(py, &of.b)?, array(py, &of.p)?];
        Ok((state, of.states, of.inputs, of.parameters, matrices))
    }

    /// The state after so many steps of RK4, inputs held.
    fn step<'py>(
        &self,
        py: Python<'py>,
        y: PyReadonlyArray1<'py, f64>,
        inputs: &NativeInputs,
        length: f64,
        steps: usize,
    ) -> PyResult<Vector<'py>> {
        let mut state = self.state(&y)?;
        let acting = inputs.get()?.clone();
        let stepped = py.detach(|| {
            for _ in 0..steps {
                state = self.evaluator.step(&state, &acting, length)?;
            }
            Ok(state)
        });
        let state = stepped.map_err(|error| errors::solve(&error))?;
        Ok(self.evaluator.pack(&state).into_pyarray(py))
    }
}

impl NativeEvaluator {
    pub(crate) fn state(&self, y: &PyReadonlyArray1<'_, f64>) -> PyResult<CraftState> {
        let state = self.evaluator.unpack(&numbers(y));
        state.map_err(|error| errors::solve(&error))
    }

    fn found(&self, state: &CraftState, inputs: &NativeInputs) -> PyResult<CraftAccelerations> {
        let found = self.evaluator.accelerations(state, &*inputs.get()?);
        found.map_err(|error| errors::solve(&error))
    }
}

/// The numbers of an array, contiguous or not.
pub(crate) fn numbers(y: &PyReadonlyArray1<'_, f64>) -> Vec<f64> {
    y.as_array().iter().copied().collect()
}

/// All accelerations in a row.
pub(crate) fn flat(found: &CraftAccelerations) -> Vec<f64> {
    let hub = found.r_b_n_ddot.iter().chain(found.omega_dot.iter()).copied();
    hub.chain(found.devices.values()).chain(found.modal.eta_ddot.iter().copied()).collect()
}

/// A matrix, rows first.
fn array<'py>(py: Python<'py>, of: &nalgebra::DMatrix<f64>) -> PyResult<Matrix<'py>> {
    let rows: Vec<f64> =
        of.row_iter().flat_map(|row| row.iter().copied().collect::<Vec<_>>()).collect();
    rows.into_pyarray(py).reshape([of.nrows(), of.ncols()])
}

/// The point that angular momentum is about.
fn point(about: &str) -> PyResult<About> {
    match about {
        "origin" => Ok(About::InertialOrigin),
        "centre_of_mass" => Ok(About::CentreOfMass),
        _ => Err(PyValueError::new_err(format!(
            "about `{about}` is not known; it is origin or centre_of_mass"
        ))),
    }
}

fn powers(power: &Power) -> [(&'static str, f64); 6] {
    [
        ("power_external", power.external),
        ("power_hub", power.hub),
        ("power_gravity", power.gravity),
        ("power_motors", power.motors),
        ("power_springs", power.springs),
        ("power_friction", power.friction),
    ]
}
