//! The first example of each package, installed in an empty place.

use std::path::Path;
use std::process::Command;

use super::archive::{Entry, Package, unpack};
use super::build::program;
use super::python;
use super::sources::lay_out;
use super::tool;
use xtask::capi::GUIDE;
use xtask::run::{is_there, output, root, run_there};
use xtask::say;
use xtask::skip::skip;

/// The page whose first program links the solver.
const README: &str = "README.md";
/// What the archive of sources runs.
const SCENARIO: &str = "scenarios/table1-catalogue-free.toml";
/// What the desktop tool links with its engine.
const CONTROLLED: &str = "scenarios/gyro-pyramid-slew.toml";
/// Below this heading, the guide of the C library says how an installed one is used.
const INSTALLED: &str = "## Install";

/// All of them. `folder` keeps what cargo compiles of other crates for the next time.
pub(super) fn examples(packages: &[Package], folder: &Path) -> Result<(), String> {
    let target = folder.join("examples");
    for package in packages {
        let place = tempfile::tempdir()
            .map_err(|error| format!("cannot make a temporary folder: {error}"))?;
        let (name, place) = (package.name.as_str(), place.path());
        // A bill of materials is read, not installed.
        let tried = if name.ends_with(".cdx.json") {
            false
        } else if name.ends_with("-sources.tar.gz") {
            sources(package, place, &target)?
        } else if name.starts_with("precess-dynamics-") {
            solver(package, place, &target)?
        } else if name.starts_with("precess-codegen-") {
            codegen(package, place, &target)?
        } else if name.starts_with("precess-c-") {
            library(package, place)?
        } else if tool::is_archive(name) {
            tool(package, place)?
        } else {
            python::first_example(package, place)?
        };
        if tried {
            say!("{name}: installed in an empty place, its first example runs");
        }
    }
    Ok(())
}

/// The desktop tool, built from the archive, evaluates a scenario.
fn sources(package: &Package, place: &Path, target: &Path) -> Result<bool, String> {
    lay_out(&unpack(&package.bytes)?, place, &[])?;
    let mut cargo = Command::new(program());
    cargo.args(["run", "--quiet", "--locked", "-p", "precess", "--", "evaluate", SCENARIO]);
    run_there(cargo.env("CARGO_TARGET_DIR", target).current_dir(place))?;
    Ok(true)
}

/// The desktop tool writes an example, and runs it; of a controlled spacecraft it links a unit with the engine.
fn tool(package: &Package, place: &Path) -> Result<bool, String> {
    lay_out(&unpack(&package.bytes)?, &place.join("precess"), &[])?;
    let program = place.join("precess/bin").join(format!(
        "{}{}",
        tool::PACKAGE,
        std::env::consts::EXE_SUFFIX
    ));
    let example = output(Command::new(&program).args(["new", "reaction_wheel"]))?;
    lay_out(&[Entry::file("bus.toml", example)], &place.join("first"), &[])?;
    for arguments in [
        &["check", "bus.toml"][..],
        &["run", "bus.toml", "--out", "results"],
        &["export", "fmu", "bus.toml", "--step", "1 ms", "--to", "bus.fmu"],
    ] {
        run_there(Command::new(&program).args(arguments).current_dir(place.join("first")))?;
    }
    if std::env::consts::OS == "linux" && is_there("cc") {
        let mut export = Command::new(&program);
        export.args(["export", "fmu"]).arg(root().join(CONTROLLED));
        export.args(["--step", "2 ms", "--binary", "--to", "controlled.fmu"]);
        run_there(export.current_dir(place.join("first")))?;
    }
    Ok(true)
}

/// The program of the README, with its dependencies as they are there.
fn solver(package: &Package, place: &Path, target: &Path) -> Result<bool, String> {
    lay_out(&unpack(&package.bytes)?, &place.join("precess/dynamics"), &[])?;
    let readme = read(README)?;
    let dependencies = block(&readme, "", "toml", README)?;
    let main = block(&readme, "", "rust", README)?;
    cargo_run(place, dependencies, main, target)?;
    Ok(true)
}

