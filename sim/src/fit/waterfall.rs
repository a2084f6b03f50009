//! A fit to spectra where the time series are gone: densities over frequency at each speed.
//!
//! A line has the power of its lobe above the noise beside it, and the frequency of the lobe's centroid
//! ([`super::lobe`]). There are no phases: forward and backward cannot be distinguished, and all radial lines count
//! as forward; moments cannot be referred to another point, so they are about W.

use std::f64::consts::TAU;

use nalgebra::Complex;

use super::detect::{LINES_MAX, remainders, strongest};
use super::error::FitError;
use super::estimate::Estimate;
use super::lines::{Lines, float};
use super::lobe::{CLEAR, LINE_NOISE, LOBE, beside, centroid_variance, lobe, noise_variance};
use super::measurement::{CHANNELS, Group, RECORDS_MIN, twice};
use super::orders::OrderLines;
use super::powers::{self, Power, Sense};
use super::rotation::Rotation;
use super::search;
use super::{Fitted, Options, assembled, check};

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
    let densities: Vec<_> = rows.iter().map(|row| &row.densities).collect();
    let Some(places) = twice(&densities) else { return Ok(()) };
    let places = places.map(|place| place + 1);
    Err(FitError::Twice { records: places.map(|place| format!("speed {place}")), places })
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
        segments: row.segments,
        noise_bins: Vec::new(),
    };
    let lines = rows.iter().map(spectra).collect();
    let mut tracked = OrderLines { orders: Vec::new(), rotations, lines, lost: Vec::new() };
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
    let left = remainders(options.highest, &durations(rows), &tracked);
    let names: Vec<_> = (1..=rows.len()).map(|number| format!("speed {number}")).collect();
    assembled(tracked, groups, &left, &names, options)
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
fn mask(tracked: &mut OrderLines, rows: &[WaterfallRow], numbers: &[f64]) {
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
            let Some(noise) = beside(densities, bin, row.segments, &lines.clear) else { continue };
            let [sum, offset] = lobe(densities, bin, noise.density);
            if sum > 10.0 * noise.density && offset.abs() < 1.5 {
                let turns = row.speed.abs() / TAU / row.bin;
                let weight = turns * turns / centroid_variance(noise.density / sum);
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
    // The variance of the mean by the scatter of each centroid, not by one factor of all weights: segments
    // that overlap leave more of the noise than of its product with the line, which the weights do not know.
    let shares = || found.iter().flatten().map(|[v, w]| (w / weights, v - mean));
    let variance: f64 = shares().map(|(s, error)| s * s * error * error / (1.0 - s)).sum();
    // Satterthwaite's degrees of freedom of this sum.
    let freedom = 1.0 / shares().map(|(s, _)| s * s).sum::<f64>();
    Estimate::new(mean, variance.sqrt(), freedom)
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
                let noise = beside(densities, bin, row.segments, &lines.clear)?;
                let power = 2.0 * row.bin * lobe(densities, bin, noise.density)[0];
                Some(([power, LINE_NOISE * row.bin * noise.density], noise.bins))
            };
            let (Some(([p, n], bins)), Some(([q, m], _))) = (of(a), of(b)) else { continue };
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
                bins: row.segments * axes / noise_variance(bins),
                segments: row.segments * axes,
                amplitude: Complex::new(0.0, 0.0),
            });
        }
    }
    points
}
