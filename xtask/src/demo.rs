//! `demo`: derive, prove, solve the paper's scenario, draw the report.

use std::process::Command;

use xtask::run::{TOOL, cargo, run, tool};

use crate::program::DERIVE;

/// Table 1 as printed and with a catalogue wheel; without torque, and with two of the wheel.
const VARIANTS: [&str; 6] = [
    "scenarios/table1-printed-free.toml",
    "scenarios/table1-printed-200.toml",
    "scenarios/table1-printed-250.toml",
    "scenarios/table1-catalogue-free.toml",
    "scenarios/table1-catalogue-200.toml",
    "scenarios/table1-catalogue-250.toml",
];

/// `regen --check`, then every variant of Table 1, with its figures, into `target/demo`.
pub(crate) fn demo() -> Result<(), String> {
    // One command, so that neither waits for the end of the other; a tool that is named is used as it is.
    if std::env::var_os(TOOL).is_none() {
        cargo(&["build", "--package", DERIVE.package, "--package", "precess"])?;
    }
    DERIVE.start(&["regen", "--check", "--quiet"])?;
    // As the tests build it: a release build takes minutes, and the runs take seconds.
    let tool = tool()?;
    for command in ["run", "plot"] {
        let mut tool = Command::new(&tool);
        tool.arg(command).args(VARIANTS).args(["--out", "target/demo", "--force"]);
        run(&mut tool)?;
    }
    Ok(())
}
