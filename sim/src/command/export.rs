//! `export table`: a spacecraft as the parameter table of the flight library's C interface; and the list of exports.
//!
//! The layout is that of `flight/capi/src/table.rs`, little-endian: "PREC", version, length, count of
//! devices and platforms; the hub; each of them; CRC-32. It is version 1 unless one has more than three joints,
//! as a platform has, then version 2. Fixed steps of rk4 with inputs held over
//! a step give the same bits there as here, for up to eight devices.

mod fmu;

use std::path::PathBuf;

use clap::{Args, Subcommand};
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use precess_dynamics::{BuiltInKind, Coupled, MAX_JOINTS, Passive, Strut, Suspension};

use super::error::CommandError;
use super::exit::Exit;
use super::options::Set;
use super::outputs::{Outputs, name_of};
use super::terminal::print;
use crate::file::from_file;
use crate::scenario::{Member, Scenario, members};

/// Bodies and joints of a device in a table of version 1, and of version 2.
const JOINTS: [usize; 2] = [3, MAX_JOINTS];
/// Devices and platforms that the flight library takes.
const DEVICES_MAX: usize = 8;
const BARE: usize = 124;
/// Kind, model and mount.
const DEVICE: usize = 80;
/// A body and its joint.
const PER_JOINT: usize = 168;
/// In version 2: what an entry stands on, a word of zero, a suspension.
const STANDING: usize = 8 + 8 * (36 + 6 + 36 + 6 * 9);
/// The kind of a platform.
const PLATFORM: i32 = 100;
/// Platforms on the hub that the flight library takes: without platforms on them, and with; platforms on each of
/// these; devices on any platform.
const PLATFORMS_MAX: usize = 4;
const LOWER_MAX: usize = 1;
const UPPER_MAX: usize = 1;
const CARRIED_MAX: usize = 4;
const ROWS_MAX: usize = 2;

/// What is exported.
#[derive(Debug, Subcommand)]
pub(super) enum Export {
    /// The parameters of hub and devices, for `precess_init_from_table` of the C library
    #[command(after_help = "Example:\n  precess export table bus.toml --to bus.table")]
    Table(Table),
    /// The spacecraft as a functional mock-up unit of FMI 2.0 or 3.0: C sources, Model Exchange and Co-Simulation
    #[command(after_help = fmu::HELP)]
    Fmu(fmu::Unit),
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
    pub(super) fn execute(&self) -> Result<Exit, CommandError> {
        let options = match self {
            Self::Table(options) => options,
            Self::Fmu(options) => return options.execute(),
        };
        let (scenario, _) = from_file(&options.file, &options.overrides.overrides())
            .map_err(CommandError::Scenario)?;
        let bytes = table(&scenario)?;
        let to = options
            .to
            .clone()
            .unwrap_or_else(|| options.file.with_file_name(format!("{}.table", scenario.name)));
        Outputs::of_files(&[&to], options.force)?.write(&[(name_of(&to), &bytes)])?;
        print(&format!(
            "{}: {} bytes, {} devices\n",
            to.display(),
            bytes.len(),
            scenario.names.len()
        ))?;
        Ok(Exit::Success)
    }
}

/// The table of a scenario.
fn table(scenario: &Scenario) -> Result<Vec<u8>, CommandError> {
    if scenario.structure.is_some() {
        let message = "the flight library's table is of a rigid hub; remove `[structure]`";
        return Err(CommandError::Other(message.to_owned()));
    }
    if let Some(joint) = scenario.first_friction() {
        let message = format!(
            "the flight library has no friction that sticks and no quadratic drag, as {joint} has; remove \
             `static_friction`, `stribeck_rate` and `quadratic_drag`, and give `coulomb` with `coulomb_rate`"
        );
        return Err(CommandError::Other(message));
    }
    let members = members(&scenario.devices);
    let count = members.len();
    if count > DEVICES_MAX {
        let message = format!(
            "{count} devices and platforms; the flight library takes {DEVICES_MAX}: remove some"
        );
        return Err(CommandError::Other(message));
    }
    check_platforms(&scenario.devices)?;
    check_rows(scenario)?;
    let most = members.iter().map(|member| member.joints().len()).max();
    let first = most.unwrap_or(0) <= JOINTS[0] && members.iter().all(|of| of.on().is_none());
    let (version, joints) = if first { (1, JOINTS[0]) } else { (2, JOINTS[1]) };
    let standing = if first { 0 } else { STANDING };
    let length = BARE + (DEVICE + PER_JOINT * joints + standing) * count;
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
    for member in &members {
        bytes
            .extend(member.device().map_or(PLATFORM, |of| of.kind().number().into()).to_le_bytes());
        bytes.extend(i32::from(member.is_lumped()).to_le_bytes());
        let mut numbers =
            |values: &[f64]| values.iter().for_each(|v| bytes.extend(v.to_le_bytes()));
        numbers(&rows(&member.mount()));
        let (bodies, passive) = (member.bodies(), member.passive());
        let missing = joints.saturating_sub(bodies.len());
        for body in &bodies {
            numbers(&[body.mass]);
            numbers(&body.origin);
            numbers(&body.centre);
            numbers(&rows(&body.inertia));
        }
        (0..missing).for_each(|_| numbers(&[0.0; 16]));
        for joint in &passive {
            let Passive { stiffness, rest, viscous, coulomb, coulomb_rate } = *joint;
            numbers(&[stiffness, rest, viscous, coulomb, coulomb_rate]);
        }
        (0..missing).for_each(|_| numbers(&[0.0; 5]));
        if !first {
            for value in [member.on().map_or(0, |on| word(on.saturating_add(1))), 0] {
                bytes.extend(value.to_le_bytes());
            }
            let none = Suspension::none();
            bytes.extend(suspension(member.suspension().unwrap_or(&none)));
        }
    }
    let sum = crc32fast::hash(&bytes);
    bytes.extend(sum.to_le_bytes());
    Ok(bytes)
}

