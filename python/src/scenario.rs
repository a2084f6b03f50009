//! [`NativeScenario`]: a scenario, read from tables.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use precess::file::{Diagnostics, Numbers, Tables, from_program};
use precess::record::{Column, Columns};
use precess::scenario::Scenario;
use pyo3::prelude::*;

use crate::errors;

/// Name, unit, frame, meaning, group and vector of a column.
pub(crate) type ColumnFacts =
    (String, &'static str, Option<String>, String, String, Option<String>);

/// A scenario that was read. It never changes.
#[pyclass(frozen, module = "precess._native")]
pub(crate) struct NativeScenario {
    pub(crate) scenario: Arc<Scenario>,
    warnings: Diagnostics,
}

#[pymethods]
impl NativeScenario {
    /// Reads a file and those it is based on; numbers of overrides without a unit are in SI units.
    #[staticmethod]
    #[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
    fn from_file(py: Python<'_>, path: PathBuf, overrides: Vec<String>) -> PyResult<Self> {
        read(py, Tables::File(&path), &overrides)
    }

    /// Reads a text, in which numbers without a unit are in SI units if `si` says so.
    #[staticmethod]
    #[expect(clippy::needless_pass_by_value, reason = "as Python passes them")]
    fn from_text(
        py: Python<'_>,
        name: &str,
        text: &str,
        folder: PathBuf,
        overrides: Vec<String>,
        si: bool,
    ) -> PyResult<Self> {
        let numbers = if si { Numbers::Si } else { Numbers::WithUnits };
        read(py, Tables::Text { name, text, numbers, folder: &folder }, &overrides)
    }

    /// Reads the text of [`Self::filled`] again; results name the texts of the first reading.
    #[staticmethod]
    fn from_filled(py: Python<'_>, filled: &str, path: String, text: String) -> PyResult<Self> {
        let numbers = Numbers::WithUnits;
        let tables = Tables::Text { name: &path, text: filled, numbers, folder: Path::new("") };
        let mut read = read(py, tables, &[])?;
        let mut scenario = (*read.scenario).clone();
        (scenario.source.path, scenario.source.text) = (path, text);
        read.scenario = Arc::new(scenario);
        Ok(read)
    }

    #[getter]
    fn name(&self) -> &str {
        &self.scenario.name
    }

    #[getter]
    fn title(&self) -> &str {
        &self.scenario.title
    }

    #[getter]
    fn description(&self) -> &str {
        &self.scenario.description
    }

    /// Length of the run, s.
    #[getter]
    fn duration(&self) -> f64 {
        self.scenario.settings.duration
    }

    /// The scenario in SI units, every default written out.
    #[getter]
    fn filled(&self) -> &str {
        &self.scenario.source.filled
    }

    /// Path and text that it was read from.
    #[getter]
    fn source(&self) -> (&str, &str) {
        (&self.scenario.source.path, &self.scenario.source.text)
    }

    /// Name and kind of each device and platform, in the order of the set.
    #[getter]
    fn members(&self) -> Vec<(String, String)> {
        let kind = |member: precess::scenario::Member<'_>| {
            member.device().map_or("platform", |device| device.kind().name()).to_owned()
        };
        self.scenario.members().map(|(name, member)| (name.to_owned(), kind(member))).collect()
    }

    /// Names of the controllers.
    #[getter]
    fn controllers(&self) -> Vec<&str> {
        self.scenario.controllers.iter().map(|of| of.name.as_str()).collect()
    }

    /// Every column that the scenario has, recorded or not.
    #[getter]
    fn all_columns(&self) -> Vec<ColumnFacts> {
        Columns::all(&self.scenario).into_iter().map(|column| facts(&column)).collect()
    }

    /// The columns that a run records.
    #[getter]
    fn columns(&self) -> PyResult<Vec<ColumnFacts>> {
        let columns =
            Columns::from_scenario(&self.scenario).map_err(|error| errors::record(&error))?;
        Ok(columns.as_slice().iter().map(facts).collect())
    }

    /// Each warning, as the command line shows it.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        let one =
            |warning| Diagnostics { sources: self.warnings.sources.clone(), all: vec![warning] };
        let all = self.warnings.all.iter().cloned();
        all.map(|warning| one(warning).to_string().trim_end().to_owned()).collect()
    }
}

fn read(py: Python<'_>, tables: Tables<'_>, overrides: &[String]) -> PyResult<NativeScenario> {
    let read = py.detach(|| from_program(tables, overrides));
    let (scenario, warnings) = read.map_err(|errors| errors::scenario(&errors))?;
    Ok(NativeScenario { scenario: Arc::new(scenario), warnings })
}

/// What Python shows of a column.
pub(crate) fn facts(column: &Column) -> ColumnFacts {
    let Column { name, unit, frame, meaning, group, vector, .. } = column.clone();
    (name, unit, frame, meaning, group, vector)
}
