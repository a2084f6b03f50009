//! Spectra of evenly sampled signals, as [`precess::spectra`] has them.

use numpy::{
    Complex64, IntoPyArray as _, PyArray1, PyArray3, PyArrayMethods as _, PyReadonlyArray1,
    PyReadonlyArray2, PyUntypedArrayMethods as _,
};
use precess::spectra::{
    AmplitudeSpectrum, Detrend, Metadata, Psd, SpectrumError, WelchSettings, Window,
    amplitude_spectrum, cross_spectra, psd,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors;
use crate::evaluator::numbers;

type Vector<'py> = Bound<'py, PyArray1<f64>>;
/// Window, samples of a segment, those that two share, what is subtracted from each.
type Settings = (String, usize, usize, String);
/// Segments, samples that none of them has, resolution, noise bandwidth, Hz, and equivalent averages.
type SpectrumDetails = (usize, usize, f64, f64, f64);
/// How they were computed; densities and coherence, bin by bin.
type CrossFacts<'py> =
    (SpectrumDetails, Bound<'py, PyArray3<Complex64>>, Option<Bound<'py, PyArray3<f64>>>);

/// A power spectral density.
#[pyclass(frozen, module = "precess._native")]
pub(crate) struct NativePsd {
    pub(crate) psd: Psd,
}

#[pymethods]
impl NativePsd {
    #[getter]
    fn density<'py>(&self, py: Python<'py>) -> Vector<'py> {
        self.psd.density.clone().into_pyarray(py)
    }

    #[getter]
    fn about(&self) -> SpectrumDetails {
        about(&self.psd.metadata)
    }

    /// RMS of the bins in a band, Hz.
    fn band_rms(&self, start: f64, stop: f64) -> PyResult<f64> {
        self.psd.band_rms([start, stop]).map_err(|error| errors::signal(&error))
    }

    /// RMS of all bins from zero to each one, or from each one on.
    fn cumulative_rms<'py>(&self, py: Python<'py>, forward: bool) -> Vector<'py> {
        let found = if forward {
            self.psd.cumulative_rms_forward()
        } else {
            self.psd.cumulative_rms_backward()
        };
        found.into_pyarray(py)
    }

    /// Factors of a bin's density for the ends of its interval.
    fn interval(&self, bin: usize, level: f64) -> PyResult<(f64, f64)> {
        let found = self.psd.interval(bin, level).map_err(|error| errors::signal(&error))?;
        Ok(found.into())
    }
}

/// Amplitudes over frequency.
#[pyclass(frozen, module = "precess._native")]
pub(crate) struct NativeAmplitudes {
    spectrum: AmplitudeSpectrum,
}

#[pymethods]
impl NativeAmplitudes {
    #[getter]
    fn amplitude<'py>(&self, py: Python<'py>) -> Vector<'py> {
        self.spectrum.amplitude.clone().into_pyarray(py)
    }

    #[getter]
    fn about(&self) -> SpectrumDetails {
        about(&self.spectrum.metadata)
    }

    /// Frequency, amplitude, bin and height above the floor of the strongest lines.
    fn strongest(&self, count: usize) -> Vec<(f64, f64, usize, f64)> {
        let lines = self.spectrum.strongest(count).into_iter();
        lines.map(|line| (line.frequency, line.amplitude, line.bin, line.above_floor)).collect()
    }
}

/// A power spectral density by Welch's method.
#[pyfunction]
#[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
pub(crate) fn spectrum_welch(
    py: Python<'_>,
    x: PyReadonlyArray1<'_, f64>,
    rate: f64,
    settings: Settings,
) -> PyResult<NativePsd> {
    let (settings, x) = (welch(settings)?, numbers(&x));
    let psd = py.detach(|| psd(&x, rate, &settings)).map_err(|error| errors::signal(&error))?;
    Ok(NativePsd { psd })
}

/// Amplitudes of lines.
#[pyfunction]
#[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
pub(crate) fn spectrum_amplitudes(
    py: Python<'_>,
    x: PyReadonlyArray1<'_, f64>,
    rate: f64,
    settings: Settings,
) -> PyResult<NativeAmplitudes> {
    let (settings, x) = (welch(settings)?, numbers(&x));
    let found = py.detach(|| amplitude_spectrum(&x, rate, &settings));
    Ok(NativeAmplitudes { spectrum: found.map_err(|error| errors::signal(&error))? })
}

/// Cross-spectral densities of the rows of a matrix, and their coherence where there are averages enough.
#[pyfunction]
#[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
pub(crate) fn spectrum_cross<'py>(
    py: Python<'py>,
    signals: PyReadonlyArray2<'py, f64>,
    rate: f64,
    settings: Settings,
) -> PyResult<CrossFacts<'py>> {
    let settings = welch(settings)?;
    let rows: Vec<Vec<f64>> = rows(&signals);
    let signals = signals.shape()[0];
    let slices: Vec<&[f64]> = rows.iter().map(Vec::as_slice).collect();
    let found = py.detach(|| cross_spectra(&slices, rate, &settings));
    let found = found.map_err(|error| errors::signal(&error))?;
    let bins = found.metadata.bins();
    let pairs = move || (0..signals).flat_map(move |i| (0..signals).map(move |j| (i, j)));
    let densities: Result<Vec<_>, _> = pairs().map(|(i, j)| found.between(i, j)).collect();
    let densities = densities.map_err(|error| errors::signal(&error))?;
    let coherences: Result<Vec<_>, _> = pairs().map(|(i, j)| found.coherence(i, j)).collect();
    let shape = [bins, signals, signals];
    let density = by_bin(&densities, bins).into_pyarray(py).reshape(shape)?;
    let coherence = match coherences {
        Ok(of) => Some(by_bin(&of, bins).into_pyarray(py).reshape(shape)?),
        Err(SpectrumError::Averages(_)) => None,
        Err(error) => return Err(errors::signal(&error)),
    };
    Ok((about(&found.metadata), density, coherence))
}

/// Spectra of pairs, one after the other, as one matrix of pairs after the other.
fn by_bin<T: Copy>(of_pairs: &[Vec<T>], bins: usize) -> Vec<T> {
    let bin = |bin: usize| of_pairs.iter().filter_map(move |of| of.get(bin).copied());
    (0..bins).flat_map(bin).collect()
}

/// The rows of a matrix.
pub(crate) fn rows(of: &PyReadonlyArray2<'_, f64>) -> Vec<Vec<f64>> {
    of.as_array().rows().into_iter().map(|row| row.iter().copied().collect()).collect()
}

fn about(of: &Metadata) -> SpectrumDetails {
    (of.segments, of.unused, of.resolution, of.noise_bandwidth, of.averages)
}

/// Settings by the names of window and trend.
fn welch((window, length, overlap, detrend): Settings) -> PyResult<WelchSettings> {
    let window = [Window::Rectangular, Window::Hann, Window::FlatTop]
        .into_iter()
        .find(|of| of.name() == window)
        .ok_or_else(|| unknown("window", &window, "rectangular, hann or flat-top"))?;
    let detrend = [Detrend::None, Detrend::Mean, Detrend::Linear]
        .into_iter()
        .find(|of| of.name() == detrend)
        .ok_or_else(|| unknown("detrend", &detrend, "none, mean or linear"))?;
    Ok(WelchSettings { window, length, overlap, detrend })
}

/// A name that is none of those that are known.
pub(crate) fn unknown(what: &str, name: &str, known: &str) -> PyErr {
    PyValueError::new_err(format!("{what} `{name}` is not known; it is {known}"))
}
