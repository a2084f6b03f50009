//! The tree of a scenario file into a [`Scenario`].

mod changes_and_wrenches;
mod check;
mod complete;
mod controllers;
pub(super) mod devices;
mod filled;
mod hub;
mod output;
mod override_errors;
mod settings;
mod sources;
mod structure;
pub(super) mod values;

use std::cell::RefCell;
use std::path::Path;

use super::diagnostic::{Diagnostics, Numbers};
use super::document::{Node, Value};
use super::keys::{Keys, Reports};
use super::load::{Override, load_file, load_text};
use super::overrides::apply;
use complete::{Completion, complete};
pub(crate) use devices::device_bodies::{has_inertia, has_mass, has_origin};
pub use filled::from_filled;

use crate::names::NAME_MAX;
use crate::scenario::{Scenario, Source};

/// Keys of a jitter budget, which no scenario has.
const BUDGET_KEYS: [&str; 2] = ["line_of_sight", "speed"];

/// The number of the format that this program reads.
pub const FORMAT: u32 = 1;

/// A scenario and its warnings, or every error.
pub type Read = Result<(Scenario, Diagnostics), Diagnostics>;

/// Reads a scenario file with the files it is based on, and overrides after it.
///
/// # Errors
/// Everything that is wrong, with its places.
pub fn from_file(path: &Path, overrides: &[Override]) -> Read {
    file(path, (overrides, Numbers::WithUnits))
}

fn file(path: &Path, overrides: (&[Override], Numbers)) -> Read {
    let mut reports = Diagnostics::default();
    let node = load_file(path, &mut reports);
    let stem =
        path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let folder = path.parent().unwrap_or_else(|| Path::new("")).to_owned();
    let path = path.display().to_string();
    with_overrides(&node, (path.as_str(), stem.as_str(), folder.as_path()), overrides, &reports)
}

/// Reads a tree after overrides; errors that these cause name them.
fn with_overrides(
    node: &Node,
    place: (&str, &str, &Path),
    overrides: (&[Override], Numbers),
    reports: &Diagnostics,
) -> Read {
    let read = |overrides: (&[Override], Numbers)| {
        scenario(node.clone(), place, overrides, reports.clone())
    };
    read(overrides).map_err(|errors| override_errors::name_overrides(errors, overrides, read))
}

/// Reads the text of a scenario; files that it names are beside `folder`.
///
/// # Errors
/// Everything that is wrong, with its places.
pub fn from_toml(name: &str, text: &str, folder: &Path) -> Read {
    self::text(name, (text, Numbers::WithUnits), folder, &[])
}

fn text(name: &str, text: (&str, Numbers), folder: &Path, overrides: &[Override]) -> Read {
    let mut reports = Diagnostics::default();
    let node = load_text(name, text, folder, &mut reports);
    let stem: String = name.chars().take(NAME_MAX).collect();
    with_overrides(&node, (name, stem.as_str(), folder), (overrides, Numbers::Si), &reports)
}

/// The tables of a scenario, for [`from_program`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tables<'a> {
    /// Those of a file.
    File(&'a Path),
    /// Those of a text.
    Text {
        /// How it is named in messages; the scenario's name where the text states none.
        name: &'a str,
        /// TOML.
        text: &'a str,
        /// What a number without a unit is in the text.
        numbers: Numbers,
        /// Where files are sought that it names.
        folder: &'a Path,
    },
}

/// Reads a scenario that a program describes. A number without a unit is in SI units and radians in
/// its overrides, and in its text where it says so.
///
/// # Errors
/// Everything that is wrong, with its places.
pub fn from_program(tables: Tables<'_>, overrides: &[Override]) -> Read {
    match tables {
        Tables::File(path) => file(path, (overrides, Numbers::Si)),
        Tables::Text { name, text, numbers, folder } => {
            self::text(name, (text, numbers), folder, overrides)
        }
    }
}

pub(super) fn scenario(
    node: Node,
    place: (&str, &str, &Path),
    overrides: (&[Override], Numbers),
    reports: Diagnostics,
) -> Read {
    with_completion(node, place, overrides, reports, complete)
}

fn with_completion(
    mut node: Node,
    (path, stem, folder): (&str, &str, &Path),
    overrides: (&[Override], Numbers),
    mut reports: Diagnostics,
    complete: Completion,
) -> Read {
    // Of what is not TOML only that is reported: its keys would be guesses.
    if reports.has_errors() {
        return Err(reports);
    }
    apply(&mut node, overrides, &mut reports);
    let cell = RefCell::new(reports);
    let scenario = read(&node, path, stem, folder, &cell);
    if let Some(scenario) = scenario.as_ref().filter(|_| !cell.borrow().has_errors()) {
        output::columns::check(&node, scenario, &cell);
    }
    let mut reports = cell.into_inner();
    match scenario {
        Some(mut scenario) if !reports.has_errors() => {
            check::check(&node, &scenario, &mut reports);
            if reports.has_errors() {
                return Err(reports);
            }
            let cell = RefCell::new(reports);
            complete(&node, &mut scenario, &cell);
            let reports = cell.into_inner();
            if reports.has_errors() {
                return Err(reports);
            }
            scenario.source.filled = super::write::to_toml(&scenario);
            Ok((scenario, reports))
        }
        _ => {
            if !reports.has_errors() {
                reports.error_anywhere(format!("{path} is no scenario"), "");
            }
            Err(reports)
        }
    }
}

