//! Measurements of a wheel on a table: TOML that says where the wheel is, what the columns of the files of
//! samples are, and what is looked for (docs/fit.md). Keys and units as in scenario files; every error at
//! once.

use std::path::Path;

use nalgebra::Vector3;

use super::diagnostic::Diagnostics;
use super::keys::Keys;
use super::read::values::mount::direction;
use super::read_file::{folder_of, read_file};
use super::waterfall::waterfall;
use crate::fit::device::Rotor;
use crate::fit::samples::{Layout, Samples, mean_and_slope, read as read_samples, steps};
use crate::fit::{
    CHANNELS, Group, Measurement, Mode, ModeGuess, Options, Record, TablePose, WaterfallRow,
};
use crate::names::column_name_fault;
use crate::units::{Measure, parse_unit};

/// The number of the format that this program reads.
const FORMAT: u32 = 1;
/// Damping ratio of a mode that states none.
const DAMPING: f64 = 0.02;
/// A steady step keeps its speed within this share, and lasts this long, s.
const TOLERANCE: f64 = 2e-3;
const SHORTEST: f64 = 0.5;
/// Records that a file may list.
const RECORDS_MAX: usize = 10_000;

/// A measurement with what is looked for in it.
#[derive(Clone, Debug)]
pub struct MeasurementFile {
    /// The device's name.
    pub name: String,
    /// The heading.
    pub title: String,
    /// The records, in the wheel's axes; none of a waterfall.
    pub measurement: Measurement,
    /// Spectra instead of records.
    pub waterfall: Vec<WaterfallRow>,
    /// What is looked for.
    pub options: Options,
    /// The rotor, where it is known.
    pub rotor: Option<Rotor>,
}

/// Reads a measurement and the files of samples that it names; `progress` is called with each.
///
/// # Errors
/// Everything that is wrong, with its places.
pub fn measurement_from_toml(
    path: &Path,
    progress: &mut dyn FnMut(&str),
) -> Result<MeasurementFile, Diagnostics> {
    read_file(path, "measurement", ("", &[]), |keys| read(keys, folder_of(path), progress))
}

fn read(keys: &Keys<'_>, folder: &Path, progress: &mut dyn FnMut(&str)) -> Option<MeasurementFile> {
    if !keys.has("format") {
        keys.missing("format", "format = 1");
    }
    keys.count("format", FORMAT, FORMAT);
    if !keys.has("name") {
        keys.missing("name", "name = \"rw\"");
    }
    let name = keys.text("name").unwrap_or_default();
    if let Some(fault) = column_name_fault(name).filter(|_| keys.has("name")) {
        keys.error("name", format!("`name` is of a device: {fault}"), "use a-z, 0-9, _");
    }
    let title = keys.text("title").unwrap_or(name).to_owned();
    let options = options(keys);
    let rotor = keys.table("rotor").and_then(|rotor| read_rotor(&rotor));
    if let Some(file) = keys.text("waterfall") {
        let rows = waterfall(keys, file, folder);
        keys.finish();
        return Some(MeasurementFile {
            name: name.to_owned(),
            title,
            measurement: Measurement { records: Vec::new() },
            waterfall: rows?,
            options: options?,
            rotor,
        });
    }
    let placement = placement(keys);
    let layout = layout(keys);
    let sweep = keys.table("sweep").map(|sweep| {
        let tolerance = sweep.number("tolerance").unwrap_or(TOLERANCE);
        let shortest = sweep.quantity("shortest", Measure::TIME).unwrap_or(SHORTEST);
        sweep.finish();
        [tolerance, shortest]
    });
    let listed = keys.tables("record");
    let whole = keys.text("file");
    if listed.is_empty() == whole.is_none() {
        let message =
            "a measurement is `[[record]]` for each speed, or one `file` with a speed column";
        keys.error("file", message, "give one of them");
    }
    if listed.len() > RECORDS_MAX {
        keys.error("record", format!("more than {RECORDS_MAX} records"), "write one `file`");
        return None;
    }
    let mut records: Vec<Option<Record>> = Vec::new();
    if let (Some(layout), Some(placement)) = (&layout, &placement) {
        for record in &listed {
            records.push(one(record, folder, layout, placement, progress));
        }
        if let Some(whole) = whole {
            let sweep = sweep.unwrap_or([TOLERANCE, SHORTEST]);
            progress(whole);
            records.extend(swept(keys, &folder.join(whole), layout, placement, sweep)?);
        }
    }
    keys.finish();
    let records = records.into_iter().collect::<Option<Vec<_>>>()?;
    placement?;
    Some(MeasurementFile {
        name: name.to_owned(),
        title,
        measurement: Measurement { records },
        waterfall: Vec::new(),
        options: options?,
        rotor,
    })
}

