//! [`Profile`]: a quantity as a function of time.
//!
//! A profile is piecewise smooth: [`Profile::breaks`] lists the times at which it, or its first
//! derivative, jumps. A run places the end of a step on each, so no step spans one.

use std::cmp::Ordering;
use std::f64::consts::TAU;

/// A number as a function of the time since the start of the run, s.
#[derive(Clone, Debug, PartialEq)]
pub enum Profile {
    /// The same at any time.
    Constant(f64),
    /// `before`, and from `at` on `after`.
    Step {
        /// When it jumps, s.
        at: f64,
        /// Until then.
        before: f64,
        /// From then on.
        after: f64,
    },
    /// Linear between two times, constant outside.
    Ramp {
        /// Start and end, s.
        between: [f64; 2],
        /// Value at both.
        values: [f64; 2],
    },
    /// `mean + amplitude sin(2 pi frequency t + phase)`.
    Sine {
        /// Mean.
        mean: f64,
        /// Amplitude.
        amplitude: f64,
        /// Hz.
        frequency: f64,
        /// rad.
        phase: f64,
    },
    /// A sine whose frequency changes linearly between two times; zero outside.
    Chirp {
        /// Amplitude.
        amplitude: f64,
        /// Start and end, s.
        between: [f64; 2],
        /// Frequency at both, Hz.
        frequencies: [f64; 2],
    },
    /// Values at times.
    Table(Table),
    /// Another profile between two times, zero outside.
    During {
        /// Start and end, s.
        between: [f64; 2],
        /// The profile.
        profile: Box<Profile>,
    },
}

/// Values at times; before the first and after the last the nearest value holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Times, s, each above the one before.
    pub times: Vec<f64>,
    /// As many values.
    pub values: Vec<f64>,
    /// What holds between two times.
    pub interpolation: Interpolation,
}

/// What holds between two times of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// The value of the earlier one.
    Hold,
    /// The straight line.
    Linear,
}

/// A jump that is smaller than this part of the largest value is rounding.
const JUMP_MAX: f64 = 1e-9;

/// Why a profile has no derivative that is a profile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoDerivative {
    /// It jumps.
    Jump {
        /// When, s.
        time: f64,
        /// Its value before.
        before: f64,
        /// Its value after.
        after: f64,
    },
    /// It is a chirp.
    Chirp,
}

impl Profile {
    /// Zero at any time.
    pub const ZERO: Self = Self::Constant(0.0);

