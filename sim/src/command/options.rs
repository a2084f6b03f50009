//! Options that several commands have: scenario files, overrides, threads, the form of what is printed.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

/// Scenario files and what replaces keys in them.
#[derive(Debug, Args)]
pub(super) struct Files {
    /// Scenario files.
    #[arg(required = true, value_name = "FILE")]
    pub(super) files: Vec<PathBuf>,
    #[command(flatten)]
    pub(super) overrides: Set,
}

/// What replaces keys of a scenario file.
#[derive(Debug, Args)]
pub(super) struct Set {
    /// Replace a key: hub.mass="900 kg", device.cmg1.wheel.rate="3000 rpm"; may be repeated. A
    /// value that is no TOML is taken as text.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    set: Vec<String>,
}

/// How many threads a command has.
#[derive(Clone, Copy, Debug, Args)]
pub(super) struct Threads {
    /// Threads; the result does not depend on them. All cores without this option.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
}

impl Threads {
    /// The number of threads.
    pub(super) fn count(self) -> usize {
        self.threads.map_or_else(all_cores, usize::from)
    }
}

/// As many threads as there are cores.
fn all_cores() -> usize {
    std::thread::available_parallelism().map_or(1, std::num::NonZero::get)
}

/// How a command prints.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum Form {
    /// For people.
    #[default]
    Text,
    /// For programs.
    Json,
}

impl Set {
    /// The overrides as TOML: a shell takes the quotation marks off `hub.mass="900 kg"`.
    pub(super) fn overrides(&self) -> Vec<String> {
        self.set.iter().map(|text| as_toml(text)).collect()
    }
}

pub(super) fn as_toml(text: &str) -> String {
    let Some((key, value)) = text.split_once('=') else { return text.to_owned() };
    let bare = value.trim();
    let is_toml = bare.parse::<f64>().is_ok()
        || matches!(bare, "true" | "false")
        || bare.starts_with(['"', '\'', '[', '{']);
    if is_toml {
        return text.to_owned();
    }
    format!("{} = {}", key.trim(), toml::Value::String(bare.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_override_needs_no_quotation_marks_of_its_own() {
        assert_eq!(as_toml("hub.mass=900 kg"), "hub.mass = \"900 kg\"");
        assert_eq!(as_toml("hub.mass=\"900 kg\""), "hub.mass=\"900 kg\"");
        assert_eq!(as_toml("run.tolerance=1e-9"), "run.tolerance=1e-9");
        let table = "gravity={ central = \"1 m^3/s^2\" }";
        assert_eq!(as_toml(table), table);
    }
}
