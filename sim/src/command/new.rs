//! `new`: a commented example of a scenario file, or of a budget, with typical values.

mod controlled;

use std::fmt::Write as _;

use clap::Args;
use precess_dynamics::BuiltInKind;
use precess_dynamics::kind::JointInfo;

use super::error::CommandError;
use super::exit::Exit;
use super::terminal::print;
use crate::file::read::{has_inertia, has_mass};
use crate::scenario::body_key;
use controlled::{CONTROLLED, controlled};

/// The options of `new`.
#[derive(Debug, Args)]
pub(super) struct New {
    /// A kind of device (see `precess kinds`), or `pyramid` for four DGVSCMGs, `gyros` for four SGCMGs, `wheels` for three
    /// reaction wheels, `orbit` for a wheel in an orbit, `platform` for a wheel on an isolator; `budget` for a jitter budget of `wheels`.
    #[arg(default_value = "reaction_wheel")]
    what: String,

    /// With a controller that turns the spacecraft by 30 degrees and holds it: of `pyramid`, `gyros` and `wheels`.
    #[arg(long)]
    controller: bool,
}

impl New {
    pub(super) fn execute(&self) -> Result<Exit, CommandError> {
        if self.controller && !CONTROLLED.contains(&self.what.as_str()) {
            let message = format!(
                "there is no example of `{}` with a controller; there are {}",
                self.what,
                CONTROLLED.join(", ")
            );
            return Err(CommandError::Other(message));
        }
        let text = example(&self.what);
        let text =
            if self.controller { text.and_then(|text| controlled(text, &self.what)) } else { text };
        let Some(text) = text else {
            let known: Vec<_> = BuiltInKind::ALL.iter().map(|kind| kind.name()).collect();
            let message = format!(
                "there is no example of `{}`; there are budget, gyros, orbit, platform, pyramid, wheels, {}",
                self.what,
                known.join(", ")
            );
            return Err(CommandError::Other(message));
        };
        print(&text)?;
        Ok(Exit::Success)
    }
}

/// The text of an example.
fn example(what: &str) -> Option<String> {
    if what == "budget" {
        return Some(BUDGET.to_owned());
    }
    let mut text = String::from(HEAD);
    match what {
        "pyramid" => {
            text.push_str(PYRAMID);
            bodies(&mut text, BuiltInKind::Dgvscmg);
        }
        "gyros" => {
            let single = [("DGVSCMGs", "SGCMGs"), ("outer gimbal", "gimbal"), ("dgvscmg", "sgcmg")];
            text.push_str(
                &single.iter().fold(PYRAMID.to_owned(), |text, (a, b)| text.replace(a, b)),
            );
            bodies(&mut text, BuiltInKind::Sgcmg);
        }
        "orbit" => {
            text = text.replace("[initial]\n", ORBIT);
            text.push_str(WHEEL);
            bodies(&mut text, BuiltInKind::ReactionWheel);
        }
        "wheels" => {
            let wheels = [
                (1, "1, 0, 0", "30, 0, -20 cm"),
                (2, "0, 1, 0", "0, 30, -20 cm"),
                (3, "0, 0, 1", "-30, 0, -20 cm"),
            ];
            for (number, axis, position) in wheels {
                let _ = write!(
                    text,
                    "\n[[device]]\nname = \"wheel{number}\"\nkind = \"reaction_wheel\"\n\
                     position = \"{position}\"\nmount = {{ spin_axis = [{axis}] }}\n\
                     imbalance = {{ static = \"1 g cm\", dynamic = \"20 g cm^2\", phase = \"0 deg\" }}\n"
                );
                bodies(&mut text, BuiltInKind::ReactionWheel);
            }
        }
        "platform" => {
            text.push_str(PLATFORM);
            bodies(&mut text, BuiltInKind::ReactionWheel);
        }
        name => {
            let kind = BuiltInKind::of_name(name)?;
            let _ = write!(
                text,
                "\n[[device]]\nname = \"{}\"\nkind = \"{name}\"\n\
                 # Origin of the first joint from B, in the hub's axes.\n\
                 position = \"30, 0, 0 cm\"\n",
                short(kind)
            );
            text.push_str(mount(kind));
            if rotor_off_balance(kind) {
                text.push_str(IMBALANCE);
            }
            bodies(&mut text, kind);
            if name == "reaction_wheel" {
                text.push_str(SOURCE);
            }
        }
    }
    let kind = BuiltInKind::of_name(what);
    let joint = match (what, kind) {
        ("pyramid", _) => "cmg1.wheel".to_owned(),
        ("gyros", _) => "cmg1.gimbal".to_owned(),
        (_, Some(kind)) => {
            let body = kind.joints().last().map_or("", |joint| joint.body);
            format!("{}.{}", short(kind), body.replace(' ', "_"))
        }
        _ => "wheel1.wheel".to_owned(),
    };
    let mut tail = TAIL.replace("JOINT", &joint);
    if what == "orbit" {
        tail = tail.replace("# columns = [\"omega\", \"attitude\", \"loads\"]", ORBIT_COLUMNS);
    }
    text.push_str(&tail);
    Some(text)
}

