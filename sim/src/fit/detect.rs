//! Lines that follow the speed: harmonic numbers found in the spectra of all records together.
//!
//! Of each record the residual's PSD by its running median is 1 on average where there is noise. At a trial
//! number h it is read at `h Omega` in every record, no more than 25 counting, and summed: a line of the wheel
//! is there at every speed, one of the mains or of a mode in few records. The strongest numbers are taken,
//! all lines fitted and tracked anew, and the residual searched again, until nothing is 8 standard deviations
//! above the noise, and beyond what so many trials reach by chance: the sum over few records has a long tail. RWDMES and Masterson's toolbox find harmonics in waterfalls by peaks; the sum over speeds
//! sees lines that no single spectrum shows.

use std::f64::consts::TAU;

use statrs::function::gamma::checked_gamma_ur;

use super::discrepancy::Remainder;
use super::error::FitError;
use super::lines::{Lines, float};
use super::lobe::{beside, lobe};
use super::measurement::{Group, Measurement, Record};
use super::orders::{OrderLines, track};
use super::rotation::Rotation;

/// A statistic above this is a line, standard deviations; 8 because thousands of numbers are tried.
const THRESHOLD: f64 = 8.0;
/// What a record counts at most, by its noise.
const CAPPED: f64 = 25.0;
/// A record shows a line where it is above this, by its noise; a quarter of the records do.
const SHOWN: f64 = 4.0;
const SHOWN_SHARE: f64 = 0.25;
/// Noise is taken for a line this often in a search, by the distribution of the sum over records.
const CHANCE: f64 = 1e-3;
/// The lowest trial number: subharmonics of bearings (a cage turns at about 0.4).
const LOWEST: f64 = 0.2;
/// Trial numbers at most.
const TRIALS_MAX: usize = 2_000_000;
/// Passes, and lines, at most.
const PASSES: usize = 12;
pub(super) const LINES_MAX: usize = 40;
/// Bins on either side of the running median.
const MEDIAN: usize = 32;
/// Trial numbers are this share of a bin of the fastest record apart; the place of a line is looked for so many steps to
/// either side of its peak.
const STEP: f64 = 0.25;
const NEAR: i32 = 24;
/// A new line is this far from others of its pass, bins of the slowest record, and from lines that are
/// taken already, bins of the fastest.
const APART: f64 = 4.0;
const APART_TAKEN: f64 = 1.5;
/// A lobe whose sum is above this by the noise's density shows a line.
const LEFT_SHOWN: f64 = 10.0;
/// Lines that are left in the residuals are named up to so many.
const LEFT_MAX: usize = 6;
/// Of a pass, what is below this share of its strongest is left for the next: it may be a side lobe.
const SHARE_OF_BEST: f64 = 0.2;

/// Lines that are tracked, and what is known of the speeds.
pub(super) struct Search<'a> {
    pub(super) measurement: &'a Measurement,
    pub(super) rotations: Vec<Rotation>,
    pub(super) fixed: &'a [f64],
    pub(super) accuracy: f64,
    pub(super) highest: f64,
}

/// Tracks stated lines, or finds them.
///
/// # Errors
/// [`FitError::NoLines`] where there is none.
pub(super) fn detect(
    search: &Search<'_>,
    progress: &mut dyn FnMut(&str),
) -> Result<OrderLines, FitError> {
    let failed = FitError::NoLines { highest: 0.0, bound: THRESHOLD };
    let run = |orders: &[f64]| {
        let rotations = search.rotations.clone();
        track(search.measurement, rotations, orders, search.fixed, search.accuracy)
    };
    // The imbalance gives the speeds, however small it is.
    let mut orders = vec![1.0];
    let mut tracked = run(&orders).ok_or(failed)?;
    let mut best = 0.0;
    let durations: Vec<f64> = search.measurement.records.iter().map(Record::duration).collect();
    for pass in 0..PASSES {
        progress(&format!("lines, pass {}: {}", pass + 1, orders.len()));
        let (found, highest) = strongest(search.highest, &durations, &tracked);
        best = if pass == 0 { highest } else { best };
        if found.is_empty() || orders.len() >= LINES_MAX {
            break;
        }
        orders = tracked.orders.iter().map(|order| order.value).collect();
        orders.extend(found);
        orders.truncate(LINES_MAX);
        orders.sort_by(f64::total_cmp);
        match run(&orders) {
            Some(next) => tracked = next,
            None => break,
        }
    }
    if tracked.orders.len() == 1 && best < THRESHOLD && !shows(&tracked) {
        return Err(FitError::NoLines { highest: best, bound: THRESHOLD });
    }
    Ok(tracked)
}

