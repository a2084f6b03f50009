//! The pictures of a fit, of each group of channels that has a line: a waterfall with order lines and whirls, amplitudes of
//! lines over speed, residuals over speed, and a spectrum with the fitted lines.

use std::f64::consts::TAU;

use super::super::draw::fitted_lines::{FittedLine, FittedLines};
use super::super::draw::picture::Picture;
use super::super::draw::plane::Plane;
use super::super::draw::spectrum::{SpectrumCurve, SpectrumFigure};
use super::super::draw::waterfall::Waterfall;
use crate::fit::{Coefficient, Fitted, Group, GroupFit, Harmonic, Power, Sense};
use crate::spectra::float;

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

/// A picture of a fit.
pub(super) struct Drawing {
    /// In names of files: `waterfall-radial-force`.
    pub(super) slug: String,
    /// Below it on a page.
    pub(super) caption: String,
    pub(super) figure: Picture,
}

/// The pictures of each group.
pub(super) fn drawings(title: &str, fitted: &Fitted) -> Vec<Drawing> {
    let mut all = Vec::new();
    for (index, fit) in fitted.groups.iter().enumerate() {
        let group = fit.group;
        let shown = shown(fitted, group);
        if shown.is_empty() {
            continue;
        }
        let mut add = |kind: &str, caption: String, figure| {
            all.push(Drawing { slug: format!("{kind}-{}", slug(group)), caption, figure });
        };
        let caption =
            format!("{group}: amplitudes over the speed, crosses as measured, curves as fitted.");
        add("lines", caption, Picture::Lines(lines(title, fitted, fit, &shown)));
        if let Some((rpm, figure)) = spectrum(title, fitted, fit, index) {
            let caption = format!(
                "{group}: spectrum at {rpm:.0} rpm with the fitted lines and noise; below, the RMS of all lower frequencies."
            );
            add("spectrum", caption, Picture::Spectrum(figure));
        }
        let caption = format!(
            "{group}: residuals of powers by their standard deviation; 95 % are within 2 where the model holds."
        );
        add("residuals", caption, Picture::Plane(residuals(title, fitted, fit, &shown)));
        let caption = format!(
            "{group}: density of each axis over speed and frequency, by its scale; where nothing is drawn it is below the scale. Curves: orders and modes."
        );
        add("waterfall", caption, Picture::Waterfall(waterfall(title, fitted, fit, index, &shown)));
    }
    all
}

/// Power of a line by the model, and the standard deviation of one that is measured.
fn modelled(fitted: &Fitted, fit: &GroupFit, point: &Power) -> Option<[f64; 2]> {
    let number = fitted.harmonics.get(point.line)?.number.value;
    let amplitude = fit.predicted(point.line, number, point.sense, point.spin)?.value;
    let m = amplitude * amplitude;
    let variance = point.variance(m);
    (variance > 0.0).then(|| [m, variance.sqrt()])
}

/// Residuals of each line over the speed.
fn residuals(
    title: &str,
    fitted: &Fitted,
    fit: &GroupFit,
    shown: &[(usize, &Harmonic, &Coefficient)],
) -> Plane {
    let curve = |(index, harmonic, c): &(usize, &Harmonic, &Coefficient)| {
        let own = fit.points.iter().filter(|p| p.line == *index && p.sense == c.sense);
        let mut points: Vec<[f64; 2]> = own
            .filter_map(|point| {
                let [model, deviation] = modelled(fitted, fit, point)?;
                Some([rpm(point.spin.abs()), (point.power - model) / deviation])
            })
            .collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        (named(harmonic, c), points)
    };
    let curves: Vec<_> = shown.iter().map(curve).collect();
    let most = curves.iter().flat_map(|(_, points)| points).map(|point| point[1].abs());
    let most = 1.1 * most.fold(3.0, f64::max);
    let speeds = speeds(fitted);
    let ends = [speeds.first(), speeds.last()].map(|end| end.map_or(0.0, |end| rpm(end.abs())));
    let straight = [-2.0, 2.0].map(|level| {
        (format!("{level:+.0}").replace('-', "\u{2212}"), ends.map(|end| [end, level]))
    });
    Plane {
        description: format!(
            "{title}: residuals of the powers of the {}, by their standard deviation, over the speed in rpm.",
            fit.group
        ),
        title: format!("{title}: {}, residuals", fit.group),
        axes: ["Speed (rpm)".to_owned(), "Residual / deviation".to_owned()],
        curves,
        lines: straight.to_vec(),
        dots: Vec::new(),
        marks: Vec::new(),
        large: false,
        logarithmic: false,
        ranges: [(ends[0] < ends[1]).then_some(ends), Some([-most, most])],
    }
}

