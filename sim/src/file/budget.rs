//! Jitter budgets: TOML that names a scenario, the speeds to sweep, lines of sight and limits. Keys and units as in
//! scenario files; every error at once.

mod names;

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use nalgebra::{Matrix2x3, Unit, Vector3};

use super::diagnostic::Diagnostics;
use super::keys::Keys;
use super::load::{Override, Overrides};
use super::read::values::mount::direction;
use super::read_file::{folder_of, read_file};
use crate::jitter::budget::{Budget, Sight};
use crate::jitter::sweep::{Phases, SPEEDS_MAX};
use crate::names::numbered;
use crate::nearest::did_you_mean_file;
use crate::pointing::{Limit, LineOfSight, Metric, Sensitivity};
use crate::structure::dynamic_mass::Motor;
use crate::units::{Measure, Plain};

pub use names::check_budget_names;

/// What an override of a budget begins with; those of its scenario have none.
const PREFIX: &str = "budget.";
/// The number of the format that this program reads.
const FORMAT: u32 = 1;
/// Speeds without the key.
const COUNT: usize = 541;

/// Keys of a budget that no scenario has.
const BUDGET_KEYS: [&str; 5] = ["phases", "motor", "gimbals", "speed", "line_of_sight"];

/// Keys of a scenario that no budget has, and no plan.
pub(super) const SCENARIO_KEYS: [&str; 4] = ["hub", "device", "run", "structure"];

/// Overrides `KEY = VALUE` of a budget, whose keys have the prefix `budget.`, here taken off, and those of its scenario.
///
/// # Errors
/// A key of budgets without the prefix.
pub fn budget_overrides(set: &[Override]) -> Result<[Overrides; 2], String> {
    let [mut of_budget, mut of_scenario] = [Vec::new(), Vec::new()];
    for text in set {
        if let Some(text) = text.trim_start().strip_prefix(PREFIX) {
            of_budget.push(text.to_owned());
            continue;
        }
        let key = text.split(['.', '=']).next().unwrap_or_default().trim();
        // A scenario has requirements, too; a budget has no use for them.
        if key == "requirement" || BUDGET_KEYS.contains(&key) {
            let text = text.trim_start();
            return Err(format!("{text}: `{key}` is of the budget; write {PREFIX}{text}"));
        }
        of_scenario.push(text.clone());
    }
    Ok([of_budget, of_scenario])
}

/// Reads a budget, and overrides after it; the path of its scenario is as from the same place.
///
/// # Errors
/// Everything that is wrong, with its places.
pub fn budget_from_toml(
    path: &Path,
    overrides: &[Override],
) -> Result<(Budget, PathBuf), Diagnostics> {
    read_file(path, "budget", (PREFIX, overrides), |keys| budget(keys, folder_of(path)))
}

fn budget(keys: &Keys<'_>, folder: &Path) -> Option<(Budget, PathBuf)> {
    if let Some(key) = SCENARIO_KEYS.into_iter().find(|key| keys.has(key)) {
        let message = format!("`{key}` is of a scenario; this is read as a budget");
        let help = "run a scenario by `precess run`; a budget names it: `scenario = \"bus.toml\"`";
        keys.error(key, message, help);
        return None;
    }
    if !keys.has("format") {
        keys.missing("format", "format = 1");
    }
    keys.count("format", FORMAT, FORMAT);
    let title = keys.text("title").unwrap_or("Jitter budget").to_owned();
    let scenario = keys.file("scenario", folder);
    if !keys.has("scenario") {
        keys.missing("scenario", "scenario = \"bus.toml\"");
    }
    if let Some((path, shown)) = scenario.as_ref().filter(|(path, _)| !path.is_file()) {
        let help = did_you_mean_file(shown, path, "a path is from the folder of the budget");
        keys.error("scenario", format!("there is no scenario {}", path.display()), &help);
    }
    let phases = [("unknown", Phases::Unknown), ("given", Phases::Given), ("worst", Phases::Worst)];
    let phases = keys.choice("phases", &phases).unwrap_or_default();
    let motors = [("torque", Motor::ConstantTorque), ("rate", Motor::ConstantRate)];
    let motor = keys.choice("motor", &motors).unwrap_or_default();
    let sprung = keys.choice("gimbals", &[("sprung", true), ("locked", false)]).unwrap_or(true);
    let speed = keys.table("speed");
    if speed.is_none() {
        keys.missing("speed", "[speed]` with `from = \"600 rpm\"` and `to = \"6000 rpm\"");
    }
    let speed = speed.and_then(|speed| speeds(&speed));
    let before = keys.errors();
    let sights: Vec<Sight> = keys.tables("line_of_sight").iter().filter_map(sight).collect();
    // What a requirement names can be sought only among lines of sight that were read.
    let all_read = keys.errors() == before && keys.has("line_of_sight");
    let known = all_read.then_some(&sights[..]);
    if !keys.has("line_of_sight") {
        keys.missing("line_of_sight", "[[line_of_sight]]` with `node = \"camera\"");
    }
    let requirements = keys.tables("requirement");
    let written = requirements.iter().filter_map(|requirement| requirement.text("name"));
    let mut taken = written.map(str::to_owned).collect();
    let limits: Vec<_> = requirements.iter().filter_map(|r| limit(r, known, &mut taken)).collect();
    keys.finish();
    let (speeds, count, swept) = speed?;
    // Of written names this has been reported; one that is named by its node may have that of another.
    for (index, sight) in sights.iter().enumerate().filter(|_| all_read) {
        if sights.iter().take(index).any(|other| other.name == sight.name) {
            let message = format!("two lines of sight are named `{}`", sight.name);
            keys.error("line_of_sight", message, "rename one");
        }
    }
    let budget = Budget { title, speeds, count, swept, phases, motor, sprung, sights, limits };
    Some((budget, scenario?.0))
}

