//! `fit`: the disturbance model of a wheel from forces and moments on a rigid table: a table, a device file,
//! sources, a report and pictures.

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::path::PathBuf;
use std::time::Duration;

use clap::Args;
use indicatif::ProgressBar;

use super::error::CommandError;
use super::exit::Exit;
use super::outputs::Outputs;
use super::progress::{end_by_interrupts, uninterrupted};
use super::table::{aligned, six};
use super::terminal::print;
use crate::file::measurement_from_toml;
use crate::fit::device::{device, sources};
use crate::fit::{
    Discrepancy, Estimate, Fitted, Group, Harmonic, SQUARES_MAX, Sense, example, fit_waterfall,
    fit_with_progress,
};
use crate::report::fit::FitReport;

pub(super) const HELP: &str = "\
Examples:
  precess fit --example .
      write an example: wheel-measurement.toml and wheel-sweep.csv
  precess fit wheel-measurement.toml --out results
      fit it: a table, rw-device.toml and rw-sources.toml for scenarios, rw-fit.html, figures
Where the model does not hold, the command says why, writes no device and no sources, and exits with 2.
The file is described in docs/fit.md.";

/// The options of `fit`.
#[derive(Debug, Args)]
pub(super) struct FitCommand {
    /// What was measured, TOML (docs/fit.md).
    #[arg(required_unless_present = "example", value_name = "MEASUREMENT")]
    file: Option<PathBuf>,
    /// Write an example of a measurement into this folder.
    #[arg(long, value_name = "FOLDER", conflicts_with = "file")]
    example: Option<PathBuf>,
    /// Folder for the device file and the figures; made if it is missing.
    #[arg(long, value_name = "FOLDER", default_value = "precess-out")]
    out: PathBuf,
    /// Replace files that are there.
    #[arg(long)]
    force: bool,
}

impl FitCommand {
    pub(super) fn execute(&self) -> Result<Exit, CommandError> {
        if let Some(folder) = &self.example {
            let files = [
                (example::DESCRIPTION.to_owned(), example::TOML.to_owned()),
                (example::SAMPLES.to_owned(), example::samples()),
            ];
            print(&write(folder, &files, self.force)?)?;
            return Ok(Exit::Success);
        }
        let Some(path) = &self.file else { return Ok(Exit::Error) };
        end_by_interrupts();
        // Silent where the output is no terminal.
        let bar = ProgressBar::new_spinner();
        bar.enable_steady_tick(Duration::from_millis(100));
        let mut progress = |what: &str| bar.set_message(what.to_owned());
        let read = measurement_from_toml(path, &mut progress).map_err(CommandError::Scenario);
        let fitted = read.and_then(|file| {
            let fitted = if file.waterfall.is_empty() {
                fit_with_progress(&file.measurement, &file.options, &mut progress)
            } else {
                progress("lines and modes");
                fit_waterfall(&file.waterfall, &file.options)
            };
            let fitted = fitted
                .map_err(|error| CommandError::Other(format!("{}: {error}", path.display())))?;
            Ok((file, fitted))
        });
        bar.finish_and_clear();
        let (file, fitted) = fitted?;
        let name = &file.name;
        let written = device(&fitted, name, file.rotor.as_ref());
        let soft = written.contains("kind = \"flexible_reaction_wheel\"");
        // Not as if they were good.
        let mut files = Vec::new();
        if fitted.holds() {
            files.push((format!("{name}-device.toml"), written));
            files.push((format!("{name}-sources.toml"), sources(&fitted, name, soft)));
        }
        let text = std::fs::read_to_string(path)
            .map_err(|source| CommandError::Io { path: path.clone(), source })?;
        let report = FitReport {
            name,
            title: &file.title,
            text: &text,
            fitted: &fitted,
            of_spectra: !file.waterfall.is_empty(),
        };
        files.extend(report.files().map_err(|error| CommandError::Other(error.to_string()))?);
        let paths = write(&self.out, &files, self.force)?;
        print(&format!("{}\n\n{}\n{paths}", file.title, table(&fitted)))?;
        if fitted.holds() {
            return Ok(Exit::Success);
        }
        let old = [format!("{name}-device.toml"), format!("{name}-sources.toml")];
        for path in old.map(|file| self.out.join(file)).iter().filter(|path| path.exists()) {
            print(&format!("{} is of an earlier fit\n", path.display()))?;
        }
        print("the model does not hold: no device and no sources are written\n")?;
        Ok(Exit::Violated)
    }
}

/// Writes files; their paths, a line each.
fn write(
    folder: &std::path::Path,
    files: &[(String, String)],
    force: bool,
) -> Result<String, CommandError> {
    let paths = uninterrupted(|| Outputs::reserve(folder, &[], force)?.write(files))?;
    let lines: Vec<_> = paths.iter().map(|path| path.display().to_string()).collect();
    Ok(lines.join("\n") + "\n")
}

/// A row: name, value, interval, unit.
fn row(name: &str, estimate: &Estimate, unit: &str) -> Vec<String> {
    let [low, high] = estimate.interval.map(six);
    vec![name.to_owned(), six(estimate.value), low, high, unit.to_owned()]
}

