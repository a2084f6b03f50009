//! The licences of the crates that a library is made of, as one text.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use serde_json::Value;

use super::build::Stage;
use xtask::run::output;

/// How names of files with a licence begin.
const NAMES: [&str; 5] = ["LICENSE", "LICENCE", "COPYING", "COPYRIGHT", "NOTICE"];

/// The text: for each crate of others that the package of a manifest links, its name, version, licence and the
/// files that state it. Those that only run when it is built are not there.
pub(super) fn of_others(stage: &Stage, manifest: &str, package: &str) -> Result<String, String> {
    let mut command = stage.cargo()?;
    command.args(["metadata", "--format-version", "1", "--locked", "--manifest-path", manifest]);
    command.args(["--filter-platform", &host(stage)?]);
    let metadata: Value = serde_json::from_str(&output(&mut command)?)
        .map_err(|error| format!("cargo metadata of {manifest}: {error}"))?;
    let linked = linked(&metadata, package);
    let mut text = format!(
        "{package} is made of the crates below, and of the core libraries of Rust, which are licensed under MIT or \
         Apache-2.0.\n"
    );
    for package in array(&metadata["packages"]) {
        let other = package["source"].is_string() && linked.contains(string(&package["id"]));
        if other {
            let folder = Path::new(string(&package["manifest_path"])).parent();
            text.push_str(&of_one(package, folder.unwrap_or_else(|| Path::new("")))?);
        }
    }
    Ok(text)
}

/// The triple of this machine.
pub(super) fn host(stage: &Stage) -> Result<String, String> {
    let told = output(stage.command("rustc")?.arg("-vV"))?;
    let host = told.lines().find_map(|line| line.strip_prefix("host: "));
    host.map(str::to_owned).ok_or_else(|| "`rustc -vV` names no host".to_owned())
}

/// Identifiers of what a package links: its dependencies, and theirs, that are not of its build or its tests.
fn linked<'m>(metadata: &'m Value, package: &str) -> BTreeSet<&'m str> {
    let nodes = array(&metadata["resolve"]["nodes"]);
    let needs: BTreeMap<_, _> = nodes.iter().map(|node| (string(&node["id"]), node)).collect();
    let root = array(&metadata["packages"]).iter().find(|one| string(&one["name"]) == package);
    let mut open: Vec<_> = root.map(|one| string(&one["id"])).into_iter().collect();
    let mut found = BTreeSet::new();
    while let Some(id) = open.pop() {
        if found.insert(id) {
            let dependencies = needs.get(id).map_or(&[][..], |node| array(&node["deps"]));
            let normal =
                |one: &&Value| array(&one["dep_kinds"]).iter().any(|k| k["kind"].is_null());
            open.extend(dependencies.iter().filter(normal).map(|one| string(&one["pkg"])));
        }
    }
    found
}

/// What a crate says of its licence; an error where it has neither a file nor an expression.
fn of_one(package: &Value, folder: &Path) -> Result<String, String> {
    let (name, version) = (string(&package["name"]), string(&package["version"]));
    let expression = string(&package["license"]);
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

fn array(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

fn string(value: &Value) -> &str {
    value.as_str().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_only_builds_or_tests_need_is_not_linked() {
        let metadata = serde_json::json!({
            "packages": [{"name": "root", "id": "r"}],
            "resolve": {"nodes": [
                {"id": "r", "deps": [
                    {"pkg": "a", "dep_kinds": [{"kind": null}]},
                    {"pkg": "b", "dep_kinds": [{"kind": "build"}]},
                    {"pkg": "d", "dep_kinds": [{"kind": "dev"}]}]},
                {"id": "a", "deps": [{"pkg": "c", "dep_kinds": [{"kind": "dev"}, {"kind": null}]}]}]}
        });
        assert_eq!(linked(&metadata, "root"), BTreeSet::from(["r", "a", "c"]));
    }
}
