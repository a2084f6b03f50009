//! Pointing metrics of signals, as [`precess::pointing`] has them.

use numpy::PyReadonlyArray2;
use precess::pointing::{
    Exposure, ExposureWeights, Index, IndexValue, Interpretation, exposure_of_history,
    exposure_of_lines, exposure_of_psd, exposure_of_table, index_of_psd, index_of_runs,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors;
use crate::spectra::{NativePsd, rows, unknown};

/// Displacement, smear and jitter.
type PointingParts = (f64, f64, f64);
/// Value, confidence, runs, values of all runs.
type IndexFacts = (f64, Option<f64>, usize, usize);

fn parts(of: Exposure) -> PointingParts {
    (of.displacement, of.smear, of.jitter)
}

/// Over all exposures of a history, largest in a single one, how many, and samples of each.
#[pyfunction]
#[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
pub(crate) fn pointing_of_history(
    components: PyReadonlyArray2<'_, f64>,
    rate: f64,
    exposure: f64,
) -> PyResult<(PointingParts, PointingParts, usize, usize)> {
    let rows = rows(&components);
    let slices: Vec<&[f64]> = rows.iter().map(Vec::as_slice).collect();
    let found = exposure_of_history(&slices, rate, exposure);
    let found = found.map_err(|error| errors::signal(&error))?;
    Ok((parts(found.rms), parts(found.worst), found.count, found.samples))
}

/// Of a density by Welch's method.
#[pyfunction]
pub(crate) fn pointing_of_psd(psd: &NativePsd, exposure: f64) -> PyResult<PointingParts> {
    exposure_of_psd(&psd.psd, exposure).map(parts).map_err(|error| errors::signal(&error))
}

/// Of frequencies and densities that are linear between them.
#[pyfunction]
#[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
pub(crate) fn pointing_of_table(points: Vec<[f64; 2]>, exposure: f64) -> PyResult<PointingParts> {
    exposure_of_table(&points, exposure).map(parts).map_err(|error| errors::signal(&error))
}

/// Of frequencies and amplitudes.
#[pyfunction]
#[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
pub(crate) fn pointing_of_lines(lines: Vec<[f64; 2]>, exposure: f64) -> PyResult<PointingParts> {
    exposure_of_lines(&lines, exposure).map(parts).map_err(|error| errors::signal(&error))
}

/// Shares of the variance of a line.
#[pyfunction]
pub(crate) fn pointing_weights(frequency: f64, exposure: f64) -> PointingParts {
    let of = ExposureWeights::new(frequency, exposure);
    (of.displacement, of.smear, of.jitter)
}

/// An index of runs.
#[pyfunction]
#[pyo3(signature = (index, runs, rate, interpretation, level, confidence=None))]
#[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
pub(crate) fn pointing_index(
    index: (String, Option<f64>, Option<f64>),
    runs: Vec<PyReadonlyArray2<'_, f64>>,
    rate: f64,
    interpretation: &str,
    level: f64,
    confidence: Option<f64>,
) -> PyResult<IndexFacts> {
    let interpretation =
        [Interpretation::Temporal, Interpretation::Ensemble, Interpretation::Mixed]
            .into_iter()
            .find(|of| of.name() == interpretation)
            .ok_or_else(|| {
                unknown("interpretation", interpretation, "temporal, ensemble or mixed")
            })?;
    let index = index_of(&index)?;
    let runs: Vec<Vec<Vec<f64>>> = runs.iter().map(rows).collect();
    let runs: Vec<Vec<&[f64]>> =
        runs.iter().map(|run| run.iter().map(Vec::as_slice).collect()).collect();
    let runs: Vec<&[&[f64]]> = runs.iter().map(Vec::as_slice).collect();
    let found = index_of_runs(index, &runs, rate, interpretation, level, confidence);
    found.map(facts).map_err(|error| errors::signal(&error))
}

/// An index of a density.
#[pyfunction]
#[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
pub(crate) fn pointing_index_of_psd(
    index: (String, Option<f64>, Option<f64>),
    psd: &NativePsd,
    level: f64,
) -> PyResult<IndexFacts> {
    let found = index_of_psd(index_of(&index)?, &psd.psd, level);
    found.map(facts).map_err(|error| errors::signal(&error))
}

fn facts(of: IndexValue) -> IndexFacts {
    (of.value, of.confidence, of.runs, of.values)
}

/// An index by name, window, s, and stability time, s.
fn index_of((name, window, stability): &(String, Option<f64>, Option<f64>)) -> PyResult<Index> {
    match (name.as_str(), *window, *stability) {
        ("APE", None, None) => Ok(Index::Ape),
        ("MPE", Some(window), None) => Ok(Index::Mpe { window }),
        ("RPE", Some(window), None) => Ok(Index::Rpe { window }),
        ("PDE", Some(window), Some(stability)) => Ok(Index::Pde { window, stability }),
        ("PRE", Some(window), None) => Ok(Index::Pre { window }),
        ("APE" | "MPE" | "RPE" | "PDE" | "PRE", ..) => Err(PyValueError::new_err(
            "APE has no window, MPE, RPE and PRE have one, PDE has one and a stability time",
        )),
        _ => Err(unknown("index", name, "APE, MPE, RPE, PDE or PRE")),
    }
}
