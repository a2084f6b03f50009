//! [`Lines`]: amplitudes of all lines of one record by weighted least squares, the noise beside each, and
//! what the residual says of their frequencies.
//!
//! ```text
//! y(t) = sum_l Re(A_l exp(i h_l theta(t))) + b_0 + b_1 t + noise        weights w: Hann's window
//! ```
//!
//! All lines are fitted at once, so near ones do not leak into each other. Over a record the noise is taken
//! as white near a line, with the variance `v` per sample that the windowed residual has in the bins beside
//! it: `v = mean |sum w r exp(-i 2 pi f t)|² / sum w²`. Then
//!
//! ```text
//! E|dA|² = 4 v sum w² / (sum w)²
//! d omega = -sum w t r Im(A e) / (|A|² / 2 sum w t²)       variance v sum w² t² / (|A|² / 2 (sum w t²)²)
//! ```
//!
//! the last a step of Gauss and Newton towards the frequency of the line, uncorrelated with the amplitude
//! because t counts from the middle. With a rectangular window these are the bounds of Rife and Boorstyn
//! (IEEE Trans. Inf. Theory 20(5), 1974); Hann's costs 1.76 dB of amplitude and keeps far lines out. Another
//! estimator of spectra could be used here; what follows needs amplitudes, noise and the two corrections.

use std::f64::consts::TAU;
use std::sync::Arc;

use nalgebra::{Complex, DMatrix, DVector};
use realfft::{RealFftPlanner, RealToComplex};

use super::measurement::{CHANNELS, Record};
use super::rotation::{Rotation, phases, time};

/// A line is used from this many bins above zero frequency.
pub(super) const LOWEST_BIN: f64 = 3.0;
/// And up to this share of the sampling rate.
pub(super) const HIGHEST_SHARE: f64 = 0.45;
/// Two lines nearer than this, bins, are not resolved: their covariance is then beyond 3 %.
const RESOLVED: f64 = 1.5;
/// Two lines nearer than this are one column of the fit.
const SAME: f64 = 0.75;
/// Bins on either side of a line that show its noise, and how near another line may be, bins.
pub(super) const NOISE_BINS: usize = 32;
const CLEAR: f64 = 3.0;
/// Noise bins that a line needs.
pub(super) const NOISE_BINS_MIN: usize = 6;
/// Mean-square bins of Hann's window count for this share of independent ones: 1 / (1 + 2 (4/9) + 2 / 36).
pub(super) const INDEPENDENT: f64 = 36.0 / 70.0;

/// A window with its sums.
#[derive(Clone, Debug)]
struct Window {
    weight: Vec<f64>,
    /// s from the middle.
    time: Vec<f64>,
    /// Sums of w, w², w t², w² t².
    w: f64,
    ww: f64,
    wtt: f64,
    wwtt: f64,
}

/// A line in a channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Line {
    /// `A`, N or N m; the phase from the wheel's angle.
    pub(super) amplitude: Complex<f64>,
    /// `E|dA|²` of the noise beside it.
    pub(super) noise: f64,
    /// Step towards its frequency, rad/s, and its variance.
    pub(super) step: f64,
    pub(super) step_variance: f64,
    /// Step towards its rate of change, rad/s², and its variance.
    pub(super) bend: f64,
    pub(super) bend_variance: f64,
}

/// A line in all channels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LineSet {
    pub(super) channels: [Line; CHANNELS],
    /// `E[dA_a conj(dA_b)]`: noise that channels share, as force and referred moment do.
    pub(super) noise: [[Complex<f64>; CHANNELS]; CHANNELS],
}

/// The lines of a record.
#[derive(Clone, Debug)]
pub(super) struct Lines {
    /// Of each harmonic; none where it is out of the band, or not resolved from another line.
    pub(super) sets: Vec<Option<LineSet>>,
    /// One-sided PSD of the residual in each channel, units²/Hz, and which bins are away from all lines.
    pub(super) spectra: [Vec<f64>; CHANNELS],
    pub(super) clear: Vec<bool>,
    /// Width of a bin, Hz.
    pub(super) bin: f64,
    /// Independent segments that the densities are the mean of; 1 of a record.
    pub(super) segments: f64,
    /// Independent bins of a noise estimate.
    pub(super) noise_bins: Vec<f64>,
}

