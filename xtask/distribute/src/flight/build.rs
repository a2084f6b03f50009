//! Building the firmware: for this machine by the same cargo, for a board with a core library built
//! on the spot, and nothing but it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::board::Board;
use super::tools::{CARGO, RUSTC};
use xtask::run::{root, target};

/// What the outer build may have set, and must not decide here.
const OUTER: [&str; 7] = [
    "RUSTFLAGS",
    "CARGO_ENCODED_RUSTFLAGS",
    "CARGO_BUILD_RUSTFLAGS",
    "CARGO_BUILD_TARGET",
    "CARGO_TARGET_DIR",
    "RUSTC_WRAPPER",
    // Of the outer toolchain's libraries.
    "LD_LIBRARY_PATH",
];

/// The programs that count, with the feature that each needs.
const COUNTING: [(&str, &str); 2] =
    [("instructions", "count"), ("linearization", "count-linearization")];

/// The manifest of the firmware's workspace.
pub(super) fn firmware() -> PathBuf {
    root().join("flight/firmware")
}

/// Builds programs for this machine, not optimised: bits depend on no optimisation. Returns their folder.
pub(super) fn for_host(programs: &[&str]) -> Result<PathBuf, String> {
    let folder = target()?;
    let images = folder.join("debug");
    stale(programs.iter().map(|program| images.join(program)))?;
    let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
    let mut command = clean(&cargo);
    command.arg("build").args(bins(programs));
    built(&mut command, &folder)?;
    Ok(images)
}

/// Builds programs for a board; returns their folder.
pub(super) fn programs(board: &Board, programs: &[&str]) -> Result<PathBuf, String> {
    let (mut command, folder, images) = on_board(board, "build")?;
    stale(programs.iter().map(|program| images.join(program)))?;
    command.args(bins(programs));
    for (program, feature) in COUNTING {
        if programs.contains(&program) {
            command.args(["--features", feature]);
        }
    }
    built(&mut command, &folder)?;
    Ok(images)
}

/// Builds a package as a static library for a board; returns its path.
pub(super) fn library(board: &Board, package: &str, features: &[&str]) -> Result<PathBuf, String> {
    let (mut command, folder, images) = on_board(board, "rustc")?;
    let archive = images.join(format!("lib{}.a", package.replace('-', "_")));
    stale([archive.clone()].into_iter())?;
    command.args(["-p", package, "--lib", "--crate-type", "staticlib"]);
    command.args(["--features", &features.join(",")]);
    built(&mut command, &folder)?;
    Ok(archive)
}

fn on_board(board: &Board, task: &str) -> Result<(Command, PathBuf, PathBuf), String> {
    let folder = target()?.join("flight").join(board.name);
    let images = folder.join(board.triple).join("release");
    let mut command = clean(CARGO);
    // Only `core`: code that needs an allocator or the standard library does not build.
    command.args([task, "--release", "--target", board.triple, "-Zbuild-std=core"]);
    command.env("RUSTC", RUSTC).env("RUSTC_BOOTSTRAP", "1").env("RUSTFLAGS", board.flags());
    Ok((command, folder, images))
}

/// Cargo without what the outer build has set.
fn clean(cargo: &str) -> Command {
    let mut command = Command::new(cargo);
    for variable in OUTER {
        command.env_remove(variable);
    }
    command
}

fn bins<'a>(programs: &'a [&'a str]) -> impl Iterator<Item = &'a str> {
    programs.iter().flat_map(|program| ["--bin", program])
}

/// Removes what an earlier build left, so that nothing old can pass for new.
fn stale(images: impl Iterator<Item = PathBuf>) -> Result<(), String> {
    for image in images.filter(|image| image.exists()) {
        fs::remove_file(&image).map_err(|error| format!("{}: {error}", image.display()))?;
    }
    Ok(())
}

/// Runs cargo in the firmware's workspace; its messages where it fails.
fn built(command: &mut Command, folder: &Path) -> Result<(), String> {
    command.arg("--target-dir").arg(folder).arg("--quiet").current_dir(firmware());
    let output = command.output().map_err(|error| format!("cargo did not start: {error}"))?;
    if output.status.success() {
        return Ok(());
    }
    let errors = String::from_utf8_lossy(&output.stderr);
    Err(format!("the build in {} failed ({}):\n{errors}", folder.display(), output.status))
}
