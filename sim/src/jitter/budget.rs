//! [`Budget`]: which speeds are swept, where the optics look, and what they may move; [`Assessed`]: what a sweep says
//! of each limit.

use nalgebra::Vector3;

use super::keep_out::keep_out;
use super::model::Output;
use super::sweep::{Phases, Sweep};
use crate::pointing::{ExposureWeights, Limit, LineOfSight, Margin, Metric, PointingError};
use crate::structure::dynamic_mass::Motor;

/// A smaller share of a mean square is left out.
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
    /// The same by each assumption about phases: that of the budget, and the other ones.
    pub by_phases: Vec<ByPhases>,
    /// Contributors and their shares of the mean square there, largest first.
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
    /// The margin there.
    pub margin: Margin,
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
                let weight = weight_of(&limit.metric)?;
                let over_speed = |phases| -> Vec<f64> {
                    let square = |speed| sweep.mean_square(speed, &outputs, phases, &weight);
                    (0..sweep.speeds.len()).map(|k| square(k).sqrt()).collect()
                };
                let largest = |phases, values: &[f64]| {
                    let worst = (0..values.len()).max_by(|a, b| values[*a].total_cmp(&values[*b]));
                    let worst = worst.unwrap_or(0);
                    let value = values.get(worst).copied().unwrap_or(f64::NAN);
                    ByPhases { phases, worst, margin: Margin { value, limit: limit.limit } }
                };
                let values = over_speed(self.phases);
                let stated = largest(self.phases, &values);
                let mut by_phases = vec![stated];
                for phases in self.assumptions().into_iter().skip(1) {
                    by_phases.push(largest(phases, &over_speed(phases)));
                }
                let worst = stated.worst;
                let shares = sweep.shares(worst, &outputs, &weight);
                let noise = sweep.noise_square(worst, &outputs, &weight);
                let whole: f64 = shares.iter().sum::<f64>() + noise;
                let mut shares: Vec<(usize, f64)> =
                    shares.into_iter().map(|share| share / whole).enumerate().collect();
                shares.retain(|(_, share)| *share > SHARE_MIN);
                shares.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
                Ok(Assessed {
                    sight: *sight,
                    limit: limit.clone(),
                    keep_out: keep_out(&sweep.speeds, &values, limit.limit, 2.0 * step),
                    margin: stated.margin,
                    by_phases,
                    values,
                    worst,
                    shares,
                    noise: if whole > 0.0 { noise / whole } else { 0.0 },
                })
            })
            .collect()
    }
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

/// The share of a line's mean square in a metric, by its angular frequency, rad/s.
///
/// # Errors
/// [`PointingError`] for an index, which is of a history or a density.
pub fn weight_of(metric: &Metric) -> Result<Box<dyn Fn(f64) -> f64>, PointingError> {
    let hertz = |frequency: f64| frequency / std::f64::consts::TAU;
    let exposed =
        move |exposure: f64, of: fn(&ExposureWeights) -> f64| -> Box<dyn Fn(f64) -> f64> {
            Box::new(move |frequency| of(&ExposureWeights::new(hertz(frequency), exposure)))
        };
    Ok(match *metric {
        Metric::Rms => Box::new(|_| 1.0),
        Metric::BandRms([from, to]) => {
            Box::new(move |w| if (from..=to).contains(&hertz(w)) { 1.0 } else { 0.0 })
        }
        Metric::Displacement(exposure) => exposed(exposure, |weights| weights.displacement),
        Metric::Smear(exposure) => exposed(exposure, |weights| weights.smear),
        Metric::Jitter(exposure) => exposed(exposure, |weights| weights.jitter),
        Metric::Index { .. } => {
            return Err(PointingError::Interpretation { of: "an index of lines" });
        }
    })
}
