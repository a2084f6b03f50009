//! `run`: scenario files into results and reports.
//!
//! Results are written while the run goes on, under the name with `.partial` at its end, and get
//! their name when they are complete. The report is written last.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::io::{BufRead as _, IsTerminal as _, Write as _};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};

use super::advice::{self, advice};
use super::error::CommandError;
use super::exit::Exit;
use super::{Files, print};
use crate::engine::{Outcome, run};
use crate::file::{Diagnostics, from_file};
use crate::record::partial::Partial;
use crate::record::{Csv, Many, Npz, Recorder};
use crate::report::Report;
use crate::scenario::{Format, Scenario};

pub(super) const HELP: &str = "\
Examples:
  precess run bus.toml
      results and a report into the folder precess-out
  precess run scenarios/*.toml --out results --set run.duration='2 s'
      two seconds of each

Where the scenario has crossings, their times are printed, and written to NAME-events.csv.

The exit code is 0 where every run was complete and met its requirements, 2 where one did not, 3 where one
could not be evaluated and none is violated, 1 on an error. Ctrl-C ends a run early: what was computed is complete, and says so; a second one ends at once.";

/// The options of `run`.
#[derive(Debug, Args)]
pub(super) struct Run {
    #[command(flatten)]
    files: Files,
    /// Folder for the results; made if it is missing.
    #[arg(long, value_name = "FOLDER", default_value = "precess-out")]
    out: PathBuf,
    /// Replace results that are there.
    #[arg(long)]
    force: bool,
    /// Write no report.
    #[arg(long)]
    no_report: bool,
}

/// How often Ctrl-C was pressed.
static INTERRUPTS: AtomicUsize = AtomicUsize::new(0);

impl Run {
    pub(super) fn execute(&self) -> Result<Exit, CommandError> {
        let scenarios = read_all(&self.files)?;
        for (scenario, _) in &scenarios {
            may_write(&self.out, &self.names(scenario), self.force)?;
        }
        std::fs::create_dir_all(&self.out)
            .map_err(|source| CommandError::Io { path: self.out.clone(), source })?;
        watch_interrupts();
        let mut exit = Exit::Success;
        for (scenario, reports) in &scenarios {
            exit = exit.max(self.run(scenario, reports)?);
            if INTERRUPTS.load(Ordering::Relaxed) > 0 {
                break;
            }
        }
        Ok(exit)
    }

    /// The files of a scenario.
    fn names(&self, scenario: &Scenario) -> Vec<String> {
        let mut names: Vec<_> = scenario
            .output
            .formats
            .iter()
            .map(|format| format!("{}.{}", scenario.name, extension(*format)))
            .collect();
        if !scenario.crossings.is_empty() {
            names.push(format!("{}-events.csv", scenario.name));
        }
        if !self.no_report {
            names.push(format!("{}.html", scenario.name));
        }
        names
    }

    /// Runs one; how it ended, and what became of its requirements.
    fn run(&self, scenario: &Scenario, reports: &Diagnostics) -> Result<Exit, CommandError> {
        let mut files = Vec::new();
        for format in &scenario.output.formats {
            let path = self.out.join(format!("{}.{}", scenario.name, extension(*format)));
            files.push(recorder(*format, &path)?);
        }
        let mut warnings: Vec<_> =
            reports.all.iter().map(|warning| warning.message.clone()).collect();
        let mut report = Report::new(scenario, &warnings);
        let mut all: Vec<&mut dyn Recorder> = vec![&mut report];
        for file in &mut files {
            all.push(file.as_mut());
        }
        let duration = scenario.settings.duration;
        let outcome = with_progress(scenario, duration, &mut Many::new(all))?;
        // Rates that were reached only during the run.
        let known = advice::initial(scenario);
        let reached = advice(scenario, outcome.peak_rates.iter().copied());
        for advice in reached.iter().filter(|advice| !known.iter().any(|k| k.is_like(advice))) {
            report.warn(advice.to_string());
            warnings.push(advice.to_string());
        }
        if !scenario.crossings.is_empty() {
            let path = self.out.join(format!("{}-events.csv", scenario.name));
            write_whole(&path, &events_csv(&outcome))?;
        }
        if !self.no_report {
            let path = self.out.join(format!("{}.html", scenario.name));
            let page = report.html(&outcome).map_err(|e| CommandError::Other(e.to_string()))?;
            write_whole(&path, &page)?;
        }
        let files: Vec<_> = self
            .names(scenario)
            .iter()
            .map(|name| self.out.join(name).display().to_string())
            .collect();
        print(&report.summary(&outcome, &files));
        for warning in &warnings {
            eprintln!("warning: {warning}");
        }
        let of_run = if outcome.end.is_complete() { Exit::Success } else { Exit::Violated };
        let of_requirements = Exit::of_states(report.verdicts().iter().map(|of| &of.state));
        Ok(of_run.max(of_requirements))
    }
}

/// Crossings, stops and changes: a row for each, with its time, s, in the digits that read back the same.
fn events_csv(outcome: &Outcome) -> String {
    let mut text = String::from("time_s,event\n");
    let mut digits = zmij::Buffer::new();
    for event in &outcome.events {
        text.push_str(digits.format(event.time));
        // RFC 4180: quotation marks are doubled.
        let _ = writeln!(text, ",\"{}\"", event.text.replace('"', "\"\""));
    }
    text
}

/// Reads all files, or reports what is wrong with all of them.
pub(super) fn read_all(files: &Files) -> Result<Vec<(Scenario, Diagnostics)>, CommandError> {
    let overrides = files.overrides.overrides();
    let mut scenarios: Vec<(Scenario, Diagnostics)> = Vec::new();
    let mut failed = None;
    for path in &files.files {
        match from_file(path, &overrides) {
            Ok((scenario, mut reports)) => {
                if scenarios.iter().any(|(other, _)| other.name == scenario.name) {
                    let message = format!(
                        "two scenarios are named `{}`, and their results have one name; give one \
                         of them another `name`",
                        scenario.name
                    );
                    return Err(CommandError::Other(message));
                }
                reports.all.extend(advice::initial(&scenario).iter().map(Into::into));
                scenarios.push((scenario, reports));
            }
            Err(errors) => {
                if let Some(CommandError::Scenario(earlier)) =
                    failed.replace(CommandError::Scenario(errors))
                {
                    eprintln!("{earlier}");
                }
            }
        }
    }
    failed.map_or(Ok(scenarios), Err)
}

/// Runs a scenario up to a time, s, or Ctrl-C, with a progress bar, which a pipe does not get.
pub(super) fn with_progress(
    scenario: &Scenario,
    until: f64,
    recorder: &mut dyn Recorder,
) -> Result<Outcome, CommandError> {
    const PARTS: u16 = 1000;
    let bar = progress_bar(usize::from(PARTS), &scenario.name);
    let outcome = run(scenario, recorder, &mut |time| {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a share of a thousand"
        )]
        bar.set_position((time / until * f64::from(PARTS)) as u64);
        if INTERRUPTS.load(Ordering::Relaxed) > 0 || time > until {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    bar.finish_and_clear();
    let name = scenario.name.clone();
    outcome.map_err(|source| CommandError::Run { name, source })
}

/// As many threads as there are cores.
pub(super) fn all_cores() -> usize {
    std::thread::available_parallelism().map_or(1, std::num::NonZero::get)
}

/// A bar of so many parts, silent where the output is no terminal.
pub(super) fn progress_bar(parts: usize, what: &str) -> ProgressBar {
    let bar = ProgressBar::new(u64::try_from(parts).unwrap_or(u64::MAX));
    if let Ok(style) =
        ProgressStyle::with_template("{msg:24} {wide_bar} {percent:>3} %, {eta} left")
    {
        bar.set_style(style);
    }
    bar.set_message(what.to_owned());
    bar
}

/// Whether Ctrl-C was pressed.
pub(super) fn interrupted() -> bool {
    INTERRUPTS.load(Ordering::Relaxed) > 0
}

/// The first Ctrl-C ends the run, the second the program.
pub(super) fn watch_interrupts() {
    const INTERRUPTED: i32 = 130;
    // Where no handler can be set, Ctrl-C ends the program, and leaves `.partial` files.
    let _ = ctrlc::set_handler(|| {
        if INTERRUPTS.fetch_add(1, Ordering::Relaxed) > 0 {
            std::process::exit(INTERRUPTED);
        }
    });
}

fn extension(format: Format) -> &'static str {
    match format {
        Format::Csv => "csv",
        Format::Npz => "npz",
        Format::Parquet => "parquet",
    }
}

#[cfg_attr(
    feature = "parquet",
    expect(clippy::unnecessary_wraps, reason = "an error only without the feature")
)]
fn recorder(format: Format, path: &Path) -> Result<Box<dyn Recorder>, CommandError> {
    match format {
        Format::Csv => Ok(Box::new(Csv::new(path))),
        Format::Npz => Ok(Box::new(Npz::new(path))),
        #[cfg(feature = "parquet")]
        Format::Parquet => Ok(Box::new(crate::record::Parquet::new(path))),
        #[cfg(not(feature = "parquet"))]
        Format::Parquet => Err(CommandError::Other(
            "this program was built without Parquet; build it with `--features parquet`, or record \
             csv or npz"
                .to_owned(),
        )),
    }
}

/// The names of the files in a folder that have an extension.
pub(super) fn files(folder: &Path, extension: &str) -> Result<BTreeSet<String>, CommandError> {
    let failure = |source| CommandError::Io { path: folder.to_owned(), source };
    let mut names = BTreeSet::new();
    for entry in std::fs::read_dir(folder).map_err(failure)? {
        let name = entry.map_err(failure)?.file_name();
        if Path::new(&name).extension().is_some_and(|found| found == extension) {
            names.insert(name.to_string_lossy().into_owned());
        }
    }
    Ok(names)
}

/// Asks on a terminal whether results may be replaced; refuses elsewhere.
pub(super) fn may_write(folder: &Path, names: &[String], force: bool) -> Result<(), CommandError> {
    if folder.is_file() {
        let message = format!("{} is a file; name a folder", folder.display());
        return Err(CommandError::Other(message));
    }
    let Some(path) = names.iter().map(|name| folder.join(name)).find(|path| path.exists()) else {
        return Ok(());
    };
    if path.is_dir() {
        return Err(CommandError::Exists(path));
    }
    if force {
        return Ok(());
    }
    let stdin = std::io::stdin();
    if !stdin.is_terminal() || !std::io::stderr().is_terminal() {
        return Err(CommandError::Exists(path));
    }
    eprint!("{} exists. Replace it and the results beside it? [y/N] ", path.display());
    let _ = std::io::stderr().flush();
    let mut answer = String::new();
    let read = stdin.lock().read_line(&mut answer);
    if read.is_ok() && matches!(answer.trim(), "y" | "Y" | "yes") {
        Ok(())
    } else {
        Err(CommandError::Exists(path))
    }
}

/// Writes a text under its name once it is on the disk.
pub(super) fn write_whole(path: &Path, text: &str) -> Result<(), CommandError> {
    write_bytes(path, text.as_bytes())
}

/// Writes a file under its name once it is on the disk.
pub(super) fn write_bytes(path: &Path, bytes: &[u8]) -> Result<(), CommandError> {
    let failure = |source| CommandError::Io { path: path.to_owned(), source };
    let mut partial = Partial::create(path).map_err(failure)?;
    partial.write_all(bytes).map_err(failure)?;
    partial.finish().map_err(failure)
}
