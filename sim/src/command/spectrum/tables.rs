//! What `spectrum` prints and writes: text, JSON, and a table of all frequencies (CSV).

use std::fmt::Write as _;

use crate::command::table::{aligned, six};
use crate::pointing::ExposureHistory;
use crate::spectra::{AmplitudeSpectrum, Line, Metadata, Psd, float};

/// Columns of a result with their spectra.
pub(super) struct Analysis {
    /// The result's name, without extension.
    pub(super) name: String,
    /// Time of the first and last sample, s.
    pub(super) span: [f64; 2],
    /// Bands, Hz.
    pub(super) bands: Vec<[f64; 2]>,
    /// Lengths of exposures, s.
    pub(super) exposures: Vec<f64>,
    /// At least one.
    pub(super) columns: Vec<Analysed>,
}

/// The spectra of a column.
pub(super) struct Analysed {
    pub(super) name: String,
    pub(super) unit: String,
    pub(super) mean: f64,
    pub(super) density: Psd,
    pub(super) amplitudes: AmplitudeSpectrum,
    /// The strongest first.
    pub(super) lines: Vec<Line>,
    /// RMS in each band.
    pub(super) bands: Vec<f64>,
    /// Of each length.
    pub(super) exposures: Vec<ExposureHistory>,
}

impl Analysed {
    /// RMS of the density over all frequencies.
    fn rms(&self) -> f64 {
        self.density.mean_square().sqrt()
    }
}

/// How the spectra were computed.
fn method(analysis: &Analysis) -> Vec<String> {
    let Some(column) = analysis.columns.first() else { return Vec::new() };
    let Metadata { settings, rate, samples, segments, unused, resolution, averages, .. } =
        column.density.metadata;
    let [from, to] = analysis.span;
    let share = 100.0 * float(settings.overlap) / float(settings.length);
    let length = float(settings.length) / rate;
    vec![
        format!(
            "{}: {samples} samples at {} Hz, {} s to {} s",
            analysis.name,
            six(rate),
            six(from),
            six(to)
        ),
        format!(
            "window {}, {segments} segments of {} s ({} samples), overlap {} %, removed: {}",
            settings.window.name(),
            six(length),
            settings.length,
            six(share),
            settings.detrend.name()
        ),
        format!(
            "resolution {} Hz, {averages:.1} averages of independent segments, unused samples: {unused}",
            six(resolution)
        ),
    ]
}

/// The numbers for people.
pub(super) fn text(analysis: &Analysis) -> String {
    let mut out = method(analysis).join("\n") + "\n\n";
    let mut head = vec!["column".to_owned(), "mean".to_owned(), "RMS".to_owned()];
    let bands = analysis.bands.iter();
    head.extend(bands.map(|[from, to]| format!("{} to {} Hz", six(*from), six(*to))));
    for time in &analysis.exposures {
        for part in ["displacement", "smear", "jitter"] {
            head.push(format!("{part} {} s", six(*time)));
        }
    }
    head.push("unit".to_owned());
    let mut rows = vec![head];
    for column in &analysis.columns {
        let mut row = vec![column.name.clone(), six(column.mean), six(column.rms())];
        row.extend(column.bands.iter().map(|rms| six(*rms)));
        for exposure in &column.exposures {
            let of = exposure.rms;
            row.extend([of.displacement, of.smear, of.jitter].map(six));
        }
        row.push(column.unit.clone());
        rows.push(row);
    }
    out.push_str(&aligned(&rows));
    let head = [
        "line of",
        "frequency (Hz)",
        "amplitude",
        "share of mean square (%)",
        "above floor (dB)",
        "unit",
    ];
    let mut rows = vec![head.map(str::to_owned).to_vec()];
    for column in &analysis.columns {
        for line in &column.lines {
            rows.push(vec![
                column.name.clone(),
                six(line.frequency),
                six(line.amplitude),
                format!("{:.1}", 100.0 * share(line, column)),
                floor(line).map_or_else(|| "-".to_owned(), |decibels| format!("{decibels:.1}")),
                column.unit.clone(),
            ]);
        }
    }
    if rows.len() == 1 {
        out.push_str("\nno line is 12 dB above the bins about it\n");
    } else {
        out.push('\n');
        out.push_str(&aligned(&rows));
    }
    out
}