    /// Whether it is zero at any time.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        matches!(self, Self::Constant(value) if *value == 0.0)
    }

    /// Whether it is the same at any time.
    #[must_use]
    pub fn is_constant(&self) -> bool {
        matches!(self, Self::Constant(_))
    }

    /// Its value at a time; at a jump the value after it.
    ///
    /// `from_below` takes the value before a jump at exactly this time: that of a step which ends
    /// there.
    #[must_use]
    pub fn at(&self, time: f64, from_below: bool) -> f64 {
        let reached = |edge: f64| if from_below { time > edge } else { time >= edge };
        match self {
            Self::Constant(value) => *value,
            Self::Step { at, before, after } => {
                if reached(*at) {
                    *after
                } else {
                    *before
                }
            }
            Self::Ramp { between: [start, end], values: [first, last] } => {
                let share = ((time - start) / (end - start)).clamp(0.0, 1.0);
                first + share * (last - first)
            }
            Self::Sine { mean, amplitude, frequency, phase } => {
                mean + amplitude
                    * precess_dynamics::Angle::sin_cos(TAU * frequency * time + phase).0
            }
            Self::Chirp { amplitude, between: [start, end], frequencies: [first, last] } => {
                if !reached(*start) || reached(*end) {
                    return 0.0;
                }
                let t = time - start;
                let cycles = first * t + 0.5 * (last - first) / (end - start) * t * t;
                amplitude * precess_dynamics::Angle::sin_cos(TAU * cycles).0
            }
            Self::Table(table) => table.at(time, from_below),
            Self::During { between: [start, end], profile } => {
                if reached(*start) && !reached(*end) { profile.at(time, from_below) } else { 0.0 }
            }
        }
    }

    /// The highest frequency with which it oscillates, Hz; zero of one that does not.
    pub(crate) fn highest_frequency(&self) -> f64 {
        match self {
            Self::Sine { frequency, .. } => frequency.abs(),
            Self::Chirp { frequencies: [first, last], .. } => first.abs().max(last.abs()),
            Self::During { profile, .. } => profile.highest_frequency(),
            Self::Constant(_) | Self::Step { .. } | Self::Ramp { .. } | Self::Table(_) => 0.0,
        }
    }

    /// Its derivative by time from the start of the run on.
    ///
    /// # Errors
    ///
    /// It jumps, or is a chirp, whose derivative is no profile.
    pub fn derivative(&self) -> Result<Self, NoDerivative> {
        let jump = |time: &f64| {
            let [before, after] = [true, false].map(|from_below| self.at(*time, from_below));
            (*time > 0.0 && (after - before).abs() > JUMP_MAX * self.size())
                .then_some(NoDerivative::Jump { time: *time, before, after })
        };
        let mut breaks = self.breaks();
        breaks.sort_by(f64::total_cmp);
        if let Some(jump) = breaks.iter().find_map(jump) {
            return Err(jump);
        }
        Ok(match self {
            Self::Constant(_) | Self::Step { .. } => Self::ZERO,
            Self::Ramp { between: [start, end], values: [first, last] } => {
                let slope = Self::Constant((last - first) / (end - start));
                Self::During { between: [*start, *end], profile: Box::new(slope) }
            }
            Self::Sine { amplitude, frequency, phase, .. } => {
                let amplitude = amplitude * TAU * frequency;
                let phase = phase + 0.25 * TAU;
                Self::Sine { mean: 0.0, amplitude, frequency: *frequency, phase }
            }
            Self::Chirp { .. } => return Err(NoDerivative::Chirp),
            Self::Table(table) => table.slopes(),
            Self::During { between, profile } => {
                let profile = Box::new(profile.derivative()?);
                Self::During { between: *between, profile }
            }
        })
    }

    /// A bound of its magnitude at any time.
    #[must_use]
    pub fn bound(&self) -> f64 {
        match self {
            Self::Sine { mean, amplitude, .. } => mean.abs() + amplitude.abs(),
            Self::During { profile, .. } => profile.bound(),
            other => other.size(),
        }
    }

    /// The largest magnitude of its numbers: a jump is judged by it.
    fn size(&self) -> f64 {
        let largest = |of: &[f64]| of.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        match self {
            Self::Constant(value) => value.abs(),
            Self::Step { before, after, .. } => largest(&[*before, *after]),
            Self::Ramp { values, .. } => largest(values),
            Self::Sine { mean, amplitude, .. } => largest(&[*mean, *amplitude]),
            Self::Chirp { amplitude, .. } => amplitude.abs(),
            Self::Table(table) => largest(&table.values),
            Self::During { profile, .. } => profile.size(),
        }
    }

    /// What is wrong with it: an interval that does not end after it starts, a table that is not
    /// sorted by time, a number that is not finite.
    #[must_use]
    pub fn fault(&self) -> Option<String> {
        let interval = |[start, end]: &[f64; 2]| {
            let message =
                || format!("an interval from {start} s to {end} s does not end after it starts");
            (start.partial_cmp(end) != Some(Ordering::Less)).then(message)
        };
        let finite = |numbers: &[f64]| {
            let bad = numbers.iter().find(|number| !number.is_finite());
            bad.map(|number| format!("{number} is not finite; give a number"))
        };
        match self {
            Self::Constant(value) => finite(&[*value]),
            Self::Step { at, before, after } => finite(&[*at, *before, *after]),
            Self::Ramp { between, values } => interval(between).or_else(|| finite(values)),
            Self::Sine { mean, amplitude, frequency, phase } => {
                finite(&[*mean, *amplitude, *frequency, *phase])
            }
            Self::Chirp { amplitude, between, frequencies } => {
                interval(between).or_else(|| finite(&[*amplitude])).or_else(|| finite(frequencies))
            }
            Self::Table(table) => table.fault(),
            Self::During { between, profile } => interval(between).or_else(|| profile.fault()),
        }
    }

    /// The times at which it or its slope jumps, in no order.
    #[must_use]
    pub fn breaks(&self) -> Vec<f64> {
        match self {
            Self::Constant(_) | Self::Sine { .. } => Vec::new(),
            Self::Step { at, .. } => vec![*at],
            Self::Ramp { between, .. } | Self::Chirp { between, .. } => between.to_vec(),
            Self::Table(table) => table.times.clone(),
            Self::During { between, profile } => {
                let mut breaks = profile.breaks();
                breaks.extend(between);
                breaks
            }
        }
    }
}

impl Table {
    fn fault(&self) -> Option<String> {
        let Self { times, values, .. } = self;
        if times.is_empty() || times.len() != values.len() {
            return Some(format!("a table of {} times and {} values", times.len(), values.len()));
        }
        if let Some(bad) = times.iter().chain(values).find(|number| !number.is_finite()) {
            return Some(format!("{bad} in a table is not finite; give a number"));
        }
        let pair = times.windows(2).find(|pair| pair[0] >= pair[1])?;
        Some(format!("time {} s of a table does not come after {} s", pair[1], pair[0]))
    }

