//! `structure`: what the file of a structure has, and the same as NPZ or op4.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};

use super::error::CommandError;
use super::exit::Exit;
use super::outputs::{Outputs, name_of};
use super::table::{aligned, six};
use super::terminal::print;
use crate::file::{StructureReadError, structure_from_file};
use crate::report::mode_shapes::mode_shapes;
use crate::structure::{Structure, bytes_of, npz, op4};

/// What is done with a structure.
#[derive(Debug, Subcommand)]
pub(super) enum StructureCommand {
    /// Print nodes, frequencies, damping ratios, effective masses and checks; of an op4 file its matrices
    #[command(after_help = "Examples:\n  precess structure show bus.npz\n  \
        precess structure show bus.npz --shapes bus-modes.svg")]
    Show(Show),
    /// Write a structure as NPZ, or as Nastran's op4 with the table that maps its rows to nodes
    #[command(after_help = "Examples:\n  precess structure convert Flex_Bus.txt --to bus.npz\n  \
        precess structure convert bus.npz --to bus.op4      bus.op4 and bus.toml")]
    Convert(Convert),
}

/// The options of `structure show`.
#[derive(Debug, Args)]
pub(super) struct Show {
    /// NPZ, Flex text of 42, or a table in TOML (docs/structure.md).
    file: PathBuf,
    /// Write a picture of the mode shapes (SVG): the nodes at rest and displaced, up to 24 modes.
    #[arg(long, value_name = "FILE")]
    shapes: Option<PathBuf>,
    /// Replace a picture that is there.
    #[arg(long, requires = "shapes")]
    force: bool,
}

/// The options of `structure convert`.
#[derive(Debug, Args)]
pub(super) struct Convert {
    /// NPZ, Flex text of 42, or a table in TOML (docs/structure.md).
    file: PathBuf,
    /// The file to write, NPZ or `.op4` (binary; a table `.toml` beside it); `.npz` in place of the
    /// file's ending without this option.
    #[arg(long, value_name = "FILE")]
    to: Option<PathBuf>,
    /// Replace a file that is there.
    #[arg(long)]
    force: bool,
}

/// The structure of a file.
pub(super) fn read(path: &Path) -> Result<Structure, CommandError> {
    structure_from_file(path).map_err(|error| match error {
        StructureReadError::Table(errors) => CommandError::Scenario(errors),
        StructureReadError::File(error) => CommandError::Other(error.to_string()),
    })
}

impl StructureCommand {
    pub(super) fn execute(&self) -> Result<Exit, CommandError> {
        match self {
            Self::Show(show) => show.execute(),
            Self::Convert(convert) => convert.execute(),
        }
    }
}

impl Show {
    fn execute(&self) -> Result<Exit, CommandError> {
        if self.shapes.is_none()
            && let Some(text) = self.matrices()?
        {
            print(&text)?;
            return Ok(Exit::Success);
        }
        if let Some(path) = self.shapes.as_ref().filter(|path| ending_of(path) != "svg") {
            return Err(unknown_ending(path, "a picture (.svg)"));
        }
        let structure = read(&self.file)?;
        print(&shown(&structure))?;
        if let Some(path) = &self.shapes {
            let file = (name_of(path), mode_shapes(&structure));
            Outputs::of_files(&[path], self.force)?.write(&[file])?;
            print(&format!("\n{}\n", path.display()))?;
        }
        Ok(Exit::Success)
    }

    /// The matrices of an op4 file; none of another one.
    fn matrices(&self) -> Result<Option<String>, CommandError> {
        if self.file.extension().is_some_and(|extension| extension == "toml") {
            return Ok(None);
        }
        let failure = |error: crate::structure::StructureError| {
            CommandError::Other(error.in_file(&self.file).to_string())
        };
        let bytes = bytes_of(&self.file).map_err(failure)?;
        if !op4::is_op4(&bytes) {
            return Ok(None);
        }
        let matrices = op4::read(&bytes).map_err(failure)?;
        let lines: String = matrices.iter().map(|matrix| matrix.summary() + "\n").collect();
        Ok(Some(lines))
    }
}

/// The ending of a file's name, in small letters.
fn ending_of(path: &Path) -> String {
    path.extension().map_or_else(String::new, |ending| ending.to_string_lossy().to_lowercase())
}

/// The error of a file whose name ends in no format that is written.
fn unknown_ending(path: &Path, formats: &str) -> CommandError {
    CommandError::Other(format!(
        "{}: the ending of the name says the format, {formats}; write another ending",
        path.display()
    ))
}

