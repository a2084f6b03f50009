//! `engines`: computes the stored values again with the engines, and with `--more` compares the
//! solver with them on spacecraft that are not stored.

use std::env;
use std::io::ErrorKind;
use std::process::Command;

use clap::Args;

use xtask::run::{root, run, target};
use xtask::skip::skip;

/// What evaluates the engines and compares: Pinocchio and `MuJoCo`, of the DGVSCMG and of every
/// kind; Basilisk, of reaction wheels and of VSCMGs; Pinocchio, of isolated platforms; pyYeti, of structures; Basilisk's
/// laws, of steering and of attitude, and its law and servo over a run; `SciPy`, of filters; python-control, of
/// loops; the package `mcap`, of a recording; Basilisk, of the effector of `flight/basilisk`; `FMPy`, of functional
/// mock-up units; NVRTC and ptxas, of the registers and spills of batch kernels.
const SCRIPTS: [&str; 16] = [
    "tests/engines/store.py",
    KINDS,
    "tests/engines/wheels.py",
    "tests/engines/lumped.py",
    "tests/engines/gyros.py",
    "tests/engines/isolated.py",
    "tests/engines/structures.py",
    "tests/engines/steering.py",
    "tests/engines/filters.py",
    "tests/engines/loops.py",
    "tests/engines/steered.py",
    "tests/engines/mrp_feedback.py",
    "tests/engines/recording.py",
    "tests/engines/effector.py",
    "tests/engines/units.py",
    "tests/engines/gpu.py",
];

/// What draws more spacecraft.
const KINDS: &str = "tests/engines/kinds.py";

/// The variable by which the suite reads another file than the stored one.
const FILE: &str = "PRECESS_ENGINES_KINDS";

/// Exit status of the script where a Python package is missing.
const MISSING: i32 = 77;

/// Options of `engines`.
#[derive(Args)]
pub(crate) struct Options {
    /// Compare the solver with Pinocchio and `MuJoCo` on so many more random spacecraft
    #[arg(long, value_name = "N")]
    more: Option<u32>,
}

/// The stored values, or more spacecraft.
pub(crate) fn engines(options: &Options) -> Result<(), String> {
    match options.more {
        None => stored(),
        Some(count) => more(count),
    }
}

/// Each script with `--check`, or a line that says why not.
pub(crate) fn stored() -> Result<(), String> {
    SCRIPTS.iter().try_for_each(|script| python(script, &["--check"]).map(|_| ()))
}

/// More spacecraft by both engines, then the suite on them.
fn more(count: u32) -> Result<(), String> {
    let path = target()?.join("engines.json");
    let path = path.to_str().ok_or_else(|| format!("{} is no text", path.display()))?;
    if python(KINDS, &["--more", &count.to_string(), path])? {
        let cargo = env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
        let suite = ["test", "-p", "precess-tests", "--test", "engines", "kinds::", "--"];
        return run(Command::new(cargo).args(suite).arg("--nocapture").env(FILE, path));
    }
    Ok(())
}

/// Runs a script; false where a package is missing, which a line says.
fn python(script: &str, arguments: &[&str]) -> Result<bool, String> {
    let line = format!("python3 {script} {}", arguments.join(" "));
    eprintln!("$ {line}");
    // No bytecode: a check leaves no files.
    let status =
        Command::new("python3").args(["-B", script]).args(arguments).current_dir(root()).status();
    match status {
        Ok(status) if status.success() => Ok(true),
        Ok(status) if status.code() == Some(MISSING) => skipped(script),
        Ok(status) => Err(format!("`{line}` failed ({status})")),
        Err(error) if error.kind() == ErrorKind::NotFound => skipped(script),
        Err(error) => Err(format!("`{line}` did not start: {error}")),
    }
}

fn skipped(script: &str) -> Result<bool, String> {
    let what = format!("the engines of {script}");
    skip(&what, "pip install -r tests/engines/requirements.txt").map(|()| false)
}
