//! The equations as printed: the machine's verdict on each block must be what its notes say.

use precess_codegen::page::Page;
use precess_codegen::regen::as_printed;

fn pages(folder: &str) -> Vec<Page> {
    let folder = format!("{}/../tests/derivation{folder}", env!("CARGO_MANIFEST_DIR"));
    let mut pages = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.extension().is_some_and(|e| e == "md") && name != "README.md" {
            pages.push(Page { name, text: std::fs::read_to_string(path).unwrap() });
        }
    }
    pages.sort_by(|a, b| a.name.cmp(&b.name));
    pages
}

/// Equal only for a balanced device, which is what the paper says of them; (125) chooses values.
const SPECIAL: [&str; 4] = ["(18)", "(19)", "(65)", "(125)"];

#[test]
fn a_block_agrees_exactly_when_its_notes_say_so() {
    let (printed, rows) = as_printed(&pages(""), &pages("/printed")).unwrap();
    let stated = printed.iter().filter(|block| !block.is_words());
    let mut wrong = Vec::new();
    for (block, row) in stated.zip(&rows) {
        let differs = block.notes.iter().any(|note| note.changes_value);
        if differs == row.holds() && !SPECIAL.contains(&block.tag.as_str()) {
            wrong.push(format!("{} {}", block.tag, block.name));
        }
    }
    assert!(rows.len() > 100, "only {} blocks", rows.len());
    assert!(wrong.is_empty(), "notes and verdict differ: {wrong:?}");
}
