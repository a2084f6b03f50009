//! `export table`: a spacecraft as the parameter table of the flight library's C interface.
//!
//! The layout is that of `flight/capi/src/table.rs`, version 1, little-endian: "PREC", version,
//! length, count of devices; the hub; each device; CRC-32. Fixed steps of rk4 with inputs held over
//! a step give the same bits there as here, for up to eight devices.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, Subcommand};
use nalgebra::Matrix3;
use precess_dynamics::kind::ImbalanceModel;

use super::error::CommandError;
use super::run::may_write;
use super::{Set, print};
use crate::file::from_file;
use crate::scenario::Scenario;

const VERSION: u32 = 1;
/// Devices that the flight library takes.
const DEVICES_MAX: usize = 8;
const BARE: usize = 124;
const PER_DEVICE: usize = 584;

/// What is exported.
#[derive(Debug, Subcommand)]
pub(super) enum Export {
    /// The parameters of hub and devices, for `precess_init_from_table` of the C library
    #[command(after_help = "Example:\n  precess export table bus.toml --to bus.table")]
    Table(Table),
}

/// The options of `export table`.
#[derive(Debug, Args)]
pub(super) struct Table {
    /// The scenario file.
    file: PathBuf,
    #[command(flatten)]
    overrides: Set,
    /// The file to write; the scenario's name and `.table` beside it without this option.
    #[arg(long, value_name = "FILE")]
    to: Option<PathBuf>,
    /// Replace a file that is there.
    #[arg(long)]
    force: bool,
}

impl Export {
    pub(super) fn execute(&self) -> Result<ExitCode, CommandError> {
        let Self::Table(options) = self;
        let (scenario, _) = from_file(&options.file, &options.overrides.overrides())
            .map_err(CommandError::Scenario)?;
        let bytes = table(&scenario)?;
        let to = options
            .to
            .clone()
            .unwrap_or_else(|| options.file.with_file_name(format!("{}.table", scenario.name)));
        let name = to.file_name().map(|name| name.to_string_lossy().into_owned());
        let folder = to.parent().map(PathBuf::from).unwrap_or_default();
        may_write(&folder, &name.into_iter().collect::<Vec<_>>(), options.force)?;
        std::fs::write(&to, &bytes)
            .map_err(|source| CommandError::Io { path: to.clone(), source })?;
        print(&format!(
            "{}: {} bytes, {} devices\n",
            to.display(),
            bytes.len(),
            scenario.devices.len()
        ));
        Ok(ExitCode::SUCCESS)
    }
}

/// The table of a scenario.
fn table(scenario: &Scenario) -> Result<Vec<u8>, CommandError> {
    let count = scenario.devices.len();
    if count > DEVICES_MAX {
        let message =
            format!("{count} devices; the flight library takes {DEVICES_MAX}: remove some");
        return Err(CommandError::Other(message));
    }
    let length = BARE + PER_DEVICE * count;
    let mut bytes = Vec::with_capacity(length);
    bytes.extend(b"PREC");
    let word = |value: usize| u32::try_from(value).unwrap_or(u32::MAX);
    for value in [VERSION, word(length), word(count)] {
        bytes.extend(value.to_le_bytes());
    }
    let mut numbers = |values: &[f64]| values.iter().for_each(|v| bytes.extend(v.to_le_bytes()));
    let hub = &scenario.hub;
    numbers(&[hub.m_b]);
    numbers(hub.r_bc_b.as_slice());
    numbers(&rows(&hub.i_b_bc));
    for device in &scenario.devices {
        let parameters = device.parameters();
        let lumped = parameters.model == ImbalanceModel::Lumped;
        bytes.extend(i32::from(device.kind().number()).to_le_bytes());
        bytes.extend(i32::from(lumped).to_le_bytes());
        let mut numbers =
            |values: &[f64]| values.iter().for_each(|v| bytes.extend(v.to_le_bytes()));
        numbers(&rows(&parameters.mount));
        for body in &parameters.bodies {
            numbers(&[body.mass]);
            numbers(&body.origin);
            numbers(&body.centre);
            numbers(&rows(&body.inertia));
        }
        for joint in &parameters.passive {
            numbers(&[
                joint.stiffness,
                joint.rest,
                joint.viscous,
                joint.coulomb,
                joint.coulomb_rate,
            ]);
        }
    }
    let sum = crc32fast::hash(&bytes);
    bytes.extend(sum.to_le_bytes());
    Ok(bytes)
}

/// The elements row by row.
fn rows(matrix: &Matrix3<f64>) -> [f64; 9] {
    let m = matrix;
    [m.m11, m.m12, m.m13, m.m21, m.m22, m.m23, m.m31, m.m32, m.m33]
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    #[test]
    fn a_table_has_the_layout_of_the_flight_library() {
        let text = include_str!("../../../scenarios/table1-printed-free.toml");
        let read = crate::file::from_toml("table1", text, Path::new(""));
        let (scenario, _) = read.unwrap_or_else(|errors| panic!("{errors}"));
        let bytes = table(&scenario).expect("one device");
        assert_eq!(bytes.len(), BARE + PER_DEVICE);
        let number = |at: usize| f64::from_le_bytes(bytes[at..at + 8].try_into().expect("eight"));
        assert_eq!(&bytes[..4], b"PREC");
        // Hub's mass; the first device's mount; the mass of its first body; its wheel's offset.
        assert_eq!([number(16), number(120 + 8), number(120 + 80)], [810.0, 1.0, 24.0]);
        assert_eq!(number(120 + 80 + 2 * 128 + 8 * 5), 8.0e-3);
    }
}
