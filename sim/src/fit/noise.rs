//! Noise beside a line, averaged over neighbouring speeds.
//!
//! The noise of one record is the mean of some tens of bins, uncertain by a fifth; weights by it would widen
//! what they weigh by more than their intervals say. A line is near its own frequency in the records of the
//! next speeds, so their noise is averaged, where it is alike: within a factor of 3 in every channel, as
//! chance leaves it, and within the bins that one record uses on either side.

use std::f64::consts::TAU;

use super::lines::{LineSet, Lines, NOISE_BINS, float};
use super::measurement::CHANNELS;
use super::rotation::Rotation;

/// Records on either side.
const NEIGHBOURS: usize = 2;
/// Noise that is no more different than this is averaged.
const ALIKE: f64 = 3.0;

/// The same lines with averaged noise.
pub(super) fn averaged(mut all: Vec<Lines>, rotations: &[Rotation], orders: &[f64]) -> Vec<Lines> {
    let mut rising: Vec<usize> = (0..all.len()).collect();
    rising.sort_by(|a, b| rotations[*a].speed.abs().total_cmp(&rotations[*b].speed.abs()));
    for (line, order) in orders.iter().enumerate() {
        let own: Vec<Option<LineSet>> = rising.iter().map(|k| all[*k].sets[line]).collect();
        let bins: Vec<f64> = rising.iter().map(|k| all[*k].noise_bins[line]).collect();
        for (place, record) in rising.iter().enumerate() {
            let Some(set) = own[place] else { continue };
            let width = all[*record].bin;
            let mut noise = set.noise.map(|row| row.map(|value| value * bins[place]));
            let mut count = bins[place];
            let near = place.saturating_sub(NEIGHBOURS)..(place + NEIGHBOURS + 1).min(rising.len());
            for other in near.filter(|other| *other != place) {
                let Some(found) = own[other] else { continue };
                let k = rising[other];
                let apart =
                    order * (rotations[k].speed.abs() - rotations[*record].speed.abs()) / TAU;
                // In terms of an amplitude, noise is by the length of its record.
                let scale = width / all[k].bin;
                if apart.abs() > float(NOISE_BINS) * width || !alike(&set, &found, scale) {
                    continue;
                }
                count += bins[other];
                for (row, other_row) in noise.iter_mut().zip(&found.noise) {
                    for (value, other_value) in row.iter_mut().zip(other_row) {
                        *value += other_value * scale * bins[other];
                    }
                }
            }
            let noise = noise.map(|row| row.map(|value| value / count));
            let mut next = LineSet { noise, ..set };
            for (channel, line) in next.channels.iter_mut().enumerate() {
                let ratio = noise[channel][channel].re / set.noise[channel][channel].re;
                line.noise *= ratio;
                line.step_variance *= ratio;
                line.bend_variance *= ratio;
            }
            all[*record].sets[line] = Some(next);
            all[*record].noise_bins[line] = count;
        }
    }
    all
}

fn alike(a: &LineSet, b: &LineSet, scale: f64) -> bool {
    (0..CHANNELS).all(|channel| {
        let ratio = scale * b.noise[channel][channel].re / a.noise[channel][channel].re;
        (1.0 / ALIKE..=ALIKE).contains(&ratio)
    })
}
