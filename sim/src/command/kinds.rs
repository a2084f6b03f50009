//! `kinds`: what devices there are.

use std::fmt::Write as _;
use std::process::ExitCode;

use clap::Args;
use precess_dynamics::BuiltInKind;

use super::table::aligned_left;
use super::{CommandError, print};
use crate::file::read::body_key;

/// The options of `kinds`.
#[derive(Debug, Args)]
pub(super) struct Kinds {
    /// One kind, in detail.
    kind: Option<String>,
}

impl Kinds {
    pub(super) fn execute(&self) -> Result<ExitCode, CommandError> {
        let Some(name) = &self.kind else {
            let mut rows =
                vec![vec!["kind".to_owned(), "bodies from the hub to the tip".to_owned()]];
            for kind in BuiltInKind::ALL {
                let bodies: Vec<_> = kind.joints().iter().map(body_key).collect();
                rows.push(vec![kind.name().to_owned(), bodies.join(", ")]);
            }
            print(&aligned_left(&rows));
            return Ok(ExitCode::SUCCESS);
        };
        let Some(kind) = BuiltInKind::of_name(name) else {
            let known: Vec<_> = BuiltInKind::ALL.iter().map(|kind| kind.name()).collect();
            let message = format!("no kind is named `{name}`; there are {}", known.join(", "));
            return Err(CommandError::Other(message));
        };
        let mut text = String::new();
        let _ = writeln!(text, "{}\n\njoints from the hub to the tip", kind.name());
        for joint in kind.joints() {
            let axis = ["x", "y", "z"].get(joint.axis).copied().unwrap_or("?");
            let (how, unit) =
                if joint.slides { ("slides along", "m") } else { ("turns about", "rad") };
            let rate = joint.rate;
            let motor =
                if joint.driven { "motor" } else { "keeps its rate, motor torque computed" };
            let _ = writeln!(
                text,
                "  {:<14} {how} {axis}; coordinate {} ({unit}), rate {rate}, {motor} {}",
                body_key(joint),
                joint.coordinate,
                joint.motor
            );
        }
        let _ = writeln!(text, "\nparameters of the Rust structure");
        let rows: Vec<_> = kind
            .parameters()
            .iter()
            .map(|p| {
                let unit = if p.unit.is_empty() { "" } else { p.unit };
                vec![format!("  {}", p.name), unit.to_owned(), p.meaning.to_owned()]
            })
            .collect();
        text.push_str(&aligned_left(&rows));
        let _ = writeln!(text, "\n`precess new {}` prints a scenario with one.", kind.name());
        print(&text);
        Ok(ExitCode::SUCCESS)
    }
}
