//! The licences of the crates that a library is made of, as one text.

use std::fs;

use super::build::Stage;
use crate::crates_of::{Crate, Metadata, linked_by};
use xtask::run::output;

/// How names of files with a licence begin.
const NAMES: [&str; 5] = ["LICENSE", "LICENCE", "COPYING", "COPYRIGHT", "NOTICE"];

/// The text: for each crate of others that the package of a manifest links, its name, version, licence and the
/// files that state it. Those that only run when it is built are not there.
pub(super) fn of_others(stage: &Stage, manifest: &str, package: &str) -> Result<String, String> {
    let metadata = metadata(stage, manifest)?;
    let lines = linked_by(stage.cargo()?, manifest, package, &host(stage)?)?;
    let linked = metadata.linked(&lines);
    let mut text = format!(
        "{package} is made of the crates below, and of the core libraries of Rust, which are licensed under MIT or \
         Apache-2.0.\n"
    );
    for one in metadata.crates() {
        if one.source.is_some() && linked.contains_key(one.id) {
            text.push_str(&of_one(&one)?);
        }
    }
    Ok(text)
}

/// The crates of a manifest, as they are linked on this machine.
pub(super) fn metadata(stage: &Stage, manifest: &str) -> Result<Metadata, String> {
    Metadata::read(stage.cargo()?, manifest, &["--filter-platform", &host(stage)?])
}

/// The triple of this machine.
pub(super) fn host(stage: &Stage) -> Result<String, String> {
    let told = output(stage.command("rustc")?.arg("-vV"))?;
    let host = told.lines().find_map(|line| line.strip_prefix("host: "));
    host.map(str::to_owned).ok_or_else(|| "`rustc -vV` names no host".to_owned())
}

/// What a crate says of its licence; an error where it has neither a file nor an expression.
fn of_one(one: &Crate<'_>) -> Result<String, String> {
    let Crate { name, version, licence: expression, folder, .. } = one;
    let mut text = format!("\n{}\n{name} {version}: {expression}\n", "-".repeat(80));
    let wrong = |error| format!("cannot read {}: {error}", folder.display());
    let mut files: Vec<_> =
        fs::read_dir(folder).map_err(wrong)?.flatten().map(|one| one.path()).collect();
    files.sort();
    for path in &files {
        let file = path.file_name().unwrap_or_default().to_string_lossy().to_uppercase();
        if path.is_file() && NAMES.iter().any(|name| file.starts_with(name)) {
            text.push('\n');
            text.push_str(fs::read_to_string(path).map_err(wrong)?.trim_end());
            text.push('\n');
        }
    }
    if expression.is_empty() && text.lines().count() < 4 {
        return Err(format!("{name} {version} states no licence; ask its authors"));
    }
    Ok(text)
}
