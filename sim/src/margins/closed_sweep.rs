//! [`close`]: lines and noise of a jitter budget with the loop of a controller closed.

use nalgebra::Complex;

use super::MarginsError;
use super::analysis::ControlLoop;
use super::closed_noise::{ClosedNoise, ReadingSpectrum};
use super::lines::ClosedLine;
use crate::jitter::budget::Budget;
use crate::jitter::device::Steady;
use crate::jitter::model::{Contributor, Line, Model};
use crate::jitter::noise::NoiseSweep;
use crate::jitter::sweep::{Sweep, some_of};
use crate::scenario::{SampledController, Scenario};

/// An alias is at a component of this frequency, as a share of it.
const SAME: f64 = 1e-9;

/// What a closed loop has beside the lines and the noise of the sweep.
#[derive(Clone, Debug, Default)]
pub struct ClosedSweep {
    /// Speeds, rad/s, at which the loop is not stable; there lines and noise are none that would be seen.
    pub unstable: Vec<f64>,
    /// The noise of each of [`CLOSED_NOISE`](super::closed_noise::CLOSED_NOISE).
    pub noise: [NoiseSweep; 3],
}

/// Replaces the lines and the noise of a sweep by those of the closed loop. Behind the contributors of the sweep each has another one, its
/// alias: what the controller does at the frequency at which its samples show the line; zero, at the line's own frequency, where
/// it is not aliased. Noise is that of sources with all that samples alias of it, and that of sensors.
///
/// # Errors
/// [`MarginsError`].
pub fn close(
    scenario: &Scenario,
    of: &SampledController,
    budget: &Budget,
    sweep: &mut Sweep,
    progress: &dyn Fn(usize),
) -> Result<ClosedSweep, MarginsError> {
    let steady = Steady { motor: budget.motor, sprung: budget.sprung, swept: Some(&budget.swept) };
    let free: Vec<usize> = of.joints.iter().map(|own| own.joint).collect();
    let mut model = Model::with_free(scenario, &budget.outputs(), &steady, &free)?;
    model.add_sources(scenario)?;
    let count = sweep.contributors.len();
    let aliases: Vec<Contributor> = sweep
        .contributors
        .iter()
        .map(|of| Contributor { cause: format!("{} aliased", of.cause), ..of.clone() })
        .collect();
    sweep.contributors.extend(aliases);
    let reading = ReadingSpectrum::of_sensors(of)?;
    let has_noise = !(model.noises.is_empty() && reading.is_zero());
    let noise_speeds = if has_noise { some_of(&sweep.speeds) } else { Vec::new() };
    let (mut whole, mut found) = (NoiseSweep::default(), ClosedSweep::default());
    for (index, (speed, lines)) in sweep.speeds.iter().zip(&mut sweep.lines).enumerate() {
        let closed = ControlLoop::of_model(scenario, of, model.clone(), *speed)?;
        if !closed.closed.is_stable()? {
            found.unstable.push(*speed);
        }
        let all = closed.lines()?;
        let mut aliased = Vec::with_capacity(count);
        for (line, closed) in lines.iter_mut().zip(&all) {
            if let Some(own) = closed.components.first() {
                line.values.clone_from(&own.outputs);
            }
            aliased.push(alias_of(line, closed, count));
        }
        lines.extend(aliased);
        if noise_speeds.contains(speed) {
            let ClosedNoise { whole: all, parts } = closed.closed_noise(reading)?;
            whole.speeds.push(all);
            for (to, part) in found.noise.iter_mut().zip(parts) {
                to.speeds.push(part);
            }
        }
        progress(index + 1);
    }
    sweep.noise = whole;
    Ok(found)
}

/// The alias of a line.
fn alias_of(line: &Line, closed: &ClosedLine, count: usize) -> Line {
    let contributor = line.contributor + count;
    let at_alias = closed.components.iter().skip(1);
    let found = at_alias
        .filter(|_| closed.is_aliased())
        .find(|of| (of.frequency - closed.alias).abs() <= SAME * closed.alias);
    match found {
        Some(component) => Line {
            contributor,
            frequency: component.frequency * std::f64::consts::TAU,
            values: component.outputs.clone(),
        },
        None => Line {
            contributor,
            frequency: line.frequency,
            values: vec![Complex::new(0.0, 0.0); line.values.len()],
        },
    }
}
