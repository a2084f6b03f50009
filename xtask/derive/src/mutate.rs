//! `mutate`: one wrong term at a time, checked by the laws of physics; the pages with the results
//! of it.

use std::fs;

use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use precess_codegen::kinds::{self, DGVSCMG, KINDS};
use precess_codegen::page::Page;
use precess_review::mutation::{Engines, Kind, Progress, Report, Selection, Tally, mutate_all};
use precess_review::report::{self, traceability};
use precess_review::verdict::verdicts;

use xtask::files::{differing, write};
use xtask::run::root;
use xtask::say;

use crate::pages::{read_pages, read_texts, texts};
use crate::regen::PAGES;

/// The file of the engines' stored values.
const ENGINES: &str = "tests/fixtures/engines.json";
/// The derivation, whose comments name equations.
const DERIVATION: &str = "codegen/src/derivation";

/// Options of `mutate`.
#[derive(Args)]
pub(crate) struct Options {
    /// Make the mutants of only this kind, and write no page
    #[arg(long, value_name = "NAME")]
    kind: Option<String>,
    /// Make the mutants of only this function (of the DGVSCMG, unless a kind is named), and write
    /// no page
    #[arg(long, value_name = "NAME")]
    kernel: Option<String>,
    /// Make only every K-th mutant, and write no page
    #[arg(long, value_name = "K", default_value = "1")]
    #[arg(value_parser = clap::value_parser!(u16).range(1..))]
    sample: u16,
    /// Write nothing; show what would change on the pages and fail if anything would
    #[arg(long, conflicts_with_all = ["kind", "kernel", "sample"])]
    check: bool,
}

impl Options {
    /// The kinds that are meant.
    fn kinds(&self) -> Result<Vec<&'static kinds::Kind>, String> {
        let all = || KINDS.to_vec();
        match (&self.kind, &self.kernel) {
            (None, None) => Ok(all()),
            (None, Some(_)) => Ok(vec![&DGVSCMG]),
            (Some(name), _) => {
                let found = KINDS.into_iter().find(|kind| kind.name == name);
                found.map(|kind| vec![kind]).ok_or_else(|| {
                    let known = all().iter().map(|kind| kind.name).collect::<Vec<_>>().join(", ");
                    format!("no kind is called `{name}`; choose one of {known}")
                })
            }
        }
    }
}

/// Makes the mutants, prints what became of them, and writes or compares the pages.
pub(crate) fn mutate(options: &Options) -> Result<(), String> {
    let json = fs::read_to_string(root().join(ENGINES))
        .map_err(|error| format!("cannot read {ENGINES}: {error}"))?;
    let engines = Engines::parse(&DGVSCMG, &json).map_err(|error| format!("{ENGINES}: {error}"))?;
    let selection =
        Selection { kernel: options.kernel.as_deref(), every: usize::from(options.sample) };
    let kinds = options.kinds()?;
    let reports = with_progress(&kinds, &engines, &selection)?;
    reports.iter().for_each(print);
    // A page that lists survivors is worth having, too.
    if kinds.len() == KINDS.len() && options.sample == 1 {
        keep(&reports, options.check)?;
    }
    match reports.iter().flat_map(Report::survivors).count() {
        0 => Ok(()),
        survivors => {
            Err(format!("{survivors} mutants survive: no law shows them; add one that does"))
        }
    }
}

/// Writes the pages, or compares them with the files there.
fn keep(reports: &[Report], check: bool) -> Result<(), String> {
    let pages = root().join(PAGES);
    let verdicts = verdicts(&read_pages(&pages)?, &read_pages(&pages.join("printed"))?);
    let verdicts = verdicts.map_err(|error| error.to_string())?;
    let page = report::mutation(reports).map_err(|error| error.to_string())?;
    let mut files: Vec<_> = page.into_iter().collect();
    for report in reports.iter().filter(|report| report.kind.name == DGVSCMG.name) {
        let traces = traceability(&verdicts, report, &sources()?);
        files.push(traces.map_err(|error| error.to_string())?);
    }
    if !check {
        return write(texts(&files), &root());
    }
    let (stale, all) = (differing(texts(&files), &root()), files.len());
    if stale > 0 {
        return Err(format!("{stale} of {all} pages are stale; run `cargo xtask mutate`"));
    }
    say!("{all} pages are fresh");
    Ok(())
}

/// The files of the derivation, by path from the root.
fn sources() -> Result<Vec<Page>, String> {
    let wrong = |error: &std::io::Error| format!("cannot read {DERIVATION}: {error}");
    let mut folders = vec![DERIVATION.to_owned()];
    for entry in fs::read_dir(root().join(DERIVATION)).map_err(|error| wrong(&error))? {
        let entry = entry.map_err(|error| wrong(&error))?;
        if entry.path().is_dir() {
            folders.push(format!("{DERIVATION}/{}", entry.file_name().to_string_lossy()));
        }
    }
    folders.sort();
    let mut files = Vec::new();
    for folder in folders {
        let pages = read_texts(&root().join(&folder), "rs")?.into_iter();
        files.extend(pages.map(|page| Page { name: format!("{folder}/{}", page.name), ..page }));
    }
    Ok(files)
}

/// A bar on a terminal, nothing where there is none.
fn with_progress(
    kinds: &[&'static kinds::Kind],
    engines: &Engines,
    selection: &Selection<'_>,
) -> Result<Vec<Report>, String> {
    let bar = ProgressBar::new(0);
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} mutants, {eta} left");
    bar.set_style(style.map_err(|error| error.to_string())?);
    let report_progress = |progress| match progress {
        Progress::Found(more) => bar.inc_length(u64::try_from(more).unwrap_or(u64::MAX)),
        Progress::Done => bar.inc(1),
    };
    let reports =
        mutate_all(kinds, engines, selection, &report_progress).map_err(|error| error.to_string());
    bar.finish_and_clear();
    reports
}

fn print(report: &Report) {
    let [a, b, c] = Kind::ALL.map(Kind::title);
    say!(
        "\n{:30} {:>7}  {a:>12} {b:>12} {c:>12} {:>7}  {:>10} {:>9}",
        report.kind.name,
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
        "{name:30} {mutants:>7}  {a:>12} {b:>12} {c:>12} {any:>7}  {equivalent:>10} {survivors:>9}"
    );
}
