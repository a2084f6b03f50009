//! `margins`: the loop of a scenario's controller: gain, phase and delay margins, sensitivity, poles, lines of rotors and their
//! aliases, noise; a table, JSON, CSV, figures and a report.

mod files;

use std::fmt::Write as _;
use std::path::PathBuf;

use clap::Args;
use precess_control::AtFrequency;

use super::error::CommandError;
use super::exit::Exit;
use super::options::Set;
use super::outputs::Outputs;
use super::progress::progress_bar;
use super::table::{aligned, six};
use super::terminal::{note, print};
use crate::file::from_file;
use crate::margins::MarginsError;
use crate::margins::analysis::{AXES, ControlLoop, LoopAnalysis, chosen};
use crate::margins::lines::ClosedLine;
use crate::margins::measurement::ReadingNoise;
use crate::margins::noise::NoiseGains;
use crate::margins::notes::notes;
use crate::pointing::RequirementState;
use crate::report::margins::{LeastMargins, MarginsReport, decibels, margin};
use crate::scenario::{LoopMargin, SampledController, Scenario, decibels as decibels_of};
use crate::units::{Measure, parse_quantity};

pub(super) const HELP: &str = "\
Examples:
  precess margins scenarios/four-wheel-slew.toml
      margins, poles and lines, with a report into the folder precess-out
  precess margins bus.toml --set controller.aocs.delay='100 ms' --phase-margin '40 deg'
      the same with a longer delay and another limit
  precess margins bus.toml --attitude-noise '5 arcsec' --rate-noise '1 urad/s'
      and the RMS of the attitude by noise of what is measured";

/// Radians of a second of arc.
const ARCSEC: f64 = std::f64::consts::PI / 648_000.0;
/// Poles, oscillations and lines that are printed, at most.
const ROWS_MAX: usize = 16;
/// The least gain margin, dB, and the least phase margin, degrees, where neither an option nor a requirement states one.
const GAIN_LEAST: f64 = 6.0;
const PHASE_LEAST: f64 = 30.0;
/// Steps of the work.
const STEPS: usize = 4;

/// The options of `margins`.
#[derive(Debug, Args)]
pub(super) struct Margins {
    /// The scenario file.
    #[arg(value_name = "SCENARIO")]
    file: PathBuf,
    /// The controller, where there are several.
    #[arg(long, value_name = "NAME")]
    controller: Option<String>,
    #[command(flatten)]
    overrides: Set,
    /// The least gain margin of an axis, upwards and downwards, dB; without it that of the scenario's requirement, or 6 dB.
    #[arg(long, value_name = "DB", value_parser = gain)]
    gain_margin: Option<f64>,
    /// The least phase margin of an axis, with its unit; without it that of the scenario's requirement, or 30 deg.
    #[arg(long, value_name = "ANGLE", value_parser = angle)]
    phase_margin: Option<f64>,
    /// Standard deviation of the rotation that is read about each axis at a sample, with its unit: in the place of the star tracker's.
    #[arg(long, value_name = "ANGLE", value_parser = angle)]
    attitude_noise: Option<f64>,
    /// Standard deviation of the rate that is read about each axis at a sample, with its unit: in the place of the gyro's.
    #[arg(long, value_name = "RATE", value_parser = rate)]
    rate_noise: Option<f64>,
    /// Folder for the results; made if it is missing.
    #[arg(long, value_name = "FOLDER", default_value = "precess-out")]
    out: PathBuf,
    /// Replace results that are there.
    #[arg(long)]
    force: bool,
}

/// A quantity that is not negative, SI.
fn quantity(text: &str, measure: Measure, example: &str) -> Result<f64, String> {
    let example = format!("write a number and a unit: \"{example}\"");
    let found = parse_quantity(text).map_err(|error| format!("{}; {example}", error.kind))?;
    match found.values[..] {
        [value] if found.is(measure) && value >= 0.0 => Ok(value),
        _ => Err(format!("`{text}` does not fit; {example}")),
    }
}

fn angle(text: &str) -> Result<f64, String> {
    quantity(text, Measure::ANGLE, "30 deg")
}

fn rate(text: &str) -> Result<f64, String> {
    quantity(text, Measure::ANGULAR_RATE, "1 urad/s")
}

/// Decibels.
fn gain(text: &str) -> Result<f64, String> {
    decibels_of(text)
        .ok_or_else(|| format!("`{text}` is no gain margin; write decibels, not negative: \"6\""))
}

/// Everything that is computed.
struct Found {
    analysis: LoopAnalysis,
    lines: Vec<ClosedLine>,
    noise: Option<NoiseGains>,
}

