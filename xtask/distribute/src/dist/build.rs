//! How a distributed thing is built: by cargo, from sources in a folder, so that its bytes do not depend on that.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::archive;
use super::wrapper;

/// Sources in a folder, and where cargo puts what it builds of them.
pub(super) struct Stage {
    pub(super) sources: PathBuf,
    pub(super) target: PathBuf,
}

impl Stage {
    /// Cargo, or a program that starts it: rust's paths remapped, its hashes replaced, one time.
    pub(super) fn command(&self, program: impl Into<OsString>) -> Result<Command, String> {
        let this = std::env::current_exe().map_err(|error| format!("where am I: {error}"))?;
        let mut flags = vec![format!("--remap-path-prefix={}=precess", self.sources.display())];
        flags.extend(
            registries()
                .iter()
                .map(|folder| format!("--remap-path-prefix={}=crates", folder.display())),
        );
        let mut command = Command::new(program.into());
        command
            // The separator of cargo: a folder may have spaces.
            .env("CARGO_ENCODED_RUSTFLAGS", flags.join("\u{1f}"))
            .env_remove("RUSTFLAGS")
            .env("CARGO_TARGET_DIR", &self.target)
            .env("CARGO_INCREMENTAL", "0")
            .env("RUSTC_WRAPPER", this)
            .env(wrapper::VARIABLE, &self.sources)
            .env("SOURCE_DATE_EPOCH", archive::time().to_string())
            .current_dir(&self.sources);
        Ok(command)
    }

    /// Cargo, in the folder of the sources.
    pub(super) fn cargo(&self) -> Result<Command, String> {
        self.command(program())
    }
}

/// Cargo itself.
pub(super) fn program() -> String {
    std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned())
}

/// Where cargo keeps the sources of other crates.
fn registries() -> Vec<PathBuf> {
    let home = std::env::var_os("CARGO_HOME").map(PathBuf::from);
    let user = || std::env::var_os("HOME").map(|home| Path::new(&home).join(".cargo"));
    let Some(home) = home.or_else(user) else { return Vec::new() };
    let listed = fs::read_dir(home.join("registry/src")).into_iter().flatten().flatten();
    let mut folders: Vec<_> = listed.map(|one| one.path()).collect();
    folders.sort();
    folders
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_of_sources_and_of_other_crates_are_remapped() -> Result<(), String> {
        let stage = Stage { sources: "/a b".into(), target: "/t".into() };
        let command = stage.cargo()?;
        let flags = command.get_envs().find(|(name, _)| *name == "CARGO_ENCODED_RUSTFLAGS");
        let flags = flags.and_then(|(_, value)| value).unwrap_or_default().to_string_lossy();
        assert!(flags.split('\u{1f}').any(|flag| flag == "--remap-path-prefix=/a b=precess"));
        Ok(())
    }
}
