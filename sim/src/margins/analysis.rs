//! [`ControlLoop`]: the closed loop of a controller, and [`LoopAnalysis`]: its margins, curves and poles.

use std::f64::consts::TAU;

use nalgebra::{Complex, DMatrix, Schur};
use precess_control::{
    AtFrequency, AxisMargins, LoopCurve, LoopResponse, SampledLoop, longest_delay,
};

use super::MarginsError;
use super::feedback::law_feedback;
use super::measurement::torque_filters;
use super::plant::ControlledPlant;
use super::sampled::ControlledSamples;
use crate::jitter::model::{Model, Output};
use crate::scenario::{SampledController, Scenario};

/// Names of the axes.
pub const AXES: [&str; 3] = ["x", "y", "z"];
/// A pole within this of 1 is neutral: what the loop does not act on.
const NEUTRAL: f64 = 1e-6;
/// A pole of a smaller magnitude is over within a sample.
const FAST: f64 = 1e-3;
/// The lowest frequency of the curves, as a share of the highest.
const LOWEST: f64 = 1e-4;
/// A smaller factor of a torque is none: a loop that integrates twice is next to the negative real axis at low frequencies.
const GAIN_LEAST: f64 = 1e-4;
/// Rests of a delay that are looked at again and again.
const RESTS: usize = 8;
/// A closed pole this near to one of the spacecraft by itself has its name.
const NEAR: f64 = 0.1;

/// A closed loop.
#[derive(Clone, Debug)]
pub struct ControlLoop {
    /// Name of the controller.
    pub name: String,
    /// Samples per second, Hz.
    pub rate: f64,
    /// The spacecraft.
    pub plant: ControlledPlant,
    /// The same from sample to sample.
    pub samples: ControlledSamples,
    /// Spacecraft, joints, servo, sensors and estimator with the law and the filters of the torque.
    pub closed: SampledLoop,
    /// The same with all that is given and waits, as [`ControlledSamples::plant`] has it.
    pub(super) with_all: SampledLoop,
    /// What noise of the readings adds to the states of the plant of `closed`.
    pub(super) noise: DMatrix<f64>,
}

/// A curve's point.
#[derive(Clone, Debug)]
pub struct LoopPoint {
    /// Angular frequency, rad/s.
    pub omega: f64,
    /// `L_i` of each axis, the others closed.
    pub axes: [Complex<f64>; 3],
    /// Eigenvalues of L, by falling magnitude.
    pub loci: [Complex<f64>; 3],
    /// Largest and smallest singular value of L.
    pub open: [f64; 2],
    /// Largest singular values of S and T.
    pub peaks: [f64; 2],
    /// `S_ii` and `T_ii` of each axis.
    pub closed: [[f64; 2]; 3],
}

/// An oscillation of the spacecraft by itself.
#[derive(Clone, Debug, PartialEq)]
pub struct OpenOscillation {
    /// What moves: `mode 1`, `rw.tilt_y, rw.tilt_z, forward whirl`; empty where another one is equal.
    pub name: String,
    /// Hz.
    pub frequency: f64,
    /// Damping ratio.
    pub damping: f64,
    /// At which the samples show it, Hz.
    pub alias: f64,
}

/// A pole of the closed loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopPole {
    /// In the plane of z.
    pub z: Complex<f64>,
    /// Hz, of `ln(z) / T`: up to half the rate of the samples.
    pub frequency: f64,
    /// Damping ratio.
    pub damping: f64,
    /// Number of the oscillation of the spacecraft by itself that it is near.
    pub oscillation: Option<usize>,
}

/// What a loop is worth.
#[derive(Clone, Debug)]
pub struct LoopAnalysis {
    /// Whether it is stable.
    pub stable: bool,
    /// Of each axis of B; none of a loop that is not stable.
    pub axes: Option<Vec<AxisMargins>>,
    /// Largest `|T_ii|` of each axis.
    pub complementary: Option<Vec<AtFrequency>>,
    /// How much longer the delay may be, s; none where it may be 32 periods. Zero of a loop that is not stable.
    pub delay: Option<f64>,
    /// Largest singular values of S and T over the frequencies; none of a loop that is not stable.
    pub peaks: Option<[AtFrequency; 2]>,
    /// Poles with an imaginary part that is not negative, by rising frequency.
    pub poles: Vec<LoopPole>,
    /// How many poles are at 1, which the loop does not act on: momentum, rates of wheels.
    pub neutral: usize,
    /// Oscillations of the spacecraft with motors held.
    pub oscillations: Vec<OpenOscillation>,
    /// Over the frequencies, rising to half the rate of the samples.
    pub points: Vec<LoopPoint>,
    /// What averaging over the turns of rotors leaves out at the highest crossover, as a share of the inertia.
    pub periodic: Option<AtFrequency>,
}

