//! Sources: the files that git tracks, as an archive, and laid out in a folder to build from.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::archive::{Content, Entry};
use xtask::run::{output, root};

/// Every tracked file as it is on disk now.
pub(super) fn tracked() -> Result<Vec<Entry>, String> {
    let listed = output(Command::new("git").args(["ls-files", "-z"]).current_dir(root()))?;
    listed.split_terminator('\0').map(|path| entry(&root(), path)).collect()
}

/// A file or link of a folder.
pub(super) fn entry(folder: &Path, path: &str) -> Result<Entry, String> {
    let full = folder.join(path);
    let wrong = |error| format!("cannot read {}: {error}", full.display());
    let metadata = fs::symlink_metadata(&full).map_err(wrong)?;
    let content = if metadata.is_symlink() {
        Content::Link(fs::read_link(&full).map_err(wrong)?.to_string_lossy().into_owned())
    } else {
        Content::File { bytes: fs::read(&full).map_err(wrong)?, executable: executable(&metadata) }
    };
    Ok(Entry { path: path.to_owned(), content })
}

/// Makes a folder have these entries and, but for those that it keeps, no others. What has not changed keeps
/// its time: cargo compares times.
pub(super) fn lay_out(entries: &[Entry], folder: &Path, keep: &[&str]) -> Result<(), String> {
    let wanted: BTreeSet<_> = entries.iter().map(|entry| folder.join(&entry.path)).collect();
    for path in files(folder, keep)? {
        if !wanted.contains(&path) {
            fs::remove_file(&path)
                .map_err(|error| format!("cannot remove {}: {error}", path.display()))?;
        }
    }
    entries.iter().try_for_each(|one| {
        let path = folder.join(&one.path);
        if entry(folder, &one.path).is_ok_and(|found| found == *one) {
            return Ok(());
        }
        fs::create_dir_all(path.parent().unwrap_or(folder))
            .and_then(|()| put(&one.content, &path))
            .map_err(|error| format!("cannot write {}: {error}", path.display()))
    })
}

/// Every file and link below a folder, but for those in the folders directly below it that it keeps.
fn files(folder: &Path, keep: &[&str]) -> Result<Vec<PathBuf>, String> {
    let mut found = Vec::new();
    let Ok(listed) = fs::read_dir(folder) else { return Ok(found) };
    for one in listed {
        let one = one.map_err(|error| format!("cannot list {}: {error}", folder.display()))?;
        let kept = keep.iter().any(|name| one.file_name() == *name);
        if one.file_type().is_ok_and(|kind| kind.is_dir()) {
            found.extend(if kept { Vec::new() } else { files(&one.path(), &[])? });
        } else if !kept {
            found.push(one.path());
        }
    }
    Ok(found)
}

/// Writes a file or a link where there may be another.
fn put(content: &Content, path: &Path) -> std::io::Result<()> {
    if fs::symlink_metadata(path).is_ok() {
        fs::remove_file(path)?;
    }
    match content {
        Content::File { bytes, executable } => {
            fs::write(path, bytes)?;
            if *executable { make_executable(path) } else { Ok(()) }
        }
        Content::Link(to) => link(to, path),
    }
}

#[cfg(unix)]
fn executable(metadata: &fs::Metadata) -> bool {
    use std::os::unix::fs::PermissionsExt as _;
    metadata.permissions().mode() & 0o100 != 0
}

#[cfg(unix)]
fn make_executable(path: &Path) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt as _;
    fs::set_permissions(path, fs::Permissions::from_mode(0o755))
}

#[cfg(unix)]
fn link(to: &str, path: &Path) -> std::io::Result<()> {
    std::os::unix::fs::symlink(to, path)
}

#[cfg(not(unix))]
fn executable(_: &fs::Metadata) -> bool {
    false
}

#[cfg(not(unix))]
fn make_executable(_: &Path) -> std::io::Result<()> {
    Ok(())
}

/// Without links, the file that the link leads to.
#[cfg(not(unix))]
fn link(to: &str, path: &Path) -> std::io::Result<()> {
    fs::copy(path.with_file_name(to), path).map(|_| ())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_is_made_to_have_the_entries_and_what_it_keeps() -> Result<(), String> {
        let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
        let kept = [Entry::file("target/kept", "k"), Entry::file("old/gone", "g")];
        lay_out(&kept, folder.path(), &[])?;
        let entries = [Entry::file("a/b", "text"), Entry::link("c", "a/b")];
        lay_out(&entries, folder.path(), &["target"])?;
        let found: Result<Vec<_>, _> =
            entries.iter().map(|one| entry(folder.path(), &one.path)).collect();
        assert_eq!(found?, entries);
        assert!(folder.path().join("target/kept").exists());
        assert!(!folder.path().join("old/gone").exists());
        Ok(())
    }
}
