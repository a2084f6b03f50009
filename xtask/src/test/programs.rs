//! Test programs: built by cargo in one or two commands, and where each is.
//!
//! Features of one member reach what all others of a command are made of. So what is compiled with the solver's
//! lanes has a command of its own, and every other member is compiled once for all commands.

use std::collections::BTreeSet;
use std::iter;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;
use xtask::run::{program, root, run};

use super::suites::{How, Suite};
use crate::measured;
use crate::members::Members;

/// A test program that was built.
#[derive(Debug)]
pub(crate) struct Program {
    pub(crate) package: String,
    /// `lib`, `bin` or the name of an integration test.
    pub(crate) target: String,
    pub(crate) path: PathBuf,
    /// The folder of the package, in which cargo would run it.
    pub(crate) folder: PathBuf,
}

/// Builds the test programs of some suites, all of whose packages are in a group; what rustc takes is noted in a file.
pub(crate) fn build(
    members: Members,
    suites: &[&Suite],
    all: bool,
    notes: &Path,
) -> Result<Vec<Program>, String> {
    let selected = selected(members, suites, all);
    if selected.is_empty() {
        return Ok(Vec::new());
    }
    let count = selected.iter().filter(|word| **word == "--package").count();
    eprintln!("$ cargo test --no-run ({count} packages{})", members.says());
    let mut cargo = Command::new(program());
    cargo.args(["test", "--no-run", "--message-format=json-render-diagnostics"]).args(selected);
    measured::wrap(&mut cargo, notes);
    let output = cargo.stdout(Stdio::piped()).current_dir(root()).spawn();
    let output = output.and_then(std::process::Child::wait_with_output);
    let output = output.map_err(|error| format!("cargo did not start: {error}"))?;
    if !output.status.success() {
        return Err(format!("the tests were not compiled ({})", output.status));
    }
    let text = String::from_utf8_lossy(&output.stdout);
    Ok(text.lines().filter_map(read).collect())
}

/// Puts the libraries of packages beside the programs that were built for the tests, from the same crates: with another
/// selection cargo would compile all of them again.
pub(crate) fn build_libraries(
    members: Members,
    suites: &[&Suite],
    all: bool,
    notes: &Path,
) -> Result<(), String> {
    eprintln!("$ cargo build --lib");
    let mut cargo = Command::new(program());
    let selected = selected(members, suites, all).into_iter().filter(|word| *word != "--bins");
    cargo.args(["build", "--quiet"]).args(selected);
    measured::wrap(&mut cargo, notes);
    run(&mut cargo)
}

/// Arguments of cargo that select the test programs of some suites; none where there are none.
fn selected(members: Members, suites: &[&Suite], all: bool) -> Vec<&'static str> {
    let (mut packages, mut kinds) = (BTreeSet::new(), BTreeSet::new());
    for suite in suites {
        let How::Target { package, target } = suite.how else { continue };
        packages.insert(package);
        match target {
            "lib" => kinds.insert(("--lib", None)),
            "bin" => kinds.insert(("--bins", None)),
            name => kinds.insert(("--test", Some(name))),
        };
    }
    if packages.is_empty() {
        return Vec::new();
    }
    let mut words = members.features(all).to_vec();
    words.extend(optimisation(all));
    words.extend(kinds.into_iter().flat_map(|(option, name)| iter::once(option).chain(name)));
    words.extend(packages.into_iter().flat_map(|package| ["--package", package]));
    words
}

/// What `--all` optimises: the desktop tool and the solver behind it, whose fits and budgets then take a sixth of the
/// time, and the generator, whose proofs of mutants then take two thirds.
const OPTIMISED: &[&str] = &[
    "profile.dev.package.precess-codegen.opt-level=3",
    "profile.dev.package.precess.opt-level=1",
    "profile.dev.package.precess-craft.opt-level=1",
    // With an optimiser four parts of these take a quarter more of rustc's time than one.
    "profile.dev.package.precess.codegen-units=1",
    "profile.dev.package.precess-craft.codegen-units=1",
    // Runs of a minute.
    "profile.dev.package.precess-ledger.opt-level=2",
];

