//! The files of the site before any is written: pages with their sections, and what they show.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use xtask::files::remove_folder;

/// A heading of a page with the text below it, for the search.
pub(crate) struct Section {
    /// The address of the heading in its page; empty at the page's beginning.
    pub(crate) address: String,
    pub(crate) title: String,
    pub(crate) text: String,
}

/// A page.
pub(crate) struct Page {
    pub(crate) title: String,
    pub(crate) sections: Vec<Section>,
}

/// Files by their paths from the site's root.
#[derive(Default)]
pub(crate) struct Folder {
    files: BTreeMap<String, Vec<u8>>,
    pages: BTreeMap<String, Page>,
}

impl Folder {
    /// Adds a page.
    pub(crate) fn page(&mut self, path: &str, html: String, page: Page) {
        self.text(path, html);
        self.pages.insert(path.to_owned(), page);
    }

    /// Adds a text.
    pub(crate) fn text(&mut self, path: &str, text: String) {
        self.bytes(path, text.into_bytes());
    }

    /// Adds any file.
    pub(crate) fn bytes(&mut self, path: &str, bytes: Vec<u8>) {
        self.files.insert(path.to_owned(), bytes);
    }

    /// The pages in the order of their paths.
    pub(crate) fn pages(&self) -> impl Iterator<Item = (&str, &Page)> {
        self.pages.iter().map(|(path, page)| (path.as_str(), page))
    }

    /// Whether there is such a file.
    pub(crate) fn has(&self, path: &str) -> bool {
        self.files.contains_key(path)
    }

    /// The text of a page.
    pub(crate) fn html(&self, path: &str) -> &str {
        self.files.get(path).and_then(|bytes| std::str::from_utf8(bytes).ok()).unwrap_or_default()
    }

    /// Writes everything beside the folder, with the Rust reference in `rust`, and then replaces it. A folder that is no
    /// site is left as it is.
    pub(crate) fn write(&self, out: &Path, rust: Option<&Path>) -> Result<(), String> {
        let is_a_site = out.join("search.js").is_file();
        let is_empty = fs::read_dir(out).map_or(true, |mut entries| entries.next().is_none());
        if out.exists() && !is_a_site && !is_empty {
            let out = out.display();
            return Err(format!(
                "{out} has files and is no site; name an empty folder or a new one"
            ));
        }
        let mut partial = out.as_os_str().to_owned();
        partial.push(".partial");
        let partial = Path::new(&partial);
        remove_folder(partial)?;
        let written =
            self.files.iter().try_for_each(|(path, bytes)| put(&partial.join(path), bytes));
        let written =
            written.and_then(|()| rust.map_or(Ok(()), |rust| copy(rust, &partial.join("rust"))));
        if let Err(error) = written {
            remove_folder(partial)?;
            return Err(error);
        }
        remove_folder(out)?;
        fs::rename(partial, out).map_err(|error| format!("cannot write {}: {error}", out.display()))
    }
}

/// Paths of all files below a folder, as they are below `rust`.
pub(crate) fn files_below(folder: &Path) -> Result<Vec<String>, String> {
    fn add(folder: &Path, from: &str, paths: &mut Vec<String>) -> std::io::Result<()> {
        for entry in fs::read_dir(folder)? {
            let entry = entry?;
            let path = format!("{from}/{}", entry.file_name().to_string_lossy());
            if entry.file_type()?.is_dir() {
                add(&entry.path(), &path, paths)?;
            } else {
                paths.push(path);
            }
        }
        Ok(())
    }
    let mut paths = Vec::new();
    add(folder, "rust", &mut paths)
        .map_err(|error| format!("cannot read {}: {error}", folder.display()))?;
    paths.sort();
    Ok(paths)
}

fn put(path: &Path, bytes: &[u8]) -> Result<(), String> {
    let folder = path.parent().unwrap_or(path);
    fs::create_dir_all(folder)
        .and_then(|()| fs::write(path, bytes))
        .map_err(|error| format!("cannot write {}: {error}", path.display()))
}

fn copy(from: &Path, into: &Path) -> Result<(), String> {
    for path in files_below(from)? {
        let below = path.strip_prefix("rust/").unwrap_or(&path);
        let bytes = fs::read(from.join(below));
        put(&into.join(below), &bytes.map_err(|error| format!("cannot read {path}: {error}"))?)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_site_is_replaced_and_nothing_else() {
        let place = tempfile::tempdir().unwrap();
        let out = place.path().join("site");
        let mut folder = Folder::default();
        folder.text("search.js", String::new());
        folder.text("docs/a.html", "a".to_owned());
        folder.write(&out, None).unwrap();
        fs::write(out.join("stale.html"), "").unwrap();
        folder.write(&out, None).unwrap();
        assert!(!out.join("stale.html").exists() && out.join("docs/a.html").is_file());

        let mine = place.path().join("mine");
        put(&mine.join("thesis.tex"), b"mine").unwrap();
        let error = folder.write(&mine, None).unwrap_err();
        assert!(error.contains("is no site"), "{error}");
        assert_eq!(fs::read(mine.join("thesis.tex")).unwrap(), b"mine");
    }
}