fn read(node: &Node, path: &str, stem: &str, folder: &Path, reports: &Reports) -> Option<Scenario> {
    let keys = Keys::new(node, "", reports)?;
    if let Value::Table(table) = &node.value
        && let Some(key) = BUDGET_KEYS.into_iter().find(|key| table.get(key).is_some())
    {
        let message = format!("`{key}` is of a jitter budget; this is read as a scenario");
        keys.error(key, message, "run a budget by `precess jitter`");
        return None;
    }
    match keys.count("format", FORMAT, FORMAT) {
        None if !keys.has("format") => keys.missing("format", "format = 1"),
        _ => {}
    }
    let name = name(&keys, stem);
    let title = keys.text("title").unwrap_or(&name).to_owned();
    let description = keys.text("description").unwrap_or_default().to_owned();
    let structure = structure::structure(&keys, folder);
    let structure_file = structure::file(&keys, folder);
    let hub = hub::hub(&keys, structure.as_ref());
    let devices = devices::device::devices(&keys, folder, structure.as_ref());
    let devices = devices::platform::with_platforms(&keys, devices, folder, structure.as_ref());
    let joints = devices::joints::Joints::of_devices(&devices);
    let settings = settings::settings(&keys);
    let (initial, reference) = devices::initial::initial(&keys, &devices);
    let gravity = settings::gravity(&keys);
    let changes = changes_and_wrenches::changes(&keys, &joints, settings.as_ref(), folder);
    let wrenches = changes_and_wrenches::wrenches(&keys, &joints, structure.as_ref(), folder);
    let points = changes_and_wrenches::points(&keys, &joints, structure.as_ref());
    let known = sources::SourceContext {
        devices: &devices,
        joints: &joints,
        structure: structure.as_ref(),
        settings: settings.as_ref(),
        folder,
    };
    let disturbances = sources::sources(&keys, &known);
    let controllers = controllers::controllers(
        &keys,
        (&devices, structure.as_ref()),
        (reference, &initial),
        folder,
    );
    let crossings = output::crossings(&keys);
    let output = output::output(&keys, settings.as_ref());
    let (requirements, margin_requirements) =
        output::requirement::requirements(&keys, settings.as_ref(), &controllers);
    keys.finish();
    let (hub, hub_size, hub_mode) = hub?;
    let (drives, stops, friction) = joints.acting();
    let on_node: Vec<_> = devices.iter().filter_map(|device| device.node).collect();
    let structure = structure.map(|structure| structure.modal(&keys, on_node));
    let text = reports.borrow().sources.iter().fold(String::new(), |text, source| {
        text + &format!("# {}\n{}\n", source.name, source.text.trim_end())
    });
    Some(Scenario {
        name,
        title,
        description,
        hub,
        hub_size,
        names: devices.iter().map(|device| device.name.clone()).collect(),
        devices: devices::rows::set(&devices),
        structure,
        mounts: devices.into_iter().map(|device| device.turns).collect(),
        initial,
        mean: None,
        reference,
        hub_mode,
        gravity,
        drives,
        stops,
        friction,
        wrenches,
        points,
        disturbances,
        controllers,
        changes,
        crossings,
        settings: settings?,
        output: output?,
        requirements,
        margin_requirements,
        source: Source {
            path: path.to_owned(),
            text,
            filled: String::new(),
            structure: structure_file,
        },
    })
}