/// A line's mean square by that of its column.
fn share(line: &Line, column: &Analysed) -> f64 {
    let square = column.density.mean_square();
    if square > 0.0 { 0.5 * line.amplitude * line.amplitude / square } else { 0.0 }
}

/// How far a line is above the floor, dB; none above a floor of zero.
fn floor(line: &Line) -> Option<f64> {
    line.above_floor.is_finite().then(|| 20.0 * line.above_floor.log10())
}

/// The numbers for programs.
pub(super) fn json(analysis: &Analysis, files: &[String]) -> String {
    let columns = analysis.columns.iter().map(|column| {
        let lines = column.lines.iter().map(|line| {
            serde_json::json!({
                "frequency": line.frequency, "amplitude": line.amplitude, "above_floor": floor(line),
            })
        });
        let bands = analysis.bands.iter().zip(&column.bands);
        let bands = bands.map(|(band, rms)| serde_json::json!({ "band": band, "rms": rms }));
        let exposures = analysis.exposures.iter().zip(&column.exposures).map(|(time, found)| {
            serde_json::json!({
                "exposure": time, "exposures": found.count, "displacement": found.rms.displacement,
                "smear": found.rms.smear, "jitter": found.rms.jitter,
            })
        });
        serde_json::json!({
            "column": column.name, "unit": column.unit, "mean": column.mean, "rms": column.rms(),
            "lines": lines.collect::<Vec<_>>(), "bands": bands.collect::<Vec<_>>(),
            "exposures": exposures.collect::<Vec<_>>(),
        })
    });
    let metadata = analysis.columns.first().map(|column| {
        let of = column.density.metadata;
        serde_json::json!({
            "window": of.settings.window.name(), "length": of.settings.length,
            "overlap": of.settings.overlap, "detrend": of.settings.detrend.name(),
            "rate": of.rate, "samples": of.samples, "segments": of.segments, "unused": of.unused,
            "resolution": of.resolution, "noise_bandwidth": of.noise_bandwidth,
            "averages": of.averages,
        })
    });
    let value = serde_json::json!({
        "result": analysis.name, "from": analysis.span[0], "to": analysis.span[1],
        "spectrum": metadata, "columns": columns.collect::<Vec<_>>(), "files": files,
    });
    serde_json::to_string_pretty(&value).unwrap_or_default()
}

/// A row for each frequency: of each column density, amplitude of a line, RMS of all lower and of all higher
/// frequencies.
pub(super) fn csv(analysis: &Analysis) -> String {
    let mut text = String::new();
    for line in method(analysis) {
        let _ = writeln!(text, "# {line}");
    }
    text.push_str("# density: one-sided, unit^2/Hz; amplitude: of a line on the bin\n");
    for column in &analysis.columns {
        let unit = if column.unit.is_empty() { "1" } else { &column.unit };
        let _ = writeln!(text, "#   {} [{unit}]", column.name);
    }
    text.push_str("frequency_hz");
    for Analysed { name, .. } in &analysis.columns {
        let _ = write!(text, ",{name}.density,{name}.amplitude,{name}.rms_below,{name}.rms_above");
    }
    text.push('\n');
    let cumulative: Vec<[Vec<f64>; 2]> = analysis
        .columns
        .iter()
        .map(|c| [c.density.cumulative_rms_forward(), c.density.cumulative_rms_backward()])
        .collect();
    let Some(first) = analysis.columns.first() else { return text };
    let mut digits = zmij::Buffer::new();
    for (bin, (frequency, _)) in first.density.iter().enumerate() {
        text.push_str(digits.format(frequency));
        for (column, [below, above]) in analysis.columns.iter().zip(&cumulative) {
            let series = [&column.density.density, &column.amplitudes.amplitude, below, above];
            for values in series {
                text.push(',');
                text.push_str(digits.format(values.get(bin).copied().unwrap_or(f64::NAN)));
            }
        }
        text.push('\n');
    }
    text
}
