//! `bake`: kernels of one spacecraft. Without a file, those that the tests hold against the general
//! ones: a folder of `tests/baked` each. Written are those that are committed, which have a manifest.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use clap::Args;
use precess_bake::{Baked, Description, Language, Options as Baking, bake as derive};

use xtask::files::{differing, write};
use xtask::run::root;
use xtask::say;

use crate::pages::texts;

/// The folder of the spacecraft that the tests know.
const FOLDER: &str = "tests/baked";
/// The description in each of them.
const DESCRIPTION: &str = "description.toml";
/// What a committed crate has.
const MANIFEST: &str = "Cargo.toml";

/// The folders whose values are folded end so.
const CONSTANTS: &str = "_constants";

/// The options of `bake`.
#[derive(Args)]
pub(crate) struct Options {
    /// A description, or a scenario with `--scenario`; all spacecraft of the tests without it
    file: Option<PathBuf>,
    /// The file is a scenario: the desktop tool is built and says what its spacecraft is
    #[arg(long, requires = "file")]
    scenario: bool,
    /// The folder to write
    #[arg(long, value_name = "DIR", requires = "file")]
    out: Option<PathBuf>,
    /// What to write
    #[arg(long, value_enum, default_value_t = Language::Rust, requires = "file")]
    language: Language,
    /// Fold the values, too: constants instead of a constructor that takes them
    #[arg(long, requires = "file")]
    constants: bool,
    /// Write nothing; fail if a committed file is stale
    #[arg(long, conflicts_with_all = ["file", "out"])]
    check: bool,
}

/// Derives, proves and writes, or compares.
pub(crate) fn bake(options: &Options) -> Result<(), String> {
    let Some(file) = &options.file else { return all(options.check) };
    // As the caller sees them: cargo runs in the root.
    let here = |path: &Path| {
        std::path::absolute(path).map_err(|error| format!("{}: {error}", path.display()))
    };
    let file = &here(file)?;
    let text = if options.scenario { described(file)? } else { read(file)? };
    let description = parsed(file, &text)?;
    let Options { language, constants, .. } = *options;
    let baked =
        derive(&description, Baking { language, constants }).map_err(|error| error.to_string())?;
    let out = match &options.out {
        Some(out) => here(out)?,
        None => root().join("target/baked").join(&description.name),
    };
    write(texts(&baked.files), &out)?;
    report(&baked, &out);
    Ok(())
}

/// The spacecraft of the tests, as Rust.
fn all(check: bool) -> Result<(), String> {
    let folder = root().join(FOLDER);
    let entries =
        fs::read_dir(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut folders: Vec<_> = entries.filter_map(|entry| entry.ok().map(|e| e.path())).collect();
    folders.sort();
    let mut stale = 0;
    for folder in folders.iter().filter(|folder| folder.join(DESCRIPTION).is_file()) {
        let file = folder.join(DESCRIPTION);
        let description = parsed(&file, &read(&file)?)?;
        let constants = description.name.ends_with(CONSTANTS);
        let what = Baking { language: Language::Rust, constants };
        let baked = derive(&description, what).map_err(|error| error.to_string())?;
        if !folder.join(MANIFEST).is_file() {
            // The suite that holds it against the general kernels emits it.
        } else if check {
            stale += differing(texts(&baked.files), folder);
        } else {
            write(texts(&baked.files), folder)?;
        }
        report(&baked, folder);
    }
    if stale == 0 {
        return Ok(());
    }
    Err(format!("{stale} files in {FOLDER} are stale; run `cargo xtask bake`"))
}

/// What the desktop tool says of a scenario's spacecraft.
fn described(file: &Path) -> Result<String, String> {
    let program = std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
    let mut command = Command::new(program);
    command.args(["run", "--quiet", "--package", "precess", "--", "bake", "--description"]);
    let output = command.arg(file).current_dir(root()).output();
    let output = output.map_err(|error| format!("cargo did not start: {error}"))?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).trim().to_owned());
    }
    String::from_utf8(output.stdout).map_err(|error| error.to_string())
}

fn read(file: &Path) -> Result<String, String> {
    fs::read_to_string(file).map_err(|error| format!("{}: {error}", file.display()))
}

fn parsed(file: &Path, text: &str) -> Result<Description, String> {
    Description::read(text).map_err(|error| format!("{}: {error}", file.display()))
}

fn report(baked: &Baked, out: &Path) {
    let out = out.strip_prefix(root()).unwrap_or(out).display();
    let operations = baked.operations;
    say!(
        "{out}: {} claims proven, {} operations an evaluation, {} of the general kernels",
        baked.proof.len(),
        operations.baked,
        operations.general
    );
}
