//! `spectrum`: densities, lines, RMS and exposures of columns of a result, as tables and figures.

mod tables;

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::error::CommandError;
use super::exit::Exit;
use super::options::Form;
use super::outputs::Outputs;
use super::plot::time;
use super::result::{Signal, Signals};
use super::terminal::print;
use crate::names::file_names;
use crate::pointing::{PointingError, exposure_of_history};
use crate::report::spectrum::{SpectrumCurve, SpectrumFigure};
use crate::spectra::{
    AmplitudeSpectrum, Detrend, WelchSettings, Window, amplitude_spectrum, float, psd,
};
use crate::units::{Measure, parse_quantity};
use tables::{Analysed, Analysis, csv, json, text};

pub(super) const HELP: &str = "\
Examples:
  precess spectrum precess-out/bus.csv
      density, lines and RMS of omega: tables, a CSV file and a figure
  precess spectrum bus.npz --column omega_x --band '10, 200 Hz' --exposure '10 ms'
      and its RMS in a band, and displacement, smear and jitter of exposures
  precess spectrum bus.csv --column w1.mount.force --window flat-top --segment '1 s'
      amplitudes of lines to 0.1 %

Displacement contains the mean; the density does not, unless --detrend is none.";

/// Segments of the record without `--segment`, before they overlap, and the fewest samples of one.
const SEGMENTS: usize = 8;
const SHORTEST: usize = 64;
/// Samples of a segment without `--segment`, at most.
const LONGEST: usize = 1 << 20;

