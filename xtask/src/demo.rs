//! `demo`: derive, prove, solve the paper's scenario, draw the report.

use xtask::run::cargo;

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
    // One command, so that neither waits for the end of the other.
    cargo(&["build", "--package", DERIVE.package, "--package", "precess"])?;
    DERIVE.start(&["regen", "--check", "--quiet"])?;
    for command in ["run", "plot"] {
        // As the tests build it: a release build takes minutes, and the runs take seconds.
        let first = ["run", "-p", "precess", "--", command];
        let last = ["--out", "target/demo", "--force"];
        cargo(&[&first[..], &VARIANTS, &last].concat())?;
    }
    Ok(())
}
