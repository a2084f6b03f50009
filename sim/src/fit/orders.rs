//! Harmonic numbers `h_l` of the lines, and speed and drift of every record, by all lines at once.
//!
//! A line turns at `h Omega` within a record. Its residual gives a step `d(h Omega)` ([`super::lines`]) with a
//! variance, free of the line's amplitude and phase. All steps together are a problem of least squares in
//! `d h_l` and `d Omega_k`, with the stated accuracy of the speeds as a prior; the speeds are eliminated:
//!
//! ```text
//! d(h_l Omega_k) = Omega_k d h_l + h_l d Omega_k        h = 1 is the imbalance, and exact
//! d(h_l drift_k) = h_l d drift_k
//! ```
//!
//! A step is too short by the share of noise in the line's power, `1 - E|dA|² / |A|²`, which is its regressor.
//! A line takes part in a record once its frequency is known to a third of a bin: the low lines find the speed
//! for the high ones. Where the accuracy of the speeds leaves the lowest anywhere in many bins, it is searched for
//! first ([`super::speeds`]). A line that does not take part in the end is not measured in that record: its
//! amplitude at a wrong frequency would be too small.

use std::f64::consts::TAU;

use nalgebra::{DMatrix, DVector};

use super::estimate::Estimate;
use super::lines::{LineSet, Lines, Transforms, float, lines};
use super::measurement::{CHANNELS, Measurement, Record};
use super::noise::averaged;
use super::rotation::Rotation;
use super::speeds::located;

/// Iterations at most; each squares the error.
const ITERATIONS: usize = 12;
/// Converged: no line moves by more than this share of a bin.
const SETTLED: f64 = 1e-4;
/// A line takes part where its frequency is known to this share of a bin, and moves by this much at most.
const KNOWN: f64 = 0.35;
const STEP_MAX: f64 = 0.5;
/// Less of its power than this is noise, of a line that takes part.
const SIGNAL_MIN: f64 = 0.75;
/// The drift that is expected of a steady step without an index, as a share of its speed.
pub(super) const DRIFT: f64 = 2e-3;
/// And with one, at least: below it no line tells.
const DRIFT_MIN: f64 = 1e-9;
/// A speed that is known better than this, as a share, is exact.
pub(super) const EXACT: f64 = 1e-12;

/// Harmonic numbers, and the lines of all records at them.
#[derive(Clone, Debug)]
pub(super) struct OrderLines {
    pub(super) orders: Vec<Estimate>,
    pub(super) rotations: Vec<Rotation>,
    pub(super) lines: Vec<Lines>,
    /// Records in which no line gives the speed, so none is measured.
    pub(super) lost: Vec<usize>,
}

/// The sums over a record.
struct Sums {
    /// Information on the frequency of each line, and the step by it.
    information: Vec<f64>,
    right: Vec<f64>,
    /// The variance of the latter.
    variance: Vec<f64>,
    /// The information of the speed's prior.
    prior: f64,
    /// The same of the speed, with its prior.
    speed: [f64; 2],
    /// The same of the drift.
    drift: [f64; 2],
    /// Sum of squares by variance, and their number.
    squares: [f64; 2],
    /// Whether the frequency of each line is known well enough to measure it.
    known: Vec<bool>,
}

/// Harmonic numbers from first guesses, speeds that are stated to `accuracy`, and lines at `fixed`
/// frequencies, Hz, which follow no speed. None where the lines of a record depend on each other.
pub(super) fn track(
    measurement: &Measurement,
    rotations: Vec<Rotation>,
    guesses: &[f64],
    fixed: &[f64],
    accuracy: f64,
) -> Option<OrderLines> {
    let mut orders = guesses.to_vec();
    let mut rotations = rotations;
    let mut transforms = Transforms::default();
    let records = &measurement.records;
    let stated: Vec<Rotation> = rotations.clone();
    let mut found_to = vec![f64::INFINITY; records.len()];
    for ((record, rotation), deviation) in records.iter().zip(&mut rotations).zip(&mut found_to) {
        if let Some(start) = located(record, rotation, guesses, fixed, accuracy, &mut transforms) {
            (rotation.speed, rotation.drift) = (start.speed, start.drift);
            *deviation = start.deviation;
        }
    }
    let mut estimates = Vec::new();
    let mut all = Vec::new();
    let mut known = Vec::new();
    for iteration in 0..ITERATIONS {
        all = records
            .iter()
            .zip(&rotations)
            .map(|(record, rotation)| lines(record, rotation, &orders, fixed, &mut transforms))
            .collect::<Option<Vec<_>>>()?;
        all = averaged(all, &rotations, &orders);
        let sums: Vec<_> = (0..records.len())
            .map(|k| {
                let priors = [accuracy, found_to[k]];
                sums(&records[k], &all[k], &orders, [&rotations[k], &stated[k]], priors)
            })
            .collect();
        let (steps, covariance) = joint(&sums, &rotations, &orders);
        let freedom = freedom(&sums, &orders);
        let variance = variance(&sums, freedom);
        estimates = (0..orders.len())
            .map(|l| Estimate::new(orders[l], (variance * covariance[(l, l)]).sqrt(), freedom))
            .collect();
        known = sums.iter().map(|sums| sums.known.clone()).collect();
        // The last pass only evaluates.
        if iteration + 1 == ITERATIONS {
            break;
        }
        let moved = advance(&sums, &steps, records, &mut orders, &mut rotations);
        if moved < SETTLED {
            break;
        }
    }
    let mut lost = Vec::new();
    for (record, (found, known)) in all.iter_mut().zip(&known).enumerate() {
        let before = found.sets.iter().any(Option::is_some);
        for (set, known) in found.sets.iter_mut().zip(known) {
            *set = set.filter(|_| *known);
        }
        if before && found.sets.iter().all(Option::is_none) {
            lost.push(record);
        }
    }
    Some(OrderLines { orders: estimates, rotations, lines: all, lost })
}

