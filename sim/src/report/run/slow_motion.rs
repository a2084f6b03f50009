//! [`Turns`]: the frames of a few turns of the fastest wheel, and by how much the hub's deviation
//! from steady turning is magnified when they are shown.
//!
//! Frames lie as far apart as samples allow with 20 or more for each turn, so at most 44; where the
//! sampling rate does not resolve a turn that finely there are none. The turns are the last ones of
//! the run, or, where the wheel then is slower, those at which it was fastest.

use std::collections::VecDeque;

use nalgebra::Vector3;
use precess_control::rotation::{from_vector, inverse, product, to_vector};
use precess_dynamics::Quaternion;

use super::replay::{COORDINATES, Frame};
use crate::report::number;

/// Frames for each turn, at least.
const PER_TURN: f64 = 20.0;
/// Frames for each turn that are aimed at: the wheel may become faster until the next one.
const AIM: f64 = 22.0;
/// Turns that are kept.
const TURNS: f64 = 5.0;
/// Turns that make a window, at least.
const TURNS_MIN: f64 = 2.0;
/// Most frames: all turns at twice the least density, and some.
const FRAMES_MAX: usize = 240;
/// A wheel below this rate is not seen to turn, rad/s.
const RATE_MIN: f64 = 1e-2;
/// The largest deviation as it is shown, rad.
const SHOWN: f64 = 0.1;
/// What is below is rounding, rad.
const DEVIATION_MIN: f64 = 1e-13;

/// Keeps frames of the latest turns, and of the fastest ones.
pub(in crate::report) struct Turns {
    /// Whether each joint is that of a wheel.
    wheels: Vec<bool>,
    /// Between two samples, s.
    spacing: f64,
    latest: VecDeque<Frame>,
    /// Rate of the fastest wheel at the last frame, rad/s.
    rate: f64,
    fastest: Vec<Frame>,
    fastest_rate: f64,
}

impl Turns {
    /// For the wheels among the joints, and so many samples in a second.
    pub(in crate::report) fn new(wheels: Vec<bool>, rate: f64) -> Self {
        Self {
            wheels,
            spacing: 1.0 / rate,
            latest: VecDeque::new(),
            rate: 0.0,
            fastest: Vec::new(),
            fastest_rate: 0.0,
        }
    }

    /// Adds a sample.
    pub(in crate::report) fn add(&mut self, frame: &Frame) {
        let rates = frame.iter().skip(COORDINATES + self.wheels.len()).zip(&self.wheels);
        let rate = rates.filter(|(_, wheel)| **wheel).map(|(r, _)| r.abs()).fold(0.0, f64::max);
        if !rate.is_finite() || rate < RATE_MIN {
            return;
        }
        let turn = std::f64::consts::TAU / rate;
        let [aim, most] = [AIM, PER_TURN].map(|frames| turn / frames * (1.0 + 1e-9));
        if self.spacing > most {
            self.latest.clear();
            return;
        }
        if let Some(last) = self.latest.back() {
            let apart = frame[0] - last[0];
            // The next sample is near enough to the last frame.
            if apart + self.spacing <= aim {
                return;
            }
            if apart > most {
                self.latest.clear();
            }
        }
        self.latest.push_back(frame.clone());
        self.rate = rate;
        let old = |first: &Frame| frame[0] - first[0] > TURNS * turn * (1.0 + 1e-9);
        while self.latest.len() > FRAMES_MAX || self.latest.front().is_some_and(old) {
            self.latest.pop_front();
        }
        if rate > 1.05 * self.fastest_rate && self.turns() > 0.98 * TURNS {
            (self.fastest, self.fastest_rate) = (self.latest.iter().cloned().collect(), rate);
        }
    }

    /// Turns that the latest frames span.
    fn turns(&self) -> f64 {
        match (self.latest.front(), self.latest.back()) {
            (Some(first), Some(last)) => (last[0] - first[0]) * self.rate / std::f64::consts::TAU,
            _ => 0.0,
        }
    }

    /// Label, frames and factor of a window; none where no turn is resolved, or where the hub turns
    /// steadily.
    pub(in crate::report) fn window(&self) -> Option<(String, Vec<Frame>, f64)> {
        let at_end = self.rate >= 0.9 * self.fastest_rate && self.turns() >= TURNS_MIN;
        let frames: Vec<Frame> =
            if at_end { self.latest.iter().cloned().collect() } else { self.fastest.clone() };
        let (first, last) = (frames.first()?, frames.last()?);
        if frames.len() < 3 || !frames.iter().flatten().all(|number| number.is_finite()) {
            return None;
        }
        let largest = largest_deviation(&frames);
        if largest < DEVIATION_MIN {
            return None;
        }
        let span = format!("{} s to {} s", number::time(first[0]), number::time(last[0]));
        Some((format!("slow motion, {span}"), frames, round_below(SHOWN / largest).max(1.0)))
    }
}

