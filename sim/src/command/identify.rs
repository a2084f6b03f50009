//! `identify`: imbalance, friction, inertia and bias of a spacecraft from telemetry: a table, and a file of parts of a scenario.

use std::fmt::Write as _;
use std::path::PathBuf;

use clap::Args;
use indicatif::ProgressBar;

use super::error::CommandError;
use super::exit::Exit;
use super::outputs::Outputs;
use super::progress::{end_by_interrupts, uninterrupted};
use super::table::{aligned, six};
use super::terminal::print;
use crate::file::identification_example as example;
use crate::file::{from_file, identification_from_toml};
use crate::fit::Estimate;
use crate::identify::device::device;
use crate::identify::{Design, Identified, Manoeuvre, NamedEstimate, Progress, design, identify};
use crate::report::identify::IdentifyReport;
use crate::scenario::Scenario;
use crate::telemetry::Telemetry;
use crate::units::Plain;

pub(super) const HELP: &str = "\
Examples:
  precess identify --example .
      write an example: bus.toml, bus-unknown.toml and bus-telemetry.csv
  precess identify bus.toml --unknown bus-unknown.toml --data bus-telemetry.csv --out results
      find the unknowns: a table, and results/bus-identified.toml for scenarios
  precess identify bus.toml --unknown bus-unknown.toml --data bus-telemetry.csv --design slew.toml spin-up.toml
      also what each of these manoeuvres, scenarios of the same spacecraft, would tell
Where the model does not hold, or the data do not tell an unknown without a prior, the command says so and exits with 2.
The files are described in docs/identify.md.";

/// The options of `identify`.
#[derive(Debug, Args)]
pub(super) struct IdentifyCommand {
    /// The scenario of the spacecraft.
    #[arg(required_unless_present = "example", value_name = "SCENARIO")]
    file: Option<PathBuf>,
    /// What is unknown, TOML (docs/identify.md).
    #[arg(long, required_unless_present = "example", value_name = "FILE")]
    unknown: Option<PathBuf>,
    /// Telemetry: CSV, NPZ or Parquet.
    #[arg(long, required_unless_present = "example", value_name = "FILE")]
    data: Option<PathBuf>,
    /// Manoeuvres, scenarios of the same spacecraft: what each would tell that the telemetry does not.
    #[arg(long, value_name = "SCENARIO", num_args = 1.., conflicts_with = "example")]
    design: Vec<PathBuf>,
    /// Write an example into this folder.
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["file", "unknown", "data"])]
    example: Option<PathBuf>,
    /// Folder for the result; made if it is missing.
    #[arg(long, value_name = "FOLDER", default_value = "precess-out")]
    out: PathBuf,
    /// Replace files that are there.
    #[arg(long)]
    force: bool,
}

