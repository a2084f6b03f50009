//! [`NativeBatch`]: many states of a scenario's spacecraft, or of as many spacecraft whose parameters
//! differ; in lanes where all devices are of one kind on a rigid hub, one by one elsewhere.
//!
//! States are evaluated in parts of a fixed size, so no number depends on how many threads share them.

mod arrays;
mod derivatives;
mod engine;
#[cfg(feature = "cuda")]
mod gpu;
mod reduce;
mod results;
mod rows;
mod work;

use std::sync::{Arc, Mutex, OnceLock};

use numpy::{
    IntoPyArray as _, PyArray3, PyArrayMethods as _, PyReadonlyArray2, PyUntypedArrayMethods as _,
};
use precess::evaluation::{CraftInputs, Parameter};
use precess::scenario::Scenario;
use precess_lanes::{PART, Steps};
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;

use crate::errors;
use crate::evaluator::NativeEvaluator;
use crate::inputs::NativeInputs;
use crate::scenario::NativeScenario;

use arrays::{contiguous, direction, writable};
pub(crate) use derivatives::{Linearized, Sizes};
use engine::Engine;
use reduce::{BatchHistory, Reduction};
use results::{Failures, Rows, RunFacts, exceptions, run_facts};
use rows::failed_rows;
pub(crate) use rows::{BatchRows, InputRows};
use work::{Progress, share, watched};

/// Names of accelerations, states and inputs; derivatives by states and by inputs; failures.
type LinearizedFacts<'py> = (
    Vec<String>,
    Vec<String>,
    Vec<String>,
    Bound<'py, PyArray3<f64>>,
    Bound<'py, PyArray3<f64>>,
    Failures,
);

/// Many states, of one spacecraft or of one each.
#[pyclass(frozen, module = "precess._native")]
pub(crate) struct NativeBatch {
    pub(crate) rows: Arc<BatchRows>,
    /// On a GPU, where that is wanted.
    #[cfg(feature = "cuda")]
    gpu: Option<gpu::GpuRows>,
}