/// One, two or five times a power of ten, not above a number.
fn round_below(value: f64) -> f64 {
    let decade = 10_f64.powf(value.log10().floor());
    let fits = |n: f64| (n * decade <= value * (1.0 + 1e-9)).then_some(n * decade);
    [5.0, 2.0].into_iter().find_map(fits).unwrap_or(decade).round().max(1.0)
}

/// The largest deviation of the hub from straight motion, rad, as the page splits it off: see
/// sim/report/DATA.md.
fn largest_deviation(frames: &[Frame]) -> f64 {
    let attitude =
        |frame: &Frame| Quaternion { q0: frame[1], q1: frame[2], q2: frame[3], q3: frame[4] };
    let middle = inverse(&attitude(&frames[frames.len() / 2]));
    let turned: Vec<_> =
        frames.iter().map(|frame| to_vector(&product(&middle, &attitude(frame)))).collect();
    let times: Vec<_> = frames.iter().map(|frame| frame[0]).collect();
    let lines =
        [0, 1, 2].map(|axis| straight(&times, &turned.iter().map(|v| v[axis]).collect::<Vec<_>>()));
    let deviations = times.iter().zip(&turned).map(|(time, vector)| {
        let course = lines.map(|[mean, slope, at]| mean + slope * (time - at));
        let course = from_vector(&Vector3::from(course));
        let deviation = to_vector(&product(&inverse(&course), &from_vector(vector)));
        deviation.iter().map(|d| d * d).sum::<f64>().sqrt()
    });
    deviations.fold(0.0, f64::max)
}

/// The line that fits best by weighted least squares: value at a time, slope, that time.
fn straight(times: &[f64], values: &[f64]) -> [f64; 3] {
    #[expect(clippy::cast_precision_loss, reason = "a few hundred frames")]
    let weight = |k: usize| {
        let sine = (std::f64::consts::PI * (k as f64 + 0.5) / times.len() as f64).sin();
        sine * sine
    };
    let sum = |of: &dyn Fn(usize) -> f64| (0..times.len()).map(|k| weight(k) * of(k)).sum::<f64>();
    let total = sum(&|_| 1.0);
    let at = sum(&|k| times[k]) / total;
    let mean = sum(&|k| values[k]) / total;
    let square = sum(&|k| (times[k] - at) * (times[k] - at));
    let both = sum(&|k| (times[k] - at) * (values[k] - mean));
    [mean, if square > 0.0 { both / square } else { 0.0 }, at]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A hub that turns steadily and vibrates once a turn of its wheel, by 1e-6 rad.
    fn frame(time: f64, spin: f64) -> Frame {
        let angle = 0.1 * time + 1e-6 * (spin * time).cos();
        let Quaternion { q0, q1, q2, q3 } = from_vector(&Vector3::new(angle, 0.0, 0.0));
        vec![time, q0, q1, q2, q3, 0.1, 0.0, 0.0, 0.0, 0.0, 0.0, spin * time, spin]
    }

    fn run(spin: f64, rate: f64) -> Turns {
        let mut turns = Turns::new(vec![true], rate);
        (0..10_000).for_each(|k| turns.add(&frame(f64::from(k) / rate, spin)));
        turns
    }

    #[test]
    fn the_last_turns_are_kept_with_twenty_frames_for_each() {
        let (label, frames, magnify) = run(50.0, 1000.0).window().expect("resolved");
        let turn = std::f64::consts::TAU / 50.0;
        assert!(frames.windows(2).all(|pair| pair[1][0] - pair[0][0] <= turn / 20.0));
        assert!(frames.len() >= 98 && frames.len() <= FRAMES_MAX, "{}", frames.len());
        assert!(frames.last().is_some_and(|last| last[0] > 9.99));
        assert_eq!((label.as_str(), magnify), ("slow motion, 9.37 s to 9.995 s", 5e4));
    }

    #[test]
    fn a_wheel_whose_rate_varies_keeps_its_last_turns() {
        let mut turns = Turns::new(vec![true], 500.0);
        (0..5000).for_each(|k| {
            let time = f64::from(k) / 500.0;
            turns.add(&frame(time, 52.36 + 0.01 * (9.0 * time).sin()));
        });
        assert!(turns.window().is_some_and(|(_, frames, _)| frames[0][0] > 9.0));
    }

    #[test]
    fn no_window_where_samples_do_not_resolve_a_turn() {
        assert!(run(50.0, 100.0).window().is_none());
    }
}