/// The channels' steps of a line as one.
#[derive(Clone, Copy, Debug, Default)]
struct Step {
    /// Information on the frequency, the step by it, and the step's variance by that of its noise.
    information: f64,
    right: f64,
    variance: f64,
    /// The first two for the rate of change.
    bend: [f64; 2],
}

fn of_line(line: &LineSet) -> Step {
    let mut sums = Step::default();
    let mut share = [0.0; CHANNELS];
    for (channel, share) in line.channels.iter().zip(&mut share) {
        let signal = 1.0 - channel.noise / channel.amplitude.norm_sqr();
        // Also not a number: a channel without any signal.
        let counts = signal >= SIGNAL_MIN && channel.step_variance > 0.0;
        if !counts {
            continue;
        }
        sums.information += signal * signal / channel.step_variance;
        sums.right += signal * channel.step / channel.step_variance;
        sums.bend[0] += signal * signal / channel.bend_variance;
        sums.bend[1] += signal * channel.bend / channel.bend_variance;
        *share = signal / channel.step_variance.sqrt();
    }
    // Steps of two channels are as correlated as the parts of their noise in quadrature to the lines.
    for a in 0..CHANNELS {
        for b in 0..CHANNELS {
            if share[a] == 0.0 || share[b] == 0.0 {
                continue;
            }
            let [of_a, of_b] = [a, b].map(|k| &line.channels[k]);
            let product = line.noise[a][b] * of_a.amplitude.conj() * of_b.amplitude;
            let sizes = (of_a.noise * of_b.noise).sqrt();
            let sizes = sizes * of_a.amplitude.norm() * of_b.amplitude.norm();
            sums.variance += share[a] * share[b] * product.re / sizes;
        }
    }
    sums
}

fn sums(
    record: &Record,
    found: &Lines,
    orders: &[f64],
    [rotation, stated]: [&Rotation; 2],
    [accuracy, found_to]: [f64; 2],
) -> Sums {
    let count = orders.len();
    let size = rotation.speed.abs();
    let duration = record.duration();
    // What is known of speed and drift before the lines.
    let (spread, bend_spread) = if rotation.indexed {
        (rotation.speed_deviation, rotation.drift_deviation.max(DRIFT_MIN * size / duration))
    } else {
        (accuracy * size, DRIFT * size / duration)
    };
    let prior = if spread > EXACT * size { 1.0 / (spread * spread) } else { f64::INFINITY };
    let drift_prior = 1.0 / (bend_spread * bend_spread);
    let mut sums = Sums {
        information: vec![0.0; count],
        right: vec![0.0; count],
        variance: vec![0.0; count],
        prior,
        speed: [prior, 0.0],
        drift: [drift_prior, drift_prior * (stated.drift - rotation.drift)],
        squares: [0.0; 2],
        known: vec![false; count],
    };
    // What the search tells is in the lines once more: it opens the gate, and is no prior.
    let mut sharp = prior.max(1.0 / (found_to * found_to));
    if prior.is_finite() {
        sums.speed[1] = prior * (stated.speed - rotation.speed);
    }
    let mut rising: Vec<usize> = (0..count).collect();
    rising.sort_by(|a, b| orders[*a].total_cmp(&orders[*b]));
    for l in rising {
        let Some(line) = found.sets.get(l).and_then(Option::as_ref) else { continue };
        let h = orders[l];
        let known = h / sharp.sqrt() * duration / TAU;
        if known > KNOWN {
            continue;
        }
        sums.known[l] = true;
        let Step { information, right, variance, bend } = of_line(line);
        sums.information[l] = information;
        sums.right[l] = right;
        sums.variance[l] = variance;
        sums.speed[0] += h * h * information;
        sharp += h * h * information;
        sums.speed[1] += h * right;
        sums.drift[0] += h * h * bend[0];
        sums.drift[1] += h * bend[1];
        if variance > 0.0 {
            sums.squares[0] += right * right / variance;
            sums.squares[1] += 1.0;
        }
    }
    sums
}

