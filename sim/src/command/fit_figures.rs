//! The pictures of `fit`: a waterfall with order lines and whirls, and amplitudes of lines over speed, of each
//! group of channels that has a line.

use std::f64::consts::TAU;

use crate::fit::{Coefficient, Fitted, Group, GroupFit, Harmonic, Sense};
use crate::report::fitted_lines::{FittedLine, FittedLines};
use crate::report::waterfall::Waterfall;

/// Speeds of a fitted curve.
const SPEEDS: u32 = 240;
/// Lines of a picture, at most.
const LINES_MAX: usize = 7;
/// Equivalent noise bandwidth of Hann's window, bins.
const HANN: f64 = 1.5;

fn rpm(speed: f64) -> f64 {
    speed * 60.0 / TAU
}

fn slug(group: Group) -> String {
    group.to_string().replace(' ', "-")
}

/// Name and text of each picture.
pub(super) fn figures(name: &str, title: &str, fitted: &Fitted) -> Vec<(String, String)> {
    let mut files = Vec::new();
    for (index, fit) in fitted.groups.iter().enumerate() {
        let group = fit.group;
        let shown = shown(fitted, group);
        if shown.is_empty() {
            continue;
        }
        let waterfall = waterfall(title, fitted, fit, index, &shown);
        if let Ok(svg) = waterfall.file() {
            files.push((format!("{name}-waterfall-{}.svg", slug(group)), svg));
        }
        if let Ok(svg) = lines(title, fitted, fit, &shown).file() {
            files.push((format!("{name}-lines-{}.svg", slug(group)), svg));
        }
    }
    files
}

/// Index, line and coefficient of those that stand out, the largest first.
fn shown(fitted: &Fitted, group: Group) -> Vec<(usize, &Harmonic, &Coefficient)> {
    let all = fitted.harmonics.iter().enumerate();
    let mut shown: Vec<_> = all
        .flat_map(|(index, harmonic)| {
            let of_group = harmonic.coefficients.iter().filter(|c| c.group == group && c.seen);
            of_group.map(move |c| (index, harmonic, c))
        })
        .collect();
    shown.sort_by(|a, b| b.2.c.value.total_cmp(&a.2.c.value));
    shown.truncate(LINES_MAX);
    shown.sort_by(|a, b| a.1.number.value.total_cmp(&b.1.number.value));
    shown
}

/// From the lowest to the highest speed, rad/s, with the sign of most records.
fn speeds(fitted: &Fitted) -> Vec<f64> {
    let of = || fitted.rotations.iter().map(|rotation| rotation.speed);
    let sign =
        if of().filter(|speed| *speed < 0.0).count() * 2 > of().count() { -1.0 } else { 1.0 };
    let low = of().map(f64::abs).fold(f64::INFINITY, f64::min);
    let high = of().map(f64::abs).fold(0.0, f64::max);
    let share = |k: u32| f64::from(k) / f64::from(SPEEDS - 1);
    (0..SPEEDS).map(|k| sign * (low + share(k) * (high - low))).collect()
}

fn named(harmonic: &Harmonic, c: &Coefficient) -> String {
    let number = format!("{:.3}", harmonic.number.value);
    let number = number.trim_end_matches('0').trim_end_matches('.');
    match c.sense {
        Sense::Forward => format!("h = {number}"),
        Sense::Backward => format!("h = {number}, backward"),
    }
}

fn lines(
    title: &str,
    fitted: &Fitted,
    fit: &GroupFit,
    shown: &[(usize, &Harmonic, &Coefficient)],
) -> FittedLines {
    let unit = if fit.group.is_torque() { "N m" } else { "N" };
    let lines = shown.iter().map(|(index, harmonic, c)| {
        let own = fit.points.iter().filter(|p| p.line == *index && p.sense == c.sense);
        let measured = own.map(|p| [rpm(p.spin.abs()), p.power.max(0.0).sqrt()]);
        let fitted = speeds(fitted).into_iter().filter_map(|spin| {
            let at = fit.predicted(*index, harmonic.number.value, c.sense, spin)?;
            Some([rpm(spin.abs()), at.value, at.interval[0], at.interval[1]])
        });
        FittedLine {
            name: named(harmonic, c),
            measured: measured.collect(),
            fitted: fitted.collect(),
        }
    });
    FittedLines {
        description: format!(
            "{title}: amplitudes of the lines of the {}, in {unit}, over the speed in rpm; crosses as \
             measured, curves as fitted, with 95 % bands.",
            fit.group
        ),
        title: format!("{title}: {}, measured and fitted", fit.group),
        axis: format!("Amplitude ({unit})"),
        lines: lines.collect(),
    }
}

fn waterfall(
    title: &str,
    fitted: &Fitted,
    fit: &GroupFit,
    index: usize,
    shown: &[(usize, &Harmonic, &Coefficient)],
) -> Waterfall {
    let mut spectra: Vec<(f64, f64, Vec<f64>)> = Vec::new();
    for (record, (spectrum, rotation)) in fitted.waterfall.iter().zip(&fitted.rotations).enumerate()
    {
        let mut density = spectrum.groups.get(index).cloned().unwrap_or_default();
        // The lines, which the residual is without, back in their bins.
        for point in fit.points.iter().filter(|point| point.record == record) {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a bin")]
            let bin = (point.frequency.abs() / TAU / spectrum.bin).round() as usize;
            if let Some(value) = density.get_mut(bin) {
                *value += 0.5 * point.power.max(0.0) / (HANN * spectrum.bin);
            }
        }
        spectra.push((rpm(rotation.speed.abs()), spectrum.bin, density));
    }
    spectra.sort_by(|a, b| a.0.total_cmp(&b.0));
    #[expect(clippy::cast_precision_loss, reason = "bins of a record")]
    let highest = spectra.iter().map(|(_, bin, d)| bin * d.len() as f64).fold(0.0, f64::max);
    let mut numbers: Vec<f64> = shown.iter().map(|(_, h, _)| h.number.value).collect();
    numbers.dedup();
    let mut curves: Vec<(String, Vec<[f64; 2]>)> = numbers
        .iter()
        .map(|number| {
            let name = format!("{number:.3}");
            let name = name.trim_end_matches('0').trim_end_matches('.');
            let points = speeds(fitted).into_iter().map(|s| [rpm(s.abs()), number * s.abs() / TAU]);
            (format!("h = {name}"), points.collect())
        })
        .collect();
    for mode in &fit.modes {
        let whirls = if mode.mode.inertia_ratio > 0.0 { 2 } else { 1 };
        for whirl in (0..2).rev().take(whirls) {
            let name = match (whirls, whirl) {
                (1, _) => "mode",
                (_, 0) => "backward whirl",
                _ => "forward whirl",
            };
            let points = speeds(fitted).into_iter().map(|s| {
                let [low, high] = mode.mode.whirls(s.abs());
                let rate = if whirl == 0 { -low } else { high };
                [rpm(s.abs()), rate / TAU]
            });
            curves.push((name.to_owned(), points.collect()));
        }
    }
    Waterfall {
        description: format!(
            "{title}: density of the {} over frequency in Hz and speed in rpm, with order lines and modes.",
            fit.group
        ),
        title: format!("{title}: {}", fit.group),
        spectra,
        highest,
        curves,
    }
}
