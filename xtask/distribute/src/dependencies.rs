//! `dependencies`: the crates of every workspace against `deny.toml`: licences, bans, sources. cargo-deny reads the same
//! file, and beyond this looks for advisories, which needs the network.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::process::Command;

use serde::Deserialize;
use spdx::{Expression, LicenseReq, ParseMode};
use xtask::run::{program, root};
use xtask::say;

use crate::crates_of::Metadata;

/// The rules.
const RULES: &str = "deny.toml";

/// Every workspace.
const WORKSPACES: [&str; 5] = [
    "Cargo.toml",
    "flight/Cargo.toml",
    "flight/firmware/Cargo.toml",
    "python/Cargo.toml",
    "sim/fuzz/Cargo.toml",
];

/// What is read of the rules: a key that is not here would be heeded by nobody, and is an error.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Rules {
    graph: Graph,
    licenses: Licences,
    bans: Bans,
    sources: Sources,
}

/// Which crates are looked at.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Graph {
    all_features: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Licences {
    allow: BTreeSet<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Bans {
    multiple_versions: Severity,
    skip: Vec<Named>,
    deny: Vec<Named>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Sources {
    unknown_registry: Severity,
    unknown_git: Severity,
    allow_registry: BTreeSet<String>,
}

/// A crate, with why it is here.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Named {
    #[serde(rename = "crate")]
    name: String,
    #[serde(rename = "reason")]
    _reason: String,
}

/// How severe a breach is. There is one: a warning is read by nobody.
#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
enum Severity {
    Deny,
}

/// Checks all workspaces.
pub(crate) fn dependencies() -> Result<(), String> {
    let text = fs::read_to_string(root().join(RULES));
    let text = text.map_err(|error| format!("cannot read {RULES}: {error}"))?;
    let rules: Rules = toml::from_str(&text).map_err(|error| format!("{RULES}: {error}"))?;
    let (mut breaches, mut crates, mut used) = (Vec::new(), BTreeSet::new(), BTreeSet::new());
    for manifest in WORKSPACES {
        let mut cargo = Command::new(program());
        cargo.current_dir(root());
        let options: &[&str] = if rules.graph.all_features { &["--all-features"] } else { &[] };
        let metadata = Metadata::read(cargo, manifest, options)?;
        let found = check(&metadata, &rules, &mut used)?;
        breaches.extend(found.into_iter().map(|breach| format!("{manifest}: {breach}")));
        let others = metadata.crates().filter(|one| one.source.is_some());
        crates.extend(others.map(|one| format!("{} {}", one.name, one.version)));
    }
    let idle: Vec<_> = rules.licenses.allow.difference(&used).collect();
    if !idle.is_empty() {
        breaches.push(format!("{RULES} allows {idle:?}, which no crate needs; take them away"));
    }
    if breaches.is_empty() {
        let (crates, workspaces) = (crates.len(), WORKSPACES.len());
        say!("{crates} crates of {workspaces} workspaces hold to {RULES}: licences, bans, sources");
        return Ok(());
    }
    Err(format!("{} breaches of {RULES}:\n{}", breaches.len(), breaches.join("\n")))
}

/// What breaks the rules. Adds the licences by which crates are allowed.
fn check(
    metadata: &Metadata,
    rules: &Rules,
    used: &mut BTreeSet<String>,
) -> Result<Vec<String>, String> {
    let mut breaches = Vec::new();
    let mut versions: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    let Severity::Deny = rules.sources.unknown_registry;
    let Severity::Deny = rules.sources.unknown_git;
    for one in metadata.crates() {
        let Some(source) = one.source else { continue };
        let name = format!("{} {}", one.name, one.version);
        versions.entry(one.name).or_default().insert(one.version);
        if rules.bans.deny.iter().any(|banned| banned.name == one.name) {
            breaches.push(format!("{name} is banned"));
        }
        let registry = source.strip_prefix("registry+").unwrap_or_default();
        if !rules.sources.allow_registry.contains(registry) {
            breaches.push(format!("{name} comes from {source}"));
        }
        let expression = Expression::parse_mode(one.licence, ParseMode::LAX)
            .map_err(|error| format!("the licence of {name}: {error}"))?;
        let allowed = |wanted: &LicenseReq| rules.licenses.allow.contains(&wanted.to_string());
        if !expression.evaluate(allowed) {
            breaches.push(format!("{name} has the licence {}", one.licence));
        }
        let wanted = expression.requirements().map(|wanted| wanted.req.to_string());
        used.extend(wanted.filter(|wanted| rules.licenses.allow.contains(wanted)));
    }
    let Severity::Deny = rules.bans.multiple_versions;
    for (name, versions) in versions.into_iter().filter(|(_, versions)| versions.len() > 1) {
        if !rules.bans.skip.iter().any(|skipped| skipped.name == name) {
            breaches.push(format!("{name} is there in versions {versions:?}"));
        }
    }
    Ok(breaches)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crates_of::tests::metadata;

    const TEXT: &str = "[graph]\nall-features = true\n[licenses]\nallow = [\"MIT\", \"GPL-3.0\"]\n[bans]\nmultiple-versions = \"deny\"\nskip = []\n\
                        deny = []\n[sources]\nunknown-registry = \"deny\"\nunknown-git = \"deny\"\n\
                        allow-registry = [\"https://github.com/rust-lang/crates.io-index\"]\n";

    fn breaches(rules: &str) -> Vec<String> {
        check(&metadata(), &toml::from_str(rules).unwrap(), &mut BTreeSet::new()).unwrap()
    }

    #[test]
    fn each_rule_is_heeded() {
        assert_eq!(breaches(TEXT), Vec::<String>::new());
        assert_eq!(
            breaches(&TEXT.replace(", \"GPL-3.0\"", "")),
            ["b 1.0.0 has the licence GPL-3.0"]
        );
        let banned = TEXT.replace("deny = []", "deny = [{ crate = \"d\", reason = \"none\" }]");
        assert_eq!(breaches(&banned), ["d 1.0.0 is banned"]);
        assert_eq!(breaches(&TEXT.replace("crates.io", "own.io")).len(), 4);
    }

    #[test]
    fn a_rule_that_nobody_would_heed_is_an_error() {
        for (a, b) in
            [("skip = []", "skip = []\nwildcards = \"deny\""), ("\"deny\"\nskip", "\"warn\"\nskip")]
        {
            assert!(toml::from_str::<Rules>(&TEXT.replace(a, b)).is_err(), "{b}");
        }
    }
}
