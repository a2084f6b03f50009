//! The sources are as docs/architecture.md has them: imports between folders make no circle, and the functions of a step
//! are in the files that the page names and call each other as it has them.

mod graph;
mod imports;
mod step;

use std::path::Path;
use std::sync::OnceLock;

use graph::Graph;
use imports::Crate;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

/// Folders of the sources of crates that have folders or more than a few files.
const CRATES: [&str; 10] = [
    "codegen/src",
    "codegen/bake/src",
    "codegen/review/src",
    "dynamics/src",
    "sim/control/src",
    "sim/src",
    "tests/src",
    "xtask/src",
    "xtask/derive/src",
    "xtask/distribute/src",
];

/// Circles between folders that there are, each with its reason.
const FOLDERS: [(&str, &[&str], &str); 1] = [(
    "dynamics/src",
    &["generated", "model"],
    "generated/hub.rs imports nothing: the emitted records that the traits of the model exchange with the kernels",
)];

/// A circle in one folder has at most so many files.
const FILES: usize = 5;

/// Larger ones that there are, by crate and folder; a number may only fall.
const LARGER: [(&str, &str, usize); 0] = [];

/// The crates, read once.
fn crates() -> impl Iterator<Item = (&'static str, &'static Crate)> {
    static READ: OnceLock<Vec<Crate>> = OnceLock::new();
    let read = || CRATES.iter().map(|name| Crate::read(&Path::new(ROOT).join(name))).collect();
    CRATES.into_iter().zip(READ.get_or_init(read))
}

#[test]
fn no_circle_between_folders() {
    let (mut found, mut expected) = (Vec::new(), FOLDERS.to_vec());
    for (name, source) in crates() {
        assert!(source.imports.len() > 5, "{name}: {} imports", source.imports.len());
        let graph = Graph::of_folders(source);
        for circle in graph.circles() {
            let known = expected.len();
            expected.retain(|(of, nodes, _)| *of != name || nodes.iter().ne(&circle));
            if expected.len() == known {
                found.push(format!("{name}: {}", graph.described(&circle)));
            }
        }
    }
    assert!(found.is_empty(), "circles between folders:\n{}", found.join("\n"));
    assert!(expected.is_empty(), "no circle any more, remove from the list: {expected:?}");
}

#[test]
fn no_large_circle_within_a_folder() {
    let (mut found, mut expected) = (Vec::new(), LARGER.to_vec());
    for (name, source) in crates() {
        for folder in source.folders() {
            let graph = Graph::of_files(source, &folder);
            for circle in graph.circles().into_iter().filter(|circle| circle.len() > FILES) {
                let known = expected.len();
                expected.retain(|of| *of != (name, folder.as_str(), circle.len()));
                if expected.len() == known {
                    found.push(format!("{name} {folder}: {}", graph.described(&circle)));
                }
            }
        }
    }
    assert!(found.is_empty(), "circles of more than {FILES} files:\n{}", found.join("\n"));
    assert!(expected.is_empty(), "smaller now, lower the number or remove it: {expected:?}");
}
