//! A fit to spectra where the time series are gone: densities over frequency at each speed.
//!
//! A line has the power `|A|² = 2 df sum (S - S_0)` over the bins of its window's main lobe, with the density
//! `S_0` of the noise beside it; of a mean over n segments its variance is that of one segment by n. Its
//! frequency is the centroid of the same bins. There are no phases: forward and backward cannot be told apart
//! and all radial lines count as forward; moments cannot be referred to another point, so they are about W.

use std::f64::consts::TAU;

use nalgebra::Complex;

use super::detect::{LINES_MAX, strongest};
use super::error::FitError;
use super::estimate::Estimate;
use super::lines::{Lines, NOISE_BINS, float};
use super::measurement::{CHANNELS, Group, RECORDS_MIN};
use super::orders::Tracked;
use super::powers::{self, Power, Sense};
use super::rotation::Rotation;
use super::search;
use super::{Fitted, Options, assembled, check};

/// Bins on either side of a line that have its power: a main lobe of Hann's window and a bin.
const LOBE: usize = 3;
/// Bins from a line that show its noise.
const CLEAR: usize = 5;
/// What stands for `E|dA|²` of a line whose power is a sum over bins, by the noise's density and the width of a bin: the product
/// of line and noise has the variance `4 A² σ² Σw⁴ / (Σw²)²`, and Hann's window `35 / 18` bins of it (an amplitude by
/// least squares has 1.5).
const LINE_NOISE: f64 = 35.0 / 9.0;
/// Variance of the noise in the lobe by the square of that: `4 (7 + 12 · 4/9 + 10 / 36) / 15.1` with the correlation of
/// neighbouring bins, less the one that every power has, and 1.1 of the floor's, which is a median of some forty bins.
const LOBE_NOISE: f64 = 3.5;
/// Variance of the centroid of a lobe in bins, times the segments, by the share of the noise in it: of the product of line and noise,
/// and of noise by itself, `sum of k l |rho_kl|²` over the lobe.
const BY_LINE: f64 = 0.56;
const BY_NOISE: f64 = 42.5;
/// Passes of the detection.
const PASSES: usize = 10;
/// Bins that a spectrum has at least.
const BINS_MIN: usize = 64;

/// Spectra at one speed.
#[derive(Clone, Debug, PartialEq)]
pub struct WaterfallRow {
    /// rad/s.
    pub speed: f64,
    /// Width of a bin, Hz; the first is at zero frequency.
    pub bin: f64,
    /// Independent segments that were averaged.
    pub segments: f64,
    /// One-sided densities in the wheel's axes about W, N²/Hz and N² m²/Hz.
    pub densities: [Vec<f64>; CHANNELS],
}

fn checked(rows: &[WaterfallRow]) -> Result<(), FitError> {
    if rows.len() < RECORDS_MIN {
        return Err(FitError::Records { found: rows.len(), least: RECORDS_MIN });
    }
    for (number, row) in rows.iter().enumerate() {
        let record = format!("speed {}", number + 1);
        let found = row.densities.each_ref().map(Vec::len);
        if found.iter().any(|length| *length != found[0]) {
            return Err(FitError::Uneven { record, found });
        }
        if found[0] < BINS_MIN {
            return Err(FitError::Waterfall { what: "bins", found: found[0], wanted: BINS_MIN });
        }
        for (what, value, range) in [
            ("the speed (rad/s)", row.speed.abs(), [1e-3, 1e6]),
            ("the width of a bin (Hz)", row.bin, [1e-6, 1e6]),
            ("the number of segments", row.segments, [1.0, 1e9]),
        ] {
            if !(range[0]..=range[1]).contains(&value) {
                return Err(FitError::Range { record, what, value, range });
            }
        }
        for (channel, densities) in super::CHANNEL_NAMES.iter().zip(&row.densities) {
            let bad = densities.iter().position(|d| !(d.is_finite() && *d >= 0.0));
            if let Some(index) = bad {
                return Err(FitError::Sample { record, channel, index });
            }
        }
    }
    Ok(())
}

