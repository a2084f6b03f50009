//! Packages of the crates that other crates link, as cargo packs them.

use std::fs;

use super::archive::Package;
use super::build::Stage;
use xtask::files::remove_folder;
use xtask::run::run_there;

/// The solver, and what derives and emits a kind in a crate of one's own.
const CRATES: [&str; 2] = ["precess-dynamics", "precess-codegen"];

/// A package of each. The sources have no history in them, so nothing of it gets into a package.
pub(super) fn packages(stage: &Stage) -> Result<Vec<Package>, String> {
    let folder = stage.target.join("package");
    // Packages of another version would be taken for these.
    remove_folder(&folder)?;
    let mut command = stage.cargo()?;
    // Their tests are those of the repository.
    command.args(["package", "--quiet", "--no-verify", "--allow-dirty", "--locked"]);
    command.args(CRATES.iter().flat_map(|name| ["--package", name]));
    run_there(&mut command)?;
    let wrong = |error| format!("cannot read {}: {error}", folder.display());
    let mut packages = Vec::new();
    for name in CRATES {
        let mut listed: Vec<_> =
            fs::read_dir(&folder).map_err(wrong)?.flatten().map(|one| one.path()).collect();
        listed.retain(|path| {
            let file = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            file.starts_with(&format!("{name}-"))
                && path.extension().is_some_and(|ending| ending == "crate")
        });
        let [path] = listed.as_slice() else {
            return Err(format!("{} has {} packages of {name}", folder.display(), listed.len()));
        };
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        packages.push(Package { name, bytes: fs::read(path).map_err(wrong)? });
    }
    Ok(packages)
}
