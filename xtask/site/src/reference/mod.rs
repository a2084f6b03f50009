//! References: of Rust by rustdoc, of Python from the docstrings of the package, of C from the headers of the library.
//! The list of pages names each by the folder or the file that it is made from.

mod c;
mod python;
pub(crate) mod rust;

use std::path::Path;

use crate::folder::{Folder, Page};
use crate::markdown::Rendered;
use crate::page::Layout;

/// What the list names, and the page that it becomes.
const MADE: [(&str, &str); 3] = [
    (rust::SOURCE, "rust/index.html"),
    (python::SOURCE, "python/index.html"),
    (c::SOURCE, "c/index.html"),
];

/// Whether a source of the list becomes a reference.
pub(crate) fn is_made(source: &str) -> bool {
    path(source).is_some()
}

/// The page of a reference.
pub(crate) fn path(source: &str) -> Option<&'static str> {
    MADE.iter().find(|(from, _)| *from == source).map(|(_, page)| *page)
}

/// Writes the references.
pub(crate) fn pages(
    root: &Path,
    layout: &Layout,
    with_rust: bool,
    folder: &mut Folder,
) -> Result<(), String> {
    let mut add = |path: &str, source: &str, title: &str, rendered: Rendered| {
        let html = layout.page(path, source, title, &rendered)?;
        folder.page(path, html, Page { title: title.to_owned(), sections: rendered.sections });
        Ok(())
    };
    add("rust/index.html", rust::SOURCE, "Rust", rust::contents(with_rust))?;
    python::pages(root, &mut add)?;
    c::pages(root, &mut add)
}

/// Takes a page: its path, source, title and text.
type Add<'a> = dyn FnMut(&str, &str, &str, Rendered) -> Result<(), String> + 'a;
