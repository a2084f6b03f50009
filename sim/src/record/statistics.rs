//! [`Statistics`]: the numbers that requirements limit, from the samples as they come.
//!
//! The quantity is a column, or the magnitude of a vector or of its components along or across a direction; the RMS in a band of a vector is that of
//! its components together. Means over time are by the trapezoidal rule, so a last sample that is
//! not evenly spaced has its own weight; the band, exposures and indices of ECSS use only samples
//! that are. Memory does not grow with the run: levels are found in buckets, at most 0.1 % above.

use super::no_data::no_data;
use super::welch::Welch;
use super::{Header, Outcome, RecordError, Recorder};
use crate::pointing::{
    EXPOSURE_SAMPLES_MIN, ExposureHistory, IndexStream, Margin, NoData, PointingError, Quantile,
    RequirementState, WindowSums, samples_of,
};
use crate::scenario::{Projection, Requirement, Statistic};

/// Computes what requirements limit.
pub struct Statistics {
    requirements: Vec<Requirement>,
    histories: Vec<History>,
    /// Samples per second, 1/s, and length of the whole run, s.
    rate: f64,
    duration: f64,
    verdicts: Vec<Verdict>,
}

/// A requirement and what became of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// The requirement's name.
    pub name: String,
    /// The column or vector, with the direction of its components where only some count.
    pub quantity: String,
    /// The statistic, SI; none where nothing was measured. Of a window that was not run to its end, that of what was.
    pub value: Option<f64>,
    /// Its upper bound, SI.
    pub limit: f64,
    /// The unit in which both are shown, and its size in SI.
    pub unit: (String, f64),
    /// Whether the whole window was run.
    pub complete: bool,
    /// What became of it.
    pub state: RequirementState,
}

/// What is kept of a quantity.
struct History {
    columns: Vec<usize>,
    projection: Projection,
    window: [f64; 2],
    statistic: Statistic,
    /// The samples before the end of the run are this far apart, s.
    spacing: f64,
    first: Option<Vec<f64>>,
    /// Time and magnitude of the last sample in the window.
    last: Option<[f64; 2]>,
    /// Largest magnitude, or departure from the first sample.
    most: f64,
    /// Integral of the square.
    integral: f64,
    length: f64,
    bands: Vec<Welch>,
    pointing: Option<Pointing>,
}

/// What is kept for exposures and indices.
enum Pointing {
    Exposures(WindowSums),
    Index(IndexStream, Quantile),
}

impl Statistics {
    /// The statistics of these requirements.
    #[must_use]
    pub fn new(requirements: &[Requirement]) -> Self {
        let requirements = requirements.to_vec();
        let (histories, verdicts) = (Vec::new(), Vec::new());
        Self { requirements, histories, rate: 0.0, duration: 0.0, verdicts }
    }

    /// One for each requirement in order, once the run has ended.
    #[must_use]
    pub fn verdicts(&self) -> &[Verdict] {
        &self.verdicts
    }
}

impl Verdict {
    /// How far the value is below the limit, SI; none where there is no value.
    #[must_use]
    pub fn margin(&self) -> Option<Margin> {
        self.value.map(|value| Margin { value, limit: self.limit })
    }

    /// Whether the requirement is met over its whole window.
    #[must_use]
    pub fn is_met(&self) -> bool {
        self.state.is_met()
    }
}

impl Recorder for Statistics {
    fn begin(&mut self, header: &Header) -> Result<(), RecordError> {
        self.verdicts.clear();
        self.histories.clear();
        (self.rate, self.duration) = (header.rate, header.duration);
        for requirement in &self.requirements {
            let columns = header.quantity(&requirement.quantity)?;
            let components = requirement.projection.components(columns.len());
            let [from, to] = requirement.window;
            let mut bands = Vec::new();
            if let Statistic::BandRms(band) = requirement.statistic {
                let highest = 0.5 * header.rate;
                if !(0.0 <= band[0] && band[0] < band[1] && band[1] <= highest) {
                    let requirement = requirement.name.clone();
                    return Err(RecordError::Band { requirement, band, highest });
                }
                let count = (to - from) * header.rate;
                bands.extend((0..components).map(|_| Welch::new(band, header.rate, count)));
            }
            let pointing = Pointing::new(requirement.statistic, components, header.rate);
            let pointing = pointing.map_err(|source| RecordError::Metric {
                requirement: requirement.name.clone(),
                source,
            })?;
            self.histories.push(History {
                columns,
                projection: requirement.projection,
                window: requirement.window,
                statistic: requirement.statistic,
                spacing: 1.0 / header.rate,
                first: None,
                last: None,
                most: 0.0,
                integral: 0.0,
                length: 0.0,
                bands,
                pointing,
            });
        }
        Ok(())
    }

    fn sample(&mut self, row: &[f64]) -> Result<(), RecordError> {
        let time = row.first().copied().unwrap_or_default();
        self.histories.iter_mut().for_each(|history| history.add(time, row));
        Ok(())
    }

