//! Files of unknowns: TOML that says what is to be found in telemetry, what is known of it, and what the columns are
//! (docs/identify.md). Keys and units as in scenario files; every error at once.

use std::path::Path;

use super::diagnostic::Diagnostics;
use super::document::Value;
use super::keys::Keys;
use super::read_file::read_file;
use crate::identify::{JointNoise, Unknown, UnknownPrior, Unknowns};
use crate::names::column_name_fault;
use crate::scenario::Scenario;
use crate::telemetry::{Sensor, TelemetryLayout};
use crate::units::{Measure, parse_unit};

/// The number of the format that this program reads.
const FORMAT: u32 = 1;

/// What is to be found, and where it is read from.
#[derive(Clone, Debug)]
pub struct IdentificationFile {
    /// In names of files.
    pub name: String,
    /// The heading.
    pub title: String,
    /// What is unknown.
    pub unknowns: Unknowns,
    /// The columns of the telemetry.
    pub layout: TelemetryLayout,
    /// Of each device the layout that it was named by; none of one by its own name.
    pub layouts: Vec<Option<String>>,
}

/// Reads a file of unknowns of a scenario.
///
/// # Errors
/// Everything that is wrong, with its places.
pub fn identification_from_toml(
    path: &Path,
    scenario: &Scenario,
) -> Result<IdentificationFile, Diagnostics> {
    read_file(path, "file of unknowns", ("", &[]), |keys| read(keys, scenario))
}

fn read(keys: &Keys<'_>, scenario: &Scenario) -> Option<IdentificationFile> {
    if !keys.has("format") {
        keys.missing("format", "format = 1");
    }
    keys.count("format", FORMAT, FORMAT);
    let name = keys.text("name").unwrap_or(&scenario.name).to_owned();
    if let Some(fault) = column_name_fault(&name).filter(|_| keys.has("name")) {
        keys.error("name", format!("`name` is of files: {fault}"), "use a-z, 0-9, _");
    }
    let title = keys.text("title").unwrap_or(&scenario.title).to_owned();
    let controller = keys.text("controller").map(str::to_owned);
    let layout = match TelemetryLayout::of_scenario(scenario, controller.as_deref()) {
        Ok(layout) => Some(layout),
        Err(error) => {
            keys.error("controller", error.to_string(), "");
            None
        }
    };
    let mut layouts = vec![None; scenario.names.len()];
    let mut unknowns = Vec::new();
    if let Some(table) = keys.table("unknown") {
        of_hub(&table, &mut unknowns);
        for device in table.tables("device") {
            of_device(&device, scenario, &mut unknowns, &mut layouts);
        }
        table.finish();
    } else if !keys.has("unknown") {
        keys.missing("unknown", "[unknown]");
    }
    let empty = keys.empty();
    let layout = layout.and_then(|layout| {
        let table = keys.table_or("telemetry", &empty)?;
        columns(&table, layout)
    });
    let mut noise = JointNoise::default();
    if let Some(table) = keys.table("noise") {
        noise.tachometer = table.quantity("tachometer", Measure::ANGULAR_RATE).unwrap_or(0.0);
        noise.encoder = table.quantity("encoder", Measure::ANGLE).unwrap_or(0.0);
        for (key, value) in [("tachometer", noise.tachometer), ("encoder", noise.encoder)] {
            if value < 0.0 {
                table.error(key, "a standard deviation is not negative", "correct it");
            }
        }
        table.finish();
    }
    keys.finish();
    let unknowns = Unknowns { controller, unknowns, noise, is_near: false };
    Some(IdentificationFile { name, title, unknowns, layout: layout?, layouts })
}

/// `true`: nothing is known; a quantity: a standard deviation; `false` or missing: it is no unknown.
fn deviation(keys: &Keys<'_>, key: &str, measure: Measure) -> Option<Vec<f64>> {
    let node = keys.node(key)?;
    if let Value::Boolean(unknown) = node.value {
        return unknown.then(Vec::new);
    }
    let value = keys.quantity(key, measure)?;
    positive(keys, key, value).map(|value| vec![value])
}

fn positive(keys: &Keys<'_>, key: &str, value: f64) -> Option<f64> {
    if value > 0.0 {
        return Some(value);
    }
    let help = "write `true` where nothing is known, or remove it where it is known";
    keys.error(key, format!("the standard deviation `{key}` is not above zero"), help);
    None
}

fn of_hub(keys: &Keys<'_>, unknowns: &mut Vec<UnknownPrior>) {
    for (key, unknown, measure) in [
        ("hub_inertia", Unknown::HubInertia, Measure::INERTIA),
        ("hub_moments", Unknown::HubMoments, Measure::INERTIA),
        ("hub_centre", Unknown::HubCentre, Measure::LENGTH),
        ("gyro_bias", Unknown::GyroBias, Measure::ANGULAR_RATE),
    ] {
        if let Some(deviations) = deviation(keys, key, measure) {
            unknowns.push(UnknownPrior { unknown, deviations });
        }
    }
}

