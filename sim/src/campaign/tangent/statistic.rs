//! Derivatives of a number of a history.
//!
//! The square of an RMS, also of one of exposures, is a quadratic form Q of the samples x. With their
//! derivatives d and any factor s,
//!
//! ```text
//! Q(x + s d) - Q(x - s d) = 4 s B(x, d)      dF = B(x, d) / F      F = sqrt Q(x)
//! ```
//!
//! without an error but rounding. The RMS in a band is such a form as long as no bin of the spectrum enters or leaves the
//! band: B is that of the bins that are in it. A peak has the derivative of the magnitude at the sample that is largest.

use super::run::Samples;
use crate::campaign::Selection;
use crate::record::welch::band_derivatives;
use crate::record::{Header, Outcome, Recorder as _, Statistics};
use crate::scenario::{Projection, Requirement, Scenario, Statistic};
use precess_craft::tangent::{Number, WIDTH};

/// The size of `s d` by that of `x`.
const SHARE: f64 = 0.1;

/// A number of a history.
pub(super) struct Kind {
    columns: Vec<usize>,
    projection: Projection,
    window: [f64; 2],
    of: StatisticKind,
}

enum StatisticKind {
    /// RMS over time, by the trapezoidal rule.
    Rms,
    Peak,
    /// At the end of the window.
    Final,
    /// Largest departure from the first sample.
    Drift,
    /// The RMS in a band, Hz.
    BandRms([f64; 2]),
    /// The root of a quadratic form.
    Quadratic(Box<Requirement>),
    /// What has no derivative.
    None,
}

/// The requirements, then RMS and peak of each column.
pub(super) fn kinds(
    scenario: &Scenario,
    selection: &Selection,
    header: &Header,
) -> Result<Vec<Kind>, String> {
    let columns = |name: &str| header.quantity(name).map_err(|error| error.to_string());
    let mut kinds = Vec::new();
    for requirement in &scenario.requirements {
        let of = match requirement.statistic {
            Statistic::Peak => StatisticKind::Peak,
            Statistic::Rms => StatisticKind::Rms,
            Statistic::Final => StatisticKind::Final,
            Statistic::Drift => StatisticKind::Drift,
            Statistic::BandRms(band) => StatisticKind::BandRms(band),
            Statistic::Displacement(_) | Statistic::Smear(_) | Statistic::Jitter(_) => {
                StatisticKind::Quadratic(Box::new(requirement.clone()))
            }
            Statistic::Index { .. } => StatisticKind::None,
        };
        kinds.push(Kind {
            columns: columns(&requirement.quantity)?,
            projection: requirement.projection,
            window: requirement.window,
            of,
        });
    }
    for name in &selection.columns {
        let (columns, window) = (columns(name)?, [selection.from, f64::INFINITY]);
        let whole =
            |of| Kind { columns: columns.clone(), projection: Projection::None, window, of };
        kinds.push(whole(StatisticKind::Rms));
        kinds.push(whole(StatisticKind::Peak));
    }
    Ok(kinds)
}

/// Magnitude of a vector and its derivatives.
fn magnitude(values: &[Number]) -> Number {
    let square: f64 = values.iter().map(|of| of.value * of.value).sum();
    let size = square.sqrt();
    let mut found = Number::constant(size);
    for key in 0..WIDTH {
        let sum: f64 = values.iter().map(|of| of.value * of.derivative(key)).sum();
        found.add_derivative(key, if size > 0.0 { sum / size } else { 0.0 });
    }
    found
}

impl Kind {
    /// The number and its derivatives by some keys; none where a quantity has none.
    pub(super) fn derivatives(
        &self,
        samples: &Samples,
        header: &Header,
        outcome: &Outcome,
        keys: usize,
    ) -> Option<(f64, Vec<f64>)> {
        let [from, to] = self.window;
        let values = |row: &[Number]| -> Vec<Number> {
            let of = self.columns.iter().filter_map(|column| row.get(*column).copied());
            self.projection.of_numbers(of.collect(), Number::constant)
        };
        let history: Vec<(f64, Vec<Number>)> = samples
            .iter()
            .filter(|(time, _)| (from..=to).contains(time))
            .map(|(time, row)| (*time, values(row)))
            .collect();
        let first = history.first()?.1.clone();
        let largest = |of: &dyn Fn(&[Number]) -> Number| {
            let all = history.iter().map(|(_, values)| of(values));
            all.max_by(|a, b| a.value.total_cmp(&b.value))
        };
        let found = match &self.of {
            StatisticKind::Rms => return rms(&history, keys),
            StatisticKind::BandRms(band) => {
                let whole = outcome.end_time >= to;
                let settings = (*band, header.rate, (to - from) * header.rate);
                return band_rms(&history, settings, keys).filter(|_| whole);
            }
            StatisticKind::Quadratic(requirement) => {
                return quadratic(requirement, &self.columns, (samples, header, outcome), keys);
            }
            StatisticKind::Peak => largest(&magnitude)?,
            StatisticKind::Final => magnitude(&history.last()?.1),
            StatisticKind::Drift => largest(&|values| {
                let apart: Vec<Number> = values.iter().zip(&first).map(|(a, b)| *a - *b).collect();
                magnitude(&apart)
            })?,
            StatisticKind::None => return None,
        };
        found.value.is_finite().then(|| (found.value, found.derivatives[..keys].to_vec()))
    }
}

