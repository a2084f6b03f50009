//! Pointing error indices with a statistical interpretation, a level and a confidence.
//!
//! A requirement reads `prob(|index| < limit) >= P`, with a stated interpretation of the probability
//! (ECSS-E-ST-60-10C, 4.1.1 to 4.1.4, annex A.1.2; P is called confidence level there, and level here, since the
//! confidence is that of a sample). Levels of densities are those of Gaussian errors of zero mean (annex A.2.4).

use std::f64::consts::PI;

use precess_dynamics::Angle;
use statrs::distribution::{Binomial, ContinuousCDF as _, DiscreteCDF as _, Normal};

use super::exposure::{check_number, check_time, parts};
use super::indices::{means_of_run, norm, values_of_run};
use super::quantile::{quantile, rank};
use super::weights::ExposureWeights;
use super::{Index, PointingError};
use crate::spectra::Psd;

/// What the probability of a requirement is taken over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpretation {
    /// Over all times of the worst run: the limit holds for a share P of the time in every run.
    Temporal,
    /// Over the worst times of all runs: the limit holds at all times in a share P of the runs.
    Ensemble,
    /// Over all times of all runs.
    Mixed,
}

/// An index with how it is to be read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IndexValue {
    /// Which index.
    pub index: Index,
    /// The value that the index does not exceed with the level, unit.
    pub value: f64,
    /// What the level is of.
    pub interpretation: Interpretation,
    /// Probability P.
    pub level: f64,
    /// Probability that P is reached, by the number of runs: of the ensemble interpretation, whose runs are
    /// independent. Values along a run are not, so the others have none.
    pub confidence: Option<f64>,
    /// Runs; zero of a density.
    pub runs: usize,
    /// Values of all runs; zero of a density.
    pub values: usize,
}

impl Interpretation {
    /// The name in files and reports.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Temporal => "temporal",
            Self::Ensemble => "ensemble",
            Self::Mixed => "mixed",
        }
    }
}

/// An index of runs, each with its components sample by sample, at a rate, 1/s.
///
/// With a `confidence` C the ensemble interpretation takes, of the largest values of n runs, the least whose rank k has
/// `P(fewer than k of n below the quantile) >= C`: a one-sided tolerance bound without assumption on the distribution
/// (Wilks, Ann. Math. Statist. 12, 1941). Without, it takes the quantile of the sample, and states the confidence that
/// this has.
///
/// # Errors
///
/// Windows, a level or confidence that is not between zero and one, runs that are too short or too few, a sample that
/// is not finite, or a confidence of an interpretation over time.
pub fn index_of_runs(
    index: Index,
    runs: &[&[&[f64]]],
    rate: f64,
    interpretation: Interpretation,
    level: f64,
    confidence: Option<f64>,
) -> Result<IndexValue, PointingError> {
    for level in [Some(level), confidence].into_iter().flatten() {
        check_level(level)?;
    }
    index.check()?;
    let along: Vec<Vec<f64>> = match index {
        Index::Pre { window } => reproducibility(window, runs, rate)?,
        _ => runs
            .iter()
            .map(|components| values_of_run(index, components, rate))
            .collect::<Result<_, _>>()?,
    };
    let values = along.iter().map(Vec::len).sum();
    let result = |value: f64, confidence: Option<f64>| {
        check_number("index", 0, value)?;
        let runs = runs.len();
        Ok(IndexValue { index, value, interpretation, level, confidence, runs, values })
    };
    let over_time = || PointingError::Interpretation { of: "the confidence of a level over time" };
    match interpretation {
        Interpretation::Temporal | Interpretation::Mixed if confidence.is_some() => {
            Err(over_time())
        }
        Interpretation::Temporal => {
            let each = along.into_iter().map(|values| quantile(values, level));
            let each: Vec<f64> = each.collect::<Result<_, _>>()?;
            result(quantile(each, 1.0)?, None)
        }
        Interpretation::Mixed => result(quantile(along.concat(), level)?, None),
        Interpretation::Ensemble => {
            let largest = |values: &Vec<f64>| values.iter().copied().fold(0.0, f64::max);
            let mut largest: Vec<f64> = along.iter().map(largest).collect();
            largest.sort_by(f64::total_cmp);
            let (rank, reached) = ensemble_rank(largest.len(), level, confidence)?;
            let value = largest.get(rank - 1).copied();
            result(value.ok_or(PointingError::Short { samples: 0, least: 1 })?, Some(reached))
        }
    }
}

