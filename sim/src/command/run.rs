//! `run`: scenario files into results and reports.
//!
//! Results are written while the run goes on, under the name with `.partial` at its end, and get
//! their name when they are complete. The report is written last.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};

use super::advice::{self, advice};
use super::error::CommandError;
#[cfg(unix)]
use super::exit::TERMINATED;
use super::exit::{Exit, INTERRUPTED};
use super::outputs::Outputs;
use super::terminal::visible;
use super::{Files, note, print};
use crate::engine::{Outcome, run};
use crate::file::{Diagnostics, from_file};
use crate::record::partial::Reservation;
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

Ctrl-C or SIGTERM ends a run early: what was computed is complete, and says so; a second one ends at once.";

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

/// How often Ctrl-C was pressed, or SIGTERM was received.
static INTERRUPTS: AtomicUsize = AtomicUsize::new(0);

impl Run {
    pub(super) fn execute(&self) -> Result<Exit, CommandError> {
        let scenarios = read_all(&self.files)?;
        if !cfg!(feature = "parquet")
            && scenarios.iter().any(|(of, _)| of.output.formats.contains(&Format::Parquet))
        {
            return Err(without_parquet());
        }
        let names: Vec<_> =
            scenarios.iter().flat_map(|(scenario, _)| self.names(scenario)).collect();
        let mut outputs = Outputs::reserve(&self.out, &names, self.force)?;
        watch_interrupts();
        let mut exit = Exit::Success;
        for (scenario, reports) in &scenarios {
            let done = self.run(scenario, reports, &mut outputs);
            let left = || outputs.left(&self.names(scenario));
            exit = exit.max(done.map_err(|error| error.leaving(left()))?);
            if INTERRUPTS.load(Ordering::Relaxed) > 0 {
                break;
            }
        }
        Ok(exit)
    }

    /// The files of a scenario.
    fn names(&self, scenario: &Scenario) -> Vec<String> {
        let mut names: Vec<_> = results(scenario).collect();
        if !scenario.crossings.is_empty() {
            names.push(events_name(scenario));
        }
        if !self.no_report {
            names.push(format!("{}.html", scenario.name));
        }
        names
    }

    /// Runs one; how it ended, and what became of its requirements.
    fn run(
        &self,
        scenario: &Scenario,
        reports: &Diagnostics,
        outputs: &mut Outputs,
    ) -> Result<Exit, CommandError> {
        let mut files = Vec::new();
        for format in &scenario.output.formats {
            let name = format!("{}.{}", scenario.name, extension(*format));
            if let Some(reservation) = outputs.take(&name) {
                files.push(recorder(*format, reservation)?);
            }
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
        let mut texts = Vec::new();
        if !scenario.crossings.is_empty() {
            texts.push((events_name(scenario), events_csv(&outcome)));
        }
        if !self.no_report {
            let page = report.html(&outcome).map_err(|e| CommandError::Other(e.to_string()))?;
            texts.push((format!("{}.html", scenario.name), page));
        }
        // The results are complete, and stay.
        let results = || results(scenario).map(|name| self.out.join(name)).collect();
        outputs.write(&texts).map_err(|error| error.leaving(results()))?;
        let files: Vec<_> = self
            .names(scenario)
            .iter()
            .map(|name| self.out.join(name).display().to_string())
            .collect();
        print(&report.summary(&outcome, &files))?;
        for warning in &warnings {
            note(&format!("warning: {warning}"));
        }
        let of_run = if outcome.end.is_complete() { Exit::Success } else { Exit::Violated };
        let of_requirements = Exit::of_states(report.verdicts().iter().map(|of| &of.state));
        Ok(of_run.max(of_requirements))
    }
}

/// The names of a scenario's results.
fn results(scenario: &Scenario) -> impl Iterator<Item = String> {
    let formats = scenario.output.formats.iter();
    formats.map(|format| format!("{}.{}", scenario.name, extension(*format)))
}

/// The name of the file with the times of crossings.
fn events_name(scenario: &Scenario) -> String {
    format!("{}-events.csv", scenario.name)
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
                    note(&earlier.to_string());
                }
            }
        }
    }
    failed.map_or(Ok(scenarios), Err)
}

/// Runs a scenario up to a time, s, or an interrupt, with a progress bar, which a pipe does not get.
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
    bar.set_message(visible(what).into_owned());
    bar
}

/// Whether Ctrl-C was pressed, or SIGTERM was received.
pub(super) fn interrupted() -> bool {
    INTERRUPTS.load(Ordering::Relaxed) > 0
}

/// The first Ctrl-C or SIGTERM ends the run, the second the program.
pub(super) fn watch_interrupts() {
    // Where no handler can be set, either ends the program, and leaves `.partial` files.
    let _ = ctrlc::set_handler(|| interrupt(INTERRUPTED));
    #[cfg(unix)]
    if let Ok(mut signals) = signal_hook::iterator::Signals::new([signal_hook::consts::SIGTERM]) {
        std::thread::spawn(move || signals.forever().for_each(|_| interrupt(TERMINATED)));
    }
}

/// Counts an interrupt; the second ends the program with a code.
fn interrupt(code: u8) {
    if INTERRUPTS.fetch_add(1, Ordering::Relaxed) > 0 {
        std::process::exit(code.into());
    }
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
fn recorder(format: Format, reservation: Reservation) -> Result<Box<dyn Recorder>, CommandError> {
    match format {
        Format::Csv => Ok(Box::new(Csv::reserved(reservation))),
        Format::Npz => Ok(Box::new(Npz::reserved(reservation))),
        #[cfg(feature = "parquet")]
        Format::Parquet => Ok(Box::new(crate::record::Parquet::reserved(reservation))),
        #[cfg(not(feature = "parquet"))]
        Format::Parquet => Err(without_parquet()),
    }
}

/// The error of a format that this program does not have.
fn without_parquet() -> CommandError {
    CommandError::Other(
        "this program was built without Parquet; install it by `cargo install --path sim --features parquet`, or \
         record csv or npz"
            .to_owned(),
    )
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
