//! The hand-checked pages, and the files that follow from them.

use std::path::Path;

use precess_codegen::emit::EmittedFile;
use precess_codegen::page::Page;
use xtask::files::{File, read_files};

/// The pages of a folder by name; its README describes them and is none.
pub(crate) fn read_pages(folder: &Path) -> Result<Vec<Page>, String> {
    let mut pages = read_texts(folder, "md")?;
    pages.retain(|page| page.name != "README.md");
    if pages.is_empty() {
        return Err(format!("no hand-checked pages (*.md) in {}", folder.display()));
    }
    Ok(pages)
}

/// The files of a folder that end so, by name.
pub(crate) fn read_texts(folder: &Path, ending: &str) -> Result<Vec<Page>, String> {
    let files = read_files(folder, ending)?;
    Ok(files.into_iter().map(|(name, text)| Page { name, text }).collect())
}

/// Path and text of each.
pub(crate) fn texts(files: &[EmittedFile]) -> impl Iterator<Item = File<'_>> {
    files.iter().map(|file| (file.path.as_str(), file.text.as_str()))
}
