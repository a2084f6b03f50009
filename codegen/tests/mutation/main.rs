//! Every term counts: drop or flip one term of any equation, on either side, and the proof names
//! exactly that term.

mod emitted;
mod pages;
mod sites;

use precess_codegen::page::Page;

/// The hand-checked pages.
fn hand_checked() -> Vec<Page> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/derivation");
    let mut pages = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let page = path.extension().is_some_and(|extension| extension == "md");
        if page && name != "README.md" {
            pages.push(Page { name, text: std::fs::read_to_string(path).unwrap() });
        }
    }
    pages.sort_by(|a, b| a.name.cmp(&b.name));
    pages
}
