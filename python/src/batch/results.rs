//! What calls of a batch return: arrays of `NumPy`, and failures as exceptions.

use numpy::{IntoPyArray as _, PyArray2, PyArray3, PyArrayMethods as _};
use pyo3::prelude::*;

use super::engine::Failure;
use super::rows::Failed;

pub(super) type Rows<'py> = Bound<'py, PyArray2<f64>>;
/// Index and exception of each element that failed.
pub(super) type Failures = Vec<(usize, Py<PyAny>)>;
/// Final states, samples, reductions in the order of the request, failures.
pub(super) type RunFacts<'py> =
    (Rows<'py>, Option<Bound<'py, PyArray3<f64>>>, Vec<Rows<'py>>, Failures);

/// Final states, samples and reductions as arrays; failures as exceptions.
pub(super) fn run_facts(
    py: Python<'_>,
    (y, histories, reduced): (Vec<f64>, Option<Vec<f64>>, Vec<Vec<f64>>),
    [count, samples, size]: [usize; 3],
    failures: Failed,
) -> PyResult<RunFacts<'_>> {
    let failures = exceptions(py, failures)?;
    let histories = match histories {
        Some(of) => Some(of.into_pyarray(py).reshape([count, samples, size])?),
        None => None,
    };
    let reduced: PyResult<Vec<_>> =
        reduced.into_iter().map(|of| of.into_pyarray(py).reshape([count, size])).collect();
    Ok((y.into_pyarray(py).reshape([count, size])?, histories, reduced?, failures))
}

/// Failures in the order of the elements, as exceptions.
pub(super) fn exceptions(py: Python<'_>, mut of: Vec<(usize, Failure)>) -> PyResult<Failures> {
    of.sort_by_key(|(index, _)| *index);
    let one = |(index, failure): (usize, Failure)| {
        let exception = failure.exception().into_value(py);
        Ok((index, exception.into_any()))
    };
    of.into_iter().map(one).collect()
}
