//! [`Budget`]: which speeds are swept, where the optics look, and what they may move; [`Assessed`]: what a sweep says
//! of each limit.

use nalgebra::Vector3;

use super::keep_out::keep_out;
use super::model::Output;
use super::sweep::{Phases, Sweep};
use super::weight::Weight;
use crate::pointing::{Limit, LineOfSight, Margin, NoData, PointingError, RequirementState};
use crate::structure::dynamic_mass::Motor;

/// A metric that varies over the speed by less than this part of it is the same at every speed: it varies by rounding.
const VARIATION_MIN: f64 = 1e-9;
/// A share of a mean square that is smaller than this is left out.
const SHARE_MIN: f64 = 1e-9;

/// A line of sight with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Sight {
    /// Its name.
    pub name: String,
    /// Its sensitivities.
    pub line: LineOfSight,
}

/// A jitter budget.
#[derive(Clone, Debug, PartialEq)]
pub struct Budget {
    /// What a heading says.
    pub title: String,
    /// Lowest and highest speed, rad/s.
    pub speeds: [f64; 2],
    /// Speeds between them, both included.
    pub count: usize,
    /// Rotors whose speed is swept; empty for all.
    pub swept: Vec<String>,
    /// How lines of one frequency are added.
    pub phases: Phases,
    /// What motors of rotors do to small changes of their rates.
    pub motor: Motor,
    /// Whether other joints are free on their springs.
    pub sprung: bool,
    /// The lines of sight.
    pub sights: Vec<Sight>,
    /// Limits, each on a line of sight by its number.
    pub limits: Vec<(usize, Limit)>,
}

/// A limit and what a sweep found.
#[derive(Clone, Debug)]
pub struct Assessed {
    /// The number of the line of sight.
    pub sight: usize,
    /// The limit.
    pub limit: Limit,
    /// The metric at each speed, SI.
    pub values: Vec<f64>,
    /// The number of the speed at which it is largest.
    pub worst: usize,
    /// The margin there.
    pub margin: Margin,
    /// Why it could not be evaluated: no line and no noise has a share in the metric at any speed.
    pub no_data: Option<NoData>,
    /// The same by each assumption about phases: that of the budget, and the other ones.
    pub by_phases: Vec<ByPhases>,
    /// Contributors and their shares of the mean square there, as the budget's phases add them up, largest first. With that of
    /// the noise they add up to one. Of given phases a share may be negative.
    pub shares: Vec<(usize, f64)>,
    /// The share of broadband noise there.
    pub noise: f64,
    /// Speeds to keep out of, rad/s.
    pub keep_out: Vec<[f64; 2]>,
}

/// What a sweep says of a limit by one assumption about phases.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ByPhases {
    /// The assumption.
    pub phases: Phases,
    /// The number of the speed at which the metric is largest.
    pub worst: usize,
    /// Whether it is the same at every speed, but for rounding.
    pub is_flat: bool,
    /// The margin there.
    pub margin: Margin,
}

impl ByPhases {
    /// By how much a limit is violated, in words.
    #[must_use]
    pub fn excess(&self) -> String {
        format!("violated by {:.1} dB with {}", -self.margin.decibels(), self.phases.words())
    }
}

impl Assessed {
    /// Whether the metric is the same at every speed, but for rounding.
    #[must_use]
    pub fn is_flat(&self) -> bool {
        self.by_phases.first().is_some_and(|of| of.is_flat)
    }

    /// What became of the limit, by the budget's assumption about phases.
    #[must_use]
    pub fn state(&self) -> RequirementState {
        self.state_of(&self.margin)
    }

    /// Of a limit that is met by the budget's assumption about phases, the other one that violates it by most.
    #[must_use]
    pub fn violated_by(&self) -> Option<ByPhases> {
        let violated = |of: &&ByPhases| self.state_of(&of.margin).is_violated();
        let others = self.by_phases.iter().skip(1).filter(violated);
        let worst = others.max_by(|a, b| a.margin.value.total_cmp(&b.margin.value));
        worst.copied().filter(|_| self.state().is_met())
    }

    /// The same by a margin of another assumption.
    #[must_use]
    pub fn state_of(&self, margin: &Margin) -> RequirementState {
        state_of(self.no_data, margin)
    }
}

impl Budget {
    /// The assumptions about phases that are reported: that of the budget, and beside it the expected value and the worst.
    #[must_use]
    pub fn assumptions(&self) -> Vec<Phases> {
        let mut all = vec![self.phases];
        all.extend([Phases::Unknown, Phases::Worst].into_iter().filter(|of| *of != self.phases));
        all
    }