impl Margins {
    pub(super) fn execute(&self) -> Result<Exit, CommandError> {
        let set = self.overrides.overrides();
        let (scenario, reports) = from_file(&self.file, &set).map_err(CommandError::Scenario)?;
        let stem = self.file.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into());
        // Before the work, too; not kept, since an interrupt during the work would leave it.
        drop(Outputs::reserve(&self.out, &[format!("{stem}-margins.html")], self.force)?);
        let warnings: Vec<String> =
            reports.all.iter().map(|warning| warning.message.clone()).collect();
        for warning in &warnings {
            note(&format!("warning: {warning}"));
        }
        let other = |error: &dyn std::fmt::Display| {
            CommandError::Other(format!("{}: {error}", scenario.name))
        };
        let of = chosen(&scenario, self.controller.as_deref()).map_err(|error| other(&error))?;
        let notes = notes(&scenario, of);
        for text in &notes {
            note(&format!("note: {text}"));
        }
        let measured = self.noise_of(of).map_err(|error| other(&error))?;
        let found = find(&scenario, of).map_err(|error| other(&error))?;
        let verdicts = found.analysis.verdicts(&scenario, &of.name);
        let report = MarginsReport {
            scenario: &scenario,
            controller: of,
            analysis: &found.analysis,
            lines: &found.lines,
            noise: found.noise.as_ref(),
            measured,
            least: self.least_of(&scenario, of),
            verdicts: &verdicts,
            notes: &notes,
            warnings: &warnings,
        };
        let mut files = vec![
            (format!("{stem}-margins.html"), report.html().map_err(|error| other(&error))?),
            (format!("{stem}-margins.json"), files::json(&report)),
            (format!("{stem}-loop.csv"), files::loop_csv(&found.analysis)),
            (format!("{stem}-poles.csv"), files::poles_csv(&found.analysis)),
            (format!("{stem}-closed-lines.csv"), files::lines_csv(&found.lines)),
        ];
        for (name, svg) in report.figures().map_err(|error| other(&error))? {
            files.push((format!("{stem}-{name}.svg"), svg));
        }
        Outputs::reserve(&self.out, &[], self.force)?.write(&files)?;
        print(&summary(&report))?;
        let folder = self.out.display();
        print(&format!("files: {folder}/{stem}-margins.html and {} more\n", files.len() - 1))?;
        let axes = report.states().into_iter().flatten();
        let states: Vec<RequirementState> =
            axes.chain(verdicts.iter().map(|of| of.state)).collect();
        Ok(Exit::of_states(&states))
    }
}

impl Margins {
    /// As they are stated, or the largest of the scenario's requirements.
    fn least_of(&self, scenario: &Scenario, of: &SampledController) -> LeastMargins {
        let required = |margin: LoopMargin| {
            let all = scenario.margin_requirements.iter();
            let own = all.filter(|own| own.controller == of.name && own.margin == margin);
            own.map(|own| own.least).reduce(f64::max)
        };
        let gain = self.gain_margin.or_else(|| required(LoopMargin::Gain));
        let phase = self.phase_margin.or_else(|| required(LoopMargin::Phase));
        LeastMargins {
            gain: gain.unwrap_or(GAIN_LEAST),
            phase: phase.unwrap_or(PHASE_LEAST.to_radians()),
        }
    }

    /// Noise as it is stated, or that of the sensors.
    fn noise_of(&self, of: &SampledController) -> Result<ReadingNoise, MarginsError> {
        let own = ReadingNoise::of_sensors(of)?;
        let rate = self.rate_noise.unwrap_or(own.rate);
        let attitude = match self.attitude_noise {
            Some(stated) => ReadingNoise::new(stated, rate).attitude,
            None => own.attitude,
        };
        Ok(ReadingNoise { attitude, rate })
    }
}

fn find(scenario: &Scenario, of: &SampledController) -> Result<Found, MarginsError> {
    let bar = progress_bar(STEPS, "steps");
    let found = ControlLoop::new(scenario, of, &[])?;
    bar.inc(1);
    let analysis = found.analysis()?;
    bar.inc(1);
    let lines = found.lines()?;
    bar.inc(1);
    let noise = found.noise();
    bar.finish_and_clear();
    Ok(Found { analysis, lines, noise })
}

/// A number at a frequency.
fn at(of: Option<AtFrequency>, number: impl Fn(f64) -> String) -> String {
    of.map_or_else(
        || "any".to_owned(),
        |of| format!("{} at {} Hz", number(of.value), six(of.omega / std::f64::consts::TAU)),
    )
}

fn level(value: f64) -> String {
    format!("{:.3} dB", decibels(value))
}