fn read_rotor(rotor: &Keys<'_>) -> Option<Rotor> {
    let mass = rotor.required("mass", Measure::MASS);
    let inertia = rotor.quantities::<2>("inertia", Measure::INERTIA);
    if inertia.is_none() && !rotor.has("inertia") {
        rotor.missing("inertia", "inertia = \"0.012, 0.0075 kg m^2\"");
    }
    rotor.finish();
    Some(Rotor { mass: mass?, inertia: inertia? })
}

/// `[table]`: where the wheel is on it.
fn placement(keys: &Keys<'_>) -> Option<TablePose> {
    let Some(table) = keys.table("table") else {
        if !keys.has("table") {
            keys.missing("table", "[table]");
        }
        return None;
    };
    let position = table.vector("position", Measure::LENGTH);
    if position.is_none() && !table.has("position") {
        table.missing("position", "position = \"0, 0, 8 cm\"");
    }
    if !table.has("spin_axis") {
        table.missing("spin_axis", "spin_axis = [0, 0, 1]");
    }
    let [axis, reference] = ["spin_axis", "reference"].map(|key| {
        let vector = table.node(key).and_then(|_| table.numbers::<3>(key)).map(Vector3::from);
        // Reports one without a direction.
        vector.filter(|_| direction(&table, key).is_some())
    });
    let words = [("on_table", false), ("on_wheel", true)];
    let on_wheel = table.choice("reads", &words).unwrap_or(false);
    table.finish();
    let (position, axis) = (position?, axis?);
    // Across the axis: the table's x, or y where the wheel spins about x.
    let across = if axis.x.abs() > 0.9 * axis.norm() { Vector3::y() } else { Vector3::x() };
    let placement = TablePose::new(position, axis, reference.unwrap_or(across), on_wheel);
    match placement {
        Ok(placement) => Some(placement),
        Err(error) => {
            table.error("spin_axis", error.to_string(), "");
            None
        }
    }
}

/// `[columns]`: names and units.
fn layout(keys: &Keys<'_>) -> Option<Layout> {
    let rate = keys.quantity("rate", Measure::FREQUENCY);
    // With the rate every column has a usual name.
    let empty = keys.empty();
    let table =
        if keys.has("rate") { keys.table_or("columns", &empty) } else { keys.table("columns") };
    let Some(table) = table else {
        if !keys.has("columns") {
            keys.missing("columns", "[columns]");
        }
        return None;
    };
    let unit = |key: &str, measure: Measure| -> Option<f64> {
        let Some(text) = table.text(key) else { return Some(1.0) };
        match parse_unit(text) {
            Ok((size, dimension)) if dimension == measure.dimension => Some(size),
            _ => {
                let Measure { name, usual, .. } = measure;
                table.error(
                    key,
                    format!("`{text}` is no unit of {name}"),
                    &format!("{usual} is one"),
                );
                None
            }
        }
    };
    let sizes = [unit("force_unit", Measure::FORCE), unit("torque_unit", Measure::TORQUE)];
    let speed_size = unit("speed_unit", Measure::ANGULAR_RATE);
    let time_size = unit("time_unit", Measure::TIME);
    let three = |key: &str, or: [&str; 3]| -> Option<[String; 3]> {
        let names = match table.texts(key) {
            Some(names) => names.into_iter().map(str::to_owned).collect::<Vec<_>>(),
            None => or.map(str::to_owned).to_vec(),
        };
        let found = <[String; 3]>::try_from(names).ok();
        if found.is_none() {
            table.error(key, format!("`columns.{key}` is not three names"), "name x, y and z");
        }
        found
    };
    let force = three("force", ["fx", "fy", "fz"]);
    let torque = three("torque", ["tx", "ty", "tz"]);
    let time = table.text("time").map(str::to_owned);
    let speed = table.text("speed").map(str::to_owned);
    let index = table.text("index").map(str::to_owned);
    if time.is_none() && rate.is_none() && !table.has("time") && !keys.has("rate") {
        table.missing("time", "time = \"time_s\"");
        return None;
    }
    table.finish();
    let ([fx, fy, fz], [tx, ty, tz]) = (force?, torque?);
    let channels: [String; CHANNELS] = [fx, fy, fz, tx, ty, tz];
    Some(Layout {
        time: time.map(|time| Some((time, time_size?))).unwrap_or_default(),
        rate,
        channels,
        sizes: [sizes[0]?, sizes[1]?],
        speed: speed.map(|speed| Some((speed, speed_size?))).unwrap_or_default(),
        index,
    })
}