/// A name for a device of a kind.
fn short(kind: BuiltInKind) -> &'static str {
    let last = kind.joints().last().map_or("", |joint| joint.body);
    match last {
        "wheel" if kind.joints().iter().all(|joint| !joint.body.contains("gimbal")) => "wheel1",
        "wheel" => "cmg1",
        "panel" => "panel1",
        _ => "slosh1",
    }
}

/// Whether the wheel of a kind can be off balance: it has an offset for a parameter.
fn rotor_off_balance(kind: BuiltInKind) -> bool {
    kind.parameters().iter().any(|parameter| parameter.name == "d")
}

fn mount(kind: BuiltInKind) -> &'static str {
    match short(kind) {
        "wheel1" => "# The spin axis in the hub's axes.\nmount = { spin_axis = [1, 0, 0] }\n",
        "cmg1" => {
            "# Spin axis and gimbal axis at zero angles, in the hub's axes.\n\
             mount = { spin_axis = [1, 0, 0], gimbal_axis = [0, 0, 1] }\n"
        }
        _ => {
            "# The device's axes are the hub's, turned: here by nothing.\n\
              mount = { axis = [0, 0, 1], angle = \"0 deg\" }\n"
        }
    }
}

/// The tables of the bodies of a kind.
fn bodies(text: &mut String, kind: BuiltInKind) {
    for joint in kind.joints() {
        let _ = writeln!(text, "\n[device.{}]", body_key(joint));
        if !has_mass(kind, joint) {
            bearing(text, joint);
            continue;
        }
        let (mass, inertia) = typical(joint);
        let _ = writeln!(text, "mass = \"{mass}\"");
        if has_inertia(kind, joint) {
            let _ = writeln!(
                text,
                "# Moments of inertia about the body's centre of mass, in its own axes.\n\
                 inertia = \"{inertia}\""
            );
        }
        let axis = ["x", "y", "z"].get(joint.axis).copied().unwrap_or("?");
        if joint.slides {
            let _ = writeln!(
                text,
                "# It slides along {axis}: spring and damper, and where it starts.\n\
                 stiffness = \"20 N/m\"\ndamping = \"0.5 N s/m\"\ndisplacement = \"1 cm\""
            );
        } else if joint.body == "wheel" {
            let _ = writeln!(text, "# It turns about {axis}.\nrate = \"3000 rpm\"");
            if joint.driven {
                let _ = writeln!(
                    text,
                    "# Of its motor; a torque turns the hub the other way.\ntorque = \"0 N m\"\ntorque_limit = \"0.2 N m\""
                );
            }
        } else if joint.body == "panel" {
            let _ = writeln!(
                text,
                "centre_of_mass = \"0, 1, 0 m\"\n# It turns about {axis}.\n\
                 stiffness = \"30 N m/rad\"\ndamping = \"0.2 N m s/rad\"\nangle = \"1 deg\""
            );
        } else {
            let _ = writeln!(
                text,
                "# It turns about {axis}.\nangle = \"0 deg\"\n\
                 torque = {{ sine = \"0.2 N m\", frequency = \"0.5 Hz\" }}"
            );
        }
    }
}