/// Plans of transforms, shared by records of one length.
#[derive(Default)]
pub(super) struct Transforms {
    planner: Option<RealFftPlanner<f64>>,
    window: Option<Window>,
    rate: f64,
}

impl Window {
    fn hann(length: usize, rate: f64) -> Self {
        let turn = TAU * rate / float(length);
        let time: Vec<f64> = (0..length).map(|index| time(index, length, rate)).collect();
        let shape = phases([0.0, turn, 0.0], length, rate);
        let weight: Vec<f64> = shape.iter().map(|e| 0.5 + 0.5 * e.re).collect();
        let sum =
            |of: &dyn Fn(f64, f64) -> f64| weight.iter().zip(&time).map(|(w, t)| of(*w, *t)).sum();
        Self {
            w: sum(&|w, _| w),
            ww: sum(&|w, _| w * w),
            wtt: sum(&|w, t| w * t * t),
            wwtt: sum(&|w, t| w * w * t * t),
            weight,
            time,
        }
    }
}

impl Transforms {
    /// Weights of Hann's window over so many samples.
    pub(super) fn weights(&mut self, length: usize, rate: f64) -> Vec<f64> {
        self.window(length, rate).weight
    }

    fn window(&mut self, length: usize, rate: f64) -> Window {
        match &self.window {
            Some(window) if window.weight.len() == length && self.rate == rate => window.clone(),
            _ => {
                let window = Window::hann(length, rate);
                self.window = Some(window.clone());
                self.rate = rate;
                window
            }
        }
    }

    pub(super) fn plan(&mut self, length: usize) -> Arc<dyn RealToComplex<f64>> {
        self.planner.get_or_insert_with(RealFftPlanner::new).plan_fft_forward(length)
    }
}

/// Which orders are in the band of a record and resolved, and which of them have columns.
fn usable(orders: &[f64], fixed: &[f64], record: &Record, rotation: &Rotation) -> Vec<[bool; 2]> {
    let bin = 1.0 / record.duration();
    let hertz = |order: &f64| order * rotation.speed.abs() / TAU;
    let all: Vec<f64> = orders.iter().map(hertz).chain(fixed.iter().copied()).collect();
    let in_band = |f: f64| (LOWEST_BIN * bin..=HIGHEST_SHARE * record.rate).contains(&f);
    let nearest = |index: usize, upto: usize| {
        let others = all.iter().take(upto).enumerate().filter(|(k, f)| *k != index && in_band(**f));
        others.map(|(_, f)| (f - all[index]).abs() / bin).fold(f64::INFINITY, f64::min)
    };
    (0..all.len())
        .map(|index| {
            let inside = in_band(all[index]);
            let column = inside && nearest(index, index) >= SAME;
            [column, column && nearest(index, all.len()) >= RESOLVED]
        })
        .collect()
}

