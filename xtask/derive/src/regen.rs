//! `regen`: pages in, proofs and files out. Nothing is written unless every proof holds.
//!
//! With `--emit c` the files are the same kernels as C, for those who cannot link Rust.

use std::fs;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use precess_codegen::emit::{self, EmittedFile};
use precess_codegen::proof::Comparison;
use precess_review::regen::{Pages, Regeneration, regenerate};

use xtask::files::{differing, write};
use xtask::run::root;
use xtask::say;

use crate::pages::{read_pages, texts};
use crate::printed;

/// The folder of the hand-checked pages.
pub(crate) const PAGES: &str = "tests/derivation";

/// Where the C kernels are written unless something else is said; not part of the repository.
const C_FOLDER: &str = "target/c";

/// What the kernels are written as.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum Language {
    /// The files of this repository
    #[default]
    Rust,
    /// C99 with the same bits, into target/c
    C,
}

/// Options of `regen`.
#[derive(Args, Default)]
pub(crate) struct Options {
    /// Write nothing; show what would change and fail if anything would
    #[arg(long)]
    check: bool,
    /// Print only the rows that do not hold
    #[arg(long)]
    quiet: bool,
    /// Show the verdict on each equation as it is printed, and stop
    #[arg(long)]
    printed: bool,
    /// Write the kernels in this language
    #[arg(long, value_name = "LANGUAGE", value_enum, default_value_t, conflicts_with = "printed")]
    emit: Language,
    /// Read the hand-checked pages from this folder
    #[arg(long, value_name = "DIR")]
    pages: Option<PathBuf>,
    /// Write the files below this folder instead of the repository, or of target/c
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

impl Options {
    /// The command that writes what these options would compare.
    fn remedy(&self) -> String {
        let options = [("--pages", &self.pages), ("--out", &self.out)].into_iter();
        let given = options.filter_map(|(option, folder)| {
            folder.as_ref().map(|folder| format!(" {option} {}", folder.display()))
        });
        let emit = if self.emit == Language::C { " --emit c" } else { "" };
        format!("cargo xtask regen{emit}{}", given.collect::<String>())
    }

