//! The Rust reference, by rustdoc: pages, search and fonts of its own, without network.

use std::path::PathBuf;
use std::process::Command;

use xtask::files::remove_folder;
use xtask::run::{program, run, target};

use crate::folder::Section;
use crate::markdown::{Heading, Rendered};

/// What the list names it by.
pub(crate) const SOURCE: &str = "dynamics/src/lib.rs";

/// The crates that others use, and what each is for.
const CRATES: [(&str, &str, &str); 5] = [
    (
        "precess-dynamics",
        "precess_dynamics",
        "the solver, without the standard library and without a heap",
    ),
    (
        "precess-control",
        "precess_control",
        "loops of a sampled controller: margins, poles, filters",
    ),
    ("precess", "precess", "scenarios, runs, reports, campaigns: the desktop tool as a library"),
    (
        "precess-codegen",
        "precess_codegen",
        "derivation, proof and emission, for kinds of one's own",
    ),
    ("precess-bake", "precess_bake", "kernels of one spacecraft"),
];

/// Documents the crates; returns the folder.
pub(crate) fn documented() -> Result<PathBuf, String> {
    let folder = target()?.join("doc");
    // Crates that were documented for another purpose would be listed.
    remove_folder(&folder)?;
    let mut cargo = Command::new(program());
    // A link that leads nowhere is an error here too.
    cargo.env("RUSTDOCFLAGS", "--deny warnings");
    cargo.args(["doc", "--no-deps", "--quiet", "--lib", "--all-features"]);
    run(cargo.args(CRATES.iter().flat_map(|(package, _, _)| ["--package", *package])))?;
    Ok(folder)
}

/// The page in front of it.
pub(crate) fn contents(with_rust: bool) -> Rendered {
    let mut body = "<h1 id=\"rust\">Rust</h1>\n<ul>\n".to_owned();
    let mut text = String::new();
    for (package, folder, purpose) in CRATES {
        let name = if with_rust {
            format!("<a href=\"{folder}/index.html\"><code>{package}</code></a>")
        } else {
            format!("<code>{package}</code>")
        };
        put!(body, "<li>{name}: {purpose}</li>\n");
        put!(text, "{package}: {purpose} ");
    }
    body.push_str("</ul>\n");
    body.push_str(if with_rust {
        "<p>These pages have a search of their own, by names and by types.</p>\n"
    } else {
        "<p>This copy was made without them: <code>cargo xtask site</code> without <code>--quick</code> has them.</p>\n"
    });
    let heading = Heading::new(1, "rust", "Rust");
    let section = Section { address: "rust".to_owned(), title: "Rust".to_owned(), text };
    Rendered { body, headings: vec![heading], sections: vec![section] }
}