/// Rejects more platforms, and more on one, than the flight library takes.
fn check_platforms((_, isolated, _): &precess_craft::Set) -> Result<(), CommandError> {
    let upper = isolated.iter().map(|of| of.carried.1.len());
    let lower = upper.clone().filter(|count| *count > 0).count();
    let all = isolated.iter().flat_map(|of| {
        let on_platform = of.carried.1.iter().map(|of| of.carried.len());
        std::iter::once(of.carried.0.len()).chain(on_platform)
    });
    for (what, found, most) in [
        ("platforms", isolated.len().saturating_sub(lower), PLATFORMS_MAX),
        ("platforms with platforms on them", lower, LOWER_MAX),
        ("platforms on a platform", upper.max().unwrap_or(0), UPPER_MAX),
        ("devices on a platform", all.max().unwrap_or(0), CARRIED_MAX),
    ] {
        if found > most {
            let message = format!("{found} {what}; the flight library takes {most}: remove some");
            return Err(CommandError::Other(message));
        }
    }
    Ok(())
}

/// Rejects more rows of panels than the flight library takes, and rows that carry something else.
fn check_rows(scenario: &Scenario) -> Result<(), CommandError> {
    let members = members(&scenario.devices);
    let on = |base: usize| members.iter().filter(move |member| member.on() == Some(base));
    let carried_by = |base: usize| {
        let on_base = scenario.members().filter(|(_, member)| member.on() == Some(base));
        on_base.map(|(name, _)| name.to_owned()).collect::<Vec<_>>().join(", ")
    };
    for (index, (name, member)) in scenario.members().enumerate() {
        let Some(panel) = member.device().filter(|of| of.kind() == BuiltInKind::HingedPanel) else {
            continue;
        };
        let carried = on(index).filter_map(Member::device);
        let others = carried.filter(|of| of.kind() != panel.kind()).count();
        if others > 0 || on(index).count() > 1 {
            let message = format!(
                "`{name}` carries {}; the flight library takes one panel on a panel, and no other device: remove some",
                carried_by(index)
            );
            return Err(CommandError::Other(message));
        }
    }
    let (found, most) = (scenario.devices.2.len(), ROWS_MAX);
    if found > most {
        let message =
            format!("{found} rows of panels; the flight library takes {most}: remove some");
        return Err(CommandError::Other(message));
    }
    Ok(())
}

