//! Arrays of `NumPy` that a batch reads and writes, with their names in messages.

use numpy::{
    PyArray3, PyArrayMethods as _, PyReadonlyArray2, PyReadwriteArray3, PyUntypedArrayMethods as _,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// The numbers of a direction, zero without one.
pub(super) fn direction(
    name: &str,
    of: Option<&PyReadonlyArray2<'_, f64>>,
    [count, width]: [usize; 2],
) -> PyResult<Vec<f64>> {
    let Some(of) = of else { return Ok(vec![0.0; count * width]) };
    if of.shape() != [count, width] {
        let shape = of.shape();
        let message = format!("{name} has the shape {shape:?}; it needs [{count}, {width}]");
        return Err(PyValueError::new_err(message));
    }
    Ok(of.as_array().iter().copied().collect())
}

/// An array of this shape, to be written.
pub(super) fn writable<'py>(
    name: &str,
    array: &Bound<'py, PyArray3<f64>>,
    shape: [usize; 3],
) -> PyResult<PyReadwriteArray3<'py, f64>> {
    if array.shape() != shape {
        let found = array.shape();
        let message = format!("{name} has the shape {found:?}; it needs {shape:?}");
        return Err(PyValueError::new_err(message));
    }
    let borrowed = array.try_readwrite();
    borrowed.map_err(|error| PyValueError::new_err(format!("{name} cannot be written: {error}")))
}

/// Its numbers, rows first.
pub(super) fn contiguous<'a>(
    name: &str,
    array: &'a mut PyReadwriteArray3<'_, f64>,
) -> PyResult<&'a mut [f64]> {
    let wrong = || PyValueError::new_err(format!("{name} needs contiguous rows (C order)"));
    // A slice is also given of columns that are contiguous.
    if !array.is_c_contiguous() {
        return Err(wrong());
    }
    array.as_slice_mut().map_err(|_| wrong())
}
