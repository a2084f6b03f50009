//! The crates that a package is made of, as cargo resolves them: for licences, for the bill of materials, and for the
//! rules of `deny.toml`.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use std::process::Command;

use serde_json::Value;
use xtask::run::output;

/// What `cargo metadata` says.
pub(crate) struct Metadata(Value);

/// A crate.
pub(crate) struct Crate<'m> {
    pub(crate) id: &'m str,
    pub(crate) name: &'m str,
    pub(crate) version: &'m str,
    /// The expression of its licence; empty where it states none.
    pub(crate) licence: &'m str,
    /// Where it comes from; none of a crate of ours.
    pub(crate) source: Option<&'m str>,
    /// Its own files.
    pub(crate) folder: PathBuf,
}

impl Metadata {
    /// Of a manifest, by a cargo that is set up for it; `options` are of features and platforms.
    pub(crate) fn read(
        mut cargo: Command,
        manifest: &str,
        options: &[&str],
    ) -> Result<Self, String> {
        cargo.args(["metadata", "--format-version", "1", "--locked", "--manifest-path", manifest]);
        let value = serde_json::from_str(&output(cargo.args(options))?);
        value.map(Self).map_err(|error| format!("cargo metadata of {manifest}: {error}"))
    }

    /// All crates, by name and version.
    pub(crate) fn crates(&self) -> impl Iterator<Item = Crate<'_>> {
        array(&self.0["packages"]).iter().map(|package| Crate {
            id: string(&package["id"]),
            name: string(&package["name"]),
            version: string(&package["version"]),
            licence: string(&package["license"]),
            source: package["source"].as_str(),
            folder: PathBuf::from(string(&package["manifest_path"]))
                .parent()
                .map(std::path::Path::to_path_buf)
                .unwrap_or_default(),
        })
    }

    /// A crate of ours.
    pub(crate) fn package(&self, name: &str) -> Result<Crate<'_>, String> {
        let found = self.crates().find(|one| one.name == name && one.source.is_none());
        found.ok_or_else(|| format!("there is no package `{name}`"))
    }

    /// What a crate links: its dependencies that are not of its build or its tests.
    pub(crate) fn dependencies(&self, id: &str) -> Vec<&str> {
        let nodes = array(&self.0["resolve"]["nodes"]);
        let node = nodes.iter().find(|node| string(&node["id"]) == id);
        let normal =
            |one: &&Value| array(&one["dep_kinds"]).iter().any(|kind| kind["kind"].is_null());
        let dependencies = node.map_or(&[][..], |node| array(&node["deps"]));
        dependencies.iter().filter(normal).map(|one| string(&one["pkg"])).collect()
    }

    /// Identifiers of what a package links, its own among them, with what each of them links itself: of the lines of
    /// [`linked_by`]. A workspace's own resolution has features of other packages, too, and macros of compilers.
    pub(crate) fn linked(&self, lines: &str) -> BTreeMap<&str, Vec<&str>> {
        let lines: BTreeSet<_> = lines.lines().filter_map(named).collect();
        let linked: BTreeSet<_> = self
            .crates()
            .filter(|one| lines.contains(&(one.name, one.version)))
            .map(|one| one.id)
            .collect();
        let own =
            |id: &str| self.dependencies(id).into_iter().filter(|of| linked.contains(of)).collect();
        linked.iter().map(|id| (*id, own(id))).collect()
    }
}

/// What a package links on a platform, as `cargo tree` lists it: without what only builds it or is a macro.
pub(crate) fn linked_by(
    mut cargo: Command,
    manifest: &str,
    package: &str,
    platform: &str,
) -> Result<String, String> {
    cargo.args(["tree", "--locked", "--manifest-path", manifest, "--package", package]);
    output(cargo.args([
        "--edges",
        "normal,no-proc-macro",
        "--target",
        platform,
        "--prefix",
        "none",
    ]))
}

/// Name and version of a line.
fn named(line: &str) -> Option<(&str, &str)> {
    let mut words = line.split_whitespace();
    Some((words.next()?, words.next()?.strip_prefix('v')?))
}

fn array(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

fn string(value: &Value) -> &str {
    value.as_str().unwrap_or_default()
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A package `root` that links `a`, which links `c`.
    pub(crate) fn metadata() -> Metadata {
        let other = |name: &str, licence: &str| {
            serde_json::json!({"name": name, "id": name, "version": "1.0.0", "license": licence,
                "source": "registry+https://github.com/rust-lang/crates.io-index"})
        };
        Metadata(serde_json::json!({
            "packages": [{"name": "root", "id": "r", "version": "0.1.0", "license": "MIT", "source": null},
                other("a", "MIT OR Apache-2.0"), other("b", "GPL-3.0"), other("c", "Zlib/MIT"), other("d", "MIT")],
            "resolve": {"nodes": [
                {"id": "r", "deps": [
                    {"pkg": "a", "dep_kinds": [{"kind": null}]},
                    {"pkg": "b", "dep_kinds": [{"kind": "build"}]},
                    {"pkg": "d", "dep_kinds": [{"kind": "dev"}]}]},
                {"id": "a", "deps": [{"pkg": "c", "dep_kinds": [{"kind": "dev"}, {"kind": null}]}]}]}
        }))
    }

    #[test]
    fn what_only_builds_or_tests_need_is_not_linked() {
        let metadata = metadata();
        let linked = metadata.linked("root v0.1.0 (/p)\na v1.0.0\nc v1.0.0\na v1.0.0 (*)\n");
        assert_eq!(linked.keys().copied().collect::<Vec<_>>(), ["a", "c", "r"]);
        assert_eq!((&linked["r"][..], &linked["a"][..]), (&["a"][..], &["c"][..]));
        assert!(metadata.package("a").is_err_and(|error| error.contains("no package `a`")));
    }
}
