//! Files: read by folder, compared with the files on disk, written all or none.

use std::fs;
use std::io::Error;
use std::path::{Path, PathBuf};

use similar::TextDiff;

use crate::say;

/// Path from the folder that is written, and text.
pub type File<'a> = (&'a str, &'a str);

/// Name and text of the files of a folder that end so, by name.
///
/// # Errors
/// A line that names the folder or the file that cannot be read.
pub fn read_files(folder: &Path, ending: &str) -> Result<Vec<(String, String)>, String> {
    let wrong = |path: &Path, error: &Error| format!("cannot read {}: {error}", path.display());
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).map_err(|error| wrong(folder, &error))? {
        let path = entry.map_err(|error| wrong(folder, &error))?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if path.extension().is_some_and(|extension| extension == ending) {
            let text = fs::read_to_string(&path).map_err(|error| wrong(&path, &error))?;
            files.push((name, text));
        }
    }
    files.sort();
    Ok(files)
}

/// Writes what changed. All text is on disk before the first file is replaced, and nothing is left
/// when some of it cannot be written.
///
/// # Errors
/// A line that names the file that cannot be written.
pub fn write<'a>(files: impl IntoIterator<Item = File<'a>>, into: &Path) -> Result<(), String> {
    let changed = files.into_iter().map(|file| (file, into.join(file.0)));
    let changed: Vec<_> = changed
        .filter(|((_, text), path)| !fs::read_to_string(path).is_ok_and(|there| there == *text))
        .map(|(file, path)| (file, beside(&path), path))
        .collect();
    let written = changed.iter().try_for_each(|((_, text), partial, path)| {
        fs::create_dir_all(path.parent().unwrap_or(into))
            .and_then(|()| fs::write(partial, text))
            .map_err(|error| format!("cannot write {}: {error}", path.display()))
    });
    if written.is_err() {
        for (_, partial, _) in &changed {
            // What was not made cannot be removed, and need not be.
            let _ = fs::remove_file(partial);
        }
        return written;
    }
    for ((name, _), partial, path) in &changed {
        fs::rename(partial, path)
            .map_err(|error| format!("cannot replace {}: {error}", path.display()))?;
        say!("wrote {name}");
    }
    Ok(())
}

/// Removes a folder with all that is in it; one that is not there is none to remove.
///
/// # Errors
/// A line that names the folder that cannot be removed.
pub fn remove_folder(folder: &Path) -> Result<(), String> {
    if !folder.exists() {
        return Ok(());
    }
    fs::remove_dir_all(folder)
        .map_err(|error| format!("cannot remove {}: {error}", folder.display()))
}

/// Where a file is written before it is renamed: a name that no other file has.
fn beside(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".partial");
    PathBuf::from(name)
}

/// Shows the difference from the files on disk; returns how many differ.
pub fn differing<'a>(files: impl IntoIterator<Item = File<'a>>, into: &Path) -> usize {
    let mut stale = 0;
    for (path, text) in files {
        let now = fs::read_to_string(into.join(path)).unwrap_or_default();
        if now != text {
            stale += 1;
            let diff = TextDiff::from_lines(now.as_str(), text);
            let (old, new) = (format!("a/{path}"), format!("b/{path}"));
            say!("{}", diff.unified_diff().header(&old, &new));
        }
    }
    stale
}
