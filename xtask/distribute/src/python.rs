//! `python`: builds the wheel of the Python package, installs it in an environment of its own, and runs the
//! tests against what is installed, and against the command line.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use clap::Args;

use crate::wheel;
use xtask::files::remove_folder;
use xtask::run::{TOOL, output, root, run, target, tool};
use xtask::say;
use xtask::skip::{all_required, skip};

/// What builds the wheel, and what the tests need.
const REQUIREMENTS: &str = "python/tests/requirements.txt";
/// What functions for JAX and `CasADi` are tested with: 660 MB, so only where nothing may be skipped.
const LARGE: &str = "python/tests/requirements-large.txt";
const INSTALL: &str = "apt-get install python3-venv python3-pip";
/// Longest time to import the package beyond `NumPy`, and largest wheel: printed beside what is measured.
const IMPORT_MS: f64 = 50.0;
const WHEEL_MB: f64 = 6.0;

/// Options of `python`.
#[derive(Args)]
pub(crate) struct Options {
    /// Build as for development: less optimised, without AVX-512 and not compressed, so without the wheel's
    /// size
    #[arg(long)]
    quick: bool,
}

/// Builds, installs, tests.
pub(crate) fn python(options: &Options) -> Result<(), String> {
    let start = Instant::now();
    let folder = target()?.join("python");
    let Some(python) = environment(&folder.join("environment"))? else { return Ok(()) };
    let wheels = folder.join("wheels");
    remove_folder(&wheels)?;
    let mut build = Command::new(python.with_file_name("maturin"));
    build.args(["build", "--locked", "--manifest-path", "python/Cargo.toml"]);
    build.args(wheel::STORED).arg("--out").arg(&wheels);
    if options.quick {
        build.args(["--no-default-features", "--features", "development"]);
    } else {
        build.arg("--release");
    }
    // As for development, crates of others are those of the main workspace.
    let built = if options.quick { target()? } else { folder.join("build") };
    run(build.env("CARGO_TARGET_DIR", built))?;
    let wheel = wheel::of_folder(&wheels)?;
    if !options.quick {
        wheel::compress(&wheel)?;
        let size =
            std::fs::metadata(&wheel).map_err(|error| format!("{}: {error}", wheel.display()))?;
        say!(
            "wheel: {:.2} MB, goal {WHEEL_MB} MB",
            f64::from(u32::try_from(size.len()).unwrap_or(u32::MAX)) / 1e6
        );
    }
    let built = start.elapsed().as_secs_f64();
    run(pip(&python).args(["--force-reinstall", "--no-deps"]).arg(&wheel))?;
    say!("import: {} ms beyond NumPy's, goal {IMPORT_MS} ms", imported(&python)?);
    let mut tests = Command::new(&python);
    tests.args(["-B", "-m", "pytest", "-q", "python/tests"]).env(TOOL, tool()?);
    run(&mut tests)?;
    say!(
        "Python: {:.1} minutes to the wheel, {:.1} in all",
        built / 60.0,
        start.elapsed().as_secs_f64() / 60.0
    );
    Ok(())
}

/// The interpreter of an environment with what the tests need; none where there is no Python to make one.
fn environment(folder: &Path) -> Result<Option<PathBuf>, String> {
    let python = folder.join("bin/python");
    if !python.exists() {
        let made = output(Command::new("python3").args(["-m", "venv"]).arg(folder));
        if let Err(error) = made {
            eprintln!("{error}");
            // Half of one is none.
            let _ = std::fs::remove_dir_all(folder);
            return skip("the Python package", INSTALL).map(|()| None);
        }
    }
    let mut packages = pip(&python);
    packages.args(["--requirement", REQUIREMENTS]);
    if all_required() {
        packages.args(["--requirement", LARGE]);
    }
    if let Err(error) = run(&mut packages) {
        eprintln!("{error}");
        let install = format!("pip install --requirement {REQUIREMENTS}");
        return skip("the Python package", &install).map(|()| None);
    }
    Ok(Some(python))
}

fn pip(python: &Path) -> Command {
    let mut pip = Command::new(python);
    pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]);
    pip.current_dir(root());
    pip
}

/// Time to import the package after `NumPy`, ms: the median of five interpreters.
fn imported(python: &Path) -> Result<String, String> {
    let program = "import numpy, time; t = time.perf_counter(); import precess; \
                   print(f'{1e3 * (time.perf_counter() - t):.1f}')";
    let mut times = Vec::new();
    for _ in 0..5 {
        let printed = output(Command::new(python).args(["-I", "-c", program]))?;
        times.push(printed.trim().parse::<f64>().map_err(|error| format!("{printed}: {error}"))?);
    }
    times.sort_by(f64::total_cmp);
    Ok(format!("{}", times[times.len() / 2]))
}
