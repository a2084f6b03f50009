//! The command line: its commands and options, and what they do.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};

use crate::bound::{excesses, hold};
use crate::error::CliError;
use crate::outcome::{Outcome, outcome};
use crate::output::files::{self, File};
use crate::output::plates::plates;
use crate::output::report::{ReportError, report};
use crate::output::{csv, summary};
use crate::run::Settings;
use crate::scenario::table1::{Drive, Imbalance, Variant, variants};

/// Runs spacecraft with imbalanced gyros and reports what the imbalance does.
#[derive(Debug, Parser)]
#[command(version, after_help = "Example:\n  precess run table1 --imbalance printed --drive 200")]
pub struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Run a scenario and write data, figures and a report.
    #[command(after_help = run_help())]
    Run(Run),
    /// List the scenarios and their variants.
    #[command(after_help = "Example:\n  precess list")]
    List,
}

/// The scenarios.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Name {
    /// Table 1 of the paper: a rigid hub with one imbalanced DGVSCMG.
    #[value(name = "table1")]
    Table1,
}

#[derive(Debug, Args)]
struct Run {
    /// The scenario.
    #[arg(value_enum, default_value = "table1")]
    scenario: Name,
    /// The wheel's imbalance; both without this option.
    #[arg(long, value_enum)]
    imbalance: Option<Imbalance>,
    /// The motors; all three without this option.
    #[arg(long, value_enum)]
    drive: Option<Drive>,
    /// Length of the run, s.
    #[arg(
        long,
        value_name = "SECONDS",
        allow_negative_numbers = true,
        default_value_t = Settings::default().duration
    )]
    duration: f64,
    /// Relative tolerance of one step.
    #[arg(long, allow_negative_numbers = true, default_value = "1e-13")]
    tolerance: f64,
    /// Samples recorded per second; 500 without this option, or the nearest that suits the
    /// duration.
    #[arg(long, value_name = "HERTZ", allow_negative_numbers = true)]
    rate: Option<f64>,
    /// Folder for the results; made if it is missing.
    #[arg(long, value_name = "FOLDER", default_value = "precess-out")]
    out: PathBuf,
}

impl Cli {
    /// Executes the command; `print` gets the text for the reader.
    ///
    /// # Errors
    /// Any error that ends the command early: no file has been written then, or only whole ones.
    /// And a run whose files are written and printed, but whose drifts exceed the bound for its
    /// settings (see [`crate::bound`]).
    pub fn execute(self, print: &mut dyn FnMut(&str)) -> Result<(), CliError> {
        match self.command {
            Command::Run(run) => run.execute(print),
            Command::List => {
                print(&list());
                Ok(())
            }
        }
    }
}

impl Run {
    fn execute(&self, print: &mut dyn FnMut(&str)) -> Result<(), CliError> {
        let Self { duration, tolerance, rate, .. } = *self;
        let rate = rate.unwrap_or_else(|| Settings::rate_for(duration));
        let settings = Settings { duration, tolerance, rate };
        settings.check().map_err(CliError::Settings)?;
        let Name::Table1 = self.scenario;
        let variants = variants(self.imbalance, self.drive);
        let names = variants.iter().flat_map(|v| file_names(&v.name())).collect::<Vec<_>>();
        // Rejected before the work, not after it.
        files::prepare(&self.out, names.iter().map(String::as_str).chain([REPORT]))?;
        let outcomes = run_all(&variants, settings)?;
        let mut results = Vec::new();
        let mut drawn = Vec::new();
        let text = summary::summary(&outcomes, &settings, &self.out, names.len() + 1);
        let beyond = outcomes
            .iter()
            .flat_map(|o| excesses(&o.scenario.name, &o.figures().drift))
            .collect::<Vec<_>>();
        for outcome in outcomes {
            let plates = plates(&outcome);
            let name = &outcome.scenario.name;
            results.push(File { name: format!("{name}.csv"), content: csv::csv(&outcome.history) });
            for plate in &plates {
                let content = plate.figure.file().map_err(ReportError::from)?;
                results.push(File { name: format!("{name}-{}.svg", plate.name), content });
            }
            drawn.push((outcome, plates));
        }
        results.push(File { name: REPORT.to_owned(), content: report(&drawn, &settings)? });
        files::write(&self.out, &results)?;
        print(&text);
        Ok(hold(&settings, beyond)?)
    }
}

const REPORT: &str = "report.html";

fn run_help() -> String {
    const EXAMPLES: &str = "\
Examples:
  precess run
      every variant of Table 1 into precess-out
  precess run table1 --imbalance catalogue --drive free --duration 2 --out short
      two seconds of one variant into short

At the default tolerance and duration, or within them, a drift of energy less work or of a momentum
beyond 1e-12 fails the command after its files are written; otherwise it is a note.";
    format!("{EXAMPLES}\n\n{}", csv::COLUMNS)
}

/// The files of one variant.
fn file_names(name: &str) -> [String; 4] {
    [".csv", "-angular-velocity.svg", "-position.svg", "-conservation.svg"]
        .map(|rest| format!("{name}{rest}"))
}

fn run_all(variants: &[Variant], settings: Settings) -> Result<Vec<Outcome<1>>, CliError> {
    const STEPS: u64 = 1000;
    // On standard error, and only if that is a terminal: indicatif sees to it.
    let bar = ProgressBar::new(STEPS * variants.len() as u64);
    if let Ok(style) = ProgressStyle::with_template("{msg:24} {wide_bar} {percent:>3} %") {
        bar.set_style(style);
    }
    let mut outcomes = Vec::new();
    for (variant, done) in variants.iter().zip(0_u64..) {
        let scenario = variant.scenario();
        let name = scenario.name.clone();
        bar.set_message(name.clone());
        let ran = outcome(scenario, settings, &mut |share| {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                clippy::cast_precision_loss,
                reason = "a share of a thousand"
            )]
            bar.set_position(STEPS * done + (share * STEPS as f64) as u64);
        });
        outcomes.push(ran.map_err(|source| CliError::Run { scenario: name, source })?);
    }
    bar.finish_and_clear();
    Ok(outcomes)
}

fn list() -> String {
    let mut text =
        String::from("table1  Table 1 of the paper: a rigid hub with one imbalanced DGVSCMG\n");
    for variant in variants(None, None) {
        let Variant { imbalance, drive } = variant;
        let (name, wheel, motors) = (variant.name(), imbalance.words(), drive.words());
        // Writing to a string cannot fail.
        let _ = writeln!(text, "  {name:22}  {wheel}, {motors}");
    }
    text
}

/// Prints to standard output; a reader that has gone away is no error.
pub fn print(text: &str) {
    let mut out = std::io::stdout().lock();
    let _ = out.write_all(text.as_bytes()).and_then(|()| out.flush());
}
