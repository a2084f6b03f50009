//! `accelerance`: accelerances of a structure over frequency, the dynamic mass of devices on it, and the
//! transmission from their blocked force to the mounted one, as tables (CSV) and figures (SVG).

mod mounted;

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use nalgebra::Complex;

use super::error::CommandError;
use super::exit::Exit;
use super::outputs::Outputs;
use super::structure;
use super::terminal::{note, print};
use crate::names::file_names;
use crate::report::response::Response;
use crate::structure::accelerance::{Accelerance, Base, ComplexMatrix};
use crate::structure::mounted::{transmission, without_mass};
use crate::structure::{COORDINATE_NAMES, COORDINATES, Fault, Structure};
use crate::units::{Measure, parse_quantity};
use mounted::{DeviceOptions, MountedDevices};

pub(super) const HELP: &str = "\
Examples:
  precess accelerance bus.npz --at wheel1 --from '1 Hz' --to '500 Hz'
      driving-point accelerance at wheel1: a table and figures
  precess accelerance bus.npz --at camera --force-at wheel1
      acceleration of the camera by forces at wheel1
  precess accelerance bus.npz --at wheel1 --scenario bus.toml --device wheel1
      and the dynamic mass of the wheel, and the transmission from its blocked
      force to the mounted one";

/// Names of forces and moments, in the order of the coordinates.
const FORCES: [&str; COORDINATES] = ["fx", "fy", "fz", "mx", "my", "mz"];
/// What is smaller than this share of the largest curve is not drawn.
const DRAWN_MIN: f64 = 1e-9;
/// Frequencies of a table, at most.
const POINTS_MAX: u32 = 100_000;