impl IdentifyCommand {
    pub(super) fn execute(&self) -> Result<Exit, CommandError> {
        if let Some(folder) = &self.example {
            return write_example(folder, self.force);
        }
        let (Some(path), Some(unknown), Some(data)) = (&self.file, &self.unknown, &self.data)
        else {
            return Ok(Exit::Error);
        };
        end_by_interrupts();
        let other = |error: &dyn std::fmt::Display| CommandError::Other(error.to_string());
        let (scenario, _) = from_file(path, &[]).map_err(CommandError::Scenario)?;
        let file = identification_from_toml(unknown, &scenario).map_err(CommandError::Scenario)?;
        let telemetry = Telemetry::read(data, &file.layout).map_err(|error| other(&error))?;
        let manoeuvres = self.manoeuvres()?;
        // Silent where the output is no terminal.
        let bar = ProgressBar::new_spinner();
        let mut progress = |at: &Progress| {
            let [part, whole] = at.part;
            bar.set_message(format!(
                "{part:.0} of {whole:.0} s, step {}: {:.0} s",
                at.step, at.time
            ));
            bar.tick();
            true
        };
        let found = identify(&scenario, &telemetry, &file.unknowns, &mut progress);
        bar.finish_and_clear();
        let found =
            found.map_err(|error| CommandError::Other(format!("{}: {error}", data.display())))?;
        let manoeuvres: Vec<_> =
            manoeuvres.iter().map(|(name, scenario)| Manoeuvre { name, scenario }).collect();
        let designed = if manoeuvres.is_empty() {
            String::new()
        } else {
            let of = design(&scenario, &file.unknowns, &found, &manoeuvres);
            design_table(&of.map_err(|error| other(&error))?)
        };
        let text = device(&found, &scenario, &file.layouts);
        let of_unknowns = std::fs::read_to_string(unknown)
            .map_err(|source| CommandError::Io { path: unknown.clone(), source })?;
        let report = IdentifyReport {
            name: &file.name,
            title: &file.title,
            text: &of_unknowns,
            found: &found,
        };
        let page = report.html().map_err(|error| other(&error))?;
        let files = [
            (format!("{}-identified.toml", file.name), text),
            (format!("{}-identified.html", file.name), page),
        ];
        let paths = uninterrupted(|| Outputs::reserve(&self.out, &[], self.force)?.write(&files))?;
        let paths: Vec<_> = paths.iter().map(|path| path.display().to_string()).collect();
        let table = table(&found) + &designed;
        print(&format!("{}\n\n{table}\n{}\n", file.title, paths.join("\n")))?;
        let exit = if found.holds() && found.is_told() { Exit::Success } else { Exit::Violated };
        Ok(exit)
    }
}

impl IdentifyCommand {
    /// The scenarios of `--design` with their names.
    fn manoeuvres(&self) -> Result<Vec<(String, Scenario)>, CommandError> {
        let read = |path: &PathBuf| {
            let (scenario, _) = from_file(path, &[]).map_err(CommandError::Scenario)?;
            let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            Ok((name, scenario))
        };
        self.design.iter().map(read).collect()
    }
}

/// What manoeuvres would tell, for people.
fn design_table(of: &Design) -> String {
    let number = |value: f64| if value.is_finite() { six(value) } else { "not told".to_owned() };
    let mut head = vec!["standard deviation".to_owned(), "record".to_owned()];
    head.extend(of.manoeuvres.iter().map(|name| format!("with {name}")));
    let mut rows = vec![head.clone()];
    for own in &of.numbers {
        let mut cells = vec![own.name.clone(), number(own.alone)];
        cells.extend(own.with.iter().map(|with| number(*with)));
        cells.push(own.unit.to_owned());
        rows.push(cells);
    }
    let mut text = "\nmanoeuvres\n".to_owned();
    let lengths = of.manoeuvres.iter().zip(&of.durations);
    text.extend(lengths.map(|(name, length)| format!("- {name}: {} s\n", Plain(*length))));
    let _ = write!(text, "\n{}", aligned(&rows));
    if !of.directions.is_empty() {
        let mut list = String::new();
        head[0].replace_range(.., "in steps of it");
        let mut rows = vec![head];
        for (number, own) in of.directions.iter().enumerate() {
            let place = number + 1;
            // Writing to a string cannot fail.
            let _ = writeln!(list, "{place}. {}", own.direction);
            let mut cells = vec![place.to_string(), "not told".to_owned()];
            cells.extend(own.with.iter().enumerate().map(|(manoeuvre, deviation)| {
                let told = if own.is_told_by(manoeuvre) { "told" } else { "not told" };
                format!("{told}, {deviation:.2e}")
            }));
            rows.push(cells);
        }
        let _ = write!(
            text,
            "\nwhat the record does not tell of the spacecraft, a change by any multiple of\n{list}\nits standard deviation by the \
             readings\n{}",
            aligned(&rows)
        );
    }
    text
}

fn write_example(folder: &std::path::Path, force: bool) -> Result<Exit, CommandError> {
    let truth = example::truth().map_err(CommandError::Scenario)?;
    let telemetry =
        example::telemetry(&truth).map_err(|error| CommandError::Other(error.to_string()))?;
    let files = [
        (example::SCENARIO_FILE.to_owned(), example::SCENARIO.to_owned()),
        (example::UNKNOWN_FILE.to_owned(), example::UNKNOWN.to_owned()),
        (example::TELEMETRY_FILE.to_owned(), telemetry),
    ];
    let paths = uninterrupted(|| Outputs::reserve(folder, &[], force)?.write(&files))?;
    let lines: Vec<_> = paths.iter().map(|path| path.display().to_string()).collect();
    print(&(lines.join("\n") + "\n"))?;
    Ok(Exit::Success)
}

