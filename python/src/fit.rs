//! Disturbance models of wheels from measurements, as [`precess::fit`] has them.

use std::path::PathBuf;

use numpy::{PyReadonlyArray2, PyUntypedArrayMethods as _};
use precess::file::measurement_from_toml;
use precess::fit::device::{Rotor, device, sources};
use precess::fit::{
    CHANNELS, Coefficient, Estimate, Fitted, FittedMode, Measurement, Options, Record, Sense, fit,
    fit_waterfall,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors;

/// Value, standard deviation, and the ends of the 95 % interval.
type EstimateFacts = (f64, f64, f64, f64);
/// Ends of a band, Hz, and the floor within it.
type Floor = (f64, f64, EstimateFacts);
/// Group, sense, coefficient, phase, whether it is above the noise.
type CoefficientFacts = (String, &'static str, EstimateFacts, Option<EstimateFacts>, bool);
/// Group; frequency, rad/s, damping ratio, ratio of inertias, share.
type ModeFacts = (String, EstimateFacts, EstimateFacts, EstimateFacts, EstimateFacts);
/// Name, rate, speed, drift, pulses; samples by channels.
type RecordFacts<'py> = (String, f64, f64, f64, Vec<f64>, PyReadonlyArray2<'py, f64>);

/// A fitted model.
#[pyclass(frozen, module = "precess._native")]
pub(crate) struct NativeFit {
    fitted: Fitted,
    /// What files call the wheel.
    #[pyo3(get)]
    name: String,
    rotor: Option<Rotor>,
}

#[pymethods]
impl NativeFit {
    /// `U_s`, `U_d`, phase and angle.
    #[getter]
    fn imbalance(
        &self,
    ) -> (EstimateFacts, EstimateFacts, Option<EstimateFacts>, Option<EstimateFacts>) {
        let of = &self.fitted.imbalance;
        let facts = |of: &Estimate| estimate(of);
        (
            estimate(&of.u_s),
            estimate(&of.u_d),
            of.phase.as_ref().map(facts),
            of.angle.as_ref().map(facts),
        )
    }

    /// The number of each harmonic, and its coefficients.
    #[getter]
    fn harmonics(&self) -> Vec<(EstimateFacts, Vec<CoefficientFacts>)> {
        let coefficient = |of: &Coefficient| {
            let sense = match of.sense {
                Sense::Forward => "forward",
                Sense::Backward => "backward",
            };
            let phase = of.phase.as_ref().map(estimate);
            (of.group.to_string(), sense, estimate(&of.c), phase, of.seen)
        };
        let harmonics = self.fitted.harmonics.iter();
        harmonics
            .map(|of| (estimate(&of.number), of.coefficients.iter().map(coefficient).collect()))
            .collect()
    }

    /// Internal modes.
    #[getter]
    fn modes(&self) -> Vec<ModeFacts> {
        let facts = |of: &FittedMode| {
            let [frequency, damping] = [estimate(&of.frequency), estimate(&of.damping)];
            let [ratio, share] = [estimate(&of.inertia_ratio), estimate(&of.share)];
            (of.group.to_string(), frequency, damping, ratio, share)
        };
        self.fitted.modes.iter().map(facts).collect()
    }

    /// Broadband noise of each group: bands, Hz, and densities.
    #[getter]
    fn floors(&self) -> Vec<(String, Vec<Floor>)> {
        let bands = |of: &Vec<precess::fit::Band>| {
            of.iter().map(|of| (of.range[0], of.range[1], estimate(&of.density))).collect()
        };
        let floors = self.fitted.floors.iter();
        floors.map(|(group, of)| (group.to_string(), bands(of))).collect()
    }

    /// Mean square of the residuals by their variance, and degrees of freedom, of each group.
    #[getter]
    fn residuals(&self) -> Vec<(String, f64, f64)> {
        let groups = self.fitted.groups.iter();
        groups.map(|of| (of.group.to_string(), of.squares / of.freedom, of.freedom)).collect()
    }

    /// What the model does not explain, and whether it does not hold because of it.
    #[getter]
    fn discrepancies(&self) -> Vec<(String, bool)> {
        self.fitted.discrepancies.iter().map(|of| (of.to_string(), of.fails())).collect()
    }

    /// The parts of a scenario: device and sources. `rotor`: mass, moments of inertia about and across its axis.
    #[pyo3(signature = (name, rotor=None))]
    fn parts(&self, name: &str, rotor: Option<(f64, f64, f64)>) -> (String, String) {
        let rotor = rotor.map(|(mass, axial, across)| Rotor { mass, inertia: [axial, across] });
        let rotor = rotor.or(self.rotor);
        let written = device(&self.fitted, name, rotor.as_ref());
        let soft = written.contains("kind = \"flexible_reaction_wheel\"");
        let sources = sources(&self.fitted, name, soft);
        (written, sources)
    }
}

fn estimate(of: &Estimate) -> EstimateFacts {
    (of.value, of.deviation, of.interval[0], of.interval[1])
}

/// Fits what a measurement file describes.
#[pyfunction]
#[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
pub(crate) fn fit_file(py: Python<'_>, path: PathBuf) -> PyResult<NativeFit> {
    py.detach(|| {
        let read = measurement_from_toml(&path, &mut |_| {});
        let file = read.map_err(|found| errors::scenario(&found))?;
        let fitted = if file.waterfall.is_empty() {
            fit(&file.measurement, &file.options)
        } else {
            fit_waterfall(&file.waterfall, &file.options)
        };
        let fitted = fitted.map_err(|error| errors::signal(&error))?;
        Ok(NativeFit { fitted, name: file.name, rotor: file.rotor })
    })
}

/// Fits records in the wheel's axes about its centre.
#[pyfunction]
#[pyo3(signature = (name, records, harmonics, interference, highest=None, speed_accuracy=None))]
#[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
pub(crate) fn fit_records(
    py: Python<'_>,
    name: String,
    records: Vec<RecordFacts<'_>>,
    harmonics: Vec<f64>,
    interference: Vec<f64>,
    highest: Option<f64>,
    speed_accuracy: Option<f64>,
) -> PyResult<NativeFit> {
    let records: PyResult<Vec<_>> = records.iter().map(record).collect();
    let measurement = Measurement { records: records? };
    let default = Options::default();
    let options = Options {
        harmonics,
        highest: highest.unwrap_or(default.highest),
        modes: None,
        interference,
        speed_accuracy: speed_accuracy.unwrap_or(default.speed_accuracy),
        compare_with_imbalance: default.compare_with_imbalance,
    };
    let fitted = py.detach(|| fit(&measurement, &options));
    Ok(NativeFit { fitted: fitted.map_err(|error| errors::signal(&error))?, name, rotor: None })
}

fn record((name, rate, speed, drift, pulses, samples): &RecordFacts<'_>) -> PyResult<Record> {
    let [length, channels] = [samples.shape()[0], samples.shape()[1]];
    if channels != CHANNELS {
        return Err(PyValueError::new_err(format!(
            "samples have the shape ({length}, {channels}); they need (samples, {CHANNELS}): force and moment"
        )));
    }
    let samples = samples.as_array();
    let channels = std::array::from_fn(|channel| samples.column(channel).iter().copied().collect());
    Ok(Record {
        name: name.clone(),
        rate: *rate,
        speed: *speed,
        drift: *drift,
        pulses: pulses.clone(),
        channels,
    })
}
