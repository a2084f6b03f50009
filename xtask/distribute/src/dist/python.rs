//! The Python package: its sources, and a wheel that is built from them.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::archive::{Package, unpack};
use super::build::Stage;
use super::first::nth_block;
use super::licences;
use super::sources::lay_out;
use crate::wheel;
use xtask::files::remove_folder;
use xtask::run::{output, root, run_there};
use xtask::say;
use xtask::skip::skip;

/// The Python package, in the sources.
pub(super) const MANIFEST: &str = "python/Cargo.toml";
/// What builds it. The wheel names its version.
const MATURIN: &str = "maturin==1.16.0";
/// The page whose first program is run.
const PAGE: &str = "docs/python.md";
/// Fails unless the installed wheel has the licences of the crates that it is made of.
const HAS_LICENCES: &str = "import importlib.metadata as m
names = [file.name for file in m.files('precess')]
assert 'LICENSES-OF-OTHERS' in names, names";
const INSTALL: &str = "apt-get install python3-venv python3-pip";

/// Sources and wheel; none where Python is not there.
pub(super) fn packages(stage: &Stage, folder: &Path) -> Result<Vec<Package>, String> {
    let Some(python) = environment(&folder.join("maturin"), &[MATURIN])? else {
        return Ok(Vec::new());
    };
    let maturin = python.with_file_name("maturin");
    let out = folder.join("python-packages");
    remove_folder(&out)?;
    // What `build` remaps is there only after this.
    let fetched = ["fetch", "--locked", "--manifest-path", MANIFEST];
    run_there(stage.cargo()?.args(fetched))?;
    // Its name is one of those that `license-files` takes.
    let licences = licences::of_others(stage, MANIFEST, "precess-python")?;
    let beside = stage.sources.join("python/LICENSES-OF-OTHERS");
    fs::write(&beside, licences)
        .map_err(|error| format!("cannot write {}: {error}", beside.display()))?;
    let mut sdist = stage.command(&maturin)?;
    run_there(sdist.args(["sdist", "--manifest-path", MANIFEST, "--out"]).arg(&out))?;
    let sources = single(&out, "tar.gz")?;
    // Built from its own sources, the wheel shows that nothing is missing in them.
    let unpacked = Stage {
        sources: folder.join("python-sources"),
        target: stage.target.with_file_name("python-target"),
    };
    lay_out(&unpack(&sources.bytes)?, &unpacked.sources, &[])?;
    let mut build = unpacked.command(&maturin)?;
    build.args(["build", "--release", "--locked", "--quiet"]).args(wheel::STORED);
    build.arg("--out").arg(&out);
    run_there(&mut build)?;
    wheel::compress(&wheel::of_folder(&out)?)?;
    Ok(vec![sources, single(&out, "whl")?])
}

/// Installs a wheel in an empty environment, and runs the first program of its page in an empty folder that has the
/// scenarios. The package of sources was built when the wheel was made.
pub(super) fn first_example(package: &Package, place: &Path) -> Result<bool, String> {
    if Path::new(&package.name).extension().is_none_or(|ending| ending != "whl") {
        return Ok(false);
    }
    let wheel = place.join(&package.name);
    fs::write(&wheel, &package.bytes)
        .map_err(|error| format!("cannot write {}: {error}", wheel.display()))?;
    let wheel = wheel.to_string_lossy();
    let Some(python) = environment(&place.join("environment"), &[&wheel])? else {
        return Ok(false);
    };
    run_there(Command::new(&python).args(["-I", "-c", HAS_LICENCES]))?;
    let page = fs::read_to_string(root().join(PAGE))
        .map_err(|error| format!("cannot read {PAGE}: {error}"))?;
    let program = nth_block(&page, "", "python", 0, PAGE)?;
    let folder = place.join("empty");
    let scenarios = super::sources::tracked()?;
    let scenarios: Vec<_> =
        scenarios.into_iter().filter(|entry| entry.path.starts_with("scenarios/")).collect();
    lay_out(&scenarios, &folder, &[])?;
    let printed = output(Command::new(python).args(["-I", "-c", program]).current_dir(&folder))?;
    say!("{}", printed.trim_end());
    Ok(true)
}

/// The interpreter of an environment with some packages; none where there is no Python to make one.
fn environment(folder: &Path, packages: &[&str]) -> Result<Option<PathBuf>, String> {
    let python = folder.join("bin/python");
    if !python.exists() {
        let made = output(Command::new("python3").args(["-m", "venv"]).arg(folder));
        if let Err(error) = made {
            eprintln!("{error}");
            skip("the Python package", INSTALL)?;
            return Ok(None);
        }
    }
    let mut pip = Command::new(&python);
    pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]).args(packages);
    run_there(&mut pip)?;
    Ok(Some(python))
}

/// The one file of a folder that ends so.
fn single(folder: &Path, ending: &str) -> Result<Package, String> {
    let wrong = |error| format!("cannot read {}: {error}", folder.display());
    let mut found: Vec<_> =
        fs::read_dir(folder).map_err(wrong)?.flatten().map(|one| one.path()).collect();
    found.retain(|path| path.to_string_lossy().ends_with(ending));
    let [path] = found.as_slice() else {
        return Err(format!("{} has {} files *{ending}", folder.display(), found.len()));
    };
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    Ok(Package { name, bytes: fs::read(path).map_err(wrong)? })
}