#[pymethods]
impl NativeBatch {
    /// `parameters`: names, and a row for each element. `scenarios`: one for each element.
    #[new]
    #[pyo3(signature = (evaluator, parameters=None, scenarios=None, lanes=true, cuda=false))]
    #[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
    fn new(
        py: Python<'_>,
        evaluator: &NativeEvaluator,
        parameters: Option<(Vec<String>, PyReadonlyArray2<'_, f64>)>,
        scenarios: Option<Vec<Py<NativeScenario>>>,
        lanes: bool,
        cuda: bool,
    ) -> PyResult<Self> {
        #[cfg(not(feature = "cuda"))]
        if cuda {
            return Err(errors::class::UnsupportedError::new_err(
                "backend \"cuda\" is not part of this build: it has not the feature `cuda`; build the wheel with `maturin \
                 build --release --features cuda`",
            ));
        }
        let evaluator = evaluator.evaluator.clone();
        let each = scenarios.is_some() || parameters.is_some();
        let mut elements: Vec<Arc<Scenario>> = match &scenarios {
            Some(scenarios) => scenarios.iter().map(|of| of.get().scenario.clone()).collect(),
            None => Vec::new(),
        };
        if let Some((names, values)) = &parameters {
            let of = Parameter::named(evaluator.scenario(), names);
            let of = of.map_err(|error| errors::evaluation(&error))?;
            if let Some(other) = of.iter().find(|parameter| !parameter.is_number()) {
                return Err(PyValueError::new_err(format!(
                    "`{}` is no number of the spacecraft but a derivative; set a key of the scenario \
                     instead, such as `device.NAME.imbalance`",
                    other.name
                )));
            }
            let values = values.as_array();
            if elements.is_empty() {
                let one = Arc::new(evaluator.scenario().clone());
                elements = vec![one; values.nrows()];
            }
            if elements.len() != values.nrows() {
                let message = format!("{} rows for {} elements", values.nrows(), elements.len());
                return Err(PyValueError::new_err(message));
            }
            for (element, row) in elements.iter_mut().zip(values.rows()) {
                let Scenario { hub, devices, .. } = Arc::make_mut(element);
                for (parameter, value) in of.iter().zip(row) {
                    parameter.set(hub, devices, *value);
                }
            }
        }
        let own = elements.iter().map(|of| &**of).chain([evaluator.scenario()]);
        if let Some(joint) = own.into_iter().find_map(Scenario::first_friction) {
            let message = format!(
                "batches have no friction that sticks and no quadratic drag, as {joint} has; run the scenarios one by \
                 one, or give it `coulomb` with `coulomb_rate` instead"
            );
            return Err(errors::class::UnsupportedError::new_err(message));
        }
        #[cfg(feature = "cuda")]
        let gpu = if cuda { Some(gpu::GpuRows::new(&evaluator, &elements)?) } else { None };
        let count = each.then_some(elements.len());
        let engine = py.detach(|| {
            if each { Engine::each(&elements, lanes) } else { Engine::same(&evaluator, lanes) }
        });
        let scenarios = if each { elements } else { Vec::new() };
        let (each, names) = (OnceLock::new(), Mutex::new(None));
        let rows = BatchRows { evaluator, engine, count, scenarios, each, names };
        Ok(Self {
            rows: Arc::new(rows),
            #[cfg(feature = "cuda")]
            gpu,
        })
    }

    /// Whether it is evaluated in lanes.
    #[getter]
    fn is_laned(&self) -> bool {
        self.rows.engine.is_laned()
    }

    /// Why the processor computes what a GPU was wanted for; none where no GPU was, or one computes.
    #[getter]
    #[cfg_attr(
        not(feature = "cuda"),
        expect(clippy::unused_self, reason = "a property of Python, with the feature `cuda`")
    )]
    fn fallback(&self) -> Option<String> {
        #[cfg(feature = "cuda")]
        return self.gpu.as_ref()?.fallback();
        #[cfg(not(feature = "cuda"))]
        None
    }

    /// Accelerations, one row each; failures.
    #[pyo3(signature = (y, inputs, u=None, threads=0, progress=None))]
    #[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
    fn accelerations<'py>(
        &self,
        py: Python<'py>,
        y: PyReadonlyArray2<'py, f64>,
        inputs: &NativeInputs,
        u: Option<PyReadonlyArray2<'py, f64>>,
        threads: usize,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<(Rows<'py>, Failures)> {
        let BatchArguments { y, count, acting, .. } = self.given(&y, inputs, u.as_ref())?;
        let width = self.rows.acceleration_size();
        let mut out = vec![f64::NAN; count * width];
        let given = (y.as_slice(), &acting);
        let failures = watched(py, Progress::new(progress), |look| {
            #[cfg(feature = "cuda")]
            if let Some(gpu) = self.gpu.as_ref().filter(|gpu| gpu.is_there()) {
                return gpu.accelerations(given, &mut out, look);
            }
            self.rows.accelerations(given, &mut out, threads, look)
        })?;
        let failures = exceptions(py, failures)?;
        Ok((out.into_pyarray(py).reshape([count, width])?, failures))
    }

    /// Steps of RK4, inputs held.
    #[pyo3(signature = (y, inputs, u, dt, steps, every, history, reductions, threads=0, progress=None))]
    #[expect(clippy::too_many_arguments, reason = "keywords of Python")]
    #[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
    fn run<'py>(
        &self,
        py: Python<'py>,
        y: PyReadonlyArray2<'py, f64>,
        inputs: &NativeInputs,
        u: Option<PyReadonlyArray2<'py, f64>>,
        dt: f64,
        steps: usize,
        every: usize,
        history: bool,
        reductions: Vec<String>,
        threads: usize,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<RunFacts<'py>> {
        let BatchArguments { mut y, count, size, acting } = self.given(&y, inputs, u.as_ref())?;
        let every = every.max(1);
        #[cfg(feature = "cuda")]
        if let Some(gpu) = self.gpu.as_ref().filter(|gpu| gpu.is_there()) {
            let settings = gpu::settings(every, history, &reductions)?;
            let (kept, reduced, failures) = watched(py, Progress::new(progress), |look| {
                gpu.run((&mut y, &acting), (dt, steps), &settings, look)
            })?;
            return run_facts(py, (y, kept, reduced), [count, steps / every + 1, size], failures);
        }
        let samples = if history { steps / every + 1 } else { 0 };
        let reductions: PyResult<Vec<Reduction>> =
            reductions.iter().map(|name| Reduction::of_name(name)).collect();
        let reductions = reductions?;
        let mut kept = BatchHistory::new(count, samples, size, reductions);
        let jobs = y.chunks_mut(PART * size).zip(kept.parts()).enumerate();
        let jobs = jobs.map(|(part, (y, kept))| (part, y, kept)).collect();
        let of = Steps { length: dt, count: steps, every };
        let work = |(part, y, mut kept): (usize, &mut [f64], reduce::PartHistory<'_>),
                    go: &(dyn Fn() -> bool + Sync)| {
            let inputs = acting.of_part(part, y.len() / size);
            kept.start(y);
            let ends = self.rows.engine.run(part, y, &inputs, of, &mut kept, go);
            kept.finish(&ends);
            failed_rows(part, &ends, y, size)
        };
        let failures =
            watched(py, Progress::new(progress), |look| share(threads, look, jobs, work))?;
        let (histories, reduced) = kept.into_parts();
        run_facts(py, (y, histories, reduced), [count, samples, size], failures)
    }

    /// Derivatives of the accelerations of each state by states and inputs, with the names of rows and columns; into the
    /// arrays of `out`, where they are given.
    #[pyo3(signature = (y, inputs, u=None, threads=0, out=None))]
    #[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
    fn linearize<'py>(
        &self,
        py: Python<'py>,
        y: PyReadonlyArray2<'py, f64>,
        inputs: &NativeInputs,
        u: Option<PyReadonlyArray2<'py, f64>>,
        threads: usize,
        out: Option<[Bound<'py, PyArray3<f64>>; 2]>,
    ) -> PyResult<LinearizedFacts<'py>> {
        let BatchArguments { y, count, acting, .. } = self.given(&y, inputs, u.as_ref())?;
        let shape = self.rows.linearized(&acting.base);
        let shape = shape.map_err(|error| errors::evaluation(&error))?;
        let Sizes { rows, states, inputs } = shape.sizes();
        let dims = [[count, rows, states], [count, rows, inputs]];
        let [c, d] = match out {
            Some(given) => given,
            None => dims.map(|of| PyArray3::zeros(py, of, false)),
        };
        let (mut of_c, mut of_d) =
            (writable("out[0]", &c, dims[0])?, writable("out[1]", &d, dims[1])?);
        let into = (contiguous("out[0]", &mut of_c)?, contiguous("out[1]", &mut of_d)?);
        let given = (y.as_slice(), &acting);
        let failures = watched(py, Progress::new(None), |look| {
            self.rows.linearize(given, shape.sizes(), into, threads, look)
        })?;
        let failures = exceptions(py, failures)?;
        drop((of_c, of_d));
        let Linearized { outputs, states, inputs } = &*shape;
        Ok((outputs.clone(), states.clone(), inputs.clone(), c, d, failures))
    }

    /// What the accelerations of each state change by along a direction of states and of inputs, in the order of the
    /// names that `linearize` returns; failures.
    #[pyo3(signature = (y, inputs, dx, du, u=None, threads=0))]
    #[expect(clippy::too_many_arguments, reason = "keywords of Python")]
    #[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
    fn jvp<'py>(
        &self,
        py: Python<'py>,
        y: PyReadonlyArray2<'py, f64>,
        inputs: &NativeInputs,
        dx: Option<PyReadonlyArray2<'py, f64>>,
        du: Option<PyReadonlyArray2<'py, f64>>,
        u: Option<PyReadonlyArray2<'py, f64>>,
        threads: usize,
    ) -> PyResult<(Rows<'py>, Failures)> {
        let BatchArguments { y, count, acting, .. } = self.given(&y, inputs, u.as_ref())?;
        let shape = self.rows.linearized(&acting.base);
        let sizes = shape.map_err(|error| errors::evaluation(&error))?.sizes();
        let dx = direction("dx", dx.as_ref(), [count, sizes.states])?;
        let du = direction("du", du.as_ref(), [count, sizes.inputs])?;
        let mut out = vec![f64::NAN; count * sizes.rows];
        let (given, along) = ((y.as_slice(), &acting), (dx.as_slice(), du.as_slice()));
        let failures = watched(py, Progress::new(None), |look| {
            self.rows.jvp(given, sizes, along, &mut out, threads, look)
        })?;
        let failures = exceptions(py, failures)?;
        Ok((out.into_pyarray(py).reshape([count, sizes.rows])?, failures))
    }

    /// The gradient of the sum of the accelerations of each state times weights, by states and by inputs, in the order of
    /// the names that `linearize` returns; failures.
    #[pyo3(signature = (y, inputs, weights, u=None, threads=0))]
    #[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
    fn vjp<'py>(
        &self,
        py: Python<'py>,
        y: PyReadonlyArray2<'py, f64>,
        inputs: &NativeInputs,
        weights: PyReadonlyArray2<'py, f64>,
        u: Option<PyReadonlyArray2<'py, f64>>,
        threads: usize,
    ) -> PyResult<(Rows<'py>, Rows<'py>, Failures)> {
        let BatchArguments { y, count, acting, .. } = self.given(&y, inputs, u.as_ref())?;
        let shape = self.rows.linearized(&acting.base);
        let sizes = shape.map_err(|error| errors::evaluation(&error))?.sizes();
        let weights = direction("weights", Some(&weights), [count, sizes.rows])?;
        let mut by_states = vec![f64::NAN; count * sizes.states];
        let mut by_inputs = vec![f64::NAN; count * sizes.inputs];
        let given = (y.as_slice(), &acting);
        let failures = watched(py, Progress::new(None), |look| {
            let into = (by_states.as_mut_slice(), by_inputs.as_mut_slice());
            self.rows.vjp(given, sizes, &weights, into, threads, look)
        })?;
        let failures = exceptions(py, failures)?;
        let by_states = by_states.into_pyarray(py).reshape([count, sizes.states])?;
        Ok((by_states, by_inputs.into_pyarray(py).reshape([count, sizes.inputs])?, failures))
    }
}