/// Range, count and rotors.
fn speeds(keys: &Keys<'_>) -> Option<([f64; 2], usize, Vec<String>)> {
    let [from, to] = ["from", "to"].map(|key| keys.required(key, Measure::ANGULAR_RATE));
    let most = u32::try_from(SPEEDS_MAX).unwrap_or(u32::MAX);
    let count = keys.count("count", 2, most).and_then(|count| usize::try_from(count).ok());
    let rotors = keys.texts("rotors").unwrap_or_default();
    keys.finish();
    let range = [from?, to?];
    let written = |key: &str, value: f64| match keys.text_or_list(key) {
        Some(text) => text.to_owned(),
        None => format!("{} rad/s", Plain(value)),
    };
    if range[0] <= 0.0 {
        let message =
            format!("`speed.from` is {}; a wheel at rest has no tones", written("from", range[0]));
        keys.error("from", message, "write a speed above zero, for example `from = \"600 rpm\"`");
        return None;
    }
    if range[0] >= range[1] {
        let [from, to] = [written("from", range[0]), written("to", range[1])];
        let message = format!("`speed.from` is {from}, which is not below `speed.to`, {to}");
        keys.error("from", message, "`from` is the lowest speed, `to` the highest");
        return None;
    }
    Some((range, count.unwrap_or(COUNT), rotors.into_iter().map(str::to_owned).collect()))
}

/// A rigid instrument by its boresight, or sensitivities node by node.
fn sight(keys: &Keys<'_>) -> Option<Sight> {
    let node = keys.text("node");
    let name = keys.text("name").or(node);
    let parts: Vec<_> = keys.tables("sensitivity").iter().filter_map(sensitivity).collect();
    let axes = ["boresight", "across"].map(|key| direction(keys, key));
    let listed = keys.has("sensitivity");
    let unknown = keys.finish();
    if listed == node.is_some() {
        // One of them may be misspelt.
        if unknown && !listed {
            return None;
        }
        let help = "write `node` with its `boresight`, or `[[line_of_sight.sensitivity]]`";
        keys.error("node", "a line of sight is of one rigid instrument, or of sensitivities", help);
        return None;
    }
    let line = match node {
        None => LineOfSight::new(parts),
        Some(node) => {
            let boresight = axes[0].map_or_else(Vector3::z, Unit::into_inner);
            let usual = if boresight.x.abs() > 0.9 * boresight.norm() {
                Vector3::y()
            } else {
                Vector3::x()
            };
            LineOfSight::rigid(node, &boresight, &axes[1].map_or(usual, Unit::into_inner))
        }
    };
    match line {
        Ok(line) => Some(Sight { name: name.unwrap_or("line of sight").to_owned(), line }),
        Err(error) => {
            keys.error("boresight", error.to_string(), "");
            None
        }
    }
}

