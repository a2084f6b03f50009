//! The files of `margins` beside the report: JSON and CSV.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use precess_control::AtFrequency;
use serde_json::{Value, json};

use crate::margins::analysis::{AXES, LoopAnalysis};
use crate::margins::lines::ClosedLine;
use crate::report::margins::MarginsReport;

/// A number at a frequency; null for none.
fn at(of: Option<AtFrequency>) -> Value {
    of.map_or(Value::Null, |of| json!({ "value": of.value, "frequency_hz": of.omega / TAU }))
}

/// All numbers but the curves: SI, frequencies in Hz, gains as factors.
pub(super) fn json(report: &MarginsReport<'_>) -> String {
    let (of, found) = (report.controller, report.analysis);
    let states = report.states();
    let axes: Vec<Value> = found
        .axes
        .iter()
        .flatten()
        .zip(found.complementary.iter().flatten())
        .zip(AXES)
        .zip(&states)
        .map(|(((axis, t), name), [gain, phase])| {
            json!({
                "axis": name,
                "gain_up": at(axis.gain_up),
                "gain_down": at(axis.gain_down),
                "phase_rad": at(axis.phase),
                "sensitivity_peak": at(Some(axis.sensitivity)),
                "complementary_peak": at(Some(*t)),
                "gain_state": gain.word(),
                "phase_state": phase.word(),
            })
        })
        .collect();
    let poles: Vec<Value> = found
        .poles
        .iter()
        .map(|of| {
            json!({
                "z": [of.z.re, of.z.im],
                "frequency_hz": of.frequency,
                "damping_ratio": of.damping,
                "oscillation": of.oscillation,
            })
        })
        .collect();
    let oscillations: Vec<Value> = found
        .oscillations
        .iter()
        .map(|of| {
            json!({
                "name": of.name,
                "frequency_hz": of.frequency,
                "damping_ratio": of.damping,
                "alias_hz": of.alias,
            })
        })
        .collect();
    let lines: Vec<Value> = report
        .lines
        .iter()
        .map(|of| {
            json!({
                "rotor": of.rotor,
                "cause": of.cause,
                "order": of.order,
                "frequency_hz": of.frequency,
                "alias_hz": of.alias,
                "aliased": of.is_aliased(),
                "held_rms_rad": of.held_rms(),
                "closed_rms_rad": of.attitude_rms(),
            })
        })
        .collect();
    let all = json!({
        "format": 1,
        "scenario": report.scenario.name,
        "controller": of.name,
        "rate_hz": of.rate,
        "delay_s": of.delay,
        "stable": found.stable,
        "least": { "gain_db": report.least.gain, "phase_rad": report.least.phase },
        "axes": axes,
        "requirements": requirements(report),
        "delay_margin_s": found.delay,
        "sensitivity_peak": at(found.peaks.map(|[s, _]| s)),
        "complementary_peak": at(found.peaks.map(|[_, t]| t)),
        "neutral_poles": found.neutral,
        "poles": poles,
        "oscillations": oscillations,
        "lines": lines,
        "noise": noise(report),
        "averaging_leaves_out": at(found.periodic),
    });
    // Numbers and texts only: it can always be written.
    serde_json::to_string_pretty(&all).unwrap_or_default() + "\n"
}

/// What noise of the sensors does; null without an estimate of it.
fn noise(report: &MarginsReport<'_>) -> Value {
    report.noise.map_or(Value::Null, |gains| {
        json!({
            "attitude_by_attitude": gains.attitude,
            "attitude_by_rate_s": gains.rate,
            "attitude_noise_rad": report.measured.attitude_deviations(),
            "rate_noise_rad_per_s": report.measured.rate,
            "attitude_rms_rad": gains.attitude_rms(&report.measured),
        })
    })
}

/// What is required of the margins.
fn requirements(report: &MarginsReport<'_>) -> Vec<Value> {
    report
        .verdicts
        .iter()
        .map(|of| {
            json!({
                "name": of.requirement.name,
                "margin": of.requirement.margin.word(),
                "least": of.requirement.least,
                "value": of.found,
                "state": of.state.word(),
            })
        })
        .collect()
}

/// Numbers with the fewest digits that read back the same.
fn numbers(text: &mut String, values: impl IntoIterator<Item = f64>) {
    let mut digits = zmij::Buffer::new();
    for (index, value) in values.into_iter().enumerate() {
        if index > 0 {
            text.push(',');
        }
        text.push_str(digits.format(value));
    }
}

/// A row for each frequency.
pub(super) fn loop_csv(found: &LoopAnalysis) -> String {
    let mut text = String::from("frequency_hz");
    for axis in AXES {
        let _ = write!(text, ",l_{axis}_re,l_{axis}_im,s_{axis},t_{axis}");
    }
    text.push_str(",open_largest,open_smallest,sensitivity_largest,complementary_largest");
    for number in 1..=3 {
        let _ = write!(text, ",eigenvalue_{number}_re,eigenvalue_{number}_im");
    }
    text.push('\n');
    for at in &found.points {
        let axes = at.axes.iter().zip(&at.closed).flat_map(|(l, [s, t])| [l.re, l.im, *s, *t]);
        let loci = at.loci.iter().flat_map(|value| [value.re, value.im]);
        let row = std::iter::once(at.omega / TAU).chain(axes).chain(at.open).chain(at.peaks);
        numbers(&mut text, row.chain(loci));
        text.push('\n');
    }
    text
}

/// A row for each pole of the closed loop.
pub(super) fn poles_csv(found: &LoopAnalysis) -> String {
    let mut text = String::from("z_re,z_im,frequency_hz,damping_ratio,oscillation_hz,moves\n");
    for of in &found.poles {
        let own = of.oscillation.and_then(|number| found.oscillations.get(number));
        numbers(&mut text, [of.z.re, of.z.im, of.frequency, of.damping]);
        text.push(',');
        if let Some(own) = own {
            numbers(&mut text, [own.frequency]);
        }
        let _ = writeln!(text, ",{}", own.map_or("", |own| &own.name).replace(", ", " "));
    }
    text
}

/// A row for each component of each line: at the line itself, at its alias, at further images.
pub(super) fn lines_csv(lines: &[ClosedLine]) -> String {
    let mut text = String::from("rotor,cause,order,frequency_hz,alias_hz,component_hz");
    for axis in AXES {
        let _ = write!(text, ",rotation_{axis}_re,rotation_{axis}_im");
    }
    text.push('\n');
    for of in lines {
        for component in &of.components {
            let _ = write!(text, "{},{},", of.rotor, of.cause.replace(',', " "));
            let values = component.attitude.iter().flat_map(|value| [value.re, value.im]);
            let head = [of.order, of.frequency, of.alias, component.frequency];
            numbers(&mut text, head.into_iter().chain(values));
            text.push('\n');
        }
    }
    text
}