    /// The folder that the files are written below.
    fn into(&self) -> PathBuf {
        let usual = match self.emit {
            Language::Rust => root(),
            Language::C => root().join(C_FOLDER),
        };
        self.out.clone().unwrap_or(usual)
    }
}

/// Regenerates, prints one row per equation, and writes or compares the files.
pub(crate) fn regen(options: &Options) -> Result<(), String> {
    let pages = options.pages.clone().unwrap_or_else(|| root().join(PAGES));
    settle(made_from(&pages)?, options)
}

fn made_from(pages: &Path) -> Result<Regeneration, String> {
    regenerate(&all_pages(pages)?).map_err(|error| error.to_string())
}

/// Prints a regeneration, and writes or compares its files.
fn settle(made: Regeneration, options: &Options) -> Result<(), String> {
    if options.printed && made.holds() {
        printed::show(&made.verdicts);
        return Ok(());
    }
    print(&made, options.quiet);
    let failed = made.rows.iter().filter(|row| !row.holds()).count();
    if failed > 0 {
        return Err(format!(
            "{failed} of {} proofs do not hold; no file was written",
            made.rows.len()
        ));
    }
    let files = match options.emit {
        Language::Rust => made.files,
        Language::C => emit::c::files().map_err(|error| error.to_string())?,
    };
    if options.check {
        compare(&files, &options.into(), &options.remedy())
    } else {
        write(texts(&files), &options.into())
    }
}

/// Folders of the pages beside those of the paper's equations: our own, those of the elimination, and
/// what is printed.
const BESIDE: [&str; 3] = ["kernels", "kernels/elimination", "printed"];

/// The pages below a folder.
fn all_pages(folder: &Path) -> Result<Pages, String> {
    let [kernels, elimination, printed] = BESIDE.map(|beside| read_pages(&folder.join(beside)));
    Ok(Pages {
        paper: read_pages(folder)?,
        kernels: kernels?,
        elimination: elimination?,
        printed: printed?,
    })
}

/// What every function costs, and what each pass brings.
const OPERATIONS: &str = "docs/operations.md";

fn print(made: &Regeneration, quiet: bool) {
    let shown: Vec<_> = made.rows.iter().filter(|row| !quiet || !row.holds()).collect();
    if !shown.is_empty() {
        say!("{}", Comparison::heading());
    }
    let mut kind = None;
    for row in shown {
        if row.kind != kind {
            kind = row.kind;
            say!("\n{}", kind.unwrap_or("as printed"));
        }
        say!("{row}");
    }
    let operations = made.files.iter().find(|file| file.path == OPERATIONS);
    if let Some(EmittedFile { text, .. }) = operations.filter(|_| !quiet) {
        say!("\n{text}");
    }
    let held = made.rows.iter().filter(|row| row.holds()).count();
    say!("{held} of {} claims proven equal", made.rows.len());
}

/// Shows the difference from the files on disk, where every file must be an emitted one.
fn compare(files: &[EmittedFile], into: &Path, remedy: &str) -> Result<(), String> {
    let stale = differing(texts(files), into);
    if let Some(orphan) = orphan(files, into) {
        return Err(format!("{} is not emitted any more; delete it", orphan.display()));
    }
    if stale == 0 {
        say!("{} files are fresh", files.len());
        return Ok(());
    }
    Err(format!("{stale} of {} files are stale; run `{remedy}`", files.len()))
}

/// The first file among the emitted Rust, at any depth, that was not emitted.
fn orphan(files: &[EmittedFile], into: &Path) -> Option<PathBuf> {
    let emitted: Vec<_> = files.iter().map(|file| into.join(&file.path)).collect();
    let mut folders = vec![into.join("dynamics/src/generated")];
    let mut found = Vec::new();
    while let Some(folder) = folders.pop() {
        let entries = fs::read_dir(folder).into_iter().flatten();
        let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
        let (inner, files): (Vec<_>, Vec<_>) = paths.partition(|path| path.is_dir());
        folders.extend(inner);
        found.extend(files.into_iter().filter(|path| !emitted.contains(path)));
    }
    found.into_iter().min()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;
    use std::sync::OnceLock;

    use super::*;

    /// What the committed pages give: one regeneration takes seconds.
    fn made() -> Regeneration {
        static MADE: OnceLock<Regeneration> = OnceLock::new();
        MADE.get_or_init(|| made_from(&root().join(PAGES)).unwrap()).clone()
    }

    #[test]
    fn the_committed_files_are_fresh() {
        assert_eq!(
            settle(made(), &Options { check: true, quiet: true, ..Options::default() }),
            Ok(())
        );
    }

    #[test]
    fn two_runs_in_two_directories_give_the_same_bytes() {
        // The other run is the one that is committed.
        let folder = tempfile::tempdir().unwrap();
        let out = Some(folder.path().to_path_buf());
        assert_eq!(settle(made(), &Options { quiet: true, out, ..Options::default() }), Ok(()));
        let now = tree(folder.path(), "");
        assert!(now.contains_key("dynamics/src/generated/hub.rs"), "{:?}", now.keys());
        assert!(now.contains_key("docs/derivation.md"), "{:?}", now.keys());
        for (path, bytes) in now {
            assert!(fs::read(root().join(&path)).unwrap() == bytes, "{path} differs");
        }
    }

    #[test]
    fn c_is_written_by_itself_and_checked_like_the_rest() {
        let folder = tempfile::tempdir().unwrap();
        let out = Some(folder.path().to_path_buf());
        let options = |check| {
            let (out, emit) = (out.clone(), Language::C);
            Options { check, quiet: true, out, emit, ..Options::default() }
        };
        assert_eq!(settle(made(), &options(false)), Ok(()));
        let written = tree(folder.path(), "");
        assert!(written.contains_key("precess_dgvscmg.c"), "{:?}", written.keys());
        assert!(written.keys().all(|path| path.starts_with("precess_")), "{:?}", written.keys());
        assert_eq!(settle(made(), &options(true)), Ok(()));
        fs::write(folder.path().join("precess_hub.h"), "").unwrap();
        let message = settle(made(), &options(true)).unwrap_err();
        let all = written.len();
        let start = format!("1 of {all} files are stale; run `cargo xtask regen --emit c --out ");
        assert!(message.starts_with(&start), "{message}");
    }

    /// Every file below a folder, by its path from there.
    fn tree(folder: &Path, from: &str) -> BTreeMap<String, Vec<u8>> {
        let mut found = BTreeMap::new();
        for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
            let path = format!("{from}{}", entry.file_name().to_str().unwrap());
            if entry.file_type().unwrap().is_dir() {
                found.append(&mut tree(&entry.path(), &format!("{path}/")));
            } else {
                found.insert(path, fs::read(entry.path()).unwrap());
            }
        }
        found
    }