/// Fits the lines of a record: harmonic numbers `orders`, and lines at `fixed` frequencies, Hz, which are
/// only taken out.
pub(super) fn lines(
    record: &Record,
    rotation: &Rotation,
    orders: &[f64],
    fixed: &[f64],
    transforms: &mut Transforms,
) -> Option<Lines> {
    let (length, rate) = (record.length(), record.rate);
    let window = transforms.window(length, rate);
    let usable = usable(orders, fixed, record, rotation);
    let all = orders.iter().map(|order| Some(*order)).chain(fixed.iter().map(|_| None));
    let mut columns: Vec<Vec<f64>> = vec![vec![1.0; length], window.time.clone()];
    let mut place = vec![None; usable.len()];
    for (index, order) in all.enumerate().filter(|(index, _)| usable[*index][0]) {
        let wave = match order {
            Some(order) => rotation.phases(order, length, rate),
            None => phases([0.0, TAU * fixed[index - orders.len()], 0.0], length, rate),
        };
        place[index] = Some(columns.len());
        columns.push(wave.iter().map(|e| e.re).collect());
        columns.push(wave.iter().map(|e| -e.im).collect());
    }
    let solved = solve(&columns, &window, record)?;
    let resolution = rate / float(length);
    let hertz = |index: usize| match orders.get(index) {
        Some(order) => order * rotation.speed.abs() / TAU,
        None => fixed[index - orders.len()],
    };
    let taken: Vec<f64> = (0..place.len()).filter(|k| place[*k].is_some()).map(hertz).collect();
    let clear: Vec<bool> = (0..=length / 2)
        .map(|bin| {
            let f = float(bin) * resolution;
            bin >= 3
                && 2 * bin < length
                && taken.iter().all(|line| (f - line).abs() > CLEAR * resolution)
        })
        .collect();
    let transform = transforms.plan(length);
    let transformed = solved.residuals.each_ref().map(|residual| {
        let mut tapered: Vec<f64> =
            residual.iter().zip(&window.weight).map(|(r, w)| r * w).collect();
        let mut spectrum = transform.make_output_vec();
        // Lengths are those of the plan: it cannot fail.
        let _ = transform.process(&mut tapered, &mut spectrum);
        spectrum
    });
    let density = |value: &Complex<f64>| 2.0 * value.norm_sqr() / (rate * window.ww);
    let spectra =
        transformed.each_ref().map(|spectrum| spectrum.iter().map(density).collect::<Vec<_>>());
    let mut noise_bins = vec![0.0; orders.len()];
    let mut found = Vec::with_capacity(orders.len());
    for index in 0..orders.len() {
        let bins = beside(hertz(index) / resolution, &clear);
        let place = place[index].filter(|_| usable[index][1] && bins.len() >= NOISE_BINS_MIN);
        noise_bins[index] = INDEPENDENT * float(bins.len());
        found.push(place.map(|place| {
            let noise = shared(&bins, &transformed, &window);
            let channels = std::array::from_fn(|channel| {
                let amplitude = solved.amplitudes[channel][place];
                let waves = [&columns[place], &columns[place + 1]];
                line(
                    amplitude,
                    waves,
                    &solved.residuals[channel],
                    &window,
                    noise[channel][channel].re,
                )
            });
            LineSet { channels, noise }
        }));
    }
    Some(Lines { sets: found, spectra, clear, bin: resolution, segments: 1.0, noise_bins })
}

/// Bins beside a line that show its noise, as many on either side.
fn beside(line: f64, clear: &[bool]) -> Vec<usize> {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a bin of the record"
    )]
    let middle = line.max(0.0).round() as usize;
    let good = |bin: &usize| clear.get(*bin).copied().unwrap_or(false);
    let above: Vec<usize> = (middle + 1..=middle + NOISE_BINS).filter(good).collect();
    let below: Vec<usize> =
        (middle.saturating_sub(NOISE_BINS)..middle).rev().filter(good).collect();
    let each = above.len().min(below.len());
    let each = if each < NOISE_BINS_MIN { above.len().max(below.len()) } else { each };
    above.into_iter().take(each).chain(below.into_iter().take(each)).collect()
}

/// `E[dA_a conj(dA_b)]` by the residuals in some bins.
fn shared(
    bins: &[usize],
    transformed: &[Vec<Complex<f64>>; CHANNELS],
    window: &Window,
) -> [[Complex<f64>; CHANNELS]; CHANNELS] {
    let mut noise = [[Complex::new(0.0, 0.0); CHANNELS]; CHANNELS];
    let scale = 4.0 / (window.w * window.w * float(bins.len()));
    for a in 0..CHANNELS {
        for b in 0..=a {
            let products =
                bins.iter().map(|bin| transformed[a][*bin] * transformed[b][*bin].conj());
            let mean = products.fold(Complex::new(0.0, 0.0), |sum, value| sum + value) * scale;
            noise[a][b] = mean;
            noise[b][a] = mean.conj();
        }
    }
    noise
}

