//! [`Band`]: broadband noise of a group, a one-sided PSD over bands of frequency.
//!
//! The residual of the lines, away from them, in bands of equal ratio; what the fitted modes amplify is
//! divided by `|H|²` where that is above 1, of a radial pair by the mean of both senses, bin by bin. It is the mean over all speeds;
//! the densities at the lower and the upper half of the speeds show whether it grows with them.

use std::f64::consts::TAU;

use super::estimate::Estimate;
use super::lines::{INDEPENDENT, Lines, float};
use super::measurement::Group;
use super::modes::{Mode, amplification};
use super::rotation::Rotation;

/// Bands of a decade.
const PER_DECADE: f64 = 10.0;
/// The lowest band begins at this many bins, and the highest ends at this share of the spectrum.
const LOWEST_BIN: f64 = 4.0;
const HIGHEST_SHARE: f64 = 0.9;
/// Bins that a band needs.
const BINS_MIN: f64 = 8.0;

/// A band of frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// Its ends, Hz.
    pub range: [f64; 2],
    /// PSD of each axis, N²/Hz or N² m²/Hz.
    pub density: Estimate,
    /// The same of the lower and of the upper half of the speeds.
    pub halves: [f64; 2],
}

/// The bands of a group.
#[must_use]
pub(super) fn floor(
    group: Group,
    all: &[Lines],
    rotations: &[Rotation],
    modes: &[Mode],
) -> Vec<Band> {
    let lowest = all.iter().map(|found| found.bin).fold(0.0, f64::max) * LOWEST_BIN;
    let highest = all
        .iter()
        .map(|found| float(found.clear.len()) * found.bin * HIGHEST_SHARE)
        .fold(f64::INFINITY, f64::min);
    // Not finite without records.
    if !(lowest > 0.0 && highest > lowest && highest.is_finite()) {
        return Vec::new();
    }
    let count = (PER_DECADE * (highest / lowest).log10()).ceil().max(1.0);
    let ratio = (highest / lowest).powf(1.0 / count);
    let mut speeds: Vec<f64> = rotations.iter().map(|rotation| rotation.speed.abs()).collect();
    speeds.sort_by(f64::total_cmp);
    let middle = speeds.get(speeds.len() / 2).copied().unwrap_or(0.0);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "some tens")]
    let mut sums = vec![([[0.0; 2]; 2], 0.0); count as usize];
    let samples = INDEPENDENT * if group.is_radial() { 2.0 } else { 1.0 };
    let channels = group.channels();
    for (found, rotation) in all.iter().zip(rotations) {
        let half = usize::from(rotation.speed.abs() >= middle);
        for (bin, _) in found.clear.iter().enumerate().filter(|(_, clear)| **clear) {
            let frequency = float(bin) * found.bin;
            let place = ((frequency / lowest).ln() / ratio.ln()).floor();
            if place < 0.0 || place >= count {
                continue;
            }
            let w = TAU * frequency;
            let gain = |w: f64| amplification(modes, w, rotation.speed).norm_sqr();
            let gain = if group.is_radial() { 0.5 * (gain(w) + gain(-w)) } else { gain(w) };
            // Below 1 it would raise the table's noise, which the modes do not filter.
            let gain = gain.max(1.0);
            let density = 0.5 * channels.iter().map(|c| found.spectra[*c][bin]).sum::<f64>() / gain;
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked")]
            let (halves, freedom) = &mut sums[place as usize];
            halves[half][0] += density;
            halves[half][1] += 1.0;
            *freedom += samples * found.segments;
        }
    }
    let mut bands = Vec::new();
    let mut from = lowest;
    for ([low, high], freedom) in sums {
        let to = from * ratio;
        let (total, bins) = (low[0] + high[0], low[1] + high[1]);
        let density = total / bins;
        if bins >= BINS_MIN && density.is_finite() {
            let of = |[sum, bins]: [f64; 2]| if bins > 0.0 { sum / bins } else { density };
            bands.push(Band {
                range: [from, to],
                density: Estimate::positive(density, freedom.sqrt().recip(), freedom),
                halves: [of(low), of(high)],
            });
        }
        from = to;
    }
    bands
}