/// The options of `accelerance`.
#[derive(Debug, Args)]
pub(super) struct AcceleranceCommand {
    /// The structure: NPZ, Flex text of 42, or a table in TOML (docs/structure.md).
    file: PathBuf,
    /// A node that moves; may be repeated.
    #[arg(long, required = true, value_name = "NODE")]
    at: Vec<String>,
    /// The node with the force; each node that moves for its own (driving point) without this option.
    #[arg(long, value_name = "NODE")]
    force_at: Option<String>,
    /// The lowest frequency, with its unit.
    #[arg(long, value_name = "FREQUENCY", value_parser = frequency, default_value = "1 Hz")]
    from: f64,
    /// The highest frequency, with its unit.
    #[arg(long, value_name = "FREQUENCY", value_parser = frequency, default_value = "1 kHz")]
    to: f64,
    /// Frequencies at equal ratios; those of the modes are added.
    #[arg(long, default_value_t = 600, value_parser = clap::value_parser!(u32).range(2..=i64::from(POINTS_MAX)))]
    points: u32,
    /// Whether the structure is free, or held at B.
    #[arg(long, default_value = "free")]
    base: BaseCondition,
    #[command(flatten)]
    devices: DeviceOptions,
    /// Folder for tables and figures; made if it is missing.
    #[arg(long, value_name = "FOLDER", default_value = "precess-out")]
    out: PathBuf,
    /// Replace files that are there.
    #[arg(long)]
    force: bool,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum BaseCondition {
    /// A rigid motion follows forces.
    Free,
    /// B does not move.
    Fixed,
}

/// A 6 × 6 response over frequency.
struct Table {
    /// In names of files.
    name: String,
    title: String,
    /// Names of rows and columns.
    names: [[&'static str; COORDINATES]; 2],
    /// Physical quantity of rows by columns, for each block: translation or rotation.
    units: [[&'static str; 2]; 2],
    values: Vec<ComplexMatrix>,
    /// Name and values of a last column of the table.
    bound: Option<(&'static str, Vec<f64>)>,
}

/// A frequency with its unit, Hz.
fn frequency(text: &str) -> Result<f64, String> {
    let example = "write a number above zero and a unit of frequency: \"10 Hz\"";
    let quantity = parse_quantity(text).map_err(|error| format!("{}; {example}", error.kind))?;
    match quantity.values[..] {
        [value] if quantity.is(Measure::FREQUENCY) && value > 0.0 => Ok(value),
        _ => Err(format!("`{text}` is no frequency; {example}")),
    }
}

impl AcceleranceCommand {
    pub(super) fn execute(&self) -> Result<Exit, CommandError> {
        let structure = structure::read(&self.file)?;
        if self.from >= self.to {
            let message = format!("{} Hz to {} Hz is no range", self.from, self.to);
            return Err(CommandError::Other(message));
        }
        let failed =
            |fault: Fault| CommandError::Other(format!("{}: {fault}", self.file.display()));
        let frequencies = self.frequencies(&structure);
        let stem =
            self.file.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned());
        let mut tables = Vec::new();
        for to in &self.at {
            let from = self.force_at.as_ref().unwrap_or(to);
            let numbers =
                [structure.node(to).map_err(failed)?, structure.node(from).map_err(failed)?];
            tables.push(
                self.accelerance(&structure, [to, from], numbers, &frequencies).map_err(failed)?,
            );
        }
        let node = self.at.first().map_or("", String::as_str);
        let number = structure.node(node).map_err(failed)?;
        let position = structure.nodes.get(number).map_or_else(Default::default, |n| n.position);
        if let Some(devices) = self.devices.mounted(node, &position)? {
            tables.push(dynamic_mass(&devices, node, &frequencies).map_err(failed)?);
            let both = self.transmission(&structure, (node, number), &devices, &frequencies);
            tables.push(both.map_err(failed)?);
        }
        // Names of nodes that differ may be one in the name of a file.
        let names = file_names(tables.iter().map(|table| &table.name));
        for (table, name) in tables.iter_mut().zip(names) {
            table.name = format!("{stem}-{name}");
        }
        let files: Vec<_> = tables.iter().flat_map(|table| table.files(&frequencies)).collect();
        for path in Outputs::reserve(&self.out, &[], self.force)?.write(&files)? {
            print(&format!("{}\n", path.display()))?;
        }
        Ok(Exit::Success)
    }

    /// Equal ratios, and every mode with its half-power points, so that no peak is missed; Hz, rising.
    fn frequencies(&self, structure: &Structure) -> Vec<f64> {
        let ratio = (self.to / self.from).ln() / f64::from(self.points - 1);
        let mut all: Vec<f64> =
            (0..self.points).map(|k| self.from * (ratio * f64::from(k)).exp()).collect();
        for mode in &structure.modes {
            let natural = mode.frequency / TAU;
            let near =
                [-2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0].map(|n| natural * (1.0 + n * mode.damping));
            // A mode without damping has no finite response at its frequency.
            all.extend(near.into_iter().filter(|f| *f != natural || mode.damping > 0.0));
        }
        all.retain(|frequency| (self.from..=self.to).contains(frequency));
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    }

    fn base(&self) -> Base {
        match self.base {
            BaseCondition::Free => Base::Free,
            BaseCondition::Fixed => Base::Fixed,
        }
    }

    fn accelerance(
        &self,
        structure: &Structure,
        [to, from]: [&str; 2],
        [row, column]: [usize; 2],
        frequencies: &[f64],
    ) -> Result<Table, Fault> {
        let accelerance = Accelerance::new(structure, self.base(), &[row], &[column])?;
        let values: Result<Vec<_>, _> =
            frequencies.iter().map(|f| accelerance.at(TAU * f)).collect();
        let by = if to == from { String::new() } else { format!(" by {from}") };
        let title = if to == from {
            format!("Accelerance at {to}")
        } else {
            format!("Accelerance of {to} by {from}")
        };
        Ok(Table {
            name: format!("accelerance {to}{by}"),
            title,
            names: [COORDINATE_NAMES, FORCES],
            units: [["m/s²/N", "m/s²/(N m)"], ["rad/s²/N", "rad/s²/(N m)"]],
            values: values?,
            bound: None,
        })
    }

    /// The transmission `(1 + M_w A_s)^-1` of devices at the first node.
    fn transmission(
        &self,
        structure: &Structure,
        (node, number): (&str, usize),
        devices: &MountedDevices,
        frequencies: &[f64],
    ) -> Result<Table, Fault> {
        let accelerance = Accelerance::new(structure, self.base(), &[number], &[number])?;
        let at = |f: &f64| {
            let w = TAU * f;
            let mut own = accelerance.at(w)?;
            // In the model of the structure the devices are a rigid body.
            if structure.has_devices == Some(true) {
                own = without_mass(&own, &devices.rigid.dynamic_mass(w)?, w)?;
            }
            transmission(&devices.averaged.dynamic_mass(w)?, &own, w)
        };
        let values: Result<Vec<_>, _> = frequencies.iter().map(at).collect();
        if structure.has_devices.is_none() {
            note(&format!(
                "warning: {} does not say whether its model has the devices' mass (`has_devices`); taken as \
                 without",
                self.file.display()
            ));
        }
        Ok(Table {
            name: format!("transmission {node}"),
            title: format!("Mounted by blocked force at {node}: {}", devices.names),
            names: [FORCES, FORCES],
            units: [["N/N", "N/(N m)"], ["N m/N", "N m/(N m)"]],
            values: values?,
            bound: None,
        })
    }
}

/// The dynamic mass of devices at a node, and the bound of what averaging leaves out.
fn dynamic_mass(devices: &MountedDevices, node: &str, frequencies: &[f64]) -> Result<Table, Fault> {
    let MountedDevices { averaged, names, .. } = devices;
    let values: Result<Vec<_>, _> =
        frequencies.iter().map(|f| averaged.dynamic_mass(TAU * f)).collect();
    let left_out: Result<Vec<_>, _> =
        frequencies.iter().map(|f| averaged.periodic(TAU * f)).collect();
    let left_out = left_out?;
    let most = left_out.iter().copied().fold(0.0, f64::max);
    note(&format!(
        "note: {names}: averaging over a turn leaves out at most {most:.1e} of the inertia, at the frequency \
         plus and minus one and two times the rates"
    ));
    Ok(Table {
        name: format!("dynamic mass {node}"),
        title: format!("Dynamic mass at {node}: {names}"),
        names: [FORCES, COORDINATE_NAMES],
        units: [["kg", "kg m"], ["kg m", "kg m²"]],
        values: values?,
        bound: Some(("left_out", left_out)),
    })
}

impl Table {
    /// Name and text of the table and its figures.
    fn files(&self, frequencies: &[f64]) -> Vec<(String, String)> {
        let mut files = vec![(format!("{}.csv", self.name), self.csv(frequencies))];
        let parts = |names: [&str; COORDINATES]| {
            if names == FORCES { ["force", "moment"] } else { ["translation", "rotation"] }
        };
        for (row, of) in parts(self.names[0]).into_iter().enumerate() {
            for (column, by) in parts(self.names[1]).into_iter().enumerate() {
                let response = self.block(frequencies, [row, column]);
                if let Some(Ok(svg)) = response.map(|response| response.file()) {
                    files.push((format!("{}-{of}-by-{by}.svg", self.name), svg));
                }
            }
        }
        files
    }

    /// A row for each frequency: real and imaginary part of each of the 36 elements.
    fn csv(&self, frequencies: &[f64]) -> String {
        let mut text = String::from("frequency_hz");
        for row in self.names[0] {
            for column in self.names[1] {
                let _ = write!(text, ",{row}_{column}_re,{row}_{column}_im");
            }
        }
        if let Some((name, _)) = &self.bound {
            let _ = write!(text, ",{name}");
        }
        let mut digits = zmij::Buffer::new();
        for (index, (frequency, values)) in frequencies.iter().zip(&self.values).enumerate() {
            text.push('\n');
            text.push_str(digits.format(*frequency));
            for value in values.transpose().iter() {
                for part in [value.re, value.im] {
                    text.push(',');
                    text.push_str(digits.format(part));
                }
            }
            if let Some(bound) = self.bound.as_ref().and_then(|(_, values)| values.get(index)) {
                text.push(',');
                text.push_str(digits.format(*bound));
            }
        }
        text.push('\n');
        text
    }

    /// The picture of a block of three rows and columns; none where it is zero.
    fn block(&self, frequencies: &[f64], [row, column]: [usize; 2]) -> Option<Response> {
        let curve = |i: usize, j: usize| -> Vec<Complex<f64>> {
            self.values.iter().map(|value| value[(3 * row + i, 3 * column + j)]).collect()
        };
        let largest = |values: &[Complex<f64>]| values.iter().map(|v| v.norm()).fold(0.0, f64::max);
        let mut curves = Vec::new();
        for i in 0..3 {
            for j in 0..3 {
                let name =
                    format!("{}/{}", self.names[0][3 * row + i], self.names[1][3 * column + j]);
                curves.push((name, curve(i, j)));
            }
        }
        let most = curves.iter().map(|(_, values)| largest(values)).fold(0.0, f64::max);
        curves.retain(|(_, values)| largest(values) > DRAWN_MIN * most);
        let unit = self.units[row][column];
        (most > 0.0).then(|| Response {
            description: format!(
                "{}, in {unit}, magnitude and phase over frequency in Hz.",
                self.title
            ),
            title: self.title.clone(),
            axis: format!("Magnitude ({unit})"),
            frequencies: frequencies.to_vec(),
            curves,
        })
    }
}