/// The name of the scenario, which names its files.
fn name(keys: &Keys<'_>, stem: &str) -> String {
    let fits = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    match keys.text("name") {
        Some(name) if !name.is_empty() && name.chars().all(fits) && name.len() <= NAME_MAX => {
            name.to_owned()
        }
        Some(name) => {
            let message = format!("`name` is \"{name}\"");
            keys.error("name", message, "use lower-case letters, digits and hyphens, up to 100");
            String::new()
        }
        None => {
            let small = stem.to_lowercase();
            let name: String = small.chars().map(|c| if fits(c) { c } else { '-' }).collect();
            if name.len() > NAME_MAX {
                let message = format!("the file's name has {} letters", name.len());
                keys.error("name", message, "add a `name` of at most 100: results are named by it");
            }
            if name.is_empty() { "scenario".to_owned() } else { name }
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix3, Vector3};
    use precess_dynamics::Hub;

    use super::super::to_toml;
    use super::*;

    const TABLE_1: &str = include_str!("../../../../scenarios/table1-printed-free.toml");

    fn read_text(text: &str) -> Read {
        from_toml("test.toml", text, Path::new(""))
    }

    fn errors(text: &str) -> String {
        read_text(text).expect_err("an error").to_string()
    }

    #[test]
    fn table_1_is_read_to_the_bit() {
        let (read, _) = read_text(TABLE_1).unwrap_or_else(|errors| panic!("{errors}"));
        let hub = Hub {
            m_b: 810.0,
            r_bc_b: Vector3::new(-0.02e-2, 0.01e-2, 10e-2),
            i_b_bc: Matrix3::new(900.0, 4.15, 2.93, 4.15, 800.0, 2.75, 2.93, 2.75, 600.0),
        };
        assert_eq!(read.hub, hub);
        let [precess_dynamics::BuiltIn::Dgvscmg(device)] = read.devices.0[..] else {
            panic!("{:?}", read.devices);
        };
        assert_eq!((device.d, device.i_w_wc.m13, device.r_go_b.x), (8e-3, 0.0154, 0.3));
        let omega = Vector3::new(4.85_f64.to_radians(), 0.57_f64.to_radians(), 0.0);
        // By pi / 180 or by 180 / pi: a rounding.
        assert!((read.initial.omega - omega).norm() < 1e-17);
    }

    #[test]
    fn a_scenario_written_is_read_back_the_same() {
        let text = TABLE_1.replace(
            "[device.wheel]",
            "[device.wheel]\ntorque = { sine = \"3 mN m\", \
            frequency = \"2 Hz\", from = \"1 s\", to = \"2 s\" }\ntorque_limit = \"2 mN m\"\n\
            power_limit = \"30 W\"\nrate_limit = \"6000 rpm\"\n\
            stiffness = \"1 mN m/deg\"\nupper_stop = \"300 rev\"",
        );
        let text = text
            + "[[at]]\ntime = \"3 s\"\njoint = \"cmg.outer_gimbal\"\nbrake = true\n\
            [[wrench]]\non = \"hub\"\nforce = { z = { step = \"1 N\", at = \"1 s\" } }\n\
            [[requirement]]\nname = \"a\"\nquantity = \"omega\"\nstatistic = \"band_rms\"\n\
            band = \"1, 2 Hz\"\nlimit = \"1 deg/s\"\n\
            [[requirement]]\nname = \"b\"\nquantity = \"omega\"\nstatistic = \"pde\"\n\
            window = \"1 s\"\nstability = \"2 s\"\nlevel = 0.95\nlimit = \"1 deg/s\"\n\
            [[requirement]]\nname = \"c\"\nquantity = \"omega\"\nstatistic = \"jitter\"\n\
            exposure = \"100 ms\"\nlimit = \"1 deg/s\"\n";
        let (first, _) = read_text(&text).unwrap_or_else(|errors| panic!("{errors}"));
        let written = to_toml(&first);
        let (second, _) =
            read_text(&written).unwrap_or_else(|errors| panic!("{errors}\n{written}"));
        assert_eq!(to_toml(&second), written);
        assert_eq!(second.devices, first.devices);
        assert_eq!(second.drives, first.drives);
        assert_eq!(second.initial, first.initial);
        assert_eq!(second.changes, first.changes);
        assert_eq!(second.wrenches, first.wrenches);
        assert_eq!(second.requirements, first.requirements);
    }

    #[test]
    fn all_errors_come_at_once_with_their_lines() {
        let text = TABLE_1
            .replace("mass = \"810 kg\"", "mas = \"810 kg\"")
            .replace("\"4 kg\"", "4")
            .replace("\"500 rpm\"", "\"500 Hz\"")
            .replace("\"10 s\"", "\"10 furlongs\"")
            .replace("mass = \"24 kg\"", "mass = \"-24 kg\"");
        let shown = errors(&text);
        for part in [
            "unknown key `hub.mas`",
            "did you mean `mass`?",
            "`device.cmg.wheel.mass` has no unit",
            "`device.cmg.wheel.rate` is a frequency, where an angular rate is wanted",
            "`run.duration`: no such unit",
            "`device.cmg.outer_gimbal.mass` is -24 kg",
            "test.toml:14:1",
        ] {
            assert!(shown.contains(part), "{part} in\n{shown}");
        }
    }

    #[test]
    fn an_attitude_is_read_back_to_the_bit() {
        let head = "format = 1\n[hub]\nmass = \"9 kg\"\ninertia = \"1, 1, 1 kg m^2\"\n[run]\n\
                    duration = \"1 s\"\n[initial.attitude]\n";
        for angles in ["1, 2, 3", "10, -20, 30", "170, 80, -100", "0.1, 0.2, 0.3", "7, 7, 7"] {
            let text = format!(
                "{head}euler = \"{angles} deg\"\nsequence = \"ZYX\"\ndirection = \"N to B\"\n"
            );
            let (first, _) = read_text(&text).unwrap_or_else(|errors| panic!("{errors}"));
            let (second, _) = read_text(&to_toml(&first)).unwrap_or_else(|e| panic!("{e}"));
            assert_eq!(second.initial.attitude, first.initial.attitude, "{angles}");
        }
    }

    #[test]
    fn what_is_no_toml_is_said_alone() {
        let shown = errors("format = 1\n[hub\nmass = ");
        assert!(shown.contains("not TOML"), "{shown}");
        assert!(!shown.contains("missing"), "{shown}");
        for text in ["", "\0", "format = 1e999", "hub = 3", "device = 7\nformat = 1"] {
            assert!(!errors(text).is_empty());
        }
    }
}
