//! Files: read by folder, compared with the files on disk, written all or none.

use std::fs;
use std::io::Error;
use std::path::{Path, PathBuf};

use precess_codegen::emit::EmittedFile;
use precess_codegen::page::Page;
use precess_review::report::BUILT;
use similar::TextDiff;

use crate::run::say;

/// The pages of a folder by name; its README describes them and is none.
pub(crate) fn read_pages(folder: &Path) -> Result<Vec<Page>, String> {
    let mut pages = read_files(folder, "md")?;
    pages.retain(|page| page.name != "README.md");
    if pages.is_empty() {
        return Err(format!("no hand-checked pages (*.md) in {}", folder.display()));
    }
    Ok(pages)
}

/// The files of a folder that end so, by name.
pub(crate) fn read_files(folder: &Path, ending: &str) -> Result<Vec<Page>, String> {
    let wrong = |path: &Path, error: &Error| format!("cannot read {}: {error}", path.display());
    let mut pages = Vec::new();
    for entry in fs::read_dir(folder).map_err(|error| wrong(folder, &error))? {
        let path = entry.map_err(|error| wrong(folder, &error))?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if path.extension().is_some_and(|extension| extension == ending) {
            let text = fs::read_to_string(&path).map_err(|error| wrong(&path, &error))?;
            pages.push(Page { name, text });
        }
    }
    pages.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(pages)
}

/// Those of the files that are committed, and so can be stale; pages for a browser are only built.
pub(crate) fn committed(mut files: Vec<EmittedFile>) -> Vec<EmittedFile> {
    files.retain(|file| !file.path.starts_with(BUILT));
    files
}

/// Writes what changed. All text is on disk before the first file is replaced, and nothing is left
/// left when some of it cannot be written.
pub(crate) fn write(files: &[EmittedFile], into: &Path) -> Result<(), String> {
    let changed = files.iter().map(|file| (file, into.join(&file.path)));
    let changed: Vec<_> = changed
        .filter(|(file, path)| !fs::read_to_string(path).is_ok_and(|text| text == file.text))
        .map(|(file, path)| (file, beside(&path), path))
        .collect();
    let written = changed.iter().try_for_each(|(file, partial, path)| {
        fs::create_dir_all(path.parent().unwrap_or(into))
            .and_then(|()| fs::write(partial, &file.text))
            .map_err(|error| format!("cannot write {}: {error}", path.display()))
    });
    if written.is_err() {
        for (_, partial, _) in &changed {
            // What was not made cannot be removed, and need not be.
            let _ = fs::remove_file(partial);
        }
        return written;
    }
    for (file, partial, path) in &changed {
        fs::rename(partial, path)
            .map_err(|error| format!("cannot replace {}: {error}", path.display()))?;
        say!("wrote {}", file.path);
    }
    Ok(())
}

/// Where a file is written before it is renamed: a name that no other file has.
fn beside(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".partial");
    PathBuf::from(name)
}

/// Shows the difference from the files on disk; returns how many differ.
pub(crate) fn differing(files: &[EmittedFile], into: &Path) -> usize {
    let mut stale = 0;
    for file in files {
        let now = fs::read_to_string(into.join(&file.path)).unwrap_or_default();
        if now != file.text {
            stale += 1;
            let diff = TextDiff::from_lines(&now, &file.text);
            let (old, new) = (format!("a/{}", file.path), format!("b/{}", file.path));
            say!("{}", diff.unified_diff().header(&old, &new));
        }
    }
    stale
}
