//! [`Template`]: a scenario file that is read from the disk once, and into scenarios with other overrides many times.

use std::path::{Path, PathBuf};

use super::diagnostic::{Diagnostics, Numbers};
use super::document::Node;
use super::load::{Override, load_file};
use super::overrides::keys_of;
use super::read::{Read, scenario};

/// The tree of a scenario file with the files it is based on. Tables and structures that it names are read for each
/// scenario.
#[derive(Clone, Debug)]
pub struct Template {
    node: Node,
    path: PathBuf,
    reports: Diagnostics,
}

impl Template {
    /// Reads a scenario file with the files it is based on.
    ///
    /// # Errors
    /// A file that cannot be read, or is not TOML.
    pub fn from_file(path: &Path) -> Result<Self, Diagnostics> {
        let mut reports = Diagnostics::default();
        let node = load_file(path, &mut reports);
        if reports.has_errors() {
            return Err(reports);
        }
        Ok(Self { node, path: path.to_owned(), reports })
    }

    /// The keys that an override's key stands for: itself, or those of `+` and `*`.
    ///
    /// # Errors
    /// Nothing matches; with the names that there are.
    pub fn keys_of(&self, key: &str) -> Result<Vec<String>, String> {
        keys_of(&self.node, key).map_err(|(message, help)| format!("{message}; {help}"))
    }

    /// The scenario with these overrides, as [`from_file`](super::from_file) reads it.
    ///
    /// # Errors
    /// Everything that is wrong, with its places.
    pub fn scenario(&self, overrides: &[Override]) -> Read {
        let stem = self.path.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into());
        let folder = self.path.parent().unwrap_or_else(|| Path::new(""));
        let path = self.path.display().to_string();
        let overrides = (overrides, Numbers::WithUnits);
        scenario(self.node.clone(), (&path, &stem, folder), overrides, self.reports.clone())
    }
}
