//! `demo`: derive, prove, solve the paper's scenario, draw the report.

use crate::regen;
use crate::run::{cargo, root};

/// `regen --check`, then every variant of Table 1, with its figures, into `target/demo`.
pub(crate) fn demo() -> Result<(), String> {
    regen::regen(&regen::Options::check_only())?;
    let variants = variants()?;
    let variants: Vec<_> = variants.iter().map(String::as_str).collect();
    for command in ["run", "plot"] {
        let first = ["run", "--release", "-p", "precess", "--", command];
        let last = ["--out", "target/demo", "--force"];
        cargo(&[&first[..], &variants, &last].concat())?;
    }
    Ok(())
}

/// The scenario files of Table 1, in the order of their names.
fn variants() -> Result<Vec<String>, String> {
    let folder = root().join("scenarios");
    let entries = std::fs::read_dir(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let names = entries.flatten().filter_map(|entry| entry.file_name().into_string().ok());
    let mut variants: Vec<_> = names
        .filter(|name| name.starts_with("table1") && name.ends_with(".toml"))
        .map(|name| format!("scenarios/{name}"))
        .collect();
    variants.sort();
    Ok(variants)
}