/// Fits a disturbance model to spectra.
///
/// # Errors
/// As [`super::fit`].
pub fn fit_waterfall(rows: &[WaterfallRow], options: &Options) -> Result<Fitted, FitError> {
    checked(rows)?;
    check(options)?;
    let rotations = rows.iter().map(|row| Rotation::stated(row.speed, 0.0)).collect::<Vec<_>>();
    let spectra = |row: &WaterfallRow| Lines {
        sets: Vec::new(),
        spectra: row.densities.clone(),
        clear: (0..row.densities[0].len()).map(|bin| bin >= LOBE).collect(),
        bin: row.bin,
        noise_bins: Vec::new(),
    };
    let mut tracked =
        Tracked { orders: Vec::new(), rotations, lines: rows.iter().map(spectra).collect() };
    let mut numbers = options.harmonics.clone();
    numbers.push(1.0);
    if options.harmonics.is_empty() {
        for _ in 0..PASSES {
            mask(&mut tracked, rows, &numbers);
            let (found, _) = strongest(options.highest, &durations(rows), &tracked);
            if found.is_empty() || numbers.len() >= LINES_MAX {
                break;
            }
            numbers.extend(found);
        }
    }
    numbers.sort_by(f64::total_cmp);
    numbers.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
    mask(&mut tracked, rows, &numbers);
    let lines = &tracked.lines;
    let known = numbers.iter().map(|number| refined(rows, *number, lines)).collect::<Vec<_>>();
    numbers = known.iter().map(|order| order.value).collect();
    mask(&mut tracked, rows, &numbers);
    // With their intervals, which the mask does not know.
    tracked.orders = known;
    let mut groups = Vec::new();
    for group in Group::ALL {
        let points = points(rows, &numbers, group, &tracked.lines);
        groups.push(match &options.modes {
            Some(modes) => powers::fit(group, numbers.len(), points, modes)?,
            None => search::search(group, numbers.len(), &points)?,
        });
    }
    Ok(assembled(tracked, groups))
}

fn durations(rows: &[WaterfallRow]) -> Vec<f64> {
    rows.iter().map(|row| 1.0 / row.bin).collect()
}

/// The bin of a line in a row.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a bin")]
fn bin_of(row: &WaterfallRow, number: f64) -> usize {
    (number * row.speed.abs() / TAU / row.bin).round() as usize
}

/// Takes the bins near lines out of the noise.
fn mask(tracked: &mut Tracked, rows: &[WaterfallRow], numbers: &[f64]) {
    for (found, row) in tracked.lines.iter_mut().zip(rows) {
        for number in numbers {
            let bin = bin_of(row, *number);
            let near = bin.saturating_sub(CLEAR - 1)..bin + CLEAR;
            let clear = found.clear.iter_mut().enumerate();
            clear.filter(|(k, _)| near.contains(k)).for_each(|(_, clear)| *clear = false);
        }
    }
    tracked.orders = numbers.iter().map(|number| Estimate::exact(*number)).collect();
}

/// Sum of densities above the noise in a lobe, and their centroid in bins from its middle.
fn lobe(densities: &[f64], bin: usize, noise: f64) -> [f64; 2] {
    let (mut sum, mut moment) = (0.0, 0.0);
    let mut offset = -float(LOBE);
    for k in bin.saturating_sub(LOBE)..=bin + LOBE {
        let above = densities.get(k).copied().unwrap_or(noise) - noise;
        sum += above;
        moment += offset * above;
        offset += 1.0;
    }
    [sum, moment / sum]
}

/// The median of the bins on either side of a lobe, as a mean of noise; bins of other lines would raise it.
fn beside(densities: &[f64], bin: usize, segments: f64, clear: &[bool]) -> f64 {
    let mut near: Vec<f64> = Vec::with_capacity(2 * NOISE_BINS);
    let low = bin.saturating_sub(NOISE_BINS)..bin.saturating_sub(CLEAR);
    let high = bin + CLEAR + 1..(bin + NOISE_BINS).min(densities.len());
    let own = low.chain(high).filter(|k| clear.get(*k).copied().unwrap_or(true));
    near.extend(own.filter_map(|k| densities.get(k)));
    near.sort_by(f64::total_cmp);
    let median = near.get(near.len() / 2).copied().unwrap_or(0.0);
    // The median of a mean of n exponential numbers, by Wilson and Hilferty.
    median / (1.0 - 1.0 / (9.0 * segments)).powi(3)
}

