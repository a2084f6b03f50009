//! When a profile passes the limit of its motor: there the torque has a kink, and a step ends.
//!
//! Straight pieces are listed once, by [`straight`]; a sine or a chirp passes its limit as often as
//! it likes, so [`next`] finds one time after another.

use std::f64::consts::TAU;

use crate::scenario::{Interpolation, Profile};

/// Adds the times at which a piecewise linear profile passes the limit.
pub(super) fn straight(profile: &Profile, limit: f64, ends: &mut Vec<f64>) {
    let mut piece = |[from, to]: [f64; 2], [first, last]: [f64; 2]| {
        for bound in [-limit, limit] {
            if (first - bound) * (last - bound) < 0.0 {
                ends.push(from + (to - from) * ((bound - first) / (last - first)));
            }
        }
    };
    match profile {
        Profile::Ramp { between, values } => piece(*between, *values),
        Profile::Table(table) if table.interpolation == Interpolation::Linear => {
            for (times, values) in table.times.windows(2).zip(table.values.windows(2)) {
                piece([times[0], times[1]], [values[0], values[1]]);
            }
        }
        Profile::During { profile, .. } => straight(profile, limit, ends),
        _ => {}
    }
}

/// A time this share of a period after another is another.
const APART: f64 = 1e-9;

/// The next time at which a sine or a chirp passes the limit, if it does; none of other profiles.
pub(super) fn next(profile: &Profile, limit: f64, time: f64) -> Option<f64> {
    match profile {
        Profile::Sine { mean, amplitude, frequency, phase } if *frequency > 0.0 => {
            let shift = phase / TAU;
            let cycles = next_cycles(*mean, *amplitude, limit, frequency * time + shift)?;
            Some((cycles - shift) / frequency)
        }
        Profile::Chirp { amplitude, between: [start, end], frequencies: [first, last] } => {
            let (from, sweep) = ((time - start).max(0.0), (last - first) / (end - start));
            let cycles = next_cycles(0.0, *amplitude, limit, (first + 0.5 * sweep * from) * from)?;
            // The earlier root of 0.5 sweep t^2 + first t = cycles.
            let root = (first * first + 2.0 * sweep * cycles).sqrt();
            let found = start + 2.0 * cycles / (first + root);
            (found < *end).then_some(found)
        }
        Profile::During { between: [start, end], profile } => {
            next(profile, limit, time.max(*start)).filter(|found| found < end)
        }
        _ => None,
    }
}

/// The next phase, in turns, at which `mean + amplitude sin` passes a limit.
fn next_cycles(mean: f64, amplitude: f64, limit: f64, cycles: f64) -> Option<f64> {
    let passes = [-limit, limit].into_iter().map(|bound| (bound - mean) / amplitude);
    passes
        .filter(|sine| sine.abs() < 1.0)
        .flat_map(|sine| {
            let rising = sine.asin() / TAU;
            [rising, 0.5 - rising]
        })
        .map(|turn| turn + (cycles + APART - turn).ceil())
        .min_by(f64::total_cmp)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each time found is after the one before, has the limit's value, and none is left out.
    fn check(profile: &Profile, limit: f64, end: f64) -> usize {
        let mut count = 0;
        let mut time = 0.0;
        let inside = |time: f64| profile.at(time, false).abs() < limit;
        while let Some(found) = next(profile, limit, time).filter(|found| *found < end) {
            assert!(found > time, "{found} after {time}");
            assert!(
                (profile.at(found, false).abs() - limit).abs() < 1e-9,
                "{profile:?} at {found}"
            );
            let between = (1..100).map(|k| time + (found - time) * (f64::from(k) / 100.0));
            let sides: Vec<_> = between.map(inside).collect();
            assert!(sides.windows(2).all(|pair| pair[0] == pair[1]), "{time} to {found}");
            (time, count) = (found, count + 1);
        }
        count
    }

    #[test]
    fn a_sine_passes_its_limit_four_times_a_period_or_two() {
        let sine = |mean: f64| Profile::Sine { mean, amplitude: 2.0, frequency: 3.0, phase: 0.7 };
        assert_eq!(check(&sine(0.0), 1.5, 10.0), 120);
        assert_eq!(check(&sine(1.0), 1.5, 10.0), 60);
        assert_eq!(next(&sine(0.0), 2.5, 0.0), None);
        let during = Profile::During { between: [1.0, 2.0], profile: Box::new(sine(0.0)) };
        let (first, none) = (next(&during, 1.5, 0.0), next(&during, 1.5, 2.0));
        assert!(first.is_some_and(|first| (1.0..1.1).contains(&first)) && none.is_none());
    }

    #[test]
    fn a_chirp_passes_its_limit_faster_and_faster_or_slower_and_slower() {
        // Cycles are 2 s times the sum of both frequencies; each has four passes.
        for (frequencies, passes) in
            [([1.0, 5.0], 48), ([5.0, 1.0], 48), ([0.0, 3.0], 24), ([4.0, 0.0], 32)]
        {
            let chirp = Profile::Chirp { amplitude: 1.0, between: [0.5, 4.5], frequencies };
            assert_eq!(check(&chirp, 0.6, 10.0), passes, "{frequencies:?}");
        }
    }
}