/// Whether the first line is above its noise in some record.
fn shows(tracked: &OrderLines) -> bool {
    let first = tracked.lines.iter().filter_map(|found| found.sets.first()?.as_ref());
    first
        .flat_map(|line| line.channels)
        .any(|line| line.amplitude.norm_sqr() > SHOWN * SHOWN * line.noise)
}

/// The PSD of each channel of a record by its running median; 0 beside fitted lines.
fn whitened(found: &Lines) -> Vec<Vec<f64>> {
    let of = |spectrum: &Vec<f64>| {
        let count = spectrum.len();
        let mut out = vec![0.0; count];
        let mut near = Vec::with_capacity(2 * MEDIAN + 1);
        let mut median = 0.0;
        for bin in 0..count {
            // The median of neighbours changes slowly: every fourth bin has its own.
            if bin % 4 == 0 {
                near.clear();
                let range = bin.saturating_sub(MEDIAN)..(bin + MEDIAN + 1).min(count);
                near.extend(range.filter(|k| found.clear[*k]).map(|k| spectrum[k]));
                near.sort_by(f64::total_cmp);
                median = near.get(near.len() / 2).copied().unwrap_or(0.0);
            }
            if median > 0.0 && found.clear[bin] {
                out[bin] = spectrum[bin] / median * std::f64::consts::LN_2;
            }
        }
        out
    };
    found.spectra.iter().map(of).collect()
}

/// Harmonic numbers above the threshold, strongest first, and the highest statistic, of records that last as
/// long, s.
pub(super) fn strongest(
    highest_number: f64,
    durations: &[f64],
    tracked: &OrderLines,
) -> (Vec<f64>, f64) {
    let turns = |k: usize| tracked.rotations[k].speed.abs() * durations[k] / TAU;
    let fastest = (0..durations.len()).map(turns).fold(0.0, f64::max);
    let slowest = (0..durations.len()).map(turns).fold(f64::INFINITY, f64::min);
    let spectra: Vec<_> = tracked.lines.iter().map(whitened).collect();
    let step = (STEP / fastest).max(highest_number / float(TRIALS_MAX));
    let mut statistics = Vec::new();
    let mut h = LOWEST;
    // Independent ones: bins of the fastest record, in four groups.
    let trials = (4.0 * fastest * highest_number).max(1.0);
    while h <= highest_number {
        statistics.push((h, statistic(h, tracked, &spectra, CHANCE / trials)));
        h += step;
    }
    let highest = statistics.iter().map(|(_, z)| *z).fold(0.0, f64::max);
    let mut peaks: Vec<(f64, f64)> = statistics
        .windows(3)
        .filter(|w| w[1].1 >= w[0].1 && w[1].1 > w[2].1 && w[1].1 > THRESHOLD)
        .map(|w| w[1])
        .collect();
    peaks.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut taken: Vec<f64> = Vec::new();
    for (h, z) in peaks {
        let new = taken.iter().all(|other| (h - other).abs() * slowest > APART);
        let own =
            |h: f64| tracked.orders.iter().all(|o| (h - o.value).abs() * fastest > APART_TAKEN);
        if new && own(h) && z > SHARE_OF_BEST * highest {
            let h = sharpened(h, STEP / fastest, tracked, &spectra);
            let apart = |other: &f64| (h - other).abs() * fastest > APART_TAKEN;
            if own(h) && taken.iter().all(apart) {
                taken.push(h);
            }
        }
    }
    (taken, highest)
}