/// `node`, and of each axis x and y three numbers by displacement, rad/m, and by rotation, rad/rad.
fn sensitivity(keys: &Keys<'_>) -> Option<Sensitivity> {
    let node = keys.text("node");
    if !keys.has("node") {
        keys.missing("node", "node = \"mirror\"");
    }
    let row = |key: &str| Vector3::from(keys.numbers::<3>(key).unwrap_or_default()).transpose();
    let matrix = |x: &str, y: &str| Matrix2x3::from_rows(&[row(x), row(y)]);
    let displacement = matrix("x_by_displacement", "y_by_displacement");
    let rotation = matrix("x_by_rotation", "y_by_rotation");
    keys.finish();
    Some(Sensitivity { node: node?.to_owned(), displacement, rotation })
}

/// A requirement; the line of sight that it names is sought among those that are known, if all were read. One without a
/// name has that of its metric, with a number where that is taken.
fn limit(
    keys: &Keys<'_>,
    sights: Option<&[Sight]>,
    taken: &mut HashSet<String>,
) -> Option<(usize, Limit)> {
    let named = keys.text("line_of_sight");
    let metrics = [("rms", 0), ("band_rms", 1), ("displacement", 2), ("smear", 3), ("jitter", 4)];
    let metric = if keys.has("metric") { keys.choice("metric", &metrics) } else { Some(0) };
    let (exposed, banded) = (metric >= Some(2), metric == Some(1));
    let exposure = if exposed { keys.required("exposure", Measure::TIME) } else { Some(0.0) };
    let band =
        if banded { keys.quantities::<2>("band", Measure::FREQUENCY) } else { Some([0.0; 2]) };
    if banded && !keys.has("band") {
        keys.missing("band", "band = \"1, 200 Hz\"");
    }
    let useless =
        [(keys.has("exposure") && !exposed, "exposure"), (keys.has("band") && !banded, "band")];
    let written = keys.any_quantity("limit");
    if !keys.has("limit") {
        keys.missing("limit", "limit = \"1 urad\"");
    }
    let name = keys.text("name");
    let unknown = keys.finish();
    // What belongs to a metric can be said only of one that is known and not misspelt.
    let sure = metric.is_some() && !unknown;
    for (_, key) in useless.into_iter().filter(|(useless, _)| *useless && sure) {
        let message = format!("`{key}` has no use in the metric of this requirement");
        let of =
            "`exposure` is of displacement, smear and jitter, `band` of band_rms; rms has neither";
        keys.error(key, message, of);
    }
    let (metric, written) = (metric?, written?);
    let [limit] = written.values[..] else {
        keys.error("limit", "`limit` is one number with its unit", "write `limit = \"1 urad\"`");
        return None;
    };
    if !written.is(Measure::ANGLE) || limit <= 0.0 {
        keys.error(
            "limit",
            "the limit of a line of sight is an angle above zero",
            "write `limit = \"1 urad\"`",
        );
        return None;
    }
    let (exposure, band) = (exposure?, band?);
    if exposed && exposure <= 0.0 {
        keys.error("exposure", "`exposure` is not above zero", "");
        return None;
    }
    if metric == 1 && !(0.0 <= band[0] && band[0] < band[1]) {
        keys.error("band", "a band rises from zero or above", "write `band = \"1, 200 Hz\"`");
        return None;
    }
    let sights = sights?;
    let sight = match named {
        None if sights.len() == 1 => Some(0),
        // The key may be the one that is misspelt.
        None if unknown => return None,
        None => None,
        Some(named) => sights.iter().position(|sight| sight.name == named),
    };
    let Some(sight) = sight else {
        let names: Vec<_> = sights.iter().map(|sight| format!("`{}`", sight.name)).collect();
        let message = "`line_of_sight` names no line of sight";
        keys.error("line_of_sight", message, &format!("write one of {}", names.join(", ")));
        return None;
    };
    let unit = (written.unit.clone(), size(&written.unit));
    let (metric, word) = match metric {
        0 => (Metric::Rms, "RMS"),
        1 => (Metric::BandRms(band), "RMS in a band"),
        2 => (Metric::Displacement(exposure), "displacement"),
        3 => (Metric::Smear(exposure), "smear"),
        _ => (Metric::Jitter(exposure), "jitter"),
    };
    let name = name.map_or_else(|| numbered(word, taken), str::to_owned);
    Some((sight, Limit { name, metric, limit, unit }))
}

/// The size of a unit in SI.
fn size(unit: &str) -> f64 {
    let one = crate::units::parse_quantity(&format!("1 {unit}"));
    one.ok().and_then(|one| one.values.first().copied()).unwrap_or(1.0)
}