/// The spectrum of the record in the middle of the speeds, as measured and as fitted, and its speed, rpm.
fn spectrum(
    title: &str,
    fitted: &Fitted,
    fit: &GroupFit,
    index: usize,
) -> Option<(f64, SpectrumFigure)> {
    let mut order: Vec<usize> = (0..fitted.rotations.len().min(fitted.waterfall.len())).collect();
    let speed = |record: &usize| fitted.rotations.get(*record).map_or(0.0, |of| of.speed.abs());
    order.sort_by(|a, b| speed(a).total_cmp(&speed(b)));
    let record = *order.get(order.len() / 2)?;
    let measured = fitted.waterfall.get(record)?;
    let bin = measured.bin;
    let mut found = measured.groups.get(index)?.clone();
    let floor = fitted.floors.iter().find(|(group, _)| *group == fit.group).map(|(_, bands)| bands);
    let frequencies: Vec<f64> = (0..found.len()).map(|k| float(k) * bin).collect();
    let noise = |frequency: &f64| {
        let within = |[from, to]: [f64; 2]| (from..to).contains(frequency);
        let band = floor.into_iter().flatten().find(|band| within(band.range));
        band.map_or(f64::NAN, |band| band.density.value)
    };
    let mut model: Vec<f64> = frequencies.iter().map(noise).collect();
    for point in fit.points.iter().filter(|point| point.record == record) {
        let Some([power, _]) = modelled(fitted, fit, point) else { continue };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a bin")]
        let at = (point.frequency.abs() / TAU / bin).round() as usize;
        for (density, power) in [(&mut found, point.power.max(0.0)), (&mut model, power)] {
            if let Some(value) = density.get_mut(at) {
                let own = if value.is_finite() { *value } else { 0.0 };
                *value = own + 0.5 * power / (HANN * bin);
            }
        }
    }
    // From the bins of a line on, the noise of the fit: those of the zero frequency have none.
    let rms = |density: &[f64]| {
        let mut sum = 0.0;
        density
            .iter()
            .map(|value| {
                sum += if value.is_finite() { value * bin } else { 0.0 };
                sum.sqrt()
            })
            .collect::<Vec<f64>>()
    };
    let curve = |name: &str, density: Vec<f64>| SpectrumCurve {
        name: name.to_owned(),
        rms: rms(&density),
        density,
    };
    let rpm = rpm(speed(&record));
    let title = format!("{title}: {} at {rpm:.0} rpm", fit.group);
    let unit = if fit.group.is_torque() { "N m" } else { "N" };
    let figure = SpectrumFigure {
        description: format!(
            "{title}: density of each axis in {unit} squared by Hz over frequency in Hz, as measured and as fitted; below, the \
             RMS of all lower frequencies."
        ),
        title,
        unit: unit.to_owned(),
        frequencies,
        curves: vec![curve("measured", found), curve("fitted", model)],
    };
    Some((rpm, figure))
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
        unit: if fit.group.is_torque() { "N² m²/Hz" } else { "N²/Hz" },
        highest,
        curves,
    }
}
