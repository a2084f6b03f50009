//! Results on disk: whole files, and nobody else's touched.
//!
//! Every file is written whole under a free name in the same folder ("a part"), and only
//! when all of them are on the disk is the first one renamed. So each file is whole at any time:
//! the earlier run's or the new one's. A program killed between two renames leaves a mix of both,
//! whole files all the same; one killed before leaves parts, which block nothing and which a later
//! run removes.
//!
//! A list in the folder names the files that runs have written there; a file of a wanted name that
//! is not on the list is somebody else's, and the run is rejected before anything is written.

use std::collections::BTreeSet;
use std::fs::{self, OpenOptions};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use tempfile::{Builder, NamedTempFile, TempPath};

use crate::error::WriteError;

/// The list of files that runs have written into a folder.
pub const LIST: &str = "precess-files.txt";

const HEAD: &str = "# Files written by precess; a later run may replace them, and no others.";

/// A part is called this, six letters or digits, and [`PART`].
const PREFIX: &str = ".precess-";
const PART: &str = ".part";
/// A part lives for as long as it takes to write all of them, seconds at most; one this old was
/// left by a program that was killed.
const STALE: Duration = Duration::from_secs(3600);

/// A file to be: its name and its content.
pub struct File {
    /// Name, without folder.
    pub name: String,
    /// Content.
    pub content: String,
}

/// Makes the folder if it is missing, and tries whether files of these names can be written there.
///
/// Called before the work: what it finds would otherwise be found after it.
///
/// # Errors
/// The first name that is taken by a folder, or by a file that no earlier run wrote; a folder that
/// cannot be made, read or written.
pub fn prepare<'a>(
    folder: &Path,
    names: impl IntoIterator<Item = &'a str>,
) -> Result<(), WriteError> {
    check(folder, names)?;
    fs::create_dir_all(folder).map_err(|e| failure(folder, e))?;
    part(folder).map(drop).map_err(|e| failure(folder, e))
}

/// Writes the files into a folder, which is made if it is missing.
///
/// # Errors
/// As [`prepare`], and any other error of the operating system. Until every file is on the disk
/// as a part, none gets its name; of a rename that fails, only the files before it are replaced.
pub fn write(folder: &Path, files: &[File]) -> Result<(), WriteError> {
    prepare(folder, files.iter().map(|f| f.name.as_str()))?;
    sweep(folder);
    let mut names = listed(folder)?;
    names.extend(files.iter().map(|f| f.name.clone()));
    let lines = std::iter::once(HEAD).chain(names.iter().map(String::as_str)).collect::<Vec<_>>();
    let list = File { name: LIST.to_owned(), content: lines.join("\n") + "\n" };
    // The list first: a file of ours is never taken for somebody else's.
    let parts = std::iter::once(&list)
        .chain(files)
        .map(|file| {
            let path = folder.join(&file.name);
            let beside = path.parent().unwrap_or(folder);
            let stored = store(beside, &file.content).map_err(|e| failure(&path, e))?;
            Ok((stored, path))
        })
        .collect::<Result<Vec<_>, WriteError>>()?;
    for (stored, path) in parts {
        stored.persist(&path).map_err(|e| failure(&path, e.error))?;
    }
    Ok(())
}

/// Checks that no wanted file is there already unless an earlier run wrote it.
fn check<'a>(folder: &Path, names: impl IntoIterator<Item = &'a str>) -> Result<(), WriteError> {
    let ours = listed(folder)?;
    for name in names {
        let path = folder.join(name);
        let there = path.symlink_metadata();
        if there.is_ok_and(|there| there.is_dir() || !ours.contains(name)) {
            return Err(WriteError::Foreign { path });
        }
    }
    Ok(())
}

/// An empty part, gone when it is dropped. It is opened as any new file, so whoever may read the
/// folder's other files may read it.
fn part(folder: &Path) -> std::io::Result<NamedTempFile> {
    Builder::new()
        .prefix(PREFIX)
        .suffix(PART)
        .make_in(folder, |path| OpenOptions::new().write(true).create_new(true).open(path))
}

/// A part on the disk with its content.
fn store(folder: &Path, content: &str) -> std::io::Result<TempPath> {
    let mut part = part(folder)?;
    part.write_all(content.as_bytes())?;
    part.as_file().sync_all()?;
    Ok(part.into_temp_path())
}