/// Lines in the residuals of a fit, strongest first, with their sizes: the median over the records that show them.
pub(super) fn remainders(highest: f64, durations: &[f64], tracked: &OrderLines) -> Vec<Remainder> {
    let (numbers, _) = strongest(highest, durations, tracked);
    let of = |number: f64| {
        let each = Group::ALL.into_iter().filter_map(|group| {
            let mut sizes: Vec<f64> = Vec::new();
            let records = tracked.lines.iter().zip(&tracked.rotations);
            for (found, rotation) in records {
                let speed = rotation.speed.abs();
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "a bin"
                )]
                let bin = (number * speed / TAU / found.bin).round() as usize;
                let powers = group.channels().map(|channel| {
                    let densities = &found.spectra[channel];
                    let noise = beside(densities, bin, found.segments, &found.clear)?;
                    let [sum, _] = lobe(densities, bin, noise.density);
                    (sum > LEFT_SHOWN * noise.density).then_some(2.0 * found.bin * sum)
                });
                // Of a pair that turns, the mean of both axes.
                let shown: Vec<f64> = powers.into_iter().flatten().collect();
                if !shown.is_empty() {
                    sizes.push((0.5 * shown.iter().sum::<f64>()).sqrt() / (speed * speed));
                }
            }
            sizes.sort_by(f64::total_cmp);
            let size = *sizes.get(sizes.len() / 2)?;
            let shows = float(sizes.len()) >= SHOWN_SHARE * float(durations.len());
            shows.then_some(Remainder { group, number, size })
        });
        each.collect::<Vec<_>>()
    };
    numbers.into_iter().take(LEFT_MAX).flat_map(of).collect()
}

/// A trial number where the sum without a cap is largest near it: the statistic caps what a record counts, so it is flat
/// about a strong line.
fn sharpened(h: f64, step: f64, tracked: &OrderLines, spectra: &[Vec<Vec<f64>>]) -> f64 {
    let mut best = (strength(h, tracked, spectra), h);
    for place in (1..=NEAR).flat_map(|k| [-k, k]) {
        let near = h + f64::from(place) * step;
        let found = strength(near, tracked, spectra);
        if found > best.0 {
            best = (found, near);
        }
    }
    best.1
}

/// The sum of a trial number over all records and channels, without a cap.
fn strength(h: f64, tracked: &OrderLines, spectra: &[Vec<Vec<f64>>]) -> f64 {
    let each = tracked.lines.iter().zip(&tracked.rotations).zip(spectra);
    each.map(|((found, rotation), spectra)| {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a bin")]
        let bin = (h * rotation.speed.abs() / TAU / found.bin).round() as usize;
        spectra.iter().filter_map(|channel| channel.get(bin)).sum::<f64>()
    })
    .sum()
}

/// The statistic of a trial number: of the group that shows it best, standard deviations; not above the threshold
/// where pure noise reaches it with a probability above `chance`.
fn statistic(h: f64, tracked: &OrderLines, spectra: &[Vec<Vec<f64>>], chance: f64) -> f64 {
    let mut sums = [0.0; 4];
    let mut shown = [0_usize; 4];
    let mut counted = 0_usize;
    let mut segments = 0.0;
    for ((found, rotation), spectra) in tracked.lines.iter().zip(&tracked.rotations).zip(spectra) {
        let bin = h * rotation.speed.abs() / TAU / found.bin;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a bin")]
        let bin = bin.round() as usize;
        if 10 * bin >= 9 * found.clear.len() || !found.clear.get(bin).copied().unwrap_or(false) {
            continue;
        }
        counted += 1;
        segments += found.segments;
        for (k, group) in Group::ALL.into_iter().enumerate() {
            let [a, b] = group.channels().map(|channel| spectra[channel][bin]);
            let value = 0.5 * (a + b);
            sums[k] += value.min(CAPPED) - 1.0;
            shown[k] += usize::from(value > SHOWN);
        }
    }
    if counted < 3 {
        return 0.0;
    }
    let n = float(counted);
    let enough = (SHOWN_SHARE * n).max(2.0);
    let mut best = 0.0_f64;
    for ((group, sum), shown) in Group::ALL.into_iter().zip(sums).zip(shown) {
        if float(shown) < enough {
            continue;
        }
        let z = sum / n.sqrt();
        // A mean of segments, of a radial pair of twice as many, is of a gamma distribution.
        let axes = if group.is_radial() { 2.0 } else { 1.0 };
        let shape = axes * segments;
        let by_chance = || checked_gamma_ur(shape, shape * (sum + n) / n).is_ok_and(|p| p > chance);
        best = best.max(if z > THRESHOLD && by_chance() { THRESHOLD.next_down() } else { z });
    }
    best
}