/// The options of `spectrum`.
#[derive(Debug, Args)]
pub(super) struct Spectrum {
    /// A result (CSV, NPZ).
    result: PathBuf,
    /// A column, or a vector such as omega; may be repeated. Without it omega, or the first three columns.
    #[arg(long, value_name = "NAME")]
    column: Vec<String>,
    /// What a segment is multiplied by: hann for densities, flat-top for amplitudes, rectangular for whole periods.
    #[arg(long, value_enum, default_value = "hann")]
    window: WindowName,
    /// Length of a segment, with its unit; an eighth of the record without it. Its inverse is the resolution.
    #[arg(long, value_name = "TIME", value_parser = time)]
    segment: Option<f64>,
    /// What two segments share, percent, to 98; by the window 50 (hann), 75 (flat-top), 0 (rectangular).
    #[arg(long, value_name = "PERCENT", value_parser = percent)]
    overlap: Option<f64>,
    /// What is subtracted from each segment.
    #[arg(long, value_enum, default_value = "mean")]
    detrend: DetrendName,
    /// A band of which the RMS is printed: "10, 200 Hz"; may be repeated.
    #[arg(long, value_name = "BAND", value_parser = band)]
    band: Vec<[f64; 2]>,
    /// Length of exposures of which displacement, smear and jitter are printed: "10 ms"; may be repeated.
    #[arg(long, value_name = "TIME", value_parser = time)]
    exposure: Vec<f64>,
    /// Lines of each column that are printed, at most.
    #[arg(long, default_value_t = 5, value_parser = clap::value_parser!(u32).range(0..=1000))]
    lines: u32,
    /// Time at which the samples start, with its unit: "0.2 s".
    #[arg(long, value_name = "TIME", value_parser = time)]
    from: Option<f64>,
    /// Time at which they end.
    #[arg(long, value_name = "TIME", value_parser = time)]
    to: Option<f64>,
    /// Folder for the table (CSV) and figures (SVG); made if it is missing.
    #[arg(long, value_name = "FOLDER", default_value = "precess-out")]
    out: PathBuf,
    /// Replace files that are there.
    #[arg(long)]
    force: bool,
    /// How the numbers are printed.
    #[arg(long, value_enum, default_value_t)]
    format: Form,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum WindowName {
    Hann,
    FlatTop,
    Rectangular,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum DetrendName {
    None,
    Mean,
    Linear,
}

/// A share, percent.
fn percent(text: &str) -> Result<f64, String> {
    let number = text.trim().trim_end_matches('%').trim().parse::<f64>();
    match number {
        Ok(percent) if (0.0..=98.0).contains(&percent) => Ok(percent),
        _ => Err(format!("`{text}` is no share from 0 to 98 percent; write for example 50")),
    }
}

/// A band of frequencies with their unit, Hz.
fn band(text: &str) -> Result<[f64; 2], String> {
    let example = "write two rising frequencies and their unit: \"10, 200 Hz\"";
    let quantity = parse_quantity(text).map_err(|error| format!("{}; {example}", error.kind))?;
    match quantity.values[..] {
        [from, to] if quantity.is(Measure::FREQUENCY) && 0.0 <= from && from < to => Ok([from, to]),
        _ => Err(format!("`{text}` is no band; {example}")),
    }
}

impl Spectrum {
    pub(super) fn execute(&self) -> Result<Exit, CommandError> {
        let interval = [self.from.unwrap_or(f64::NEG_INFINITY), self.to.unwrap_or(f64::INFINITY)];
        let signals = Signals::read(&self.result, &self.column, interval)?;
        let wrong = |error: &dyn std::fmt::Display| {
            CommandError::Other(format!("{}: {error}", self.result.display()))
        };
        let settings = self.settings(&signals);
        let columns = signals.columns.iter().map(|signal| {
            self.analysed(signal, signals.rate, &settings)
                .map_err(|error| wrong(&format!("{}: {error}", signal.name)))
        });
        let columns = columns.collect::<Result<Vec<_>, _>>()?;
        let stem = self.result.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into());
        let analysis = Analysis {
            name: stem,
            span: signals.span,
            bands: self.band.clone(),
            exposures: self.exposure.clone(),
            columns,
        };
        let mut files = vec![(format!("{}-spectrum.csv", analysis.name), csv(&analysis))];
        for (slug, figure) in figures(&analysis) {
            let svg = figure.file().map_err(|error| CommandError::Other(error.to_string()))?;
            files.push((format!("{}-spectrum-{slug}.svg", analysis.name), svg));
        }
        let paths = Outputs::reserve(&self.out, &[], self.force)?.write(&files)?;
        let paths: Vec<_> = paths.iter().map(|path| path.display().to_string()).collect();
        match self.format {
            Form::Text => print(&format!("{}\n{}\n", text(&analysis), paths.join("\n")))?,
            Form::Json => print(&(json(&analysis, &paths) + "\n"))?,
        }
        Ok(Exit::Success)
    }

    /// The segments, of a record of these signals.
    fn settings(&self, signals: &Signals) -> WelchSettings {
        let samples = signals.columns.first().map_or(0, |signal| signal.samples.len());
        let (window, overlap) = match self.window {
            WindowName::Hann => (Window::Hann, 50.0),
            WindowName::FlatTop => (Window::FlatTop, 75.0),
            WindowName::Rectangular => (Window::Rectangular, 0.0),
        };
        let detrend = match self.detrend {
            DetrendName::None => Detrend::None,
            DetrendName::Mean => Detrend::Mean,
            DetrendName::Linear => Detrend::Linear,
        };
        let shortest = SHORTEST.min(samples);
        let length = self.segment.map_or_else(
            || (samples / SEGMENTS).clamp(shortest, LONGEST.max(shortest)),
            |time| whole(time * signals.rate),
        );
        let overlap = whole(self.overlap.unwrap_or(overlap) / 100.0 * float(length));
        WelchSettings { window, length, overlap, detrend }
    }

    fn analysed(
        &self,
        signal: &Signal,
        rate: f64,
        settings: &WelchSettings,
    ) -> Result<Analysed, PointingError> {
        let density = psd(&signal.samples, rate, settings)?;
        let amplitudes: AmplitudeSpectrum = amplitude_spectrum(&signal.samples, rate, settings)?;
        let bands = self.band.iter().map(|band| density.band_rms(*band));
        let bands = bands.collect::<Result<_, _>>()?;
        let samples = [signal.samples.as_slice()];
        let exposures = self.exposure.iter().map(|time| exposure_of_history(&samples, rate, *time));
        Ok(Analysed {
            name: signal.name.clone(),
            unit: signal.unit.clone(),
            mean: signal.samples.iter().sum::<f64>() / float(signal.samples.len()),
            lines: amplitudes.strongest(usize::try_from(self.lines).unwrap_or(usize::MAX)),
            amplitudes,
            bands,
            exposures: exposures.collect::<Result<_, _>>()?,
            density,
        })
    }
}

/// A number of samples next to a number that is not negative; what is beyond all bounds is rejected as a length.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a cast saturates, and lengths have a bound"
)]
fn whole(number: f64) -> usize {
    number.round() as usize
}

/// A figure for each vector, or column that is none, with its name in files.
fn figures(analysis: &Analysis) -> Vec<(String, SpectrumFigure)> {
    let base = |name: &str| -> String {
        let axis = ["_x", "_y", "_z"].iter().find_map(|axis| name.strip_suffix(axis));
        axis.unwrap_or(name).to_owned()
    };
    let mut figures: Vec<(String, SpectrumFigure)> = Vec::new();
    for column in &analysis.columns {
        let of = base(&column.name);
        let curve = SpectrumCurve {
            name: column.name.clone(),
            density: column.density.density.clone(),
            rms: column.density.cumulative_rms_forward(),
        };
        if let Some((_, figure)) =
            figures.iter_mut().find(|(known, figure)| *known == of && figure.unit == column.unit)
        {
            figure.curves.push(curve);
            continue;
        }
        let title = format!("Spectrum of {of}");
        let figure = SpectrumFigure {
            description: format!(
                "{title} of {}: one-sided power spectral density and RMS of all lower frequencies, \
                 over frequency in Hz.",
                analysis.name
            ),
            title,
            unit: column.unit.clone(),
            frequencies: column.density.iter().map(|(frequency, _)| frequency).collect(),
            curves: vec![curve],
        };
        figures.push((of, figure));
    }
    let names = file_names(figures.iter().map(|(of, _)| of));
    names.into_iter().zip(figures).map(|(name, (_, figure))| (name, figure)).collect()
}