    #[test]
    fn a_file_that_is_not_emitted_is_found_in_any_folder() {
        let folder = tempfile::tempdir().unwrap();
        let generated = folder.path().join("dynamics/src/generated");
        fs::create_dir_all(generated.join("dgvscmg")).unwrap();
        let file = |path: &str| EmittedFile {
            path: format!("dynamics/src/generated/{path}"),
            text: String::new(),
        };
        let emitted = ["mod.rs", "dgvscmg/device.rs"].map(file);
        write(texts(&emitted), folder.path()).unwrap();
        assert_eq!(orphan(&emitted, folder.path()), None);
        let left = generated.join("dgvscmg/old.rs");
        fs::write(&left, "").unwrap();
        assert_eq!(orphan(&emitted, folder.path()), Some(left));
    }

    #[test]
    fn a_wrong_page_is_named_and_nothing_is_written() {
        let folder = tempfile::tempdir().unwrap();
        let (pages, out) = (folder.path().join("pages"), folder.path().join("out"));
        for beside in BESIDE {
            fs::create_dir_all(pages.join(beside)).unwrap();
        }
        for page in read_pages(&root().join(PAGES)).unwrap() {
            let text = page.text.replace("- i_go_22", "+ i_go_22");
            fs::write(pages.join(page.name), text).unwrap();
        }
        for beside in BESIDE {
            for page in read_pages(&root().join(PAGES).join(beside)).unwrap() {
                fs::write(pages.join(beside).join(page.name), page.text).unwrap();
            }
        }
        let options = Options {
            quiet: true,
            pages: Some(pages),
            out: Some(out.clone()),
            ..Options::default()
        };
        let message = regen(&options).unwrap_err();
        assert!(message.ends_with("proofs do not hold; no file was written"), "{message}");
        assert!(!out.exists());
    }

    #[test]
    fn a_stale_file_fails_the_check_with_its_remedy() {
        let folder = tempfile::tempdir().unwrap();
        let out = Some(folder.path().to_path_buf());
        let options =
            |check| Options { check, quiet: true, out: out.clone(), ..Options::default() };
        assert_eq!(settle(made(), &options(false)), Ok(()));
        let path = folder.path().join("dynamics/src/generated/hub.rs");
        let text = fs::read_to_string(&path).unwrap();
        fs::write(&path, text.replace("rad/s.", "rpm.")).unwrap();
        let before = fs::read_to_string(&path).unwrap();
        let message = settle(made(), &options(true)).unwrap_err();
        let all = tree(folder.path(), "").len();
        let start = format!("1 of {all} files are stale; run `cargo xtask regen --out ");
        assert!(message.starts_with(&start), "{message}");
        assert_eq!(fs::read_to_string(&path).unwrap(), before);
    }
}