/// For the terminal.
fn summary(report: &MarginsReport<'_>) -> String {
    let (of, found) = (report.controller, report.analysis);
    let mut text = format!(
        "{}\n{}: {} Hz, delay {} ms: {}\n",
        report.scenario.title,
        of.name,
        six(of.rate),
        six(1e3 * of.delay),
        if found.stable { "stable" } else { "not stable: poles outside the unit circle" }
    );
    let head = ["axis", "state", "gain up", "gain down", "phase", "largest |S|", "largest |T|"];
    let mut rows = vec![head.map(str::to_owned).to_vec()];
    let axes = found.axes.iter().flatten().zip(found.complementary.iter().flatten());
    for (((axis, t), name), states) in axes.zip(AXES).zip(report.states()) {
        let state = states.iter().find(|state| state.is_violated()).or(states.first());
        rows.push(vec![
            name.to_owned(),
            state.map_or_else(String::new, |state| state.word().to_owned()),
            at(axis.gain_up, level),
            at(axis.gain_down, level),
            at(axis.phase, |value| format!("{:.3} deg", value.to_degrees())),
            at(Some(axis.sensitivity), level),
            at(Some(*t), level),
        ]);
    }
    if found.axes.is_some() {
        text.push_str(&aligned(&rows));
    }
    if let Some([s, t]) = found.peaks {
        let _ = writeln!(
            text,
            "whole loop: S {}, T {}, delay margin {}",
            at(Some(s), level),
            at(Some(t), level),
            found.delay.map_or_else(
                || "more than 32 samples".to_owned(),
                |delay| format!("{} ms", six(1e3 * delay))
            )
        );
    }
    for of in report.verdicts {
        let value = |value: f64| margin(of.requirement.margin, value);
        let _ = writeln!(
            text,
            "requirement {}: {} margin {}, at least {}: {}",
            of.requirement.name,
            of.requirement.margin.word(),
            of.found.map_or_else(|| "any".to_owned(), value),
            of.requirement.written,
            of.state.word()
        );
    }
    poles(&mut text, found);
    lines(&mut text, report.lines);
    if report.measured != ReadingNoise::default() {
        let _ = match report.noise {
            Some(noise) => {
                let rms = noise.attitude_rms(&report.measured).map(|rms| six(rms / ARCSEC));
                let read = report.measured.attitude_deviations().map(|rms| six(rms / ARCSEC));
                writeln!(
                    text,
                    "noise: attitude {} arcsec RMS about x, y, z, by {} arcsec and {} urad/s of the readings",
                    rms.join(", "),
                    read.join(", "),
                    six(1e6 * report.measured.rate)
                )
            }
            None => writeln!(
                text,
                "noise: its effect has no end; the loop is not stable, or an estimator has no gain"
            ),
        };
    }
    if let Some(periodic) = found.periodic {
        let _ = writeln!(
            text,
            "averaged over the turns of rotors: loads beside a motion, at its frequency and those of rotors together, are left out, at most {} of the devices' inertial ones at {} Hz",
            six(periodic.value),
            six(periodic.omega / std::f64::consts::TAU)
        );
    }
    text
}

fn poles(text: &mut String, found: &LoopAnalysis) {
    let mut rows = vec![
        ["pole", "Hz", "damping ratio", "|z|", "of the spacecraft"].map(str::to_owned).to_vec(),
    ];
    for (number, of) in found.poles.iter().take(ROWS_MAX).enumerate() {
        let oscillation = of.oscillation.and_then(|number| found.oscillations.get(number));
        let named = oscillation.map_or_else(String::new, |of| {
            let aliased = of.alias < 0.999 * of.frequency;
            let aliased =
                if aliased { format!(", aliased to {} Hz", six(of.alias)) } else { String::new() };
            let name = if of.name.is_empty() { String::new() } else { format!("{}, ", of.name) };
            format!("{name}{} Hz{aliased}", six(of.frequency))
        });
        rows.push(vec![
            (number + 1).to_string(),
            six(of.frequency),
            six(of.damping),
            six(of.z.norm()),
            named,
        ]);
    }
    text.push_str(&aligned(&rows));
    let more = found.poles.len().saturating_sub(ROWS_MAX);
    let more = if more > 0 { format!("{more} more poles; ") } else { String::new() };
    let _ = writeln!(text, "{more}{} poles at 1, on which the loop does not act", found.neutral);
}

fn lines(text: &mut String, lines: &[ClosedLine]) {
    if lines.is_empty() {
        return;
    }
    let size = |of: &[f64; 3]| of.iter().map(|v| v * v).sum::<f64>().sqrt();
    let mut sorted: Vec<_> = lines.iter().map(|of| (size(&of.attitude_rms()), of)).collect();
    sorted.sort_by(|a, b| b.0.total_cmp(&a.0));
    let head = ["rotor", "cause", "Hz", "in the samples", "RMS held, arcsec", "RMS closed, arcsec"];
    let mut rows = vec![head.map(str::to_owned).to_vec()];
    for (closed, of) in sorted.iter().take(ROWS_MAX) {
        let aliased = if of.is_aliased() { "aliased to " } else { "" };
        rows.push(vec![
            of.rotor.clone(),
            format!("{}, order {}", of.cause, six(of.order)),
            six(of.frequency),
            if of.is_constant() {
                "constant".to_owned()
            } else {
                format!("{aliased}{} Hz", six(of.alias))
            },
            six(size(&of.held_rms()) / ARCSEC),
            six(closed / ARCSEC),
        ]);
    }
    text.push_str(&aligned(&rows));
    let more = sorted.len().saturating_sub(ROWS_MAX);
    if more > 0 {
        let _ = writeln!(text, "{more} more lines");
    }
}
