//! Speed and drift of a record without an index, searched for over all that is known of them beforehand.
//!
//! In a record of many turns a line is anywhere in many bins, and a drift spreads it over many. The part of each
//! channel's spectrum that the line may be in is a signal of few samples; it is turned back by trial drifts and
//! transformed again. With the noise `N` of a bin the logarithm of the likelihood of a line there is, up to a constant,
//!
//! ```text
//! J = sum |Z(speed, drift)|² / N - z_speed² / 2 - z_drift² / 2        sum over channels
//! ```
//!
//! (a matched filter of linear chirps; z are the distances from what is stated, by their standard deviations). The
//! largest J is taken where noise does not reach it by chance. Steps are a quarter of a bin and one bin of sweep, from
//! where Gauss and Newton's steps converge ([`super::orders`]). Where that takes too many trials, the middle half of
//! the record is searched first, and the whole near what it shows.

use std::f64::consts::TAU;

use nalgebra::Complex;

use super::lines::{HIGHEST_SHARE, LOWEST_BIN, Transforms, float};
use super::measurement::{CHANNELS, Record};
use super::orders::{DRIFT, EXACT};
use super::rotation::Rotation;
use crate::disturbance::fourier::Roots;

/// Speeds and drifts are searched within so many standard deviations.
const SPEEDS: f64 = 4.0;
const DRIFTS: f64 = 3.0;
/// What is known to this many bins, and to this many bins of sweep, is not searched for.
const NARROW: [f64; 2] = [0.25, 0.5];
/// Trial speeds in a bin.
const FINE: usize = 4;
/// The frequency of a line that was found is known to this share of a bin.
const FOUND: f64 = 0.2;
/// Bins beside the range that a line's lobe needs, and those on either side that show the noise.
const MARGIN: f64 = 4.0;
const BESIDE: usize = 48;
const BESIDE_MIN: usize = 8;
/// Bins about a line at a fixed frequency that are left out.
const FIXED: f64 = 2.5;
/// Trials times samples of a transform, at most; with more, half of the record is searched first.
const COST_MAX: usize = 1 << 23;
/// Samples of the shortest part.
const PART_MIN: usize = 512;
/// How often noise is taken for a line.
const CHANCE: f64 = 1e-4;
/// Noise is not below this share of the strongest bin: rounding.
const ROUNDING: f64 = 1e-24;

/// What a search found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Start {
    /// rad/s, with the sign of what was stated.
    pub(super) speed: f64,
    /// rad/s².
    pub(super) drift: f64,
    /// What the speed is known to, rad/s.
    pub(super) deviation: f64,
}

/// Centre and half-width of what is searched: size of the speed, rad/s, and its change, rad/s².
#[derive(Clone, Copy, Debug)]
struct Range {
    speed: [f64; 2],
    drift: [f64; 2],
}

/// The line of one number in one record.
struct Line<'a> {
    record: &'a Record,
    number: f64,
    fixed: &'a [f64],
    /// Centres and standard deviations.
    prior: Range,
}

/// A channel near the line: a signal of few samples, and its noise, by the same scale as a bin's power.
struct Baseband {
    samples: Vec<Complex<f64>>,
    noise: f64,
}

/// Speed and drift by the first of some harmonic numbers that shows itself, the imbalance before the others; none with
/// an index, of a speed that is exact, and where no line stands out of the noise.
pub(super) fn located(
    record: &Record,
    stated: &Rotation,
    numbers: &[f64],
    fixed: &[f64],
    accuracy: f64,
    transforms: &mut Transforms,
) -> Option<Start> {
    if stated.indexed || accuracy <= EXACT {
        return None;
    }
    let size = stated.speed.abs();
    let sense = stated.speed.signum();
    let prior = Range {
        speed: [size, accuracy * size],
        drift: [sense * stated.drift, DRIFT * size / record.duration()],
    };
    let range = Range {
        speed: [size, SPEEDS * prior.speed[1]],
        drift: [prior.drift[0], DRIFTS * prior.drift[1]],
    };
    let turn = TAU / record.duration();
    let [bins, sweeps] = [range.speed[1] / turn, range.drift[1] * record.duration() / turn];
    if bins < NARROW[0] && sweeps < NARROW[1] {
        return None;
    }
    let mut order: Vec<f64> = numbers.to_vec();
    order.sort_by(|a, b| (*a != 1.0).cmp(&(*b != 1.0)).then(a.total_cmp(b)));
    order.into_iter().find_map(|number| {
        let line = Line { record, number, fixed, prior };
        let [speed, drift] = line.search(record.length(), range, transforms)?;
        let deviation = FOUND * TAU / (number * record.duration());
        Some(Start { speed: sense * speed, drift: sense * drift, deviation })
    })
}

