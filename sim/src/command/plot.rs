//! `plot`: the figures of a run, as SVG files.

use std::path::PathBuf;

use clap::Args;

use super::error::CommandError;
use super::exit::Exit;
use super::options::Files;
use super::outputs::{Outputs, files};
use super::progress::{interrupted, watch_interrupts, with_progress};
use super::scenarios::read_all;
use super::terminal::{note, print};
use crate::record::IntervalRecorder;
use crate::report::Report;
use crate::scenario::Scenario;
use crate::units::{Measure, Plain, parse_quantity};

/// The options of `plot`.
#[derive(Debug, Args)]
pub(super) struct Plot {
    #[command(flatten)]
    files: Files,
    /// Folder for the figures; made if it is missing.
    #[arg(long, value_name = "FOLDER", default_value = "precess-out")]
    out: PathBuf,
    /// Replace figures that are there.
    #[arg(long)]
    force: bool,
    /// Time at which the figures start, with its unit: "0.2 s".
    #[arg(long, value_name = "TIME", value_parser = time)]
    from: Option<f64>,
    /// Time at which the figures, and the run, end.
    #[arg(long, value_name = "TIME", value_parser = time)]
    to: Option<f64>,
}

/// A time with its unit, s.
pub(super) fn time(text: &str) -> Result<f64, String> {
    let example = "write a number and a unit of time: \"0.2 s\"";
    let quantity = parse_quantity(text).map_err(|error| format!("{}; {example}", error.kind))?;
    match quantity.values[..] {
        [value] if quantity.is(Measure::TIME) => Ok(value),
        _ => Err(format!("`{text}` is no time; {example}")),
    }
}

impl Plot {
    pub(super) fn execute(&self) -> Result<Exit, CommandError> {
        let scenarios = read_all(&self.files)?;
        let mut earlier = Vec::new();
        for (scenario, _) in &scenarios {
            earlier.extend(self.earlier(scenario)?);
        }
        let mut outputs = Outputs::reserve(&self.out, &earlier, self.force)?;
        watch_interrupts();
        for (scenario, _) in &scenarios {
            let mut report = Report::new(scenario, &[]);
            let interval = self.interval(scenario)?;
            let mut part = IntervalRecorder::new(interval, &mut report);
            with_progress(scenario, interval[1], &mut part)?;
            let figures = report.figures().map_err(|e| CommandError::Other(e.to_string()))?;
            let name = |of: String| format!("{}-{of}.svg", scenario.name);
            let figures: Vec<_> = figures.into_iter().map(|(of, svg)| (name(of), svg)).collect();
            for path in outputs.write(&figures)? {
                print(&format!("{}\n", path.display()))?;
            }
            if interrupted() {
                note("interrupted: the figures are of a shorter run");
                return Ok(Exit::Violated);
            }
        }
        Ok(Exit::Success)
    }

    /// The interval of the figures, s.
    fn interval(&self, scenario: &Scenario) -> Result<[f64; 2], CommandError> {
        let duration = scenario.settings.duration;
        let [from, to] = [self.from.unwrap_or(0.0), self.to.unwrap_or(duration)];
        if 0.0 <= from && from < to && to <= duration {
            return Ok([from, to]);
        }
        let name = &scenario.name;
        let message = format!(
            "{name}: {} s to {} s is not within the run's {} s",
            Plain(from),
            Plain(to),
            Plain(duration)
        );
        Err(CommandError::Other(message))
    }

    /// The figures of a scenario that are there. Which ones a run has is known only at its end.
    fn earlier(&self, scenario: &Scenario) -> Result<Vec<String>, CommandError> {
        if !self.out.exists() {
            return Ok(Vec::new());
        }
        let of_it = |name: &String| {
            name.strip_prefix(&scenario.name).is_some_and(|rest| rest.starts_with('-'))
        };
        Ok(files(&self.out, "svg")?.into_iter().filter(of_it).collect())
    }
}