    /// The outputs of a model: two for each line of sight.
    #[must_use]
    pub fn outputs(&self) -> Vec<Output> {
        let mut outputs = Vec::new();
        for sight in &self.sights {
            for (axis, name) in ["x", "y"].into_iter().enumerate() {
                let terms = sight.line.sensitivities().iter().map(|of| {
                    let row: [f64; 6] = std::array::from_fn(|k| {
                        if k < 3 { of.displacement[(axis, k)] } else { of.rotation[(axis, k - 3)] }
                    });
                    (of.node.clone(), row)
                });
                outputs.push(Output {
                    name: format!("{} {name}", sight.name),
                    terms: terms.collect(),
                });
            }
        }
        outputs
    }

    /// What a sweep of the model with [`Self::outputs`] says of each limit; intervals of speed nearer than two steps
    /// are one.
    ///
    /// # Errors
    /// [`PointingError`] for an index, which is of a history or a density.
    pub fn assess(&self, sweep: &Sweep) -> Result<Vec<Assessed>, PointingError> {
        let [from, to] = self.speeds;
        let step = (to - from) / crate::spectra::float(self.count.max(2) - 1);
        self.limits
            .iter()
            .map(|(sight, limit)| {
                let outputs = outputs_of(*sight);
                let weight = Weight::of_metric(&limit.metric)?;
                let noise = sweep.noise.squares(&outputs, &weight);
                let over_speed = |phases| -> Vec<f64> {
                    let value = |(k, speed): (usize, &f64)| {
                        let of_lines = sweep.line_square(k, &outputs, phases, &weight);
                        (of_lines + noise.at(*speed)).sqrt()
                    };
                    sweep.speeds.iter().enumerate().map(value).collect()
                };
                let largest = |phases, values: &[f64]| {
                    let worst = worst_of(values);
                    let value = values.get(worst).copied().unwrap_or(f64::NAN);
                    ByPhases {
                        phases,
                        worst,
                        is_flat: is_flat(values),
                        margin: Margin { value, limit: limit.limit },
                    }
                };
                let values = over_speed(self.phases);
                let stated = largest(self.phases, &values);
                let mut by_phases = vec![stated];
                for phases in self.assumptions().into_iter().skip(1) {
                    by_phases.push(largest(phases, &over_speed(phases)));
                }
                let worst = stated.worst;
                let (shares, noise) = shares(sweep, worst, (&outputs, self.phases, &weight));
                Ok(Assessed {
                    sight: *sight,
                    limit: limit.clone(),
                    keep_out: keep_out(&sweep.speeds, &values, limit.limit, 2.0 * step),
                    margin: stated.margin,
                    no_data: weight.no_data().filter(|_| !sweep.has_share(&weight)),
                    by_phases,
                    values,
                    worst,
                    shares,
                    noise,
                })
            })
            .collect()
    }
}

/// What becomes of a limit by a margin, or why it is not evaluated.
pub(super) fn state_of(no_data: Option<NoData>, margin: &Margin) -> RequirementState {
    let by_margin = || RequirementState::from_margin(margin);
    no_data.map_or_else(by_margin, RequirementState::NotEvaluated)
}

/// Contributors and their shares of a mean square at a speed, largest first, and that of the noise.
fn shares(
    sweep: &Sweep,
    speed: usize,
    (outputs, phases, weight): (&[usize], Phases, &Weight),
) -> (Vec<(usize, f64)>, f64) {
    let shares = sweep.shares(speed, outputs, phases, weight);
    let noise = sweep.noise_square(speed, outputs, weight);
    let whole: f64 = shares.iter().sum::<f64>() + noise;
    let mut shares: Vec<(usize, f64)> =
        shares.into_iter().map(|share| share / whole).enumerate().collect();
    shares.retain(|(_, share)| share.abs() > SHARE_MIN && share.is_finite());
    shares.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()).then(a.0.cmp(&b.0)));
    (shares, if whole > 0.0 { noise / whole } else { 0.0 })
}

/// The number of the largest of some values: the first of those that are equal, and the first of all where all are the same, but
/// for rounding.
#[must_use]
pub fn worst_of(values: &[f64]) -> usize {
    let largest =
        || (0..values.len()).max_by(|a, b| values[*a].total_cmp(&values[*b]).then(b.cmp(a)));
    if is_flat(values) { 0 } else { largest().unwrap_or(0) }
}

/// Whether values of several speeds are the same, but for rounding.
#[must_use]
pub fn is_flat(values: &[f64]) -> bool {
    let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    values.len() > 1 && most - least <= VARIATION_MIN * most.abs().max(least.abs())
}

/// Outputs of a line of sight.
#[must_use]
pub fn outputs_of(sight: usize) -> [usize; 2] {
    [2 * sight, 2 * sight + 1]
}

/// A line of sight along B's z axis of a node: its rotations about x and y.
///
/// # Errors
/// None of these axes has any; those of [`LineOfSight::rigid`].
pub fn along_z(node: &str) -> Result<LineOfSight, PointingError> {
    LineOfSight::rigid(node, &Vector3::z(), &Vector3::x())
}