fn rms(history: &[(f64, Vec<Number>)], keys: usize) -> Option<(f64, Vec<f64>)> {
    let (mut square, mut by, mut length) = (0.0, vec![0.0; keys], 0.0);
    let product = |values: &[Number], key: usize| -> f64 {
        values.iter().map(|of| of.value * of.derivative(key)).sum()
    };
    let own = |values: &[Number]| -> f64 { values.iter().map(|of| of.value * of.value).sum() };
    for pair in history.windows(2) {
        let [(t0, a), (t1, b)] = pair else { continue };
        let half = 0.5 * (t1 - t0);
        length += t1 - t0;
        square += half * (own(a) + own(b));
        for (key, sum) in by.iter_mut().enumerate() {
            *sum += half * (product(a, key) + product(b, key));
        }
    }
    let value = (square / length).sqrt();
    let by = by.into_iter().map(|sum| if value > 0.0 { sum / (length * value) } else { 0.0 });
    value.is_finite().then(|| (value, by.collect()))
}

/// By the bins in the band: of each component the evenly spaced samples, as [`Statistics`] takes them.
fn band_rms(
    history: &[(f64, Vec<Number>)],
    settings: ([f64; 2], f64, f64),
    keys: usize,
) -> Option<(f64, Vec<f64>)> {
    let (_, rate, _) = settings;
    let even = |before: f64, time: f64| ((time - before) * rate - 1.0).abs() < 1e-6;
    let first = history.first()?;
    let rest = history.windows(2).filter_map(|pair| {
        let [before, sample] = pair else { return None };
        even(before.0, sample.0).then_some(sample)
    });
    let samples: Vec<&Vec<Number>> =
        std::iter::once(first).chain(rest).map(|(_, values)| values).collect();
    let (mut square, mut by) = (0.0, vec![0.0; keys]);
    for component in 0..first.1.len() {
        let record = |of: &dyn Fn(&Number) -> f64| -> Vec<f64> {
            samples.iter().filter_map(|values| values.get(component).map(of)).collect()
        };
        let directions: Vec<Vec<f64>> =
            (0..keys).map(|key| record(&|of: &Number| of.derivative(key))).collect();
        let (own, along) = band_derivatives(settings, &record(&|of| of.value), &directions)?;
        square += own;
        by.iter_mut().zip(along).for_each(|(sum, along)| *sum += along);
    }
    let value = square.sqrt();
    let by = by.into_iter().map(|sum| if value > 0.0 { sum / value } else { 0.0 });
    value.is_finite().then(|| (value, by.collect()))
}

/// By polarisation, with the statistic of a run itself.
fn quadratic(
    requirement: &Requirement,
    columns: &[usize],
    (samples, header, outcome): (&Samples, &Header, &Outcome),
    keys: usize,
) -> Option<(f64, Vec<f64>)> {
    let statistic = |number: &dyn Fn(&Number) -> f64| -> Option<f64> {
        let mut statistics = Statistics::new(std::slice::from_ref(requirement));
        statistics.begin(header).ok()?;
        for (time, row) in samples {
            let mut row: Vec<f64> = row.iter().map(number).collect();
            *row.first_mut()? = *time;
            statistics.sample(&row).ok()?;
        }
        statistics.finish(outcome).ok()?;
        let verdict = statistics.verdicts().first()?;
        verdict.value.filter(|value| verdict.complete && value.is_finite())
    };
    let value = statistic(&|of| of.value)?;
    let size = |of: &dyn Fn(&Number) -> f64| -> f64 {
        let all = samples.iter().flat_map(|(_, row)| columns.iter().filter_map(|k| row.get(*k)));
        all.map(|number| of(number).powi(2)).sum::<f64>().sqrt()
    };
    let of_values = size(&|of| of.value);
    let mut by = Vec::new();
    for key in 0..keys {
        let of_slopes = size(&|of| of.derivative(key));
        if of_slopes == 0.0 || value == 0.0 {
            by.push(0.0);
            continue;
        }
        let s = SHARE * of_values / of_slopes;
        let [below, above] =
            [-s, s].map(|s| statistic(&|of: &Number| of.value + s * of.derivative(key)));
        let (below, above) = (below?, above?);
        by.push((above * above - below * below) / (4.0 * s * value));
    }
    Some((value, by))
}
