//! Runs of fixed steps with derivatives: samples of the state and its accelerations.

use precess_dynamics::JointStates as _;

use precess_craft::tangent::{Number, WIDTH};

use super::chain::ChainCraft;
use super::dual::DualCraft;
use crate::record::Header;
use crate::scenario::{IntegratorChoice, Scenario};

/// Steps of a turn of the fastest joint, where the scenario has no fixed step.
const PER_TURN: f64 = 100.0;
/// Keys up to which dual numbers are cheaper: each six of them take a run of their own, and the chain's steps are linearised
/// whatever the number of keys. Four gyros of the imaging satellite take 1.7 s by six keys over dual numbers and 3.7 s by the chain, by twelve
/// 3.6 and 5.0 s, by 14 keys 5.7 and 6.3 s.
const DUAL_MAX: usize = 2 * WIDTH;
/// Numbers that are kept, with their derivatives by six keys: 560 MB.
const NUMBERS_MAX: usize = 10_000_000;
/// Steps of a run, at most.
const STEPS_MAX: f64 = 1e8;
/// Times nearer than this share of a step are one.
const NEAR: f64 = 1e-9;

/// Samples: of each its time and a number for each column; NaN of a quantity that is not of the state.
pub(super) type Samples = Vec<(f64, Vec<Number>)>;

/// A state with its derivatives.
pub(super) trait Motion: Sized {
    /// After a step, s.
    fn after(&self, length: f64) -> Result<Self, String>;

    /// A number for each column, once for each six keys.
    fn rows(&self, header: &Header, time: f64) -> Result<Vec<Vec<Number>>, String>;
}

/// Whose derivatives a run has.
enum Method {
    /// Of the equations, by any number of keys, carried through the stages of each step.
    Chain(Box<ChainCraft>),
    /// Of dual numbers, by six keys at a time.
    Dual,
}

/// Runs a scenario with the derivatives of its numbers by keys: samples for each six keys, in order, through `each`.
pub(super) fn samples(
    scenario: &Scenario,
    header: &Header,
    slopes: &[Vec<f64>],
    each: &mut dyn FnMut(&Samples, usize) -> Result<(), String>,
) -> Result<(), String> {
    let times = Times::new(scenario)?;
    // Where an output step ends, too.
    let numbers = times.samples.saturating_mul(header.columns.len()).max(1);
    if numbers > NUMBERS_MAX {
        return Err("the run is too long to be kept with its derivatives; shorten it".to_owned());
    }
    let at_once = WIDTH * (NUMBERS_MAX / numbers);
    for slopes in slopes.chunks(at_once) {
        match method(scenario, slopes)? {
            Method::Chain(craft) => {
                let found = run(craft.start(), &times, header)?;
                for (samples, keys) in found.iter().zip(slopes.chunks(WIDTH)) {
                    each(samples, keys.len())?;
                }
            }
            Method::Dual => {
                for keys in slopes.chunks(WIDTH) {
                    let craft = DualCraft::new(scenario, keys)?;
                    for samples in run(craft.start(), &times, header)? {
                        each(&samples, keys.len())?;
                    }
                }
            }
        }
    }
    Ok(())
}

fn method(scenario: &Scenario, slopes: &[Vec<f64>]) -> Result<Method, String> {
    if slopes.len() <= DUAL_MAX {
        return Ok(Method::Dual);
    }
    let chain = ChainCraft::new(scenario, slopes)?;
    Ok(chain.map_or(Method::Dual, |craft| Method::Chain(Box::new(craft))))
}

/// When a run has steps and samples.
pub(super) struct Times {
    duration: f64,
    rate: f64,
    step: f64,
    samples: usize,
}

impl Times {
    pub(super) fn new(scenario: &Scenario) -> Result<Self, String> {
        let (duration, rate) = (scenario.settings.duration, scenario.output.rate);
        let step = match scenario.settings.integrator {
            IntegratorChoice::Rk4 { step } => step,
            IntegratorChoice::Dop853 { .. } => {
                let rates = scenario.initial.devices.states().map(|[_, rate]| rate.abs());
                let fastest = rates.fold(scenario.initial.omega.norm(), f64::max);
                let longest = std::f64::consts::TAU / fastest / PER_TURN;
                let parts = (1.0 / (rate * longest)).ceil().max(1.0);
                1.0 / (rate * parts)
            }
        };
        if duration / step > STEPS_MAX {
            return Err(
                "the run is too long to be kept with its derivatives; shorten it".to_owned()
            );
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
        let samples = (duration * rate) as usize;
        Ok(Self { duration, rate, step, samples })
    }
}

/// Samples for each six keys.
pub(super) fn run<M: Motion>(
    mut motion: M,
    times: &Times,
    header: &Header,
) -> Result<Vec<Samples>, String> {
    let Times { duration, rate, step, .. } = *times;
    let mut kept: Vec<Samples> = Vec::new();
    let mut keep = |motion: &M, at: f64| -> Result<(), String> {
        let rows = motion.rows(header, at)?;
        kept.resize_with(rows.len(), Samples::new);
        kept.iter_mut().zip(rows).for_each(|(kept, row)| kept.push((at, row)));
        Ok(())
    };
    let mut sample = 0_u32;
    let mut steps = 0_u32;
    loop {
        let time = f64::from(steps) * step;
        let after = (f64::from(steps + 1) * step).min(duration);
        loop {
            let at = f64::from(sample) / rate;
            if at > duration - NEAR * step || at >= after - NEAR * step {
                break;
            }
            if (at - time).abs() <= NEAR * step {
                keep(&motion, at)?;
            } else {
                keep(&motion.after(at - time)?, at)?;
            }
            sample += 1;
        }
        motion = motion.after(after - time)?;
        steps += 1;
        if after >= duration - NEAR * step {
            keep(&motion, duration)?;
            return Ok(kept);
        }
    }
}
