//! `watch`: a scenario's model run along telemetry, and what has changed: alarms, the quantities of every
//! block, a page.

use std::fmt::Write as _;
use std::fs;
use std::io::Write as _;
use std::path::PathBuf;

use clap::Args;
use serde::Serialize;

use super::error::CommandError;
use super::exit::Exit;
use super::options::{Form, Set};
use super::outputs::Outputs;
use super::plot::time;
use super::progress::{end_by_interrupts, end_if_interrupted, uninterrupted};
use super::table::six;
use super::terminal::{note, print};
use crate::file::from_file;
use crate::record::partial::{Partial, partial_name};
use crate::record::{Decimate, Recorder as _};
use crate::report::watch::{BUCKETS, WatchReport, WatchedQuantity, shown};
use crate::telemetry::{Exclusion, TelemetryLayout, TelemetryRows};
use crate::watch::{Alarm, Block, Watch, WatchError, WatchSettings, Watched};

pub(super) const HELP: &str = "\
Examples:
  precess watch bus.toml --data telemetry.csv
      what has changed since the first ten minutes; the page precess-out/bus-watch.html
  precess watch bus.toml --data telemetry.npz --learn '300 s' --false-alarms 0.1 --format json
Columns are named as those of a run: time, aocs.gyro_x to _z, rw1.spin, rw1.u_w (docs/health.md).";

/// Alarms that are kept; further ones are counted.
const KEPT: usize = 1000;

/// The options of `watch`.
#[derive(Debug, Args)]
pub(super) struct WatchCommand {
    /// The scenario file: what is known of the spacecraft.
    #[arg(value_name = "SCENARIO")]
    file: PathBuf,
    /// The telemetry (CSV, NPZ, Parquet).
    #[arg(long, value_name = "FILE")]
    data: PathBuf,
    #[command(flatten)]
    overrides: Set,
    /// The controller whose sensors the telemetry is of; the only one without this option.
    #[arg(long, value_name = "NAME")]
    controller: Option<String>,
    /// Length of a block, with its unit.
    #[arg(long, value_name = "TIME", value_parser = time, default_value = "2 s")]
    block: f64,
    /// How long the reference is taken, from the start.
    #[arg(long, value_name = "TIME", value_parser = time, default_value = "600 s")]
    learn: f64,
    /// False alarms an hour, of all tests together.
    #[arg(long, value_name = "NUMBER", default_value_t = 1.0)]
    false_alarms: f64,
    /// Folder for the files; made if it is missing.
    #[arg(long, value_name = "FOLDER", default_value = "precess-out")]
    out: PathBuf,
    /// Replace files that are there.
    #[arg(long)]
    force: bool,
    /// How alarms are printed.
    #[arg(long, value_enum, default_value_t)]
    format: Form,
}

/// Everything that is printed.
struct Findings {
    alarms: Vec<Alarm>,
    further: u64,
    blocks: u64,
    /// Start of the first block and end of the last one, s.
    span: Option<[f64; 2]>,
    references: Vec<WatchedQuantity>,
    /// The middle of each block and each quantity, for the figures.
    history: Decimate,
}

