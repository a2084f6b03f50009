//! One run: a scenario integrated by DOP853 into a history of samples and a ledger of steps.
//!
//! Attitude is integrated as a quaternion (a shadow switch of MRPs is a discontinuity to an
//! adaptive integrator). Two running integrals travel with the state: the work of everything that
//! acts on or inside the spacecraft, and the integral of sum |u * rate|, the unit in which energy
//! is judged.
//!
//! The wheel turns a hundred times in ten seconds. An angle of 600 rad is kept to 1e-13 rad only,
//! and rounding it in every step changes the sum of the momenta of wheel and hub; so every joint
//! angle is brought back by whole turns, which are counted, once it has gone round.
//!
//! Samples between two accepted steps are steps of their own, started at the last accepted state,
//! so they are as accurate as the run. The interpolant of differential-equations 0.7.0 is not: it
//! evaluates the upper half of its polynomial with the factors s and 1 - s exchanged, which at
//! tolerance 1e-13 costs five digits of momentum (8e-7 kg m/s instead of 5e-12, and 5e-12 once they
//! are corrected).

use precess_dynamics::Spacecraft;

use crate::error::RunError;
use crate::history::{History, Sample, Steps};
use crate::integrator::{Integrator, System};
use crate::ledger::{Entry, Ledger};
use crate::packing::{Packed, Turns};
use crate::scenario::Scenario;

/// How long, how finely and how densely a scenario is run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Length of the run, s.
    pub duration: f64,
    /// Relative tolerance of one step.
    pub tolerance: f64,
    /// Samples recorded per second, 1/s.
    pub rate: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self { duration: 10.0, tolerance: 1e-13, rate: RATE }
    }
}

/// Samples per second by default: sixty in a turn of Table 1's wheel.
const RATE: f64 = 500.0;
/// Fewer samples than this say nothing about a run of any length.
const SAMPLES_MIN: f64 = 2.0;
/// Shorter, and a turn of no wheel fits in; longer, and the ledger of steps outgrows memory.
const DURATION_MIN: f64 = 1e-3;
const DURATION_MAX: f64 = 1e4;
/// A history is kept in memory and written as text: 600 bytes a sample, 120 MB in all.
const SAMPLES_MAX: f64 = 2e5;
/// Tighter than a few roundings of one step, no step can be accepted.
const TOLERANCE_MIN: f64 = 1e-15;
/// Looser than this, the step no longer resolves a turn of the wheel.
const TOLERANCE_MAX: f64 = 1e-3;

impl Settings {
    /// The default sampling rate, or the nearest to it that a run of this duration allows, 1/s.
    #[must_use]
    pub fn rate_for(duration: f64) -> f64 {
        let (lowest, highest) = rates(duration);
        RATE.max(lowest).min(highest)
    }

    /// Checks every setting against its bounds.
    ///
    /// # Errors
    /// The first setting that is out of bounds, with its value and the bound.
    pub fn check(&self) -> Result<(), RunError> {
        let Self { duration, tolerance, rate } = *self;
        if !(DURATION_MIN..=DURATION_MAX).contains(&duration) {
            let (lowest, highest) = (DURATION_MIN, DURATION_MAX);
            return Err(RunError::Duration { value: duration, lowest, highest });
        }
        if !(TOLERANCE_MIN..=TOLERANCE_MAX).contains(&tolerance) {
            let (lowest, highest) = (TOLERANCE_MIN, TOLERANCE_MAX);
            return Err(RunError::Tolerance { value: tolerance, lowest, highest });
        }
        let (lowest, highest) = rates(duration);
        if !(lowest..=highest).contains(&rate) {
            return Err(RunError::Rate { value: rate, lowest, highest });
        }
        Ok(())
    }
}

/// Lowest and highest sampling rate of a run, 1/s.
fn rates(duration: f64) -> (f64, f64) {
    (SAMPLES_MIN / duration, SAMPLES_MAX / duration)
}

/// Runs a scenario.
///
/// `progress` hears the simulated time after each accepted step, s.
///
/// # Errors
/// Settings out of bounds, parameters that the solver rejects, a state that it cannot solve, or an
/// integrator that stops before the end; each names the scenario's time where it happened.
pub fn run<const N: usize>(
    scenario: &Scenario<N>,
    settings: &Settings,
    progress: &mut dyn FnMut(f64),
) -> Result<History<N>, RunError> {
    settings.check()?;
    let spacecraft =
        Spacecraft::new(&scenario.hub, &scenario.devices).map_err(RunError::Parameters)?;
    let system = System::new(spacecraft, scenario.inputs);
    let mut start = Packed::new(&scenario.state);
    let mut turns = Turns::default();
    start.wrap(&mut turns);
    let start = start.into_vec();
    let span = (0.0, settings.duration);
    let mut integrator = Integrator::new(&system, settings.tolerance, span, &start, None)?;
    let mut recorder =
        Recorder { system: &system, scenario, settings, samples: Vec::new(), entries: Vec::new() };
    recorder.record(&integrator, &turns)?;
    while !integrator.done() {
        integrator.step()?;
        recorder.record(&integrator, &turns)?;
        progress(integrator.time());
        let mut state = Packed::<N>::from_slice(integrator.state());
        if state.once_round() && !integrator.done() {
            state.wrap(&mut turns);
            integrator.restart(&state.into_vec())?;
        }
    }
    let Integrator { accepted, rejected, .. } = integrator;
    let Recorder { samples, entries, .. } = recorder;
    let steps = Steps { accepted, rejected, evaluations: system.evaluations() };
    Ok(History { samples, ledger: Ledger { entries }, steps })
}