fn usable(row: &WaterfallRow, bin: usize) -> bool {
    bin >= 2 * LOBE && 20 * bin < 19 * row.densities[0].len()
}

/// A number by the centroids of its line in every row and channel that shows it.
fn refined(rows: &[WaterfallRow], number: f64, all: &[Lines]) -> Estimate {
    if number == 1.0 {
        return Estimate::exact(1.0);
    }
    // Of each row the centroids and their weights.
    let mut found: Vec<Vec<[f64; 2]>> = Vec::new();
    for (row, lines) in rows.iter().zip(all) {
        let bin = bin_of(row, number);
        if !usable(row, bin) {
            continue;
        }
        let mut of_row = Vec::new();
        for densities in &row.densities {
            let noise = beside(densities, bin, row.segments, &lines.clear);
            let [sum, offset] = lobe(densities, bin, noise);
            if sum > 10.0 * noise && offset.abs() < 1.5 {
                let turns = row.speed.abs() / TAU / row.bin;
                let share = noise / sum + 1e-9;
                let weight = turns * turns / (share * (BY_LINE + BY_NOISE * share));
                of_row.push([(float(bin) + offset) / turns, weight]);
            }
        }
        if !of_row.is_empty() {
            found.push(of_row);
        }
    }
    let weights: f64 = found.iter().flatten().map(|[_, weight]| weight).sum();
    let shown = found.len() >= 4 && weights > 0.0;
    if !shown {
        return Estimate::new(number, 0.0, 4.0);
    }
    let mean = found.iter().flatten().map(|[v, w]| v * w).sum::<f64>() / weights;
    // Weights are inverse variances but for one factor, which the scatter of all rows gives.
    let squares: f64 = found.iter().flatten().map(|[v, w]| w * (v - mean).powi(2)).sum();
    let freedom = float(found.iter().map(Vec::len).sum::<usize>()) - 1.0;
    Estimate::new(mean, (squares / freedom / weights).sqrt(), freedom)
}

/// Powers of the lines of a group; of a radial one the mean of both axes.
fn points(rows: &[WaterfallRow], numbers: &[f64], group: Group, all: &[Lines]) -> Vec<Power> {
    let mut points = Vec::new();
    let [a, b] = group.channels();
    for (record, row) in rows.iter().enumerate() {
        for (line, number) in numbers.iter().enumerate() {
            let bin = bin_of(row, *number);
            let apart = |other: &f64| bin_of(row, *other).abs_diff(bin);
            let alone = numbers.iter().enumerate().all(|(k, n)| k == line || apart(n) > 2 * LOBE);
            let Some(lines) = all.get(record).filter(|_| usable(row, bin) && alone) else {
                continue;
            };
            let of = |channel: usize| {
                let densities = &row.densities[channel];
                let noise = beside(densities, bin, row.segments, &lines.clear);
                [2.0 * row.bin * lobe(densities, bin, noise)[0], LINE_NOISE * row.bin * noise]
            };
            let ([p, n], [q, m]) = (of(a), of(b));
            let axes = if group.is_radial() { 2.0 } else { 1.0 };
            points.push(Power {
                record,
                line,
                sense: Sense::Forward,
                spin: row.speed,
                frequency: number * row.speed,
                power: 0.5 * (p + q),
                // What no line is above has a density all the same.
                noise: (0.5 * (n + m)).max(f64::MIN_POSITIVE),
                bins: row.segments * axes / LOBE_NOISE,
                segments: row.segments * axes,
                amplitude: Complex::new(0.0, 0.0),
            });
        }
    }
    points
}