impl WatchCommand {
    pub(super) fn execute(&self) -> Result<Exit, CommandError> {
        end_by_interrupts();
        let (scenario, reports) =
            from_file(&self.file, &self.overrides.overrides()).map_err(CommandError::Scenario)?;
        for warning in &reports.all {
            note(&format!("warning: {}", warning.message));
        }
        let other = |error: &dyn std::fmt::Display| {
            CommandError::Other(format!("{}: {error}", scenario.name))
        };
        let layout = TelemetryLayout::of_scenario(&scenario, self.controller.as_deref());
        let layout = layout.map_err(|error| other(&error))?;
        let telemetry =
            |error: crate::telemetry::TelemetryError| CommandError::Other(error.to_string());
        let mut rows = TelemetryRows::open(&self.data, &layout).map_err(telemetry)?;
        let settings =
            WatchSettings { block: self.block, learn: self.learn, false_alarms: self.false_alarms };
        let mut watch =
            Watch::new(&scenario, rows.sensors(), &settings).map_err(|error| other(&error))?;
        for remark in watch.remarks() {
            note(&format!("warning: {remark}"));
        }
        let [blocks, alarms, page] = ["watch.csv", "alarms.json", "watch.html"]
            .map(|ending| format!("{}-{ending}", scenario.name));
        let names = [blocks.clone(), alarms.clone(), page.clone()];
        let mut outputs = uninterrupted(|| Outputs::reserve(&self.out, &names, self.force))?;
        let path = self.out.join(&blocks);
        let io = |source| CommandError::Io { path: path.clone(), source };
        let Some(reservation) = outputs.take(&blocks) else { return Ok(Exit::Error) };
        let mut table = reservation.begin().map_err(io)?;
        let mut found = Findings {
            alarms: Vec::new(),
            further: 0,
            blocks: 0,
            span: None,
            references: Vec::new(),
            history: Decimate::new(BUCKETS),
        };
        let done = head(&mut table, &watch).map_err(io).and_then(|()| {
            let mut next = || {
                end_if_interrupted();
                rows.next_reading().map_err(WatchError::Telemetry)
            };
            while let Some(block) = watch.next_block(&mut next).map_err(|error| match error {
                WatchError::Telemetry(error) => telemetry(error),
                error => other(&error),
            })? {
                row(&mut table, &block).map_err(io)?;
                found.take(block)?;
            }
            Ok(())
        });
        if let Err(error) = done {
            let _ = table.discard();
            return Err(error);
        }
        let references = watch.references();
        found.references = watch
            .quantities()
            .zip(references)
            .map(|((name, watched), reference)| (name.to_owned(), watched.clone(), reference))
            .collect();
        if let Err(source) = uninterrupted(|| table.finish()) {
            let _ = fs::remove_file(partial_name(&path));
            return Err(io(source));
        }
        let json = found.json(rows.exclusions());
        let html = WatchReport {
            name: &scenario.name,
            title: &scenario.title,
            settings: &settings,
            blocks: found.blocks,
            span: found.span.unwrap_or_default(),
            quantities: &found.references,
            history: &found.history,
            alarms: &found.alarms,
            further: found.further,
            exclusions: rows.exclusions(),
        };
        let html = html.html().map_err(|error| other(&error).leaving(vec![path.clone()]))?;
        let files = [(alarms.clone(), &json), (page.clone(), &html)];
        let written = uninterrupted(|| outputs.write(&files));
        written.map_err(|error| error.leaving(vec![path.clone()]))?;
        match self.format {
            Form::Json => print(&json)?,
            Form::Text => {
                let folder = self.out.display();
                print(&found.text(&settings, rows.exclusions()))?;
                print(&format!("files: {folder}/{page}, {folder}/{blocks}, {folder}/{alarms}\n"))?;
            }
        }
        if found.blocks == 0 {
            note("warning: the telemetry is shorter than a block: nothing was watched");
            return Ok(Exit::NotEvaluated);
        }
        Ok(if found.alarms.is_empty() { Exit::Success } else { Exit::Violated })
    }
}

/// The names of the columns: each quantity and its standard deviation, SI units.
fn head(to: &mut Partial, watch: &Watch) -> std::io::Result<()> {
    let mut line = "start,end".to_owned();
    for (name, watched) in watch.quantities() {
        let _ = write!(line, ",{name} ({0}),deviation ({0})", watched.unit());
    }
    writeln!(to, "{line},alarms")
}

/// A row; cells of what a block does not determine are empty.
fn row(to: &mut Partial, block: &Block) -> std::io::Result<()> {
    let [start, end] = block.times;
    let mut line = format!("{start},{end}");
    for value in &block.values {
        match value {
            Some([value, variance]) => {
                let _ = write!(line, ",{value:e},{:e}", variance.sqrt());
            }
            None => line.push_str(",,"),
        }
    }
    writeln!(to, "{line},{}", block.alarms.len())
}