/// The table of a joint of flexible bearings: with the typical wheel, modes at about 60 Hz and at rest 100 Hz.
fn bearing(text: &mut String, joint: &JointInfo) {
    let [how, stiffness, damping] = if joint.slides {
        ["slides along", "6e5 N/m", "30 N s/m"]
    } else {
        ["tilts about", "6e3 N m/rad", "0.2 N m s/rad"]
    };
    let axis = ["x", "y", "z"].get(joint.axis).copied().unwrap_or("?");
    let _ = writeln!(
        text,
        "# The rotor {how} {axis} on its bearings.\nstiffness = \"{stiffness}\"\n\
         damping = \"{damping}\""
    );
}

/// Mass and moments of inertia of a body, of the size of a small satellite's.
fn typical(joint: &JointInfo) -> (&'static str, &'static str) {
    match joint.body {
        // A disc of 24 cm: J = m r^2 / 2 = 0.0288 kg m^2, and a rim that is 4 cm wide.
        "wheel" => ("4 kg", "288, 150, 150 kg cm^2"),
        "panel" => ("8 kg", "2.7, 0.1, 2.8 kg m^2"),
        body if body.contains("gimbal") => ("2 kg", "300, 250, 250 kg cm^2"),
        _ => ("10 kg", "0, 0, 0 kg m^2"),
    }
}

const BUDGET: &str = include_str!("new/budget.toml");

const HEAD: &str = r#"# A spacecraft for `precess run`. Every quantity has its unit; `precess check` tells what is wrong.
format = 1
title = "A first spacecraft"

# The hub without its devices: their bodies are added to it.
[hub]
mass = "350 kg"
# From the reference point B, in the hub's axes.
centre_of_mass = "0, 0, 2 cm"
# Moments of inertia about the hub's centre of mass, and the tensor's elements 12, 13, 23; of a table that has the
# integrals of x y, x z, y z with the other sign: inertia_integrals.
inertia = "80, 70, 60 kg m^2"
products_of_inertia = "0, 0, 0 kg m^2"
# For drawings only.
size = "1.2, 1, 1 m"

[initial]
angular_velocity = "0, 0, 0 deg/s"
# Or: { mrp = [0, 0, 0] }, { axis = [0, 0, 1], angle = "10 deg" },
# { euler = "0, 0, 10 deg", sequence = "ZYX", direction = "N to B" }.
attitude = { quaternion = [1, 0, 0, 0], scalar = "first" }
# The run starts in the vibration of its wheels, about this state: without it a hub at rest drifts. Wheels of one speed
# still make it drift, slowly: `check` warns where a requirement counts that.
settled = true
"#;

const IMBALANCE: &str = r#"# As the wheel's data sheet states it. The phase is the angle from the force to the torque.
imbalance = { static = "1 g cm", dynamic = "20 g cm^2", phase = "0 deg" }
"#;

const PYRAMID: &str = include_str!("new/pyramid.toml");

/// The head of the initial state, with the field of the Earth.
const ORBIT: &str = r#"# The field of the Earth as that of a point: a circular orbit at 500 km.
[gravity]
central = "3.986004418e14 m^3/s^2"

[initial]
position = "6878.137, 0, 0 km"
velocity = "0, 5.38293, 5.38293 km/s"
# Attitude and rate below are from the orbital frame: z down, y against the orbit's normal.
relative_to = "orbit"
"#;

const ORBIT_COLUMNS: &str = "# Roll, pitch, yaw and rate from the orbital frame, momentum about the centre of mass.\n\
                             columns = [\"omega\", \"orbit\", \"wheel1\"]";

