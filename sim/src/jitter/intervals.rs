//! [`Density`]: a density in intervals of frequency, and its integral over any part of them.
//!
//! An integral is split at every edge that it has: the ends of the noises' bands, the frequencies of their tables, and the
//! ends of the band of a metric. Intervals are short where a natural frequency is: the density of a mode of damping ratio zeta
//! is as wide as `2 zeta` of its frequency. In each interval the rule of Gauss and Legendre with five frequencies integrates over
//! the logarithm of the frequency, in which a density on a rigid hub is an exponential function: to rounding. Within an
//! interval the density is that of the polynomial through the logarithms of the five, so a power of the frequency is exact
//! there, too.

use std::f64::consts::{LN_10, TAU};

use super::campbell::Oscillation;
use super::weight::{PERIODS_MAX, Weight};
use crate::spectra::float;

/// Intervals of a decade.
const PER_DECADE: f64 = 16.0;
/// An undamped mode has intervals as one with this damping ratio: its mean square is not finite, and the result is large.
const DAMPING_MIN: f64 = 1e-9;
/// Frequencies of an interval.
pub(super) const NODES: usize = 5;
/// Gauss and Legendre: places from -1 to 1, and weights whose sum is 2 (Abramowitz and Stegun, table 25.4).
const RULE: [[f64; 2]; NODES] = [
    [-0.906_179_845_938_664, 0.236_926_885_056_189_08],
    [-0.538_469_310_105_683_1, 0.478_628_670_499_366_47],
    [0.0, 0.568_888_888_888_888_9],
    [0.538_469_310_105_683_1, 0.478_628_670_499_366_47],
    [0.906_179_845_938_664, 0.236_926_885_056_189_08],
];
/// Parts of a period of a share that goes to and fro.
const PARTS: f64 = 2.0;

/// A density in an interval of frequency.
pub(super) struct Density {
    /// Hz.
    pub(super) ends: [f64; 2],
    /// At the five frequencies.
    pub(super) values: [f64; NODES],
}

impl Density {
    /// Mean square of a part of the interval, Hz, weighted.
    pub(super) fn integral(&self, part: [f64; 2], weight: &Weight) -> f64 {
        let [from, to] = weight.support(part);
        if from >= to {
            return 0.0;
        }
        let periods = weight.time().map_or(0.0, |time| (to - from) * time);
        let is_mean = periods > PERIODS_MAX;
        let share = |frequency: f64| {
            if is_mean { weight.mean_at(frequency) } else { weight.at(TAU * frequency) }
        };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 1024")]
        let parts = if is_mean { 1 } else { (PARTS * periods).ceil().max(1.0) as usize };
        let is_whole = parts == 1 && [from, to] == self.ends;
        let mut sum = 0.0;
        for part in 0..parts {
            let end = |part: usize| from + (to - from) * (float(part) / float(parts));
            let ends = [end(part), end(part + 1)];
            let half = 0.5 * libm::log(ends[1] / ends[0]);
            for ((frequency, [_, of_node]), value) in
                nodes(ends).into_iter().zip(RULE).zip(self.values)
            {
                let density = if is_whole { value } else { self.at(frequency) };
                sum += half * of_node * frequency * density * share(frequency);
            }
        }
        sum
    }

    /// At a frequency, Hz: the polynomial through the logarithms of the five values, or through the values where one is not
    /// above zero.
    fn at(&self, frequency: f64) -> f64 {
        let [from, to] = self.ends;
        let place = 2.0 * libm::log(frequency / from) / libm::log(to / from) - 1.0;
        let is_positive = self.values.iter().all(|value| *value > 0.0);
        let mut sum = 0.0;
        for (node, (value, [own, _])) in self.values.iter().zip(RULE).enumerate() {
            let others = RULE.iter().enumerate().filter(|(other, _)| *other != node);
            let lagrange: f64 =
                others.map(|(_, [other, _])| (place - other) / (own - other)).product();
            sum += lagrange * if is_positive { libm::log(*value) } else { *value };
        }
        if is_positive { libm::exp(sum) } else { sum.max(0.0) }
    }
}

/// The five frequencies of an interval, Hz: even in the logarithm, as the rule has them.
pub(super) fn nodes([from, to]: [f64; 2]) -> [f64; NODES] {
    let half = 0.5 * libm::log(to / from);
    RULE.map(|[place, _]| from * libm::exp(half * (1.0 + place)))
}

/// Intervals of frequency, Hz, within some bands: split at their ends and at corners, and short at natural frequencies.
pub(super) fn intervals(
    bands: &[[f64; 2]],
    corners: impl Iterator<Item = f64>,
    natural: &[Oscillation],
) -> Vec<[f64; 2]> {
    let mut edges: Vec<f64> = bands.iter().flatten().copied().chain(corners).collect();
    edges.sort_by(f64::total_cmp);
    edges.dedup();
    let mut intervals = Vec::new();
    for pair in edges.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        let middle = 0.5 * (from + to);
        if !bands.iter().any(|[first, last]| *first < middle && middle < *last) {
            continue;
        }
        let decades = libm::log(to / from) / LN_10;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 700")]
        let parts = (PER_DECADE * decades).ceil().max(1.0) as usize;
        let end = |part: usize| match part {
            0 => from,
            part if part == parts => to,
            part => from * libm::exp(LN_10 * decades * float(part) / float(parts)),
        };
        for part in 0..parts {
            split([end(part), end(part + 1)], natural, &mut intervals);
        }
    }
    intervals
}

/// Halves an interval, Hz, until it is no longer than its distance from every natural frequency and the half-width of that.
fn split([from, to]: [f64; 2], natural: &[Oscillation], intervals: &mut Vec<[f64; 2]>) {
    let is_long = natural.iter().any(|of| {
        let centre = of.frequency / TAU;
        let apart = (from - centre).max(centre - to).max(0.0);
        to - from > apart + centre * of.damping.abs().max(DAMPING_MIN)
    });
    let middle = 0.5 * (from + to);
    if is_long && from < middle && middle < to {
        split([from, middle], natural, intervals);
        split([middle, to], natural, intervals);
    } else {
        intervals.push([from, to]);
    }
}

#[cfg(test)]
mod tests;