/// What a call of a batch was given.
struct BatchArguments {
    /// The states, one after the other.
    y: Vec<f64>,
    /// How many.
    count: usize,
    /// Numbers of each.
    size: usize,
    acting: InputRows,
}

impl NativeBatch {
    /// The rows of one spacecraft.
    pub(crate) fn of_one(&self) -> PyResult<&Arc<BatchRows>> {
        if self.rows.count.is_some() {
            let message = "a function of JAX is of one spacecraft; Batch.linearize, jvp and vjp have those \
                           that differ";
            return Err(errors::class::UnsupportedError::new_err(message));
        }
        Ok(&self.rows)
    }

    fn given(
        &self,
        y: &PyReadonlyArray2<'_, f64>,
        inputs: &NativeInputs,
        u: Option<&PyReadonlyArray2<'_, f64>>,
    ) -> PyResult<BatchArguments> {
        let (y, count) = self.states(y)?;
        let acting = self.acting(inputs.get()?.clone(), u, count)?;
        Ok(BatchArguments { y, count, size: self.rows.state_size(), acting })
    }

    /// The rows of states.
    fn states(&self, y: &PyReadonlyArray2<'_, f64>) -> PyResult<(Vec<f64>, usize)> {
        let [count, width] = [y.shape()[0], y.shape()[1]];
        let size = self.rows.state_size();
        if width != size {
            let message = format!("states have {width} numbers; they need {size}");
            return Err(PyValueError::new_err(message));
        }
        if let Some(expected) = self.rows.count.filter(|expected| *expected != count) {
            let message = format!("{count} states for {expected} spacecraft");
            return Err(PyIndexError::new_err(message));
        }
        Ok((y.as_array().iter().copied().collect(), count))
    }

    /// The rows of inputs: force and torque on the hub, then a number for each joint.
    fn acting(
        &self,
        base: CraftInputs,
        u: Option<&PyReadonlyArray2<'_, f64>>,
        count: usize,
    ) -> PyResult<InputRows> {
        let Some(u) = u else { return Ok(InputRows { base, rows: Vec::new(), width: 0 }) };
        let width = self.rows.input_size();
        if u.shape() != [count, width] {
            let message = format!(
                "inputs have the shape {:?}; they need ({count}, {width}): force, torque, motors",
                u.shape()
            );
            return Err(PyValueError::new_err(message));
        }
        Ok(InputRows { base, rows: u.as_array().iter().copied().collect(), width })
    }
}
