//! `kinds`: what devices there are, and the platform that carries devices.

use std::fmt::Write as _;

use clap::Args;
use precess_dynamics::kind::{JointInfo, Kind, ParameterInfo};
use precess_dynamics::{BuiltInKind, Platform};

use super::error::CommandError;
use super::exit::Exit;
use super::table::aligned_left;
use super::terminal::print;
use crate::scenario::{body_key, joint_key};

/// The options of `kinds`.
#[derive(Debug, Args)]
pub(super) struct Kinds {
    /// One kind, in detail.
    kind: Option<String>,
    /// For programs: a JSON object with the bodies of each kind of device, from the hub to the tip.
    #[arg(long, conflicts_with = "kind")]
    json: bool,
}

/// What is known of a kind of device, or of the platform that carries devices.
struct KindDescription {
    name: &'static str,
    joints: &'static [JointInfo],
    parameters: &'static [ParameterInfo],
    /// Where there is an example of it.
    example: String,
}

/// Every kind, and the platform.
fn described() -> impl Iterator<Item = KindDescription> {
    let kinds = BuiltInKind::ALL.iter().map(|kind| KindDescription {
        name: kind.name(),
        joints: kind.joints(),
        parameters: kind.parameters(),
        example: format!("`precess new {}` prints a scenario with one.", kind.name()),
    });
    let platform = KindDescription {
        name: <Platform as Kind>::NAME,
        joints: <Platform as Kind>::JOINTS,
        parameters: <Platform as Kind>::PARAMETERS,
        example:
            "A table `[[platform]]` of a scenario is one; devices and platforms stand on it by `on`. Example: \
                  scenarios/wheels-on-isolator.toml."
                .to_owned(),
    };
    kinds.chain([platform])
}

impl Kinds {
    pub(super) fn execute(&self) -> Result<Exit, CommandError> {
        if self.json {
            print(&json())?;
            return Ok(Exit::Success);
        }
        let Some(name) = &self.kind else {
            print(&table())?;
            return Ok(Exit::Success);
        };
        let Some(kind) = described().find(|kind| kind.name == name) else {
            let known: Vec<_> = described().map(|kind| kind.name).collect();
            let message = format!("no kind is named `{name}`; there are {}", known.join(", "));
            return Err(CommandError::Other(message));
        };
        print(&kind.detail())?;
        Ok(Exit::Success)
    }
}

/// The kinds of devices with their bodies, for programs.
fn json() -> String {
    let kinds = BuiltInKind::ALL.iter().map(|kind| {
        let bodies: Vec<_> = kind.joints().iter().map(body_key).collect();
        (kind.name().to_owned(), serde_json::Value::from(bodies))
    });
    format!("{:#}\n", serde_json::Value::Object(kinds.collect()))
}

/// The kinds with their bodies; what a platform carries is said of it.
fn table() -> String {
    let mut rows = vec![vec!["kind".to_owned(), "bodies from the hub to the tip".to_owned()]];
    for kind in described() {
        let mut bodies: Vec<_> = kind.joints.iter().map(body_key).collect();
        if kind.name == <Platform as Kind>::NAME {
            bodies = vec!["six joints under devices that stand `on` it".to_owned()];
        }
        rows.push(vec![kind.name.to_owned(), bodies.join(", ")]);
    }
    aligned_left(&rows)
}

impl KindDescription {
    /// Joints and parameters.
    fn detail(&self) -> String {
        let mut text = String::new();
        let _ = writeln!(text, "{}\n\njoints from the hub to the tip", self.name);
        for joint in self.joints {
            let axis = ["x", "y", "z"].get(joint.axis).copied().unwrap_or("?");
            let (how, unit) =
                if joint.slides { ("slides along", "m") } else { ("turns about", "rad") };
            let rate = joint.rate;
            let motor =
                if joint.driven { "motor" } else { "keeps its rate, motor torque computed" };
            let _ = writeln!(
                text,
                "  {:<14} {how} {axis}; coordinate {} ({unit}), rate {rate}, {motor} {}",
                joint_key(joint),
                joint.coordinate,
                joint.motor
            );
        }
        let _ = writeln!(text, "\nparameters of the Rust structure");
        let rows: Vec<_> = self
            .parameters
            .iter()
            .map(|p| {
                let unit = if p.unit.is_empty() { "" } else { p.unit };
                vec![format!("  {}", p.name), unit.to_owned(), p.meaning.to_owned()]
            })
            .collect();
        text.push_str(&aligned_left(&rows));
        let _ = writeln!(text, "\n{}", self.example);
        text
    }
}