    fn finish(&mut self, outcome: &Outcome) -> Result<(), RecordError> {
        let pairs = self.requirements.iter().zip(&self.histories);
        self.verdicts = pairs
            .map(|(requirement, history)| {
                let value = history.value();
                let complete = outcome.end_time >= requirement.window[1];
                Verdict {
                    name: requirement.name.clone(),
                    quantity: requirement.projection.of_quantity(&requirement.quantity),
                    value,
                    limit: requirement.limit,
                    unit: requirement.unit.clone(),
                    complete,
                    state: self.state(requirement, value, outcome.end_time),
                }
            })
            .collect();
        Ok(())
    }
}

impl Statistics {
    /// The state of a requirement by its value, of a run that ended at a time, s. What has been exceeded stays exceeded,
    /// so a peak of a part of the window may violate the limit, and nothing else of a part counts.
    fn state(&self, requirement: &Requirement, value: Option<f64>, end: f64) -> RequirementState {
        let [_, to] = requirement.window;
        let margin = value.map(|value| Margin { value, limit: requirement.limit });
        let by_margin = margin.as_ref().map(RequirementState::from_margin);
        if end >= to {
            let none = || no_data(requirement, self.rate, self.duration);
            let none = || none().unwrap_or(NoData::NoSample { window: requirement.window });
            return by_margin.unwrap_or_else(|| RequirementState::NotEvaluated(none()));
        }
        let only_grows = matches!(requirement.statistic, Statistic::Peak | Statistic::Drift);
        match by_margin {
            Some(state) if only_grows && state.is_violated() => state,
            _ => RequirementState::NotEvaluated(NoData::WindowNotRun { end, to }),
        }
    }
}

impl History {
    fn add(&mut self, time: f64, row: &[f64]) {
        let [from, to] = self.window;
        if !(from..=to).contains(&time) {
            return;
        }
        let values = || self.columns.iter().map(|column| row.get(*column).copied());
        let values = values().map(|value| value.unwrap_or(f64::NAN)).collect();
        let values: Vec<f64> = self.projection.of(values);
        let magnitude = norm(values.iter().copied());
        let of_most = if self.statistic == Statistic::Drift {
            let first = self.first.get_or_insert_with(|| values.clone());
            norm(values.iter().zip(first).map(|(value, first)| value - *first))
        } else {
            magnitude
        };
        // A NaN is no small value.
        if of_most > self.most || of_most.is_nan() {
            self.most = of_most;
        }
        let mut even = true;
        if let Some([before, last]) = self.last {
            let step = time - before;
            self.integral += 0.5 * step * (last * last + magnitude * magnitude);
            self.length += step;
            even = (step / self.spacing - 1.0).abs() < 1e-6;
        }
        if even {
            self.bands.iter_mut().zip(&values).for_each(|(band, value)| band.add(*value));
            if let Some(pointing) = &mut self.pointing {
                pointing.add(&values);
            }
        }
        self.last = Some([time, magnitude]);
    }

    fn value(&self) -> Option<f64> {
        let [_, last] = self.last?;
        match self.statistic {
            Statistic::Peak | Statistic::Drift => Some(self.most),
            Statistic::Rms if self.length > 0.0 => Some((self.integral / self.length).sqrt()),
            Statistic::Final | Statistic::Rms => Some(last),
            Statistic::BandRms(_) => {
                let squares = self.bands.iter().map(Welch::mean_square);
                squares.sum::<Option<f64>>().map(f64::sqrt)
            }
            Statistic::Displacement(_) => self.exposures().map(|of| of.rms.displacement),
            Statistic::Smear(_) => self.exposures().map(|of| of.rms.smear),
            Statistic::Jitter(_) => self.exposures().map(|of| of.rms.jitter),
            Statistic::Index { level, .. } => match &self.pointing {
                Some(Pointing::Index(_, values)) => values.at(level),
                _ => None,
            },
        }
    }

    fn exposures(&self) -> Option<ExposureHistory> {
        match &self.pointing {
            Some(Pointing::Exposures(sums)) => sums.history(),
            _ => None,
        }
    }
}

impl Pointing {
    /// For a statistic of a quantity with some components at a rate, 1/s; none where it needs nothing.
    fn new(
        statistic: Statistic,
        components: usize,
        rate: f64,
    ) -> Result<Option<Self>, PointingError> {
        statistic.check(rate)?;
        Ok(match statistic {
            Statistic::Displacement(time) | Statistic::Smear(time) | Statistic::Jitter(time) => {
                let samples = samples_of(time, rate, EXPOSURE_SAMPLES_MIN)?;
                Some(Self::Exposures(WindowSums::new(samples, components)))
            }
            Statistic::Index { index, .. } => {
                Some(Self::Index(IndexStream::new(index, rate)?, Quantile::default()))
            }
            _ => None,
        })
    }

    fn add(&mut self, values: &[f64]) {
        match self {
            Self::Exposures(sums) => sums.add(values.iter().copied()),
            Self::Index(stream, quantile) => stream.add(values, &mut |value| quantile.add(value)),
        }
    }
}

/// The magnitude of components.
fn norm(components: impl Iterator<Item = f64>) -> f64 {
    components.map(|component| component * component).sum::<f64>().sqrt()
}