    /// The slopes between its times, zero outside; the table has no jump.
    fn slopes(&self) -> Profile {
        let pairs = self.times.windows(2).zip(self.values.windows(2));
        let slope = |(t, v): (&[f64], &[f64])| (v[1] - v[0]) / (t[1] - t[0]);
        let values: Vec<f64> = match self.interpolation {
            Interpolation::Hold => Vec::new(),
            Interpolation::Linear => pairs.map(slope).collect(),
        };
        let (Some(first), Some(last), false) =
            (self.times.first(), self.times.last(), values.is_empty())
        else {
            return Profile::ZERO;
        };
        let times = self.times.iter().take(values.len()).copied().collect();
        let table = Self { times, values, interpolation: Interpolation::Hold };
        let profile = Box::new(Profile::Table(table));
        Profile::During { between: [*first, *last], profile }
    }

    fn at(&self, time: f64, from_below: bool) -> f64 {
        let after = if from_below {
            self.times.partition_point(|t| *t < time)
        } else {
            self.times.partition_point(|t| *t <= time)
        };
        let value = |index: usize| self.values.get(index).copied().unwrap_or(0.0);
        let time_of = |index: usize| self.times.get(index).copied().unwrap_or(0.0);
        let Some(before) = after.checked_sub(1) else { return value(0) };
        if after >= self.times.len() || self.interpolation == Interpolation::Hold {
            return value(before);
        }
        let share = (time - time_of(before)) / (time_of(after) - time_of(before));
        value(before) + share * (value(after) - value(before))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_jump_has_two_sides() {
        let step = Profile::Step { at: 2.0, before: 1.0, after: 5.0 };
        assert_eq!([step.at(1.0, false), step.at(2.0, true), step.at(2.0, false)], [1.0, 1.0, 5.0]);
        let times = vec![0.0, 1.0, 3.0];
        let held = Table { times, values: vec![1.0, 2.0, 4.0], interpolation: Interpolation::Hold };
        let linear = Table { interpolation: Interpolation::Linear, ..held.clone() };
        assert_eq!([held.at(1.0, true), held.at(1.0, false), held.at(9.0, false)], [1.0, 2.0, 4.0]);
        assert_eq!([linear.at(-1.0, false), linear.at(2.0, false)], [1.0, 3.0]);
        assert_eq!(linear.at(1.0, true), 2.0);
    }

    #[test]
    fn a_derivative_is_that_of_differences() {
        let times = vec![-1.0, 1.0, 3.0, 3.5];
        let values = vec![1.0, 2.0, 4.0, 0.5];
        let sine = Profile::Sine { mean: 2.0, amplitude: 3.0, frequency: 0.5, phase: 0.3 };
        let whole = Profile::Sine { mean: 0.0, amplitude: 3.0, frequency: 0.5, phase: 0.0 };
        for profile in [
            Profile::Constant(2.0),
            Profile::Step { at: 0.0, before: 1.0, after: 5.0 },
            Profile::Ramp { between: [0.5, 2.5], values: [1.0, -3.0] },
            Profile::Table(Table { times, values, interpolation: Interpolation::Linear }),
            Profile::During { between: [0.0, 4.0], profile: Box::new(whole) },
            sine,
        ] {
            let derivative = profile.derivative().expect("it has no jump");
            for k in 0..50 {
                let (time, h) = (0.013 + 0.1 * f64::from(k), 1e-6);
                let difference = profile.at(time + h, false) - profile.at(time - h, false);
                let found = derivative.at(time, false);
                assert!((found - difference / (2.0 * h)).abs() < 1e-7, "{profile:?} at {time}");
            }
        }
    }

    #[test]
    fn a_jump_has_no_derivative_and_is_named_with_its_time() {
        let held = Table {
            times: vec![0.0, 2.0],
            values: vec![1.0, 3.0],
            interpolation: Interpolation::Hold,
        };
        let jump = |time, before, after| Err(NoDerivative::Jump { time, before, after });
        assert_eq!(Profile::Table(held).derivative(), jump(2.0, 1.0, 3.0));
        let step = Profile::Step { at: 1.0, before: 0.0, after: 5.0 };
        assert_eq!(step.derivative(), jump(1.0, 0.0, 5.0));
        // The slope of a ramp jumps at both of its ends.
        let ramp = Profile::Ramp { between: [0.5, 2.5], values: [1.0, 5.0] };
        let slope = ramp.derivative().expect("a ramp has no jump");
        assert_eq!(slope.derivative(), jump(0.5, 0.0, 2.0));
        let chirp = Profile::Chirp { amplitude: 1.0, between: [1.0, 3.0], frequencies: [2.0, 4.0] };
        assert_eq!(chirp.derivative(), Err(NoDerivative::Chirp));
    }

    #[test]
    fn a_chirp_has_its_frequencies_at_both_ends() {
        let chirp = Profile::Chirp { amplitude: 1.0, between: [1.0, 3.0], frequencies: [2.0, 4.0] };
        // Six cycles in two seconds; a small step after the start the phase is that of 2 Hz.
        let early = chirp.at(1.0 + 1e-6, false);
        assert!((early - (TAU * 2.0 * 1e-6)).abs() < 1e-9);
        assert_eq!(chirp.at(3.0, false), 0.0);
        assert!(chirp.at(3.0, true).abs() < 1e-12);
    }
}