/// Arguments of cargo by which everything is optimised that is in `--all`.
pub(crate) fn optimisation(all: bool) -> impl Iterator<Item = &'static str> {
    let settings = if all { OPTIMISED } else { &[] };
    settings.iter().flat_map(|setting| ["--config", *setting])
}

/// The test program of a message of cargo, if it is about one.
fn read(line: &str) -> Option<Program> {
    let message: Value = serde_json::from_str(line).ok()?;
    if message["reason"] != "compiler-artifact" || message["profile"]["test"] != true {
        return None;
    }
    let path = PathBuf::from(message["executable"].as_str()?);
    let manifest = Path::new(message["manifest_path"].as_str()?);
    let target = named(&message["target"])?;
    Some(Program {
        package: package(message["package_id"].as_str()?).to_owned(),
        target: target.to_owned(),
        path,
        folder: manifest.parent()?.to_path_buf(),
    })
}

/// A target of cargo's messages as rows have it.
pub(super) fn named(target: &Value) -> Option<&str> {
    match target["kind"][0].as_str()? {
        "test" => target["name"].as_str(),
        // A library for other languages.
        "staticlib" => Some("lib"),
        kind => Some(kind),
    }
}

/// The package's name: after `#` and before `@`, or the folder where the two are the same.
fn package(id: &str) -> &str {
    let (folder, name) = id.rsplit_once('#').unwrap_or((id, id));
    match name.split_once('@') {
        Some((name, _)) => name,
        None => folder.rsplit('/').next().unwrap_or(folder),
    }
}

#[cfg(test)]
mod tests {
    use super::super::suites::SUITES;
    use super::*;
    use crate::program::{DERIVE, DISTRIBUTE, SITE};

    #[test]
    fn a_package_is_named_in_both_forms_of_its_identifier() {
        assert_eq!(package("path+file:///p/sim#precess@0.1.0"), "precess");
        assert_eq!(package("path+file:///p/xtask#0.1.0"), "xtask");
    }

    /// What a command resolves with other features is compiled once more, and so is all that depends on it.
    #[test]
    fn programs_of_the_workbench_are_made_of_the_crates_of_the_tests() {
        let tree = |edges: &str, selection: &[&str]| -> BTreeSet<String> {
            let mut cargo = Command::new(program());
            cargo.args(["tree", "--prefix", "none", "--format", "{p}: {f}", "--edges", edges]);
            let output = cargo.args(selection).current_dir(root()).output().unwrap();
            assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
            let text = String::from_utf8_lossy(&output.stdout);
            text.lines().map(|line| line.trim_end_matches(" (*)").to_owned()).collect()
        };
        let plain = SUITES.iter().filter_map(|suite| match suite.how {
            How::Target { package, target } => Some((package, target)),
            _ => None,
        });
        let plain = plain
            .filter(|(package, target)| Members::of_target(package, target, true) == Members::Plain)
            .flat_map(|(package, _)| ["--package", package]);
        let tests: Vec<_> = Members::Plain.features(true).iter().copied().chain(plain).collect();
        let tests = tree("normal,build,dev", &tests);
        for built in [DERIVE, DISTRIBUTE, SITE] {
            let own = tree("normal,build", &["--package", built.package]);
            let others: Vec<_> = own.difference(&tests).collect();
            assert!(
                others.is_empty(),
                "{}: add the features that the tests have to `xtask/features`: {others:?}",
                built.package
            );
        }
    }

    #[test]
    fn only_a_test_program_is_read() {
        let line = |executable: &str, test: bool| {
            format!(
                r#"{{"reason":"compiler-artifact","package_id":"path+file:///p/sim#precess@0.1.0",
                "manifest_path":"/p/sim/Cargo.toml","target":{{"kind":["test"],"name":"fit"}},
                "profile":{{"test":{test}}},"executable":{executable}}}"#
            )
        };
        let found = read(&line("\"/t/fit-1\"", true)).unwrap();
        assert_eq!((found.package.as_str(), found.target.as_str()), ("precess", "fit"));
        assert_eq!(found.folder, Path::new("/p/sim"));
        assert!(read(&line("null", true)).is_none());
        assert!(read(&line("\"/t/precess\"", false)).is_none());
        assert!(read("   Compiling").is_none());
    }
}