/// The devices of a name: one, or those of a layout, `NAME1`, `NAME2` and so on.
fn devices(scenario: &Scenario, name: &str) -> Vec<(usize, bool)> {
    let own = scenario.names.iter().position(|of| of == name);
    if let Some(own) = own {
        return vec![(own, false)];
    }
    let member = |of: &String| {
        let number = of.strip_prefix(name);
        number
            .is_some_and(|number| !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit()))
    };
    let all = scenario.names.iter().enumerate();
    all.filter(|(_, of)| member(of)).map(|(index, _)| (index, true)).collect()
}

fn of_device(
    keys: &Keys<'_>,
    scenario: &Scenario,
    unknowns: &mut Vec<UnknownPrior>,
    layouts: &mut [Option<String>],
) {
    if !keys.has("name") {
        keys.missing("name", "name = \"rw\"");
    }
    let name = keys.text("name").unwrap_or_default();
    let found = devices(scenario, name);
    if found.is_empty() && keys.has("name") {
        let nearest = crate::nearest::nearest(name, scenario.names.iter());
        let help = format!("there is {}", nearest.join(", "));
        keys.error("name", format!("no device is named `{name}`"), &help);
    }
    let imbalance = imbalance(keys);
    let friction = [
        (deviation(keys, "viscous", Measure::ANGULAR_DAMPING), Unknown::Viscous as fn(usize) -> _),
        (deviation(keys, "coulomb", Measure::TORQUE), Unknown::Coulomb),
    ];
    let mount = deviation(keys, "mount", Measure::ANGLE);
    keys.finish();
    for (device, of_layout) in found {
        if of_layout && let Some(layout) = layouts.get_mut(device) {
            *layout = Some(name.to_owned());
        }
        if let Some(deviations) = &imbalance {
            let (unknown, deviations) = (Unknown::Imbalance(device), deviations.clone());
            unknowns.push(UnknownPrior { unknown, deviations });
        }
        let joints = scenario.joints().enumerate().filter(|(_, (of, ..))| *of == device);
        // The wheel is at the tip.
        if let Some((joint, _)) = joints.last() {
            for (deviations, unknown) in &friction {
                if let Some(deviations) = deviations.clone() {
                    unknowns.push(UnknownPrior { unknown: unknown(joint), deviations });
                }
            }
        }
        if let Some(deviations) = mount.clone() {
            unknowns.push(UnknownPrior { unknown: Unknown::Mount(device), deviations });
        }
    }
}

/// `true`, or `{ static, dynamic }`, standard deviations about zero of each of two components.
fn imbalance(keys: &Keys<'_>) -> Option<Vec<f64>> {
    let node = keys.node("imbalance")?;
    if let Value::Boolean(unknown) = node.value {
        return unknown.then(Vec::new);
    }
    let table = keys.table("imbalance")?;
    let stated = table.required("static", Measure::STATIC_IMBALANCE);
    let dynamic = table.required("dynamic", Measure::DYNAMIC_IMBALANCE);
    table.finish();
    Some(vec![positive(&table, "static", stated?)?, positive(&table, "dynamic", dynamic?)?])
}

/// `[telemetry]`: names and units of the columns.
fn columns(keys: &Keys<'_>, mut layout: TelemetryLayout) -> Option<TelemetryLayout> {
    let unit = |key: &str, measure: Measure| -> Option<f64> {
        let Some(text) = keys.text(key) else { return Some(1.0) };
        match parse_unit(text) {
            Ok((size, dimension)) if dimension == measure.dimension => Some(size),
            _ => {
                let Measure { name, usual, .. } = measure;
                let message = format!("`{text}` is no unit of {name}");
                keys.error(key, message, &format!("{usual} is one"));
                None
            }
        }
    };
    let time_size = unit("time_unit", Measure::TIME);
    let gyro_size = unit("gyro_unit", Measure::ANGULAR_RATE);
    let rate_size = unit("rate_unit", Measure::ANGULAR_RATE);
    let angle_size = unit("angle_unit", Measure::ANGLE);
    let torque_size = unit("torque_unit", Measure::TORQUE);
    let range = keys.quantity("gyro_range", Measure::ANGULAR_RATE);
    let range = range.and_then(|range| positive(keys, "gyro_range", range));
    if let Some(time) = keys.text("time") {
        time.clone_into(&mut layout.time);
    }
    let [gyro, star] = ["gyro", "star_tracker"].map(|key| keys.text(key).map(str::to_owned));
    keys.finish();
    layout.time_size = time_size?;
    let sizes = [gyro_size?, rate_size?, angle_size?, torque_size?];
    for of in &mut layout.sensors {
        match of.sensor {
            Sensor::Gyro => {
                of.size = sizes[0];
                of.range = range;
                if let Some(base) = &gyro {
                    of.columns = ["x", "y", "z"].map(|axis| format!("{base}_{axis}")).to_vec();
                }
            }
            Sensor::StarTracker => {
                if let Some(base) = &star {
                    of.columns = (0..4).map(|k| format!("{base}{k}")).collect();
                }
            }
            Sensor::Tachometer(_) => of.size = sizes[1],
            Sensor::Encoder(_) => of.size = sizes[2],
            Sensor::Motor(_) => of.size = sizes[3],
        }
    }
    Some(layout)
}