fn unknown(name: &str, why: &str) -> Vec<String> {
    vec![name.to_owned(), "unknown".to_owned(), String::new(), String::new(), why.to_owned()]
}

/// Everything that was fitted, for people.
fn table(fitted: &Fitted) -> String {
    let degrees = |angle: &Estimate| angle.times(360.0 / TAU);
    let head = ["", "value", "95 % from", "to", "unit"].map(str::to_owned).to_vec();
    let heading = |text: &str| vec![text.to_owned()];
    let mut rows = vec![head, heading("imbalance")];
    let imbalance = &fitted.imbalance;
    // 1 kg m is 1e5 g cm, 1 kg m² is 1e7 g cm².
    rows.push(row("U_s", &imbalance.u_s.times(1e5), "g cm"));
    rows.push(row("U_d", &imbalance.u_d.times(1e7), "g cm^2"));
    rows.push(match &imbalance.phase {
        Some(phase) => row("phase of U_d", &degrees(phase), "deg"),
        None => unknown("phase of U_d", "hidden by noise"),
    });
    rows.push(match &imbalance.angle {
        Some(angle) => row("angle of U_s", &degrees(angle), "deg"),
        None => unknown("angle of U_s", "no index"),
    });
    for harmonic in &fitted.harmonics {
        rows.extend(of_harmonic(harmonic));
    }
    for mode in &fitted.modes {
        rows.push(heading(&format!("\nmode of the {}", mode.group)));
        rows.push(row("frequency", &mode.frequency.times(1.0 / TAU), "Hz"));
        rows.push(row("damping ratio", &mode.damping, ""));
        if mode.inertia_ratio.value != 0.0 {
            rows.push(row("I_s / I_r", &mode.inertia_ratio, ""));
        }
        if mode.share.deviation > 0.0 {
            rows.push(row("share", &mode.share, ""));
        }
    }
    let mut text = aligned(&rows);
    let _ = writeln!(
        text,
        "\nmean square of residuals by variance (noise has 1; up to {SQUARES_MAX}, or what few residuals reach by \
         chance, the model holds), degrees of freedom"
    );
    let rows: Vec<_> = fitted
        .groups
        .iter()
        .map(|fit| vec![fit.group.to_string(), six(fit.squares / fit.freedom), six(fit.freedom)])
        .collect();
    text.push_str(&aligned(&rows));
    let mut rows = vec![heading("\nbroadband noise of each axis, mean over all speeds")];
    rows.push(["", "from (Hz)", "to (Hz)", "density"].map(str::to_owned).to_vec());
    for (group, bands) in &fitted.floors {
        let unit = if group.is_torque() { "N^2 m^2/Hz" } else { "N^2/Hz" };
        let ends = bands.first().zip(bands.last()).map(|(a, b)| [a.range[0], b.range[1]]);
        let densities = || bands.iter().map(|band| band.density.value);
        let (low, high) =
            (densities().fold(f64::INFINITY, f64::min), densities().fold(0.0, f64::max));
        if let Some([from, to]) = ends {
            let density = format!("{low:.2e} to {high:.2e} {unit}");
            rows.push(vec![group.to_string(), six(from), six(to), density]);
        }
    }
    text.push_str(&aligned(&rows));
    for (heading, fails) in [("remarks", false), ("what the model does not explain", true)] {
        let own = |d: &&Discrepancy| d.fails() == fails;
        let lines: Vec<_> =
            fitted.discrepancies.iter().filter(own).map(|d| format!("- {d}\n")).collect();
        if !lines.is_empty() {
            let _ = write!(text, "\n{heading}\n{}", lines.concat());
        }
    }
    text
}

/// Rows of a harmonic: its number, and its coefficients above the noise; of h = 1 those beside the imbalance.
fn of_harmonic(harmonic: &Harmonic) -> Vec<Vec<String>> {
    let first = harmonic.number.value == 1.0;
    let of_imbalance =
        |group: Group, sense| first && group.is_radial() && matches!(sense, Sense::Forward);
    let shown: Vec<_> = harmonic
        .coefficients
        .iter()
        .filter(|c| c.seen && !of_imbalance(c.group, c.sense))
        .collect();
    let mut rows = Vec::new();
    if first && shown.is_empty() {
        return rows;
    }
    if first {
        rows.push(vec!["\nharmonic 1, beside the imbalance".to_owned()]);
    } else {
        rows.push(vec![format!("\nharmonic {:.4}", harmonic.number.value)]);
        rows.push(row("h", &harmonic.number, ""));
    }
    for c in &shown {
        let sense = match (c.group.is_radial(), c.sense) {
            (false, _) => "",
            (true, Sense::Forward) => ", forward",
            (true, Sense::Backward) => ", backward",
        };
        rows.push(row(&format!("C, {}{sense}", c.group), &c.c, c.group.coefficient_unit()));
        if let Some(phase) = &c.phase {
            rows.push(row("  phase", &phase.times(360.0 / TAU), "deg"));
        }
    }
    if shown.is_empty() {
        let measured = !harmonic.coefficients.is_empty();
        let why =
            if measured { "hidden by noise" } else { "out of the band, or beside another line" };
        rows.push(unknown("C", why));
    }
    rows
}
