//! The files of a folder.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// The bytes of each file by its name.
pub(crate) fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry"));
    let named = entries.map(|entry| (entry.file_name().into_string().expect("text"), entry.path()));
    named.map(|(name, path)| (name, fs::read(path).expect("a file"))).collect()
}
