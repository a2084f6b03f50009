//! `site`: the documents, the references and the notebooks as one folder of pages with search, which opens from a disk.
//!
//! A page is where its source is in the repository: `docs/guide.md` becomes `docs/guide.html`. Files that pages link to
//! are pages too. Same sources, same bytes; a link that leads nowhere is an error, and then nothing is written.

/// Adds to a text, which takes everything.
macro_rules! put {
    ($into:expr, $($text:tt)*) => {
        // A text cannot refuse.
        let _ = std::fmt::Write::write_fmt(&mut $into, format_args!($($text)*));
    };
}

mod folder;
mod links;
mod markdown;
mod navigation;
mod notebook;
mod page;
mod path;
mod reference;
mod search;
mod sources;

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use clap::{Parser, Subcommand};
use xtask::run::{is_there, root, run_there, target};
use xtask::say;
use xtask::skip::skip;

use folder::Folder;
use navigation::Navigation;
use page::Layout;

/// The documents as pages.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    command: Site,
}

#[derive(Subcommand)]
enum Site {
    /// Write documents, references and notebooks as one folder of pages that need no network
    #[command(after_help = "Examples: cargo xtask site\n          cargo xtask site --check")]
    Site(Options),
}

/// Options of `site`.
#[derive(clap::Args)]
struct Options {
    /// Write into this folder, which is replaced, instead of `target/site`
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Leave out the Rust reference, which takes as long as everything else together
    #[arg(long)]
    quick: bool,
    /// Follow every link in a browser too, look for words, at two widths and in both themes
    #[arg(long)]
    check: bool,
}

/// The page to open.
const INDEX: &str = "index.html";

fn main() -> ExitCode {
    let Site::Site(options) = Arguments::parse().command;
    xtask::ended(site(&options))
}

fn site(options: &Options) -> Result<(), String> {
    let out = match &options.out {
        Some(folder) => folder.clone(),
        None => target()?.join("site"),
    };
    let root = root();
    let navigation = Navigation::read(&root)?;
    let rust = if options.quick { None } else { Some(reference::rust::documented()?) };
    let mut folder = Folder::default();
    let layout = Layout::new(navigation)?;
    sources::pages(&root, &layout, &mut folder)?;
    reference::pages(&root, &layout, rust.is_some(), &mut folder)?;
    folder.text("search.js", search::script(&folder)?);
    for (name, text) in page::ASSETS {
        folder.text(name, text.to_owned());
    }
    let rust_files = rust.as_deref().map(folder::files_below).transpose()?.unwrap_or_default();
    let found = links::check(&folder, rust_files.iter().map(String::as_str))?;
    folder.write(&out, rust.as_deref())?;
    say!(
        "site: {} pages, {} links and pictures, none dead: {}",
        folder.pages().count(),
        found,
        out.join(INDEX).display()
    );
    if options.check { walk(&root, &out) } else { Ok(()) }
}

/// Walks the pages in a browser, if Node.js and Chromium are installed.
fn walk(root: &Path, out: &Path) -> Result<(), String> {
    let browser = std::env::var("CHROMIUM").unwrap_or_else(|_| "/usr/bin/chromium".to_owned());
    if !(is_there("node") && is_there("npm") && is_there(&browser)) {
        return skip("pages of the site in a browser", "apt-get install nodejs npm chromium");
    }
    let programs = root.join("sim/report");
    if !programs.join("node_modules").is_dir() {
        let packages = ["ci", "--ignore-scripts", "--no-audit", "--no-fund"];
        run_there(Command::new("npm").args(packages).current_dir(&programs))?;
    }
    run_there(Command::new("node").arg("check-site.mjs").arg(out).current_dir(&programs))
}
