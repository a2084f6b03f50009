//! `export fmu`: a scenario's spacecraft as a functional mock-up unit. The solver is derived by `precess-bake`; with `--binary`
//! a C compiler makes the library of this platform, of the simulator's engine where the solver in C is not enough.

mod library;

use std::env;
use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;

use crate::command::error::CommandError;
use crate::command::exit::Exit;
use crate::command::generator::Generator;
use crate::command::options::{Set, as_toml};
use crate::command::outputs::{Outputs, name_of};
use crate::command::terminal::{note, print};
use crate::file::from_file;
use crate::fmu::{EngineFmu, FmiVersion, Fmu, FmuError, archive, headers};
use crate::scenario::Scenario;
use library::{linked, of_engine};

pub(super) const HELP: &str = "Examples:\n  precess export fmu bus.toml --step '1 ms'\n  \
    precess export fmu bus.toml --step '1 ms' --fmi 3 --binary --to bus.fmu";

/// The options of `export fmu`.
#[derive(Debug, Args)]
pub(in crate::command) struct Unit {
    /// The scenario file.
    file: PathBuf,
    #[command(flatten)]
    overrides: Set,
    /// Length of the steps of Co-Simulation: that of `run.step` without this option.
    #[arg(long, value_name = "TIME")]
    step: Option<String>,
    /// Version of FMI, 2 or 3.
    #[arg(long, value_name = "VERSION", default_value_t = 2, value_parser = clap::value_parser!(u8).range(2..=3))]
    fmi: u8,
    /// Put the library of this platform beside the sources, compiled by `CC` of the environment, or `cc`. Of a scenario that
    /// cannot be sources it runs the simulator's engine, for Co-Simulation.
    #[arg(long)]
    binary: bool,
    /// The engine for such a library; `libprecess_fmu.a` beside this program without this option.
    #[arg(long, value_name = "FILE", requires = "binary")]
    engine: Option<PathBuf>,
    /// The file to write; the scenario's name and `.fmu` beside it without this option.
    #[arg(long, value_name = "FILE")]
    to: Option<PathBuf>,
    /// Replace a file that is there.
    #[arg(long)]
    force: bool,
}

impl Unit {
    pub(super) fn execute(&self) -> Result<Exit, CommandError> {
        let mut overrides = self.overrides.overrides();
        if let Some(step) = &self.step {
            overrides.extend(
                ["run.integrator=rk4".to_owned(), format!("run.step={step}")]
                    .iter()
                    .map(|text| as_toml(text)),
            );
        }
        let (scenario, _) = from_file(&self.file, &overrides).map_err(CommandError::Scenario)?;
        let to = self
            .to
            .clone()
            .unwrap_or_else(|| self.file.with_file_name(format!("{}.fmu", scenario.name)));
        let mut outputs = Outputs::of_files(&[&to], self.force)?;
        let work = tempfile::tempdir().map_err(failure(&env::temp_dir()))?;
        let unit = match Fmu::new(&scenario) {
            Ok(unit) => self.of_sources(&unit, work.path())?,
            Err(error) if self.binary && error != FmuError::Tolerance => {
                Some(self.of_engine(&scenario, &error, work.path())?)
            }
            Err(error) => return Err(CommandError::Other(refused(&error))),
        };
        let Some(unit) = unit else { return Ok(Exit::Error) };
        let bytes = archive(&unit.files).map_err(failure(&to))?;
        outputs.write(&[(name_of(&to), &bytes)])?;
        for text in &unit.notes {
            note(&format!("note: {text}"));
        }
        let (count, size) = (unit.files.len(), bytes.len());
        let variables = unit.variables;
        print(&format!("{}: {size} bytes, {count} files, {variables} variables\n", to.display()))?;
        Ok(Exit::Success)
    }

    fn version(&self) -> FmiVersion {
        FmiVersion::of_number(self.fmi).unwrap_or_default()
    }

    /// The unit of sources; none where its solver is not derived, and the generator has said why.
    fn of_sources(&self, unit: &Fmu, work: &Path) -> Result<Option<Contents>, CommandError> {
        let described = unit.spacecraft().write();
        let description = described.map_err(|error| CommandError::Other(error.to_string()))?;
        let solver = work.join("solver");
        let general = ["--general".into(), "--out".into(), solver.clone().into_os_string()];
        if !Generator::new().arguments(general).silent().derive(&description)? {
            return Ok(None);
        }
        let version = self.version();
        let files = unit.files(version, &texts(&solver)?);
        let mut files: Vec<(String, Vec<u8>)> =
            files.into_iter().map(|(path, text)| (path, text.into_bytes())).collect();
        if self.binary {
            let sources = files.iter().filter_map(|(path, bytes)| {
                Some((path.strip_prefix("sources/")?.to_owned(), bytes.clone()))
            });
            let headers =
                headers(version).into_iter().map(|(name, text)| (name, text.into_bytes()));
            let sources: Vec<_> = sources.chain(headers).collect();
            let binary = linked(&sources, unit.name(), version, &work.join("unit"), None)?;
            files.insert(1, binary);
        }
        let notes = unit.notes().to_vec();
        Ok(Some(Contents { files, notes, variables: unit.variable_count() }))
    }

    /// The unit that runs the engine, of what is refused as sources.
    fn of_engine(
        &self,
        scenario: &Scenario,
        why: &FmuError,
        work: &Path,
    ) -> Result<Contents, CommandError> {
        let other = |error: FmuError| CommandError::Other(error.to_string());
        let unit = EngineFmu::new(scenario).map_err(other)?;
        let engine = of_engine(self.engine.as_deref())?;
        let version = self.version();
        let sources = unit.sources(version).into_iter();
        let sources: Vec<_> = sources.map(|(name, text)| (name, text.into_bytes())).collect();
        let binary = linked(&sources, unit.name(), version, &work.join("unit"), Some(&engine))?;
        let description = unit.description(version).into_bytes();
        let files = vec![("modelDescription.xml".to_owned(), description), binary];
        let mut notes = vec![format!(
            "{why}; this unit runs the simulator's engine instead, for Co-Simulation alone"
        )];
        notes.extend_from_slice(unit.notes());
        Ok(Contents { files, notes, variables: unit.variable_count() })
    }
}

/// What is written.
struct Contents {
    files: Vec<(String, Vec<u8>)>,
    notes: Vec<String>,
    variables: usize,
}

/// Why there is no unit of sources, and what else there may be.
fn refused(error: &FmuError) -> String {
    match error {
        FmuError::Tolerance => error.to_string(),
        _ => format!("{error}; or add `--binary`: such a unit runs the simulator's engine"),
    }
}

/// The files of a folder with their names, in the order of these.
fn texts(folder: &Path) -> Result<Vec<(String, String)>, CommandError> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).map_err(failure(folder))? {
        let path = entry.map_err(failure(folder))?.path();
        let text = fs::read_to_string(&path).map_err(failure(&path))?;
        files.push((name_of(&path), text));
    }
    files.sort();
    Ok(files)
}

fn failure(path: &Path) -> impl FnOnce(std::io::Error) -> CommandError + use<> {
    let path = path.to_owned();
    |source| CommandError::Io { path, source }
}