/// A suspension: stiffness, rest, damping, six struts; zeros where there is none.
fn suspension(of: &Suspension) -> Vec<u8> {
    let none =
        Coupled { stiffness: Matrix6::zeros(), rest: Vector6::zeros(), damping: Matrix6::zeros() };
    let Coupled { stiffness, rest, damping } = of.coupled.unwrap_or(none);
    // Both are symmetric to rounding; the table has rows.
    let matrices = [stiffness.transpose(), damping.transpose()];
    let mut numbers = Vec::with_capacity(STANDING / 8);
    numbers.extend(&matrices[0]);
    numbers.extend(&rest);
    numbers.extend(&matrices[1]);
    for strut in &of.struts {
        let zero = Vector3::zeros();
        let none =
            Strut { position: zero, direction: zero, length: 0.0, stiffness: 0.0, damping: 0.0 };
        let strut = strut.unwrap_or(none);
        numbers.extend(strut.position.iter().chain(&strut.direction));
        numbers.extend([strut.length, strut.stiffness, strut.damping]);
    }
    numbers.into_iter().flat_map(f64::to_le_bytes).collect()
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
        assert_eq!(bytes.len(), 124 + 2320);
        assert_eq!(bytes[4], 2);
        let number = |at: usize| f64::from_le_bytes(bytes[at..at + 8].try_into().expect("eight"));
        // No mass of a link of the bearings; that of the rotor; the stiffness of a tilt.
        let (body, passive) = (120 + 80, 120 + 80 + 7 * 128);
        assert_eq!([number(body), number(body + 5 * 128)], [0.0, 4.0]);
        assert_eq!(number(passive + 3 * 40), 1580.0);
    }

    #[test]
    fn a_table_of_an_isolator_says_what_stands_on_it() {
        let text = include_str!("../../../scenarios/wheels-on-isolator.toml");
        let read = crate::file::from_toml("isolator", text, Path::new(""));
        let (scenario, _) = read.unwrap_or_else(|errors| panic!("{errors}"));
        let bytes = table(&scenario).expect("a platform and four wheels");
        assert_eq!(bytes.len(), 124 + 5 * 2320);
        let word = |at: usize| i32::from_le_bytes(bytes[at..at + 4].try_into().expect("four"));
        let entry = |index: usize| 120 + 2320 * index;
        let kinds = [0, 1, 2, 3, 4].map(|index| [word(entry(index)), word(entry(index) + 1256)]);
        assert_eq!(kinds, [[100, 0], [9, 1], [9, 1], [9, 1], [9, 1]]);
    }

    #[test]
    fn a_table_has_one_platform_on_another() {
        let platform = |name: &str, on: &str| {
            format!(
                "[[platform]]\nname = \"{name}\"\non = \"{on}\"\nmass = \"1 kg\"\ninertia = \"1, 1, 1 kg m^2\"\n"
            )
        };
        let of = |platforms: &[(&str, &str)]| {
            let platforms: String = platforms.iter().map(|(name, on)| platform(name, on)).collect();
            let text = format!(
                "format = 1\n{platforms}[hub]\nmass = \"9 kg\"\ninertia = \"9, 9, 9 kg m^2\"\n[run]\nduration = \"1 s\"\n"
            );
            let read = crate::file::from_toml("stacked", &text, Path::new(""));
            let (scenario, _) = read.unwrap_or_else(|errors| panic!("{errors}"));
            table(&scenario)
        };
        // Entries in the order of the set, each with 1 + the entry that it stands on.
        let bytes = of(&[("upper", "lower"), ("other", "hub"), ("lower", "hub")]).expect("three");
        let word = |at: usize| i32::from_le_bytes(bytes[at..at + 4].try_into().expect("four"));
        assert_eq!([0, 1, 2].map(|index| word(120 + 2320 * index + 1256)), [0, 0, 2]);
        for (platforms, found) in [
            ([("a", "hub"), ("b", "a"), ("c", "a"), ("d", "hub")], "2 platforms on a platform"),
            (
                [("a", "hub"), ("b", "a"), ("c", "d"), ("d", "hub")],
                "2 platforms with platforms on them",
            ),
        ] {
            let error = of(&platforms).expect_err(found).to_string();
            assert!(error.contains(found) && error.contains("remove"), "{error}");
        }
    }

    #[test]
    fn more_devices_on_a_platform_than_the_library_takes_are_refused() {
        let text = include_str!("../../../scenarios/wheels-on-isolator.toml");
        let text = format!("{text}\n[[device]]\nname = \"rw5\"\ncopy_of = \"rw1\"\n");
        let read = crate::file::from_toml("isolator", &text, Path::new(""));
        let (scenario, _) = read.unwrap_or_else(|errors| panic!("{errors}"));
        let error = table(&scenario).expect_err("five wheels on a platform").to_string();
        assert!(error.contains("5 devices on a platform") && error.contains("remove"), "{error}");
    }

    #[test]
    fn friction_that_sticks_is_refused() {
        let text = include_str!("../../../scenarios/sticking-wheel.toml");
        let read = crate::file::from_toml("sticking", text, Path::new(""));
        let (scenario, _) = read.unwrap_or_else(|errors| panic!("{errors}"));
        let error = table(&scenario).expect_err("it sticks").to_string();
        assert!(error.contains("as wheel.theta has; remove `static_friction`"), "{error}");
    }
}
