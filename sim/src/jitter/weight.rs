//! [`Weight`]: the share of a line's mean square in a metric, by its frequency, and the edges and periods of that share.

use std::f64::consts::TAU;

use crate::pointing::{ExposureWeights, Metric, NoData, PointingError};

/// A line this near to an end of a band, of its frequency, is on it and counts.
const ON_EDGE: f64 = 1e-9;
/// Longer than so many periods of a share that goes to and fro, an interval has its mean over a period.
pub(super) const PERIODS_MAX: f64 = 512.0;

/// The share of a line's mean square in a metric.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weight(Metric);

impl Weight {
    /// That of a metric.
    ///
    /// # Errors
    /// [`PointingError`] for an index, which is of a history or a density.
    pub fn of_metric(metric: &Metric) -> Result<Self, PointingError> {
        match metric {
            Metric::Index { .. } => Err(PointingError::Interpretation { of: "an index of lines" }),
            _ => Ok(Self(*metric)),
        }
    }

    /// One at every frequency.
    #[must_use]
    pub const fn one() -> Self {
        Self(Metric::Rms)
    }

    /// The share at an angular frequency, rad/s.
    #[must_use]
    pub fn at(&self, frequency: f64) -> f64 {
        let hertz = frequency / TAU;
        match self.0 {
            Metric::Rms | Metric::Index { .. } => 1.0,
            Metric::BandRms([from, to]) => {
                let slack = ON_EDGE * hertz;
                if (from - slack..=to + slack).contains(&hertz) { 1.0 } else { 0.0 }
            }
            Metric::Displacement(time) => ExposureWeights::new(hertz, time).displacement,
            Metric::Smear(time) => ExposureWeights::new(hertz, time).smear,
            Metric::Jitter(time) => ExposureWeights::new(hertz, time).jitter,
        }
    }

    /// The mean share over a period of the weight about a frequency, Hz, many periods above zero: `sin^2` and `cos^2` are
    /// one half.
    pub(super) fn mean_at(&self, hertz: f64) -> f64 {
        let Some(time) = self.time() else { return self.at(TAU * hertz) };
        let u = std::f64::consts::PI * hertz * time;
        let displacement = 0.5 / (u * u);
        let smear = 1.5 * (1.0 + 1.0 / (u * u)) / (u * u);
        match self.0 {
            Metric::Displacement(_) => displacement,
            Metric::Smear(_) => smear,
            _ => 1.0 - displacement - smear,
        }
    }

    /// The part of an interval, Hz, in which it is not zero: an integral over frequency is split there.
    pub(super) fn support(&self, [from, to]: [f64; 2]) -> [f64; 2] {
        match self.0 {
            Metric::BandRms([first, last]) => [from.max(first), to.min(last)],
            _ => [from, to],
        }
    }

    /// The exposure, s, whose inverse is the period over which it goes to and fro, Hz; none where it does not.
    pub(super) const fn time(&self) -> Option<f64> {
        match self.0 {
            Metric::Displacement(time) | Metric::Smear(time) | Metric::Jitter(time) => Some(time),
            Metric::Rms | Metric::BandRms(_) | Metric::Index { .. } => None,
        }
    }

    /// What there is no data of where no line and no noise has a share.
    pub(super) const fn no_data(&self) -> Option<NoData> {
        match self.0 {
            Metric::BandRms(band) => Some(NoData::NoLine { band }),
            Metric::Displacement(exposure) | Metric::Smear(exposure) | Metric::Jitter(exposure) => {
                Some(NoData::NoShare { exposure })
            }
            Metric::Rms | Metric::Index { .. } => None,
        }
    }

    /// Whether it has a share in an interval, Hz.
    pub(super) fn has_share(&self, interval: [f64; 2]) -> bool {
        let [from, to] = self.support(interval);
        from < to && (self.time().is_none() || self.at(TAU * to) > 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_on_the_edge_of_a_band_counts() {
        let weight = Weight::of_metric(&Metric::BandRms([10.0, 50.0])).expect("no index");
        for hertz in [10.0, 10.0 * (1.0 - 1e-15), 50.0, 50.0 * (1.0 + 1e-15)] {
            assert_eq!(weight.at(TAU * hertz), 1.0, "{hertz}");
        }
        assert_eq!((weight.at(TAU * 9.999), weight.at(TAU * 50.001)), (0.0, 0.0));
    }

    #[test]
    fn mean_shares_are_those_over_a_period() {
        for metric in [Metric::Displacement(2.0), Metric::Smear(2.0), Metric::Jitter(2.0)] {
            let weight = Weight::of_metric(&metric).expect("no index");
            // Periods are 1 by 2 Hz; 1000 of them above zero the share falls by 2e-3 over one.
            let parts = 1000;
            let mean = (0..parts)
                .map(|k| weight.at(TAU * (500.0 + 0.5 * f64::from(k) / f64::from(parts))))
                .sum::<f64>()
                / f64::from(parts);
            let found = weight.mean_at(500.25);
            assert!((found / mean - 1.0).abs() < 1e-3, "{metric:?}: {found} for {mean}");
        }
    }
}