const WHEEL: &str = r#"
[[device]]
name = "wheel1"
kind = "reaction_wheel"
position = "30, 0, 0 cm"
# Along the orbit's normal.
mount = { spin_axis = [0, -1, 0] }
imbalance = { static = "1 g cm", dynamic = "20 g cm^2", phase = "0 deg" }
"#;

const PLATFORM: &str = include_str!("new/platform.toml");

const TAIL: &str = r#"
# What happens over time, for example:
# [[at]]
# time = "5 s"
# joint = "JOINT"
# brake = true

[run]
duration = "10 s"
# Steps are chosen for a relative tolerance; or: integrator = "rk4", step = "0.1 ms".
integrator = "dop853"
tolerance = 1e-11

[output]
# Ten samples in a turn of the wheel, or more.
rate = "1 kHz"
formats = ["csv"]
# columns = ["omega", "attitude", "loads"]

[[requirement]]
name = "rate"
quantity = "omega"
statistic = "peak"
limit = "1 deg/s"
"#;

/// A source for a reaction wheel.
const SOURCE: &str = r#"
# What the imbalance does not do: bearing tones and noise of the data sheet, for example:
# [[source]]
# name = "bearing"
# on = "wheel1"
# spin_axis = "z"              # of the data sheet
# seed = 1                     # of unknown phases
# [[source.harmonic]]
# number = 2.0                 # 1 is the imbalance, which the wheel has
# radial_force = "1 g mm"      # amplitude over the square of the rate
"#;

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::file::from_toml;

    #[test]
    fn the_commented_source_is_one() {
        let text = example("reaction_wheel").expect("an example");
        let source = SOURCE.lines().skip(2).map(|line| line.trim_start_matches("# "));
        let text = source.fold(text, |text, line| text + line + "\n");
        let read = from_toml("source", &text, Path::new(""));
        let (scenario, _) = read.unwrap_or_else(|errors| panic!("{errors}\n{text}"));
        assert_eq!(scenario.disturbances.len(), 1);
    }

    #[test]
    fn the_budget_is_one_of_the_three_wheels() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("budget.toml");
        for (file, what) in [("budget.toml", "budget"), ("wheels.toml", "wheels")] {
            let text = example(what).expect("an example");
            std::fs::write(folder.path().join(file), text).expect("it is written");
        }
        let read = crate::file::budget_from_toml(&path, &[]);
        let (budget, scenario) = read.unwrap_or_else(|errors| panic!("{errors}"));
        assert_eq!((budget.limits.len(), budget.count), (1, 181));
        assert_eq!(scenario.file_name().and_then(|name| name.to_str()), Some("wheels.toml"));
    }

    /// The change that each example has as a comment names a joint of its own.
    #[test]
    fn the_commented_change_is_one() {
        let kinds = BuiltInKind::ALL.iter().map(|kind| kind.name());
        for what in kinds.chain(["gyros", "orbit", "platform", "pyramid", "wheels"]) {
            let text = example(what).expect("an example");
            let change = text.lines().skip_while(|line| *line != "# [[at]]").take(4);
            let change: Vec<_> = change.map(|line| line.trim_start_matches("# ")).collect();
            let read = from_toml(what, &format!("{text}\n{}\n", change.join("\n")), Path::new(""));
            // A wheel that its kind keeps at its rate has no brake.
            if let Err(errors) = read {
                let shown = errors.to_string();
                assert!(!shown.contains("no joint is named"), "{what}: {shown}");
            }
        }
    }

    #[test]
    fn every_example_is_a_scenario_without_warning() {
        let kinds = BuiltInKind::ALL.iter().map(|kind| kind.name());
        for what in kinds.chain(["gyros", "orbit", "platform", "pyramid", "wheels"]) {
            let text = example(what).expect("an example");
            let read = from_toml(what, &text, Path::new(""));
            let (_, warnings) = read.unwrap_or_else(|errors| panic!("{what}:\n{errors}\n{text}"));
            assert!(warnings.all.is_empty(), "{what}:\n{warnings}");
        }
    }
}