/// `[[harmonic]]`, `[[mode]]`, `interference`, `speed_accuracy`, `highest_harmonic`.
fn options(keys: &Keys<'_>) -> Option<Options> {
    let defaults = Options::default();
    let mut harmonics = Vec::new();
    for table in keys.tables("harmonic") {
        harmonics.push(table.required("number", Measure::NUMBER));
        table.finish();
    }
    let groups = [
        ("axial_force", Group::AxialForce),
        ("radial_force", Group::RadialForce),
        ("axial_torque", Group::AxialTorque),
        ("radial_torque", Group::RadialTorque),
    ];
    let tables = keys.tables("mode");
    let mut modes = Vec::new();
    for table in &tables {
        if !table.has("of") {
            table.missing("of", "of = \"radial_torque\"");
        }
        let group = table.choice("of", &groups);
        let hertz = table.required("frequency", Measure::FREQUENCY);
        let damping = table.number("damping").unwrap_or(DAMPING);
        let ratio = table.number("inertia_ratio");
        let share = table.number("share").unwrap_or(1.0);
        let fit_ratio = table.boolean("fit_inertia_ratio");
        let fit_share = table.boolean("fit_share").unwrap_or(false);
        table.finish();
        let good = |value: f64, range: [f64; 2]| (range[0]..=range[1]).contains(&value);
        if !good(damping, [1e-5, 0.7]) || !hertz.is_none_or(|f| good(f, [1e-6, 1e6])) {
            let message = "a mode has a frequency above 0 and a damping ratio from 1e-5 to 0.7";
            table.error("damping", message, "correct it");
        }
        let tilts = group == Some(Group::RadialTorque);
        modes.push(group.zip(hertz).map(|(group, hertz)| ModeGuess {
            group,
            mode: Mode {
                frequency: std::f64::consts::TAU * hertz,
                damping,
                inertia_ratio: ratio.unwrap_or(if tilts { 1.0 } else { 0.0 }),
                share,
            },
            fit_ratio: fit_ratio.unwrap_or(tilts),
            fit_share,
        }));
    }
    let find = keys.boolean("find_modes").unwrap_or(tables.is_empty());
    let interference = match keys.node("interference") {
        Some(node) => keys.values_of(node, "interference", Measure::FREQUENCY),
        None => Some(Vec::new()),
    };
    let speed_accuracy = keys.number("speed_accuracy").unwrap_or(defaults.speed_accuracy);
    if !(0.0..=0.1).contains(&speed_accuracy) {
        let help = "it is a share: 0.001 for a tenth of a percent";
        keys.error("speed_accuracy", format!("{speed_accuracy} is not within 0 to 0.1"), help);
    }
    let highest = keys.number("highest_harmonic").unwrap_or(defaults.highest);
    let compared = keys.boolean("compare_with_imbalance");
    let modes = modes.into_iter().collect::<Option<Vec<_>>>()?;
    Some(Options {
        harmonics: harmonics.into_iter().collect::<Option<Vec<_>>>()?,
        highest,
        modes: (!find).then_some(modes),
        interference: interference?,
        speed_accuracy,
        compare_with_imbalance: compared.unwrap_or(defaults.compare_with_imbalance),
    })
}

fn samples(keys: &Keys<'_>, path: &Path, layout: &Layout) -> Option<Samples> {
    match read_samples(path, layout) {
        Ok(samples) => Some(samples),
        Err(error) => {
            keys.error("file", error.to_string(), "");
            None
        }
    }
}

/// One `[[record]]`.
fn one(
    keys: &Keys<'_>,
    folder: &Path,
    layout: &Layout,
    placement: &TablePose,
    progress: &mut dyn FnMut(&str),
) -> Option<Record> {
    if !keys.has("file") {
        keys.missing("file", "file = \"step-01.csv\"");
    }
    let name = keys.text("file");
    let stated = keys.quantity("speed", Measure::ANGULAR_RATE);
    let pulses = match keys.node("pulses") {
        Some(node) => keys.values_of(node, "pulses", Measure::TIME),
        None => Some(Vec::new()),
    };
    if !keys.has("speed") && layout.speed.is_none() {
        keys.missing("speed", "speed = \"600 rpm\"");
    }
    keys.finish();
    let name = name?;
    progress(name);
    let samples = samples(keys, &folder.join(name), layout)?;
    let [speed, drift] = match stated {
        Some(speed) => [speed, 0.0],
        None if samples.speed.is_empty() => return None,
        None => mean_and_slope(&samples.speed, samples.rate),
    };
    let pulses = pulses?;
    Some(Record {
        name: name.to_owned(),
        rate: samples.rate,
        speed,
        drift,
        pulses: if pulses.is_empty() { samples.pulses } else { pulses },
        channels: placement.referred_samples(&samples.channels),
    })
}

/// The steps of one file.
fn swept(
    keys: &Keys<'_>,
    path: &Path,
    layout: &Layout,
    placement: &TablePose,
    [tolerance, shortest]: [f64; 2],
) -> Option<Vec<Option<Record>>> {
    if layout.speed.is_none() {
        keys.error("file", "a sweep needs the column of its speed", "add `columns.speed`");
        return None;
    }
    let samples = samples(keys, path, layout)?;
    match steps(&samples, tolerance, shortest) {
        Ok(mut records) => {
            for record in &mut records {
                record.channels = placement.referred_samples(&record.channels);
            }
            Some(records.into_iter().map(Some).collect())
        }
        Err(error) => {
            keys.error("file", error.to_string(), "");
            None
        }
    }
}