/// Steps of the harmonic numbers with the speeds eliminated, and their covariance.
fn joint(sums: &[Sums], rotations: &[Rotation], orders: &[f64]) -> (Vec<f64>, DMatrix<f64>) {
    let count = orders.len();
    let mut normal = DMatrix::zeros(count, count);
    let mut right = DVector::zeros(count);
    let mut scatter = DMatrix::zeros(count, count);
    for (sums, rotation) in sums.iter().zip(rotations) {
        let spin = rotation.speed;
        let row = |l: usize| spin * orders[l] * sums.information[l];
        let recip = if sums.speed[0].is_finite() { 1.0 / sums.speed[0] } else { 0.0 };
        for l in 0..count {
            normal[(l, l)] += spin * spin * sums.information[l];
            right[l] += spin * sums.right[l] - row(l) * recip * sums.speed[1];
            for other in 0..count {
                normal[(l, other)] -= row(l) * recip * row(other);
            }
        }
        // The right side is this matrix times the steps by information, and the prior's.
        let map = DMatrix::from_fn(count, count, |l, other| {
            let own = if l == other { spin } else { 0.0 };
            own - row(l) * recip * orders[other]
        });
        let variances = DMatrix::from_diagonal(&DVector::from_column_slice(&sums.variance));
        scatter += &map * variances * map.transpose();
        if recip > 0.0 {
            let prior = DVector::from_fn(count, |l, _| row(l) * recip);
            scatter += &prior * prior.transpose() * sums.prior;
        }
    }
    // A line that is exact, or that no record shows, keeps its number.
    for l in 0..count {
        if orders[l] == 1.0 || normal[(l, l)] <= 0.0 {
            for other in 0..count {
                normal[(l, other)] = 0.0;
                normal[(other, l)] = 0.0;
            }
            (normal[(l, l)], right[l]) = (1.0, 0.0);
        }
    }
    let inverse =
        normal.cholesky().map_or_else(|| DMatrix::zeros(count, count), |factor| factor.inverse());
    let steps = &inverse * right;
    let mut covariance = &inverse * scatter * &inverse;
    for l in 0..count {
        if orders[l] == 1.0 {
            covariance[(l, l)] = 0.0;
        }
    }
    (steps.iter().copied().collect(), covariance)
}

fn freedom(sums: &[Sums], orders: &[f64]) -> f64 {
    let points: f64 = sums.iter().map(|sums| sums.squares[1]).sum();
    let free = orders.iter().filter(|order| **order != 1.0).count();
    // The share of each speed that the lines determine, and not its prior.
    let shares = sums.iter().filter(|sums| sums.speed[0].is_finite());
    let speeds: f64 = shares.map(|sums| 1.0 - sums.prior / sums.speed[0]).sum();
    (points - float(free) - speeds).max(4.0)
}

/// The variance of the steps by that which the noise beside the lines predicts; not below 1, as the scale
/// factor of the Particle Data Group's reviews: residuals show what noise misses, not less noise.
fn variance(sums: &[Sums], freedom: f64) -> f64 {
    let squares: f64 = sums.iter().map(|sums| sums.squares[0]).sum();
    (squares / freedom).max(1.0)
}

/// Moves orders, speeds and drifts; the largest move of a line, bins.
fn advance(
    sums: &[Sums],
    steps: &[f64],
    records: &[Record],
    orders: &mut [f64],
    rotations: &mut [Rotation],
) -> f64 {
    let mut most = 0.0_f64;
    let highest = orders.iter().copied().fold(1.0, f64::max);
    for ((sums, record), rotation) in sums.iter().zip(records).zip(rotations.iter_mut()) {
        let duration = record.duration();
        let bin = TAU / (duration * highest);
        if sums.speed[0].is_finite() {
            let by_orders: f64 = (0..steps.len())
                .map(|l| rotation.speed * orders[l] * sums.information[l] * steps[l])
                .sum();
            let step = (sums.speed[1] - by_orders) / sums.speed[0];
            let step = step.clamp(-STEP_MAX * bin * highest, STEP_MAX * bin * highest);
            rotation.speed += step;
            most = most.max((step / bin).abs());
        }
        let limit = bin / duration;
        let bend = (sums.drift[1] / sums.drift[0]).clamp(-limit * highest, limit * highest);
        rotation.drift += bend;
        // The index keeps its mean angle: that of t² is a twelfth of the duration's square.
        if rotation.indexed {
            rotation.angle -= bend * duration * duration / 24.0;
        }
        most = most.max((bend * duration / bin).abs());
    }
    let slowest = records.iter().zip(rotations.iter());
    let size = slowest.map(|(r, rotation)| rotation.speed.abs() * r.duration() / TAU);
    let turns = size.fold(0.0, f64::max);
    for (order, step) in orders.iter_mut().zip(steps) {
        let step = step.clamp(-STEP_MAX / turns, STEP_MAX / turns);
        *order += step;
        most = most.max((step * turns).abs());
    }
    most
}