impl Findings {
    fn take(&mut self, block: Block) -> Result<(), CommandError> {
        self.blocks += 1;
        let [start, end] = block.times;
        self.span = Some([self.span.map_or(start, |[first, _]| first), end]);
        let values = block.values.iter().map(|of| of.map_or(f64::NAN, |[value, _]| value));
        let row: Vec<f64> = std::iter::once(0.5 * (start + end)).chain(values).collect();
        self.history.sample(&row).map_err(|error| CommandError::Other(error.to_string()))?;
        for alarm in block.alarms {
            if self.alarms.len() < KEPT {
                self.alarms.push(alarm);
            } else {
                self.further += 1;
            }
        }
        Ok(())
    }

    /// For people.
    fn text(&self, settings: &WatchSettings, exclusions: &[Exclusion]) -> String {
        let mut text = String::new();
        for exclusion in exclusions {
            let _ = writeln!(text, "{exclusion}");
        }
        let [from, to] = self.span.unwrap_or_default();
        let _ = writeln!(
            text,
            "{} blocks of {} s from {} s to {} s, {} quantities, {} false alarms an hour at most",
            self.blocks,
            six(settings.block),
            six(from),
            six(to),
            self.references.len(),
            six(settings.false_alarms)
        );
        for (name, watched, reference) in &self.references {
            match reference {
                // It is found in the series of drag.
                None if *watched == Watched::TorqueConstant => {}
                None => {
                    let _ =
                        writeln!(text, "{name}: not enough blocks determine it for a reference");
                }
                Some([_, scatter]) if *scatter > 1.0 => {
                    let _ = writeln!(
                        text,
                        "{name}: scatters {} times as much as white noise of the sensors; its bounds are as wide",
                        six(scatter.sqrt())
                    );
                }
                Some(_) => {}
            }
        }
        for alarm in &self.alarms {
            text.push_str(&sentence(alarm));
        }
        if self.further > 0 {
            let _ = writeln!(text, "and {} further alarms", self.further);
        }
        if self.alarms.is_empty() {
            text.push_str("no alarm\n");
        }
        text
    }

    /// For programs.
    fn json(&self, exclusions: &[Exclusion]) -> String {
        let alarms: Vec<_> = self.alarms.iter().map(AlarmJson::new).collect();
        let excluded: Vec<String> = exclusions.iter().map(ToString::to_string).collect();
        let all = serde_json::json!({
            "blocks": self.blocks,
            "span": self.span,
            "alarms": alarms,
            "further_alarms": self.further,
            "excluded": excluded,
        });
        format!("{all:#}\n")
    }
}

/// An alarm: what, when, by how much, what else would look the same.
fn sentence(alarm: &Alarm) -> String {
    let Alarm { name, watched, of: _, time, shift, alike } = alarm;
    let of = |value: f64| shown(watched, value);
    let ((change, unit), (half, _)) = (of(shift.change), of(shift.half_width));
    let (before, _) = of(shift.before);
    let test = shift.test.name();
    let mut text = format!(
        "alarm at {} s: {name} has changed by {} {unit} (95 %: {} to {}) from {} {unit}, since {} s ({test})\n",
        six(*time),
        six(change),
        six(change - half),
        six(change + half),
        six(before),
        six(shift.onset)
    );
    for other in alike {
        let _ = writeln!(text, "    the same to these sensors: {other}");
    }
    text
}

#[derive(Serialize)]
struct AlarmJson<'a> {
    name: &'a str,
    unit: &'static str,
    time: f64,
    onset: f64,
    before: f64,
    change: f64,
    interval: [f64; 2],
    test: String,
    alike: &'a [String],
}

impl<'a> AlarmJson<'a> {
    fn new(alarm: &'a Alarm) -> Self {
        let shift = &alarm.shift;
        Self {
            name: &alarm.name,
            unit: alarm.watched.unit(),
            time: alarm.time,
            onset: shift.onset,
            before: shift.before,
            change: shift.change,
            interval: [shift.change - shift.half_width, shift.change + shift.half_width],
            test: shift.test.name().replace(' ', "_"),
            alike: &alarm.alike,
        }
    }
}
