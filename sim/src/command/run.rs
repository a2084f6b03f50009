//! `run`: scenario files into results and reports.
//!
//! Results are written while the run goes on, under the name with `.partial` at its end, and get
//! their name when they are complete. The report is written last.

use std::fmt::Write as _;
use std::path::PathBuf;

use clap::Args;

use super::advice::{self, advice};
use super::error::CommandError;
use super::exit::Exit;
use super::options::Files;
use super::outputs::Outputs;
use super::progress::{interrupted, watch_interrupts, with_progress};
use super::scenarios::read_all;
use super::terminal::{note, print};
use crate::file::Diagnostics;
use crate::record::partial::Reservation;
use crate::record::{Csv, Npz, Outcome, Recorder, RecorderGroup};
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

impl Run {
    pub(super) fn execute(&self) -> Result<Exit, CommandError> {
        let scenarios = read_all(&self.files)?;
        let wants = |format| scenarios.iter().any(|(of, _)| of.output.formats.contains(&format));
        if !cfg!(feature = "parquet") && wants(Format::Parquet) {
            return Err(without("Parquet", "parquet"));
        }
        if !cfg!(feature = "mcap") && wants(Format::Mcap) {
            return Err(without("MCAP", "mcap"));
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
            if interrupted() {
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
                files.push(recorder(*format, reservation, scenario)?);
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
        let outcome = with_progress(scenario, duration, &mut RecorderGroup::new(all))?;
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

fn extension(format: Format) -> &'static str {
    match format {
        Format::Csv => "csv",
        Format::Npz => "npz",
        Format::Parquet => "parquet",
        Format::Mcap => "mcap",
    }
}

#[cfg_attr(
    all(feature = "parquet", feature = "mcap"),
    expect(clippy::unnecessary_wraps, reason = "an error only without a feature")
)]
#[cfg_attr(
    not(feature = "mcap"),
    expect(unused_variables, reason = "only an MCAP file shows the spacecraft")
)]
fn recorder(
    format: Format,
    reservation: Reservation,
    scenario: &Scenario,
) -> Result<Box<dyn Recorder>, CommandError> {
    match format {
        Format::Csv => Ok(Box::new(Csv::reserved(reservation))),
        Format::Npz => Ok(Box::new(Npz::reserved(reservation))),
        #[cfg(feature = "parquet")]
        Format::Parquet => Ok(Box::new(crate::record::Parquet::reserved(reservation))),
        #[cfg(not(feature = "parquet"))]
        Format::Parquet => Err(without("Parquet", "parquet")),
        #[cfg(feature = "mcap")]
        Format::Mcap => Ok(Box::new(crate::mcap::Mcap::reserved(reservation, scenario))),
        #[cfg(not(feature = "mcap"))]
        Format::Mcap => Err(without("MCAP", "mcap")),
    }
}

/// The error of a format that this program does not have.
fn without(format: &str, feature: &str) -> CommandError {
    CommandError::Other(format!(
        "this program was built without {format}; install it by `cargo install --path sim --features {feature}`, or \
         record csv or npz"
    ))
}
