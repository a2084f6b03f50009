//! The folders of `src` are floors: a file uses its own folder and those below it, never one above.

use std::fs;
use std::path::{Path, PathBuf};

/// The floors from the ground up.
const FLOORS: [&str; 11] = [
    "numbers",
    "attitude",
    "model",
    "validation",
    "equations",
    "generated",
    "sets",
    "solve",
    "results",
    "integrate",
    "lanes",
];

/// Records that kernels and solver share: below `sets` nothing else of `generated` is named.
const SHARED: &str = "generated::hub";

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// Floors that a text names, its own tests left out.
fn named(text: &str) -> impl Iterator<Item = &str> {
    let code = text.split("#[cfg(test)]").next().unwrap_or(text);
    let lines = code.lines().filter(|line| !line.trim_start().starts_with("//"));
    lines.flat_map(|line| line.split("crate::").skip(1))
}

fn level(path: &str) -> Option<usize> {
    FLOORS
        .iter()
        .position(|floor| path.strip_prefix(floor).is_some_and(|rest| rest.starts_with("::")))
}

#[test]
fn no_floor_uses_one_above_it() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let (mut found, mut arrows) = (Vec::new(), 0);
    files(&source, &mut found);
    for path in found {
        let inside = path.strip_prefix(&source).unwrap().to_str().unwrap().replace('\\', "/");
        let Some(own) = level(&inside.replace('/', "::")) else { continue };
        if inside.ends_with("_checks.rs") {
            continue;
        }
        for used in named(&fs::read_to_string(&path).unwrap()) {
            let Some(other) = level(used) else { continue };
            arrows += 1;
            let known = other <= own || used.starts_with(SHARED);
            let name = used.split([';', '{', ' ']).next().unwrap_or(used);
            assert!(known, "{inside} uses crate::{name}, a floor above its own");
        }
    }
    assert!(arrows > 300, "{arrows} arrows seen");
}

#[test]
fn an_arrow_upwards_is_seen() {
    let text =
        "use crate::lanes::Batch;\n// crate::solve::state\n#[cfg(test)]\nuse crate::sets::one;\n";
    let used: Vec<_> = named(text).collect();
    assert_eq!(used, ["lanes::Batch;"]);
    assert!(level(used[0]) > level("numbers::real"));
}