impl Convert {
    fn execute(&self) -> Result<Exit, CommandError> {
        let structure = read(&self.file)?;
        let to = self.to.clone().unwrap_or_else(|| self.file.with_extension("npz"));
        let failed = |error: crate::structure::StructureError| {
            CommandError::Other(error.in_file(&to).to_string())
        };
        let mut files = Vec::new();
        let ending = ending_of(&to);
        if ending == "op4" {
            let name = to.file_name().unwrap_or_default().to_string_lossy();
            let (bytes, table) = op4::of_structure(&structure, &name).map_err(failed)?;
            files.extend([(to.clone(), bytes), (to.with_extension("toml"), table.into_bytes())]);
        } else if ending == "npz" {
            files.push((to.clone(), npz::write(&structure).map_err(failed)?));
        } else {
            return Err(unknown_ending(&to, "NPZ (.npz) or op4 (.op4)"));
        }
        let paths: Vec<_> = files.iter().map(|(path, _)| path.as_path()).collect();
        let mut outputs = Outputs::of_files(&paths, self.force)?;
        let files: Vec<_> = files.iter().map(|(path, bytes)| (name_of(path), bytes)).collect();
        outputs.write(&files)?;
        let (nodes, modes) = (structure.nodes.len(), structure.modes.len());
        print(&format!("{}: {nodes} nodes, {modes} modes\n", to.display()))?;
        if !structure.initial.is_empty() {
            print(
                "modal coordinates and rates at the start are not in it: write them in the scenario\n",
            )?;
        }
        Ok(Exit::Success)
    }
}

/// Everything about a structure, for people.
fn shown(structure: &Structure) -> String {
    let cells = |texts: &[&str]| texts.iter().map(|text| (*text).to_owned()).collect::<Vec<_>>();
    let mut text = String::new();
    if !structure.name.is_empty() {
        let _ = writeln!(text, "{}\n", structure.name);
    }
    let mut rows = vec![cells(&["node", "x (m)", "y (m)", "z (m)"])];
    for node in &structure.nodes {
        let position = node.position.iter().map(|value| six(*value));
        rows.push(std::iter::once(node.name.clone()).chain(position).collect());
    }
    text.push_str(&aligned(&rows));
    text.push('\n');
    text.push_str(&mass(structure));
    text.push_str("\neffective masses about B\n");
    let heads = ["mode", "f (Hz)", "zeta", "x (kg)", "y (kg)", "z (kg)"];
    let turns = ["rx (kg m^2)", "ry (kg m^2)", "rz (kg m^2)"];
    let mut rows = vec![cells(&[&heads[..], &turns[..]].concat())];
    let masses = structure.effective_masses();
    for (index, (mode, masses)) in structure.modes.iter().zip(&masses).enumerate() {
        let hertz = mode.frequency / std::f64::consts::TAU;
        let mut row = vec![(index + 1).to_string(), six(hertz), six(mode.damping)];
        row.extend(masses.iter().map(|value| six(*value)));
        rows.push(row);
    }
    let sum = masses.iter().fold(nalgebra::Vector6::zeros(), |sum, masses| sum + masses);
    let mut row = cells(&["sum", "", ""]);
    row.extend(sum.iter().map(|value| six(*value)));
    rows.push(row);
    text.push_str(&aligned(&rows));
    if !structure.initial.is_empty() {
        let [coordinates, rates] = structure.states();
        for (what, values) in [("coordinates", coordinates), ("rates", rates)] {
            let values: Vec<_> = values.iter().map(|value| six(*value)).collect();
            let _ = writeln!(text, "modal {what} at the start {}", values.join(", "));
        }
    }
    text.push_str("\nchecks\n");
    let mut rows = Vec::new();
    for check in structure.checks() {
        let (answer, found) = match (check.holds(), check.found) {
            (Some(holds), Some(found)) => {
                let sign = if holds { "<=" } else { ">" };
                let found = format!("{:.1e} {sign} {:.0e}", found.max(0.0), check.bound);
                (if holds { "yes" } else { "no" }, format!("{found} {}", check.note))
            }
            _ => ("unknown", check.note.to_owned()),
        };
        rows.push(vec![check.claim.to_owned(), answer.to_owned(), found]);
    }
    text.push_str(&super::table::aligned_left(&rows));
    text
}

fn mass(structure: &Structure) -> String {
    let mut text = String::new();
    let devices = match structure.has_devices {
        Some(true) => "the model has the mass of the devices",
        Some(false) => "the model is without the devices",
        None => "nobody said whether the model has the mass of the devices",
    };
    match &structure.mass {
        None => text.push_str("mass unknown\n"),
        Some(mass) => {
            let list = |values: &[f64]| {
                values.iter().map(|value| six(*value)).collect::<Vec<_>>().join(", ")
            };
            let inertia = &mass.inertia;
            let products = [inertia.m12, inertia.m13, inertia.m23];
            let _ = writeln!(
                text,
                "mass {} kg, centre of mass {} m\ninertia about B {} kg m^2, elements 12, 13, 23 of it \
                 {} kg m^2",
                six(mass.mass),
                list(mass.centre().as_slice()),
                list(inertia.diagonal().as_slice()),
                list(&products)
            );
        }
    }
    let _ = writeln!(text, "{devices}");
    text
}