/// A row: name, value, interval, unit.
fn row(name: &str, estimate: &Estimate, unit: &str, told: bool) -> Vec<String> {
    let [low, high] = estimate.interval.map(six);
    if told {
        return vec![name.to_owned(), six(estimate.value), low, high, unit.to_owned()];
    }
    let none = String::new();
    vec![name.to_owned(), "not told".to_owned(), none.clone(), none, unit.to_owned()]
}

/// Everything that was found, for people.
fn table(found: &Identified) -> String {
    let heading = |text: &str| vec![text.to_owned()];
    let mut rows = vec![["", "value", "95 % from", "to", "unit"].map(str::to_owned).to_vec()];
    for wheel in &found.wheels {
        let told = wheel.told;
        let degrees = |angle: &Estimate| angle.times(180.0 / std::f64::consts::PI);
        rows.push(heading(&wheel.device));
        let [u_s, u_d] = wheel.hidden;
        for (name, estimate, unit, hidden) in [
            ("U_s", wheel.u_s.times(1e5), "g cm", u_s),
            ("U_d", wheel.u_d.times(1e7), "g cm^2", u_d),
            ("phase of U_d", degrees(&wheel.phase), "deg", u_s || u_d),
            ("angle at the start", degrees(&wheel.angle), "deg", u_s),
        ] {
            let mut cells = row(name, &estimate, unit, told);
            if let (true, true, Some(cell)) = (told, hidden, cells.get_mut(1)) {
                "hidden by noise".clone_into(cell);
            }
            rows.push(cells);
        }
    }
    rows.push(heading("numbers"));
    let of_wheel = |of: &&NamedEstimate| {
        found.wheels.iter().any(|wheel| {
            let own = of.name.strip_prefix(&wheel.device);
            own.is_some_and(|own| own.starts_with(".static_") || own.starts_with(".j_"))
        })
    };
    for of in found.numbers.iter().filter(|of| !of_wheel(of)) {
        rows.push(row(&of.name, &of.estimate, of.unit, of.told));
    }
    let mut text = aligned(&rows);
    text.push_str("\nmean square of residuals by variance (noise has 1), numbers, beyond three standard deviations\n");
    let rows: Vec<_> = found
        .residuals
        .iter()
        .map(|of| {
            vec![
                of.sensor.to_owned(),
                six(of.mean_square),
                of.count.to_string(),
                of.outliers.to_string(),
            ]
        })
        .collect();
    text.push_str(&aligned(&rows));
    let [from, to] = found.span;
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "\nfrom {} s to {} s; steps of at most {} s; {} steps over the whole record",
        Plain(from),
        Plain(to),
        six(found.step),
        found.steps
    );
    let mut lines: Vec<String> = found.exclusions.iter().map(|of| format!("- {of}\n")).collect();
    if found.outside > 0 {
        lines.push(format!(
            "- {} readings outside the time in which every motor's torque is known\n",
            found.outside
        ));
    }
    let correlated = found.correlations.iter().take(12).map(|of| {
        let [a, b] = &of.names;
        format!("- {a} and {b}: {:.3}\n", of.correlation)
    });
    let untold = found.untold.iter().map(|of| {
        let by = if of.has_prior { "; the prior tells it" } else { "" };
        format!("- {of}{by}\n")
    });
    for (heading, lines) in [
        ("left out", lines),
        ("correlations of 0.9 and more", correlated.collect()),
        ("what the data do not tell: a change by any multiple of", untold.collect()),
    ] {
        if !lines.is_empty() {
            let _ = write!(text, "\n{heading}\n{}", lines.concat());
        }
    }
    if !found.holds() {
        text.push_str(
            "\nthe model does not hold: intervals are wider by the root of the mean square\n",
        );
    }
    text
}
