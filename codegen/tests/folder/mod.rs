//! The pages of a folder, as the tests read them, inside the crate and outside: `Page` is what the
//! parent module calls by that name.

use std::path::Path;

use super::Page;

/// The pages of `tests/derivation` or of a folder in it, by name; a README is none.
pub(crate) fn pages(folder: &str) -> Vec<Page> {
    // From the folder of either crate of the generator.
    let mut above = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().skip(1);
    let pages = above.find_map(|path| Some(path.join("tests/derivation")).filter(|p| p.is_dir()));
    let folder = pages.expect("the pages are in the repository").join(folder);
    let mut pages = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.extension().is_some_and(|extension| extension == "md") && name != "README.md" {
            pages.push(Page { name, text: std::fs::read_to_string(path).unwrap() });
        }
    }
    pages.sort_by(|a, b| a.name.cmp(&b.name));
    pages
}