impl Line<'_> {
    /// Size of the speed and its change by the middle `length` samples of the record.
    fn search(&self, length: usize, range: Range, transforms: &mut Transforms) -> Option<[f64; 2]> {
        let duration = float(length) / self.record.rate;
        // The speed that is a bin, and the drift that sweeps over one.
        let turn = TAU / (self.number * duration);
        let sweep = turn / duration;
        let sweeps = (range.drift[1] / sweep).ceil();
        let reach =
            range.speed[1] / turn + 0.5 * (sweeps + (range.drift[0] / sweep).abs()) + MARGIN;
        let (reach, sweeps) = (whole(reach.ceil()), whole(sweeps));
        let size = (2 * reach + 2).next_power_of_two();
        let cost = (2 * sweeps + 1).saturating_mul(FINE * size);
        if cost > COST_MAX && length / 2 >= PART_MIN {
            let [speed, drift] = self.search(length / 2, range, transforms)?;
            let range = Range { speed: [speed, 2.0 * turn], drift: [drift, 8.0 * sweep] };
            return self.search(length, range, transforms);
        }
        let middle = whole((range.speed[0] / turn).round());
        let bands = self.basebands(length, [middle, reach, size], transforms)?;
        let [first, last] = [-1.0, 1.0].map(|side| {
            let end = (range.speed[0] + side * range.speed[1]) / turn - float(middle);
            (end * float(FINE)).round()
        });
        let (roots, fine) = (Roots::new(FINE * size), FINE * size);
        let step = duration / float(size);
        let centre = 0.5 * (float(length) - 1.0) / self.record.rate;
        let mut best = (f64::NEG_INFINITY, 0.0, range.speed[0], range.drift[0]);
        for trial in 0..=2 * sweeps {
            let drift = range.drift[0] + (float(trial) - float(sweeps)) * sweep;
            let mut sums = vec![0.0; fine];
            for band in &bands {
                let mut values = vec![Complex::new(0.0, 0.0); fine];
                for (index, (value, sample)) in values.iter_mut().zip(&band.samples).enumerate() {
                    let t = float(index) * step - centre;
                    let phase = 0.5 * self.number * drift * t * t;
                    let (sine, cosine) = precess_dynamics::Angle::sin_cos(phase);
                    // The conjugate: the sum below has the sign of a synthesis.
                    *value = (sample * Complex::new(cosine, -sine)).conj();
                }
                roots.synthesise(&mut values);
                let scale = 1.0 / (band.noise * float(size) * float(size));
                for (sum, value) in sums.iter_mut().zip(&values) {
                    *sum += scale * value.norm_sqr();
                }
            }
            let mut place = first;
            while place <= last {
                let speed = (float(middle) + place / float(FINE)) * turn;
                let index = if place < 0.0 { fine - whole(-place) } else { whole(place) };
                let power = sums.get(index).copied().unwrap_or(0.0);
                let gain = power - self.penalty(speed, drift);
                if gain > best.0 {
                    best = (gain, power, speed, drift);
                }
                place += 1.0;
            }
        }
        let trials = (last - first + 1.0) * float(2 * sweeps + 1);
        let (_, power, speed, drift) = best;
        stands_out(power, trials).then_some([speed, drift])
    }

    /// `z_speed² / 2 + z_drift² / 2`.
    fn penalty(&self, speed: f64, drift: f64) -> f64 {
        let by = |value: f64, [centre, deviation]: [f64; 2]| ((value - centre) / deviation).powi(2);
        0.5 * (by(speed, self.prior.speed) + by(drift, self.prior.drift))
    }

    /// The bins within `reach` of `middle` of each channel as signals of `size` samples; none where they are out of the
    /// band, or too few beside them show the noise.
    fn basebands(
        &self,
        length: usize,
        [middle, reach, size]: [usize; 3],
        transforms: &mut Transforms,
    ) -> Option<Vec<Baseband>> {
        let top = HIGHEST_SHARE * float(length);
        let in_band = |bin: usize| float(bin) >= LOWEST_BIN && float(bin) <= top;
        if !in_band(middle) {
            return None;
        }
        let duration = float(length) / self.record.rate;
        let free = |bin: usize| {
            let near = |line: &f64| (float(bin) - line * duration).abs() < FIXED;
            in_band(bin) && !self.fixed.iter().any(near)
        };
        let from = (self.record.length() - length) / 2;
        let weights = transforms.weights(length, self.record.rate);
        let plan = transforms.plan(length);
        let roots = Roots::new(size);
        let mut bands = Vec::with_capacity(CHANNELS);
        for channel in &self.record.channels {
            let samples = channel.get(from..from + length)?;
            let mut tapered: Vec<f64> = samples.iter().zip(&weights).map(|(x, w)| x * w).collect();
            let mut spectrum = plan.make_output_vec();
            // Lengths are those of the plan: it cannot fail.
            let _ = plan.process(&mut tapered, &mut spectrum);
            let value = |bin: usize| spectrum.get(bin).copied().unwrap_or_default();
            let below = middle.saturating_sub(reach);
            let sides = (below.saturating_sub(BESIDE)..below)
                .chain(middle + reach + 1..=middle + reach + BESIDE)
                .filter(|bin| free(*bin));
            let mut beside: Vec<f64> = sides.map(|bin| value(bin).norm_sqr()).collect();
            if beside.len() < BESIDE_MIN {
                return None;
            }
            beside.sort_by(f64::total_cmp);
            let mut samples = vec![Complex::new(0.0, 0.0); size];
            let mut strongest = 0.0_f64;
            for bin in (below..=middle + reach).filter(|bin| free(*bin)) {
                let place = if bin < middle { size - (middle - bin) } else { bin - middle };
                if let Some(sample) = samples.get_mut(place) {
                    *sample = value(bin);
                    strongest = strongest.max(sample.norm_sqr());
                }
            }
            // The median of an exponential distribution is ln 2 of its mean.
            let median = beside.get(beside.len() / 2).copied().unwrap_or(0.0);
            let noise = (median / std::f64::consts::LN_2).max(ROUNDING * strongest);
            if noise > 0.0 {
                roots.synthesise(&mut samples);
                bands.push(Baseband { samples, noise });
            }
        }
        Some(bands)
    }
}

/// Whether the power of a line in all channels by their noise is more than chance leaves in so many trials: each two
/// channels are taken as one, as where a moment is referred by its force.
fn stands_out(power: f64, trials: f64) -> bool {
    let half = 0.5 * power;
    half - (1.0 + half + 0.5 * half * half).ln() > (trials / CHANCE).ln()
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "counts of bins, at most those of a record"
)]
fn whole(value: f64) -> usize {
    value.clamp(0.0, 4_294_967_296.0) as usize
}
