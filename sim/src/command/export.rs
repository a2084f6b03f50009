//! `export table`: a spacecraft as the parameter table of the flight library's C interface.
//!
//! The layout is that of `flight/capi/src/table.rs`, little-endian: "PREC", version, length, count of
//! devices; the hub; each device; CRC-32. It is version 1 unless a device has more than three joints,
//! then version 2. Fixed steps of rk4 with inputs held over
//! a step give the same bits there as here, for up to eight devices.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, Subcommand};
use nalgebra::Matrix3;
use precess_dynamics::MAX_JOINTS;
use precess_dynamics::kind::ImbalanceModel;

use super::error::CommandError;
use super::run::may_write;
use super::{Set, print};
use crate::file::from_file;
use crate::scenario::Scenario;

/// Bodies and joints of a device in a table of version 1, and of version 2.
const JOINTS: [usize; 2] = [3, MAX_JOINTS];
/// Devices that the flight library takes.
const DEVICES_MAX: usize = 8;
const BARE: usize = 124;
/// Kind, model and mount.
const DEVICE: usize = 80;
/// A body and its joint.
const PER_JOINT: usize = 168;

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
            scenario.names.len()
        ));
        Ok(ExitCode::SUCCESS)
    }
}

/// The table of a scenario.
fn table(scenario: &Scenario) -> Result<Vec<u8>, CommandError> {
    if scenario.structure.is_some() {
        let message = "the flight library's table is of a rigid hub; remove `[structure]`";
        return Err(CommandError::Other(message.to_owned()));
    }
    let (on_hub, isolated) = &scenario.devices;
    if !isolated.is_empty() {
        let message = "a table of the flight library has no platforms; remove `[[platform]]`, and \
                       `on` of the devices on it";
        return Err(CommandError::Other(message.to_owned()));
    }
    let count = on_hub.len();
    if count > DEVICES_MAX {
        let message =
            format!("{count} devices; the flight library takes {DEVICES_MAX}: remove some");
        return Err(CommandError::Other(message));
    }
    let most = on_hub.iter().map(|device| device.kind().joints().len()).max();
    let first = most.unwrap_or(0) <= JOINTS[0];
    let (version, joints) = if first { (1, JOINTS[0]) } else { (2, JOINTS[1]) };
    let length = BARE + (DEVICE + PER_JOINT * joints) * count;
    let mut bytes = Vec::with_capacity(length);
    bytes.extend(b"PREC");
    let word = |value: usize| u32::try_from(value).unwrap_or(u32::MAX);
    for value in [version, word(length), word(count)] {
        bytes.extend(value.to_le_bytes());
    }
    let mut numbers = |values: &[f64]| values.iter().for_each(|v| bytes.extend(v.to_le_bytes()));
    let hub = &scenario.hub;
    numbers(&[hub.m_b]);
    numbers(hub.r_bc_b.as_slice());
    numbers(&rows(&hub.i_b_bc));
    for device in on_hub {
        let parameters = device.parameters();
        let lumped = parameters.model == ImbalanceModel::Lumped;
        bytes.extend(i32::from(device.kind().number()).to_le_bytes());
        bytes.extend(i32::from(lumped).to_le_bytes());
        let mut numbers =
            |values: &[f64]| values.iter().for_each(|v| bytes.extend(v.to_le_bytes()));
        numbers(&rows(&parameters.mount));
        for body in parameters.bodies.iter().take(joints) {
            numbers(&[body.mass]);
            numbers(&body.origin);
            numbers(&body.centre);
            numbers(&rows(&body.inertia));
        }
        for joint in parameters.passive.iter().take(joints) {
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
        assert_eq!(bytes.len(), 124 + 584);
        assert_eq!(bytes[4], 1);
        let number = |at: usize| f64::from_le_bytes(bytes[at..at + 8].try_into().expect("eight"));
        assert_eq!(&bytes[..4], b"PREC");
        // Hub's mass; the first device's mount; the mass of its first body; its wheel's offset.
        assert_eq!([number(16), number(120 + 8), number(120 + 80)], [810.0, 1.0, 24.0]);
        assert_eq!(number(120 + 80 + 2 * 128 + 8 * 5), 8.0e-3);
    }

    #[test]
    fn a_table_of_flexible_bearings_is_of_version_2() {
        let text = include_str!("../../../scenarios/soft-wheel-whirl.toml");
        let read = crate::file::from_toml("whirl", text, Path::new(""));
        let (scenario, _) = read.unwrap_or_else(|errors| panic!("{errors}"));
        let bytes = table(&scenario).expect("one device");
        assert_eq!(bytes.len(), 124 + 1088);
        assert_eq!(bytes[4], 2);
        let number = |at: usize| f64::from_le_bytes(bytes[at..at + 8].try_into().expect("eight"));
        // No mass of a link of the bearings; that of the rotor; the stiffness of a tilt.
        let (body, passive) = (120 + 80, 120 + 80 + 6 * 128);
        assert_eq!([number(body), number(body + 5 * 128)], [0.0, 4.0]);
        assert_eq!(number(passive + 3 * 40), 1580.0);
    }
}