/// Removes the parts that killed programs left; one that cannot be removed harms nothing.
fn sweep(folder: &Path) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let ours = name.to_str().is_some_and(|n| n.starts_with(PREFIX) && n.ends_with(PART));
        // Of the entry itself, not of what it may point to.
        let stale = entry.metadata().is_ok_and(|m| {
            let age = m.modified().ok().and_then(|time| time.elapsed().ok());
            m.is_file() && age.is_some_and(|age| age > STALE)
        });
        if ours && stale {
            let _ = fs::remove_file(entry.path());
        }
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
    use std::time::SystemTime;

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
    fn somebody_elses_file_is_rejected_and_kept() {
        let folder = folder("foreign");
        fs::create_dir_all(&folder).expect("folder");
        fs::write(folder.join("b.csv"), "mine").expect("b.csv");
        let rejected = write(&folder, &[file("a.csv", "1"), file("b.csv", "2")]);
        assert!(matches!(rejected, Err(WriteError::Foreign { path }) if path.ends_with("b.csv")));
        assert_eq!(fs::read_to_string(folder.join("b.csv")).expect("b.csv"), "mine");
        assert_eq!(names(&folder), ["b.csv"]);
        fs::remove_dir_all(&folder).expect("cleanup");
    }

    #[test]
    fn a_write_that_fails_leaves_what_was_there_and_no_parts() {
        let folder = folder("fails");
        write(&folder, &[file("a.csv", "1")]).expect("first");
        // No name for a file: its folder is missing.
        let rejected = write(&folder, &[file("a.csv", "2"), file("nowhere/b.csv", "3")]);
        assert!(matches!(rejected, Err(WriteError::Io { path, .. }) if path.ends_with("b.csv")));
        assert_eq!(fs::read_to_string(folder.join("a.csv")).expect("a.csv"), "1");
        assert_eq!(names(&folder), ["a.csv", LIST]);
        fs::remove_dir_all(&folder).expect("cleanup");
    }

    #[test]
    fn a_part_left_behind_blocks_nothing_and_only_a_stale_one_of_ours_is_removed() {
        let folder = folder("part");
        fs::create_dir_all(&folder).expect("folder");
        let long_ago = SystemTime::now() - 2 * STALE;
        let (stale, fresh, theirs) =
            (".precess-Ab3xYz.part", ".precess-Cd4uVw.part", ".a.csv.77.part");
        for (name, time) in [(stale, long_ago), (fresh, SystemTime::now()), (theirs, long_ago)] {
            let left = fs::File::create(folder.join(name)).expect("a part");
            left.set_modified(time).expect("its time");
        }
        write(&folder, &[file("a.csv", "1")]).expect("a new folder");
        assert_eq!(fs::read_to_string(folder.join("a.csv")).expect("a.csv"), "1");
        assert_eq!(names(&folder), [theirs, fresh, "a.csv", LIST]);
        fs::remove_dir_all(&folder).expect("cleanup");
    }

    #[test]
    fn a_folder_under_a_wanted_name_is_rejected() {
        let folder = folder("taken");
        write(&folder, &[file("a.csv", "1")]).expect("first");
        fs::remove_file(folder.join("a.csv")).expect("a.csv");
        fs::create_dir(folder.join("a.csv")).expect("a folder instead");
        let rejected = prepare(&folder, ["a.csv"]);
        assert!(matches!(rejected, Err(WriteError::Foreign { path }) if path.ends_with("a.csv")));
        fs::remove_dir_all(&folder).expect("cleanup");
    }

    #[test]
    fn preparing_makes_the_folder_and_leaves_it_empty() {
        let folder = folder("prepare");
        prepare(&folder.join("deep"), ["a.csv"]).expect("a folder can be made");
        assert!(names(&folder.join("deep")).is_empty());
        fs::remove_dir_all(&folder).expect("cleanup");
    }

    /// A link to nowhere: it can be neither read as a folder nor made one.
    #[cfg(unix)]
    #[test]
    fn a_folder_that_cannot_be_made_is_found_before_the_work() {
        let folder = folder("link");
        let _ = fs::remove_file(&folder);
        std::os::unix::fs::symlink("nowhere-at-all", &folder).expect("a link");
        let rejected = prepare(&folder, ["a.csv"]);
        assert!(matches!(rejected, Err(WriteError::Io { path, .. }) if path == folder));
        fs::remove_file(&folder).expect("cleanup");
    }

    /// As the shell would make it: 0666 less the umask, which no test can count on but as equality.
    #[cfg(unix)]
    #[test]
    fn a_result_may_be_read_by_whom_any_new_file_may() {
        use std::os::unix::fs::PermissionsExt;
        let folder = folder("mode");
        write(&folder, &[file("a.csv", "1")]).expect("first");
        fs::write(folder.join("any"), "").expect("any new file");
        let mode =
            |name: &str| fs::metadata(folder.join(name)).expect("a file").permissions().mode();
        assert_eq!(mode("a.csv"), mode("any"));
        fs::remove_dir_all(&folder).expect("cleanup");
    }

    #[test]
    fn a_folder_that_is_a_file_is_an_error_with_its_path() {
        let folder = folder("file");
        fs::write(&folder, "a file").expect("file");
        let rejected = write(&folder, &[file("a.csv", "1")]);
        assert!(matches!(rejected, Err(WriteError::Io { .. })));
        fs::remove_file(&folder).expect("cleanup");
    }
}
