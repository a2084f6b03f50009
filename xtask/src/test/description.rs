//! What a suite tests, in its own words: the first sentence of its file, or the description of its package.

use std::fs;
use std::path::PathBuf;

use xtask::run::root;

use super::suites::{How, Suite};

/// The packages of the suites and their folders.
const FOLDERS: [(&str, &str); 23] = [
    ("precess-codegen", "codegen"),
    ("precess-bake", "codegen/bake"),
    ("precess-description", "codegen/description"),
    ("precess-review", "codegen/review"),
    ("precess-derive", "xtask/derive"),
    ("precess-dynamics", "dynamics"),
    ("precess-double-double", "tests/double_double"),
    ("precess-tests", "tests"),
    ("precess-derivatives", "tests/derivatives"),
    ("precess-ledger", "tests/ledger"),
    ("precess-baked", "tests/baked"),
    ("four-wheels", "tests/baked/four_wheels"),
    ("imaging-satellite", "tests/baked/imaging_satellite"),
    ("precess-attack", "tests/attack"),
    ("precess-control", "sim/control"),
    ("precess-fmu", "sim/fmu"),
    ("precess-gpu", "sim/gpu"),
    ("precess", "sim"),
    ("xtask", "xtask"),
    ("precess-distribute", "xtask/distribute"),
    ("precess-site", "xtask/site"),
    ("precess-lanes", "sim/lanes"),
    ("precess-point-masses", "tests/point_masses"),
];

/// The folder of a package.
pub(crate) fn folder(package: &str) -> Option<&'static str> {
    FOLDERS.iter().find(|(name, _)| *name == package).map(|(_, folder)| *folder)
}

/// The file of an integration test.
pub(crate) fn file(package: &str, target: &str) -> Option<PathBuf> {
    let tests = root().join(folder(package)?).join("tests");
    let files = [tests.join(format!("{target}.rs")), tests.join(target).join("main.rs")];
    files.into_iter().find(|file| file.exists())
}

impl Suite {
    /// What it tests, in a sentence without its full stop.
    pub(crate) fn says(&self) -> String {
        match self.how {
            How::Documentation => {
                "the examples in the documentation of every library compile and hold".to_owned()
            }
            How::Command(words) => command(words[0]).to_owned(),
            How::Target { package, target: "lib" | "bin" } => {
                format!("unit tests of `{}`", folder(package).unwrap_or(package))
            }
            // Their files are emitted, and end with the spacecraft.
            How::Target { package, target: "reference" } => {
                format!(
                    "emitted kernels of `{package}` against the whole system, solved without elimination"
                )
            }
            How::Target { package, target } => {
                let text = file(package, target).and_then(|file| fs::read_to_string(file).ok());
                sentence(&text.unwrap_or_default())
            }
        }
    }
}

/// What a command of the workbench tests.
fn command(name: &str) -> &'static str {
    match name {
        "lint" => "format, and clippy with warnings denied",
        "regen" => {
            "every kind is derived, proven and emitted to the committed bytes, pages included"
        }
        "bake" => {
            "kernels of the tests' spacecraft are derived, proven and emitted to the committed bytes"
        }
        "mutate" => "each term made wrong breaks a law of physics",
        "demo" => "the six variants of Table 1 run and are drawn",
        "accuracy" => "errors of accelerations and derivatives are those of the page",
        "instructions" => "instructions of calls are within 1 % of the page",
        "engines" => "stored values are those that the engines compute today",
        "flight" => {
            "two of the boards print the bits of this machine, and pass the gates; the C library"
        }
        "python" => "the wheel is built, installed and tested",
        "reports" => "the built report is that of its sources, and works in a browser",
        "dependencies" => {
            "crates of others have allowed licences and sources, and one version each"
        }
        "site" => "the documents become pages without a dead link, which a browser walks",
        _ => "",
    }
}

/// The first sentence of the comment that a file begins with.
fn sentence(text: &str) -> String {
    let lines = text.lines().map_while(|line| line.strip_prefix("//!")).map(str::trim);
    let comment = lines.collect::<Vec<_>>().join(" ");
    let end = comment.find(". ").unwrap_or(comment.len());
    comment[..end].trim_end_matches('.').replace('|', "\\|")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_sentence_may_go_over_lines() {
        let text =
            "//! Runs of scenario files\n//! against closed forms. More.\n//!\n//! And more.\n";
        assert_eq!(sentence(text), "Runs of scenario files against closed forms");
    }
}
