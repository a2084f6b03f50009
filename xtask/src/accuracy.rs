//! `accuracy`: where the bound on the accelerations holds and where it is lost, measured and drawn.

use std::fs;
use std::process::Command;

use clap::Args;

use crate::members::{Members, without_lanes};
use crate::test::{CASES, optimisation};
use xtask::files::{File, differing, write};
use xtask::run::{built, cargo, program, root, run, target};
use xtask::say;

/// The page and its figure, in `docs`.
const FILES: [&str; 2] = ["accuracy.md", "accuracy.svg"];

/// Options of `accuracy`.
#[derive(Args)]
pub(crate) struct Options {
    /// Write nothing; show what would change and fail if anything would
    #[arg(long)]
    check: bool,
}

/// Measures by the suite `linearize` and the example `accuracy`; writes the page with its figure, or compares.
pub(crate) fn accuracy(options: &Options) -> Result<(), String> {
    let out = target()?.join("accuracy");
    let derivatives = target()?.join("derivatives.txt");
    // As `cargo xtask test` builds them: a release build takes minutes, to the same bytes.
    let all = std::env::var_os(CASES).is_some_and(|cases| cases == "all");
    let mut selected = without_lanes();
    selected.extend(optimisation(all));
    selected.extend(Members::Plain.features(true));
    let suite = ["--quiet", "--test", "linearize"];
    let only = ["--", "--ignored", "figures_for_the_accuracy_page"];
    let mut figures = Command::new(program());
    figures.arg("test").args(&selected).args(suite).args(only);
    run(figures.env("PRECESS_FIGURES", &derivatives).env(CASES, "all"))?;
    let example = ["--profile", "test", "--quiet", "--example", "accuracy"];
    cargo(&[&["build"], &selected[..], &example].concat())?;
    let mut example = Command::new(built("examples/accuracy")?);
    run(example.arg("--out").arg(&out).arg("--derivatives").arg(&derivatives))?;
    let files = FILES.map(|name| {
        let text = fs::read_to_string(out.join(name));
        let text = text.map_err(|error| format!("cannot read {name}: {error}"))?;
        Ok((format!("docs/{name}"), text))
    });
    let files = files.into_iter().collect::<Result<Vec<_>, String>>()?;
    if options.check {
        return match differing(texts(&files), &root()) {
            0 => {
                say!("{} files are fresh", files.len());
                Ok(())
            }
            stale => Err(format!(
                "{stale} of {} files are stale; run `cargo xtask accuracy`",
                files.len()
            )),
        };
    }
    if let Some((_, text)) = files.first() {
        say!("{text}");
    }
    write(texts(&files), &root())
}

/// Path and text of each.
fn texts(files: &[(String, String)]) -> impl Iterator<Item = File<'_>> {
    files.iter().map(|(path, text)| (path.as_str(), text.as_str()))
}