/// The controller of a name, or the only one.
///
/// # Errors
/// [`MarginsError::NoController`], [`MarginsError::Choice`].
pub fn chosen<'a>(
    scenario: &'a Scenario,
    name: Option<&str>,
) -> Result<&'a SampledController, MarginsError> {
    let known = || scenario.controllers.iter().map(|of| of.name.clone()).collect();
    match (name, &scenario.controllers[..]) {
        (_, []) => Err(MarginsError::NoController),
        (None, [only]) => Ok(only),
        (None, _) => Err(MarginsError::Choice { name: None, known: known() }),
        (Some(name), all) => all
            .iter()
            .find(|of| of.name == name)
            .ok_or_else(|| MarginsError::Choice { name: Some(name.to_owned()), known: known() }),
    }
}

impl ControlLoop {
    /// Of a scenario's controller, rotors at their initial rates, with outputs at nodes.
    ///
    /// # Errors
    /// [`MarginsError`].
    pub fn new(
        scenario: &Scenario,
        of: &SampledController,
        outputs: &[Output],
    ) -> Result<Self, MarginsError> {
        Self::of_plant(scenario, of, ControlledPlant::new(scenario, of, outputs)?)
    }

    /// Of a model in which the commanded joints are free, at a speed of its swept rotors, rad/s.
    ///
    /// # Errors
    /// [`MarginsError`].
    pub(crate) fn of_model(
        scenario: &Scenario,
        of: &SampledController,
        model: Model,
        speed: f64,
    ) -> Result<Self, MarginsError> {
        Self::of_plant(scenario, of, ControlledPlant::of_model(scenario, of, model, speed)?)
    }

    fn of_plant(
        scenario: &Scenario,
        of: &SampledController,
        plant: ControlledPlant,
    ) -> Result<Self, MarginsError> {
        let samples = ControlledSamples::new(&plant, of)?;
        let law = law_feedback(scenario, of, &plant.allocation.momentum)?;
        let feedback = law.then(&torque_filters(of)?)?;
        let (least, noise) = samples.least_plant()?;
        let closed = SampledLoop::new(least, feedback.clone())?;
        let with_all = SampledLoop::new(samples.plant()?.0, feedback)?;
        Ok(Self { name: of.name.clone(), rate: of.rate, plant, samples, closed, with_all, noise })
    }

    /// Margins, curves and poles.
    ///
    /// # Errors
    /// [`MarginsError`].
    pub fn analysis(&self) -> Result<LoopAnalysis, MarginsError> {
        let stable = self.closed.is_stable()?;
        let curve = self.closed.curve()?;
        let mut axes = stable.then(|| curve.margins());
        for axis in axes.iter_mut().flatten() {
            axis.gain_down = axis.gain_down.filter(|of| of.value > GAIN_LEAST);
        }
        let (mut complementary, mut peaks) = (None, None);
        if stable {
            let own = |axis: usize| {
                let of = |at: &LoopResponse| at.complementary.get((axis, axis)).map_or(0.0, norm);
                curve.largest(of)
            };
            complementary = Some([own(0), own(1), own(2)].to_vec());
            let of_t = |at: &LoopResponse| at.complementary.singular_values().max();
            peaks = Some([curve.largest(LoopResponse::peak), curve.largest(of_t)]);
        }
        let delay = self.longest_delay()?;
        let oscillations = self.oscillations();
        let (poles, neutral) = self.poles(&oscillations)?;
        let points = self.points(&curve);
        let crossover = points.iter().filter(|at| at.open[0] >= 1.0).map(|at| at.omega);
        let periodic = match crossover.fold(0.0, f64::max) {
            omega if omega > 0.0 => Some(AtFrequency { value: self.plant.periodic(omega)?, omega }),
            _ => None,
        };
        Ok(LoopAnalysis {
            stable,
            axes,
            complementary,
            delay,
            peaks,
            poles,
            neutral,
            oscillations,
            points,
            periodic,
        })
    }