/// A program that derives a kind and proves it.
fn codegen(package: &Package, place: &Path, target: &Path) -> Result<bool, String> {
    const PAGE: &str = "docs/adding-a-kind.md";
    lay_out(&unpack(&package.bytes)?, &place.join("precess/codegen"), &[])?;
    let page = read(PAGE)?;
    let kind = block(&page, "", "rust", PAGE)?;
    let main = format!(
        "{kind}\nfn main() -> Result<(), Box<dyn Error>> {{\n    write(Path::new(\"emitted\"))\n}}\n"
    );
    let dependencies = "[dependencies]\nprecess-codegen = { path = \"precess/codegen\" }\n";
    cargo_run(place, dependencies, &main, target)?;
    Ok(true)
}

/// A program in a workspace of its own, built and run.
fn cargo_run(place: &Path, dependencies: &str, main: &str, target: &Path) -> Result<(), String> {
    let manifest = format!(
        "[workspace]\n[package]\nname = \"first\"\nedition = \"2024\"\n{dependencies}\n[profile.dev]\nopt-level = 2\n"
    );
    lay_out(
        &[Entry::file("Cargo.toml", manifest), Entry::file("src/main.rs", main)],
        place,
        &["precess"],
    )?;
    let mut cargo = Command::new(program());
    run_there(cargo.args(["run", "--quiet"]).env("CARGO_TARGET_DIR", target).current_dir(place))
}

/// The program of the guide, by `pkg-config` and by `CMake`, with the lines of the guide.
fn library(package: &Package, place: &Path) -> Result<bool, String> {
    // A folder whose name has a space in it would need quotes in the lines of the guide.
    let prefix = place.join("precess-c");
    lay_out(&unpack(&package.bytes)?, &prefix, &[])?;
    let guide = read(GUIDE)?;
    let mut tried = false;
    for (tool, number, install) in
        [("pkg-config", 0, "apt-get install pkg-config"), ("cmake", 1, "apt-get install cmake")]
    {
        if !is_there(tool) || !is_there("cc") {
            skip(&format!("the C library by {tool}"), install)?;
            continue;
        }
        let mut entries = vec![Entry::file("first.c", block(&guide, "", "c", GUIDE)?)];
        if tool == "cmake" {
            let lists = block(&guide, INSTALLED, "cmake", GUIDE)?;
            entries.push(Entry::file("CMakeLists.txt", lists));
        }
        let folder = place.join(tool);
        lay_out(&entries, &folder, &[])?;
        let lines = nth_block(&guide, INSTALLED, "sh", number, GUIDE)?;
        let mut shell = Command::new("sh");
        shell.args(["-e", "-u", "-x", "-c", lines]).env("PRECESS", &prefix);
        run_there(shell.current_dir(&folder))?;
        tried = true;
    }
    Ok(tried)
}

/// The first block of a language below a heading.
fn block<'t>(text: &'t str, heading: &str, language: &str, page: &str) -> Result<&'t str, String> {
    nth_block(text, heading, language, 0, page)
}

/// A block of a language below a heading, counted from 0.
pub(super) fn nth_block<'t>(
    text: &'t str,
    heading: &str,
    language: &str,
    number: usize,
    page: &str,
) -> Result<&'t str, String> {
    let below = text.split_once(heading).map(|(_, below)| below);
    let mut blocks = below.into_iter().flat_map(|below| below.split("\n```"));
    // Every second piece is in a block.
    let found = blocks.by_ref().skip(1).step_by(2).filter_map(|piece| {
        let (first, rest) = piece.split_once('\n')?;
        (first == language).then_some(rest)
    });
    found
        .into_iter()
        .nth(number)
        .ok_or_else(|| format!("{page} has no block {number} of {language} below `{heading}`"))
}

fn read(page: &str) -> Result<String, String> {
    let path = root().join(page);
    std::fs::read_to_string(&path)
        .map_err(|error| format!("cannot read {}: {error}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_is_found_by_heading_language_and_number() {
        let page =
            "a\n```c\nzero\n```\n## One\n```sh\none\n```\ntext\n```c\ntwo\n```\n```sh\nx\ny\n```\n";
        assert_eq!(nth_block(page, "", "c", 1, ""), Ok("two"));
        assert_eq!(nth_block(page, "## One", "sh", 1, ""), Ok("x\ny"));
        assert!(nth_block(page, "## One", "sh", 2, "").is_err());
    }
}
