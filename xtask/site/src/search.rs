//! What the search looks through: every section of every page, as a script that sets one variable. A file, not an
//! answer of a server: pages of a disk may not request one.

use serde::Serialize;

use crate::folder::Folder;

/// A section: page, address and title of the page in front of the section's own.
#[derive(Serialize)]
struct Entry<'a>(&'a str, &'a str, &'a str, &'a str, String);

/// The script.
pub(crate) fn script(folder: &Folder) -> Result<String, String> {
    let mut entries = Vec::new();
    for (path, page) in folder.pages() {
        if page.sections.is_empty() {
            entries.push(Entry(path, "", &page.title, "", String::new()));
        }
        for section in &page.sections {
            let text = section.text.split_whitespace().collect::<Vec<_>>().join(" ");
            if !(section.title.is_empty() && text.is_empty()) {
                entries.push(Entry(path, &section.address, &page.title, &section.title, text));
            }
        }
    }
    let entries =
        serde_json::to_string(&entries).map_err(|error| format!("the search: {error}"))?;
    Ok(format!("var SECTIONS = {entries};\n"))
}