    /// How much longer the delay may be, s. Of each rest of a period that comes again the steps are computed once.
    fn longest_delay(&self) -> Result<Option<f64>, MarginsError> {
        let mut known: Vec<(f64, ControlledSamples)> = Vec::new();
        longest_delay(self.samples.sampling, |periods, rest| {
            let found = known.iter().find(|(of, _)| of.to_bits() == rest.to_bits());
            let samples = match found {
                Some((_, samples)) => samples.clone().with_periods((periods, rest)),
                None => self.samples.with_delay(&self.plant.held, (periods, rest)),
            };
            let (plant, _) = samples.least_plant()?;
            if found.is_none() && known.len() < RESTS {
                known.push((rest, samples));
            }
            Ok(SampledLoop::new(plant, self.closed.feedback().clone())?)
        })
    }

    /// The curves.
    fn points(&self, curve: &LoopCurve<'_>) -> Vec<LoopPoint> {
        let at = |found: &LoopResponse| {
            let mut axes = [Complex::new(0.0, 0.0); 3];
            for (axis, to) in axes.iter_mut().enumerate() {
                *to = found.axis(axis)?;
            }
            let mut loci = [Complex::new(0.0, 0.0); 3];
            let values = Schur::try_new(found.open.clone(), f64::EPSILON, 10_000)?.eigenvalues()?;
            loci.iter_mut().zip(values.iter()).for_each(|(to, value)| *to = *value);
            loci.sort_by(|a, b| b.norm_sqr().total_cmp(&a.norm_sqr()));
            let sizes = found.open.singular_values();
            let own = |axis: usize| {
                [&found.sensitivity, &found.complementary]
                    .map(|of| of.get((axis, axis)).map_or(0.0, norm))
            };
            Some(LoopPoint {
                omega: found.omega,
                axes,
                loci,
                open: [sizes.max(), sizes.min()],
                peaks: [found.peak(), found.complementary.singular_values().max()],
                closed: [own(0), own(1), own(2)],
            })
        };
        let lowest = LOWEST * self.closed.nyquist();
        let shown = curve.responses().iter().filter(|found| found.omega >= lowest);
        shown.filter_map(at).collect()
    }

    fn oscillations(&self) -> Vec<OpenOscillation> {
        let of = |[frequency, damping]: [f64; 2]| {
            let seen = frequency * (1.0 - damping * damping).max(0.0).sqrt();
            let (name, alias) =
                (self.plant.moving([frequency, damping]), alias(seen, self.rate).abs());
            OpenOscillation { name, frequency, damping, alias }
        };
        self.plant.oscillations().into_iter().map(of).collect()
    }

    fn poles(
        &self,
        oscillations: &[OpenOscillation],
    ) -> Result<(Vec<LoopPole>, usize), MarginsError> {
        let period = self.samples.sampling.period;
        let all = self.closed.poles()?;
        let one = Complex::new(1.0, 0.0);
        let neutral = all.iter().filter(|z| (**z - one).norm() < NEUTRAL).count();
        let listed = all
            .into_iter()
            .filter(|z| (*z - one).norm() >= NEUTRAL && z.im >= 0.0 && z.norm() > FAST);
        let mut poles: Vec<LoopPole> = listed
            .map(|z| {
                let s = z.ln() / period;
                let damping = if s.norm() > 0.0 { -s.re / s.norm() } else { 0.0 };
                LoopPole { z, frequency: s.norm() / TAU, damping, oscillation: None }
            })
            .collect();
        poles.sort_by(|a, b| a.frequency.total_cmp(&b.frequency));
        for (number, of) in oscillations.iter().enumerate() {
            let w = TAU * of.frequency;
            let damped = w * (1.0 - of.damping * of.damping).max(0.0).sqrt();
            let z = Complex::from_polar((-of.damping * w * period).exp(), damped * period);
            let z = Complex::new(z.re, z.im.abs());
            let free = poles.iter_mut().filter(|pole| pole.oscillation.is_none());
            let nearest = free.min_by(|a, b| (a.z - z).norm().total_cmp(&(b.z - z).norm()));
            if let Some(pole) = nearest.filter(|pole| (pole.z - z).norm() < NEAR) {
                pole.oscillation = Some(number);
            }
        }
        Ok((poles, neutral))
    }
}

/// The frequency at which samples at a rate show another one: from minus half the rate to half of it, with the sign of its turn.
#[must_use]
pub fn alias(frequency: f64, rate: f64) -> f64 {
    frequency - (frequency / rate).round() * rate
}

fn norm(value: &Complex<f64>) -> f64 {
    value.norm()
}