/// Enters every accepted step into the ledger, and fills the samples within it.
struct Recorder<'a, const N: usize> {
    system: &'a System<N>,
    scenario: &'a Scenario<N>,
    settings: &'a Settings,
    samples: Vec<Sample<N>>,
    entries: Vec<Entry>,
}

impl<const N: usize> Recorder<'_, N> {
    fn record(&mut self, now: &Integrator<N>, turns: &Turns<N>) -> Result<(), RunError> {
        let entry = self.entry(now.time(), now.state())?;
        self.entries.push(entry);
        while let Some(time) = self.next_sample().filter(|&time| time <= now.time()) {
            let (state, entry) = if time == now.time() {
                (Packed::from_slice(now.state()), entry)
            } else {
                let (from, y) = now.before();
                let between = self.between(from, y, time)?;
                let entry = self.entry(time, &between)?;
                (Packed::from_slice(&between), entry)
            };
            self.samples.push(Sample { time, state: turns.unwrapped(&state.state()), entry });
        }
        Ok(())
    }

    /// The time of the sample that is next; past the last whole one there is one more, at the end.
    fn next_sample(&self) -> Option<f64> {
        #[expect(clippy::cast_precision_loss, reason = "fewer samples than 2^53")]
        let time = self.samples.len() as f64 / self.settings.rate;
        let end = self.settings.duration;
        let more = self.samples.last().is_none_or(|s| s.time < end);
        more.then_some(time.min(end))
    }

    fn entry(&self, time: f64, y: &[f64]) -> Result<Entry, RunError> {
        let packed = Packed::from_slice(y);
        Entry::new(time, &packed, self.system.spacecraft(), self.scenario)
            .map_err(|source| RunError::Solve { time, source })
    }

    /// The state at `time`, by a step of its own from the last accepted one.
    fn between(&self, from: f64, y: &Vec<f64>, time: f64) -> Result<Vec<f64>, RunError> {
        let step = Some(time - from);
        let mut integrator =
            Integrator::new(self.system, self.settings.tolerance, (from, time), y, step)?;
        while !integrator.done() {
            integrator.step()?;
        }
        Ok(integrator.state().clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::table1::{Drive, Imbalance, Variant};

    fn printed() -> Scenario<1> {
        Variant { imbalance: Imbalance::Printed, drive: Drive::Wheel200 }.scenario()
    }

    #[test]
    fn samples_come_at_the_rate_and_end_with_the_run() {
        let settings = Settings { duration: 0.105, rate: 100.0, ..Settings::default() };
        let history = run(&printed(), &settings, &mut |_| {}).expect("Table 1 runs");
        let times: Vec<_> = history.samples.iter().map(|s| s.time).collect();
        assert_eq!(times[..3], [0.0, 0.01, 0.02]);
        assert_eq!(times[10..], [0.1, 0.105]);
        let last = history.ledger.entries.last().expect("an entry");
        assert_eq!(last.time, 0.105, "no step goes past the end");
    }

    /// Two runs of one tolerance, their steps cut differently: a few of its units apart.
    const SAMPLE: f64 = 1e-11;

    #[test]
    fn samples_between_steps_lie_on_the_motion() {
        let settings = Settings { duration: 0.25, rate: 977.0, ..Settings::default() };
        let history = run(&printed(), &settings, &mut |_| {}).expect("Table 1 runs");
        let sample = history.samples[200];
        let settings = Settings { duration: sample.time, rate: 10.0, ..settings };
        let end = run(&printed(), &settings, &mut |_| {}).expect("Table 1 runs");
        let end = end.samples[end.samples.len() - 1];
        assert_eq!(end.time, sample.time);
        assert!((end.state.omega - sample.state.omega).norm() < SAMPLE);
        assert!((end.state.devices[0].theta - sample.state.devices[0].theta).abs() < SAMPLE);
        assert!(sample.state.devices[0].theta > std::f64::consts::TAU, "counted through a turn");
    }

    #[test]
    fn settings_out_of_bounds_are_rejected_with_value_bound_and_remedy() {
        let rejected = |settings: Settings| {
            let error = run(&printed(), &settings, &mut |_| {}).expect_err("out of bounds");
            error.to_string()
        };
        let default = Settings::default();
        assert_eq!(
            rejected(Settings { duration: -1.0, ..default }),
            "duration -1 s is outside 0.001 s to 10000 s; the default is 10"
        );
        assert_eq!(
            rejected(Settings { tolerance: f64::NAN, ..default }),
            "tolerance NaN is outside 1e-15 to 1e-3; the default is 1e-13"
        );
        assert_eq!(
            rejected(Settings { rate: 1e9, ..default }),
            "rate 1000000000 samples/s is outside 0.2 to 20000 for this duration; give one in \
             between"
        );
    }

    #[test]
    fn the_default_rate_suits_every_duration() {
        assert_eq!(Settings::rate_for(10.0), Settings::default().rate);
        for duration in [DURATION_MIN, 2e-3, 0.6, 399.0, 1e3, DURATION_MAX] {
            let rate = Settings::rate_for(duration);
            let settings = Settings { duration, rate, ..Settings::default() };
            assert!(settings.check().is_ok(), "{rate} samples/s in {duration} s");
        }
    }

    #[test]
    fn a_state_that_is_no_number_is_an_error_with_its_time() {
        let mut scenario = printed();
        scenario.state.omega.x = f64::NAN;
        let error = run(&scenario, &Settings::default(), &mut |_| {}).expect_err("NaN");
        assert!(matches!(error, RunError::Solve { time: 0.0, .. }), "{error}");
    }
}
