//! The table of suites is complete: every test target of the workspace has a row, and every folder of sources is named
//! by one.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use xtask::run::{output, program, root};

use super::description;
use super::programs::named;
use super::suites::{How, SUITES, Suite};

/// Folders of sources that no test can see broken, each with its reason.
const UNTESTED: &[(&str, &str)] = &[
    ("tests/benches", "benchmarks: timed, not asserted"),
    ("sim/benches", "benchmarks: timed, not asserted"),
    ("tests/measure", "`cargo xtask bench`: timed, not asserted"),
    ("tests/peers", "scripts of `cargo xtask bench` with other engines"),
];

/// Package and target of every test program that cargo knows of.
fn targets() -> BTreeSet<(String, String)> {
    let mut cargo = Command::new(program());
    cargo.args(["metadata", "--no-deps", "--offline", "--format-version", "1"]);
    let text = output(cargo.current_dir(root())).unwrap();
    let metadata: serde_json::Value = serde_json::from_str(text.trim()).unwrap();
    let mut found = BTreeSet::new();
    for package in metadata["packages"].as_array().unwrap() {
        let name = package["name"].as_str().unwrap();
        for target in package["targets"].as_array().unwrap() {
            let source = Path::new(target["src_path"].as_str().unwrap());
            let target_name = named(target).unwrap();
            if target["test"] == true && (target["kind"][0] == "test" || has_tests(source)) {
                found.insert((name.to_owned(), target_name.to_owned()));
            }
        }
    }
    found
}

/// Whether a file below that of a crate has a test in it.
fn has_tests(root_file: &Path) -> bool {
    let is_library = root_file.ends_with("lib.rs");
    let folder = root_file.parent().unwrap();
    rust_files(folder).iter().any(|file| {
        // Library and program of one folder share their files but for the two roots.
        let elsewhere = file.parent() == Some(folder)
            && file.ends_with(if is_library { "main.rs" } else { "lib.rs" });
        !elsewhere && fs::read_to_string(file).unwrap().contains("#[test]")
    })
}

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
        let path = entry.path();
        if path.is_dir() {
            files.extend(rust_files(&path));
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            files.push(path);
        }
    }
    files
}

#[test]
fn every_test_program_has_a_row() {
    let rows = SUITES.iter().filter_map(|suite| match suite.how {
        How::Target { package, target } => Some((package.to_owned(), target.to_owned())),
        _ => None,
    });
    let rows: BTreeSet<_> = rows.collect();
    let missing: Vec<_> = targets().difference(&rows).cloned().collect();
    // The command `precess` and the library share their folder, and `xtask` has both.
    let missing: Vec<_> = missing.into_iter().filter(|(_, target)| target != "bin").collect();
    assert!(missing.is_empty(), "without a row in xtask/src/test/suites.rs: {missing:?}");
    for (package, target) in rows.iter().filter(|(_, target)| target != "lib" && target != "bin") {
        let file = description::file(package, target);
        let file = file.unwrap_or_else(|| panic!("{package} has no test {target}"));
        // Of a suite of several files, any of them.
        let edited = if file.ends_with("main.rs") { file.with_file_name("other.rs") } else { file };
        let edited = edited.strip_prefix(root()).unwrap();
        let suite = SUITES.iter().find(|suite| suite.is(package, target)).unwrap();
        assert!(suite.can_break(edited), "no change of {} runs its own suite", edited.display());
    }
}

/// Folders that hold sources, from the root, two deep at most; three where rows name folders of the solver.
fn folders() -> BTreeSet<String> {
    let text = output(Command::new("git").args(["ls-files"]).current_dir(root())).unwrap();
    let sources = text.lines().filter(|file| {
        [".rs", ".py", ".c", ".h", ".js", ".mjs", ".toml", ".tera"]
            .iter()
            .any(|ending| file.ends_with(ending))
    });
    let folders = sources.filter_map(|file| {
        let (folder, _) = file.rsplit_once('/')?;
        let depth = if folder.starts_with("dynamics/src") { 3 } else { 2 };
        Some(folder.split('/').take(depth).collect::<Vec<_>>().join("/"))
    });
    folders.filter(|folder| !folder.starts_with('.')).collect()
}

#[test]
fn every_folder_of_sources_is_named_by_a_row() {
    for folder in folders() {
        let untested = UNTESTED.iter().any(|(known, _)| *known == folder);
        // Format and lints read every file, and test none.
        let mut suites = SUITES.iter().filter(|suite| suite.name() != "lint");
        let tested = suites.any(|suite| suite.can_break(Path::new(&folder)));
        assert!(untested || tested, "no suite of xtask/src/test/suites.rs names {folder}");
    }
    for path in SUITES.iter().flat_map(|suite| suite.broken_by).flat_map(|group| group.iter()) {
        assert!(root().join(path).exists(), "{path} of xtask/src/test/suites.rs is not there");
    }
}

#[test]
fn every_suite_says_what_it_tests_and_has_a_name_of_its_own() {
    let names: BTreeSet<_> = SUITES.iter().map(Suite::name).collect();
    assert_eq!(names.len(), SUITES.len());
    for suite in SUITES {
        assert!(suite.says().len() > 10, "{} does not say what it tests", suite.name());
    }
}

#[test]
fn a_change_of_the_solver_reaches_its_suites_and_no_generator() {
    let broken = |path: &str| {
        let broken = SUITES.iter().filter(|suite| suite.can_break(Path::new(path)));
        broken.map(Suite::name).collect::<Vec<_>>()
    };
    let solve = broken("dynamics/src/solve/mod.rs");
    assert!(solve.contains(&"precess-tests dynamics".to_owned()), "{solve:?}");
    assert!(!solve.contains(&"precess-codegen mutation".to_owned()), "{solve:?}");
    let lanes = broken("dynamics/src/lanes/batch.rs");
    assert!(lanes.contains(&"precess-attack sample".to_owned()), "{lanes:?}");
    assert!(!lanes.contains(&"precess fit".to_owned()), "{lanes:?}");
}
