//! [`identify`]: the numbers of a spacecraft from telemetry in arrays or in a file.

use std::path::PathBuf;
use std::sync::Arc;

use numpy::PyReadonlyArray1;
use precess::file::{IdentificationFile, identification_from_toml};
use precess::fit::Estimate;
use precess::identify::device::device;
use precess::identify::{
    Design, Direction, Identified, IdentifyError, Manoeuvre, design, identify as found_in,
};
use precess::scenario::Scenario;
use precess::telemetry::Telemetry;
use pyo3::prelude::*;

use crate::errors;
use crate::scenario::NativeScenario;

/// Value, standard deviation, and the ends of the 95 % interval.
type EstimateFacts = (f64, f64, f64, f64);
/// Device; `U_s`, `U_d`, phase and angle; whether noise hides the first and the second; whether all are told.
type WheelFacts = (String, [EstimateFacts; 4], [bool; 2], bool);
/// Names, changes and units; standard deviation in steps of it; whether priors tell it.
type DirectionFacts = (Vec<(String, f64, &'static str)>, f64, bool);
/// Sensor; how many numbers; mean square; beyond three standard deviations; whether the model explains them.
type ResidualFacts = (&'static str, u64, f64, u64, bool);
/// Lengths, s; names, units, deviations alone and with each; directions with their deviations.
type DesignFacts =
    (Vec<f64>, Vec<(String, &'static str, f64, Vec<f64>)>, Vec<(DirectionFacts, Vec<f64>)>);

/// What was found in a record.
#[pyclass(frozen, module = "precess._native")]
pub(crate) struct NativeIdentified {
    found: Identified,
    scenario: Arc<Scenario>,
    file: IdentificationFile,
}

#[pymethods]
impl NativeIdentified {
    /// Name, unit, estimate and whether it is determined, of each number.
    #[getter]
    fn numbers(&self) -> Vec<(String, &'static str, EstimateFacts, bool)> {
        let numbers = self.found.numbers.iter();
        numbers.map(|of| (of.name.clone(), of.unit, estimate(&of.estimate), of.told)).collect()
    }

    /// Imbalances of wheels.
    #[getter]
    fn wheels(&self) -> Vec<WheelFacts> {
        let wheels = self.found.wheels.iter();
        wheels
            .map(|of| {
                let numbers = [&of.u_s, &of.u_d, &of.phase, &of.angle].map(estimate);
                (of.device.clone(), numbers, of.hidden, of.told)
            })
            .collect()
    }

    /// Rows of the covariance of all numbers.
    #[getter]
    fn covariance(&self) -> Vec<Vec<f64>> {
        self.found.covariance.row_iter().map(|row| row.iter().copied().collect()).collect()
    }

    /// Directions that the data do not tell.
    #[getter]
    fn untold(&self) -> Vec<DirectionFacts> {
        self.found.untold.iter().map(direction).collect()
    }

    /// What is left of each kind of sensor.
    #[getter]
    fn residuals(&self) -> Vec<ResidualFacts> {
        let residuals = self.found.residuals.iter();
        residuals.map(|of| (of.sensor, of.count, of.mean_square, of.outliers, of.holds)).collect()
    }

    /// What was left out, in sentences.
    #[getter]
    fn exclusions(&self) -> Vec<String> {
        let mut all: Vec<String> = self.found.exclusions.iter().map(ToString::to_string).collect();
        if self.found.outside > 0 {
            all.push(format!(
                "{} readings outside the time in which every motor's torque is known",
                self.found.outside
            ));
        }
        all
    }

    /// Whether the model explains the readings, and whether data or priors tell all that is unknown.
    #[getter]
    fn verdict(&self) -> (bool, bool) {
        (self.found.holds(), self.found.is_told())
    }

    /// From when to when, s, and steps over the whole record.
    #[getter]
    fn span(&self) -> (f64, f64, usize) {
        let [start, end] = self.found.span;
        (start, end, self.found.steps)
    }

    /// The parts of a scenario.
    fn parts(&self) -> String {
        device(&self.found, &self.scenario, &self.file.layouts)
    }

    /// What manoeuvres would add.
    fn design(
        &self,
        py: Python<'_>,
        manoeuvres: Vec<(String, PyRef<'_, NativeScenario>)>,
    ) -> PyResult<DesignFacts> {
        let flown: Vec<(String, Arc<Scenario>)> =
            manoeuvres.into_iter().map(|(name, of)| (name, Arc::clone(&of.scenario))).collect();
        let of = py.detach(|| {
            let manoeuvres: Vec<_> =
                flown.iter().map(|(name, scenario)| Manoeuvre { name, scenario }).collect();
            design(&self.scenario, &self.file.unknowns, &self.found, &manoeuvres)
        });
        let Design { durations, numbers, directions, .. } = of.map_err(|of| errors::signal(&of))?;
        let numbers = numbers.into_iter().map(|of| (of.name, of.unit, of.alone, of.with));
        let directions = directions.into_iter().map(|of| (direction(&of.direction), of.with));
        Ok((durations, numbers.collect(), directions.collect()))
    }
}

fn estimate(of: &Estimate) -> EstimateFacts {
    (of.value, of.deviation, of.interval[0], of.interval[1])
}

fn direction(of: &Direction) -> DirectionFacts {
    (of.changes.clone(), of.deviation, of.has_prior)
}

/// Finds what a file names in columns, or in a file where there are none. Ctrl-C raises `KeyboardInterrupt`.
#[pyfunction]
pub(crate) fn identify(
    py: Python<'_>,
    scenario: &NativeScenario,
    unknown: PathBuf,
    columns: Vec<(String, PyReadonlyArray1<'_, f64>)>,
    data: Option<PathBuf>,
    is_near: bool,
) -> PyResult<NativeIdentified> {
    let scenario = Arc::clone(&scenario.scenario);
    let columns: Vec<(String, Vec<f64>)> = columns
        .into_iter()
        .map(|(name, of)| (name, of.as_array().iter().copied().collect()))
        .collect();
    let mut raised = None;
    let found = py.detach(|| {
        let mut file =
            identification_from_toml(&unknown, &scenario).map_err(|of| errors::scenario(&of))?;
        file.unknowns.is_near = is_near;
        let telemetry = match &data {
            Some(path) => Telemetry::read(path, &file.layout),
            None => Telemetry::of_columns("data", columns, &file.layout),
        };
        let telemetry = telemetry.map_err(|error| errors::signal(&error))?;
        let mut hear = |_: &_| match Python::attach(|py| py.check_signals()) {
            Ok(()) => true,
            Err(error) => {
                raised = Some(error);
                false
            }
        };
        let found = found_in(&scenario, &telemetry, &file.unknowns, &mut hear);
        found.map(|found| (found, file)).map_err(|error: IdentifyError| errors::signal(&error))
    });
    if let Some(error) = raised {
        return Err(error);
    }
    let (found, file) = found?;
    Ok(NativeIdentified { found, scenario, file })
}
