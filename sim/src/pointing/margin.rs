//! [`Limit`] and [`Margin`]: tables of requirements on a density and lines, and how far they are met.

use super::exposure::{check_number, check_time};
use super::{Exposure, Index, PointingError, exposure_of_lines, exposure_of_psd, index_of_psd};
use crate::spectra::Psd;

/// A metric of a signal that is limited.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Metric {
    /// RMS.
    Rms,
    /// RMS in a band of frequencies, Hz.
    BandRms([f64; 2]),
    /// RMS of the mean over exposures of a length, s.
    Displacement(f64),
    /// RMS of the straight line within exposures of a length, s.
    Smear(f64),
    /// RMS of the rest within exposures of a length, s.
    Jitter(f64),
    /// An index of ECSS with its level.
    Index {
        /// Which, with its windows.
        index: Index,
        /// Probability.
        level: f64,
    },
}

/// An upper bound of a metric.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// What a report calls it.
    pub name: String,
    /// The metric.
    pub metric: Metric,
    /// The bound, SI.
    pub limit: f64,
    /// The unit in which limit and value are shown, and its size in SI.
    pub unit: (String, f64),
}

/// How far a value is below its limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Margin {
    /// The value.
    pub value: f64,
    /// The limit, in the same unit.
    pub limit: f64,
}

/// A limit and what was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Assessment {
    /// The limit.
    pub limit: Limit,
    /// The margin, SI.
    pub margin: Margin,
}

impl Margin {
    /// Whether the value is not above the limit; not of a value that is no number.
    #[must_use]
    pub fn is_met(&self) -> bool {
        self.value <= self.limit
    }

    /// Limit by value: one or more where it is met; infinite of the value zero.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        if self.value == 0.0 { f64::INFINITY } else { self.limit / self.value }
    }

    /// `20 log10(limit / value)`, dB: not negative where it is met.
    #[must_use]
    pub fn decibels(&self) -> f64 {
        20.0 * self.ratio().log10()
    }

    /// What is left of the limit, `100 (1 - value / limit)`, percent: not negative where it is met.
    #[must_use]
    pub fn percent(&self) -> f64 {
        let used = if self.value == 0.0 { 0.0 } else { self.value / self.limit };
        100.0 * (1.0 - used)
    }
}

/// The metrics of a signal with this density, and lines beside it that the density does not contain, each a
/// frequency, Hz, and an amplitude, against their limits.
///
/// # Errors
///
/// A limit that is negative or not finite, a band beyond the density, windows, or lines that are not finite. The
/// indices of ECSS take a level of Gaussian errors, which lines are not: an index with lines is an error.
pub fn assess(
    limits: &[Limit],
    psd: &Psd,
    lines: &[[f64; 2]],
) -> Result<Vec<Assessment>, PointingError> {
    let of = |(index, limit): (usize, &Limit)| {
        check_number("limit", index, limit.limit)?;
        let value = value(limit.metric, psd, lines)?;
        check_number("value of limit", index, value)?;
        let margin = Margin { value, limit: limit.limit };
        Ok(Assessment { limit: limit.clone(), margin })
    };
    limits.iter().enumerate().map(of).collect()
}

fn value(metric: Metric, psd: &Psd, lines: &[[f64; 2]]) -> Result<f64, PointingError> {
    let exposure = |time: f64| -> Result<Exposure, PointingError> {
        check_time(time)?;
        Ok(exposure_of_psd(psd, time)?.with(&exposure_of_lines(lines, time)?))
    };
    let of_lines = |within: &dyn Fn(f64) -> bool| -> f64 {
        let inside = lines.iter().filter(|[frequency, _]| within(*frequency));
        inside.map(|[_, amplitude]| 0.5 * amplitude * amplitude).sum::<f64>().sqrt()
    };
    Ok(match metric {
        Metric::Rms => psd.mean_square().sqrt().hypot(of_lines(&|_| true)),
        Metric::BandRms([from, to]) => psd
            .band_rms([from, to])?
            .hypot(of_lines(&|frequency| from <= frequency && frequency <= to)),
        Metric::Displacement(time) => exposure(time)?.displacement,
        Metric::Smear(time) => exposure(time)?.smear,
        Metric::Jitter(time) => exposure(time)?.jitter,
        Metric::Index { index, level } => {
            if !lines.is_empty() {
                return Err(PointingError::Interpretation { of: "a Gaussian level with lines" });
            }
            index_of_psd(index, psd, level)?.value
        }
    })
}
