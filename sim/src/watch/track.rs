//! [`Track`]: readings of one sensor over the time; their mean over an interval that has no reading inside.
//!
//! Between two readings it is that of the cubic through these and their neighbours, where their times are about even, else that of a straight line:
//! of a line at a frequency below a fifth of the sampling rate the cubic's integral is right to 4 %, at a tenth to 0.3 %. Outside of the readings the nearest one is held.
//! The reading of an integrating gyro is the mean since the one before. Two readings from an interval on are required; what is older
//! than three readings is forgotten.

use std::collections::VecDeque;
use std::f64::consts::TAU;

use nalgebra::{Complex, Vector3};

/// The nodes of Gauss's rule of two points, by half of the interval: exact for a cubic.
const NODE: f64 = 0.577_350_269_189_625_8;

/// Times whose intervals differ by more than this factor are not even.
const EVEN: f64 = 2.0;

/// Readings from a time on that its interval requires.
const AHEAD: usize = 2;

/// What a reading is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// The value at its time.
    Sample,
    /// The mean since the reading before.
    Mean,
    /// An angle at its time, which may be off by turns.
    Angle,
}

/// Readings of a sensor.
#[derive(Clone, Debug)]
pub(super) struct Track {
    kind: Kind,
    readings: VecDeque<(f64, Vector3<f64>)>,
}

impl Track {
    pub(super) fn new(kind: Kind) -> Self {
        Self { kind, readings: VecDeque::new() }
    }

    /// Takes a reading. Times rise.
    pub(super) fn add(&mut self, time: f64, [x, y, z, _]: [f64; 4]) {
        let mut value = Vector3::new(x, y, z);
        if let (Kind::Angle, Some((_, before))) = (self.kind, self.readings.back()) {
            value.x -= TAU * ((value.x - before.x) / TAU).round();
        }
        self.readings.push_back((time, value));
    }

    /// Whether there are enough readings from this time on.
    pub(super) fn reaches(&self, time: f64) -> bool {
        let nth = self.readings.len().checked_sub(AHEAD);
        nth.and_then(|nth| self.readings.get(nth)).is_some_and(|(of, _)| *of >= time)
    }

    /// Forgets what is before a time.
    pub(super) fn forget(&mut self, time: f64) {
        self.readings.retain(|(of, _)| *of >= time);
    }

    /// The mean over an interval without a reading inside; of an empty one the value. None before the first reading.
    pub(super) fn mean(&mut self, [from, to]: [f64; 2]) -> Option<Vector3<f64>> {
        // One reading before the interval's first is left.
        while self.readings.get(2).is_some_and(|(time, _)| *time <= from) {
            self.readings.pop_front();
        }
        let at = |index: usize| self.readings.get(index).copied();
        let first = usize::from(at(1).is_some_and(|(time, _)| time <= from));
        let (start, value) = at(first)?;
        let next = at(first + 1).filter(|_| start <= from);
        let Some((end, after)) = next else { return Some(value) };
        if self.kind == Kind::Mean {
            return Some(if to > from { after } else { value });
        }
        let length = end - start;
        let even = |of: f64| (length / EVEN..=length * EVEN).contains(&of);
        let before = first.checked_sub(1).and_then(at).filter(|(time, _)| even(start - time));
        let last = at(first + 2).filter(|(time, _)| even(time - end));
        let of = |time: f64| match (before, last) {
            (Some(before), Some(last)) => {
                cubic(&[before, (start, value), (end, after), last], time)
            }
            _ => value.lerp(&after, (time - start) / length),
        };
        let (middle, half) = (f64::midpoint(from, to), 0.5 * (to - from));
        Some((of(middle - NODE * half) + of(middle + NODE * half)) * 0.5)
    }

    /// By how much more the integral of means over even intervals grows from reading to reading than that of the readings before, of a line that turns by this angle,
    /// as a complex number, from reading to reading.
    pub(super) fn weight(&self, turn: Complex<f64>) -> Complex<f64> {
        match self.kind {
            Kind::Mean => turn,
            Kind::Sample | Kind::Angle => (-turn.conj() + 13.0 + turn * 13.0 - turn * turn) / 24.0,
        }
    }
}

/// The cubic through four values, by Lagrange.
fn cubic(nodes: &[(f64, Vector3<f64>); 4], time: f64) -> Vector3<f64> {
    let share = |own: f64| -> f64 {
        let others = nodes.iter().filter(|(of, _)| of.to_bits() != own.to_bits());
        others.map(|(other, _)| (time - other) / (own - other)).product()
    };
    nodes.iter().map(|(own, value)| value * share(*own)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of a cubic, at times that are not even, means over any intervals are those of its integral.
    #[test]
    fn means_of_a_cubic_are_exact() {
        let of = |t: f64| 2.0 - t + 0.5 * t * t - 0.25 * t * t * t;
        let integral = |t: f64| 2.0 * t - t * t / 2.0 + t * t * t / 6.0 - t.powi(4) / 16.0;
        let mut track = Track::new(Kind::Sample);
        for time in [0.0, 1.0, 1.9, 3.0, 4.2] {
            track.add(time, [of(time), 0.0, 0.0, 0.0]);
        }
        for (from, to) in [(1.0, 1.5), (1.5, 1.9), (1.9, 2.0), (2.0, 3.0)] {
            let expected = (integral(to) - integral(from)) / (to - from);
            let found = track.mean([from, to]).expect("readings").x;
            assert!((found - expected).abs() < 1e-13, "{from} to {to}: {found}, {expected}");
        }
        // A straight line where there is no reading after the next one.
        let found = track.mean([3.0, 4.2]).expect("readings").x;
        assert!((found - f64::midpoint(of(3.0), of(4.2))).abs() < 1e-13, "{found}");
        assert_eq!(track.mean([4.2, 5.0]).map(|of| of.x), Some(of(4.2)));
    }

    /// Of a line sampled at even times the integral of means is that of the readings before, times the weight.
    #[test]
    fn the_weight_of_a_line_is_that_of_its_means() {
        for kind in [Kind::Sample, Kind::Mean] {
            let (mut track, turn) = (Track::new(kind), 0.7_f64);
            let of = |k: u32| libm::cos(turn * f64::from(k));
            for k in 0..6 {
                track.add(f64::from(k), [of(k), 0.0, 0.0, 0.0]);
            }
            let line = Complex::new(libm::cos(turn), libm::sin(turn));
            for k in 1..4 {
                let found = track.mean([f64::from(k), f64::from(k + 1)]).expect("readings").x;
                let expected = (track.weight(line) * line.powu(k)).re;
                assert!((found - expected).abs() < 1e-14, "{kind:?} {k}: {found}, {expected}");
            }
        }
    }

    /// An angle that is read within a turn goes on over its end.
    #[test]
    fn an_angle_goes_on_over_a_turn() {
        let mut track = Track::new(Kind::Angle);
        for (time, angle) in [(0.0, 3.0), (1.0, 3.1), (2.0, 3.2 - TAU), (3.0, 3.3 - TAU)] {
            track.add(time, [angle, 0.0, 0.0, 0.0]);
        }
        let found = track.mean([1.0, 2.0]).expect("readings").x;
        assert!((found - 3.15).abs() < 1e-12, "{found}");
        assert!(track.reaches(2.0) && !track.reaches(2.5));
    }
}
