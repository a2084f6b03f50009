//! Results on disk: whole files or none, and nobody else's file touched.
//!
//! A file is written under a temporary name beside its place and then renamed. A list in the folder
//! names the files that runs have written there; a file of a wanted name that is not on the list is
//! somebody else's, and the run is refused before anything is written.

use std::collections::BTreeSet;
use std::fs;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use crate::error::WriteError;

/// The list of files that runs have written into a folder.
pub const LIST: &str = "precess-files.txt";

const HEAD: &str = "# Files written by precess; a later run may replace them, and no others.";

/// A file to be: its name and its content.
pub struct File {
    /// Name, without folder.
    pub name: String,
    /// Content.
    pub content: String,
}

/// Checks that no wanted file is there already unless an earlier run wrote it.
///
/// # Errors
/// The first foreign file, or a folder that cannot be read.
pub fn check<'a>(
    folder: &Path,
    names: impl IntoIterator<Item = &'a str>,
) -> Result<(), WriteError> {
    let ours = listed(folder)?;
    for name in names {
        let path = folder.join(name);
        if !ours.contains(name) && path.symlink_metadata().is_ok() {
            return Err(WriteError::Foreign { path });
        }
    }
    Ok(())
}

/// Writes the files into a folder, which is made if it is missing.
///
/// # Errors
/// As [`check`], and whatever the operating system refuses. Nothing is left half written: until every
/// file is on the disk under its temporary name, none gets its own.
pub fn write(folder: &Path, files: &[File]) -> Result<(), WriteError> {
    check(folder, files.iter().map(|f| f.name.as_str()))?;
    fs::create_dir_all(folder).map_err(|e| failure(folder, e))?;
    let mut names = listed(folder)?;
    names.extend(files.iter().map(|f| f.name.clone()));
    let lines = std::iter::once(HEAD).chain(names.iter().map(String::as_str)).collect::<Vec<_>>();
    let list = File { name: LIST.to_owned(), content: lines.join("\n") + "\n" };
    // The list first: a file of ours is never taken for somebody else's.
    let parts: Vec<_> = std::iter::once(&list)
        .chain(files)
        .map(|file| Part {
            temporary: folder.join(format!(".{}.{}.part", file.name, std::process::id())),
            path: folder.join(&file.name),
            content: file.content.as_bytes(),
        })
        .collect();
    parts.iter().try_for_each(Part::store)?;
    parts.iter().try_for_each(Part::place)
}

/// A file on its way; its temporary name is gone with it.
struct Part<'a> {
    temporary: PathBuf,
    path: PathBuf,
    content: &'a [u8],
}

impl Part<'_> {
    fn store(&self) -> Result<(), WriteError> {
        fs::OpenOptions::new()
            .write(true)
            .create_new(true)
            .open(&self.temporary)
            .and_then(|mut handle| handle.write_all(self.content).and_then(|()| handle.sync_all()))
            .map_err(|e| failure(&self.path, e))
    }

    fn place(&self) -> Result<(), WriteError> {
        fs::rename(&self.temporary, &self.path).map_err(|e| failure(&self.path, e))
    }
}

impl Drop for Part<'_> {
    fn drop(&mut self) {
        // Placed or never stored: then there is nothing to remove, and that is no error.
        let _ = fs::remove_file(&self.temporary);
    }
}

/// Names on the folder's list; none without a list. A list without our head is no list of ours.
fn listed(folder: &Path) -> Result<BTreeSet<String>, WriteError> {
    let path = folder.join(LIST);
    match fs::read_to_string(&path) {
        Ok(text) => {
            let mut lines = text.lines();
            if lines.next() != Some(HEAD) {
                return Err(WriteError::Foreign { path });
            }
            Ok(lines.map(str::to_owned).collect())
        }
        Err(e) if e.kind() == ErrorKind::NotFound => Ok(BTreeSet::new()),
        Err(e) => Err(failure(&path, e)),
    }
}

fn failure(path: &Path, source: std::io::Error) -> WriteError {
    WriteError::Io { path: PathBuf::from(path), source }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("precess-{}-{name}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        folder
    }

    fn file(name: &str, content: &str) -> File {
        File { name: name.into(), content: content.into() }
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).expect("a folder");
        let mut names: Vec<_> = entries
            .map(|e| e.expect("an entry").file_name().into_string().expect("text"))
            .collect();
        names.sort();
        names
    }

    #[test]
    fn a_later_run_replaces_its_own_files_and_leaves_no_parts() {
        let folder = folder("replace");
        write(&folder, &[file("a.csv", "1")]).expect("first");
        write(&folder, &[file("a.csv", "2"), file("b.csv", "3")]).expect("second");
        assert_eq!(fs::read_to_string(folder.join("a.csv")).expect("a.csv"), "2");
        assert_eq!(names(&folder), ["a.csv", "b.csv", LIST]);
        fs::remove_dir_all(&folder).expect("cleanup");
    }

    #[test]
    fn somebody_elses_file_is_refused_and_kept() {
        let folder = folder("foreign");
        fs::create_dir_all(&folder).expect("folder");
        fs::write(folder.join("b.csv"), "mine").expect("b.csv");
        let refused = write(&folder, &[file("a.csv", "1"), file("b.csv", "2")]);
        assert!(matches!(refused, Err(WriteError::Foreign { path }) if path.ends_with("b.csv")));
        assert_eq!(fs::read_to_string(folder.join("b.csv")).expect("b.csv"), "mine");
        assert_eq!(names(&folder), ["b.csv"]);
        fs::remove_dir_all(&folder).expect("cleanup");
    }

    #[test]
    fn a_write_that_fails_leaves_nothing() {
        let folder = folder("fails");
        write(&folder, &[file("a.csv", "1")]).expect("first");
        // No name for a file: the folder it asks for is not there.
        let refused = write(&folder, &[file("a.csv", "2"), file("nowhere/b.csv", "3")]);
        assert!(matches!(refused, Err(WriteError::Io { .. })));
        assert_eq!(fs::read_to_string(folder.join("a.csv")).expect("a.csv"), "1");
        assert_eq!(names(&folder), ["a.csv", LIST]);
        fs::remove_dir_all(&folder).expect("cleanup");
    }

    #[test]
    fn a_folder_that_is_a_file_is_an_error_with_its_path() {
        let folder = folder("file");
        fs::write(&folder, "a file").expect("file");
        let refused = write(&folder, &[file("a.csv", "1")]);
        assert!(matches!(refused, Err(WriteError::Io { .. })));
        fs::remove_file(&folder).expect("cleanup");
    }
}
