//! `check`: what every commit passes; `lint`: its part that needs rustfmt and clippy.

use std::process::Command;

use crate::members::without_lanes;
use crate::program::DERIVE;
use xtask::capi::MANIFEST;
use xtask::run::{cargo, program, target};

/// `regen --check`, `bake --check`, `mutate --check`, format, clippy with warnings denied, unit tests: a stale or
/// broken generated file is named as such before anything tries to compile it.
pub(crate) fn check() -> Result<(), String> {
    DERIVE.run(&["regen", "--check", "--quiet"])?;
    DERIVE.run(&["bake", "--check"])?;
    DERIVE.run(&["mutate", "--check"])?;
    lint()?;
    // The campaign has no unit tests, and takes minutes to compile as if it had.
    cargo(&[&["test", "--lib", "--bins", "--quiet"], &without_lanes()[..]].concat())?;
    cargo(&["test", "--lib", "--quiet", "-p", "precess-dynamics", "-p", "precess-tests"])
}

/// Format, and clippy with warnings denied, of both workspaces that are built for this machine; skipped where the
/// toolchain has neither, which no test needs.
pub(crate) fn lint() -> Result<(), String> {
    if !["fmt", "clippy"].into_iter().all(is_subcommand) {
        eprintln!("skipped: format and lints; install with `rustup component add rustfmt clippy`");
        return Ok(());
    }
    cargo(&["fmt", "--all", "--check"])?;
    let all = ["--workspace", "--all-targets", "--all-features"];
    cargo(&[&["clippy", "--quiet"][..], &all, &["--", "--deny", "warnings"]].concat())?;
    // Without the emitted derivatives: by itself as on board, with a heap, and in lanes.
    for features in ["", "avx512,threads"] {
        let solver = ["--package", "precess-dynamics", "--no-default-features"];
        let options = [&solver[..], &["--features", features, "--", "--deny", "warnings"]].concat();
        cargo(&[&["clippy", "--quiet"][..], &options].concat())?;
    }
    cargo(&["fmt", "--all", "--check", "--manifest-path", MANIFEST])?;
    let folder = target()?.join("flight");
    let options = ["--manifest-path", MANIFEST, "--target-dir", &folder.to_string_lossy()];
    let options = [&options[..], &["--all-targets", "--", "--deny", "warnings"]].concat();
    cargo(&[&["clippy", "--quiet"][..], &options].concat())
}

/// Whether cargo has a subcommand.
fn is_subcommand(name: &str) -> bool {
    let output = Command::new(program()).args([name, "--version"]).output();
    output.is_ok_and(|output| output.status.success())
}