/// The rank of a bound among n runs, and the confidence that it has.
fn ensemble_rank(
    count: usize,
    level: f64,
    confidence: Option<f64>,
) -> Result<(usize, f64), PointingError> {
    let none = PointingError::Short { samples: 0, least: 1 };
    let first = rank(count, level).ok_or(none)?;
    let trials = u64::try_from(count).unwrap_or(u64::MAX);
    let distribution = Binomial::new(level, trials).map_err(|_| PointingError::Level(level))?;
    // The k-th of n is not below the quantile if at most k - 1 of them are.
    let reached = |rank: usize| distribution.cdf(u64::try_from(rank - 1).unwrap_or(u64::MAX));
    let Some(wanted) = confidence else { return Ok((first, reached(first))) };
    let enough = (first..=count).find(|rank| reached(*rank) >= wanted);
    let rank = enough.ok_or(PointingError::Runs { runs: count, level, confidence: wanted })?;
    Ok((rank, reached(rank)))
}

/// Differences of the means of windows at the same time of each run and the next.
fn reproducibility(
    window: f64,
    runs: &[&[&[f64]]],
    rate: f64,
) -> Result<Vec<Vec<f64>>, PointingError> {
    if runs.len() < 2 {
        let of = "the reproducibility error of fewer than two runs";
        return Err(PointingError::Interpretation { of });
    }
    let means = runs.iter().map(|components| means_of_run(window, components, rate));
    let means: Vec<Vec<Vec<f64>>> = means.collect::<Result<_, _>>()?;
    let differ = |a: &Vec<f64>, b: &Vec<f64>| norm(a.iter().zip(b).map(|(a, b)| a - b));
    let pairs = means.iter().zip(means.iter().skip(1));
    Ok(pairs.map(|(a, b)| a.iter().zip(b).map(|(a, b)| differ(a, b)).collect()).collect())
}

/// An index of a stationary Gaussian error of one axis with zero mean and this density, over time and runs: the RMS
/// through the weight of the index, with `u = pi f T`, times the factor of the level, `P(|x| <= factor sigma) = P`.
///
/// | index | weight (ESSB-HB-E-003, annex on metrics in the frequency domain) |
/// |---|---|
/// | APE | 1 |
/// | MPE | `sinc^2 u` |
/// | RPE | `1 - sinc^2 u` |
/// | PDE | `4 sin^2(pi f T_s) sinc^2 u`, with the stability time `T_s` |
/// | PRE | `2 sinc^2 u`: windows of different periods are independent |
///
/// The handbook has the RMS over a window for the RPE, as here. What the spectrum's detrending has removed is missing.
/// A probability over runs at the worst time needs runs: a density does not define it.
///
/// # Errors
///
/// Windows, a level that is not between zero and one, or a result that overflows.
pub fn index_of_psd(index: Index, psd: &Psd, level: f64) -> Result<IndexValue, PointingError> {
    check_level(level)?;
    index.check()?;
    let window = index.window().unwrap_or(0.0);
    let slowest = if let Index::Pde { stability, .. } = index { stability } else { window };
    if slowest > 0.0 {
        check_time(slowest)?;
    }
    let mut square = 0.0;
    for ([from, to], of_bin) in psd.cells() {
        let parts = 2 * parts([from, to], slowest.max(window));
        for k in 0..=parts {
            let simpson = if k == 0 || k == parts { 1.0 } else { f64::from(2 + 2 * (k % 2)) };
            let frequency = from + f64::from(k) / f64::from(parts) * (to - from);
            square += of_bin * weight(index, frequency) * simpson / (3.0 * f64::from(parts));
        }
    }
    let normal = Normal::new(0.0, 1.0).map_err(|_| PointingError::Level(level))?;
    let value = square.sqrt() * normal.inverse_cdf(0.5 + 0.5 * level);
    check_number("index", 0, value)?;
    let interpretation = Interpretation::Mixed;
    Ok(IndexValue { index, value, interpretation, level, confidence: None, runs: 0, values: 0 })
}

/// The weight of an index at a frequency, Hz.
fn weight(index: Index, frequency: f64) -> f64 {
    let of = |window: f64| ExposureWeights::new(frequency, window);
    match index {
        Index::Ape => 1.0,
        Index::Mpe { window } => of(window).displacement,
        Index::Rpe { window } => of(window).departure(),
        Index::Pde { window, stability } => {
            let (sine, _) = Angle::sin_cos(PI * frequency * stability);
            4.0 * sine * sine * of(window).displacement
        }
        Index::Pre { window } => 2.0 * of(window).displacement,
    }
}

fn check_level(level: f64) -> Result<(), PointingError> {
    if level > 0.0 && level < 1.0 { Ok(()) } else { Err(PointingError::Level(level)) }
}
