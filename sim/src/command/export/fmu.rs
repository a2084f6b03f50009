//! `export fmu`: a scenario's spacecraft as a functional mock-up unit. The solver is derived by `precess-bake`; with `--binary`
//! a C compiler makes the library of this platform.

use std::env;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use clap::Args;

use crate::command::error::CommandError;
use crate::command::exit::Exit;
use crate::command::generator::Generator;
use crate::command::options::{Set, as_toml};
use crate::command::outputs::{Outputs, name_of};
use crate::command::terminal::{note, print};
use crate::file::from_file;
use crate::fmu::{FmiVersion, Fmu, archive, compiler_arguments, headers, platform};

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
    /// Put the library of this platform beside the sources, compiled by `CC` of the environment, or `cc`.
    #[arg(long)]
    binary: bool,
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
        let other = |error: &dyn std::fmt::Display| CommandError::Other(error.to_string());
        let unit = Fmu::new(&scenario).map_err(|error| other(&error))?;
        let description = unit.spacecraft().write().map_err(|error| other(&error))?;
        let to = self
            .to
            .clone()
            .unwrap_or_else(|| self.file.with_file_name(format!("{}.fmu", scenario.name)));
        let mut outputs = Outputs::of_files(&[&to], self.force)?;
        let work = tempfile::tempdir().map_err(failure(&env::temp_dir()))?;
        let solver = work.path().join("solver");
        let general = ["--general".into(), "--out".into(), solver.clone().into_os_string()];
        if !Generator::new().arguments(general).silent().derive(&description)? {
            return Ok(Exit::Error);
        }
        let version = FmiVersion::of_number(self.fmi).unwrap_or_default();
        let files = unit.files(version, &texts(&solver)?);
        let mut bytes: Vec<(String, Vec<u8>)> =
            files.into_iter().map(|(path, text)| (path, text.into_bytes())).collect();
        if self.binary {
            let binary = compiled(&bytes, unit.name(), version, &work.path().join("unit"))?;
            bytes.insert(1, binary);
        }
        let count = bytes.len();
        let bytes = archive(&bytes).map_err(failure(&to))?;
        outputs.write(&[(name_of(&to), &bytes)])?;
        for text in unit.notes() {
            note(&format!("note: {text}"));
        }
        let (variables, size) = (unit.variable_count(), bytes.len());
        print(&format!("{}: {size} bytes, {count} files, {variables} variables\n", to.display()))?;
        Ok(Exit::Success)
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

/// The library of this platform: its path in the unit, and its bytes.
fn compiled(
    files: &[(String, Vec<u8>)],
    name: &str,
    version: FmiVersion,
    folder: &Path,
) -> Result<(String, Vec<u8>), CommandError> {
    let Some((platform, ending)) = platform(version) else {
        let message = format!(
            "{version} has no name of this platform; leave out `--binary`: the importer compiles the sources"
        );
        return Err(CommandError::Other(message));
    };
    fs::create_dir_all(folder).map_err(failure(folder))?;
    for (name, text) in headers(version) {
        let path = folder.join(name);
        fs::write(&path, text).map_err(failure(&path))?;
    }
    let mut sources = Vec::new();
    for (path, bytes) in files {
        let Some(name) = path.strip_prefix("sources/") else { continue };
        let path = folder.join(name);
        fs::write(&path, bytes).map_err(failure(&path))?;
        if path.extension().is_some_and(|ending| ending == "c") {
            sources.push(name.to_owned());
        }
    }
    let compiler = env::var_os("CC").filter(|text| !text.is_empty());
    let compiler = compiler.unwrap_or_else(|| OsString::from("cc"));
    let library = format!("{name}.{ending}");
    let done = Command::new(&compiler)
        .current_dir(folder)
        .args(compiler_arguments())
        .args(["-o", &library])
        .args(&sources)
        .output();
    let shown = compiler.to_string_lossy();
    let done = done.map_err(|error| {
        CommandError::Other(format!(
            "`{shown}` cannot be started: {error}; name a C compiler in `CC`, or leave out `--binary`: the importer \
             compiles the sources"
        ))
    })?;
    if !done.status.success() {
        let said = String::from_utf8_lossy(&done.stderr);
        let first = said.lines().next().unwrap_or("no message");
        return Err(CommandError::Other(format!(
            "`{shown}` does not compile the unit: {first}; name another C compiler in `CC`, or leave out `--binary`"
        )));
    }
    let path = folder.join(&library);
    let bytes = fs::read(&path).map_err(failure(&path))?;
    Ok((format!("binaries/{platform}/{library}"), bytes))
}

fn failure(path: &Path) -> impl FnOnce(std::io::Error) -> CommandError + use<> {
    let path = path.to_owned();
    |source| CommandError::Io { path, source }
}
