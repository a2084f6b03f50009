//! `mutate`: one wrong term at a time, put to the laws of physics; the pages that say what came of
//! it.

use std::fs;

use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use precess_codegen::kinds::DGVSCMG;
use precess_codegen::mutation::{Engines, Kind, Report, Selection, Tally, mutate as run};
use precess_codegen::page::Page;
use precess_codegen::report::traceability;
use precess_codegen::verdict::verdicts;

use crate::files::{differing, read_files, read_pages, write};
use crate::regen::PAGES;
use crate::run::{root, say};

/// Where the engines' stored values stand.
const ENGINES: &str = "tests/fixtures/engines.json";
/// The derivation, whose comments name equations.
const DERIVATION: &str = "codegen/src/derivation";

/// Options of `mutate`.
#[derive(Args)]
pub(crate) struct Options {
    /// Make the mutants of this function alone, and write no page
    #[arg(long, value_name = "NAME")]
    kernel: Option<String>,
    /// Make every K-th mutant alone, and write no page
    #[arg(long, value_name = "K", default_value = "1")]
    #[arg(value_parser = clap::value_parser!(u16).range(1..))]
    sample: u16,
    /// Write nothing; show what would change on the pages and fail if anything would
    #[arg(long, conflicts_with_all = ["kernel", "sample"])]
    check: bool,
}

impl Options {
    /// `mutate --check`.
    pub(crate) fn check_only() -> Self {
        Self { kernel: None, sample: 1, check: true }
    }
}

/// Makes the mutants, prints what became of them, and writes or compares the pages.
pub(crate) fn mutate(options: &Options) -> Result<(), String> {
    let json = fs::read_to_string(root().join(ENGINES))
        .map_err(|error| format!("cannot read {ENGINES}: {error}"))?;
    let engines = Engines::parse(&DGVSCMG, &json).map_err(|error| format!("{ENGINES}: {error}"))?;
    let selection =
        Selection { kernel: options.kernel.as_deref(), every: usize::from(options.sample) };
    let report = with_progress(&engines, &selection)?;
    print(&report);
    // A page that lists survivors is worth having, too.
    if options.kernel.is_none() && options.sample == 1 {
        keep(&report, options.check)?;
    }
    match report.survivors().count() {
        0 => Ok(()),
        survivors => {
            Err(format!("{survivors} mutants survive: no law shows them; add one that does"))
        }
    }
}

/// Writes the pages, or compares them with what stands there.
fn keep(report: &Report, check: bool) -> Result<(), String> {
    let pages = root().join(PAGES);
    let verdicts = verdicts(&read_pages(&pages)?, &read_pages(&pages.join("printed"))?);
    let verdicts = verdicts.map_err(|error| error.to_string())?;
    let mut files = report.page().map_err(|error| error.to_string())?;
    let traces = traceability(&verdicts, report, &sources()?);
    files.extend(traces.map_err(|error| error.to_string())?);
    if !check {
        return write(&files, &root());
    }
    let (stale, all) = (differing(&files, &root()), files.len());
    if stale > 0 {
        return Err(format!("{stale} of {all} pages are stale; run `cargo xtask mutate`"));
    }
    say!("{all} pages are fresh");
    Ok(())
}

/// The files of the derivation, by path from the root.
fn sources() -> Result<Vec<Page>, String> {
    let files = read_files(&root().join(DERIVATION), "rs")?;
    let named = |page: Page| Page { name: format!("{DERIVATION}/{}", page.name), ..page };
    Ok(files.into_iter().map(named).collect())
}

/// A bar on a terminal, nothing where there is none.
fn with_progress(engines: &Engines, selection: &Selection<'_>) -> Result<Report, String> {
    let bar = ProgressBar::new(0);
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} mutants, {eta} left");
    bar.set_style(style.map_err(|error| error.to_string())?);
    let mut tell = |done: usize, of: usize| {
        bar.set_length(u64::try_from(of).unwrap_or(u64::MAX));
        bar.set_position(u64::try_from(done).unwrap_or(u64::MAX));
    };
    let report = run(&DGVSCMG, engines, selection, &mut tell).map_err(|error| error.to_string());
    bar.finish_and_clear();
    report
}

fn print(report: &Report) {
    let [a, b, c] = Kind::ALL.map(Kind::title);
    say!(
        "{:16} {:>7}  {a:>12} {b:>12} {c:>12} {:>7}  {:>10} {:>9}",
        "function",
        "mutants",
        "any",
        "equivalent",
        "survivors"
    );
    for (kernel, tally) in report.by_kernel() {
        row(&kernel, &tally);
    }
    row("all", &report.total());
    for survivor in report.survivors() {
        let mutant = &survivor.mutant;
        let signals =
            Kind::ALL.map(|kind| format!("{} {:.1e}", kind.title(), survivor.signal(kind)));
        say!(
            "survives: {mutant}\n    under: {}\n    residuals: {}",
            mutant.section,
            signals.join(", ")
        );
    }
}

fn row(name: &str, tally: &Tally) {
    let Tally { mutants, killed: [a, b, c], any, equivalent, survivors } = tally;
    say!(
        "{name:16} {mutants:>7}  {a:>12} {b:>12} {c:>12} {any:>7}  {equivalent:>10} {survivors:>9}"
    );
}