/// The numbers of one line in one channel, with the noise `E|dA|²` beside it.
fn line(
    amplitude: Complex<f64>,
    [cosine, minus_sine]: [&Vec<f64>; 2],
    residual: &[f64],
    window: &Window,
    noise: f64,
) -> Line {
    let variance = noise * window.w * window.w / (4.0 * window.ww);
    let mean = window.wtt / window.w;
    let (mut slope, mut bend) = (0.0, 0.0);
    let (mut curve, mut curve_noise) = (0.0, 0.0);
    let samples = cosine.iter().zip(minus_sine).zip(residual);
    for ((sample, w), t) in samples.zip(&window.weight).zip(&window.time) {
        let ((c, s), r) = sample;
        // d/d phase of Re(A e) is -Im(A e), with e = c - i s here.
        let quadrature = amplitude.re * s - amplitude.im * c;
        let square = t * t - mean;
        slope += w * t * r * quadrature;
        bend += 0.5 * w * square * r * quadrature;
        curve += 0.25 * w * square * square;
        curve_noise += 0.25 * w * w * square * square;
    }
    let half = 0.5 * amplitude.norm_sqr();
    Line {
        amplitude,
        noise,
        step: slope / (half * window.wtt),
        step_variance: variance * window.wwtt / (half * window.wtt * window.wtt),
        bend: bend / (half * curve),
        bend_variance: variance * curve_noise / (half * curve * curve),
    }
}

struct Solved {
    /// By channel and first column of a line.
    amplitudes: [Vec<Complex<f64>>; CHANNELS],
    residuals: [Vec<f64>; CHANNELS],
}

/// Weighted least squares of every channel by the columns; none where they depend on each other.
fn solve(columns: &[Vec<f64>], window: &Window, record: &Record) -> Option<Solved> {
    let count = columns.len();
    let mut normal = DMatrix::zeros(count, count);
    let mut weighted = vec![0.0; record.length()];
    let mut right = vec![DVector::zeros(count); CHANNELS];
    for (i, column) in columns.iter().enumerate() {
        for ((out, c), w) in weighted.iter_mut().zip(column).zip(&window.weight) {
            *out = c * w;
        }
        for (j, other) in columns.iter().enumerate().take(i + 1) {
            let value = dot(&weighted, other);
            normal[(i, j)] = value;
            normal[(j, i)] = value;
        }
        for (channel, right) in record.channels.iter().zip(&mut right) {
            right[i] = dot(&weighted, channel);
        }
    }
    // The trend in s is of another size than the waves.
    let scale: Vec<f64> = (0..count).map(|i| 1.0 / normal[(i, i)].sqrt()).collect();
    let scaled = DMatrix::from_fn(count, count, |i, j| normal[(i, j)] * scale[i] * scale[j]);
    let factor = scaled.cholesky()?;
    let mut amplitudes: [Vec<Complex<f64>>; CHANNELS] = Default::default();
    let mut residuals: [Vec<f64>; CHANNELS] = record.channels.clone();
    for (channel, right) in right.into_iter().enumerate() {
        let b = DVector::from_fn(count, |i, _| right[i] * scale[i]);
        let solution = factor.solve(&b);
        let solution: Vec<f64> = solution.iter().zip(&scale).map(|(x, s)| x * s).collect();
        for (value, column) in solution.iter().zip(columns) {
            for (r, c) in residuals[channel].iter_mut().zip(column) {
                *r -= value * c;
            }
        }
        let next = solution.iter().skip(1).chain([&0.0]);
        amplitudes[channel] =
            solution.iter().zip(next).map(|(re, im)| Complex::new(*re, *im)).collect();
    }
    Some(Solved { amplitudes, residuals })
}

/// Four sums side by side, so that a processor adds four at once; the order is the same everywhere.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let (a4, b4) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest: f64 = a4.remainder().iter().zip(b4.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in a4.zip(b4) {
        for k in 0..4 {
            sums[k] += a[k] * b[k];
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

#[expect(clippy::cast_precision_loss, reason = "at most SAMPLES_MAX")]
pub(super) fn float(count: usize) -> f64 {
    count as f64
}

#[cfg(test)]
mod tests;
