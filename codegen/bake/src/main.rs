//! `precess-bake`: the kernels of one spacecraft, from a description of it.
//!
//! `precess bake` writes the description of a scenario and calls this; it can also be called with a
//! description of one's own.

use std::fs;
use std::io::{self, Read, Write as _};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use precess_bake::{Baked, Language, bake, batch, solver};
use precess_codegen::emit::EmittedFile;
use precess_description::Description;

/// Derives, proves and writes the kernels of one spacecraft
#[derive(Parser)]
#[command(
    name = "precess-bake",
    version,
    after_help = "Example:\n  precess bake scenarios/imaging-satellite.toml --out imaging_satellite\n  \
                  precess-bake imaging_satellite.toml --out imaging_satellite --language c"
)]
#[expect(clippy::struct_excessive_bools, reason = "options of a command line")]
struct Options {
    /// The description; standard input without it
    description: Option<PathBuf>,
    /// The folder to write
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// What to write; a crate without this option, C with `--general`
    #[arg(long, value_enum)]
    language: Option<Language>,
    /// Fold the values, too: constants instead of a constructor that takes them
    #[arg(long)]
    constants: bool,
    /// Assume nothing: the solver of every spacecraft with these kinds, as C99
    #[arg(long, conflicts_with = "constants")]
    general: bool,
    /// Write kernels for batches of states, too: CUDA, and C99
    #[arg(long, requires = "general")]
    batch: bool,
    /// Replace a folder that is there
    #[arg(long)]
    force: bool,
    /// Compare with what is in the folder instead of writing it
    #[arg(long, conflicts_with = "force")]
    check: bool,
}

fn main() -> ExitCode {
    match execute(&Options::parse()) {
        Ok(text) => {
            let mut out = io::stdout().lock();
            match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
                // The files are written, whoever reads this.
                Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
                    let _ = writeln!(io::stderr(), "error: standard output: {error}");
                    ExitCode::FAILURE
                }
                _ => ExitCode::SUCCESS,
            }
        }
        Err(error) => {
            let _ = writeln!(io::stderr(), "error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn execute(options: &Options) -> Result<String, String> {
    let text = read(options.description.as_deref())?;
    let description = Description::read(&text).map_err(|error| error.to_string())?;
    if options.general {
        if options.language == Some(Language::Rust) {
            let remedy = "in Rust, the crate `precess-dynamics` is the general solver";
            return Err(format!("--general writes C; {remedy}"));
        }
        let mut files = solver(&description).map_err(|error| error.to_string())?;
        if options.batch {
            files.extend(batch(&description).map_err(|error| error.to_string())?);
        }
        put(&files, options)?;
        let (out, count) = (options.out.display(), files.len());
        return Ok(format!("{out}: {count} files, for every spacecraft with these kinds\n"));
    }
    let (language, constants) = (options.language.unwrap_or(Language::Rust), options.constants);
    let what = precess_bake::Options { language, constants };
    let baked = bake(&description, what).map_err(|error| error.to_string())?;
    put(&baked.files, options)?;
    Ok(report(&baked, &options.out))
}

/// Writes the files, or compares with what is there.
fn put(files: &[EmittedFile], options: &Options) -> Result<(), String> {
    if options.check {
        check(files, &options.out)
    } else {
        write(files, &options.out, options.force)
    }
}

fn read(path: Option<&Path>) -> Result<String, String> {
    let Some(path) = path else {
        let mut text = String::new();
        let read = io::stdin().read_to_string(&mut text);
        return read.map(|_| text).map_err(|error| format!("standard input: {error}"));
    };
    fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}

/// Writes all files beside the folder, then puts them in its place: a new folder at once, those of
/// a folder that is there one by one.
fn write(files: &[EmittedFile], out: &Path, force: bool) -> Result<(), String> {
    let shown = |error: io::Error| format!("{}: {error}", out.display());
    if out.exists() && !force {
        let out = out.display();
        return Err(format!("{out} is there already; `--force` replaces the files in it"));
    }
    let parent = out.parent().filter(|parent| !parent.as_os_str().is_empty());
    let parent = parent.unwrap_or(Path::new("."));
    fs::create_dir_all(parent).map_err(shown)?;
    let made = tempfile::tempdir_in(parent).map_err(shown)?;
    for file in files {
        let path = made.path().join(&file.path);
        fs::create_dir_all(path.parent().unwrap_or(parent)).map_err(shown)?;
        fs::write(&path, &file.text).map_err(shown)?;
    }
    if !out.exists() {
        fs::rename(made.path(), out).map_err(shown)?;
        let _ = made.keep();
        return Ok(());
    }
    // Files of others in the folder stay.
    for file in files {
        let path = out.join(&file.path);
        fs::create_dir_all(path.parent().unwrap_or(out)).map_err(shown)?;
        fs::rename(made.path().join(&file.path), &path).map_err(shown)?;
    }
    Ok(())
}

/// Whether the folder has these files.
fn check(files: &[EmittedFile], out: &Path) -> Result<(), String> {
    let differs = |path: &str, text: &str| {
        fs::read_to_string(out.join(path)).map_or(true, |found| found != text)
    };
    let stale: Vec<_> = files.iter().filter(|file| differs(&file.path, &file.text)).collect();
    if stale.is_empty() {
        return Ok(());
    }
    let names: Vec<_> = stale.iter().map(|file| file.path.as_str()).collect();
    Err(format!("{}: not what would be written: {}", out.display(), names.join(", ")))
}

fn report(baked: &Baked, out: &Path) -> String {
    let assumed = baked.assumptions.join("\n  ");
    let (files, claims, operations) = (baked.files.len(), baked.proof.len(), baked.operations);
    let percent = 100.0 * ratio(operations.baked, operations.general);
    format!(
        "{}: {files} files\n\nassumed:\n  {assumed}\n\n{claims} claims proven\n{} operations an \
         evaluation, {percent:.0} % of the general kernels' {}\n",
        out.display(),
        operations.baked,
        operations.general
    )
}

#[expect(clippy::cast_precision_loss, reason = "counts of operations are small")]
fn ratio(part: usize, whole: usize) -> f64 {
    part as f64 / whole as f64
}
